// SPDX-License-Identifier: BSD-3-Clause
// Owners for the handles of the HDF5 C library, and the few calls that the program needs.
//
// Files have the earliest format (any reader of the last twenty years opens them), no times inside, data compressed
// with gzip and shuffle only: MATLAB and plain h5py read that without a plug-in. Equal content gives equal bytes.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dem4grm/core/vec3.hpp"

namespace dem::hdf5 {

/// Owns one handle. Every function below throws IoError with file or object name when the library fails.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  /// Throws IoError when id is negative; `what` names the attempt.
  Handle(hid_t id, Close close_function, const std::string& what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle();

  [[nodiscard]] hid_t id() const { return id_; }
  /// Closes now and throws IoError when that fails, as it does when the disk is full.
  void close(const std::string& what);

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

enum class Access { read, write };

/// A new, empty file; an old one of that name is replaced.
/// free_bytes at its beginning that HDF5 leaves alone: 0, or a power of 2 from 512 on.
Handle create_file(const std::filesystem::path& path, std::size_t free_bytes = 0);
Handle open_file(const std::filesystem::path& path, Access access);

Handle create_group(const Handle& parent, const std::string& name);
Handle open_group(const Handle& parent, const std::string& name);
/// Names of what a group holds, sorted.
std::vector<std::string> names_in(const Handle& group);

void write_attribute(const Handle& object, const std::string& name, double value);
void write_attribute(const Handle& object, const std::string& name, std::int64_t value);
void write_attribute(const Handle& object, const std::string& name, const std::string& value);
double read_number_attribute(const Handle& object, const std::string& name);
std::string read_text_attribute(const Handle& object, const std::string& name);

/// What every dataset says about itself.
struct Label {
  std::string name;
  std::string unit;  ///< "1" for plain numbers
  std::string description;
};

/// [n] when columns is 1, else [n / columns][columns].
void write_dataset(const Handle& parent, const Label& label, std::span<const double> values, std::size_t columns = 1);
void write_dataset(const Handle& parent, const Label& label, std::span<const std::int32_t> values,
                   std::size_t columns = 1);
void write_dataset(const Handle& parent, const Label& label, std::span<const std::int64_t> values,
                   std::size_t columns = 1);
void write_dataset(const Handle& parent, const Label& label, std::span<const std::uint8_t> values,
                   std::size_t columns = 1);
/// Text of any length, one for each row.
void write_dataset(const Handle& parent, const Label& label, std::span<const std::string> values);

/// Length of each dimension.
std::vector<std::size_t> dataset_shape(const Handle& parent, const std::string& name);
std::vector<double> read_dataset(const Handle& parent, const std::string& name);
/// Rows of three numbers, [n][3].
std::vector<Vec3> read_vectors(const Handle& parent, const std::string& name);
std::vector<std::int64_t> read_whole_numbers(const Handle& parent, const std::string& name);
std::vector<std::uint8_t> read_bytes(const Handle& parent, const std::string& name);
/// All rows of a dataset of texts.
std::vector<std::string> read_texts(const Handle& parent, const std::string& name);
/// The text in a dataset that has one row.
std::string read_text(const Handle& parent, const std::string& name);

/// What a dataset of numbers holds.
enum class DatasetKind { real, whole, byte };
DatasetKind dataset_kind(const Handle& parent, const std::string& name);

/// True for a group, false for a dataset.
bool is_group(const Handle& parent, const std::string& name);
/// Reads a dataset to its end, so that the library compares its checksums; true when it has any. Throws IoError when they do
/// not fit or a part cannot be read.
bool read_through(const Handle& parent, const std::string& name);

/// Copies a group with all that is in it to another file.
void copy_group(const Handle& from, const std::string& name, const Handle& to);

}  // namespace dem::hdf5
