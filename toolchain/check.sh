#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tiers of checks; each includes the tiers before it. Exits 0 when everything passes.
#
#   fast    what CI runs: test.sh
#   full    tests with the ctest label `full`; the tests of a needle in tissue with the kernel's
#           assertions; the fast tests again, with clang under the address and undefined-behaviour
#           sanitizers, and with gcc under the thread sanitizer
#   night   tests with the ctest label `night`
#
# `full` and `night` continue after a failure, report at the end what passed and what failed, and
# update the README's table of promises.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tier=${1:-}
[[ $# -eq 1 && $tier =~ ^(fast|full|night)$ ]] ||
  die "expected one of the tiers fast, full, night" "For example: toolchain/check.sh full"

short=(-LE '^(full|night)$')
summary=()
failed=0

# part WHAT PRESET COMMAND...: runs COMMAND with that preset and notes the result for the summary.
part() {
  local what=$1 verdict=passed tests='' start=$SECONDS begin
  use_preset "$2"
  begin=$(mktemp)
  ("${@:3}") || {
    verdict=FAILED
    failed=$((failed + 1))
    tests=$(find "$build/Testing/Temporary" -name LastTestsFailed.log -newer "$begin" \
      -exec sed 's/^[0-9]*:/                  /' {} + 2>/dev/null) || true
  }
  rm "$begin"
  what=$(printf '%s %4d min  %s' "$verdict" $(((SECONDS - start + 59) / 60)) "$what")
  summary+=("$what${tests:+$'\n'$tests}")
}

# again [CTEST_ARGUMENT...]: runs the short tests in the build of the current preset.
again() {
  configure
  compile
  run_tests "${short[@]}" "$@"
}

# Unlike the sanitizers' builds, which assert as well, this one is optimised: it leaves out no test.
asserted() {
  configure
  compile needle_tests
  run_tests "${short[@]}" -R '^(coupling|insertion)_'
}

labelled() { run_tests -L "^$1\$" --no-tests=ignore; }

[ "$tier" != fast ] || exec "$root/toolchain/test.sh"
"$root/toolchain/setup.sh" full
part "fast tests" release "$root/toolchain/test.sh"
part "full tests" release labelled full
part "tests of a needle in tissue, with the kernel's assertions" invariants asserted
# Left out: scripts, tests that choose their compilers themselves, and the longest tests, whose code
# other tests run, too.
scripts='check|rt_host|cross|rt\.determinism|fuzz\.short'
part "fast tests with clang, under the address and undefined-behaviour sanitizers" \
  sanitize again -E "^($scripts|bench|offline\.cohort|coupling_energy)|ripple|calculix"
# Only tests with several threads: all others, and those excluded by -E, have one.
part "fast tests under the thread sanitizer" \
  sanitize-threads again -R '^(hal|rt_team|console)|InTwoThreads' \
  -E '^hal_(coupling|steered)|NoHelperComes'
[ "$tier" = full ] || part "night tests" release labelled night

use_preset release
python3 "$root/toolchain/promises.py" "$root" "$build"
say "Tier $tier"
for line in "${summary[@]}"; do note "$line"; done
[ $failed -eq 0 ] || die "$failed of ${#summary[@]} parts failed"
