// SPDX-License-Identifier: BSD-3-Clause
// What a report reads beside results: a laboratory's curve, published values, the keys of a resolved case, and the verdicts of the
// quality panel.
#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/report/case_inputs.hpp"
#include "dem4grm/report/laboratory_curve.hpp"
#include "dem4grm/report/published_values.hpp"
#include "dem4grm/report/quality_panel.hpp"

namespace dem {
namespace {

template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LaboratoryCurve, ReadsOurOwnHeader) {
  const LaboratoryCurve curve = parse_laboratory_curve(
      "displacement_mm,shear_stress_kPa,vertical_displacement_mm\n0,0,0\n0.5,40.25,-0.02\n1,61,0.1\n", "a.csv");
  EXPECT_EQ(curve.displacement, (std::vector<double>{0.0, 0.5e-3, 1e-3}));
  EXPECT_EQ(curve.shear_stress, (std::vector<double>{0.0, 40.25e3, 61e3}));
  EXPECT_EQ(curve.vertical_displacement, (std::vector<double>{0.0, -0.02e-3, 0.1e-3}));
}

TEST(LaboratoryCurve, ReadsWhatALaboratoryExports) {
  // Lines about the test first, semicolons, decimal commas, other units, a settlement, an empty field, a normal stress to pass over.
  const LaboratoryCurve curve = parse_laboratory_curve(
      "\xEF\xBB\xBFTest no. 12;GRM 25\n\nTime (s);Horizontal displacement (cm);Normal stress (kPa);Shear stress "
      "(MPa);Settlement [um]\n"
      "0;0,00;100;0,000;0\n1;0,05;100;0,0402;12,5\n2;0,10;100;;-3\n",
      "b.csv");
  ASSERT_EQ(curve.displacement.size(), 3U);
  EXPECT_DOUBLE_EQ(curve.displacement[1], 0.5e-3);
  EXPECT_DOUBLE_EQ(curve.shear_stress[1], 40.2e3);
  EXPECT_TRUE(std::isnan(curve.shear_stress[2]));
  EXPECT_DOUBLE_EQ(curve.vertical_displacement[1], -12.5e-6);
  EXPECT_DOUBLE_EQ(curve.vertical_displacement[2], 3e-6);
  for (const char* words : {"cm", "MPa", "settlement positive, turned round", "semicolons"}) {
    EXPECT_NE(curve.note.find(words), std::string::npos) << curve.note;
  }
}

TEST(LaboratoryCurve, SaysWhichUnitsItTookForGranted) {
  const LaboratoryCurve curve = parse_laboratory_curve("displacement\tshear stress\n0\t0\n1\t50\n", "c.csv");
  EXPECT_DOUBLE_EQ(curve.shear_stress[1], 50e3);
  EXPECT_NE(curve.note.find("kPa (no unit is named)"), std::string::npos) << curve.note;
}

TEST(LaboratoryCurve, NamesEveryProblemWithItsPlace) {
  const auto refused = [](const std::string& text) {
    return refusal_of([&] { parse_laboratory_curve(text, "d.csv"); });
  };
  EXPECT_NE(refused("time,force\n1,2\n").find("no line names the columns"), std::string::npos);
  const std::string two = refused("displacement_mm,shear_stress_kPa\n0,abc\nxyz,3\n");
  EXPECT_NE(two.find("d.csv:2:3: error: \"abc\""), std::string::npos) << two;
  EXPECT_NE(two.find("d.csv:3:1: error: \"xyz\""), std::string::npos) << two;
  EXPECT_NE(refused("displacement_mm,shear_stress_kPa\n0,1\n").find("fewer than two rows"), std::string::npos);
  EXPECT_NE(refused("displacement_mm,shear_stress_kPa\n0,1\n5\n").find("d.csv:3:1"), std::string::npos);
}

TEST(PublishedValues, TheShippedOnesAreThoseOfTheCalibrationSet) {
  const auto rows = parse_published_values(shipped_published_values(), "published.csv");
  int void_ratios = 0, counts = 0;
  for (const PublishedValue& row : rows) {
    const bool is_pure = row.rubber_content == 0.0 || row.rubber_content == 1.0;
    if (row.quantity == "void_ratio_before_shear") {
      EXPECT_TRUE(is_pure && row.normal_stress_kPa) << row.value;  // mixtures are predicted, not compared
      ++void_ratios;
    } else {
      EXPECT_TRUE(row.quantity == "clumps" || row.quantity == "rubber_grains") << row.quantity;
      ++counts;
    }
  }
  EXPECT_EQ(void_ratios, 6);
  EXPECT_EQ(counts, 10);
}

TEST(PublishedValues, NamesEveryProblemWithItsPlace) {
  const std::string text = refusal_of([] {
    parse_published_values(
        "rubber_content,normal_stress_kPa,quantity,value,source\n1.5,,clumps,3,x\n0,low,,4,x\n0,,a,b\n", "p.csv");
  });
  for (const char* place : {"p.csv:2:1", "p.csv:3:3", "p.csv:3:7", "p.csv:4:1"}) {
    EXPECT_NE(text.find(place), std::string::npos) << place << " in\n" << text;
  }
  EXPECT_NE(refusal_of([] { parse_published_values("a,b\n", "p.csv"); }).find("header"), std::string::npos);
}

const JsonObject* row_of(const JsonList& sections, const std::string& section, const std::string& key) {
  for (const JsonValue& part : sections) {
    const auto& fields = std::get<JsonObject>(part.data);
    if (text_in(fields, "section") != section) continue;
    for (const JsonValue& row : std::get<JsonList>(find_field(fields, "rows")->data)) {
      if (text_in(std::get<JsonObject>(row.data), "key") == key) return &std::get<JsonObject>(row.data);
    }
  }
  return nullptr;
}

TEST(CaseInputs, ReadsEveryKindOfLineOfAResolvedCase) {
  const std::string text = new_case_text({"direct_shear", 25.0, "60 kPa"});
  const JsonList inputs = case_inputs(parse_case(text, "new.toml").resolved_toml);
  const JsonObject* stress = row_of(inputs, "shear", "normal_stress");
  ASSERT_NE(stress, nullptr);
  EXPECT_EQ(text_in(*stress, "value"), "60 kPa");
  EXPECT_NE(text_in(*stress, "comment").find("normal stress"), std::string::npos);
  const JsonObject* grading = row_of(inputs, "specimen", "rubber_grading");
  ASSERT_NE(grading, nullptr);
  EXPECT_EQ(text_in(*grading, "value"), "[\"3.65 mm\", 0.0], [\"3.75 mm\", 1.0]");
  EXPECT_NE(text_in(*grading, "comment").find("CSV file"), std::string::npos);
  const JsonObject* unset = row_of(inputs, "specimen", "gravel_clumps");
  ASSERT_NE(unset, nullptr);
  EXPECT_TRUE(text_in(*unset, "value").starts_with("not set: ")) << text_in(*unset, "value");
  ASSERT_NE(row_of(inputs, "", "seed"), nullptr);
}

TEST(CaseInputs, AHashSignInsideATextIsNoComment) {
  const JsonList inputs = case_inputs("name = \"a # b \\\" c\"  # the name\n");
  EXPECT_EQ(text_in(*row_of(inputs, "", "name"), "comment"), "the name");
}

std::string verdict_in(const JsonList& panel, const std::string& name) {
  for (const JsonValue& line : panel) {
    const auto& fields = std::get<JsonObject>(line.data);
    if (text_in(fields, "name").find(name) != std::string::npos) return text_in(fields, "verdict");
  }
  return "absent";
}

TEST(QualityPanel, JudgesByTheLimitsThatItNames) {
  const auto verdict = [](const char* field, double value, const char* name) {
    return verdict_in(quality_panel({{field, value}}, {}), name);
  };
  EXPECT_EQ(verdict("inertial_number_max", 9e-4, "inertial"), "good");
  EXPECT_EQ(verdict("inertial_number_max", 2e-3, "inertial"), "warning");
  EXPECT_EQ(verdict("inertial_number_max", 2e-2, "inertial"), "bad");
  EXPECT_EQ(verdict("normal_stress_max_error", 0.04, "largest error"), "good");
  EXPECT_EQ(verdict("normal_stress_max_error", 0.2, "largest error"), "bad");
  EXPECT_EQ(verdict("energy_closure_per_cent", -7.0, "energy"), "bad");
  EXPECT_EQ(verdict("lost_grains", 1.0, "lost"), "bad");
  EXPECT_EQ(verdict("broken_bonds", 12.0, "broken"), "warning");
  EXPECT_EQ(verdict("unbalanced_ratio_mean", std::nan(""), "unbalanced"), "unknown");
  EXPECT_EQ(verdict_in(quality_panel({}, {}), "lost"), "absent");
}

TEST(QualityPanel, ComparesTheMeanStressWithTheOneThatWasAskedFor) {
  const auto verdict = [](double mean) {
    return verdict_in(quality_panel({{"normal_stress_target_kPa", 1.0}, {"normal_stress_mean_kPa", mean}}, {}),
                      "error of the mean");
  };
  EXPECT_EQ(verdict(1.005), "good");
  EXPECT_EQ(verdict(0.98), "warning");
  EXPECT_EQ(verdict(1.47), "bad");
}

TEST(QualityPanel, ShowsWarningsAndARunThatDidNotFinish) {
  const JsonList panel =
      quality_panel({{"warnings", JsonList{"the plate did not hold"}}}, {{"state", "failed"}, {"cause", "NaN"}});
  EXPECT_EQ(verdict_in(panel, "warning of the run"), "warning");
  EXPECT_EQ(verdict_in(panel, "state of the run"), "bad");
  EXPECT_EQ(verdict_in(quality_panel({}, {{"state", "finished"}}), "state of the run"), "absent");
}

}  // namespace
}  // namespace dem
