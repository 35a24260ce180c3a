// SPDX-License-Identifier: BSD-3-Clause
// CSV tables, status.json and the forecast of the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/table_file.hpp"
#include "dem4grm/runs/remaining_time.hpp"
#include "dem4grm/runs/status_file.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using test::read_all;
using test::TemporaryFolder;

ShearRow sample_row() {
  ShearRow row;
  row.displacement = 1e-5;
  row.shear_stress = 61234.5;
  row.shear_stress_corrected = 62000.0;
  row.normal_stress = 1e5;
  row.vertical_displacement = -2e-6;
  row.void_ratio = 0.65;
  row.inertial_number = 3e-5;
  row.unbalanced_ratio = 0.1 + 0.2;
  row.plate_shear_stress = 1e3 / 3.0;
  row.normal_stress_worst = 99e3;
  row.time_step = 4.25e-6;
  row.normal_stress_corrected = 101e3;
  row.dilatancy = {0.75, 0.25, 0.5};
  row.energy = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
  row.wall_force[ShearBox::k_top_plate] = {1.5, -2.5, 1000.0};
  row.wall_force[ShearBox::k_top_plate + ShearBox::k_side_y_max] = {0.0, 42.0, 0.0};
  return row;
}

TEST(Table, HeaderOfShearBeginsAsPromised) {
  const TemporaryFolder folder;
  const TableFile table(folder / "shear.csv", shear_columns());
  const std::string header = read_all(folder / "shear.csv");
  const std::string promised =
      "displacement_mm,shear_stress_kPa,shear_stress_corrected_kPa,normal_stress_kPa,vertical_displacement_mm,"
      "void_ratio,inertial_number,unbalanced_ratio,half_force_imbalance,plate_shear_stress_kPa,normal_stress_worst_"
      "kPa,";
  EXPECT_EQ(header.substr(0, promised.size()), promised);
  EXPECT_TRUE(header.ends_with("breakage_J\n"));
}

TEST(Table, EveryColumnHasUnitInNameAndDescription) {
  for (const auto columns : {shear_columns(), wall_columns(), compression_columns(), micro_columns()}) {
    for (const ColumnInfo& column : columns) {
      EXPECT_FALSE(column.description.empty()) << column.name;
      if (column.unit != "1") {
        EXPECT_TRUE(column.name.ends_with("_" + std::string(column.unit))) << column.name;
      }
    }
  }
  EXPECT_EQ(shear_columns().size(), shear_values({}, 0.0).size());
  EXPECT_EQ(wall_columns().size(), wall_values({}).size());
  EXPECT_EQ(compression_columns().size(), compression_values({}).size());
  EXPECT_EQ(micro_columns().size(), micro_values({}).size());
}

TEST(Table, MicroMechanicsHasUniqueNamesAndTheUnitsOfTheHeader) {
  std::vector<std::string_view> names;
  for (const ColumnInfo& column : micro_columns()) names.push_back(column.name);
  EXPECT_EQ(names.front(), "displacement_mm");
  MicroRow row;
  row.displacement = 8e-3;
  row.numbers.sets[0].normal_direction = std::numbers::pi / 3;
  row.numbers.sets[3].strong_share = 0.25;
  row.numbers.stress_zz = 1e5;
  row.numbers.bond_strain = std::numeric_limits<double>::quiet_NaN() * -1.0;
  const std::vector<double> values = micro_values(row);
  const auto value = [&](std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    return values.at(static_cast<std::size_t>(at));
  };
  EXPECT_EQ(value("displacement_mm"), 8.0);
  EXPECT_NEAR(value("theta_n_all_deg"), 60.0, 1e-12);
  EXPECT_EQ(value("strong_share_rr"), 0.25);
  EXPECT_EQ(value("stress_zz_kPa"), 100.0);
  EXPECT_TRUE(std::isnan(value("bond_strain")));
  EXPECT_FALSE(std::signbit(value("bond_strain"))) << "else it would be printed as -nan";
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(Table, RowsAreInTheFileAtOnceInShortestNumbers) {
  const TemporaryFolder folder;
  TableFile table(folder / "shear.csv", shear_columns());
  table.append(shear_values(sample_row(), 0.25));
  const std::string text = read_all(folder / "shear.csv");
  const std::string row = text.substr(text.find('\n') + 1);
  EXPECT_EQ(row,
            "0.01,61.2345,62,100,-0.002,0.65,3e-05,0.30000000000000004,0.25,0.3333333333333333,99,4.25,"
            "101,0.75,0.25,0.5,1,2,3,4,5,6,7,8\n");
  EXPECT_EQ(table.rows(), 1U);
  EXPECT_EQ(table.values_of(1).front(), 61.2345);
}

TEST(Table, ForcesStandUnderTheNameOfTheirWall) {
  const std::vector<double> values = wall_values(sample_row());
  std::map<std::string_view, double> by_name;
  for (std::size_t c = 0; c < values.size(); ++c) by_name[wall_columns()[c].name] = values[c];
  EXPECT_EQ(by_name.size(), 1U + 3U * ShearBox::k_walls);
  EXPECT_EQ(by_name.at("displacement_mm"), 0.01);
  EXPECT_EQ(by_name.at("top_plate_fx_N"), 1.5);
  EXPECT_EQ(by_name.at("top_plate_fy_N"), -2.5);
  EXPECT_EQ(by_name.at("top_plate_fz_N"), 1000.0);
  EXPECT_EQ(by_name.at("upper_ymax_fy_N"), 42.0);
  EXPECT_EQ(by_name.at("upper_ymin_fy_N"), 0.0);
}

TEST(Table, NumbersReadBackAsTheSameBits) {
  for (const double value : {0.1, -1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), 2.0, -0.0}) {
    std::string text;
    append_number(text, value);
    double back = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value) << text;
    EXPECT_EQ(std::signbit(back), std::signbit(value));
  }
}

