// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/simulation_state.hpp"

#include <string>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

void exchange_balls(StateArchive& archive, BallStore& b) { archive.exchange_fixed("state", b.state.span()); }

constexpr std::size_t k_clump_numbers = 16;

/// Everything of a clump that moves; mass, inertia and shape follow from the scene.
void exchange_clumps(StateArchive& archive, ClumpStore& store) {
  std::vector<double> numbers(store.clumps.size() * k_clump_numbers), offsets(store.pebble_offset.size() * 3);
  const auto visit = [&](const auto& take) {
    double* v = numbers.data();
    for (Clump& c : store.clumps) {
      for (Vec3* a : {&c.position, &c.velocity, &c.angular_momentum, &c.spin}) {
        take(*v++, a->x), take(*v++, a->y), take(*v++, a->z);
      }
      Quaternion& q = c.orientation;
      take(*v++, q.w), take(*v++, q.x), take(*v++, q.y), take(*v++, q.z);
    }
    v = offsets.data();
    for (Vec3& a : store.pebble_offset) take(*v++, a.x), take(*v++, a.y), take(*v++, a.z);
  };
  if (!archive.is_loading()) visit([](double& stored, const double& value) { stored = value; });
  archive.exchange_fixed("motion", std::span(numbers));
  archive.exchange_fixed("pebble_offset", std::span(offsets));  // the fill scales its grains
  if (archive.is_loading()) visit([](const double& stored, double& value) { value = stored; });
}

/// Candidates with history and last forces; constants of the rows follow from the scene.
void exchange_contacts(StateArchive& archive, ContactTable& t) {
  archive.exchange("pairs", t.pairs);
  archive.exchange("rubber_pairs", t.n_rubber_pairs);
  archive.exchange("wall_pairs", t.wall_pairs);
  if (archive.is_loading()) t.state.resize(t.n_rows());
  // A row of the table is eight doubles.
  archive.exchange_fixed("state", std::span(t.state_numbers(), t.state.size() * k_contact_numbers));
  archive.exchange("damping_x", t.damping_x);
  archive.exchange("damping_y", t.damping_y);
  archive.exchange("damping_z", t.damping_z);
  if (archive.is_loading()) t.clear_constants();
}

/// The list itself is kept, not built anew: slip and dashpot works are summed over blocks of it, and with another list
/// their last bits would differ.
void exchange_search(StateArchive& archive, Simulation& s) {
  CandidateMargins& m = s.margins;
  archive.exchange("is_valid", s.candidates_valid);
  archive.exchange("horizon", m.horizon);
  archive.exchange("tunes", m.tunes);
  archive.exchange("least", m.least);
  archive.exchange("largest", m.largest);
  archive.exchange("margin", m.margin);
  archive.exchange("travel", m.travel);
  archive.exchange("wall_margin", m.wall_margin);
  archive.exchange("wall_travel", m.wall_travel);
  archive.exchange("is_used_up", m.is_used_up);
  archive.exchange("built_at_step", m.built_at_step);
  archive.exchange_fixed("top_speed2", std::span(s.block_top_speed2));
  archive.exchange("built_at_x", s.built_at[0]);
  archive.exchange("built_at_y", s.built_at[1]);
  archive.exchange("built_at_z", s.built_at[2]);
  if (archive.is_loading()) s.near.is_valid = false;  // found for other positions and sizes
}

void exchange_walls(StateArchive& archive, Simulation& s) {
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    archive.group(std::to_string(w), [&] {
      archive.exchange("corner", s.walls[w].corner);
      archive.exchange("length_u", s.walls[w].length_u);
      archive.exchange("length_v", s.walls[w].length_v);
      archive.exchange("velocity", s.walls[w].velocity);
      archive.exchange("friction", s.walls[w].friction);
      archive.exchange("last_velocity", s.last_wall_velocity[w]);
      archive.exchange("force", s.reactions[w].force);
      archive.exchange("stiffness", s.reactions[w].stiffness);
      archive.exchange("contacts", s.reactions[w].contacts);
    });
  }
}

