#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tiers of checks, each with all of the one before. Exits 0 when everything passes.
#
#   fast    what CI runs: test.sh
#   full    tests with the ctest label `full`; the fast tests once more with clang and under each
#           sanitizer
#   night   tests with the ctest label `night`
#
# `full` and `night` also bring the README's table of promises up to date.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tier=${1:-}
[[ $# -eq 1 && $tier =~ ^(fast|full|night)$ ]] ||
  die "expected one of the tiers fast, full, night" "For example: toolchain/check.sh full"

short=(-LE '^(full|night)$')

# again PRESET [CTEST_ARGUMENT...]: the short tests in another build.
again() {
  use_preset "$1"
  shift
  configure
  compile
  run_tests "${short[@]}" "$@"
}

note_results() { python3 "$root/toolchain/promises.py" "$root" "$build"; }

"$root/toolchain/test.sh"
[ "$tier" != fast ] || exit 0
note_results
run_tests -L '^full$' --no-tests=ignore
note_results
again clang -E '^(cross|rt\.determinism)'         # they choose their compilers themselves
again sanitize -E 'ripple|calculix'               # the longest, of code that others run too
again sanitize-threads -R '^(hal|rt_|simulator|console)'  # the others have one thread
[ "$tier" != full ] || exit 0
use_preset release
run_tests -L '^night$' --no-tests=ignore
note_results
