#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every check of the project, in the order in which a failure is cheapest; stops at the first one.
#
#   ./test.sh        all: style, release build, fast and slow tests, memory and undefined behaviour, data races,
#                    static analysis
#   ./test.sh fast   style, release build, fast tests
#
# Safe to repeat: what is built or analysed already is not built or analysed again. All that is written lies in build/.
set -euo pipefail
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")"

scope=${1:-all}
if [[ $# -gt 1 || ! "$scope" =~ ^(all|fast)$ ]]; then
  echo "usage: ./test.sh [all|fast]" >&2
  exit 64
fi

n_jobs=$(nproc)
release=build/release asan=build/asan tsan=build/tsan-clang
logs=build/logs
# Threads that wait must not hold a core that another test could use.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive} KMP_BLOCKTIME=${KMP_BLOCKTIME:-0}
# The sanitizer builds keep assertions on, those of the standard library too; -O1 -g1 compiles a third faster than
# -O2 -g.
checked_flags="-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -D_GLIBCXX_ASSERTIONS"
# A finding of the undefined-behaviour sanitizer must fail the test, which is not its default.
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
# docs/decisions/0003-thread-sanitizer.md says why clang, why this library and why these options.
export TSAN_OPTIONS=ignore_noninstrumented_modules=1:history_size=7:halt_on_error=1:exitcode=66
TSAN_OPTIONS+=:external_symbolizer_path=/usr/lib/llvm-14/bin/llvm-symbolizer
export OMP_TOOL_LIBRARIES=/usr/lib/llvm-14/lib/libarcher.so

# ---- phases: timed, listed in a table at the end, whatever the end -------------------------------------------------
phase_names=() phase_times=() phase_results=()
current=""
phase() {
  current=$1
  phase_start=$SECONDS
  echo
  echo "== test.sh: $current"
  "${@:2}"
  record passed
  current=""
}
record() {
  phase_names+=("$current")
  phase_times+=("$((SECONDS - phase_start))")
  phase_results+=("$1")
}
# shellcheck disable=SC2317  # called by the trap
summary() {
  local status=$? index n_tests=0 n_failed=0 log failed total
  [[ -z "$current" ]] || record FAILED
  echo
  printf '%-44s %7s  %s\n' "phase" "seconds" "result"
  for index in "${!phase_names[@]}"; do
    printf '%-44s %7d  %s\n' "${phase_names[$index]}" "${phase_times[$index]}" "${phase_results[$index]}"
  done
  for log in "$logs"/*.ctest; do
    [[ -f "$log" ]] || continue
    while read -r failed total; do
      n_tests=$((n_tests + total))
      n_failed=$((n_failed + failed))
    done < <(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests\{0,1\} failed out of \([0-9]*\)$/\1 \2/p' "$log")
  done
  echo "$((n_tests - n_failed)) passed, $n_failed failed"
  if [[ $status -eq 0 ]]; then
    echo "test.sh $scope: everything passed in $SECONDS s"
  else
    echo "test.sh $scope: FAILED in '${current:-start}' after $SECONDS s; the lines above the table say why"
  fi
}
trap summary EXIT
trap 'exit 130' INT TERM
mkdir -p "$logs"
rm -f "$logs"/*.ctest

# ---- what the phases do --------------------------------------------------------------------------------------------
cpp_files() {
  local folder
  for folder in src apps tests bench python; do
    [[ ! -d $folder ]] || find "$folder" -name '*.cpp' -o -name '*.hpp'
  done | sort
}

check_style() {
  local check
  for check in tools/check_*.py; do /usr/bin/python3 "$check"; done
  cpp_files | xargs -r -n 16 -P "$n_jobs" clang-format-14 --dry-run --Werror
  echo "clang-format: $(cpp_files | wc -l) files as they should be"
}

configure() {
  local log=$logs/configure-$1.log
  cmake --preset "$1" -B "$2" -DDEM4GRM_UNITY=ON "${@:3}" >"$log" 2>&1 || { cat "$log"; return 1; }
}

build() { cmake --build "$1" --parallel "$n_jobs" "${@:2}"; }

# The log is named apart for each run, so that the tests can be counted. One test more than there are cores: the longest of them wait
# most of their time, for a scheduler or a browser.
run_tests() {
  local folder=$1 name=$2
  ctest --test-dir "$folder" -j"$((n_jobs + 1))" --output-on-failure --timeout 600 "${@:3}" | tee "$logs/$name.ctest"
}

release_build() {
  tools/build_page.sh
  configure release "$release" -DDEM4GRM_BUILD_PYTHON=ON
  build "$release"
}

# Those of the named test programs for which the tree holds sources.
present() {
  local suite
  for suite in "$@"; do
    [[ -z "$(find "tests/$suite" -name '*.cpp' 2>/dev/null)" ]] || echo "test_$suite"
  done
}

sanitizer_build() {
  local targets
  mapfile -t targets < <(present unit physics determinism property)
  configure asan "$asan" "$checked_flags"
  [[ ${#targets[@]} -eq 0 ]] || build "$asan" --target "${targets[@]}"
}
# Programs that were not built carry no label; scripts and style do not change with a sanitizer.
sanitizer_tests() { run_tests "$asan" asan -L fast -LE 'script|style' --no-tests=ignore; }

# First the control experiment: a detector that reports a clean program, or misses a planted race, proves nothing.
thread_control() {
  local program=$tsan/control kind status
  mkdir -p "$tsan"
  clang++-14 -std=c++20 -O1 -g -fopenmp -fsanitize=thread -o "$program" \
    tests/scripts/thread_sanitizer_control.cpp
  # Some kernels spread memory wider than this sanitizer knows; then everything runs without address randomisation.
  fixed_addresses=()
  if OMP_NUM_THREADS=4 "$program" clean 2>&1 | grep -q 'unexpected memory mapping'; then
    fixed_addresses=(setarch "$(uname -m)" -R)
  fi
  for kind in clean add order late; do
    status=0
    OMP_NUM_THREADS=4 "${fixed_addresses[@]}" "$program" "$kind" >"$logs/tsan-$kind.log" 2>&1 || status=$?
    if [[ $status -ne $([[ $kind == clean ]] && echo 0 || echo 66) ]]; then
      cat "$logs/tsan-$kind.log"
      echo "control '$kind' ended with $status: the thread sanitizer does not work here"
      return 1
    fi
    echo "control '$kind': as expected"
  done
}

thread_build() {
  local targets
  thread_control
  mapfile -t targets < <(present determinism)
  configure tsan "$tsan" -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 -DDEM4GRM_WERROR=OFF \
    "$checked_flags"
  [[ ${#targets[@]} -eq 0 ]] ||
    "${fixed_addresses[@]}" cmake --build "$tsan" --parallel "$n_jobs" --target "${targets[@]}"
}
thread_tests() {
  "${fixed_addresses[@]}" ctest --test-dir "$tsan" -j"$n_jobs" --output-on-failure --timeout 600 -L fast -LE 'script|style' \
    --no-tests=ignore | tee "$logs/tsan.ctest"
}

static_analysis() { tools/static_analysis.py "$release" --jobs "$n_jobs"; }

# ---- the order -----------------------------------------------------------------------------------------------------
phase "install what is missing" tools/install_dependencies.sh test
phase "style" check_style
phase "release build" release_build
phase "fast tests" run_tests "$release" fast -L fast -LE style --no-tests=error
if [[ $scope == all ]]; then
  phase "slow tests" run_tests "$release" slow -L slow --no-tests=ignore
  phase "long verification cases" run_tests "$release" full -L full --no-tests=ignore
  phase "address and undefined behaviour: build" sanitizer_build
  phase "address and undefined behaviour: tests" sanitizer_tests
  phase "data races: control and build" thread_build
  phase "data races: tests" thread_tests
  phase "static analysis" static_analysis
fi
