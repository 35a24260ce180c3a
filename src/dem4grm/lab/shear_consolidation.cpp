// SPDX-License-Identifier: BSD-3-Clause
// The pause of a branched test under another normal stress: what ShearStage does before it goes on.
#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/shear_stage.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

/// The halves stand still, and the plate goes to its stress, until the specimen is at rest by the criteria of the case.
void ShearStage::consolidate() {
  observer_.note(fmt::format("consolidates under {} before it is sheared on from {:.3f} mm",
                             format_quantity(test_.shear.normal_stress, Dimension::stress), displacement_ * 1e3));
  ShearBox::set_velocities(s_.walls, test_.shear.moving_half, 0.0, s_.walls[ShearBox::k_top_plate].velocity.z);
  PlateLoad load = specimen_.load;
  load.speed_cap = s_.servo.speed_cap;  // as gently as in shear: the packing is to be kept
  s_.servo.target_force = load.stress * load.area;
  while (s_.steps % k_rest_interval != 0) s_.step();  // the time step is reviewed at whole intervals only
  bring_to_rest(s_, load, test_.equilibrium, turn_.rest, [&] { watch_consolidation(); });
  turn_.is_consolidating = false;
  s_.servo.speed_cap = plate_speed_cap(test_, velocity_);
  observer_.note(fmt::format("at rest under {:.3f} kPa after {} steps, void ratio {:.4f}", turn_.rest.stress / 1e3,
                             turn_.rest.steps, turn_.rest.void_ratio));
  keep(true);
}

void ShearStage::watch_consolidation() {
  review_time_step(s_, longest_time_step());
  if (turn_.rest.steps % k_watch_interval == 0 || !has_only_numbers(s_)) {
    const Trouble trouble = find_trouble(s_, ShearBox::rooms_of(s_.walls), k_overlap_limit);
    if (trouble.kind != TroubleKind::none) {
      throw PhysicsError(fmt::format("{} (consolidation at {:.3f} mm, step {}){}", trouble.text, displacement_ * 1e3,
                                     turn_.rest.steps, advice_for(trouble, test_.box, s_.walls)));
    }
  }
  Progress p;
  p.stage = "consolidation";
  p.fraction = -1.0;
  p.displacement = displacement_;
  p.normal_stress = turn_.rest.stress;
  p.void_ratio = turn_.rest.void_ratio;
  p.unbalanced_ratio = turn_.rest.unbalanced_ratio;
  p.steps = turn_.rest.steps;
  p.time_step = s_.dt;
  observer_.progress(p);
  keep(false);
}

}  // namespace dem
