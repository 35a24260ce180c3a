// SPDX-License-Identifier: BSD-3-Clause
// The state of a simulation and the stages of one time step.
//
// Order of a step (step.cpp): list of candidates, ball contacts, wall contacts, rubber grains (with the contacts that
// wait for them, rubber_batches.hpp), clumps, walls. Positions belong to full steps, velocities to half steps
// (leapfrog); contact laws see the positions of the full step and the velocities that led there. Every stage runs over
// blocks of fixed size and every sum has a fixed order. So the bits do not depend on the number of threads, on the
// width of the lane loops, or on when the list of candidates was built. One exception: the last bits of the work of
// slip and dashpots, which no motion depends on, follow the list.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/engine/candidate_margins.hpp"
#include "dem4grm/engine/near_pairs.hpp"
#include "dem4grm/engine/rubber_batches.hpp"
#include "dem4grm/engine/scene.hpp"
#include "dem4grm/grains/ball_store.hpp"
#include "dem4grm/grains/clump_store.hpp"
#include "dem4grm/laws/hertz_mindlin.hpp"
#include "dem4grm/laws/parallel_bond.hpp"
#include "dem4grm/search/contact_table.hpp"
#include "dem4grm/walls/wall.hpp"

namespace dem {

/// Friction coefficients in force; a stage of a test may set others than those of the materials.
struct FrictionTable {
  std::array<std::array<double, k_materials>, k_materials> between_grains{};
  std::array<double, k_materials> against_walls{};  ///< of the grain's side; the wall's own value caps it
};

/// Ball ids [first, last).
struct IdRange {
  int first = 0, last = 0;
};

/// Forces of the grains on one wall at the last evaluation.
struct WallReaction {
  Vec3 force;              ///< N
  double stiffness = 0.0;  ///< sum of the tangent normal stiffnesses of its contacts, N/m
  int contacts = 0;
};

/// History of bonds and intra-grain contacts, interleaved like the grains.
struct GrainHistory {
  AlignedArray<double> second_neighbour_shear;           ///< [n_blocks][66][3][W] N
  AlignedArray<unsigned char> second_neighbour_touches;  ///< [n_blocks][66] bit per lane: has history
  AlignedArray<double> bond;                             ///< incremental form only: [n_blocks][64][6][W]
  AlignedArray<unsigned char> bond_is_broken;            ///< incremental form only: [n_blocks][64][W]
  AlignedArray<double> companion_shear;  ///< [n_blocks][64][3][W] N; empty unless a contact acts beside the bonds
};

/// Work done since the start, J. What the grains lost, except `boundary`, which the walls put in.
struct Ledger {
  double boundary = 0.0;
  double contact_slip = 0.0;
  double contact_dashpot = 0.0;
  AlignedArray<double> grain_damping;   ///< [n_blocks * W] local damping of rubber balls
  AlignedArray<double> grain_dashpot;   ///< [n_blocks * W] bond dashpots and intra-grain contacts
  AlignedArray<double> grain_slip;      ///< [n_blocks * W] slip of intra-grain contacts
  AlignedArray<double> grain_breakage;  ///< [n_blocks * W] elastic energy of bonds that broke, see EnergyReport
  std::vector<double> clump_damping;    ///< [n_clumps]
};

/// Energies and dissipated works, J.
struct EnergyReport {
  double kinetic = 0.0, contact_strain = 0.0, bond_strain = 0.0;
  double boundary_work = 0.0, slip = 0.0, dashpot = 0.0, local_damping = 0.0;
  /// What broken bonds, and what acted beside them, held in the moment in which they broke, less what the contacts hold that
  /// took their places. Below zero when most broke in compression.
  double breakage = 0.0;
};

/// Constants of the rubber grains of one size.
struct RubberSize {
  double ball_radius = 0.0;  ///< m
  double ball_mass = 0.0;    ///< kg
  BondParameters bond;
  HertzParameters second_neighbour;
};

/// A plate that moves along its normal to carry a given force (walls/servo.hpp).
struct PlateServo {
  int wall = -1;              ///< no servo when negative
  double target_force = 0.0;  ///< N, compression positive
  double gain = 0.5;
  double speed_cap = 0.0;  ///< m/s
};

class Simulation {
 public:
  /// Builds the state; throws InputError when the scene cannot be simulated.
  explicit Simulation(const Scene& scene);

  /// One time step.
  void step();

  /// For a start: present velocities count as if they had led here with this step.
  void set_time_step(double dt);
  /// In the middle of a motion: the contacts of the next step still see the displacements of the step before.
  void change_time_step(double dt);
  [[nodiscard]] double time_step() const { return dt; }
  /// Time between the half steps before and after the present instant, over which forces act; s.
  [[nodiscard]] double kick_time() const { return 0.5 * (last_dt + dt); }
  void set_friction(const FrictionTable& friction);
  /// Friction of every material pair by the mixing rule, of walls from the walls themselves.
  [[nodiscard]] FrictionTable material_friction() const;
  /// Stops all motion of grains (not of walls).
  void reset_velocities();
  /// Must be called after positions, sizes or walls were changed by hand.
  void invalidate_candidates() { candidates_valid = false; }
  /// A new list of candidates; searches for near pairs only when the known ones may miss some.
  void rebuild_candidates();
  /// Fills what follows from the lists of candidates: constants of the rows, groups of walls, references of the owners.
  void prepare_rows();

  [[nodiscard]] EnergyReport energy() const;
  /// Fingerprint of the complete mechanical state, in order of ids.
  [[nodiscard]] std::string state_hash() const;

