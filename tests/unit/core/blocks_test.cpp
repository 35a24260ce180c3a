// SPDX-License-Identifier: BSD-3-Clause
// Every block of a parallel loop is handed out once, whoever takes it. Not tested: speed.
#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "dem4grm/core/blocks.hpp"

namespace {

using namespace dem;

/// Sets the number of threads and puts the old one back.
class Threads {
 public:
  explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

TEST(Blocks, EveryNumberIsVisitedOnceByAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 8, 100}) {
    const Threads set(threads);
    for (const std::size_t n : {0U, 1U, 7U, 8U, 9U, 1000U}) {
      std::vector<std::atomic<int>> visits(n);
      std::vector<std::atomic<int>> blocks(block_count(n, 8));
      for_each_block(n, 8, [&](std::size_t block, std::size_t begin, std::size_t end) {
        ++blocks[block];
        EXPECT_EQ(begin, 8 * block);
        EXPECT_LE(end, n);
        for (std::size_t k = begin; k < end; ++k) ++visits[k];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
      for (const auto& count : blocks) EXPECT_EQ(count, 1);
    }
  }
}

TEST(Blocks, AThreadTakesItsOwnShareFromTheFrontAndOthersFromTheEnd) {
  BlockShares shares(10, 2);
  std::size_t block = 99;
  std::vector<std::size_t> taken;
  while (shares.take(1, block)) taken.push_back(block);
  EXPECT_EQ(taken, (std::vector<std::size_t>{5, 6, 7, 8, 9, 4, 3, 2, 1, 0}));
  EXPECT_FALSE(shares.take(0, block));
}

// One thread is held up in its first block until all the others are done; with shares that are fixed this would not end.
TEST(Blocks, ASlowThreadIsNotWaitedForLongerThanOneBlockTakes) {
  const Threads set(2);
  constexpr std::size_t blocks = 64;
  std::atomic<std::size_t> done{0};
  std::atomic<bool> is_late{false};
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  for_each_block(blocks, 1, [&](std::size_t block, std::size_t, std::size_t) {
    while (block == 0 && omp_get_num_threads() > 1 && done < blocks - 1 && !is_late) {
      is_late = std::chrono::steady_clock::now() > limit;
      std::this_thread::yield();
    }
    ++done;
  });
  EXPECT_EQ(done, blocks);
  EXPECT_FALSE(is_late);
}

}  // namespace