void exchange_history(StateArchive& archive, GrainHistory& h) {
  archive.exchange_fixed("second_neighbour_shear", h.second_neighbour_shear.span());
  archive.exchange_fixed("second_neighbour_touches", h.second_neighbour_touches.span());
  archive.exchange_fixed("bond", h.bond.span());
  archive.exchange_fixed("bond_is_broken", h.bond_is_broken.span());
  archive.exchange_fixed("companion_shear", h.companion_shear.span());
}

void exchange_ledger(StateArchive& archive, Ledger& l) {
  archive.exchange("boundary", l.boundary);
  archive.exchange("contact_slip", l.contact_slip);
  archive.exchange("contact_dashpot", l.contact_dashpot);
  archive.exchange_fixed("grain_damping", l.grain_damping.span());
  archive.exchange_fixed("grain_dashpot", l.grain_dashpot.span());
  archive.exchange_fixed("grain_slip", l.grain_slip.span());
  archive.exchange_fixed("grain_breakage", l.grain_breakage.span());
  archive.exchange_fixed("clump_damping", std::span(l.clump_damping));
}

/// Saved only where there are any: the checkpoints of a shear test stay as they were.
void exchange_more_servos(StateArchive& archive, std::vector<PlateServo>& servos) {
  if (archive.is_loading() ? !archive.has_group("more_servos") : servos.empty()) return;
  archive.group("more_servos", [&] {
    auto n = static_cast<int>(servos.size());
    archive.exchange("count", n);
    servos.resize(static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < servos.size(); ++k) {
      archive.group(std::to_string(k), [&] {
        archive.exchange("wall", servos[k].wall);
        archive.exchange("force", servos[k].target_force);
        archive.exchange("gain", servos[k].gain);
        archive.exchange("cap", servos[k].speed_cap);
      });
    }
  });
}

void exchange_settings(StateArchive& archive, Simulation& s) {
  for (std::size_t m = 0; m < k_materials; ++m) {
    archive.exchange_fixed("friction_" + std::to_string(m), std::span(s.friction.between_grains[m]));
  }
  archive.exchange_fixed("wall_friction", std::span(s.friction.against_walls));
  archive.exchange("servo_wall", s.servo.wall);
  archive.exchange("servo_force", s.servo.target_force);
  archive.exchange("servo_gain", s.servo.gain);
  archive.exchange("servo_cap", s.servo.speed_cap);
  exchange_more_servos(archive, s.more_servos);
  archive.exchange("time_step", s.dt);
  archive.exchange("last_time_step", s.last_dt);
  archive.exchange("time", s.time);
  archive.exchange("steps", s.steps);
  archive.exchange("rebuilds", s.rebuilds);
}

}  // namespace

void exchange(StateArchive& archive, Simulation& s) {
  // The interleaved arrays depend on the width of a block.
  int lanes = static_cast<int>(k_lanes);
  archive.exchange("lanes", lanes);
  if (lanes != static_cast<int>(k_lanes)) throw IoError("the saved state is from a build with another pack width");
  archive.group("settings", [&] { exchange_settings(archive, s); });
  archive.group("balls", [&] { exchange_balls(archive, s.balls); });
  archive.group("clumps", [&] { exchange_clumps(archive, s.clumps); });
  archive.group("contacts", [&] { exchange_contacts(archive, s.contacts); });
  archive.group("grains", [&] { exchange_history(archive, s.grain_history); });
  archive.group("walls", [&] { exchange_walls(archive, s); });
  archive.group("ledger", [&] { exchange_ledger(archive, s.ledger); });
  archive.group("search", [&] { exchange_search(archive, s); });
  if (archive.is_loading()) s.prepare_rows();
}

void exchange(StateArchive& archive, EnergyReport& e) {
  archive.exchange("kinetic", e.kinetic);
  archive.exchange("contact_strain", e.contact_strain);
  archive.exchange("bond_strain", e.bond_strain);
  archive.exchange("boundary_work", e.boundary_work);
  archive.exchange("slip", e.slip);
  archive.exchange("dashpot", e.dashpot);
  archive.exchange("local_damping", e.local_damping);
  archive.exchange("breakage", e.breakage);
}

}  // namespace dem
