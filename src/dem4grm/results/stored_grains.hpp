// SPDX-License-Identifier: BSD-3-Clause
// The grains of a stored state: what was written to specimen.h5 or results.h5, read back as geometry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/lab/case.hpp"
#include "dem4grm/micro/homogeneity.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/specimen/packing.hpp"

namespace dem {

struct StoredGrains {
  std::filesystem::path file;
  std::string state;          ///< name of the frame, "0000"
  double displacement = 0.0;  ///< m
  DirectShearCase test;       ///< that the state was made for
  Packing packing;
  std::vector<Vec3> normals;  ///< of contacts between different bodies
  double plate_height = 0.0;  ///< m, of the top plate
};

/// The first state of a file, or of a folder's specimen.h5, else its results.h5. Throws MissingFileError when there is
/// none, IoError when the file is damaged or of another kind, Error with ExitCode::usage when it is of another test.
StoredGrains read_stored_grains(const std::filesystem::path& path);

/// The grains of one state, a group of /frames. Throws IoError when they do not fit together.
Packing read_packing(const hdf5::Handle& frame);

/// How even a stored specimen is, as summary.json says it of a run. Only before shear: the box must be whole.
Homogeneity homogeneity_of(const StoredGrains& stored);

}  // namespace dem
