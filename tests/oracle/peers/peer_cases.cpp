// SPDX-License-Identifier: BSD-3-Clause
// peer_cases GROUP PARAMETERS FOLDER: runs our side of a comparison with other programs (compare.py runs the rest).
#include "peer_cases.hpp"

#include <exception>
#include <iostream>
#include <map>
#include <span>

int main(int argc, char** argv) {
  const std::map<std::string, void (*)(const dem::peers::Json&, const dem::peers::Folder&)> groups{
      {"impact", dem::peers::run_impacts},
      {"cantilever", dem::peers::run_cantilevers},
      {"compression", dem::peers::run_compression}};
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  const auto group = argc == 4 ? groups.find(arguments[1]) : groups.end();
  if (group == groups.end()) {
    std::cerr << "usage: peer_cases impact|cantilever|compression PARAMETERS FOLDER\n";
    return 64;
  }
  try {
    std::ifstream file(arguments[2]);
    file.exceptions(std::ios::badbit | std::ios::failbit);
    group->second(dem::peers::Json::parse(file).at(group->first), arguments[3]);
  } catch (const std::exception& e) {
    std::cerr << "peer_cases: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
