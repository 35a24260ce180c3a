// SPDX-License-Identifier: BSD-3-Clause
// A file of results with bits flipped anywhere: what is damaged is named, what is whole too.
#include "dem4grm/results/results_check.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/sealed_file.hpp"
#include "support/damages.hpp"
#include "support/mixture_scene.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

class ResultsIntegrity : public ::testing::Test {
 protected:
  ResultsIntegrity() {
    test::MixtureOptions few;
    few.cells = {3, 3, 2};
    const Simulation s = test::run_mixture(few, 300);
    ResultsFile file(path_, {"direct_shear", "small", "text", "toml"});
    for (const int number : {0, 1, 2}) file.add_frame(s, {number, 1e-3 * number, s.state_hash()});
    bytes_ = test::read_all(path_);
  }

  /// A copy as an older build wrote it.
  [[nodiscard]] std::filesystem::path without_seal() const {
    std::filesystem::path plain = folder_.path() / "plain.h5";
    const hdf5::Handle from = hdf5::open_file(path_, hdf5::Access::read);
    hdf5::Handle to = hdf5::create_file(plain);
    for (const char* group : {"meta", "frames"}) hdf5::copy_group(from, group, to);
    to.close("the file cannot be closed");
    return plain;
  }

  /// The numbers of state 1 as they stand in the file.
  [[nodiscard]] std::vector<double> numbers_of(const std::filesystem::path& path) const {
    const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
    const hdf5::Handle frame = hdf5::open_group(hdf5::open_group(file, "frames"), "0001");
    std::vector<double> all = hdf5::read_dataset(hdf5::open_group(frame, "balls"), "position");
    for (const double v : hdf5::read_dataset(hdf5::open_group(frame, "contacts"), "shear_force")) all.push_back(v);
    return all;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "results.h5";
  std::string bytes_;
};

constexpr int k_usual_damages = 300;

enum class Finding { in_a_named_dataset, elsewhere, none, crash };

/// What `info` and a reader make of a damaged file. In a process of its own: some damage makes libhdf5 1.10 crash, about one flipped bit in
/// thousands, and what it cannot open it does not always give back.
Finding finding_in(const std::filesystem::path& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    Finding found = Finding::none;
    try {
      (void)open_results(path);
      ::_exit(static_cast<int>(found));
    } catch (const IoError&) {
    }
    try {
      const ResultsCheck check = check_results(path);
      found = check.damaged.empty() ? Finding::elsewhere : Finding::in_a_named_dataset;
      verdict_of(path, check);
      found = Finding::none;
    } catch (const IoError&) {
      if (found == Finding::none) found = Finding::elsewhere;  // it cannot be opened
    }
    ::_exit(static_cast<int>(found));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Finding>(WEXITSTATUS(status)) : Finding::crash;
}

TEST_F(ResultsIntegrity, OfAFreshFileIsWhole) {
  const ResultsCheck check = check_results(path_);
  EXPECT_GT(check.datasets, 100);
  EXPECT_EQ(check.without_checksum, 0);
  EXPECT_TRUE(check.damaged.empty());
  EXPECT_EQ(check.whole_states, (std::vector<std::string>{"0000", "0001", "0002"}));
  EXPECT_EQ(check.seal, SealState::fits);
  EXPECT_NE(verdict_of(path_, check).find("whole: every byte fits the seal"), std::string::npos);
  EXPECT_THROW(check_results(folder_ / "absent.h5"), MissingFileError);
}

TEST_F(ResultsIntegrity, EveryFlippedBitIsFoundByInfoAndByReaders) {
  const std::filesystem::path other = folder_.path() / "other.h5";
  RandomSequence random(7, RandomStream::test, 0);
  const int damages = test::number_of_damages(k_usual_damages);
  std::map<Finding, int> findings;
  for (int k = 0; k < damages; ++k) {
    std::string changed = bytes_;
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(changed.size()));
    changed[at] = static_cast<char>(changed[at] ^ (1 << (k % 8)));
    test::write_all(other, changed);
    const Finding found = finding_in(other);
    ++findings[found];
    EXPECT_NE(found, Finding::none) << "bit " << k % 8 << " of byte " << at;
  }
  std::printf("%d flipped bits: %d found in a named dataset, %d elsewhere, %d crash libhdf5\n", damages,
              findings[Finding::in_a_named_dataset], findings[Finding::elsewhere], findings[Finding::crash]);
  EXPECT_GT(findings[Finding::in_a_named_dataset], damages / 8) << "half of so small a file is heads and free space";
  EXPECT_LE(findings[Finding::crash], 1 + damages / 1000);
}

