// SPDX-License-Identifier: BSD-3-Clause
// Choice of the compiled loops when the program starts, and the stages of a step that go to them.
#include "dem4grm/engine/kernel_target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"

namespace dem {

#ifdef DEM_X86_TARGETS
namespace v2 {
extern const Kernels k_kernels;
}
namespace v3 {
extern const Kernels k_kernels;
}
namespace v4 {
extern const Kernels k_kernels;
}
#else
namespace plain {
extern const Kernels k_kernels;
}
#endif

namespace {

struct Target {
  std::string_view name;
  const Kernels* kernels;
  bool runs_here;
};

#ifdef DEM_X86_TARGETS
/// What tells the levels of x86-64 from each other; the rest of a level has come with these in every processor. The names of
/// levels themselves are known to g++ only.
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
}
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/// The best first.
std::vector<Target> all_targets() {
#ifdef DEM_X86_TARGETS
  return {{"v4", &v4::k_kernels, has_v4()}, {"v3", &v3::k_kernels, has_v3()}, {"v2", &v2::k_kernels, true}};
#else
  return {{"plain", &plain::k_kernels, true}};
#endif
}

const std::vector<Target>& usable_targets() {
  static const std::vector<Target> usable = [] {
    std::vector<Target> targets = all_targets();
    std::erase_if(targets, [](const Target& t) { return !t.runs_here; });
    return targets;
  }();
  return usable;
}

std::atomic<const Target*>& chosen() {
  static std::atomic<const Target*> target{&usable_targets().front()};
  return target;
}

}  // namespace

std::vector<std::string_view> usable_kernel_targets() {
  std::vector<std::string_view> names;
  for (const Target& t : usable_targets()) names.push_back(t.name);
  return names;
}

std::string_view kernel_target() { return chosen().load()->name; }

void choose_kernel_target(std::string_view name) {
  for (const Target& t : usable_targets()) {
    if (t.name != name) continue;
    chosen() = &t;
    return;
  }
  throw InputError(fmt::format("no loops for the processor target '{}'; this program on this processor has {}", name,
                               fmt::join(usable_kernel_targets(), ", ")));
}

const Kernels& kernels() { return *chosen().load()->kernels; }

void evaluate_ball_contacts(Simulation& s) { kernels().evaluate_ball_contacts(s); }
void evaluate_early_contacts(Simulation& s) { kernels().evaluate_early_contacts(s); }
void evaluate_wall_contacts(Simulation& s) { kernels().evaluate_wall_contacts(s); }
void advance_rubber_grains(Simulation& s) { kernels().advance_rubber_grains(s); }
void advance_clumps(Simulation& s) { kernels().advance_clumps(s); }

}  // namespace dem
