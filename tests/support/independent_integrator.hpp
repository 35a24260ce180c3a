// SPDX-License-Identifier: BSD-3-Clause
// A fourth-order Runge-Kutta integrator of our own: the expected value where no closed form exists.
#pragma once

#include <array>
#include <cstddef>

namespace dem::test {

template <std::size_t n>
using StateVector = std::array<double, n>;

/// One step of length h of y' = f(t, y).
template <std::size_t n, class Derivative>
StateVector<n> runge_kutta_step(const Derivative& f, double t, const StateVector<n>& y, double h) {
  const auto moved = [&](const StateVector<n>& k, double by) {
    StateVector<n> out = y;
    for (std::size_t i = 0; i < n; ++i) out[i] += by * k[i];
    return out;
  };
  const StateVector<n> a = f(t, y), b = f(t + 0.5 * h, moved(a, 0.5 * h)), c = f(t + 0.5 * h, moved(b, 0.5 * h)),
                       d = f(t + h, moved(c, h));
  StateVector<n> out = y;
  for (std::size_t i = 0; i < n; ++i) out[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  return out;
}

}  // namespace dem::test
