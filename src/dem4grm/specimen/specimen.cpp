// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/space_curve.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/void_ratio_defaults.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

namespace {

/// Volume-weighted mean size and density of the solids.
void describe(const GrainList& g, const SpecimenOrder& order, SpecimenReport& report) {
  double size = 0.0;
  for (const GravelGrain& grain : g.gravel) {
    const double d = grain.sieve_size;
    size += g.shapes[static_cast<std::size_t>(grain.shape)].volume * d * d * d * d;
  }
  const double rubber_size =
      g.rubber_count > 0 ? rubber_grain_size(g.rubber_ball_radius, order.materials.rubber.density, order.solid_density)
                         : 0.0;
  const double total = g.solid_volume();
  report.mean_size = (size + g.rubber_volume * rubber_size) / total;
  report.mean_density =
      (g.gravel_volume * order.materials.gravel.density + g.rubber_volume * order.solid_density) / total;
  report.rubber_content = g.rubber_content();
}

/// Throws IoError when the order is no permutation of the grains.
void renumber_gravel(GrainList& grains, const std::vector<int>& order) {
  const std::vector<GravelGrain> old = grains.gravel;
  std::vector<bool> is_used(old.size(), false);
  if (order.size() != old.size()) throw IoError("the saved state holds another number of gravel grains");
  for (std::size_t k = 0; k < old.size(); ++k) {
    const auto from = static_cast<std::size_t>(order[k]);
    if (from >= old.size() || is_used[from]) throw IoError("the saved state numbers its gravel grains wrongly");
    is_used[from] = true;
    grains.gravel[k] = old[from];
  }
}

/// Puts the grains of each kind in the order of a curve through the box, so that neighbours lie side by side in memory
/// for the whole test. order[k]: the drawn grain that becomes gravel grain k.
std::vector<int> number_along_curve(GrainList& grains, Fill& fill) {
  const auto position_of = [](const Pose& pose) { return pose.position; };
  sort_along_curve(fill.rubber, position_of);
  std::vector<int> order = sort_along_curve(fill.gravel, position_of);
  renumber_gravel(grains, order);
  return order;
}

Scene scene_of(const SpecimenOrder& order, const GrainList& grains, const Fill& fill) {
  Scene scene = order.materials;
  scene.rubber_ball_radius = grains.rubber_ball_radius;
  scene.grains = fill.rubber;
  scene.shapes = grains.shapes;
  for (std::size_t k = 0; k < grains.gravel.size(); ++k) {
    scene.clumps.push_back({grains.gravel[k].shape, grains.gravel[k].sieve_size, fill.gravel[k], k_gravel});
  }
  scene.wall_list = ShearBox(order.box, fill.height).walls();
  return scene;
}

FrictionTable preparation_friction(double friction) {
  FrictionTable t;  // plates are smooth during preparation
  for (auto& row : t.between_grains) row.fill(friction);
  return t;
}

void exchange(StateArchive& archive, SpecimenReport& r) {
  archive.exchange("void_ratio_generated", r.void_ratio_generated);
  archive.exchange("void_ratio_prepared", r.void_ratio_prepared);
  archive.exchange("void_ratio_before_shear", r.void_ratio_before_shear);
  archive.exchange("height", r.height);
  archive.exchange("alignment_generated", r.alignment_generated);
  archive.exchange("alignment_before_shear", r.alignment_before_shear);
  archive.exchange("fill_overlap", r.fill_overlap);
  archive.exchange("caught", r.caught);
  archive.exchange("time_step_limit", r.time_step.seconds);
  archive.exchange("time_step_limited_by", r.time_step.limited_by);
  archive.exchange("fill_steps", r.fill_steps);
  archive.exchange("compression_steps", r.compression_steps);
  archive.exchange("friction_steps", r.friction_steps);
}

void exchange(StateArchive& archive, RestState& r) {
  archive.exchange("steps", r.steps);
  archive.exchange("held", r.held);
  archive.exchange("stress", r.stress);
  archive.exchange("plate_speed", r.plate_speed);
  archive.exchange("unbalanced_ratio", r.unbalanced_ratio);
  archive.exchange("void_ratio", r.void_ratio);
}

void exchange(StateArchive& archive, FillState& f) {
  archive.exchange("growth_steps", f.growth_steps);
  archive.exchange("relaxation_steps", f.relaxation_steps);
  archive.exchange("steps", f.steps);
}

/// The stages of a preparation in order; each begins where the one before or a saved state left it.
class Preparation {
 public:
  Preparation(const SpecimenOrder& order, const PreparationHooks& hooks) : order_(order), hooks_(hooks) {
    out_.grains =
        draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
    describe(out_.grains, order, out_.report);
    out_.report.void_ratio_generated =
        order.specimen.generation_void_ratio.value_or(laboratory_void_ratio(order.specimen.rubber_content));
    out_.load = {ShearBox::k_top_plate, order.box.length * order.box.width,
                 order.normal_stress,   order.specimen.approach_speed,
                 order.servo.gain,      out_.grains.solid_volume()};
    out_.bounds = {{-order.box.wing, 0.0, 0.0},
                   {order.box.length + order.box.wing, order.box.width, order.box.upper_height}};
  }

  Specimen run() {
    if (hooks_.resumed != nullptr) {
      hooks_.resumed->exchange("stage", stage_);
      if (stage_ != k_fill) load();
    }
    if (stage_ == k_fill) begin_compression(fill());
    if (stage_ == k_compression) {
      rest();
      begin_final_friction();
    }
    if (stage_ == k_final_friction) {
      rest();
      finish();
    }
    return std::move(out_);
  }

  Specimen load_only() {
    hooks_.resumed->exchange("stage", stage_);
    if (stage_ == k_fill) throw IoError("the saved state is from the fill, which has no specimen yet");
    load();
    return std::move(out_);
  }

