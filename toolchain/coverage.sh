#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every line and branch of kernel/src is reached by a test, but for coverage_exceptions.txt beside
# this script.
# Prints the totals and what is missing, and exits 0 when nothing is.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# Tests that together reach all there is: a minute or two.
programs=(
  unit_create unit_math unit_organ_open unit_state unit_surface unit_edges unit_c_api unit_odd_organ
  coupling_continuity coupling_pools fidelity_cluster fidelity_needle_shape fuzz_organ fuzz_tick
  insertion_bone insertion_felt insertion_layers insertion_roll insertion_several obstacle_contact
  obstacle_gap rt_team stylet-simulator unit_sheets unit_snapshot
)
arguments_of() {
  case $1 in
    fuzz_*) echo "$root/tests/fuzz/seeds/${1#fuzz_}" ;;
    insertion_felt) echo --gtest_filter=Felt.* ;;
    stylet-simulator) echo --seed 2 --sessions 6 ;;
  esac
}

# llvm-cov asks for sources by their whole paths.
unset CCACHE_BASEDIR
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
# The first object goes without the option.
llvm-cov export -skip-expansions -skip-functions -instr-profile="$build/all.profdata" \
  "${objects[@]:1}" "$root/kernel/src" >"$build/kernel.json" 2>"$build/llvm-cov.log" ||
  die "llvm-cov failed" "$(head -n 3 "$build/llvm-cov.log")"
say "Coverage of kernel/src"
python3 "$root/toolchain/coverage.py" "$build/kernel.json" "$root/kernel/src" \
  "$root/toolchain/coverage_exceptions.txt"
