// SPDX-License-Identifier: BSD-3-Clause
// Good cases: values, defaults, options, the resolved copy, the template and the shipped files.
#include "dem4grm/case_file/case_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <type_traits>

#include <gtest/gtest.h>

#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/grading_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"
#include "unit/case_file/case_bits.hpp"

namespace dem {
namespace {

const std::filesystem::path k_cases = std::filesystem::path(DEM_SOURCE_DIR) / "cases";

/// A complete case in one text.
constexpr std::string_view k_small = R"([specimen]
rubber_content = 0.25
gravel_grading = [["3.5 mm", 0.0], ["5.6 mm", 0.5], ["8.5 mm", 1.0]]
rubber_grading = [["3.65 mm", 0.0], ["3.75 mm", 1.0]]
[shear]
normal_stress = "60 kPa"
)";

DirectShearCase direct_shear(std::string_view text, std::span<const Override> overrides = {}) {
  return std::get<DirectShearCase>(parse_case(text, "case.toml", overrides).test);
}

using testing_support::all_bits;

void expect_same(const TestCase& a, const TestCase& b) {
  ASSERT_EQ(a.index(), b.index());
  std::visit(
      [&b](const auto& left) {
        using Test = std::decay_t<decltype(left)>;
        EXPECT_EQ(all_bits(left), all_bits(std::get<Test>(b)));
      },
      a);
}

TEST(CaseFile, ReadsValuesWithUnits) {
  const DirectShearCase test = direct_shear(std::string(k_small) + R"(velocity = "20 mm/s"
displacement = "10 mm"
moving_half = "both"
[box]
length = "5 cm"
[rubber.bond]
form = "incremental"
tensile_strength = "3 MPa"
linear_spring = false
[recording]
extra_frames = ["0.2 mm", "8 mm"]
[equilibrium]
most_steps = 1e6
)");
  EXPECT_EQ(test.specimen.rubber_content, 0.25);
  EXPECT_EQ(test.shear.normal_stress, 60e3);
  EXPECT_EQ(test.shear.velocity, 0.02);
  EXPECT_EQ(test.shear.displacement, 0.01);
  EXPECT_EQ(test.shear.moving_half, MovingHalf::both);
  EXPECT_EQ(test.box.length, 0.05);
  EXPECT_EQ(test.bond.form, BondForm::incremental);
  EXPECT_EQ(test.bond.tensile_strength, 3e6);
  EXPECT_FALSE(test.bond.linear_spring);
  EXPECT_EQ(test.recording.extra_frames, (std::vector<double>{0.2e-3, 8e-3}));
  EXPECT_EQ(test.equilibrium.most_steps, 1000000);
  ASSERT_EQ(test.specimen.gravel_grading.size(), 3u);
  EXPECT_EQ(test.specimen.gravel_grading[1].size, 5.6e-3);
  EXPECT_EQ(test.specimen.gravel_grading[1].passing, 0.5);
}

TEST(CaseFile, KeysLeftOutKeepTheDefaultsOfTheStructs) {
  DirectShearCase expected;
  DirectShearCase test = direct_shear(k_small);
  expected.specimen = test.specimen;
  expected.shear.normal_stress = 60e3;
  EXPECT_EQ(all_bits(test), all_bits(expected));
}

TEST(CaseFile, DefaultsAreThePublishedParameters) {
  const DirectShearCase test = direct_shear(k_small);
  EXPECT_EQ(test.gravel.density, 2710.0);
  EXPECT_EQ(test.gravel.friction, 0.72);
  EXPECT_EQ(test.gravel.shear_modulus, 90e6);
  EXPECT_EQ(test.gravel.poisson_ratio, 0.3);
  EXPECT_EQ(test.rubber.density, 1610.0);
  EXPECT_EQ(test.rubber.friction, 0.27);
  EXPECT_EQ(test.rubber.shear_modulus, 12e6);
  EXPECT_EQ(test.bond.modulus, 20e6);
  EXPECT_EQ(test.bond.stiffness_ratio, 4.0);
  EXPECT_EQ(test.bond.tensile_strength, 30e200);
  EXPECT_EQ(test.bond.damping_ratio, 0.25);
  EXPECT_EQ(test.walls.friction, 0.70);
  EXPECT_EQ(test.walls.shear_modulus, 80e9);
  EXPECT_EQ(test.walls.poisson_ratio, 0.25);
  EXPECT_EQ(test.integration.local_damping, 0.2);
}

TEST(CaseFile, DottedKeysInlineTablesMarkAndCarriageReturnsAreFine) {
  std::string text(k_small);
  text += "[rubber]\nbond.stiffness_ratio = 3.0\nbond.form = \"incremental\"\n";
  EXPECT_EQ(direct_shear(text).bond.stiffness_ratio, 3.0);
  EXPECT_EQ(direct_shear("box = { length = \"60 mm\", width = \"70 mm\" }\n" + std::string(k_small)).box.width, 0.07);
  EXPECT_EQ(direct_shear("\xEF\xBB\xBF" + std::string(k_small)).shear.normal_stress, 60e3);
  std::string with_returns;
  for (const char c : k_small) with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(direct_shear(with_returns).shear.normal_stress, 60e3);
  EXPECT_EQ(direct_shear("# \u03c3_n in \u00b5-words\nname = \"Gr\u00f6\u00dfe\"\n" + std::string(k_small)).name,
            "Gr\u00f6\u00dfe");
}

TEST(CaseFile, OptionsReplaceKeysWithTheSameRules) {
  const std::vector<Override> options{{"shear.normal_stress", "30kPa"},
                                      {"specimen.rubber_content", "0.4"},
                                      {"name", "other"},
                                      {"seed", "7"},
                                      {"shear.moving_half", "\"upper\""},
                                      {"rubber.bond.linear_spring", "false"},
                                      {"recording.extra_frames", "0.2 mm, 3 mm"},
                                      {"specimen.clump_shapes", "[\"T2\", \"sphere\"]"},
                                      {"specimen.gravel_grading", "[[\"4 mm\", 0.0], [\"6 mm\", 1.0]]"}};
  const DirectShearCase test = direct_shear(k_small, options);
  EXPECT_EQ(test.shear.normal_stress, 30e3);
  EXPECT_EQ(test.specimen.rubber_content, 0.4);
  EXPECT_EQ(test.name, "other");
  EXPECT_EQ(test.seed, 7u);
  EXPECT_EQ(test.shear.moving_half, MovingHalf::upper);
  EXPECT_FALSE(test.bond.linear_spring);
  EXPECT_EQ(test.recording.extra_frames, (std::vector<double>{0.2e-3, 3e-3}));
  EXPECT_EQ(test.specimen.clump_shapes, (std::vector<std::string>{"T2", "sphere"}));
  EXPECT_EQ(test.specimen.gravel_grading.back().size, 6e-3);
  EXPECT_EQ(direct_shear("[specimen]\nrubber_content = 2\n" + std::string(k_small).substr(k_small.find("gravel")),
                         std::vector<Override>{{"specimen.rubber_content", "0.1"}})
                .specimen.rubber_content,
            0.1);
}

TEST(CaseFile, AnOptionTakesThePlaceOfTheKeyThatItExcludes) {
  const std::string dense =
      std::string("[specimen]\nrelative_density = 0.7\n") + std::string(k_small).substr(k_small.find("rubber"));
  const std::string rough =
      std::string("[specimen]\npreparation_friction = 0.2\n") + std::string(k_small).substr(k_small.find("rubber"));
  const std::vector<Override> friction{{"specimen.preparation_friction", "1.5"}},
      density{{"specimen.relative_density", "0.3"}};
  const SpecimenSettings loose = direct_shear(dense, friction).specimen;
  EXPECT_EQ(loose.preparation_friction, 1.5);
  EXPECT_FALSE(loose.relative_density.has_value());
  const SpecimenSettings searched = direct_shear(rough, density).specimen;
  EXPECT_EQ(searched.relative_density, 0.3);
  EXPECT_FALSE(searched.preparation_friction.has_value());
  EXPECT_EQ(direct_shear(dense, density).specimen.relative_density, 0.3);
  EXPECT_THROW(direct_shear(dense, std::vector<Override>{friction[0], density[0]}), InputError) << "both are asked for";
}

TEST(CaseFile, WarningsAreKeptAndDoNotStop) {
  const LoadedCase loaded = parse_case(std::string(k_small) + "velocity = \"0.1 m/s\"\n", "case.toml",
                                       std::vector<Override>{{"shear.normal_stress", "5 kPa"}});
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_EQ(loaded.warnings[0],
            "case.toml:7:12: warning: shear.velocity = 100 mm/s is above 50 mm/s: hardly quasi-static\n"
            "    7 | velocity = \"0.1 m/s\"\n"
            "      |            ^^^^^^^^^ published: 2 mm/s");
  EXPECT_TRUE(loaded.warnings[1].starts_with(
      "--set shear.normal_stress=5 kPa: warning: shear.normal_stress = 5 kPa is outside the usual 10 kPa to 500 kPa"));
}

TEST(CaseFile, ResolvedCopyIsTheIdenticalCase) {
  const LoadedCase first = load_case(k_cases / "quick.toml");
  const LoadedCase again = parse_case(first.resolved_toml, "resolved.toml");
  expect_same(first.test, again.test);
  EXPECT_EQ(first.resolved_toml, again.resolved_toml);
  const auto& test = std::get<DirectShearCase>(again.test);
  EXPECT_EQ(test.specimen.gravel_grading_file, "gradings/gravel-rounded.csv");

  const LoadedCase odd = parse_case(std::string(k_small) + R"(velocity = "1.3 mm/min"
[rubber]
friction = 0.1234567890123456789
[box]
wing = "33.3333333333333333 mm"
)",
                                    "case.toml");
  expect_same(odd.test, parse_case(odd.resolved_toml, "resolved.toml").test);
}

