// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/search/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dem4grm/core/blocks.hpp"

namespace dem {

namespace {

constexpr int k_levels = 6, k_no_level = -1;
constexpr std::size_t k_search_block = 64;         // spheres, or groups of pairs
constexpr std::size_t k_wall_search_block = 2048;  // balls

/// Balls [first, last) of one body inside a sphere; positions in m.
struct Sphere {
  Vec3 centre;
  double radius = 0.0;
  int first = 0, last = 0;
};

/// Cell grid of one size level: sphere numbers sorted by cell.
struct LevelGrid {
  double largest_radius = 0.0;
  double inverse_cell = 0.0;
  Vec3 low;
  std::array<int, 3> cells{};
  std::vector<int> start;    // [n_cells + 1]
  std::vector<int> numbers;  // sorted by cell, ascending within a cell

  [[nodiscard]] bool empty() const { return numbers.empty(); }
  [[nodiscard]] int along(double value, double origin, int axis) const {
    const double k = std::floor((value - origin) * inverse_cell);
    return static_cast<int>(std::clamp(k, 0.0, cells[static_cast<std::size_t>(axis)] - 1.0));
  }
};

Vec3 ball_centre(const SearchBalls& b, int id) {
  const auto k = static_cast<std::size_t>(id);
  return {b.x[k], b.y[k], b.z[k]};
}

/// One sphere about every run of balls with the same body.
std::vector<Sphere> bounding_spheres(const SearchBalls& balls) {
  std::vector<Sphere> spheres;
  const int n = static_cast<int>(balls.x.size());
  for (int first = 0; first < n;) {
    Sphere s;
    s.first = first;
    s.last = first + 1;
    while (s.last < n && balls.body[static_cast<std::size_t>(s.last)] == balls.body[static_cast<std::size_t>(first)]) {
      ++s.last;
    }
    first = s.last;
    spheres.push_back(s);
  }
  for_each_block(spheres.size(), k_search_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Sphere& s = spheres[k];
      for (int id = s.first; id < s.last; ++id) s.centre += ball_centre(balls, id);
      s.centre = s.centre * (1.0 / (s.last - s.first));
      for (int id = s.first; id < s.last; ++id) {
        s.radius =
            std::max(s.radius, norm(ball_centre(balls, id) - s.centre) + balls.radius[static_cast<std::size_t>(id)]);
      }
    }
  });
  return spheres;
}

int level_of(double radius, double largest) {
  int level = 0;
  double bound = 0.5 * largest;
  while (level + 1 < k_levels && radius <= bound) {
    ++level;
    bound *= 0.5;
  }
  return level;
}

void fill_grid(LevelGrid& grid, const std::vector<Sphere>& spheres, const std::vector<int>& members, double skin) {
  if (members.empty()) return;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const int m : members) {
    const Sphere& s = spheres[static_cast<std::size_t>(m)];
    low = {std::min(low.x, s.centre.x), std::min(low.y, s.centre.y), std::min(low.z, s.centre.z)};
    high = {std::max(high.x, s.centre.x), std::max(high.y, s.centre.y), std::max(high.z, s.centre.z)};
    grid.largest_radius = std::max(grid.largest_radius, s.radius);
  }
  double cell = 2.0 * grid.largest_radius + skin;
  const auto count = [&](double span) { return static_cast<int>(std::min(span / cell, 1e6)) + 1; };
  // A stray body far away must not blow the grid up: at most eight cells per sphere on average.
  while (static_cast<double>(count(high.x - low.x)) * count(high.y - low.y) * count(high.z - low.z) >
         8.0 * static_cast<double>(members.size()) + 4096.0) {
    cell *= 1.3;
  }
  grid.low = low;
  grid.inverse_cell = 1.0 / cell;
  grid.cells = {count(high.x - low.x), count(high.y - low.y), count(high.z - low.z)};
  const std::size_t n_cells = static_cast<std::size_t>(grid.cells[0]) * static_cast<std::size_t>(grid.cells[1]) *
                              static_cast<std::size_t>(grid.cells[2]);
  grid.start.assign(n_cells + 1, 0);
  std::vector<std::size_t> cell_of(members.size());
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Vec3 c = spheres[static_cast<std::size_t>(members[m])].centre;
    const int cx = grid.along(c.x, low.x, 0), cy = grid.along(c.y, low.y, 1), cz = grid.along(c.z, low.z, 2);
    cell_of[m] = static_cast<std::size_t>((cz * grid.cells[1] + cy) * grid.cells[0] + cx);
    ++grid.start[cell_of[m] + 1];
  }
  for (std::size_t c = 0; c < n_cells; ++c) grid.start[c + 1] += grid.start[c];
  std::vector<int> next(grid.start.begin(), grid.start.end() - 1);
  grid.numbers.resize(members.size());
  for (std::size_t m = 0; m < members.size(); ++m) {
    grid.numbers[static_cast<std::size_t>(next[cell_of[m]]++)] = members[m];
  }
}

