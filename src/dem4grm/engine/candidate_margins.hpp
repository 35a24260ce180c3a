// SPDX-License-Identifier: BSD-3-Clause
// How far grains may move before the list of candidates must be built anew.
#pragma once

#include <cstdint>
#include <vector>

namespace dem {

/// Every block of grains (blocks of rubber grains, then of clumps) has a margin of its own: balls are listed when they are
/// closer than the margins of their blocks, so the list holds until some block has moved by more than its margin. Fast
/// blocks get wide margins and slow ones narrow ones; one rattling grain does not widen the list for all.
///
/// formula:  margin = least + (u_block + u_mean) horizon
///   u_block  the larger of the present top speed in the block and its mean top speed since the last list (a grain that
///   has just been stopped will soon move again), m per step;   u_mean  mean of all;   horizon  steps that the list is
///   made for. Never above `largest`: the pairs near a block grow with the cube of its margin.
struct CandidateMargins {
  double horizon = 50.0;              ///< steps
  bool tunes = true;                  ///< the horizon follows what would have been cheapest for the last list
  double least = 0.0, largest = 0.0;  ///< m
  std::vector<double> margin;         ///< [n_blocks + clump blocks] m, empty before the first list
  std::vector<double> travel;      ///< m, bound of the displacement of any ball of the block since the list was built
  double wall_margin = 0.0;        ///< m, of all walls
  double wall_travel = 0.0;        ///< m, path of the fastest wall
  bool is_used_up = false;         ///< some travel has passed its margin
  std::int64_t built_at_step = 0;  ///< of the last list
};

}  // namespace dem
