// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops over blocks of fixed size. What a block computes never depends on the number of threads, nor on which
// thread it is that computes it.
#pragma once

#include <omp.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "dem4grm/core/lanes.hpp"

namespace dem {

constexpr std::size_t block_count(std::size_t n, std::size_t block_size) { return (n + block_size - 1) / block_size; }

/// The blocks of one loop, shared out among threads. Every thread begins with a share of its own, the same in every call,
/// so that it meets data that are in its cache; a thread that is done takes blocks from the end of another's share. A
/// thread that is slow, or whose processor somebody else uses for a while, is not waited for longer than one block takes.
class BlockShares {
 public:
  DEM_INLINE BlockShares(std::size_t blocks, std::size_t threads)
      : n_(threads < shares_.size() ? threads : shares_.size()) {
    for (std::size_t k = 0; k < n_; ++k) shares_[k].left = pack(blocks * k / n_, blocks * (k + 1) / n_);
  }

  /// Hands out the next block to that thread; false when none is left.
  DEM_INLINE bool take(std::size_t thread, std::size_t& block) {
    const std::size_t own = thread % n_;
    if (take_from(shares_[own], true, block)) return true;
    for (std::size_t k = 1; k < n_; ++k) {
      if (take_from(shares_[(own + k) % n_], false, block)) return true;
    }
    return false;
  }

 private:
  /// The blocks that are left of a share, [first, end), in one word, so that both change at once.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> left;
  };
  static constexpr std::uint64_t k_half = 0xffffffffU;

  DEM_INLINE static std::uint64_t pack(std::uint64_t first, std::uint64_t end) { return first << 32U | end; }

  DEM_INLINE static bool take_from(Share& share, bool from_front, std::size_t& block) {
    // The results of blocks are passed on by the end of the parallel region, not by this word.
    std::uint64_t left = share.left.load(std::memory_order_relaxed);
    for (;;) {
      const std::uint64_t first = left >> 32U, end = left & k_half;
      if (first >= end) return false;
      const std::uint64_t next = from_front ? pack(first + 1, end) : pack(first, end - 1);
      if (share.left.compare_exchange_weak(left, next, std::memory_order_relaxed)) {
        block = from_front ? first : end - 1;
        return true;
      }
    }
  }

  std::array<Share, 64> shares_;  // more threads than that begin with the same shares
  std::size_t n_;
};

/// Calls body(block, begin, end) for every block of [0, n); blocks may run at the same time on several threads.
/// The body must write only what belongs to its block, and must not throw.
template <class Body>
DEM_INLINE void for_each_block(std::size_t n, std::size_t block_size, Body&& body) {
  const std::size_t blocks = block_count(n, block_size);
  const auto run = [&](std::size_t block) {
    const std::size_t begin = block * block_size, end = begin + block_size < n ? begin + block_size : n;
    body(block, begin, end);
  };
  const auto most = static_cast<std::size_t>(omp_get_max_threads());
  const std::size_t threads = most < blocks ? most : blocks;
  if (threads <= 1) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
    return;
  }
  BlockShares shares(blocks, threads);
#pragma omp parallel num_threads(static_cast <int>(threads))
  {
    const auto me = static_cast<std::size_t>(omp_get_thread_num());
    for (std::size_t block = 0; shares.take(me, block);) run(block);
  }
}

}  // namespace dem