TEST(CaseFile, ResolvedCopyNamesEveryKey) {
  const LoadedCase loaded = parse_case(k_small, "case.toml");
  DirectShearCase bound;
  for (const Key& key : case_schema(bound).keys) {
    const std::string name = "\n" + std::string(key.name);
    const bool is_there =
        loaded.resolved_toml.find(name + " = ") != std::string::npos ||
        loaded.resolved_toml.find("\n# " + std::string(key.name) + " is not set") != std::string::npos;
    EXPECT_TRUE(is_there) << key.path();
    EXPECT_FALSE(key.help.empty()) << key.path();
  }
}

TEST(CaseFile, TemplateLoadsAndFitsAScreen) {
  for (const std::string test : {"direct_shear", "grain_compression"}) {
    for (const double vrc : {0.0, 7.0, 25.0, 100.0}) {
      const std::string text = new_case_text({test, vrc, "60kPa"});
      EXPECT_LT(split_lines(text).size(), 45u);
      const LoadedCase loaded = parse_case(text, "new.toml");
      EXPECT_TRUE(loaded.warnings.empty());
      if (test == "direct_shear") {
        const auto& shear = std::get<DirectShearCase>(loaded.test);
        EXPECT_EQ(shear.specimen.rubber_content, vrc / 100.0);
        EXPECT_EQ(shear.shear.normal_stress, 60e3);
        EXPECT_EQ(shear.box.length, 0.1);
      }
    }
  }
  EXPECT_THROW(new_case_text({"direct_shear", 250.0, "60 kPa"}), InputError);
  EXPECT_THROW(new_case_text({"direct_shear", 25.0, "60 kN"}), InputError);
  EXPECT_THROW(new_case_text({"direct_shear", 25.0, "60 GPa"}), InputError);
  EXPECT_THROW(new_case_text({"direct_sheer", 25.0, "60 kPa"}), InputError);
}

