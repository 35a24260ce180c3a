// SPDX-License-Identifier: BSD-3-Clause
// All results of a study in few files: tables for people and for statistics, strength envelopes, and the same as HDF5.
//
//     tests.csv       one row a test: its values and every number of its summary.json
//     collected.csv   one row a number, long and tidy: test, values of the study, table, displacement, quantity, unit, value;
//                     table is shear, micro, compression or summary
//     envelopes.csv   one row for each mixture and each of peak and residual shear stress
//     collected.h5    /tests, /shear, /micro, /compression, /envelopes: one dataset for each column, with unit and description
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/mohr_envelope.hpp"
#include "dem4grm/campaign/study.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

/// A finished test.
struct CollectedTest {
  std::string name;
  std::vector<StudyValue> values;
  std::filesystem::path folder;
};

/// Numbers of some tests in one table, column by column; a table of curves has the rows of all tests one after the other.
struct CollectedTable {
  struct Column {
    std::string name, unit, description;
    std::vector<double> values;  ///< not a number where a test has none
  };
  std::vector<std::int32_t> test;  ///< of each row, the place of its test
  std::vector<Column> columns;
};

/// Strength of one mixture: of all tests that differ in nothing but normal stress and seed.
struct MixtureEnvelope {
  std::vector<StudyValue> values;  ///< of the mixture
  std::string quantity;            ///< "peak" or "residual"
  int hardening = 0;               ///< tests that had no peak: their stress still rose at the end
  MohrEnvelope fit;
};

struct Collection {
  std::vector<CollectedTest> tests;
  std::vector<std::string> columns;   ///< of the values of the study, in their order
  std::vector<JsonObject> summaries;  ///< plain numbers and short texts; objects inside are flattened
  CollectedTable shear, micro, compression;
  CollectedTable walls, profiles;  ///< in collected.h5 alone: dozens of columns, and rows over the height
  std::vector<MixtureEnvelope> envelopes;
  std::vector<std::string> warnings;  ///< of tests that were left out, since their files are damaged
};

/// Reads the tests, all finished. Damaged ones are left out with a warning.
Collection read_collection(const std::vector<CollectedTest>& tests);

/// Writes the four files into a folder that is there, each as a whole. The same tests give the same bytes. Throws IoError.
void write_collection(const Collection& collection, const std::filesystem::path& folder);

/// The envelopes for people.
std::string envelopes_text(const Collection& collection);

}  // namespace dem
