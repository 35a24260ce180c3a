// SPDX-License-Identifier: BSD-3-Clause
// The shear of a finished specimen: moves the halves, records, and can stop and go on at any look of the watchdog.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem4grm/lab/before_shear.hpp"
#include "dem4grm/lab/case.hpp"
#include "dem4grm/lab/observer.hpp"
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

 private:
  /// Sums over one interval of the record: forces (N), stresses (Pa).
  struct IntervalSums {
    double lower = 0.0, upper = 0.0, normal = 0.0, bottom_plate = 0.0, worst_normal = 0.0;
    std::array<Vec3, ShearBox::k_walls> on_wall{};
    int steps = 0;
  };

  [[nodiscard]] double plate_height() const;
  [[nodiscard]] double next_row_at() const;
  /// True when the mark of that number is there and near.
  [[nodiscard]] bool has_reached(const std::vector<double>& at, std::size_t number) const;
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
};

}  // namespace dem