TEST(CaseFile, GradingsOfTheTemplateAreTheShippedFiles) {
  const auto test = direct_shear(new_case_text({}));
  const auto expect_equal = [](const Grading& grading, const char* file) {
    const GradingFile shipped = read_grading_file(k_cases / "gradings" / file);
    ASSERT_TRUE(shipped.problems.empty());
    ASSERT_EQ(grading.size(), shipped.points.size());
    for (std::size_t i = 0; i < grading.size(); ++i) {
      EXPECT_EQ(grading[i].size, shipped.points[i].size);
      EXPECT_EQ(grading[i].passing, shipped.points[i].passing);
    }
  };
  expect_equal(test.specimen.gravel_grading, "gravel-rounded.csv");
  expect_equal(test.specimen.rubber_grading, "rubber-3.7mm.csv");
}

TEST(CaseFile, ManualHoldsTheKeyTableOfTheProgram) {
  const std::filesystem::path manual = std::filesystem::path(DEM_SOURCE_DIR) / "docs" / "reference" / "case-file.md";
  std::ifstream file(manual);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_NE(text.find(key_table_markdown()), std::string::npos)
      << "write the output of `dem4grm check --keys` into " << manual;
}

TEST(CaseFile, KeyTableNamesEveryKeyOfBothTests) {
  const std::string table = key_table_markdown();
  DirectShearCase direct_shear_case;
  GrainCompressionCase compression_case;
  for (const Schema& schema : {case_schema(direct_shear_case), case_schema(compression_case)}) {
    for (const Key& key : schema.keys) {
      EXPECT_NE(table.find("| `" + std::string(key.name) + "` |"), std::string::npos) << key.path();
    }
    for (const Section& section : schema.sections) {
      EXPECT_NE(table.find("### `[" + std::string(section.name) + "]`"), std::string::npos) << section.name;
    }
  }
}

