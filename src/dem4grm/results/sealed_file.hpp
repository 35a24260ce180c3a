// SPDX-License-Identifier: BSD-3-Clause
// HDF5 files under a seal: one changed bit or missing byte anywhere is noticed before anything is read.
//
// The first 512 bytes, a user block that HDF5 leaves alone, hold three lines of text and zeros to their end:
//   dem4grm sealed file 1
//   length 5242880            of the whole file, bytes
//   xxh3-128 0123...          of everything behind the first 512 bytes
// Other programs open such a file as any other HDF5 file.
#pragma once

#include <cstddef>
#include <filesystem>

namespace dem {

/// Bytes that a file to be sealed leaves free at its beginning (hdf5::create_file).
inline constexpr std::size_t k_seal_bytes = 512;

/// Writes the seal of a file that is complete and closed. Throws IoError.
void seal_file(const std::filesystem::path& path);

/// Throws IoError that says what is wrong: cut, longer, changed, or no sealed file at all.
void check_seal(const std::filesystem::path& path);

/// False for an HDF5 file that begins with its own signature, as one without a seal does. Throws IoError when it cannot be read.
bool has_seal(const std::filesystem::path& path);

/// check_seal, but for a file without a seal, and for one that this process has found whole and nobody has changed since.
void check_seal_once(const std::filesystem::path& path);

}  // namespace dem
