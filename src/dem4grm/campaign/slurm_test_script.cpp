// SPDX-License-Identifier: BSD-3-Clause
// The shell script that runs one test under a scheduler.
#include <fmt/format.h>

#include "dem4grm/campaign/slurm_scripts.hpp"

namespace dem {
namespace {

constexpr const char* k_body = R"sh(
# One test of the campaign, from its case to its end, however often it is interrupted:
#
#   run_test.sh NAME            runs the test
#   run_test.sh NAME specimen   makes its specimen, so that other tests find the preparation that they share
#
# Slurm sends SIGUSR1 ahead of the time limit: the program saves its state, and the job puts itself back into the queue.
# SIGTERM (scancel, or a node that is needed) saves too, and leaves the rest to who sent it. Other schedulers: have
# them send SIGUSR1 or SIGTERM, and start this script again when it ends with 75. Exit codes are those of dem4grm.
set -u
name=$1
verb=${2:-run}
program=${DEM4GRM:-$default_program}
threads=${SLURM_CPUS_PER_TASK:-${THREADS:-1}}
wait_for_folder=${WAIT_FOR_FOLDER:-30}   # s, between two tries when another process is still at work in the folder
test_folder=$folder/tests/$name
log=$folder/logs/$name.log
marks=$folder/slurm/marks
mkdir -p "$folder/logs" "$marks"

reason=none child=0
ask_for_end() {
  # Only once: a second request would end the program without its state.
  [[ $reason == none && $child -ne 0 ]] && kill -TERM "$child" 2>/dev/null
  reason=$1
}
trap 'ask_for_end limit' USR1
trap 'ask_for_end end' TERM INT

# A batch job has a log of its own for each start; what the program said goes to the log of the test.
say() { echo "$(date -u +%FT%TZ) $name: $*"; }

run_once() {
  code=75
  [[ $reason != none ]] && return   # asked to end before it began
  "$program" "$verb" "$folder/cases/$name.toml" -o "$test_folder" "${store[@]}" -j "$threads" -q \
    </dev/null >/dev/null 2>"$log" &
  child=$!
  [[ $reason != none ]] && kill -TERM "$child" 2>/dev/null
  # A signal ends `wait` early; then the code is that of the signal and not of the program.
  code=1
  while true; do
    wait "$child"
    local status=$?
    [[ $status -eq 127 ]] && break
    code=$status
    kill -0 "$child" 2>/dev/null && continue
    wait "$child" 2>/dev/null
    status=$?
    [[ $status -ne 127 ]] && code=$status
    break
  done
  child=0
}

# Where the test stands, in words; the same words after three restarts mean that the time limit is too short.
place() { grep -E '"(stage|step|displacement_mm)"' "$test_folder/status.json" 2>/dev/null | tr -d ' \n'; }

put_back() {
  local mark=$marks/$name.$verb now count=0
  now=$(place)
  [[ -f $mark && "$(head -n 1 "$mark")" == "$now" ]] && count=$(tail -n 1 "$mark")
  count=$((count + 1))
  printf '%s\n%s\n' "$now" "$count" >"$mark"
  if [[ $count -gt 3 ]]; then
    say "three restarts brought it no further: the time limit is too short for it" | tee -a "$log"
    exit 75
  fi
  if [[ -z ${SLURM_JOB_ID:-} ]]; then
    say "stopped at the time limit; the same command goes on"
    exit 75
  fi
  # The number of one element of an array is also that of the whole array, whose other elements must stay as they are.
  local job=$SLURM_JOB_ID
  [[ -n ${SLURM_ARRAY_TASK_ID:-} && -n ${SLURM_ARRAY_JOB_ID:-} ]] && job=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID
  say "stopped at the time limit; goes back into the queue"
  scontrol requeue "$job" || exit 75
  sleep 60   # Slurm ends this script
  exit 75
}

# A grain compression prepares nothing and takes no store.
store=(--store "$folder/store")
grep -q '^test *= *"grain_compression"' "$folder/cases/$name.toml" && store=()

# The specimen is there already: nothing to prepare.
[[ $verb == specimen && -e $test_folder/specimen.h5 ]] && exit 0

say "$verb, start ${SLURM_RESTART_COUNT:-0}, on $(hostname)"
while true; do
  run_once
  # 143: asked in its first moments, before it listens.
  [[ $reason == limit && ( $code -eq 75 || $code -eq 143 ) ]] && put_back
  [[ $code -eq 73 && $reason == end ]] && exit 75
  [[ $code -ne 73 ]] && break
  # The scheduler may believe a node dead whose processes live on.
  [[ $reason == limit ]] && put_back
  say "another process is at work in $test_folder; tried again in $wait_for_folder s"
  sleep "$wait_for_folder" & wait $!
done
say "ended with $code"
# A preparation that failed says so when its own test runs; the tests that wait for it must begin all the same.
[[ $verb == specimen ]] && exit 0
exit "$code"
)sh";

}  // namespace

std::string slurm_test_script(const SlurmPlaces& places) {
  return fmt::format("#!/usr/bin/env bash\n# Written by dem4grm campaign run.\nfolder={}\ndefault_program={}\n{}",
                     shell_quoted(places.folder.string()), shell_quoted(places.program.string()), k_body);
}

}  // namespace dem
