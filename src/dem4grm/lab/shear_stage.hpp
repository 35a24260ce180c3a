// SPDX-License-Identifier: BSD-3-Clause
// The shear of a finished specimen: moves the halves, records, and can stop and go on at any look of the watchdog.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem4grm/lab/before_shear.hpp"
#include "dem4grm/lab/case.hpp"
#include "dem4grm/lab/observer.hpp"
#include "dem4grm/lab/shear_turn.hpp"
#include "dem4grm/specimen/specimen.hpp"

namespace dem {

class ShearStage {
 public:
  /// All four must live as long as the stage.
  ShearStage(const DirectShearCase& test, Specimen& specimen, BeforeShear& before, LabObserver& observer);

  /// From the beginning when `from` is null, else from the state in it. Throws PhysicsError when the watchdog finds
  /// trouble; the observer may throw to stop.
  void run(StateArchive* from);

  [[nodiscard]] const std::vector<ShearRow>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<MicroRow>& micro_rows() const { return micro_rows_; }
  /// Of a test that was branched from another one, where it left the course of that.
  [[nodiscard]] const ShearTurn& turn() const { return turn_; }

 private:
  static constexpr int k_watch_interval = 500;  ///< steps between two looks of the watchdog
  /// The time step may grow to so many times that of the preparation, however soft the specimen becomes.
  static constexpr double k_longest_over_prepared = 2.0;

  /// Sums over one interval of the record: forces (N), stresses (Pa).
  struct IntervalSums {
    double lower = 0.0, upper = 0.0, normal = 0.0, bottom_plate = 0.0, worst_normal = 0.0;
    std::array<Vec3, ShearBox::k_walls> on_wall{};
    int steps = 0;
  };

  [[nodiscard]] double plate_height() const;
  [[nodiscard]] double longest_time_step() const {
    return k_longest_over_prepared * specimen_.report.time_step.seconds;
  }
  [[nodiscard]] double next_row_at() const;
  /// True when the mark of that number is there and near.
  [[nodiscard]] bool has_reached(const std::vector<double>& at, std::size_t number) const;
  /// The velocity that the halves have now.
  [[nodiscard]] double halves_velocity() const;
  /// Rows since stress, velocity and interval are what they are.
  [[nodiscard]] std::span<const ShearRow> course() const {
    return std::span(rows_).subspan(static_cast<std::size_t>(turn_.course_rows));
  }
  void consolidate();
  void watch_consolidation();
  void advance();
  void finish_row();
  [[nodiscard]] EnergyReport since_start(EnergyReport e) const;
  void report();
  void watch();
  void check_books() const;
  void tell_velocity();
  void write_frame();
  void record_micro();
  StateArchive specimen_state();
  StateArchive complete_state();
  void keep(bool is_new_stage);
  void exchange_all(StateArchive& archive);
  /// Only of a branched test: the checkpoints of others stay as they were.
  void exchange_turn(StateArchive& archive);

  const DirectShearCase& test_;
  Specimen& specimen_;
  Simulation& s_;
  BeforeShear& before_;
  LabObserver& observer_;
  std::vector<double> frames_, micro_;  ///< m, where states and micro-mechanics are recorded
  double velocity_ = 0.0;               ///< m/s, of the halves against each other
  double displacement_ = 0.0, start_height_ = 0.0;
  EnergyReport start_energy_;
  std::size_t next_frame_ = 0;
  std::vector<FrameInfo> written_frames_;
  std::int64_t shear_steps_ = 0;
  IntervalSums sums_;
  std::vector<ShearRow> rows_;
  std::vector<MicroRow> micro_rows_;
  ShearTurn turn_;
};

}  // namespace dem
