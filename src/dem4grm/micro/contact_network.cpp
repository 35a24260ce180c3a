// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/contact_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dem4grm/engine/observe.hpp"

namespace dem {
namespace {

/// A shear force this close to its limit was cut to it; the law leaves less than that as rounding.
constexpr double k_at_limit = 1.0 - 1e-9;

bool has_force(const Vec3& f) { return f.x != 0.0 || f.y != 0.0 || f.z != 0.0; }

/// What the law cut: the history, not the force with its dashpots, against friction times the elastic normal force.
bool is_at_limit(const ContactTable& t, std::size_t row) {
  const double overlap = t.state[row].overlap;
  return norm(t.shear(row)) >= k_at_limit * t.friction[row] * (t.hertz[row] * overlap * std::sqrt(overlap));
}

/// Fills what contacts with balls and with walls have in common. centre: of ball i, m.
template <class AnyContact>
void take_row(AnyContact& c, const ContactTable& t, std::size_t row, const Vec3& centre) {
  const Vec3 force = t.force(row);  // on i
  const double pull = dot(force, c.normal);
  c.point = centre + c.normal * t.lever_i(row);
  c.normal_force = -pull;
  c.shear_force = force - c.normal * pull;
  c.friction = t.friction[row];
  c.is_sliding = is_at_limit(t, row);
}

void take_ball_contacts(const Simulation& s, ContactNetwork& out) {
  const ContactTable& t = s.contacts;
  for (std::size_t row = 0; row < t.n_pairs(); ++row) {
    if (!has_force(t.force(row))) continue;
    Contact c;
    c.ball_i = first_of(t.pairs[row]);
    c.ball_j = second_of(t.pairs[row]);
    c.body_i = s.body_of_ball(c.ball_i);
    c.body_j = s.body_of_ball(c.ball_j);
    c.kind = kind_of(s.material_of_ball(c.ball_i), s.material_of_ball(c.ball_j));
    const Vec3 centre = s.balls.position(s.balls.index_of_id(c.ball_i));
    const Vec3 between = s.balls.position(s.balls.index_of_id(c.ball_j)) - centre;
    c.normal = between * (1.0 / norm(between));
    c.branch =
        out.body_position[static_cast<std::size_t>(c.body_j)] - out.body_position[static_cast<std::size_t>(c.body_i)];
    take_row(c, t, row, centre);
    out.contacts.push_back(c);
  }
}

void take_wall_contacts(const Simulation& s, ContactNetwork& out) {
  const ContactTable& t = s.contacts;
  for (std::size_t k = 0; k < t.wall_pairs.size(); ++k) {
    const std::size_t row = t.n_pair_rows() + k;
    if (!has_force(t.force(row))) continue;
    WallContact c;
    c.ball = first_of(t.wall_pairs[k]);
    c.wall = second_of(t.wall_pairs[k]);
    c.body = s.body_of_ball(c.ball);
    const Vec3 centre = s.balls.position(s.balls.index_of_id(c.ball));
    c.normal = look_at(s.walls[static_cast<std::size_t>(c.wall)], centre).away * -1.0;
    take_row(c, t, row, centre);
    c.branch = c.point - out.body_position[static_cast<std::size_t>(c.body)];
    out.wall_contacts.push_back(c);
  }
}

/// The contact seen from the other side.
Contact turned(Contact c) {
  std::swap(c.ball_i, c.ball_j);
  std::swap(c.body_i, c.body_j);
  c.normal = -c.normal;
  c.shear_force = -c.shear_force;
  c.branch = -c.branch;
  return c;
}

/// The contacts [first, last) of one pair of bodies as one.
Contact merged(std::span<const Contact> of_pair) {
  Contact out = of_pair.front();
  if (of_pair.size() == 1) return out;
  Vec3 force, push, point;
  double weight = 0.0, friction = 0.0;
  out.is_sliding = true;
  for (const Contact& c : of_pair) {
    force += force_on_second(c);
    push += c.normal * c.normal_force;
    point += c.point * c.normal_force;
    friction += c.friction * c.normal_force;
    weight += c.normal_force;
    out.is_sliding = out.is_sliding && c.is_sliding;
  }
  if (norm(push) > 0.0) out.normal = push * (1.0 / norm(push));
  out.normal_force = dot(force, out.normal);
  out.shear_force = out.normal * out.normal_force - force;
  if (weight > 0.0) {
    out.point = point * (1.0 / weight);
    out.friction = friction / weight;
  }
  return out;
}

}  // namespace

SampleBox find_sample_box(std::span<const Wall> walls) {
  SampleBox box;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].name == "bottom plate") box.bottom_plate = static_cast<int>(w);
    if (walls[w].name == "top plate") box.top_plate = static_cast<int>(w);
  }
  if (box.bottom_plate < 0 || box.top_plate < 0) return {};
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const bool is_bottom = walls[w].name.starts_with("bottom plate"), is_top = walls[w].name.starts_with("top plate");
    box.plate_of_rib.push_back(is_bottom ? box.bottom_plate : is_top ? box.top_plate : static_cast<int>(w));
  }
  const Wall& bottom = walls[static_cast<std::size_t>(box.bottom_plate)];
  box.area = bottom.length_u * bottom.length_v;
  box.height = walls[static_cast<std::size_t>(box.top_plate)].corner.z - bottom.corner.z;
  return box;
}

ContactNetwork contact_network_of(const Simulation& s) {
  ContactNetwork out;
  const auto n_bodies = static_cast<std::size_t>(s.n_bodies());
  for (int body = 0; body < s.n_bodies(); ++body) out.body_position.push_back(body_position(s, body));
  out.body_material.resize(n_bodies, k_rubber);
  for (std::size_t k = 0; k < s.clumps.clumps.size(); ++k) {
    out.body_material[static_cast<std::size_t>(s.balls.n_grains) + k] = s.clumps.clumps[k].material;
  }
  out.box = find_sample_box(s.walls);
  take_ball_contacts(s, out);
  take_wall_contacts(s, out);
  return out;
}

std::vector<Contact> merge_pairs(std::span<const Contact> contacts) {
  std::vector<Contact> sorted;
  sorted.reserve(contacts.size());
  for (const Contact& c : contacts) sorted.push_back(c.body_i <= c.body_j ? c : turned(c));
  const auto key = [](const Contact& c) { return std::array{c.body_i, c.body_j, c.ball_i, c.ball_j}; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Contact& a, const Contact& b) { return key(a) < key(b); });
  std::vector<Contact> out;
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && sorted[last].body_i == sorted[first].body_i &&
           sorted[last].body_j == sorted[first].body_j) {
      ++last;
    }
    out.push_back(merged(std::span(sorted).subspan(first, last - first)));
  }
  return out;
}

std::vector<Vec3> normals_of(std::span<const Contact> contacts) {
  std::vector<Vec3> out;
  out.reserve(contacts.size());
  for (const Contact& c : contacts) out.push_back(c.normal);
  return out;
}

std::vector<Contact> contacts_of_kind(std::span<const Contact> contacts, PairKind kind) {
  std::vector<Contact> out;
  out.reserve(static_cast<std::size_t>(
      std::count_if(contacts.begin(), contacts.end(), [kind](const Contact& c) { return c.kind == kind; })));
  std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(out),
               [kind](const Contact& c) { return c.kind == kind; });
  return out;
}

}  // namespace dem
