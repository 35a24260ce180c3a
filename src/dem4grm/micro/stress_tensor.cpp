// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/stress_tensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem4grm/micro/fabric.hpp"

namespace dem {

Tensor3 contact_stress(const ContactNetwork& network) {
  Tensor3 sum;
  for (const Contact& c : network.contacts) sum += outer(force_on_second(c), c.branch);
  for (const WallContact& c : network.wall_contacts) sum += outer(force_on_second(c), c.branch);
  return sum * (1.0 / network.box.volume());
}

Tensor3 boundary_stress(const ContactNetwork& network) {
  Tensor3 sum;
  for (const WallContact& c : network.wall_contacts) sum += outer(force_on_second(c), c.point);
  return sum * (1.0 / network.box.volume());
}

double plate_stress(const ContactNetwork& network) {
  double force = 0.0;
  for (const WallContact& c : network.wall_contacts) {
    if (network.box.plate_of(c.wall) == network.box.top_plate) force += force_on_second(c).z;
  }
  return force / network.box.area;
}

double largest_difference(const Tensor3& a, const Tensor3& b) {
  const Tensor3 d = a - b;
  return std::max({std::fabs(d.xx()), std::fabs(d.yy()), std::fabs(d.zz()), std::fabs(d.xz()), std::fabs(d.zx())});
}

AnisotropyTensors anisotropy_tensors(std::span<const Contact> contacts) {
  AnisotropyTensors out;
  const double n = static_cast<double>(contacts.size());
  out.contacts = deviator(fabric_tensor(contacts)) * 7.5;
  Tensor3 normal, shear;
  bool is_positive = !contacts.empty();
  for (const Contact& c : contacts) {
    const double density = 1.0 + along(out.contacts, c.normal);
    is_positive = is_positive && density > 0.0;
    normal += outer(c.normal, c.normal) * (c.normal_force / density);
    shear += outer(c.shear_force * -1.0, c.normal) * (1.0 / density);
  }
  const double f0 = is_positive ? trace(normal) / n : std::numeric_limits<double>::quiet_NaN();
  out.normal = deviator(normal * (1.0 / n)) * (7.5 / f0);
  out.shear = deviator(shear * (1.0 / n)) * (5.0 / f0);
  return out;
}

double stress_ratio_of(const AnisotropyTensors& a) {
  return 0.4 * deviator_size(a.contacts + a.normal + a.shear * 1.5);
}

double stress_ratio_of(const Tensor3& stress) { return deviator_size(stress) / (trace(stress) / 3.0); }

}  // namespace dem