/// Appends the spheres of one level that come within the skin of sphere i; on its own level only those of higher
/// number.
void collect(const std::vector<Sphere>& spheres, const LevelGrid& grid, int i, bool own_level, double skin,
             std::vector<PairKey>& out) {
  const Sphere& a = spheres[static_cast<std::size_t>(i)];
  const double reach = a.radius + skin;
  const int cx = grid.along(a.centre.x, grid.low.x, 0), cy = grid.along(a.centre.y, grid.low.y, 1),
            cz = grid.along(a.centre.z, grid.low.z, 2);
  const int x0 = std::max(0, cx - 1), x1 = std::min(grid.cells[0] - 1, cx + 1);
  for (int kz = std::max(0, cz - 1); kz <= std::min(grid.cells[2] - 1, cz + 1); ++kz) {
    for (int ky = std::max(0, cy - 1); ky <= std::min(grid.cells[1] - 1, cy + 1); ++ky) {
      const std::size_t row =
          static_cast<std::size_t>(kz * grid.cells[1] + ky) * static_cast<std::size_t>(grid.cells[0]);
      const int begin = grid.start[row + static_cast<std::size_t>(x0)];
      const int end = grid.start[row + static_cast<std::size_t>(x1) + 1];
      for (int m = begin; m < end; ++m) {
        const int j = grid.numbers[static_cast<std::size_t>(m)];
        if (own_level && j <= i) continue;
        const Sphere& b = spheres[static_cast<std::size_t>(j)];
        const Vec3 d = b.centre - a.centre;
        const double r = reach + b.radius;
        if (dot(d, d) < r * r) out.push_back(i < j ? pair_key(i, j) : pair_key(j, i));
      }
    }
  }
}

std::vector<PairKey> join_sorted(std::vector<std::vector<PairKey>>& parts) {
  std::size_t total = 0;
  for (const auto& p : parts) total += p.size();
  std::vector<PairKey> keys;
  keys.reserve(total);
  for (const auto& p : parts) keys.insert(keys.end(), p.begin(), p.end());
  // Parts follow each other in order unless a finer level met a coarser one of lower number; then one sort settles it.
  if (!std::is_sorted(keys.begin(), keys.end())) std::sort(keys.begin(), keys.end());
  return keys;
}

/// False for a sphere with a place that is no number, or farther away than any grain can be: a calculation that went wrong. It has no
/// neighbours, so that the watchdog can find it and say so.
bool is_in_this_world(const Sphere& s) {
  constexpr double k_world = 1e6;  // m
  const Vec3& c = s.centre;
  return std::fabs(c.x) < k_world && std::fabs(c.y) < k_world && std::fabs(c.z) < k_world && s.radius < k_world;
}

