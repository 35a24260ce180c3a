// SPDX-License-Identifier: BSD-3-Clause
// The statics of one grain of the verification suite, for the tests too.
#pragma once

#include "dem4grm/verify/grain_statics.hpp"
#include "support/scene_builder.hpp"
