// SPDX-License-Identifier: BSD-3-Clause
// A test of a user's own: grains and walls put together by hand, plates under load, walls led along a table of velocities.
// Knows nothing of Python.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// A plate that moves along its normal to carry a force, or a stress over the area that is between four other walls.
struct LoadedPlate {
  PlateServo servo;
  double stress = 0.0;  ///< Pa, compression positive; with `sides`
  /// Two pairs of opposite walls whose distances give the area; -1: the force is fixed.
  std::array<int, 4> sides{-1, -1, -1, -1};
};

/// Velocity of a wall over time: linear between the rows, constant before the first and behind the last.
struct WallMotion {
  int wall = -1;
  std::vector<double> times;     ///< s, ascending
  std::vector<Vec3> velocities;  ///< m/s
};

/// What stands at a time of a motion, m/s.
Vec3 velocity_at(const WallMotion& motion, double time);

/// How a grain begins.
struct GrainStart {
  bool is_rubber = false;
  int number = 0;       ///< among the rubber grains or among the clumps
  Vec3 velocity, spin;  ///< m/s, rad/s
};

class OwnTest {
 public:
  OwnTest();

  /// Describes the test until it is built; later changes have no effect.
  Scene scene;
  std::vector<GrainStart> starts;
  std::vector<LoadedPlate> plates;
  std::vector<WallMotion> motions;

  [[nodiscard]] bool is_built() const { return simulation_ != nullptr; }
  /// Grains and walls take their places. Throws InputError when the scene cannot be simulated.
  void build();
  /// The state; builds it first.
  Simulation& state();

  /// A time step that stays as it is, s. Throws InputError unless it is positive.
  void fix_time_step(double seconds);
  /// The safe share of the smallest stability limit under about this stress, Pa; from then on it follows the stiffest mode of
  /// what there is (engine/time_step.hpp). Returns it, s.
  double choose_time_step(double stress);

  /// Whole steps until `steps` are done or the flag is not zero. Looks at the state like the watchdog of a shear test. Throws
  /// PhysicsError, and InputError when no time step was chosen.
  void run(std::int64_t steps, const volatile std::sig_atomic_t& stop);

  /// The file holds the whole test. Throws IoError; loading also when the file holds something else.
  void save(const std::filesystem::path& path);
  static std::unique_ptr<OwnTest> load(const std::filesystem::path& path);

  /// Claimed by whoever works with the state (InUse).
  std::atomic<bool> is_in_use{false};
  int threads = 1;

 private:
  void lead_walls();
  void load_plates();
  void watch();
  void exchange_all(StateArchive& archive);

  std::unique_ptr<Simulation> simulation_;
  double fixed_step_ = 0.0, longest_step_ = 0.0;  ///< s; the longest one: of a chosen step
};

/// Claims a test for one thread. Throws Error with ExitCode::usage when another one works with it.
class InUse {
 public:
  explicit InUse(OwnTest& test);
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;
  ~InUse() { test_.is_in_use = false; }

 private:
  OwnTest& test_;
};

/// All of a scene, saved or loaded.
void exchange(StateArchive& archive, Scene& scene);

}  // namespace dem
