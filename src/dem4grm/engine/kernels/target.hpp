// SPDX-License-Identifier: BSD-3-Clause
// The hot loops are compiled once for each kind of processor, in a namespace of its own: dem::v2, dem::v3, dem::v4 for
// the levels of x86-64, dem::plain where there is one kind only. CMake names the target (cmake/KernelTargets.cmake).
#pragma once

#ifndef DEM_TARGET
#define DEM_TARGET plain
#endif
