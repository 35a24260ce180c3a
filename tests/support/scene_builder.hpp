// SPDX-License-Identifier: BSD-3-Clause
// The small scenes of the verification suite, for the tests too.
#pragma once

#include "dem4grm/verify/scenes.hpp"

namespace dem::test {
using namespace dem::verify;
}
