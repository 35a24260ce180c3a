// SPDX-License-Identifier: BSD-3-Clause
// Can this process have so many threads? The OpenMP runtime ends the program when it cannot start one.
#pragma once

namespace dem {

/// How many threads of `wanted`, the calling one included, can live at a time; starts and ends the others.
int possible_threads(int wanted);

}  // namespace dem
