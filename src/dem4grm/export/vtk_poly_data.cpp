// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/export/vtk_poly_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <new>
#include <span>
#include <string_view>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say that they are little-endian");

constexpr std::size_t k_block = std::size_t{1} << 14;  // bytes before compression; a multiple of every size of number
constexpr int k_level = 5;                             // of 9, as VTK itself takes; more costs time for few bytes
constexpr double k_millimetres = 1e3;

constexpr const char* type_of(float /*value*/) { return "Float32"; }
constexpr const char* type_of(std::int32_t /*value*/) { return "Int32"; }
constexpr const char* type_of(std::uint8_t /*value*/) { return "UInt8"; }
constexpr const char* type_of(const std::string& /*value*/) { return "String"; }

template <class Number>
std::string bytes_of(const std::vector<Number>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number)};
}

/// Texts stand one after the other, each with a zero behind it.
std::string bytes_of(const VtkArray::Texts& texts) {
  std::string bytes;
  for (const std::string& text : texts) bytes.append(text.c_str(), text.size() + 1);
  return bytes;
}

std::string compressed(std::string_view block) {
  uLongf size = compressBound(block.size());
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(block.data()), block.size(), k_level);
  if (status != Z_OK) throw std::bad_alloc();  // the room is large enough and the level legal: nothing else is left
  out.resize(size);
  return out;
}

void append_head(std::string& out, std::span<const std::uint64_t> numbers) {
  out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

/// The head (blocks, bytes of a block, bytes of the last one if it is shorter, compressed bytes of each), then the blocks.
std::string encoded(std::string_view bytes) {
  const std::size_t blocks = (bytes.size() + k_block - 1) / k_block;
  std::vector<std::uint64_t> head{blocks, k_block, bytes.size() % k_block};
  std::string body;
  for (std::size_t begin = 0; begin < bytes.size(); begin += k_block) {
    const std::string block = compressed(bytes.substr(begin, k_block));
    head.push_back(block.size());
    body += block;
  }
  std::string out;
  append_head(out, head);
  return out + body;
}

/// Collects the XML and what stands behind it.
class VtpWriter {
 public:
  /// In a field, whose length no one else knows, an array says its number of rows.
  void add(const VtkArray& array, bool is_field = false) {
    const char* type = std::visit(
        [](const auto& v) { return type_of(typename std::decay_t<decltype(v)>::value_type{}); }, array.values);
    const char* element = std::holds_alternative<VtkArray::Texts>(array.values) ? "Array" : "DataArray";
    xml_ += fmt::format("<{} type=\"{}\" Name=\"{}\"", element, type, array.name);
    if (array.components > 1) xml_ += fmt::format(" NumberOfComponents=\"{}\"", array.components);
    if (is_field) xml_ += fmt::format(" NumberOfTuples=\"{}\"", array.rows());
    xml_ += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", appended_.size());
    appended_ += encoded(std::visit([](const auto& values) { return bytes_of(values); }, array.values));
  }

  void add_all(const char* element, const std::vector<VtkArray>& arrays, std::size_t rows) {
    line(fmt::format("<{}>", element));
    for (const VtkArray& array : arrays) {
      require(array.rows() == rows, "an array of a VTK file has a row for each point or cell");
      add(array);
    }
    line(fmt::format("</{}>", element));
  }

  void line(std::string_view text) {
    xml_ += text;
    xml_ += '\n';
  }

  [[nodiscard]] std::string text() const {
    return xml_ + "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string xml_, appended_;
};

void add_cells(VtpWriter& file, const VtkPolyData& data) {
  constexpr std::array<std::string_view, 3> k_elements{"Verts", "Lines", "Polys"};
  const std::string_view element = k_elements[static_cast<std::size_t>(data.kind)];
  file.line(fmt::format("<{}>", element));
  file.add({"connectivity", data.connectivity});
  file.add({"offsets", data.offsets});
  file.line(fmt::format("</{}>", element));
}

}  // namespace

std::size_t VtkArray::rows() const {
  return std::visit([](const auto& v) { return v.size(); }, values) / components;
}

std::int32_t VtkPolyData::add_point(const Vec3& metres) {
  for (const double x : {metres.x, metres.y, metres.z}) points.push_back(static_cast<float>(x * k_millimetres));
  return static_cast<std::int32_t>(n_points() - 1);
}

void VtkPolyData::add_cell(std::initializer_list<std::int32_t> corners) {
  connectivity.insert(connectivity.end(), corners);
  offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
}

std::string vtp_text(const VtkPolyData& data) {
  const auto count = [&](VtkCells kind) { return data.kind == kind ? data.n_cells() : 0; };
  VtpWriter file;
  file.line("<?xml version=\"1.0\"?>");
  file.line(
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">");
  file.line("<PolyData>");
  file.line("<FieldData>");
  for (const VtkArray& array : data.field_data) file.add(array, true);
  file.line("</FieldData>");
  file.line(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"{}\">",
                  data.n_points(), count(VtkCells::vertices), count(VtkCells::lines), count(VtkCells::polygons)));
  file.add_all("PointData", data.point_data, data.n_points());
  file.add_all("CellData", data.cell_data, data.n_cells());
  file.line("<Points>");
  file.add({"Points", data.points, 3});
  file.line("</Points>");
  add_cells(file, data);
  file.line("</Piece>");
  file.line("</PolyData>");
  return file.text();
}

}  // namespace dem
