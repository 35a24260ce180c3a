// SPDX-License-Identifier: BSD-3-Clause
// The one table that declares every key of a case file. Reader, resolved copy, template and manual are made from it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

/// Smallest and largest allowed value in SI units, both allowed themselves. Of lists: of every element.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

/// A key that says which test the case is of; nothing is stored.
struct TestName {
  std::string_view name;
};

/// A grading and the name of the file that it came from.
struct GradingSlot {
  Grading* points = nullptr;
  std::string* file = nullptr;
};

/// Clump shapes of the user and the name of the file that they came from.
struct ClumpTemplatesSlot {
  std::vector<ClumpShape>* shapes = nullptr;
  std::string* file = nullptr;
};

/// Names among the choices of the key and the shapes of the user, which have been read before.
struct ShapeNamesSlot {
  std::vector<std::string>* names = nullptr;
  const SpecimenSettings* specimen = nullptr;
};

/// A quantity, or the one word that stands for no value.
struct QuantityOrWord {
  std::optional<double>* value = nullptr;
  std::string_view word;
};

/// Where the value of a key lives inside a case; the alternative also says what kind of value it is. The choices of an
/// enumeration are named by Key::choices in the order of its enumerators.
using Slot = std::variant<TestName, double*, std::optional<double>*, int*, std::optional<int>*, std::uint64_t*, bool*,
                          std::string*, std::vector<double>*, GradingSlot, ClumpTemplatesSlot, ShapeNamesSlot,
                          QuantityOrWord, BondForm*, TimeStepRule*, MovingHalf*, SplitPlane*, Generation*>;

struct Key {
  std::string_view section{};  ///< "rubber.bond"; empty for the keys before the first section
  std::string_view name{};
  Slot slot{};
  Dimension dimension = Dimension::none;  ///< of the value or of every element of a list
  Range range{};
  std::string_view help{};           ///< one line, without unit, range and default
  std::string_view published{};      ///< value of the published model or of the laboratory; may be empty
  std::string_view default_words{};  ///< how the value is found when it is not given; empty: the value in the slot
  std::vector<std::string_view> choices{};
  bool is_required = false;
  bool is_in_template = false;  ///< written by `dem4grm new`

  [[nodiscard]] std::string path() const;
  /// True when text with a unit is asked for.
  [[nodiscard]] bool has_unit() const { return dimension != Dimension::none; }
};

struct Section {
  std::string_view name;
  std::string_view help;
};

struct Schema {
  std::vector<Section> sections;
  std::vector<Key> keys;

  /// The key of that path ("rubber.bond.modulus"), or nullptr.
  [[nodiscard]] const Key* find(std::string_view path) const;
  /// True for a section and for the parents of sections.
  [[nodiscard]] bool has_section(std::string_view name) const;
};

/// The table bound to one case. The slots point into the case, which must outlive the schema and keep its place;
/// bound to a new case, they hold the defaults.
Schema case_schema(DirectShearCase& direct_shear);
Schema case_schema(GrainCompressionCase& grain_compression);

/// "[0, 5]" or "[1 kPa, 10 MPa]"; "at least ..." when one side is open; empty when both are.
std::string range_text(const Key& key);

/// What the value is, with unit and published value: "friction coefficient, no unit (published: 0.27)".
std::string key_note(const Key& key);

/// The value in the slot as TOML text; nothing for an optional value that is not set.
std::optional<std::string> value_text(const Key& key);

/// A TOML string in quotes with all escapes.
std::string toml_quoted(std::string_view text);

/// A TOML floating-point number that reads as the same bits.
std::string toml_number(double value);

}  // namespace dem
