// SPDX-License-Identifier: BSD-3-Clause
// Errors of the library as exceptions of Python: dem4grm/errors.py holds their classes.
#pragma once

#include <pybind11/pybind11.h>

namespace dem {

/// From now on every error that leaves a function of the module becomes the class of its exit code, with the message that the
/// command line prints.
void translate_errors();

}  // namespace dem
