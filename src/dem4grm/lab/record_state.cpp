// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/record_state.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <type_traits>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// Rows of doubles only, as they lie in memory.
template <class Row>
void exchange_rows(StateArchive& archive, const char* name, std::vector<Row>& rows) {
  static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) % sizeof(double) == 0, "a row holds doubles only");
  constexpr std::size_t n = sizeof(Row) / sizeof(double);
  using Numbers = std::array<double, n>;
  std::vector<double> numbers;
  for (const Row& row : rows) {
    const auto of_row = std::bit_cast<Numbers>(row);
    numbers.insert(numbers.end(), of_row.begin(), of_row.end());
  }
  archive.exchange(name, numbers);
  if (numbers.size() % n != 0) {
    throw IoError(std::string("the saved ") + name + " have another length than those of this build");
  }
  rows.resize(numbers.size() / n);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Numbers of_row{};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(k * n), n, of_row.begin());
    rows[k] = std::bit_cast<Row>(of_row);
  }
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

void exchange(StateArchive& archive, std::vector<ShearRow>& rows) { exchange_rows(archive, "rows", rows); }

void exchange(StateArchive& archive, std::vector<MicroRow>& rows) { exchange_rows(archive, "micro_rows", rows); }

void exchange(StateArchive& archive, BeforeShear& before) {
  Homogeneity& h = before.homogeneity;
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
  archive.exchange("k0_x", before.lateral.k0_x);
  archive.exchange("k0_y", before.lateral.k0_y);
}

}  // namespace dem
