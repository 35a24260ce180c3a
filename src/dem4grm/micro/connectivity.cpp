// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/connectivity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dem {
namespace {

/// Pairs (body, partner), each once, sorted; walls are partners with negative numbers.
std::vector<std::pair<int, int>> partners_of_all(const ContactNetwork& network) {
  std::vector<std::pair<int, int>> partners;
  partners.reserve(2 * network.contacts.size() + network.wall_contacts.size());
  for (const Contact& c : network.contacts) {
    partners.emplace_back(c.body_i, c.body_j);
    partners.emplace_back(c.body_j, c.body_i);
  }
  for (const WallContact& c : network.wall_contacts) partners.emplace_back(c.body, -1 - c.wall);
  std::sort(partners.begin(), partners.end());
  partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
  return partners;
}

}  // namespace

Connectivity connectivity_of(const ContactNetwork& network) {
  const std::size_t n = network.body_position.size();
  std::vector<int> partners(n, 0), contacts(n, 0);
  double between_bodies = 0.0;
  for (const auto& [body, partner] : partners_of_all(network)) {
    ++partners[static_cast<std::size_t>(body)];
    if (partner >= 0) between_bodies += 1.0;
  }
  for (const Contact& c : network.contacts) {
    ++contacts[static_cast<std::size_t>(c.body_i)];
    ++contacts[static_cast<std::size_t>(c.body_j)];
  }
  double rattlers[k_materials] = {}, bodies[k_materials] = {}, held = 0.0, contacts_of_held = 0.0;
  for (std::size_t body = 0; body < n; ++body) {
    const std::size_t material = network.body_material[body];
    bodies[material] += 1.0;
    if (partners[body] < 2) {
      rattlers[material] += 1.0;
    } else {
      held += 1.0;
      contacts_of_held += contacts[body];
    }
  }
  const auto all = static_cast<double>(n);
  Connectivity out;
  out.coordination = 2.0 * static_cast<double>(network.contacts.size()) / all;
  out.coordination_pairs = between_bodies / all;
  out.coordination_mechanical = contacts_of_held / held;
  out.rattlers = (rattlers[k_gravel] + rattlers[k_rubber]) / all;
  out.rattlers_gravel = rattlers[k_gravel] / bodies[k_gravel];
  out.rattlers_rubber = rattlers[k_rubber] / bodies[k_rubber];
  return out;
}

Friction friction_of(std::span<const Contact> contacts) {
  double normal = 0.0, shear = 0.0, sliding = 0.0;
  for (const Contact& c : contacts) {
    normal += std::fabs(c.normal_force);
    shear += norm(c.shear_force);
    sliding += c.is_sliding ? 1.0 : 0.0;
  }
  const auto n = static_cast<double>(contacts.size());
  return {n, sliding / n, shear / normal};
}

}  // namespace dem
