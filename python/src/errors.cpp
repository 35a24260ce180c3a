// SPDX-License-Identifier: BSD-3-Clause
#include "errors.hpp"

#include <pybind11/stl.h>

#include <exception>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

namespace py = pybind11;

void raise(const Error& error, const std::vector<std::string>& problems) {
  const py::object make = py::module_::import("dem4grm.errors").attr("error_of");
  const py::object raised = make(static_cast<int>(error.code()), std::string(error.what()), problems);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(raised.ptr())), raised.ptr());
}

}  // namespace

void translate_errors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    if (!thrown) return;
    try {
      std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise(error, error.problems);
    } catch (const Error& error) {
      raise(error, {});
    }
  });
}

}  // namespace dem
