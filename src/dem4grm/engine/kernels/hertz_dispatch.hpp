// SPDX-License-Identifier: BSD-3-Clause
// From the contact settings of a case to the loop that was compiled for them.
#pragma once

#include "dem4grm/grains/material.hpp"
#include "dem4grm/laws/hertz_mindlin.hpp"

namespace dem {

/// A set of options as a type, so that a generic lambda can use it as a template argument.
template <HertzOptions options>
struct CompiledOptions {
  static constexpr HertzOptions value = options;
};

/// Calls f with the CompiledOptions that match the settings: two unloading rules times five states of the dashpots.
template <class F>
void with_hertz_options(const ContactSettings& c, F&& f) {
  const auto with_rule = [&]<bool rescale>() {
    if (!(c.normal_damping_ratio > 0.0 || c.shear_damping_ratio > 0.0)) {
      f(CompiledOptions<HertzOptions{rescale, false, false, false}>{});
      return;
    }
    switch (c.dashpot_mode) {
      case 1:
        f(CompiledOptions<HertzOptions{rescale, true, true, false}>{});
        break;
      case 2:
        f(CompiledOptions<HertzOptions{rescale, true, false, true}>{});
        break;
      case 3:
        f(CompiledOptions<HertzOptions{rescale, true, true, true}>{});
        break;
      default:
        f(CompiledOptions<HertzOptions{rescale, true, false, false}>{});
        break;
    }
  };
  if (c.hz_mode == 1) {
    with_rule.template operator()<true>();
  } else {
    with_rule.template operator()<false>();
  }
}

}  // namespace dem
