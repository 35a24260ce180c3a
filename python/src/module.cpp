// SPDX-License-Identifier: BSD-3-Clause
// dem4grm._core: the library as Python sees it. What a user calls is in the modules of python/dem4grm, which are made of this.
#include "module.hpp"

#include <omp.h>

#include <string>

#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/version.hpp"
#include "errors.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The library of DEM4GRM; use the package dem4grm, which is made of it.";
  m.attr("version") = dem::k_version;
  m.attr("commit") = dem::k_commit;
  m.attr("compiler") = std::string(dem::k_compiler) + ", " + dem::k_build_type;
  m.def("kernel_target", [] { return std::string(dem::kernel_target()); });
  m.def("processors", [] { return omp_get_num_procs(); });
  dem::translate_errors();
  dem::bind_cases(m);
  dem::bind_runs(m);
  dem::bind_campaigns(m);
  dem::bind_analysis(m);
  dem::bind_verification(m);
  dem::bind_simulation(m);
}