  [[nodiscard]] Material material_of_ball(int id) const;
  [[nodiscard]] int n_bodies() const { return balls.n_grains + static_cast<int>(clumps.clumps.size()); }
  /// Body of a ball: grains first, then clumps.
  [[nodiscard]] int body_of_ball(int id) const { return body_of[static_cast<std::size_t>(id)]; }
  /// Constants of the reference size of rubber: of all grains when there is one size.
  [[nodiscard]] const RubberSize& rubber() const { return rubber_sizes.front(); }
  [[nodiscard]] const RubberSize& rubber_of_block(std::size_t block) const {
    return rubber_sizes[static_cast<std::size_t>(size_of_block[block])];
  }
  [[nodiscard]] const RubberSize& rubber_of_grain(int grain) const {
    return rubber_of_block(static_cast<std::size_t>(grain) / k_lanes);
  }
  /// Place of the block of a ball in block_top_speed2.
  [[nodiscard]] std::size_t speed_block_of(int id) const;
  /// Balls of a block of block_top_speed2.
  [[nodiscard]] IdRange balls_of_block(std::size_t block) const;
  /// "rubber grain 12, ball 3" or "clump 7, pebble 1".
  [[nodiscard]] std::string name_of_ball(int id) const;
  /// Constants of the contact of two balls, or of a ball and a wall when wall >= 0.
  [[nodiscard]] HertzParameters contact_parameters(int ball_i, int ball_j, int wall) const;

  // State, open to readers, stages and set-up code; a lab changes only walls' velocities.
  Scene scene;
  BallStore balls;
  ClumpStore clumps;
  std::vector<Wall> walls;
  ContactTable contacts;
  ContactReferences references;  ///< owners: blocks of grains, then clumps
  RubberBatches rubber_batches;
  GrainHistory grain_history;
  std::vector<RubberSize> rubber_sizes;  ///< the reference size first, whether or not a grain has it
  std::vector<int> size_of_block;        ///< [n_blocks] row of rubber_sizes
  FrictionTable friction;
  PlateServo servo;
  std::vector<PlateServo> more_servos;     ///< of further plates, for tests with several loaded ones
  AlignedArray<double> lane_inverse_mass;  ///< [n_blocks * W] 1/kg, of one ball; 0 in unused lanes
  std::vector<WallReaction> reactions;     ///< [n_walls]
  std::vector<Vec3> last_wall_velocity;    ///< [n_walls] before the present step
  Ledger ledger;
  double dt = 0.0;       ///< s
  double last_dt = 0.0;  ///< s, of the step that led to the present positions
  double time = 0.0;     ///< s
  std::int64_t steps = 0;
  std::int64_t rebuilds = 0;
  CandidateMargins margins;
  NearPairs near;  ///< no part of the state: the lists do not depend on it
  bool candidates_valid = false;
  std::vector<double> scratch_slip, scratch_dashpot;  ///< partial sums of one stage
  std::vector<WallReaction> scratch_reactions;
  std::vector<double> scratch_reach;       ///< [n_balls] m
  std::vector<double> block_top_speed2;    ///< [n_blocks + clump blocks] m2/s2
  std::vector<int> wall_group;             ///< first wall row of every ball near a wall, and the end
  std::vector<int> wall_block;             ///< first group of every block of k_wall_block ball ids, and the end
  BallPositions built_at;                  ///< when the list was built
  std::vector<int> body_of;                ///< [n_balls]
  std::vector<int> owner_of, place_of;     ///< [n_balls] see ContactReferences
  std::vector<unsigned char> material_of;  ///< [n_balls]

 private:
  void choose_rubber_sizes();
  void place_grains();
  void place_clumps();
};

/// State of one bond as an observer sees it; compression makes normal_force negative.
struct BondReading {
  double length = 0.0;         ///< m
  double normal_force = 0.0;   ///< N, without the dashpot
  Vec3 normal, shear, moment;  ///< unit vector from centre to corner ball; N; N m
  bool is_broken = false;
};
BondReading read_bond(const Simulation& s, int grain, int bond_index);

/// Largest displacement of a ball of the block (of block_top_speed2) since it was at the given positions, m.
double largest_displacement(const Simulation& s, std::size_t block, const BallPositions& since);

/// Sets the margins of the next list of candidates from the present speeds.
void choose_margins(Simulation& s);

// The stages of a step, in order.
void refresh_candidates(Simulation& s);
/// All contacts of two balls but those that wait until their rubber grains are advanced.
void evaluate_early_contacts(Simulation& s);
void evaluate_wall_contacts(Simulation& s);
void advance_rubber_grains(Simulation& s);
void advance_clumps(Simulation& s);
void move_walls(Simulation& s);

/// Makes room for the works (J) of so many blocks of a stage in scratch_slip and scratch_dashpot, all zero.
void prepare_partial_works(Simulation& s, std::size_t blocks);
/// The same for the forces on walls in scratch_reactions.
void prepare_partial_reactions(Simulation& s, std::size_t n);
/// The reactions of walls that are parts of others, added to those.
void add_to_carriers(Simulation& s);

/// All contacts of two balls at once, for readers of forces: after it none waits.
void evaluate_ball_contacts(Simulation& s);

/// Largest number of walls that one ball may be near at a time.
inline constexpr int k_most_walls_per_ball = 16;

/// Forces on walls are summed over blocks of so many ball ids, whatever balls are listed: a list of candidates that was
/// built at another time gives the same bits.
inline constexpr int k_wall_block = 2048;

/// Number of clumps that one block of advance_clumps handles.
inline constexpr std::size_t k_clump_block = 8;

}  // namespace dem
