// SPDX-License-Identifier: BSD-3-Clause
// Growable array of plain values on a cache-line boundary, zero-filled; large arrays ask for huge pages.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace dem {

/// Array of trivially copyable T, 64-byte aligned. Elements beyond those written are zero.
/// Throws std::bad_alloc when memory is short.
template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t n) { resize(n); }
  AlignedArray(const AlignedArray& other) { assign(other.span()); }
  AlignedArray(AlignedArray&& other) noexcept { swap(other); }
  AlignedArray& operator=(AlignedArray other) noexcept {
    swap(other);
    return *this;
  }
  ~AlignedArray() { std::free(data_); }

  void swap(AlignedArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  /// Keeps the first min(size, n) elements; new ones are zero.
  void resize(std::size_t n) {
    if (n > capacity_) grow(std::max(n, capacity_ + capacity_ / 2));
    if (n > size_) std::memset(static_cast<void*>(data_ + size_), 0, (n - size_) * sizeof(T));
    size_ = n;
  }
  void assign(std::span<const T> values) {
    resize(values.size());
    if (!values.empty()) std::memcpy(static_cast<void*>(data_), values.data(), values.size() * sizeof(T));
  }
  void fill(const T& value) { std::fill_n(data_, size_, value); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::span<T> span() { return {data_, size_}; }
  [[nodiscard]] std::span<const T> span() const { return {data_, size_}; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  static constexpr std::size_t k_huge_page = std::size_t{2} << 20U;

  void grow(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    const std::size_t alignment = bytes >= k_huge_page ? k_huge_page : 64;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* fresh = std::aligned_alloc(alignment, rounded);
    if (fresh == nullptr) throw std::bad_alloc();
    // Fewer address translations for the gathers of the contact loop; a refusal of the kernel does no harm.
    if (alignment == k_huge_page) (void)madvise(fresh, rounded, MADV_HUGEPAGE);
    if (size_ > 0) std::memcpy(fresh, static_cast<const void*>(data_), size_ * sizeof(T));
    std::free(data_);
    data_ = static_cast<T*>(fresh);
    capacity_ = n;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace dem
