// SPDX-License-Identifier: BSD-3-Clause
// The contacts that carry more than the mean: who they are, what they bear, whether they span the specimen.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/options.hpp"

namespace dem {

/// Behaviour of a mixture by the majority among its strong contacts: more than half g-g, more than half r-r, or neither.
enum class Zone : std::uint8_t { rigid = 1, intermediate = 2, soft = 3 };

struct StrongNetwork {
  double threshold = 0.0;                               ///< N, mean of the measure over all contacts
  double count = 0.0;                                   ///< strong contacts
  double share = 0.0;                                   ///< of them among all contacts
  double load_share = 0.0;                              ///< of them in the sum of the measure
  std::array<double, k_pair_kinds> composition{};       ///< shares of the kinds among the strong contacts
  std::array<double, k_pair_kinds> load_composition{};  ///< the same weighted by the measure
};

/// 1 for each contact whose measure exceeds the mean of all. Source: Radjai et al. (1998), with f_n.
std::vector<unsigned char> strong_contacts(std::span<const Contact> contacts, StrongMeasure measure);

/// Not a number where there is nothing to divide by.
StrongNetwork strong_network(std::span<const Contact> contacts, StrongMeasure measure);

/// The zone and how sure it is: distance of the shares of g-g and r-r from one half, in standard errors
/// sqrt(p (1 - p) / N) of independent contacts, the smaller of the two.
struct ZoneLabel {
  Zone zone = Zone::intermediate;
  double margin = 0.0;
};
ZoneLabel zone_of(const StrongNetwork& strong);

/// Parts of the specimen that strong contacts hold together.
struct Percolation {
  bool spans = false;            ///< strong contacts lead from the bottom plate to the top plate
  double clusters = 0.0;         ///< groups of two and more bodies
  double largest_cluster = 0.0;  ///< share of the bodies in the largest group
};

/// contacts: those of the network, or its merged pairs. A contact with a plate is a link when its own measure exceeds the
/// threshold too; at the level of pairs the force is that of all contacts of the body with the plate.
Percolation percolation_of(const ContactNetwork& network, std::span<const Contact> contacts,
                           const MicroOptions& options);

}  // namespace dem
