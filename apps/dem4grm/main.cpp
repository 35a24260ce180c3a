// SPDX-License-Identifier: BSD-3-Clause
// The command line: chooses the verb, turns every error into one message and an exit code.
#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/runs/test_writer.hpp"
#include "dem4grm/version.hpp"
#include "read_apart.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace {

using dem::ExitCode;

int number(ExitCode code) { return static_cast<int>(code); }

int fail(ExitCode code, const std::string& message) {
  dem::print_error(message);
  return number(code);
}

std::string version_text() {
  return fmt::format("dem4grm {}\ncommit   {}\ncompiler {}, {}\ntarget   {} (usable here: {})\n", dem::k_version,
                     dem::k_commit, dem::k_compiler, dem::k_build_type, dem::kernel_target(),
                     fmt::join(dem::usable_kernel_targets(), ", "));
}

/// What the verb asks for help or what was wrong with the words on the command line.
int answer_parser(CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    // --help and --version of the program or of a verb: CLI11 knows the text.
    app.exit(error, std::cout, std::cerr);
    return std::cout.flush() ? number(ExitCode::done) : number(ExitCode::io);
  }
  std::string verb;
  for (const CLI::App* chosen : app.get_subcommands()) verb = " " + chosen->get_name();
  return fail(ExitCode::usage, fmt::format("{}\nsee dem4grm{} --help", error.what(), verb));
}

/// A user may want other loops than the best ones: to compare, or because the best ones make a processor hot and slow.
void choose_target() {
  const char* target = std::getenv("DEM4GRM_TARGET");
  if (target == nullptr || *target == 0) return;
  try {
    dem::choose_kernel_target(target);
  } catch (const dem::InputError& error) {
    throw dem::Error(ExitCode::usage, fmt::format("DEM4GRM_TARGET: {}", error.what()));
  }
}

int run_program(int argc, char** argv) {
  choose_target();
  CLI::App app{"Gravel-rubber mixtures in a virtual direct shear box", "dem4grm"};
  app.set_version_flag("--version", version_text(), "version, commit and compiler");
  app.require_subcommand(1);
  app.get_formatter()->column_width(26);
  app.footer(
      "Example:\n"
      "  dem4grm run my.toml -o runs/my");
  dem::add_new(app);
  dem::add_check(app);
  dem::add_specimen(app);
  dem::add_run(app);
  dem::add_info(app);
  dem::add_sieve(app);
  dem::add_profile(app);
  dem::add_micro(app);
  dem::add_report(app);
  dem::add_watch(app);
  dem::add_export(app);
  dem::add_verify(app);
  dem::add_campaign(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer_parser(app, error);
  }
  if (!std::cout.flush()) return fail(ExitCode::io, "the standard output cannot be written");
  return number(ExitCode::done);
}

/// A user who binds threads to processors has the first one bound before main; started from there, the program would see
/// that one processor only. So it gives back all that the runtime knew.
void unbind_first_thread() {
  cpu_set_t all;
  CPU_ZERO(&all);
  for (int place = 0; place < omp_get_num_places(); ++place) {
    std::vector<int> processors(static_cast<std::size_t>(omp_get_place_num_procs(place)));
    omp_get_place_proc_ids(place, processors.data());
    for (const int k : processors) CPU_SET(k, &all);
  }
  if (CPU_COUNT(&all) > 0) sched_setaffinity(0, sizeof all, &all);
}

/// Waiting threads of the OpenMP runtime spin for milliseconds by default; on a machine with other work to do, a thread
/// that spins holds the core that the awaited one needs, and a run becomes many times slower. The runtime reads the
/// limit before main, so the program starts itself once more with one (docs/decisions/0008-waiting-threads.md). A user
/// who sets the wait policy or the limit is left alone.
void limit_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", "10000", 0) != 0) return;
  std::error_code failed;
  // The link itself would start the program too, but under the name "exe" in the list of processes.
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return;
  unbind_first_thread();
  execv(program.c_str(), argv);  // returns only when it failed, and then the run goes on as it is
}

}  // namespace

int main(int argc, char** argv) {
  limit_spinning(argv);
  try {
    return run_program(argc, argv);
  } catch (const dem::ReaderEnded& reader) {
    return reader.exit_code;
  } catch (const dem::StoppedOnRequest& stop) {
    dem::print_note(stop.what());
    return number(stop.code());
  } catch (const dem::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::memory, "out of memory; dem4grm check CASE shows what a case needs");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, fmt::format("internal error: {}; please report it", error.what()));
  } catch (...) {
    return fail(ExitCode::internal, "internal error of unknown kind; please report it");
  }
}
