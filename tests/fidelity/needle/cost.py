#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Solving a needle costs the same whatever happens to the needle.

Counts the instructions of solve_rod and all it calls, for the easiest and the hardest cases, and
compares: less than 3 % between any two.

usage: cost.py NEEDLE_COST [RODS]
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
SPREAD = 0.03
TICKS = 40
CASES = {
    "rest": "no load, at rest",
    "tissue": "every load there is room for, at rest",
    "buckled": "30 N on the tip of a 25G needle",
    "thrown": "handle and 1 m of tissue thrown about every tick",
}


def instructions(program, case, rods):
    """Instructions a tick, of solve_rod with what it calls."""
    with tempfile.TemporaryDirectory() as folder:
        profile = pathlib.Path(folder) / "profile"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}",
                   "--toggle-collect=stylet::solve_rod*", program, case, rods, str(TICKS)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
        return int(re.search(r"^(?:summary|totals): (\d+)", profile.read_text(), re.M)[1]) / TICKS


def main(program, rods="64"):
    if shutil.which("valgrind") is None:
        print("skipped: valgrind, which counts the instructions, is not installed")
        return SKIPPED
    counted = {case: instructions(program, case, rods) for case in CASES}
    for case, count in counted.items():
        print(f"{rods} rods: {count:8.0f} instructions a tick: {CASES[case]}")
    spread = max(counted.values()) / min(counted.values()) - 1
    print(f"spread {100 * spread:.2f} %, allowed are {100 * SPREAD:.0f} %")
    # If there are fewer, something else than the solve was counted.
    return not (spread < SPREAD and min(counted.values()) > 1000 * int(rods))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
