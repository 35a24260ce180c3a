// SPDX-License-Identifier: BSD-3-Clause
// The stored states of a test as files that ParaView opens as series over the displacement.
//
//   OUT/balls.pvd, clumps.pvd, ...   one list for each kind of picture: which file belongs to which displacement in mm
//   OUT/states/balls_0000.vtp, ...   one file for each state and kind
//   OUT/view.py                      opens all of them in ParaView, with spheres and force chains
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dem {

struct VtkExportOptions {
  std::filesystem::path source;  ///< output folder, results.h5 or specimen.h5
  std::filesystem::path folder;  ///< OUT; empty: vtk/ beside the file
  std::vector<double> at;        ///< m, displacements of the states; empty: all of them
};

/// What was written.
struct VtkExport {
  std::filesystem::path source, folder;
  std::vector<double> displacements;  ///< m, of the states
  std::vector<std::string> series;    ///< "balls", ... ; kinds that the test does not have are left out
  std::uintmax_t bytes = 0;
};

/// Reads only the file of results, which a running test may go on writing. Every file is replaced as a whole, the lists
/// last. Throws MissingFileError when there is no such file or state, IoError when it is damaged or OUT cannot be
/// written.
VtkExport export_vtk(const VtkExportOptions& options);

}  // namespace dem
