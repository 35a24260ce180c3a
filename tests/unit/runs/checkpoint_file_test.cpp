// SPDX-License-Identifier: BSD-3-Clause
// checkpoint.h5: what is written is read again to the last bit; a file that is damaged or foreign is refused by name.
#include "dem4grm/runs/checkpoint_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/version.hpp"
#include "support/damages.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

/// A value of every kind that a state may hold.
struct Sample {
  double x = 0.1, big = std::numeric_limits<double>::max(), minus_zero = -0.0;
  std::int64_t n = -(std::int64_t{1} << 62);
  bool flag = true;
  std::string text = "limited by: grain";
  Vec3 v{1e-300, -2.5, 3.0};
  Quaternion q{0.5, -0.5, 0.5, -0.5};
  std::vector<double> none, list{1.0 / 3.0, -7.0};
  std::vector<std::uint64_t> keys{0, (std::uint64_t{5} << 32U) | 7U};
  AlignedArray<double> aligned{3};

  Sample() { aligned[1] = 4.25; }

  void exchange(StateArchive& archive) {
    archive.group("outer", [&] {
      archive.exchange("x", x);
      archive.exchange("big", big);
      archive.exchange("minus_zero", minus_zero);
      archive.group("inner", [&] { archive.exchange("n", n); });
      archive.exchange("flag", flag);
      archive.exchange("text", text);
    });
    archive.exchange("v", v);
    archive.exchange("q", q);
    archive.exchange("none", none);
    archive.exchange("list", list);
    archive.exchange("keys", keys);
    archive.exchange("aligned", aligned);
  }
};

/// Every value and every length other than in a new one.
Sample other_sample() {
  Sample s;
  s.x = s.big = 0.0;
  s.minus_zero = 1.0;
  s.n = 0;
  s.flag = false;
  s.text.clear();
  s.v = {};
  s.q = {};
  s.none = {1.0};
  s.list.clear();
  s.keys.clear();
  s.aligned.resize(0);
  return s;
}

class CheckpointFile : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "checkpoint.h5";

  static StateArchive some_state() {
    StateArchive archive;
    Sample().exchange(archive);
    return archive;
  }
};

TEST_F(CheckpointFile, ReadsWhatWasWritten) {
  write_checkpoint(path_, some_state(), {"name = \"a\"\n", 12.5, {}});
  StoredCheckpoint stored = read_checkpoint(path_);
  EXPECT_EQ(stored.facts.resolved_toml, "name = \"a\"\n");
  EXPECT_EQ(stored.facts.wall_time, 12.5);
  EXPECT_EQ(stored.facts.commit, k_commit);
  ASSERT_TRUE(stored.state.has_group("outer"));
  EXPECT_FALSE(stored.state.has_group("out"));
  std::vector<double> asked_first;
  stored.state.exchange("list", asked_first);  // in any order
  EXPECT_EQ(asked_first, (std::vector<double>{1.0 / 3.0, -7.0}));
  Sample got = other_sample();
  got.exchange(stored.state);
  EXPECT_EQ(got.x, 0.1);
  EXPECT_EQ(got.big, std::numeric_limits<double>::max());
  EXPECT_TRUE(got.minus_zero == 0.0 && std::signbit(got.minus_zero));
  EXPECT_EQ(got.n, -(std::int64_t{1} << 62));
  EXPECT_TRUE(got.flag);
  EXPECT_EQ(got.text, "limited by: grain");
  EXPECT_EQ(got.v.x, 1e-300);
  EXPECT_EQ(got.v.y, -2.5);
  EXPECT_EQ(got.q.z, -0.5);
  EXPECT_TRUE(got.none.empty());
  EXPECT_EQ(got.list, (std::vector<double>{1.0 / 3.0, -7.0}));
  EXPECT_EQ(got.keys, (std::vector<std::uint64_t>{0, (std::uint64_t{5} << 32U) | 7U}));
  ASSERT_EQ(got.aligned.size(), 3U);
  EXPECT_EQ(got.aligned[1], 4.25);
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
  std::filesystem::create_directories(path_.string() + ".tmp/in/the/way");
  EXPECT_THROW(write_checkpoint(path_, some_state(), {"new", 2.0, {}}), IoError);
  EXPECT_EQ(read_checkpoint(path_).facts.resolved_toml, "old");
}

