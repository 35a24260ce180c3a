// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/strong_network.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace dem {
namespace {

template <class AnyContact>
double strength(const AnyContact& c, StrongMeasure measure) {
  return measure == StrongMeasure::normal_force ? c.normal_force : norm(force_on_second(c));
}

double mean_strength(std::span<const Contact> contacts, StrongMeasure measure) {
  double sum = 0.0;
  for (const Contact& c : contacts) sum += strength(c, measure);
  return sum / static_cast<double>(contacts.size());
}

/// Groups of nodes that are joined one pair at a time.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t root_a = find(a), root_b = find(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Contacts with walls; at the level of pairs all of one body with one wall as one, their forces added up.
std::vector<WallContact> plate_links(const ContactNetwork& network, ContactLevel level) {
  if (level == ContactLevel::contact) return network.wall_contacts;
  std::map<std::pair<int, int>, WallContact> by_body_and_wall;
  for (const WallContact& c : network.wall_contacts) {
    const auto [place, is_new] = by_body_and_wall.try_emplace({c.body, c.wall}, c);
    if (is_new) continue;
    place->second.normal_force += c.normal_force;  // a plane has one normal
    place->second.shear_force += c.shear_force;
  }
  std::vector<WallContact> merged;
  merged.reserve(by_body_and_wall.size());
  for (const auto& [key, contact] : by_body_and_wall) merged.push_back(contact);
  return merged;
}

}  // namespace

std::vector<unsigned char> strong_contacts(std::span<const Contact> contacts, StrongMeasure measure) {
  const double threshold = mean_strength(contacts, measure);
  std::vector<unsigned char> is_strong;
  is_strong.reserve(contacts.size());
  for (const Contact& c : contacts) is_strong.push_back(strength(c, measure) > threshold ? 1 : 0);
  return is_strong;
}

StrongNetwork strong_network(std::span<const Contact> contacts, StrongMeasure measure) {
  StrongNetwork out;
  out.threshold = mean_strength(contacts, measure);
  double load = 0.0, strong_load = 0.0;
  for (const Contact& c : contacts) {
    const double of_contact = strength(c, measure);
    load += of_contact;
    if (!(of_contact > out.threshold)) continue;
    const auto kind = static_cast<std::size_t>(c.kind);
    out.count += 1.0;
    strong_load += of_contact;
    out.composition[kind] += 1.0;
    out.load_composition[kind] += of_contact;
  }
  for (std::size_t k = 0; k < k_pair_kinds; ++k) {
    out.composition[k] /= out.count;
    out.load_composition[k] /= strong_load;
  }
  out.share = out.count / static_cast<double>(contacts.size());
  out.load_share = strong_load / load;
  return out;
}

ZoneLabel zone_of(const StrongNetwork& strong) {
  const double gravel = strong.composition[static_cast<std::size_t>(PairKind::gravel_gravel)];
  const double rubber = strong.composition[static_cast<std::size_t>(PairKind::rubber_rubber)];
  ZoneLabel label;
  if (gravel > 0.5) label.zone = Zone::rigid;
  if (rubber > 0.5) label.zone = Zone::soft;
  // A share of exactly 0 or 1 has no scatter of its own: one contact more or less stands for it.
  const auto margin = [&](double p) {
    const double error = std::sqrt(std::max(p * (1.0 - p) / strong.count, 1.0 / (strong.count * strong.count)));
    return std::fabs(p - 0.5) / error;
  };
  label.margin = strong.count > 0.0 ? std::min(margin(gravel), margin(rubber)) : 0.0;
  return label;
}

Percolation percolation_of(const ContactNetwork& network, std::span<const Contact> contacts,
                           const MicroOptions& options) {
  const StrongMeasure measure = options.strong;
  const double threshold = mean_strength(contacts, measure);
  const std::size_t n = network.body_position.size(), bottom = n, top = n + 1;
  // With the plates as nodes, bodies that share nothing but a plate would count as one group; so they are joined last.
  Groups groups(n + 2);
  for (const Contact& c : contacts) {
    if (strength(c, measure) > threshold) {
      groups.join(static_cast<std::size_t>(c.body_i), static_cast<std::size_t>(c.body_j));
    }
  }
  std::vector<double> size(n, 0.0);
  for (std::size_t body = 0; body < n; ++body) size[groups.find(body)] += 1.0;
  Percolation out;
  for (const double bodies : size) {
    if (bodies >= 2.0) out.clusters += 1.0;
    out.largest_cluster = std::max(out.largest_cluster, bodies / static_cast<double>(n));
  }
  for (const WallContact& c : plate_links(network, options.level)) {
    const int plate = network.box.plate_of(c.wall);
    const bool is_bottom = plate == network.box.bottom_plate, is_top = plate == network.box.top_plate;
    if ((is_bottom || is_top) && strength(c, measure) > threshold) {
      groups.join(static_cast<std::size_t>(c.body), is_bottom ? bottom : top);
    }
  }
  out.spans = groups.find(bottom) == groups.find(top);
  return out;
}

}  // namespace dem
