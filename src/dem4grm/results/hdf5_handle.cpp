// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/hdf5_handle.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem::hdf5 {
namespace {

constexpr hsize_t k_chunk_rows = 16384;
constexpr unsigned k_compression = 4;  // of 9; higher levels cost much time for few bytes

/// The innermost reason that the library knows; of failed writes what the system said.
herr_t take_reason(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc == nullptr) return 0;
  std::string reason = error->desc;
  constexpr std::string_view k_mark = "error message = '";
  const std::size_t begin = reason.find(k_mark);
  if (begin != std::string::npos) {
    reason = reason.substr(begin + k_mark.size());
    reason = reason.substr(0, reason.find('\''));
  }
  *static_cast<std::string*>(text) = reason;
  return 1;
}

[[noreturn]] void throw_error(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_reason, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw IoError(reason.empty() ? what : fmt::format("{}: {}", what, reason));
}

void check(herr_t status, const std::string& what) {
  if (status < 0) throw_error(what);
}

/// Once, before the first call: the library must print nothing, and must not try for ever to write files at the end of
/// the program when the disk is full.
void prepare_library() {
  static const bool is_ready = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(is_ready);
}

Handle file_properties() {
  Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "HDF5 file access");
  check(H5Pset_libver_bounds(list.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), "HDF5 format bounds");
  // The folder has its own lock; locks of HDF5 fail on many network file systems.
  check(H5Pset_file_locking(list.id(), 0, 1), "HDF5 file locking");
  return list;
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "HDF5 text type");
  check(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), "HDF5 text type");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "HDF5 text type");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "HDF5 text type");
  return type;
}

void write_attribute(const Handle& object, const std::string& name, hid_t file_type, hid_t memory_type,
                     const void* value) {
  const std::string what = fmt::format("attribute {} cannot be written", name);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute(H5Acreate2(object.id(), name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, what);
  check(H5Awrite(attribute.id(), memory_type, value), what);
}

Handle dataset_properties(const std::vector<hsize_t>& shape, std::size_t bytes, const std::string& what) {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  check(H5Pset_obj_track_times(list.id(), false), what);
  if (bytes == 0) return list;
  std::vector<hsize_t> chunk = shape;
  chunk[0] = std::min(chunk[0], k_chunk_rows);
  check(H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data()), what);
  if (bytes >= 256) {  // small data gain nothing from compression
    check(H5Pset_shuffle(list.id()), what);
    check(H5Pset_deflate(list.id(), k_compression), what);
  }
  check(H5Pset_fletcher32(list.id()), what);  // of what stands in the file
  return list;
}

void write_dataset(const Handle& parent, const Label& label, const std::vector<hsize_t>& shape, std::size_t bytes,
                   hid_t file_type, hid_t memory_type, const void* values) {
  const std::string what = fmt::format("dataset {} cannot be written", label.name);
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, what);
  const Handle list = dataset_properties(shape, bytes, what);
  Handle dataset(
      H5Dcreate2(parent.id(), label.name.c_str(), file_type, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Dclose,
      what);
  if (bytes > 0) check(H5Dwrite(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what);
  write_attribute(dataset, "unit", label.unit);
  write_attribute(dataset, "description", label.description);
  dataset.close(what);
}

template <class Value>
void write_values(const Handle& parent, const Label& label, std::span<const Value> values, std::size_t columns,
                  hid_t file_type, hid_t memory_type) {
  std::vector<hsize_t> shape{values.size() / columns};
  if (columns > 1) shape.push_back(columns);
  write_dataset(parent, label, shape, values.size_bytes(), file_type, memory_type, values.data());
}

}  // namespace

Handle::Handle(hid_t id, Close close_function, const std::string& what) : id_(id), close_(close_function) {
  if (id < 0) throw_error(what);
}

Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

void Handle::close(const std::string& what) {
  if (id_ >= 0) check(close_(std::exchange(id_, -1)), what);
}

Handle create_file(const std::filesystem::path& path, std::size_t free_bytes) {
  prepare_library();
  const Handle list = file_properties();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "HDF5 properties cannot be made");
  check(H5Pset_userblock(creation.id(), free_bytes), "HDF5 user block");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), list.id()), H5Fclose,
          fmt::format("{}: cannot be written", path.string())};
}

Handle open_file(const std::filesystem::path& path, Access access) {
  prepare_library();
  const Handle list = file_properties();
  return {H5Fopen(path.c_str(), access == Access::write ? H5F_ACC_RDWR : H5F_ACC_RDONLY, list.id()), H5Fclose,
          fmt::format("{}: cannot be opened as HDF5", path.string())};
}