TEST(CaseFile, SchemaHasEachPathOnceAndDefaultsInsideTheirRanges) {
  DirectShearCase test;
  std::set<std::string> paths;
  const Schema schema = case_schema(test);
  for (const Key& key : schema.keys) {
    EXPECT_TRUE(paths.insert(key.path()).second) << key.path();
    EXPECT_TRUE(key.section.empty() || schema.has_section(key.section)) << key.path();
    if (const auto* const* slot = std::get_if<double*>(&key.slot); slot != nullptr && !key.is_required) {
      EXPECT_GE(**slot, key.range.least) << key.path();
      EXPECT_LE(**slot, key.range.most) << key.path();
    }
  }
}

TEST(CaseFile, GrainCompressionNeedsNoOtherKey) {
  const LoadedCase loaded = parse_case("test = \"grain_compression\"\n", "case.toml");
  EXPECT_EQ(all_bits(std::get<GrainCompressionCase>(loaded.test)), all_bits(GrainCompressionCase{}));
  expect_same(loaded.test, parse_case(loaded.resolved_toml, "resolved.toml").test);
  const LoadedCase other = parse_case(R"(test = "grain_compression"
[rubber]
ball_radius = "0.6 mm"
[compression]
strain = 0.3
records = 50
plate_velocity = "1 cm/s"
)",
                                      "case.toml");
  const auto& test = std::get<GrainCompressionCase>(other.test);
  EXPECT_EQ(test.ball_radius, 0.6e-3);
  EXPECT_EQ(test.strain, 0.3);
  EXPECT_EQ(test.records, 50);
  EXPECT_EQ(test.plate_velocity, 0.01);
}

TEST(CaseFile, AStudyIsToldFromACase) {
  try {
    load_case(k_cases / "paper/campaign.toml");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("this is a study, which makes many tests of a case: dem4grm campaign plan shows them"),
              std::string::npos)
        << said;
    EXPECT_TRUE(said.ends_with("1 error, nothing was run")) << said;
  }
}

TEST(CaseFile, ShippedCasesLoad) {
  const auto quick = std::get<DirectShearCase>(load_case(k_cases / "quick.toml").test);
  EXPECT_EQ(quick.name, "quick");
  EXPECT_EQ(quick.shear.normal_stress, 100e3);
  EXPECT_TRUE(std::holds_alternative<GrainCompressionCase>(load_case(k_cases / "grain_compression.toml").test));
  // The published test; tests/unit/campaign has the 18 that its study makes of it.
  const LoadedCase paper = load_case(k_cases / "paper/direct-shear.toml");
  EXPECT_TRUE(paper.warnings.empty());
  EXPECT_EQ(std::get<DirectShearCase>(paper.test).shear.displacement, 0.014);
  for (const char* name : {"eighth.toml", "studies/small-box.toml"}) EXPECT_NO_THROW(load_case(k_cases / name)) << name;
}

}  // namespace
}  // namespace dem