 private:
  static constexpr const char* k_fill = "fill";
  static constexpr const char* k_compression = "compression";
  static constexpr const char* k_final_friction = "final friction";

  Fill fill() {
    FillSettings settings;
    settings.void_ratio = out_.report.void_ratio_generated;
    settings.friction = order_.specimen.generation_friction;
    settings.seed = order_.seed;
    FillHooks hooks;
    hooks.restore = [&](FillState& state, Simulation& s) {
      if (hooks_.resumed != nullptr) exchange_fill(*hooks_.resumed, state, s);
    };
    hooks.between = [&](double share, FillState& state, Simulation& s) {
      if (!hooks_.watch || state.is_relaxed) return;
      PreparationState now{k_fill, share, {}, 0.0, false};
      now.rest.steps = state.steps;
      hooks_.watch(now, [&](StateArchive& archive) {
        archive.exchange("stage", stage_);
        exchange_fill(archive, state, s);
      });
    };
    return make_fill(out_.grains, order_.box, order_.materials, settings, hooks);
  }

  static void exchange_fill(StateArchive& archive, FillState& state, Simulation& s) {
    archive.group("fill", [&] {
      exchange(archive, state);
      archive.group("simulation", [&] { exchange(archive, s); });
    });
  }

  void begin_compression(Fill fill) {
    out_.report.fill_steps = fill.steps;
    out_.report.alignment_generated = fill.alignment;
    out_.report.fill_overlap = fill.largest_overlap;
    out_.report.caught = fill.caught;
    if (fill.caught > 0) {
      throw PhysicsError(
          fmt::format("the random fill caught {} ball centres inside other grains; choose another seed or a "
                      "larger generation_void_ratio",
                      fill.caught));
    }
    out_.gravel_order = number_along_curve(out_.grains, fill);
    out_.simulation = std::make_unique<Simulation>(scene_of(order_, out_.grains, fill));
    Simulation& s = *out_.simulation;
    out_.report.time_step = choose_time_step(s, order_.normal_stress);
    s.set_time_step(out_.report.time_step.seconds);
    s.set_friction(preparation_friction(order_.specimen.preparation_friction));
    begin(k_compression);
  }

  void begin_final_friction() {
    out_.report.void_ratio_prepared = rest_.void_ratio;
    out_.report.compression_steps = rest_.steps;
    Simulation& s = *out_.simulation;
    for (const int plate : {ShearBox::k_bottom_plate, ShearBox::k_top_plate}) {
      s.walls[static_cast<std::size_t>(plate)].friction = order_.materials.walls.friction;
    }
    s.set_friction(s.material_friction());
    begin(k_final_friction);
  }

  void finish() {
    const Simulation& s = *out_.simulation;
    out_.report.void_ratio_before_shear = rest_.void_ratio;
    out_.report.friction_steps = rest_.steps;
    out_.report.height = s.walls[ShearBox::k_top_plate].corner.z;
    out_.report.alignment_before_shear = rubber_alignment(s);
  }

  void begin(const char* stage) {
    stage_ = stage;
    rest_ = {};
    watch(true);
  }

  void rest() {
    Simulation& s = *out_.simulation;
    bring_to_rest(s, out_.load, order_.equilibrium, rest_, [&] {
      static_assert(k_review_interval % k_rest_interval == 0 && k_review_interval_with_rubber % k_rest_interval == 0);
      review_time_step(s, out_.report.time_step.seconds);
      if (rest_.steps % (5 * k_rest_interval) == 0) {
        const std::string trouble = find_trouble(s, out_.bounds, k_overlap_limit);
        if (!trouble.empty()) throw PhysicsError(fmt::format("{} (stage {}, step {})", trouble, stage_, rest_.steps));
      }
      watch(false);
    });
  }

  void watch(bool is_new_stage) {
    if (!hooks_.watch) return;
    hooks_.watch({stage_, -1.0, rest_, out_.simulation->time_step(), is_new_stage}, [&](StateArchive& archive) {
      archive.exchange("stage", stage_);
      exchange(archive, out_);
      archive.group("rest", [&] { exchange(archive, rest_); });
    });
  }

  /// A specimen of the right make, with every grain still at the origin, then its state.
  void load() {
    hooks_.resumed->exchange("gravel_order", out_.gravel_order);
    renumber_gravel(out_.grains, out_.gravel_order);
    Fill nowhere;
    nowhere.gravel.resize(out_.grains.gravel.size());
    nowhere.rubber.resize(static_cast<std::size_t>(out_.grains.rubber_count));
    nowhere.height = order_.box.height;
    out_.simulation = std::make_unique<Simulation>(scene_of(order_, out_.grains, nowhere));
    exchange(*hooks_.resumed, out_);
    if (hooks_.resumed->has_group("rest")) {
      hooks_.resumed->group("rest", [&] { exchange(*hooks_.resumed, rest_); });
    }
  }

  const SpecimenOrder& order_;
  const PreparationHooks& hooks_;
  Specimen out_;
  std::string stage_ = k_fill;
  RestState rest_;
};

}  // namespace

void exchange(StateArchive& archive, Specimen& specimen) {
  archive.exchange("gravel_order", specimen.gravel_order);
  archive.group("report", [&] { exchange(archive, specimen.report); });
  archive.group("simulation", [&] { exchange(archive, *specimen.simulation); });
}

Specimen prepare_specimen(const SpecimenOrder& order, const PreparationHooks& hooks) {
  return Preparation(order, hooks).run();
}

Specimen load_specimen(const SpecimenOrder& order, StateArchive& state) {
  PreparationHooks hooks;
  hooks.resumed = &state;
  return Preparation(order, hooks).load_only();
}

}  // namespace dem
