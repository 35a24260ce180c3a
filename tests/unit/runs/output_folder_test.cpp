// SPDX-License-Identifier: BSD-3-Clause
// The output folder: who may use it, what it holds, and files that are replaced as a whole.
#include "dem4grm/runs/output_folder.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <chrono>

#include <fmt/format.h>

#include "dem4grm/results/output_file.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using test::read_all;
using test::TemporaryFolder;
using test::write_all;

LoadedCase some_case(const std::string& name = "some") {
  LoadedCase loaded;
  GrainCompressionCase test;
  test.name = name;
  loaded.test = test;
  loaded.source_text = "# " + name + "\n";
  loaded.resolved_toml = "name = " + name + "\n";
  return loaded;
}

template <class Action>
std::string message_of(ExitCode code, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// A process number that no process has: of a child that has ended and was waited for.
pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(FolderLock, SecondOwnerIsRefusedWithHostAndProcess) {
  const TemporaryFolder folder;
  const FolderLock first(folder.path());
  const std::string message = message_of(ExitCode::folder_in_use, [&] { FolderLock second(folder.path()); });
  EXPECT_NE(message.find(fmt::format("process {} on host {}", ::getpid(), host_name())), std::string::npos) << message;
  EXPECT_NE(message.find(folder.path().string()), std::string::npos);
  EXPECT_TRUE(first.note().empty());
}

TEST(FolderLock, IsRemovedAtTheEnd) {
  const TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  EXPECT_FALSE(std::filesystem::exists(folder / FolderLock::k_name));
  const FolderLock again(folder.path());
  EXPECT_TRUE(again.note().empty());
}

TEST(FolderLock, OfADeadProcessIsTakenOver) {
  const TemporaryFolder folder;
  const pid_t dead = dead_process();
  write_all(folder / FolderLock::k_name, fmt::format("host={}\npid={}\nstart=then\n", host_name(), dead));
  const FolderLock lock(folder.path());
  EXPECT_NE(lock.note().find(fmt::format("process {}", dead)), std::string::npos) << lock.note();
  EXPECT_NE(read_all(folder / FolderLock::k_name).find(fmt::format("pid={}\n", ::getpid())), std::string::npos);
}

TEST(FolderLock, OfAnotherHostIsKept) {
  const TemporaryFolder folder;
  write_all(folder / FolderLock::k_name, "host=far-away\npid=12\nstart=then\n");
  const std::string message = message_of(ExitCode::folder_in_use, [&] { FolderLock lock(folder.path()); });
  EXPECT_NE(message.find("process 12 on host far-away since then"), std::string::npos) << message;
  EXPECT_NE(message.find("remove"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / FolderLock::k_name));
}

TEST(FolderLock, OfTheSameBatchJobOnALostNodeIsTakenOverOnceItIsSilent) {
  const TemporaryFolder folder;
  write_all(folder / FolderLock::k_name, "host=far-away\npid=12\nstart=then\njob=slurm 77\n");
  write_all(folder / "status.json", "{}");
  const auto try_with = [&](const std::string& job) { const FolderLock lock(folder.path(), job); };
  EXPECT_THROW(try_with("slurm 77"), FolderInUseError) << "its status was written a moment ago";
  using namespace std::chrono_literals;
  std::filesystem::last_write_time(folder / "status.json", std::filesystem::file_time_type::clock::now() - 10min);
  EXPECT_THROW(try_with("slurm 78"), FolderInUseError);
  EXPECT_THROW(try_with(""), FolderInUseError);
  const FolderLock lock(folder.path(), "slurm 77");
  EXPECT_NE(lock.note().find("host far-away: batch job slurm 77"), std::string::npos) << lock.note();
  EXPECT_NE(read_all(folder / FolderLock::k_name).find("job=slurm 77\n"), std::string::npos);
}

TEST(FolderLock, UnwritableFolderIsAnIoErrorWithItsPath) {
  const std::string message = message_of(ExitCode::io, [] { FolderLock lock("/proc/self"); });
  EXPECT_NE(message.find("/proc/self/run.lock: cannot be written: "), std::string::npos) << message;
}

TEST(FolderLock, OnlyOneOfManyProcessesWins) {
  const TemporaryFolder folder;
  std::vector<pid_t> children;
  for (int k = 0; k < 12; ++k) {
    const pid_t child = ::fork();
    if (child != 0) {
      children.push_back(child);
      continue;
    }
    try {
      const FolderLock lock(folder.path());
      ::usleep(800'000);
      ::_exit(0);
    } catch (const FolderInUseError&) {
      ::_exit(1);
    } catch (...) {
      ::_exit(2);
    }
  }
  int winners = 0, refused = 0;
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    winners += WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 1 : 0;
    refused += WIFEXITED(status) && WEXITSTATUS(status) == 1 ? 1 : 0;
  }
  // _exit leaves the file of the winner; the lock of the operating system ends with the process.
  EXPECT_EQ(winners, 1);
  EXPECT_EQ(refused, 11);
}

TEST(OutputFolder, GoesThroughItsStates) {
  const TemporaryFolder parent;
  const std::filesystem::path path = parent / "a/b";
  const LoadedCase loaded = some_case();
  EXPECT_EQ(look_into(path, loaded), FolderContent::nothing);
  {
    const OutputFolder folder(path, loaded);
    EXPECT_EQ(folder.found(), FolderContent::nothing);
    EXPECT_EQ(read_all(path / "case.toml"), loaded.source_text);
    EXPECT_EQ(read_all(path / "resolved.toml"), loaded.resolved_toml);
    write_all(folder.file(file_name::k_shear), "half a line");
  }
  EXPECT_EQ(look_into(path, loaded), FolderContent::unfinished);
  {
    const OutputFolder folder(path, loaded);
    EXPECT_EQ(folder.found(), FolderContent::unfinished);
    EXPECT_FALSE(std::filesystem::exists(folder.file(file_name::k_shear))) << "rest of the unfinished run";
    write_all(folder.file(file_name::k_summary), "{}");
  }
  EXPECT_EQ(look_into(path, loaded), FolderContent::complete);
  EXPECT_EQ(look_into(path, some_case("other")), FolderContent::other_case);
  const std::string message = message_of(ExitCode::usage, [&] { OutputFolder folder(path, some_case("other")); });
  EXPECT_NE(message.find("another case"), std::string::npos);
  EXPECT_NE(message.find("-o"), std::string::npos);
  EXPECT_EQ(read_all(path / "summary.json"), "{}");
}

TEST(OutputFolder, DoesNotWriteOverFilesThatAreNotItsOwn) {
  const TemporaryFolder folder;
  const LoadedCase loaded = some_case();
  write_all(folder / "notes.txt", "mine");
  write_all(folder / "case.toml", loaded.source_text);
  EXPECT_EQ(look_into(folder.path(), loaded), FolderContent::nothing) << "the case itself may lie there";
  write_all(folder / "case.toml", "another text");
  EXPECT_EQ(look_into(folder.path(), loaded), FolderContent::other_case);
  std::filesystem::remove(folder / "case.toml");
  write_all(folder / "results.h5", "precious");
  EXPECT_EQ(look_into(folder.path(), loaded), FolderContent::other_case);
}

TEST(OutputFolder, FileInItsPlaceIsAnIoError) {
  const TemporaryFolder folder;
  write_all(folder / "file", "x");
  message_of(ExitCode::io, [&] { OutputFolder f(folder / "file", some_case()); });
  const std::string message = message_of(ExitCode::io, [&] { OutputFolder f(folder / "file/below", some_case()); });
  EXPECT_NE(message.find("file/below"), std::string::npos) << message;
  EXPECT_NE(message.find("Not a directory"), std::string::npos) << message;
}

TEST(OutputFolder, DefaultNameIsSafe) {
  EXPECT_EQ(default_folder("quick"), "runs/quick");
  EXPECT_EQ(default_folder("../../etc/a b"), "runs/_._.._etc_a_b");
  EXPECT_EQ(default_folder(""), "runs/case");
}

TEST(OutputFile, ReplacingLeavesNoDraft) {
  const TemporaryFolder folder;
  replace_file(folder / "a", "one");
  replace_file(folder / "a", "two");
  EXPECT_EQ(read_all(folder / "a"), "two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.tmp"));
}

TEST(OutputFile, CreatingNeverReplaces) {
  const TemporaryFolder folder;
  create_file(folder / "a", "one");
  const std::string message = message_of(ExitCode::usage, [&] { create_file(folder / "a", "two"); });
  EXPECT_NE(message.find("is there already"), std::string::npos);
  EXPECT_EQ(read_all(folder / "a"), "one");
}

TEST(OutputFile, FullDiskIsAnIoErrorWithTheReason) {
  AppendedFile file("/dev/full");
  const std::string message = message_of(ExitCode::io, [&] { file.append("a"); });
  EXPECT_EQ(message, "/dev/full: cannot be written: No space left on device");
}

}  // namespace
}  // namespace dem
