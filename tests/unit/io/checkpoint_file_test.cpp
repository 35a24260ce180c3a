// SPDX-License-Identifier: BSD-3-Clause
// checkpoint.h5: what is written is read again to the last bit; a file that is damaged or foreign is refused by name.
#include "dem4grm/io/checkpoint_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/version.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

class CheckpointFile : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "checkpoint.h5";

  static StateArchive some_state() {
    StateArchive a;
    double x = 0.1, big = std::numeric_limits<double>::max(), minus_zero = -0.0;
    std::int64_t n = -(std::int64_t{1} << 62);
    bool flag = true;
    std::string text = "limited by: grain";
    Vec3 v{1e-300, -2.5, 3.0};
    Quaternion q{0.5, -0.5, 0.5, -0.5};
    std::vector<double> none, list{1.0 / 3.0, -7.0};
    std::vector<std::uint64_t> keys{0, (std::uint64_t{5} << 32U) | 7U};
    AlignedArray<double> aligned(3);
    aligned[1] = 4.25;
    a.group("outer", [&] {
      a.exchange("x", x);
      a.exchange("big", big);
      a.exchange("minus_zero", minus_zero);
      a.group("inner", [&] { a.exchange("n", n); });
      a.exchange("flag", flag);
      a.exchange("text", text);
    });
    a.exchange("v", v);
    a.exchange("q", q);
    a.exchange("none", none);
    a.exchange("list", list);
    a.exchange("keys", keys);
    a.exchange("aligned", aligned);
    return a;
  }
};

TEST_F(CheckpointFile, ReadsWhatWasWritten) {
  write_checkpoint(path_, some_state(), {"name = \"a\"\n", 12.5, {}});
  StoredCheckpoint stored = read_checkpoint(path_);
  EXPECT_EQ(stored.facts.resolved_toml, "name = \"a\"\n");
  EXPECT_EQ(stored.facts.wall_time, 12.5);
  EXPECT_EQ(stored.facts.commit, k_commit);
  StateArchive& a = stored.state;
  double x = 0, big = 0, minus_zero = 1;
  std::int64_t n = 0;
  bool flag = false;
  std::string text;
  Vec3 v;
  Quaternion q;
  std::vector<double> none{1.0}, list;
  std::vector<std::uint64_t> keys;
  AlignedArray<double> aligned;
  ASSERT_TRUE(a.has_group("outer"));
  EXPECT_FALSE(a.has_group("out"));
  a.exchange("list", list);  // in any order
  a.group("outer", [&] {
    a.exchange("x", x);
    a.exchange("big", big);
    a.exchange("minus_zero", minus_zero);
    a.group("inner", [&] { a.exchange("n", n); });
    a.exchange("flag", flag);
    a.exchange("text", text);
  });
  a.exchange("v", v);
  a.exchange("q", q);
  a.exchange("none", none);
  a.exchange("keys", keys);
  a.exchange("aligned", aligned);
  EXPECT_EQ(x, 0.1);
  EXPECT_EQ(big, std::numeric_limits<double>::max());
  EXPECT_TRUE(minus_zero == 0.0 && std::signbit(minus_zero));
  EXPECT_EQ(n, -(std::int64_t{1} << 62));
  EXPECT_TRUE(flag);
  EXPECT_EQ(text, "limited by: grain");
  EXPECT_EQ(v.x, 1e-300);
  EXPECT_EQ(v.y, -2.5);
  EXPECT_EQ(q.z, -0.5);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(list, (std::vector<double>{1.0 / 3.0, -7.0}));
  EXPECT_EQ(keys, (std::vector<std::uint64_t>{0, (std::uint64_t{5} << 32U) | 7U}));
  ASSERT_EQ(aligned.size(), 3U);
  EXPECT_EQ(aligned[1], 4.25);
}

TEST_F(CheckpointFile, TypesAndLengthsAreHeld) {
  StateArchive a(some_state().entries());
  std::string wrong_type;
  EXPECT_THROW(a.exchange("v", wrong_type), IoError);
  double scalar = 0.0;
  EXPECT_THROW(a.exchange("list", scalar), IoError);
  EXPECT_THROW(a.exchange("not there", scalar), IoError);
}

TEST_F(CheckpointFile, NewOneReplacesTheOldAsAWhole) {
  write_checkpoint(path_, some_state(), {"old", 1.0, {}});
  write_checkpoint(path_, some_state(), {"new", 2.0, {}});
  EXPECT_EQ(read_checkpoint(path_).facts.resolved_toml, "new");
  EXPECT_FALSE(std::filesystem::exists(path_.string() + ".tmp"));
}

TEST_F(CheckpointFile, OldOneStaysWhenTheNewOneCannotBeWritten) {
  write_checkpoint(path_, some_state(), {"old", 1.0, {}});
  std::filesystem::create_directory(path_.string() + ".tmp");
  EXPECT_THROW(write_checkpoint(path_, some_state(), {"new", 2.0, {}}), IoError);
  EXPECT_EQ(read_checkpoint(path_).facts.resolved_toml, "old");
}

TEST_F(CheckpointFile, DamageIsNamedWithTheFile) {
  write_checkpoint(path_, some_state(), {"case", 1.0, {}});
  const auto size = std::filesystem::file_size(path_);
  for (const auto part : {std::uintmax_t{0}, size / 3, size - 1}) {
    std::filesystem::copy_file(path_, folder_.path() / "part.h5", std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder_.path() / "part.h5", part);
    try {
      read_checkpoint(folder_.path() / "part.h5");
      FAIL() << "read " << part << " of " << size << " bytes";
    } catch (const IoError& e) {
      EXPECT_NE(std::string(e.what()).find("part.h5"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("remove the file"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace dem
