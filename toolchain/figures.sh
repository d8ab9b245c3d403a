#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes every figure and table of the READMEs again, each with its own command.
#
#   figures.sh           all that this machine can make in minutes: scenes, page, offline, calculix,
#                        validation, paper, published
#   figures.sh NAME...   only these
#   figures.sh --list    lists which command makes which
#   figures.sh --check   lists pictures that differ from what scenes do now; a test does this, too
#
# Only by name: `speed`, which is wrong if the machine does other work; `constants`, which takes
# long; and `promises`, which runs every test.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

names=(scenes page offline calculix validation paper published growth speed constants promises)
usual=(scenes page offline calculix validation paper published)
declare -A makes=(
  [scenes]="hal/scenes/pictures/*.svg"
  [page]="hal/console/pictures/*.png"
  [offline]="offline/docs/quality.md: table of real organs"
  [calculix]="tests/fidelity/calculix/convergence.svg"
  [validation]="toolchain/book/figures/[bc]*.svg"
  [paper]="toolchain/book/figures/paper.svg, toolchain/book/paper.md: its table"
  [published]="toolchain/book/figures/published.svg"
  [growth]="tests/bench/results/growth.svg"
  [speed]="tests/bench/results/*.csv, tests/bench/README.md: tables"
  [constants]="kernel/constants.md"
  [promises]="README.md: table of promises"
)
declare -A commands=(
  [scenes]="hal/scenes/play.py --pictures"
  [page]="hal/console/pictures.py"
  [offline]="offline/figures.py $build/bin/stylet-organ ${STYLET_DATA:-../shared/data}"
  [calculix]="tests/fidelity/calculix/plot.py $build/bin/stylet_calculix_lattice"
  [validation]="tests/fidelity/figures.py $build toolchain/book/figures"
  [paper]="tests/fidelity/paper.py $build"
  [published]="PYTHONPATH=$build/python offline/python/examples/calibrate.py \
             toolchain/book/figures/published.svg"
  [growth]="tests/bench/growth.py $build/bin/stylet-work --out tests/bench/results"
  [speed]="$build/bin/stylet bench --results=tests/bench/results &&
           tests/bench/table.py tests/bench/results tests/bench/README.md"
  [constants]="toolchain/sensitivity.py"
  [promises]="toolchain/check.sh full"
)

cd "$root"
case ${1:-} in
  --list)
    for name in "${names[@]}"; do
      command=$(tr -s ' \n' ' ' <<<"${commands[$name]//"$root/"/}")
      printf '%-9s %s\n          %s\n' "$name" "${makes[$name]}" "$command"
    done
    exit
    ;;
  --check) exec hal/scenes/shown.py ;;
esac
for name in "$@"; do
  [ -n "${commands[$name]:-}" ] ||
    die "$name: no such figure" "Expected some of: ${names[*]}"
done
[ $# -gt 0 ] || set -- "${usual[@]}"
for name in "$@"; do
  say "${makes[$name]}"
  bash -c "${commands[$name]}" || die "$name: its command failed: ${commands[$name]}"
done
