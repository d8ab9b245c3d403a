#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every line and branch of kernel/src is reached by a test, but for coverage_exceptions.txt beside
# this script.
# Prints the totals and what is missing, and exits 0 when nothing is.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# Tests that take seconds, and together reach all there is.
programs=(
  unit_create unit_determinism unit_math unit_organ_open unit_state unit_surface
  fuzz_organ fuzz_tick stylet-simulator
  coupling_friction coupling_pools coupling_relaxation coupling_continuity coupling_abuse
  fidelity_cluster fidelity_needle_abuse fidelity_needle_contact obstacle_contact
  insertion_bone insertion_layers insertion_several insertion_steering rt_memory
)
arguments_of() {
  case $1 in
    fuzz_*) echo "$root/tests/fuzz/seeds/${1#fuzz_}" ;;
    stylet-simulator) echo --seed 2 --sessions 20 ;;
  esac
}

use_preset coverage
configure
compile "${programs[@]}"
say "Running ${#programs[@]} test programs"
rm -rf "$build/profiles"
objects=()
for program in "${programs[@]}"; do
  objects+=(-object "$build/bin/$program")
  # shellcheck disable=SC2046
  LLVM_PROFILE_FILE="$build/profiles/$program.profraw" \
    "$build/bin/$program" $(arguments_of "$program") >"$build/$program.log" 2>&1 ||
    die "$program failed" "Its output: $build/$program.log"
done
llvm-profdata merge -sparse -o "$build/all.profdata" "$build"/profiles/*.profraw
llvm-cov export -format=lcov -instr-profile="$build/all.profdata" "${objects[@]}" \
  "$root/kernel/src" >"$build/kernel.lcov" 2>"$build/llvm-cov.log"
say "Coverage of kernel/src"
python3 "$root/toolchain/coverage.py" "$build/kernel.lcov" "$root/kernel/src" \
  "$root/toolchain/coverage_exceptions.txt"