TEST_F(CheckpointFile, NoFlippedBitAndNoCutPassesAndTheOneBeforeIsTaken) {
  const std::filesystem::path older = folder_.path() / "older.h5";
  for (const double number : {1.0, 2.0}) write_checkpoint(path_, some_state(), {"case", number, {}}, older);
  const std::string whole = test::read_all(path_);
  RandomSequence random(11, RandomStream::test, 0);
  const int flips = test::number_of_damages(500), cuts = flips / 10;
  for (int k = 0; k < flips + cuts; ++k) {
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(whole.size()));
    std::string damaged = whole;
    if (k < flips) {
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << (k % 8)));
    } else {
      damaged.resize(at);
    }
    test::write_all(path_, damaged);
    EXPECT_THROW(read_checkpoint(path_), IoError) << k << ' ' << at;
    const std::optional<NewestCheckpoint> newest = read_newest_checkpoint(path_, older);
    ASSERT_TRUE(newest && newest->stored.facts.wall_time == 1.0) << k << ' ' << at;
  }
}

TEST_F(CheckpointFile, NewestWholeOneIsTakenAndTheReasonTold) {
  const std::filesystem::path older = folder_.path() / "older.h5";
  EXPECT_FALSE(read_newest_checkpoint(path_, older).has_value());
  for (const double number : {1.0, 2.0, 3.0}) write_checkpoint(path_, some_state(), {"case", number, {}}, older);
  std::optional<NewestCheckpoint> newest = read_newest_checkpoint(path_, older);
  ASSERT_TRUE(newest.has_value());
  EXPECT_EQ(newest->stored.facts.wall_time, 3.0);
  EXPECT_EQ(newest->note, "");
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  newest = read_newest_checkpoint(path_, older);
  ASSERT_TRUE(newest.has_value());
  EXPECT_EQ(newest->stored.facts.wall_time, 2.0);
  EXPECT_NE(newest->note.find("checkpoint.h5: is damaged"), std::string::npos) << newest->note;
  EXPECT_NE(newest->note.find("goes on from the one before it"), std::string::npos) << newest->note;
  std::filesystem::remove(path_);  // as a power cut between the two renames leaves it
  EXPECT_EQ(read_newest_checkpoint(path_, older)->stored.facts.wall_time, 2.0);
  std::filesystem::resize_file(older, 100);
  try {
    read_newest_checkpoint(path_, older);
    FAIL() << "read a damaged one";
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("remove checkpoint.h5 and older.h5 to start the run anew"), std::string::npos)
        << e.what();
  }
}

TEST_F(CheckpointFile, EveryFlippedBitAndEveryMissingByteIsNoticed) {
  StateArchive small;
  double number = 1.0 / 3.0;
  small.exchange("number", number);
  write_checkpoint(path_, small, {"case", 1.0, {}});
  const std::string whole = test::read_all(path_);
  const std::filesystem::path other = folder_.path() / "other.h5";
  const auto is_refused = [&](const std::string& bytes) {
    test::write_all(other, bytes);
    try {
      read_checkpoint(other);
      return false;
    } catch (const IoError&) {
      return true;
    }
  };
  EXPECT_FALSE(is_refused(whole));
  // All of the seal, and every eleventh byte of the rest.
  for (std::size_t byte = 0; byte < whole.size(); byte += byte < 520 ? 1 : 11) {
    std::string changed = whole;
    changed[byte] = static_cast<char>(changed[byte] ^ (1 << (byte % 8)));
    ASSERT_TRUE(is_refused(changed)) << "bit " << byte % 8 << " of byte " << byte;
  }
  for (std::size_t length = 0; length < whole.size(); length += 31) ASSERT_TRUE(is_refused(whole.substr(0, length)));
  EXPECT_TRUE(is_refused(whole + '\0'));
  EXPECT_TRUE(is_refused(whole + whole));
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
    }
  }
}

}  // namespace
}  // namespace dem
