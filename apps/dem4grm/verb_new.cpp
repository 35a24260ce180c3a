// SPDX-License-Identifier: BSD-3-Clause
// dem4grm new: a commented case file to begin with.
#include <memory>

#include <fmt/format.h>

#include "dem4grm/results/output_file.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct NewOptions {
  NewCase wanted;
  std::string path;
};

void write_new(const NewOptions& options) {
  const std::string text = new_case_text(options.wanted);
  if (options.path.empty()) {
    print_result(text);
    return;
  }
  create_file(options.path, text);
  print_note(fmt::format("{} is written; next: dem4grm check {}", options.path, options.path));
}

}  // namespace

void add_new(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("new", "writes a commented case file");
  const auto options = std::make_shared<NewOptions>();
  verb->add_option("TEST", options->wanted.test, "direct_shear or grain_compression")->required();
  verb->add_option("--vrc", options->wanted.rubber_content_percent, "rubber content by solid volume, default 25")
      ->type_name("PERCENT");
  verb->add_option("--stress", options->wanted.normal_stress, "normal stress with its unit, default 60kPa")
      ->type_name("STRESS");
  verb->add_option("-o,--output", options->path, "file to write, which must not exist; default: stdout")
      ->type_name("FILE");
  verb->footer("Example:\n  dem4grm new direct_shear --vrc 25 --stress 60kPa -o my.toml");
  verb->callback([options] { write_new(*options); });
}

}  // namespace dem
