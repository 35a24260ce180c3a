// SPDX-License-Identifier: BSD-3-Clause
// Which contacts between rubber grains are evaluated when: most of them just before their grains move, while these are in
// the cache, so that a step goes through the state of the rubber once and not twice.
//
// Rows of two rubber balls are sorted by (i, j) with i < j, and so are blocks of grains. Whoever goes through the blocks
// in order and evaluates the contacts of a block (those with i in it) before he moves its grains, has evaluated all that
// act on it: those with j in it belong to earlier blocks, or to the block itself. No j has been moved too early, since it
// lies in a later block. Threads go through parts of consecutive blocks; contacts that reach into a later part are
// evaluated before any grain moves. What a row gives does not depend on when it is evaluated, so parts change no bit.
#pragma once

#include <vector>

namespace dem {

/// Batches of k_contact_batch rows that hold pairs of two rubber balls only; batch b begins with row b k_contact_batch.
struct RubberBatches {
  std::vector<int> first;       ///< [n_blocks + 1] first batch that begins with a row of the block or a later one
  std::vector<int> last_block;  ///< [batches] largest block of a second ball of its rows
  std::vector<double> slip;     ///< [batches] J, work of the present step
  std::vector<double> dashpot;  ///< [batches] J
  /// Blocks of a part in the present step; 0 when no contact waits for its grains.
  int part_length = 0;

  [[nodiscard]] int n_batches() const { return static_cast<int>(last_block.size()); }
  /// End of the part in which the block lies, when contacts wait.
  [[nodiscard]] int end_of_part(int block) const { return (block / part_length + 1) * part_length; }
};

}  // namespace dem
