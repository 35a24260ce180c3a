// SPDX-License-Identifier: BSD-3-Clause
// How often a test damages a file: a few hundred times, or as often as DEM4GRM_DAMAGES in the environment says.
#pragma once

#include <cstdlib>

namespace dem::test {

inline int number_of_damages(int usual) {
  const char* text = std::getenv("DEM4GRM_DAMAGES");
  const int wanted = text == nullptr ? 0 : std::atoi(text);
  return wanted > 0 ? wanted : usual;
}

}  // namespace dem::test
