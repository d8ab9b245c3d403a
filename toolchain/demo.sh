#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a fresh clone to a force curve: installs missing packages, builds a release, makes the
# default organ, and inserts a needle into it in the real-time loop, as in Fig. 9 of the paper.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

out=$root/build/demo
organ=$out/liver-phantom.organ
recording=$out/fig09.h5
scene=$root/hal/scenes/fig09-force-curve.toml

# Runs in the real-time loop; with sudo if this user lacks the rights for it; without the rights if
# nobody can get them; on a virtual clock if the machine is then too late.
run_insertion() {
  local run=("$stylet" run "$scene" --organ "$organ" --force --record "$recording")
  local unfit=4 trouble=3 status=0
  rm -f "$recording"
  "${run[@]}" || status=$?
  if [ $status -eq $unfit ] && [ "$(id -u)" -ne 0 ] && sudo -n true 2>/dev/null; then
    say "Once more through sudo, which has these rights"
    status=0
    sudo -n "${run[@]}" || status=$?
    [ ! -e "$recording" ] || sudo -n chown "$(id -u):$(id -g)" "$recording"
  fi
  if [ $status -eq $unfit ]; then
    say "Once more without these rights: the timing is only a hint, the forces are the same"
    status=0
    "${run[@]}" --allow-non-rt || status=$?
  fi
  if [ $status -eq $trouble ]; then
    say "This host was too late, so the guard let go; the same insertion on a virtual clock"
    status=0
    "${run[@]}" --fast || status=$?
  fi
  [ $status -eq 0 ] || die "the insertion did not run, for the reason above"
}

"$root/toolchain/setup.sh" develop
# Without tests, which need more packages; but a folder that was configured keeps its tests.
is_configured || without_tests=-DSTYLET_WITH_TESTS=OFF
configure ${without_tests:-}
compile stylet stylet-organ
stylet=$build/bin/stylet
stylet_organ=$build/bin/stylet-organ
mkdir -p "$out"

say "Making the organ: a liver-shaped phantom with capsule and parenchyma"
"$stylet_organ" phantom liver --voxel-mm 5 -o "$organ" || die "the organ could not be made"

say "Inserting the needle: 60 mm in, hold, and out again, in real time"
run_insertion

say "Drawing the force curve"
"$stylet" plot "$recording" -o "$out/force.svg"
"$stylet" plot "$recording" -o "$out/force.png"

say "Done"
note "organ       $organ"
note "recording   $recording"
note "picture     $out/force.svg"
note "            $out/force.png"
note "same bits?  $stylet replay $recording"
