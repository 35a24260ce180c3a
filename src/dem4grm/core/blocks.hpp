// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops over blocks of fixed size. What a block computes never depends on the number of threads.
#pragma once

#include <cstddef>

namespace dem {

constexpr std::size_t block_count(std::size_t n, std::size_t block_size) { return (n + block_size - 1) / block_size; }

/// Calls body(block, begin, end) for every block of [0, n); blocks may run at the same time on several threads.
/// The body must write only what belongs to its block, and must not throw.
template <class Body>
void for_each_block(std::size_t n, std::size_t block_size, Body&& body) {
  const auto blocks = static_cast<std::ptrdiff_t>(block_count(n, block_size));
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (std::ptrdiff_t b = 0; b < blocks; ++b) {
    const std::size_t begin = static_cast<std::size_t>(b) * block_size;
    const std::size_t end = begin + block_size < n ? begin + block_size : n;
    body(static_cast<std::size_t>(b), begin, end);
  }
}

}  // namespace dem
