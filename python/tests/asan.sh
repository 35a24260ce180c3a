#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The extension module under the address and undefined-behaviour sanitizers: builds it in build/asan, which test.sh has too, and runs
# its tests with the sanitizer's library in front of the interpreter. Ten minutes from scratch, so test.sh leaves it out.
set -euo pipefail
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
cmake --preset asan -B build/asan -DDEM4GRM_UNITY=ON -DDEM4GRM_BUILD_PYTHON=ON \
  "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -D_GLIBCXX_ASSERTIONS"
cmake --build build/asan --parallel "$(nproc)" --target dem4grm_python
ctest --test-dir build/asan --output-on-failure -L python-asan
