// SPDX-License-Identifier: BSD-3-Clause
// Entry of libFuzzer for everything that reads a file of a user. DEM4GRM_FUZZ_TARGET says which: case, study, grading, clumps,
// laboratory (a curve for the report), published (values for the report), checkpoint (behind its seal, which random bytes never have) or
// results. A reader may refuse by an Error of the library
// and nothing else; crashes, sanitizer reports, other exceptions and hangs are findings. tools/fuzz.py builds and runs it.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "dem4grm/campaign/study.hpp"
#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/clump_file.hpp"
#include "dem4grm/case_file/grading_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/report/laboratory_curve.hpp"
#include "dem4grm/report/published_values.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/results_check.hpp"
#include "dem4grm/results/sealed_file.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"

namespace {

using namespace dem;

/// A file in memory, with the shipped cases beside it.
std::filesystem::path file_of(std::string_view bytes) {
  static const std::filesystem::path folder = [] {
    std::string name = "/dev/shm/dem4grm-fuzz-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    const std::filesystem::path made = name, cases = std::filesystem::path(DEM_SOURCE_DIR) / "cases";
    for (const char* part : {"paper", "gradings", "clumps"}) std::filesystem::create_symlink(cases / part, made / part);
    std::filesystem::create_directory(made / "studies");
    return made;
  }();
  const std::filesystem::path path = folder / "studies" / "input";
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

void read_checkpoint_behind_seal(std::string_view bytes) {
  const std::filesystem::path path = file_of(bytes);
  seal_file(path);
  (void)read_checkpoint(path);
}

const std::map<std::string, std::function<void(std::string_view)>> k_targets{
    {"case", [](std::string_view bytes) { (void)parse_case(bytes, DEM_SOURCE_DIR "/cases/input.toml"); }},
    {"study", [](std::string_view bytes) { (void)load_study(file_of(bytes)); }},
    {"grading", [](std::string_view bytes) { (void)parse_grading(bytes, "input.csv"); }},
    {"clumps", [](std::string_view bytes) { (void)parse_clumps(bytes, "input.csv"); }},
    {"laboratory",
     [](std::string_view bytes) {
       (void)json_text(laboratory_as_json(parse_laboratory_curve(bytes, "input.csv"), "test"));
     }},
    {"published",
     [](std::string_view bytes) {
       (void)json_text(JsonObject{{"published", published_as_json(parse_published_values(bytes, "input.csv"))}});
     }},
    {"checkpoint", read_checkpoint_behind_seal},
    {"results", [](std::string_view bytes) { (void)verdict_of("input", check_results(file_of(bytes))); }}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name = std::getenv("DEM4GRM_FUZZ_TARGET");
  static const auto& target = k_targets.at(name != nullptr ? name : "case");
  try {
    target({reinterpret_cast<const char*>(data), size});
  } catch (const dem::Error& e) {
    if (e.code() == dem::ExitCode::internal || std::string_view(e.what()).empty()) std::abort();
  }
  return 0;
}
