// SPDX-License-Identifier: BSD-3-Clause
// Cases: read with the checks of the command line, ask for values in SI units, say what follows from them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "beside.hpp"
#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/runs/case_facts.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "dem4grm/runs/run_forecast.hpp"
#include "module.hpp"

namespace dem {
namespace {

namespace py = pybind11;
using Pairs = std::vector<std::pair<std::string, std::string>>;

std::vector<Override> overrides_of(const Pairs& pairs) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : pairs) overrides.push_back({key, value});
  return overrides;
}

/// Number of a slot in SI units; None for what is no number or not set.
py::object si_of(const Slot& slot) {
  const auto or_none = [](const auto& value) { return value ? py::object(py::cast(*value)) : py::none(); };
  return std::visit(
      [&](const auto& held) -> py::object {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, QuantityOrWord>) {
          return or_none(*held.value);
        } else if constexpr (std::is_same_v<Held, std::optional<double>*> ||
                             std::is_same_v<Held, std::optional<int>*>) {
          return or_none(*held);
        } else if constexpr (std::is_same_v<Held, double*> || std::is_same_v<Held, int*> ||
                             std::is_same_v<Held, std::uint64_t*> || std::is_same_v<Held, std::vector<double>*>) {
          return py::cast(*held);
        } else {
          return py::none();
        }
      },
      slot);
}

/// Calls use(schema) with the table of keys bound to a copy of the case.
template <class Use>
auto with_schema(const LoadedCase& loaded, const Use& use) {
  TestCase copy = loaded.test;
  return std::visit([&](auto& test) { return use(case_schema(test)); }, copy);
}

py::object value_in_si(const LoadedCase& loaded, const std::string& path) {
  return with_schema(loaded, [&](const Schema& schema) {
    const Key* key = schema.find(path);
    if (key == nullptr) throw py::key_error(path);
    return si_of(key->slot);
  });
}

py::list keys_of(const LoadedCase& loaded) {
  return with_schema(loaded, [&](const Schema& schema) {
    py::list keys;
    for (const Key& key : schema.keys) {
      py::dict one;
      one["path"] = key.path();
      one["note"] = key_note(key);
      one["range"] = range_text(key);
      keys.append(one);
    }
    return keys;
  });
}

}  // namespace

void bind_cases(py::module_& m) {
  py::class_<LoadedCase>(m, "LoadedCase")
      .def_readonly("source_text", &LoadedCase::source_text)
      .def_readonly("resolved_toml", &LoadedCase::resolved_toml)
      .def_readonly("warnings", &LoadedCase::warnings)
      .def_property_readonly("name", [](const LoadedCase& c) { return case_name(c.test); })
      .def_property_readonly("test",
                             [](const LoadedCase& c) {
                               return std::holds_alternative<DirectShearCase>(c.test) ? "direct_shear"
                                                                                      : "grain_compression";
                             })
      .def("si_value", &value_in_si)
      .def("keys", &keys_of);
  m.def("load_case", [](const std::filesystem::path& path, const Pairs& overrides) {
    return load_case(path, overrides_of(overrides));
  });
  m.def("parse_case", [](const std::string& text, const std::filesystem::path& name, const Pairs& overrides) {
    return parse_case(text, name, overrides_of(overrides));
  });
  m.def("new_case_text", [](const std::string& test, double rubber_content_percent, const std::string& normal_stress) {
    return new_case_text({test, rubber_content_percent, normal_stress});
  });
  m.def("default_folder", &default_folder);
  m.def("case_facts", [](const LoadedCase& loaded) { return json_text(facts_as_json(derive_facts(loaded.test))); });
  m.def("forecast", [](const LoadedCase& loaded, double trial, int threads) {
    std::string text;
    run_beside([&] {
      text = json_text(forecast_as_json(forecast_run(loaded.test, derive_facts(loaded.test), trial, threads)));
    });
    return text;
  });
}

}  // namespace dem
