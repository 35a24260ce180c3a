// SPDX-License-Identifier: BSD-3-Clause
// A key given outside the case file: on the command line (--set), or by a study.
#pragma once

#include <string>
#include <string_view>

namespace dem {

/// `--set specimen.rubber_content=0.4`: the value is written as in the file; quotes around text may be left out.
struct Override {
  std::string key;
  std::string value;
  std::string_view origin = "--set";  ///< how messages introduce it
};

}  // namespace dem
