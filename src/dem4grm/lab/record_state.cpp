// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/record_state.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <tuple>
#include <type_traits>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// All numbers of a row in the order of its declaration.
template <class Row>
auto numbers_of(Row& r) {
  auto& e = r.energy;
  return std::array{&r.displacement,
                    &r.shear_stress,
                    &r.shear_stress_corrected,
                    &r.normal_stress,
                    &r.vertical_displacement,
                    &r.void_ratio,
                    &r.inertial_number,
                    &r.unbalanced_ratio,
                    &r.half_force_difference,
                    &r.normal_stress_worst,
                    &r.plate_shear_stress,
                    &r.time_step,
                    &e.kinetic,
                    &e.contact_strain,
                    &e.bond_strain,
                    &e.boundary_work,
                    &e.slip,
                    &e.dashpot,
                    &e.local_damping};
}

}  // namespace

void exchange(StateArchive& archive, std::vector<FrameInfo>& frames) {
  std::size_t count = frames.size();
  archive.exchange("frames", count);
  frames.resize(count);
  for (FrameInfo& f : frames) {
    archive.group("frame_" + std::to_string(&f - frames.data()), [&] {
      archive.exchange("number", f.number);
      archive.exchange("displacement", f.displacement);
      archive.exchange("state_hash", f.state_hash);
    });
  }
}

void exchange(StateArchive& archive, std::vector<ShearRow>& rows) {
  constexpr std::size_t n = std::tuple_size_v<decltype(numbers_of(rows.front()))>;
  static_assert(sizeof(ShearRow) == n * sizeof(double), "a new member of ShearRow must be saved too");
  std::vector<double> numbers;
  for (ShearRow& r : rows) {
    for (const double* v : numbers_of(r)) numbers.push_back(*v);
  }
  archive.exchange("rows", numbers);
  if (numbers.size() % n != 0)
    throw IoError("the saved rows of the record have another length than those of this build");
  rows.resize(numbers.size() / n);
  for (std::size_t k = 0; k < rows.size() * n; ++k) *numbers_of(rows[k / n])[k % n] = numbers[k];
}

void exchange(StateArchive& archive, std::vector<MicroRow>& rows) {
  static_assert(std::is_trivially_copyable_v<MicroRow> && sizeof(MicroRow) % sizeof(double) == 0,
                "a row of micro.csv holds doubles only");
  constexpr std::size_t n = sizeof(MicroRow) / sizeof(double);
  using Numbers = std::array<double, n>;
  std::vector<double> numbers;
  for (const MicroRow& row : rows) {
    const auto of_row = std::bit_cast<Numbers>(row);
    numbers.insert(numbers.end(), of_row.begin(), of_row.end());
  }
  archive.exchange("micro_rows", numbers);
  if (numbers.size() % n != 0)
    throw IoError("the saved rows of micro.csv have another length than those of this build");
  rows.resize(numbers.size() / n);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Numbers of_row{};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(k * n), n, of_row.begin());
    rows[k] = std::bit_cast<MicroRow>(of_row);
  }
}

void exchange(StateArchive& archive, Homogeneity& h) {
  archive.exchange("cells", h.cells);
  archive.exchange("void_ratio_scatter", h.void_ratio_scatter);
  archive.exchange("rubber_content_scatter", h.rubber_content_scatter);
  archive.exchange("void_ratio_inside", h.void_ratio_inside);
  archive.exchange("void_ratio_at_plates", h.void_ratio_at_plates);
  archive.exchange("void_ratio_at_sides", h.void_ratio_at_sides);
  archive.exchange("layering_at_plates", h.layering_at_plates);
  archive.exchange("layering_at_sides", h.layering_at_sides);
  archive.exchange("contacts", h.fabric.contacts);
  archive.exchange("deviator", h.fabric.deviator);
  archive.exchange("deviator_noise", h.fabric.deviator_noise);
  archive.exchange("largest_overlap", h.overlap.largest);
  archive.exchange("caught", h.overlap.caught);
}

}  // namespace dem