TEST(Status, IsWholeAtAnyTimeAndSaysState) {
  const TemporaryFolder folder;
  StatusFile status(folder / "status.json", "some", 2);
  EXPECT_EQ(text_in(read_json_file(folder / "status.json"), "state"), "created");
  status.set_state(RunState::running);
  Progress now;
  now.stage = "shear";
  now.fraction = 0.5;
  now.displacement = 7e-3;
  RemainingTime remaining("shear", 1.0);
  status.set_progress(now, remaining);  // too soon after the last write
  EXPECT_EQ(text_in(read_json_file(folder / "status.json"), "stage"), "");
  status.set_state(RunState::failed, "lost grain");
  const JsonObject read = read_json_file(folder / "status.json");
  EXPECT_EQ(text_in(read, "state"), "failed");
  EXPECT_EQ(text_in(read, "cause"), "lost grain");
  EXPECT_EQ(text_in(read, "stage"), "shear");
  EXPECT_DOUBLE_EQ(number_in(read, "displacement_mm"), 7.0);
  EXPECT_EQ(number_in(read, "pid"), ::getpid());
  EXPECT_FALSE(std::filesystem::exists(folder / "status.json.tmp"));
}

TEST(Json, KeepsNumbersAndTakesWhatIsNoNumber) {
  const JsonObject object{{"real", 0.1}, {"whole", 7}, {"flag", true}, {"none", std::nan("")}, {"text", "a\"\xff"}};
  const std::string text = json_text(object);
  const JsonObject back = parse_json(text, "x");
  EXPECT_EQ(number_in(back, "real"), 0.1);
  EXPECT_EQ(number_in(back, "whole"), 7.0);
  EXPECT_TRUE(is_set_in(back, "flag"));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(find_field(back, "none")->data));
  EXPECT_EQ(text, json_text(object));
}

/// A stage of even speed: 1000 steps a second, so many of it done per second.
Progress even_progress(double wall_time, const std::string& stage, double fraction_per_second) {
  Progress p;
  p.stage = stage;
  p.fraction = fraction_per_second > 0.0 ? fraction_per_second * wall_time : -1.0;
  p.steps = std::llround(1000.0 * wall_time);
  p.time_step = 1e-6;
  return p;
}

TEST(Forecast, OfTheLastStageIsRightAtEvenSpeed) {
  RemainingTime remaining("shear", 0.1);
  for (double t = 0.1; t <= 20.0; t += 0.1) {
    remaining.update(even_progress(t, "shear", 0.01), t);
    if (t < 1.0) continue;
    EXPECT_NEAR(remaining.forecast().seconds.value(), 100.0 - t, 1e-6);
    EXPECT_NEAR(remaining.steps_per_second(), 1000.0, 5.0);
  }
  EXPECT_FALSE(remaining.forecast().is_lower_bound);
}

TEST(Forecast, BeforeTheLastStageIsALowerBound) {
  RemainingTime remaining("shear", 0.1);
  Progress fill;
  fill.stage = "fill";
  fill.fraction = 0.5;
  remaining.update(fill, 1.0);
  EXPECT_FALSE(remaining.forecast().seconds.has_value());
  for (double t = 0.1; t <= 5.0; t += 0.1) remaining.update(even_progress(t, "compression", 0.0), 1.0 + t);
  const Forecast forecast = remaining.forecast();
  EXPECT_TRUE(forecast.is_lower_bound);
  EXPECT_NEAR(forecast.seconds.value(), 100.0, 1.0) << "0.1 s of 1e-6 s at 1000 steps/s";
}

TEST(Forecast, FollowsAChangeOfSpeedAndAClockThatStepsBack) {
  RemainingTime remaining("shear", 1.0);
  double fraction = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.1 * k;
    fraction += k < 2000 ? 0.1 * 0.002 : 0.1 * 0.001;
    Progress p;
    p.stage = "shear";
    p.fraction = fraction;
    remaining.update(p, t);
  }
  EXPECT_NEAR(remaining.forecast().seconds.value(), (1.0 - fraction) / 0.001, 5.0);
  Progress p;
  p.stage = "shear";
  p.fraction = fraction;
  remaining.update(p, 0.0);
  EXPECT_GE(remaining.forecast().seconds.value(), 0.0);
}

}  // namespace
}  // namespace dem