TEST_F(ResultsIntegrity, AFlippedBitOfAnyByteOfTheSealIsFound) {
  const std::filesystem::path other = folder_.path() / "other.h5";
  for (std::size_t at = 0; at < k_seal_bytes; ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (at % 8)));
    test::write_all(other, changed);
    EXPECT_THROW(open_results(other), IoError) << "byte " << at;
  }
}

TEST_F(ResultsIntegrity, AnotherAttributeIsNamedAsDamageToADescription) {
  {
    hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::write);
    hdf5::write_attribute(hdf5::open_group(file, "meta"), "note", std::string("by hand"));
    file.close("the file cannot be closed");
  }
  EXPECT_THROW(open_results(path_), IoError);
  const ResultsCheck check = check_results(path_);
  EXPECT_TRUE(check.damaged.empty());
  EXPECT_EQ(check.seal, SealState::broken);
  try {
    verdict_of(path_, check);
    FAIL() << "called whole";
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("another program has written to the file"), std::string::npos) << e.what();
  }
}

TEST_F(ResultsIntegrity, AFileWithoutASealIsReadAndSaysSo) {
  const std::filesystem::path plain = without_seal();
  EXPECT_EQ(numbers_of(plain), numbers_of(path_));
  EXPECT_NO_THROW(open_results(plain));
  const ResultsCheck check = check_results(plain);
  EXPECT_EQ(check.seal, SealState::none);
  EXPECT_TRUE(check.damaged.empty());
  EXPECT_NE(verdict_of(plain, check).find("no seal"), std::string::npos);
}

TEST_F(ResultsIntegrity, AFileOfAnOlderBuildGetsASealWithItsNextState) {
  const std::filesystem::path plain = without_seal();
  const std::vector<double> before = numbers_of(plain);
  change_sealed_file(plain, [](const hdf5::Handle& file) { hdf5::create_group(file, "later"); });
  const ResultsCheck check = check_results(plain);
  EXPECT_EQ(check.seal, SealState::fits);
  EXPECT_EQ(check.whole_states, (std::vector<std::string>{"0000", "0001", "0002"}));
  EXPECT_EQ(numbers_of(plain), before);
  EXPECT_EQ(hdf5::names_in(open_results(plain)), (std::vector<std::string>{"frames", "later", "meta"}));
}

TEST_F(ResultsIntegrity, OldDamageIsNotHiddenUnderANewSeal) {
  std::string changed = bytes_;
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
  test::write_all(path_, changed);
  EXPECT_THROW(change_sealed_file(path_, [](const hdf5::Handle& file) { hdf5::create_group(file, "later"); }), IoError);
  EXPECT_EQ(test::read_all(path_), changed);
}

TEST_F(ResultsIntegrity, NoCutFileIsCalledWhole) {
  const std::filesystem::path other = folder_.path() / "other.h5";
  RandomSequence random(8, RandomStream::test, 0);
  for (int k = 0; k < test::number_of_damages(k_usual_damages) / 10; ++k) {
    test::write_all(other,
                    bytes_.substr(0, static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes_.size()))));
    EXPECT_THROW(verdict_of(other, check_results(other)), IoError) << std::filesystem::file_size(other);
  }
}

TEST_F(ResultsIntegrity, DamageOfOneStateLeavesTheOthersWhole) {
  // The middle of the stored chunk of one dataset of state 1.
  haddr_t place = 0;
  hsize_t size = 0;
  {
    const hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::read);
    const hdf5::Handle dataset(H5Dopen2(file.id(), "frames/0001/balls/position", H5P_DEFAULT), H5Dclose, "dataset");
    const hdf5::Handle space(H5Dget_space(dataset.id()), H5Sclose, "space");
    hsize_t offset[2] = {0, 0};
    unsigned mask = 0;
    ASSERT_GE(H5Dget_chunk_info(dataset.id(), space.id(), 0, offset, &mask, &place, &size), 0);
  }
  std::string changed = bytes_;
  changed[place + size / 2] = static_cast<char>(changed[place + size / 2] ^ 4);
  test::write_all(path_, changed);
  const ResultsCheck check = check_results(path_);
  EXPECT_EQ(check.damaged, (std::vector<std::string>{"frames/0001/balls/position"}));
  EXPECT_EQ(check.whole_states, (std::vector<std::string>{"0000", "0002"}));
  try {
    verdict_of(path_, check);
    FAIL() << "called whole";
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("is damaged: frames/0001/balls/position; whole states: 0000, 0002"),
              std::string::npos)
        << e.what();
  }
  EXPECT_THROW(numbers_of(path_), IoError) << "readers notice it too";
}

}  // namespace
}  // namespace dem