Handle create_group(const Handle& parent, const std::string& name) {
  const std::string what = fmt::format("group {} cannot be written", name);
  const Handle list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, what);
  check(H5Pset_obj_track_times(list.id(), false), what);
  return {H5Gcreate2(parent.id(), name.c_str(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Gclose, what};
}

Handle open_group(const Handle& parent, const std::string& name) {
  return {H5Gopen2(parent.id(), name.c_str(), H5P_DEFAULT), H5Gclose, fmt::format("group {} is not there", name)};
}

std::vector<std::string> names_in(const Handle& group) {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names), "a group cannot be read");
  std::sort(names.begin(), names.end());
  return names;
}

void write_attribute(const Handle& object, const std::string& name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(const Handle& object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void write_attribute(const Handle& object, const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size());
  write_attribute(object, name, type.id(), type.id(), value.data());
}

double read_number_attribute(const Handle& object, const std::string& name) {
  const std::string what = fmt::format("attribute {} cannot be read", name);
  const Handle attribute(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, what);
  double value = 0.0;
  check(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), what);
  return value;
}

std::string read_text_attribute(const Handle& object, const std::string& name) {
  const std::string what = fmt::format("attribute {} cannot be read", name);
  const Handle attribute(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, what);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose, what);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0) throw IoError(what);
  std::string value(H5Tget_size(type.id()), '\0');
  check(H5Aread(attribute.id(), type.id(), value.data()), what);
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

void write_dataset(const Handle& parent, const Label& label, std::span<const double> values, std::size_t columns) {
  write_values(parent, label, values, columns, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
}

void write_dataset(const Handle& parent, const Label& label, std::span<const std::int32_t> values,
                   std::size_t columns) {
  write_values(parent, label, values, columns, H5T_STD_I32LE, H5T_NATIVE_INT32);
}

void write_dataset(const Handle& parent, const Label& label, std::span<const std::int64_t> values,
                   std::size_t columns) {
  write_values(parent, label, values, columns, H5T_STD_I64LE, H5T_NATIVE_INT64);
}

void write_dataset(const Handle& parent, const Label& label, std::span<const std::uint8_t> values,
                   std::size_t columns) {
  write_values(parent, label, values, columns, H5T_STD_U8LE, H5T_NATIVE_UINT8);
}

void write_dataset(const Handle& parent, const Label& label, std::span<const std::string> values) {
  std::size_t longest = 1;
  for (const std::string& value : values) longest = std::max(longest, value.size());
  std::string bytes;
  for (std::string value : values) {
    value.resize(longest, '\0');
    bytes += value;
  }
  const Handle type = text_type(longest);
  write_dataset(parent, label, {values.size()}, bytes.size(), type.id(), type.id(), bytes.data());
}

std::vector<std::size_t> dataset_shape(const Handle& parent, const std::string& name) {
  const std::string what = fmt::format("dataset {} cannot be read", name);
  const Handle dataset(H5Dopen2(parent.id(), name.c_str(), H5P_DEFAULT), H5Dclose, what);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, what);
  std::array<hsize_t, H5S_MAX_RANK> lengths{};
  const int rank = H5Sget_simple_extent_dims(space.id(), lengths.data(), nullptr);
  if (rank < 0) throw_error(what);
  return {lengths.begin(), lengths.begin() + rank};
}

