// SPDX-License-Identifier: BSD-3-Clause
// A state that went through results.h5 gives the numbers of the simulation that wrote it, bit for bit.
#include "dem4grm/results/micro_state_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <sstream>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/micro_text.hpp"
#include "dem4grm/results/results_file.hpp"
#include "support/mixture_scene.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using NumberBits = std::array<std::uint64_t, sizeof(MicroNumbers) / sizeof(std::uint64_t)>;
NumberBits bits_of(const MicroNumbers& numbers) { return std::bit_cast<NumberBits>(numbers); }

const ResultsOrigin k_state_origin{"direct_shear", "box", "text", "resolved"};

class MicroStateFile : public ::testing::Test {
 protected:
  MicroStateFile() : path_(folder_ / "results.h5") {
    ResultsFile file(path_, k_state_origin);
    file.add_frame(early_, {0, 0.0, early_.state_hash()});
    file.add_frame(late_, {1, 2.003e-3, late_.state_hash()});
  }
  void expect_error(const std::filesystem::path& path, std::optional<double> at, ExitCode code,
                    const std::string& text) const {
    try {
      read_micro_state(path, at);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_;
  const Simulation &early_ = early(), &late_ = late();

 private:
  static const Simulation& early() {
    static const Simulation k_early = test::run_mixture({}, 500);
    return k_early;
  }
  static const Simulation& late() {
    static const Simulation k_late = test::run_mixture({}, 1500);
    return k_late;
  }
};

TEST_F(MicroStateFile, GivesTheBitsOfTheSimulation) {
  for (const bool is_late : {false, true}) {
    const StoredMicroState stored = read_micro_state(path_, is_late ? 2e-3 : 0.0);
    const Simulation& s = is_late ? late_ : early_;
    EXPECT_EQ(stored.state_hash, s.state_hash());
    for (const ContactLevel level : {ContactLevel::contact, ContactLevel::pair}) {
      MicroOptions options;
      options.level = level;
      options.resamples = 3;
      const MicroAnalysis found = analyse(stored.state, options), expected = analyse(micro_state_of(s), options);
      EXPECT_TRUE(bits_of(found.numbers) == bits_of(expected.numbers));
      EXPECT_EQ(found.histograms[0].counts, expected.histograms[0].counts);
      EXPECT_EQ(found.bands[0].normal_amplitude.high, expected.bands[0].normal_amplitude.high);
      EXPECT_GT(expected.numbers.of_all().contacts, 50.0);
      EXPECT_GT(expected.numbers.plate_stress, 0.0);
    }
  }
  EXPECT_EQ(read_micro_state(path_, std::nullopt).name, "0001") << "the last state";
}

TEST_F(MicroStateFile, SaysWhichStatesThereAre) {
  expect_error(path_, 1e-3, ExitCode::missing_file, "no state at 1 mm; there are states at 0, 2 mm");
  expect_error(folder_ / "absent.h5", 1e-3, ExitCode::missing_file, "absent.h5");
  const ResultsFile empty(folder_ / "empty.h5", k_state_origin);
  expect_error(folder_ / "empty.h5", std::nullopt, ExitCode::missing_file, "no state yet");
  const ResultsFile grain(folder_ / "grain.h5", {"grain_compression", "grain", "", ""});
  expect_error(folder_ / "grain.h5", std::nullopt, ExitCode::io, "needs a direct shear test");
}

TEST_F(MicroStateFile, StatesOfEarlierBuildsAreRefusedWithTheReason) {
  change_sealed_file(path_, [](const hdf5::Handle& file) {
    const hdf5::Handle contacts = hdf5::open_group(file, "frames/0001/contacts");
    ASSERT_GE(H5Ldelete(contacts.id(), "is_sliding", H5P_DEFAULT), 0);
  });
  expect_error(path_, 2e-3, ExitCode::io, "run the case again");
}

TEST_F(MicroStateFile, TextsHoldTheNumbers) {
  const StoredMicroState stored = read_micro_state(path_, 2e-3);
  MicroOptions options;
  options.resamples = 5;
  const MicroAnalysis analysis = analyse(stored.state, options);
  const JsonObject json = parse_json(json_text(micro_as_json(stored, analysis)), "micro");
  const auto& all = std::get<JsonObject>(find_field(std::get<JsonObject>(find_field(json, "sets")->data), "all")->data);
  EXPECT_EQ(number_in(all, "a_n"), analysis.numbers.of_all().normal_amplitude);
  EXPECT_EQ(number_in(all, "contacts"), analysis.numbers.of_all().contacts);
  EXPECT_NE(find_field(all, "bands_95"), nullptr);
  EXPECT_EQ(number_in(json, "coordination"), analysis.numbers.coordination);
  EXPECT_EQ(number_in(json, "displacement_mm"), 2.003);
  const std::string table = micro_table_text(analysis);
  for (const char* word : {"all", "g-g", "theta_n", "deg", "95 % band", "bulk_friction", "bond_strain", "kPa"}) {
    EXPECT_NE(table.find(word), std::string::npos) << word;
  }
  // Plot data: four sets of 36 directions; the densities of a set times the width of a bin add up to 1.
  std::istringstream csv(histogram_csv(analysis));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line.substr(0, 22), "set,angle_deg,contacts");
  double density = 0.0;
  int rows = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
    ++rows;
    if (!line.starts_with("all,")) continue;
    std::istringstream fields(line);
    std::string field;
    for (int k = 0; k < 4; ++k) std::getline(fields, field, ',');
    density += std::stod(field) * options.bin_width();
  }
  EXPECT_EQ(rows, 4 * 36);
  EXPECT_NEAR(density, 1.0, 1e-12);
}

}  // namespace
}  // namespace dem
