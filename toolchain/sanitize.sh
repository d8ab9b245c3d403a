#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests under clang's address and undefined-behaviour sanitizers what reads bytes from outside, what
# is between a force and a hand, and the processes beside a run (recorder, OpenIGTLink, the
# console's server). This is the part of check.sh's tier `full` that CI has time for. The readers of
# all formats run under the sanitizers in fuzz.short.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

programs=(
  unit_organ_open unit_odd_organ unit_sheets unit_state unit_snapshot unit_create
  hosts_c_simulation hosts_c_loop coupling_abuse hal_scene hal_packet hal_guard hal_motor
  hal_recording hal_side console
)
# Phantoms come from a program without sanitizers, because CGAL takes long to compile with them.
[ -x "$root/build/release/bin/stylet-organ" ] || { configure && compile stylet-organ; }
export STYLET_ORGAN=$root/build/release/bin/stylet-organ
use_preset sanitize
configure
! grep -q '^STYLET_IGTL_LIBRARY:[A-Z]*=/' "$build/CMakeCache.txt" || programs+=(hal_igtl)
compile "${programs[@]}" stylet
names=$(printf '|%s' "${programs[@]}")
# Left out: tests that end by a signal, because the sanitizers handle signals; and long tests.
left_out='PagesOfSomebodyElse|V25Abuse(Long)?[.]'
run_tests -LE '^(full|night)$' -R "^((${names:1})\.|e2e\.process\.Killed$)" -E "$left_out" "$@"
