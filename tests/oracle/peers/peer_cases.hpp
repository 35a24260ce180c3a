// SPDX-License-Identifier: BSD-3-Clause
// The scenes that other programs compute too: what our side runs, and the files by which they are handed over.
#pragma once

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <string>

#include "dem4grm/verify/scenes.hpp"

namespace dem::peers {

using namespace dem::verify;
using Json = nlohmann::json;
using Folder = std::filesystem::path;

// Each runs one group of scenes with its section of parameters.json and writes, for every scene NAME, into the folder:
//   NAME.json      what the other program cannot take from parameters.json (not for cantilevers), SI
//   NAME.start.csv the bodies at the start
//   NAME.ours.csv  our result
void run_impacts(const Json& parameters, const Folder& folder);
void run_cantilevers(const Json& parameters, const Folder& folder);
void run_compression(const Json& parameters, const Folder& folder);

/// A table that keeps every bit of its numbers.
class Table {
 public:
  Table(const Folder& path, const std::string& header) : file_(path) {
    file_.exceptions(std::ios::badbit | std::ios::failbit);
    file_ << header << '\n' << std::setprecision(17);
  }
  template <class... Numbers>
  void row(const Numbers&... numbers) {
    bool is_first = true;
    ((file_ << (std::exchange(is_first, false) ? "" : ",") << numbers), ...);
    file_ << '\n';
  }

 private:
  std::ofstream file_;
};

inline void write_json(const Folder& path, const Json& content) {
  std::ofstream file(path);
  file.exceptions(std::ios::badbit | std::ios::failbit);
  file << content.dump(1) << '\n';
}

/// Young's modulus E (Pa), Poisson's ratio, density (kg/m3) and friction of a section of parameters.json.
inline MaterialSettings material_of(const Json& p) {
  const double nu = p.at("poisson");
  return {p.at("density"), p.at("friction"), shear_modulus(p.at("young"), nu), nu};
}

/// Our damping ratio b for the damping that LAMMPS derives from a restitution coefficient e.
///   LAMMPS, tsuji:  eta = alpha(e) sqrt(m k_nd), k_nd = F_n / d = (2/3) k_n;   ours: eta = 2 b sqrt(m k_n)
inline double damping_ratio_of_tsuji(double e) {
  const double alpha =
      1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  return 0.5 * alpha * std::sqrt(2.0 / 3.0);
}

}  // namespace dem::peers
