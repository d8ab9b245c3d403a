#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tiers of checks, each with all of the one before. Exits 0 when everything passes.
#
#   fast    what CI runs: test.sh
#   full    tests with the ctest label `full`; the fast tests once more with clang and under each
#           sanitizer
#   night   tests with the ctest label `night`
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tier=${1:-}
[[ $# -eq 1 && $tier =~ ^(fast|full|night)$ ]] ||
  die "expected one of the tiers fast, full, night" "For example: toolchain/check.sh full"

"$root/toolchain/test.sh"
[ "$tier" != fast ] || exit 0
run_tests -L '^full$' --no-tests=ignore
for other in clang sanitize sanitize-threads; do
  use_preset "$other"
  configure
  compile
  run_tests -LE '^(full|night)$'
done
[ "$tier" != full ] || exit 0
use_preset release
run_tests -L '^night$' --no-tests=ignore
