#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The loop does the same whoever looks: the same number of instructions (to one in ten thousand)
and the same bits with no client of the console, with twenty, and with twenty and one that never
reads. Counted by callgrind in the loop's thread, inside run_loop, while all of them are there.

usage: watched_loop.py PROGRAM
"""
import pathlib
import re
import subprocess
import sys
import tempfile

CASES = [(0, 0), (20, 0), (20, 1)]
TOLERANCE = 1e-4


def count(program, readers, sleepers):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind"
        done = subprocess.run(
            ["valgrind", "--tool=callgrind", "--separate-threads=yes", "--fair-sched=yes",
             "--instr-atstart=no",
             "--toggle-collect=stylet::hal::run_loop(*", f"--callgrind-out-file={out}",
             program, str(readers), str(sleepers)], capture_output=True, text=True, timeout=600)
        if done.returncode != 0:
            sys.exit(f"{program} {readers} {sleepers}: exit code {done.returncode}\n{done.stderr}")
        totals = [int(total) for file in pathlib.Path(folder).iterdir()
                  for total in re.findall(r"^totals: (\d+)", file.read_text(), re.M)]
    return max(totals), done.stdout.strip()


def main():
    counted = {case: count(sys.argv[1], *case) for case in CASES}
    (alone, state), failed = counted[CASES[0]], False
    for (readers, sleepers), (instructions, now) in counted.items():
        print(f"{readers:3} readers {sleepers:3} asleep: {instructions} instructions, state and "
              f"ticks {now}")
        failed |= now != state or abs(instructions - alone) > TOLERANCE * alone
    # A count of nothing would agree with itself.
    if failed or alone < 1_000_000:
        sys.exit("watched_loop: the loop's work depends on who looks")


main()
