// SPDX-License-Identifier: BSD-3-Clause
// A key given on the command line (--set) instead of in the case file.
#pragma once

#include <string>

namespace dem {

/// `--set specimen.rubber_content=0.4`: the value is written as in the file; quotes around text may be left out.
struct Override {
  std::string key;
  std::string value;
};

}  // namespace dem
