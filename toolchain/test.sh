#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds everything, runs every test. Exits 0 when all of them pass.
# Arguments go to ctest: toolchain/test.sh -R rt
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$root/toolchain/setup.sh"
configure
compile
say "Testing"
ctest --test-dir "$build" --output-on-failure -j 2 "$@" || {
  status=$?
  die "some tests failed; they are listed above" \
    "One of them again, with its output:  ctest --test-dir ${build#"$root"/} -V -R NAME" \
    "The whole log: $build/Testing/Temporary/LastTest.log (ctest exit code $status)"
}
