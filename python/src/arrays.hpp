// SPDX-License-Identifier: BSD-3-Clause
// Arrays between NumPy and the library: without a copy where the memory fits, else with one.
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dem4grm/core/vec3.hpp"
#include "dem4grm/micro/tensor.hpp"

namespace dem {

/// Row by row, of doubles; converted on the way in when it is not.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using WholeNumbers = pybind11::array_t<int, pybind11::array::c_style | pybind11::array::forcecast>;

static_assert(sizeof(Vec3) == 3 * sizeof(double), "a row of three numbers is a vector");

/// The rows of an array [n, 3] as vectors, in its own memory. Throws std::invalid_argument for another shape.
inline std::span<const Vec3> vectors_in(const Numbers& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw std::invalid_argument(std::string(name) + " must have the shape [n, 3]");
  }
  return {reinterpret_cast<const Vec3*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

/// The numbers of an array [n]. Throws std::invalid_argument for another shape.
template <class Array>
auto numbers_in(const Array& array, const char* name, std::size_t n) {
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != n) {
    throw std::invalid_argument(std::string(name) + " must have the shape [" + std::to_string(n) + "]");
  }
  return std::span(array.data(), n);
}

/// An array that takes over the memory of a vector.
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return pybind11::array_t<T>(std::move(shape), kept->data(), owner);
}
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values) {
  const auto n = static_cast<pybind11::ssize_t>(values.size());
  return array_of(std::move(values), {n});
}
/// [n, 3], likewise.
inline pybind11::array_t<double> array_of(std::vector<Vec3> values) {
  const auto n = static_cast<pybind11::ssize_t>(values.size());
  auto* const kept = new std::vector<Vec3>(std::move(values));
  const pybind11::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Vec3>*>(p); });
  return pybind11::array_t<double>(std::vector<pybind11::ssize_t>{n, 3}, reinterpret_cast<const double*>(kept->data()),
                                   owner);
}
/// [3, 3]
inline pybind11::array_t<double> array_of(const Tensor3& t) {
  return array_of(std::vector<double>(t.value.begin(), t.value.end()), {3, 3});
}
/// [3]
inline pybind11::array_t<double> array_of(const Vec3& v) { return array_of(std::vector<double>{v.x, v.y, v.z}); }

/// Memory of somebody else, who lives at least as long as the array; cannot be written. strides in bytes.
inline pybind11::array view_of(const double* first, std::vector<pybind11::ssize_t> shape,
                               std::vector<pybind11::ssize_t> strides, const pybind11::handle& owner) {
  pybind11::array view(pybind11::dtype::of<double>(), std::move(shape), std::move(strides), first, owner);
  view.attr("setflags")(pybind11::arg("write") = false);
  return view;
}

}  // namespace dem
