#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a fresh clone to a force curve: installs what is missing, builds a release, makes the default
# organ and inserts a needle into it on the real-time loop, as in Fig. 9 of the paper.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

out=$root/build/demo
organ=$out/liver-phantom.organ
recording=$out/fig09.h5
scene=$root/hal/scenes/fig09-force-curve.toml

# The real-time loop, or the same loop without real-time priority where the host forbids it.
run_insertion() {
  local run=("$stylet" run "$scene" --organ "$organ" --record "$recording")
  local refusal=$out/real-time-refused.txt
  rm -f "$recording"
  if "${run[@]}" 2> >(tee "$refusal" >&2); then return 0; fi
  grep -q -- --allow-non-rt "$refusal" || die "the insertion did not run, for the reason above"
  note "This host does not allow real-time scheduling here, so the timing below is only a hint."
  note "The forces are the same. As root, or with the rtprio and memlock limits raised, it would."
  "${run[@]}" --allow-non-rt || die "the insertion did not run, for the reason above"
}

"$root/toolchain/setup.sh"
configure
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
