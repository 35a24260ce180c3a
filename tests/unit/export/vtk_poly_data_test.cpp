// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a .vtp file, taken apart by the rules of "VTK File Formats". That VTK itself reads whole files is tested in
// tests/export; here are the cases that a small specimen does not meet.
#include "dem4grm/export/vtk_poly_data.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// The array of this name with its blocks decompressed.
std::vector<char> bytes_in(const std::string& file, const std::string& name) {
  const std::size_t element = file.find("Name=\"" + name + "\"");
  const std::size_t offset_at = file.find("offset=\"", element) + 8;
  const std::size_t offset = std::stoul(file.substr(offset_at));
  std::size_t at = file.find('_', file.find("<AppendedData encoding=\"raw\">")) + 1 + offset;
  const auto take = [&] {
    std::uint64_t number = 0;
    std::memcpy(&number, file.data() + at, sizeof number);
    at += sizeof number;
    return number;
  };
  const std::uint64_t blocks = take(), block_size = take(), last_size = take();
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& size : packed) size = take();
  std::vector<char> out;
  for (std::size_t b = 0; b < blocks; ++b) {
    uLongf size = b + 1 == blocks && last_size > 0 ? last_size : block_size;
    std::vector<char> block(size);
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                         reinterpret_cast<const Bytef*>(file.data() + at), packed[b]),
              Z_OK);
    EXPECT_EQ(size, block.size()) << "block " << b << " of " << name;
    out.insert(out.end(), block.begin(), block.end());
    at += packed[b];
  }
  return out;
}

template <class Number>
std::vector<Number> numbers_in(const std::string& file, const std::string& name) {
  const std::vector<char> bytes = bytes_in(file, name);
  std::vector<Number> out(bytes.size() / sizeof(Number));
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

VtkPolyData points_on_a_line(int n) {
  VtkPolyData data;
  for (int k = 0; k < n; ++k) data.add_cell({data.add_point({1e-3 * k, 0.0, -2e-3})});
  return data;
}

TEST(VtkPolyData, LongArraysComeBackBlockByBlock) {
  for (const int n : {1, 4095, 4096, 4097, 20000}) {  // 4096 numbers of 4 bytes fill a block
    VtkPolyData data = points_on_a_line(n);
    VtkArray::Wholes ids(static_cast<std::size_t>(n));
    std::iota(ids.begin(), ids.end(), 7);
    data.point_data.push_back({"id", ids});
    const std::string file = vtp_text(data);
    EXPECT_EQ(numbers_in<std::int32_t>(file, "id"), ids);
    EXPECT_EQ(numbers_in<float>(file, "Points"), data.points);
    EXPECT_EQ(numbers_in<std::int32_t>(file, "offsets").back(), n);
  }
  const VtkPolyData data = points_on_a_line(3);
  EXPECT_EQ(data.points[3], 1.0F) << "coordinates are in mm";
  EXPECT_EQ(data.points[5], -2.0F);
}

TEST(VtkPolyData, NothingIsAFileToo) {
  VtkPolyData data;
  data.kind = VtkCells::lines;
  data.cell_data.push_back({"force", VtkArray::Reals{}});
  const std::string file = vtp_text(data);
  EXPECT_NE(file.find("NumberOfPoints=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\""), std::string::npos);
  EXPECT_TRUE(bytes_in(file, "force").empty());
  EXPECT_TRUE(file.ends_with("</VTKFile>\n"));
}

TEST(VtkPolyData, TextsAndVectorsHaveTheirForms) {
  VtkPolyData data = points_on_a_line(2);
  data.point_data.push_back({"name", VtkArray::Texts{"top plate", ""}});
  data.point_data.push_back({"force_N", VtkArray::Reals{1, 2, 3, 4, 5, 6}, 3});
  data.field_data.push_back({"state", VtkArray::Texts{"0003"}});
  const std::string file = vtp_text(data);
  EXPECT_EQ(numbers_in<char>(file, "name"),
            std::vector<char>({'t', 'o', 'p', ' ', 'p', 'l', 'a', 't', 'e', '\0', '\0'}));
  EXPECT_NE(file.find("<Array type=\"String\" Name=\"name\" format"), std::string::npos);
  EXPECT_NE(file.find("<DataArray type=\"Float32\" Name=\"force_N\" NumberOfComponents=\"3\" format"),
            std::string::npos);
  EXPECT_NE(file.find("Name=\"state\" NumberOfTuples=\"1\""), std::string::npos);
  EXPECT_EQ(file, vtp_text(data));
}

TEST(VtkPolyData, AnArrayThatDoesNotFitIsABug) {
  VtkPolyData data = points_on_a_line(2);
  data.cell_data.push_back({"force_N", VtkArray::Reals{1, 2, 3}});
  EXPECT_THROW(vtp_text(data), InternalError);
}

}  // namespace
}  // namespace dem
