// SPDX-License-Identifier: BSD-3-Clause
// The verification suite.
#include <omp.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "beside.hpp"
#include "dem4grm/report/verification_manual.hpp"
#include "module.hpp"

namespace dem {

void bind_verification(pybind11::module_& m) {
  namespace py = pybind11;
  m.def("verification_cases", [] {
    py::list all;
    for (const VerificationCase& c : verification_cases()) {
      all.append(py::make_tuple(c.name, c.title, c.extent == Extent::quick));
    }
    return all;
  });
  // One case at a time, so that Ctrl-C is heard between two of them.
  m.def("verify_case", [](const std::string& name, int threads) {
    std::string text;
    const std::vector<const VerificationCase*> chosen = select_cases({name}, Extent::full);
    run_beside([&] {
      omp_set_num_threads(threads);
      const std::vector<CaseOutcome> outcomes{run_case_of_suite(*chosen.front())};
      text = json_text(verification_json(outcomes));
    });
    return text;
  });
}

}  // namespace dem
