#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to the finished demonstration: installs what is missing, builds, runs cases/quick.toml.
#
#   ./run.sh [options of `dem4grm run`]
#
# Safe to repeat: a second call installs and builds nothing, and the program continues an interrupted run or says
# that it is complete. Paths in the options count from the folder of this script.
set -euo pipefail
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")"

case_file=cases/quick.toml
output=runs/quick
build=build/run

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '3,8s/^# \{0,1\}//p' run.sh
  exit 0
fi

phase=0
begin() {
  phase=$((phase + 1))
  phase_name=$1
  phase_start=$SECONDS
  echo "== run.sh $phase/4: $phase_name"
}
finish() { echo "== run.sh $phase/4: $phase_name took $((SECONDS - phase_start)) s"; }

begin "install what is missing"
tools/install_dependencies.sh build
finish

begin "make the report page, configure"
tools/build_page.sh
cmake --preset release -B "$build" -DDEM4GRM_BUILD_TESTS=OFF -DDEM4GRM_UNITY=ON
finish

begin "build"
cmake --build "$build" --parallel "$(nproc)"
finish

# The program takes the place of this script, so that a stop request reaches it directly and it can save its state;
# what it prints, its run time among it, is the end of the output. It chooses its own OpenMP settings where
# OMP_PROC_BIND and OMP_WAIT_POLICY are unset.
begin "run $case_file, results in $output (installing and building took $SECONDS s)"
mkdir -p "$(dirname -- "$output")"
exec "$build/apps/dem4grm/dem4grm" run "$case_file" -o "$output" "$@"
