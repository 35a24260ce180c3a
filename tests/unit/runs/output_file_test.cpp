// SPDX-License-Identifier: BSD-3-Clause
// Files that are replaced as a whole: rights, links in the way, and a last word on a full disk.
#include "dem4grm/results/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/run_program.hpp"

namespace dem {
namespace {

using test::read_all;
using test::TemporaryFolder;
using test::write_all;

TEST(OutputFile, HasTheRightsThatTheUmaskLeaves) {
  const TemporaryFolder folder;
  for (const mode_t mask : {0002, 0077}) {
    const mode_t before = ::umask(mask);
    replace_file(folder / "status.json", "{}");
    ::umask(before);
    struct stat facts {};
    ASSERT_EQ(::stat((folder / "status.json").c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777U, 0666U & ~mask);
  }
}

TEST(OutputFile, LinkInThePlaceOfADraftIsNotFollowed) {
  const TemporaryFolder folder;
  write_all(folder / "precious", "mine");
  std::filesystem::create_symlink(folder / "precious", folder / "status.json.tmp");
  replace_file(folder / "status.json", "{}");
  EXPECT_EQ(read_all(folder / "precious"), "mine");
  EXPECT_EQ(read_all(folder / "status.json"), "{}");
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(folder / "status.json.tmp")));
}

TEST(OutputFile, OverwritingKeepsTheLengthAndFollowsNoLink) {
  const TemporaryFolder folder;
  write_all(folder / "status.json", "{\"state\": \"running\"}");
  EXPECT_TRUE(overwrite_file(folder / "status.json", "{\"state\": \"f\"}"));
  EXPECT_EQ(read_all(folder / "status.json"), "{\"state\": \"f\"}      ");
  EXPECT_TRUE(overwrite_file(folder / "status.json", "{\"state\": \"longer than before\"}"));
  EXPECT_EQ(read_all(folder / "status.json"), "{\"state\": \"longer than before\"}");
  EXPECT_FALSE(overwrite_file(folder / "missing", "x"));
  write_all(folder / "precious", "mine");
  std::filesystem::create_symlink(folder / "precious", folder / "link");
  EXPECT_FALSE(overwrite_file(folder / "link", "x"));
  EXPECT_EQ(read_all(folder / "precious"), "mine");
}

}  // namespace
}  // namespace dem
