#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Finds lines and branches of kernel/src or offline/src that no test reaches. Left out are those in
# coverage_exceptions.txt and coverage_exceptions_offline.txt beside this script, with reasons.
# There are no others, as the tests coverage.kernel and coverage.offline check.
# Prints the totals and what is missing, and exits 0 if nothing is missing.
#
# usage: coverage.sh [kernel|offline]      (default: kernel)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

subject=${1:-kernel}
# Tests that together reach all code of a subject. Scripts run stylet-organ.
case $subject in
  kernel)
    programs=(
      unit_create unit_laws unit_math unit_organ_open unit_state unit_surface unit_edges
      unit_odd_organ unit_sheets unit_snapshot unit_sparse_organ coupling_abuse coupling_aside
      coupling_continuity coupling_friction coupling_pools coupling_stiffness fidelity_cluster
      fidelity_needle_abuse fidelity_needle_shape fuzz_organ fuzz_snapshot fuzz_tick insertion_bone
      insertion_felt insertion_layers insertion_roll insertion_several obstacle_contact obstacle_gap
      rt_team stylet-simulator
    )
    scripts=()
    exceptions=$root/toolchain/coverage_exceptions.txt
    ;;
  offline)
    programs=(
      stylet-organ fuzz_label fuzz_mesh fuzz_recipe fuzz_tissues
      offline_reader_test offline_solid_test offline_nesting_test offline_organ_test
      offline_wrap_test offline_exact_test
      offline_damage_test offline_hull_test offline_label_format_test offline_label_test
      offline_losses_test offline_program_test offline_quality_test
    )
    scripts=(dicom dicom_conformance dicom_numbers dicom_objects label_frame outputs every_file)
    exceptions=$root/toolchain/coverage_exceptions_offline.txt
    ;;
  *) die "'$subject': expected kernel or offline" "For example: toolchain/coverage.sh offline" ;;
esac
arguments_of() {
  case $1 in
    fuzz_*) echo "$root/tests/fuzz/seeds/${1#fuzz_}" ;;
    coupling_stiffness) echo --gtest_filter=Stiffness.ThinSkin* ;;
    insertion_felt) echo --gtest_filter=Felt.* ;;
    every_file) echo LabelMaps Meshes OrganFiles ;;
    stylet-simulator) echo --seed 2 --sessions 6 ;;
    stylet-organ) echo --help ;;
  esac
}

# watched NAME: runs a program or a script; its counts are added to those of other runs.
watched() {
  local command=("$build/bin/$1")
  [ -x "${command[0]}" ] || command=(/usr/bin/python3 "$root/tests/offline/$1_test.py")
  # shellcheck disable=SC2046
  LLVM_PROFILE_FILE="$build/profiles/%m.profraw" "${command[@]}" $(arguments_of "$1") \
    >"$build/$1.log" 2>&1 || die "$1 failed" "Its output: $build/$1.log"
}

one_ends() {
  wait -n || { wait; exit 1; }
  running=$((running - 1))
}

# A clock says nothing of a program that counts its lines (tests/CMakeLists.txt: TIMED).
export GTEST_FILTER='-*Timed.*'
# llvm-cov needs absolute paths of sources.
unset CCACHE_BASEDIR
use_preset coverage
configure
compile "${programs[@]}"
say "Running $((${#programs[@]} + ${#scripts[@]})) test programs"
rm -rf "$build/profiles"
export STYLET_BIN=$build/bin STYLET_SOURCE=$root
objects=() running=0
for program in "${programs[@]}"; do objects+=(-object "$build/bin/$program"); done
# Two at a time; the first that fails ends this script, when the other one is through.
for test in "${programs[@]}" "${scripts[@]}"; do
  if ((running == 2)); then one_ends; fi
  watched "$test" &
  running=$((running + 1))
done
while ((running > 0)); do one_ends; done
llvm-profdata merge -sparse -o "$build/all.profdata" "$build"/profiles/*.profraw
# llvm-cov takes the first object without an option.
llvm-cov export -skip-expansions -skip-functions -instr-profile="$build/all.profdata" \
  "${objects[@]:1}" "$root/$subject/src" >"$build/$subject.json" 2>"$build/llvm-cov.log" ||
  die "llvm-cov failed" "$(head -n 3 "$build/llvm-cov.log")"
say "Coverage of $subject/src"
python3 "$root/toolchain/coverage.py" "$build/$subject.json" "$root/$subject/src" "$exceptions"
