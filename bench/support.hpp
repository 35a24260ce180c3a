// SPDX-License-Identifier: BSD-3-Clause
// What the benchmarks share: a clock, a stored specimen, sorted times, and the columns every row begins with.
#pragma once

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/lab/dense_assembly.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/version.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace bench {

using Clock = std::chrono::steady_clock;

inline double microseconds(Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

/// Time of one call, microseconds.
template <class Work>
double time_of(Work&& work) {
  const auto start = Clock::now();
  work();
  return microseconds(Clock::now() - start);
}

struct Times {
  std::vector<double> microseconds;

  void add(double t) { microseconds.push_back(t); }
  [[nodiscard]] double fastest() const { return *std::min_element(microseconds.begin(), microseconds.end()); }
  [[nodiscard]] double median() const {
    std::vector<double> t = microseconds;
    std::nth_element(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.size() / 2), t.end());
    return t[t.size() / 2];
  }
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double t : microseconds) sum += t;
    return sum / static_cast<double>(microseconds.size());
  }
};

/// A specimen with the case it belongs to.
struct Loaded {
  dem::DirectShearCase test;
  dem::Specimen specimen;
};

/// The specimen in the checkpoint of an output folder, in whatever stage after the fill it was stopped.
inline Loaded stored_specimen(const std::filesystem::path& folder) {
  const dem::LoadedCase loaded = dem::load_case(folder / dem::file_name::k_resolved);
  dem::StoredCheckpoint checkpoint = dem::read_checkpoint(folder / dem::file_name::k_checkpoint);
  Loaded out{std::get<dem::DirectShearCase>(loaded.test), {}};
  out.specimen = dem::load_specimen(dem::specimen_order(out.test), checkpoint.state);
  dem::Simulation& s = *out.specimen.simulation;
  const double velocity = dem::expected_shear_velocity(out.test);
  s.servo.speed_cap = dem::plate_speed_cap(out.test, velocity);
  out.test.shear.velocity = velocity;
  s.invalidate_candidates();  // the list of a calm specimen, not of the last rebuild of the preparation
  return out;
}

/// The grains of a case as a dense assembly, frozen.
inline Loaded assembly_of(const dem::DirectShearCase& test) {
  Loaded out{test, {}};
  out.test.shear.velocity = dem::expected_shear_velocity(test);
  const dem::SpecimenOrder order = dem::specimen_order(out.test);
  out.specimen.grains =
      dem::draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
  const dem::DenseAssembly assembly =
      dem::make_dense_assembly(out.specimen.grains, order.materials, order.box.length, order.box.width, order.seed);
  out.specimen.simulation = std::make_unique<dem::Simulation>(assembly.scene);
  out.specimen.simulation->set_time_step(dem::k_frozen_time_step);
  return out;
}

/// "case.toml,specimen.rubber_content=1,shear.normal_stress=100 kPa": a case file, and values in place of its own.
inline dem::DirectShearCase case_of(const std::string& source) {
  std::vector<dem::Override> changes;
  std::size_t comma = source.find(',');
  const std::string file = source.substr(0, comma);
  while (comma != std::string::npos) {
    const std::size_t next = source.find(',', comma + 1), equals = source.find('=', comma);
    if (equals >= next) throw dem::InputError(source + ": after a comma stands key=value");
    changes.push_back({source.substr(comma + 1, equals - comma - 1), source.substr(equals + 1, next - equals - 1)});
    comma = next;
  }
  return std::get<dem::DirectShearCase>(dem::load_case(file, changes).test);
}

/// A stored specimen of a folder, an assembly of a case.
inline Loaded specimen_of(const std::string& source) {
  return std::filesystem::is_directory(source) ? stored_specimen(source) : assembly_of(case_of(source));
}

/// The walls as they move in the shear stage; the test is one whose velocity was chosen when it was loaded.
inline void drive_walls(const dem::DirectShearCase& test, dem::Simulation& s) {
  dem::ShearBox::set_velocities(s.walls, test.shear.moving_half, test.shear.velocity.value(),
                                s.walls[dem::ShearBox::k_top_plate].velocity.z);
}

/// The body of main: one argument at least, else the usage on stderr and 64; errors on stderr and 1.
template <class Work>
int run_benchmark(int argc, const char* usage, const Work& work) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s\n", usage);
    return 64;
  }
  try {
    if (const char* target = std::getenv("DEM4GRM_TARGET")) dem::choose_kernel_target(target);
    return work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

/// A whole number on the command line, or the given one when it is left out.
inline int argument(int argc, char** argv, int place, int otherwise) {
  return argc > place ? std::atoi(argv[place]) : otherwise;
}

inline const char* common_columns() {
  return "commit,compiler,target,processor,threads,case,rubber_grains,clumps,balls,pairs,wall_pairs";
}

/// "model name" of /proc/cpuinfo.
std::string processor_name();

inline std::string common_row(const std::string& name, const dem::Simulation& s) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}", dem::k_commit, dem::k_compiler, dem::kernel_target(),
                     processor_name(), omp_get_max_threads(), name, s.balls.n_grains, s.clumps.clumps.size(),
                     s.balls.n_balls(), s.contacts.n_pairs(), s.contacts.wall_pairs.size());
}

}  // namespace bench
