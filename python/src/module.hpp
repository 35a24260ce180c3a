// SPDX-License-Identifier: BSD-3-Clause
// The topics of the extension module; each function adds the classes and functions of one file.
#pragma once

#include <pybind11/pybind11.h>

namespace dem {

void bind_cases(pybind11::module_& m);
void bind_runs(pybind11::module_& m);
void bind_campaigns(pybind11::module_& m);
void bind_analysis(pybind11::module_& m);
void bind_verification(pybind11::module_& m);
void bind_simulation(pybind11::module_& m);

}  // namespace dem
