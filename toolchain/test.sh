#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs missing packages, builds everything, and runs all tests except the long ones, which
# check.sh runs. Exits 0 when all pass. Arguments go to ctest: toolchain/test.sh -R rt
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$root/toolchain/setup.sh" test
configure -DSTYLET_WITH_TESTS=ON  # demo.sh may have left them out
compile
run_tests -LE '^(full|night)$' "$@"
