// SPDX-License-Identifier: BSD-3-Clause
// Threads that a user binds to processors: the program starts itself once more before it computes, and must find all
// of them again.
#include <gtest/gtest.h>

#include <sched.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;

/// Sets or removes a variable of the environment for the length of a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    had_ = before != nullptr;
    if (had_) before_ = before;
    set(value);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { set(had_ ? before_.c_str() : nullptr); }

 private:
  void set(const char* value) {
    if (value == nullptr) {
      ::unsetenv(name_.c_str());
    } else {
      ::setenv(name_.c_str(), value, 1);
    }
  }
  std::string name_, before_;
  bool had_ = false;
};

int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

TEST_F(CommandLine, BoundThreadsHaveAProcessorEach) {
  const Variable policy("OMP_WAIT_POLICY", nullptr), spin("GOMP_SPINCOUNT", nullptr);
  const Variable bind("OMP_PROC_BIND", "true"), show("OMP_DISPLAY_AFFINITY", "true"),
      format("OMP_AFFINITY_FORMAT", "thread %n of %N on %A");
  const ProgramResult result = run({"run", "tiny.toml", "-q", "-j", "2", "-o", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> processors[2];
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("thread 0 of 2 on ")) processors[0].insert(line.substr(17));
    if (line.starts_with("thread 1 of 2 on ")) processors[1].insert(line.substr(17));
  }
  ASSERT_EQ(processors[0].size(), 1U) << result.err;
  ASSERT_EQ(processors[1].size(), 1U) << result.err;
  // Where there is only one processor, they share it.
  EXPECT_EQ(processors[0] != processors[1], usable_processors() > 1);
}

}  // namespace
}  // namespace dem
