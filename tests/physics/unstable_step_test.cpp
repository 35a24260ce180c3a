// SPDX-License-Identifier: BSD-3-Clause
// A time step beyond the stability limit, or grains that became stiffer than it was chosen for, throw balls about: the watchdog sees it
// and names the ball. A case file cannot ask for such a step (safe_share of engine/time_step.hpp); this is for what nobody thought of.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/walls/shear_box.hpp"
#include "support/mixture_scene.hpp"

namespace dem {
namespace {

constexpr double k_overlap_allowed = 1.0;  // of a radius, as in a shear test

/// Steps until the watchdog, which looks every 100, finds something; 0 when it does not.
int steps_until_trouble(Simulation& s, int most, std::string& text) {
  for (int step = 1; step <= most; ++step) {
    s.step();
    if (step % 100 != 0) continue;
    const Trouble trouble = find_trouble(s, ShearBox::rooms_of(s.walls), k_overlap_allowed);
    text = trouble.text;
    if (trouble.kind != TroubleKind::none) return step;
  }
  return 0;
}

TEST(UnstableStep, IsSeenByTheWatchdog) {
  const Simulation healthy = test::run_mixture({}, 300);
  double limit = healthy.dt;
  for (int k = 0; k < 30; ++k) limit = stable_time_step(healthy, limit);
  const std::vector<std::pair<std::string, std::function<void(Simulation&)>>> faults{
      {"time step x 1.5", [=](Simulation& s) { s.set_time_step(1.5 * limit); }},
      {"time step x 2", [=](Simulation& s) { s.set_time_step(2.0 * limit); }},
      {"time step x 5", [=](Simulation& s) { s.set_time_step(5.0 * limit); }},
      {"stiffness x 1000", [=](Simulation& s) {
         s.scene.gravel.shear_modulus *= 1000.0;
         s.scene.rubber.shear_modulus *= 1000.0;
         s.set_time_step(s.dt);
       }}};
  for (const auto& [name, spoil] : faults) {
    Simulation s = healthy;
    spoil(s);
    std::string text;
    const int steps = steps_until_trouble(s, 5000, text);
    EXPECT_GT(steps, 0) << name;
    std::printf("%s: after %d steps, %s\n", name.c_str(), steps, text.c_str());
  }
  Simulation s = healthy;
  std::string text;
  EXPECT_EQ(steps_until_trouble(s, 1000, text), 0) << text;
}

}  // namespace
}  // namespace dem
