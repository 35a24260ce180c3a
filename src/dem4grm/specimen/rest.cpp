// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"

namespace dem {

double speed_cap_at(const PlateLoad& load, double stress) {
  return std::max(load.speed_cap, load.speed_of_stress * std::sqrt(std::clamp(stress, 0.0, load.stress)));
}

double plate_stress(const Simulation& s, const PlateLoad& load) {
  const auto w = static_cast<std::size_t>(load.wall);
  return -dot(s.reactions[w].force, s.walls[w].normal) / load.area;
}

double plate_void_ratio(const Simulation& s, const PlateLoad& load) {
  return load.area * s.walls[static_cast<std::size_t>(load.wall)].corner.z / load.solid_volume - 1.0;
}

double plate_speed_at(double inertial_number, const Layer& layer, double stress) {
  return inertial_number * layer.height * std::sqrt(stress / layer.density) / layer.mean_size;
}

namespace {

std::string unmet(const RestState& now, const PlateLoad& load, const EquilibriumSettings& e) {
  std::string text;
  if (!(now.unbalanced_ratio < e.force_ratio)) {
    text += fmt::format(" unbalanced force ratio {:.2g} (limit {:.2g});", now.unbalanced_ratio, e.force_ratio);
  }
  if (!(std::fabs(now.plate_speed) < e.plate_speed)) {
    text += fmt::format(" plate speed {:.3g} mm/s (limit {:.3g});", now.plate_speed * 1e3, e.plate_speed * 1e3);
  }
  if (!(std::fabs(now.stress - load.stress) <= e.stress_tolerance * load.stress)) {
    text += fmt::format(" stress {:.3f} kPa (target {:.3f});", now.stress * 1e-3, load.stress * 1e-3);
  }
  return text;
}

}  // namespace

void bring_to_rest(Simulation& s, const PlateLoad& load, const EquilibriumSettings& settings, RestState& now,
                   const std::function<void()>& watch) {
  s.servo = {load.wall, load.stress * load.area, load.gain, load.speed_cap};
  const auto plate = static_cast<std::size_t>(load.wall);
  while (now.held < settings.hold_steps) {
    const double height = s.walls[plate].corner.z, start = s.time;
    s.servo.speed_cap = speed_cap_at(load, now.stress);
    for (int k = 0; k < k_rest_interval; ++k) s.step();
    now.steps += k_rest_interval;
    now.plate_speed = (s.walls[plate].corner.z - height) / (s.time - start);
    now.stress = plate_stress(s, load);
    now.unbalanced_ratio = balance(s).ratio();
    now.void_ratio = plate_void_ratio(s, load);
    now.held = unmet(now, load, settings).empty() ? now.held + k_rest_interval : 0;
    if (now.steps >= settings.most_steps && now.held < settings.hold_steps) {
      throw PhysicsError(
          fmt::format("the specimen did not come to rest in {} steps:{} raise equilibrium.most_steps or "
                      "loosen the criteria",
                      now.steps, unmet(now, load, settings)));
    }
    watch();
  }
}

}  // namespace dem