/// Pairs of spheres within the skin, sorted.
std::vector<PairKey> find_sphere_pairs(const std::vector<Sphere>& spheres, double skin) {
  double largest = 0.0;
  for (const Sphere& s : spheres) largest = is_in_this_world(s) ? std::max(largest, s.radius) : largest;
  std::array<std::vector<int>, k_levels> members;
  std::vector<int> level(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    level[i] = is_in_this_world(spheres[i]) ? level_of(spheres[i].radius, largest) : k_no_level;
    if (level[i] == k_no_level) continue;
    members[static_cast<std::size_t>(level[i])].push_back(static_cast<int>(i));
  }
  std::array<LevelGrid, k_levels> grids;
  for (std::size_t l = 0; l < k_levels; ++l) fill_grid(grids[l], spheres, members[l], skin);
  std::vector<std::vector<PairKey>> parts(block_count(spheres.size(), k_search_block));
  for_each_block(spheres.size(), k_search_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int l = 0; l <= level[i]; ++l) {
        const LevelGrid& grid = grids[static_cast<std::size_t>(l)];
        if (!grid.empty()) collect(spheres, grid, static_cast<int>(i), l == level[i], skin, parts[block]);
      }
    }
    std::sort(parts[block].begin(), parts[block].end());
  });
  return join_sorted(parts);
}

/// Balls of sphere a that come within the skin of sphere b.
void reaching(const SearchBalls& balls, const Sphere& a, const Sphere& b, double skin, std::vector<int>& out) {
  out.clear();
  for (int id = a.first; id < a.last; ++id) {
    const Vec3 d = ball_centre(balls, id) - b.centre;
    const double r = b.radius + balls.radius[static_cast<std::size_t>(id)] + skin;
    if (dot(d, d) < r * r) out.push_back(id);
  }
}

/// Appends the pairs of balls of two spheres; a holds the lower ids.
void compare(const SearchBalls& balls, const Sphere& a, const Sphere& b, double skin, std::vector<int>& of_a,
             std::vector<int>& of_b, std::vector<PairKey>& out) {
  reaching(balls, a, b, skin, of_a);
  if (of_a.empty()) return;
  reaching(balls, b, a, skin, of_b);
  for (const int i : of_a) {
    const Vec3 p = ball_centre(balls, i);
    const double reach = balls.radius[static_cast<std::size_t>(i)] + skin;
    for (const int j : of_b) {
      const Vec3 d = ball_centre(balls, j) - p;
      const double r = reach + balls.radius[static_cast<std::size_t>(j)];
      if (dot(d, d) < r * r) out.push_back(pair_key(i, j));
    }
  }
}

}  // namespace

std::vector<PairKey> find_pairs(const SearchBalls& balls, double skin) {
  if (balls.x.empty()) return {};
  const std::vector<Sphere> spheres = bounding_spheres(balls);
  const std::vector<PairKey> meeting = find_sphere_pairs(spheres, skin);
  std::vector<std::size_t> group;  // first pair of every lower sphere, and the end
  for (std::size_t k = 0; k < meeting.size(); ++k) {
    if (k == 0 || first_of(meeting[k]) != first_of(meeting[k - 1])) group.push_back(k);
  }
  group.push_back(meeting.size());
  std::vector<std::vector<PairKey>> parts(block_count(group.size() - 1, k_search_block));
  for_each_block(group.size() - 1, k_search_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    std::vector<PairKey>& out = parts[block];
    std::vector<int> of_a, of_b;
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t before = out.size();
      for (std::size_t k = group[g]; k < group[g + 1]; ++k) {
        const Sphere& a = spheres[static_cast<std::size_t>(first_of(meeting[k]))];
        const Sphere& b = spheres[static_cast<std::size_t>(second_of(meeting[k]))];
        if (balls.body[static_cast<std::size_t>(a.first)] == balls.body[static_cast<std::size_t>(b.first)]) continue;
        compare(balls, a, b, skin, of_a, of_b, out);
      }
      std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
    }
  });
  return join_sorted(parts);
}

std::vector<PairKey> find_wall_pairs(const SearchBalls& balls, std::span<const Wall> walls, double skin) {
  const std::size_t n = balls.x.size();
  std::vector<std::vector<PairKey>> parts(block_count(n, k_wall_search_block));
  for_each_block(n, k_wall_search_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 centre{balls.x[i], balls.y[i], balls.z[i]};
      const double reach = balls.radius[i] + skin;
      for (std::size_t w = 0; w < walls.size(); ++w) {
        if (walls[w].is_solid && comes_within(walls[w], centre, reach)) {
          parts[block].push_back(pair_key(static_cast<int>(i), static_cast<int>(w)));
        }
      }
    }
  });
  return join_sorted(parts);
}

}  // namespace dem