namespace {

Handle open_dataset(const Handle& parent, const std::string& name) {
  return {H5Dopen2(parent.id(), name.c_str(), H5P_DEFAULT), H5Dclose, fmt::format("dataset {} cannot be read", name)};
}

/// Bytes that a dataset takes in its file, as the file says; not more than the file has.
double stored_bytes(const Handle& dataset) {
  const Handle file(H5Iget_file_id(dataset.id()), H5Fclose, "the file of a dataset");
  hsize_t all = 0;
  check(H5Fget_filesize(file.id(), &all), "the length of the file");
  return static_cast<double>(std::min(H5Dget_storage_size(dataset.id()), all));
}

/// Number of values of a dataset. Throws IoError when a damaged shape asks for more than the bytes in the file can hold,
/// before memory is taken for it; deflate shrinks data to a 1032nd at most.
std::size_t count_of(const Handle& dataset, const Handle& parent, const std::string& name, std::size_t value_bytes) {
  constexpr double k_most_over_stored = 1100.0;
  double most = 4096.0 + k_most_over_stored * stored_bytes(dataset);
  std::size_t count = 1;
  for (const std::size_t length : dataset_shape(parent, name)) {
    most /= std::max(1.0, static_cast<double>(length));
    count *= length;
  }
  if (most < static_cast<double>(value_bytes)) {
    throw IoError(fmt::format("dataset {} cannot be read: its shape is larger than its content", name));
  }
  return count;
}

template <class Value>
std::vector<Value> read_values(const Handle& parent, const std::string& name, hid_t memory_type) {
  const Handle dataset = open_dataset(parent, name);
  std::vector<Value> values(count_of(dataset, parent, name, 1));
  if (!values.empty()) {
    check(H5Dread(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          fmt::format("dataset {} cannot be read", name));
  }
  return values;
}

}  // namespace

std::vector<double> read_dataset(const Handle& parent, const std::string& name) {
  return read_values<double>(parent, name, H5T_NATIVE_DOUBLE);
}

std::vector<Vec3> read_vectors(const Handle& parent, const std::string& name) {
  const std::vector<double> values = read_dataset(parent, name);
  std::vector<Vec3> rows(values.size() / 3);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
  return rows;
}

std::vector<std::int64_t> read_whole_numbers(const Handle& parent, const std::string& name) {
  return read_values<std::int64_t>(parent, name, H5T_NATIVE_INT64);
}

std::vector<std::uint8_t> read_bytes(const Handle& parent, const std::string& name) {
  return read_values<std::uint8_t>(parent, name, H5T_NATIVE_UINT8);
}

std::vector<std::string> read_texts(const Handle& parent, const std::string& name) {
  const std::string what = fmt::format("dataset {} cannot be read", name);
  const Handle dataset = open_dataset(parent, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, what);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0) throw IoError(what);
  const std::vector<std::size_t> shape = dataset_shape(parent, name);
  if (shape.size() != 1) throw IoError(what);
  const std::size_t width = H5Tget_size(type.id());
  std::string rows(count_of(dataset, parent, name, width) * width, '\0');
  if (!rows.empty()) check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), what);
  std::vector<std::string> texts;
  for (std::size_t row = 0; row < shape[0]; ++row) {
    std::string text = rows.substr(row * width, width);
    text.resize(std::min(text.size(), text.find('\0')));
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string read_text(const Handle& parent, const std::string& name) {
  std::vector<std::string> texts = read_texts(parent, name);
  if (texts.size() != 1) throw IoError(fmt::format("dataset {} cannot be read", name));
  return std::move(texts.front());
}

DatasetKind dataset_kind(const Handle& parent, const std::string& name) {
  const std::string what = fmt::format("dataset {} cannot be read", name);
  const Handle dataset = open_dataset(parent, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, what);
  const H5T_class_t kind = H5Tget_class(type.id());
  const std::size_t bytes = H5Tget_size(type.id());
  if (kind == H5T_FLOAT && bytes == sizeof(double)) return DatasetKind::real;
  if (kind == H5T_INTEGER && bytes == 1) return DatasetKind::byte;
  if (kind == H5T_INTEGER && bytes == sizeof(std::int64_t)) return DatasetKind::whole;
  throw IoError(what + ": it holds another kind of values");
}

bool is_group(const Handle& parent, const std::string& name) {
  const Handle object(H5Oopen(parent.id(), name.c_str(), H5P_DEFAULT), H5Oclose,
                      fmt::format("{} cannot be opened", name));
  return H5Iget_type(object.id()) == H5I_GROUP;
}

bool read_through(const Handle& parent, const std::string& name) {
  const std::string what = fmt::format("dataset {} cannot be read", name);
  const Handle dataset = open_dataset(parent, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, what);
  const std::size_t width = H5Tget_size(type.id()), values = count_of(dataset, parent, name, width);
  if (values == 0) return true;
  std::vector<char> bytes(values * width);
  check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), what);
  const Handle list(H5Dget_create_plist(dataset.id()), H5Pclose, what);
  for (int k = 0; k < H5Pget_nfilters(list.id()); ++k) {
    unsigned flags = 0, config = 0;
    std::size_t parameters = 0;
    if (H5Pget_filter2(list.id(), static_cast<unsigned>(k), &flags, &parameters, nullptr, 0, nullptr, &config) ==
        H5Z_FILTER_FLETCHER32) {
      return true;
    }
  }
  return false;
}

void copy_group(const Handle& from, const std::string& name, const Handle& to) {
  check(H5Ocopy(from.id(), name.c_str(), to.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        fmt::format("group {} cannot be copied", name));
}

}  // namespace dem::hdf5
