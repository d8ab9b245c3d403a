#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Each tick of the bare Cortex-M7 image takes the same number of instructions in every run, and the
largest number is committed.

The emulator's time is a count of instructions, so no other load on the machine can change it. The
numbers are in virtual_time.txt; --update writes them anew, after it has built stylet_replay: that
records the insertions that are replayed.

usage: virtual_time.py REPOSITORY BUILD_FOLDER [--update]
"""
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
import target  # noqa: E402

SHIFT = 6  # 2^6 ns an instruction; SysTick counts 40 ns
COUNTS_PER_INSTRUCTION = 2**SHIFT / 40
TOLERANCE = 0.01
HEADER = """\
# Instructions of one tick on the Cortex-M7 image: the worst, and the median of ticks that touch
# tissue. Written by tests/cross/virtual_time.py REPOSITORY BUILD_FOLDER --update
# case worst median
"""


def costs(program, case):
    lines = target.run("cortex_m7", program, case, "costs", options=["-icount", f"shift={SHIFT}"])
    return [(line.split()[0], int(line.split()[2])) for line in lines]


def summary(counts):
    """(worst, median of busy ticks), in instructions."""
    busy = [count for phase, count in counts if phase == "busy"]
    return (round(max(count for _, count in counts) / COUNTS_PER_INSTRUCTION),
            round(statistics.median(busy) / COUNTS_PER_INSTRUCTION))


def measure(program):
    """Case -> (worst, median); exits where two runs differ."""
    found = {}
    for case in target.CASES:
        runs = [costs(program, case) for _ in range(2)]
        if runs[0] != runs[1] or not runs[0]:
            tick = next((i for i, (a, b) in enumerate(zip(*runs)) if a != b), -1) + 1
            sys.exit(f"{case}: two runs differ, first in tick {tick}")
        found[case] = summary(runs[0])
        print(f"{case}: worst {found[case][0]}, median {found[case][1]} instructions")
    return found


def faults(committed, found):
    for case, (worst, _) in found.items():
        if case not in committed:
            yield f"{case}: no committed number"
        elif abs(worst - committed[case]) > TOLERANCE * committed[case]:
            yield (f"{case}: {worst} instructions in the worst tick, committed are "
                   f"{committed[case]}; if that is meant: virtual_time.py --update")


def read_numbers(path):
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return {row[0]: int(row[1]) for row in rows}


def record_cases(build_folder):
    """Builds the replay here, with which the recorded insertions become those of this source."""
    command = ["cmake", "--build", str(build_folder), "--target", "stylet_replay"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout[-4000:]}")


def main(repository, tests_build, rest):
    target.skip_without("cortex_m7")
    if rest == ["--update"]:
        record_cases(tests_build.parents[1])
    found = measure(target.build(repository, tests_build, "cortex_m7"))
    path = repository / "tests/cross/virtual_time.txt"
    if rest == ["--update"]:
        path.write_text(HEADER + "".join(f"{case} {a} {b}\n" for case, (a, b) in found.items()))
        return False
    wrong = list(faults(read_numbers(path), found))
    print("\n".join(wrong))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*target.arguments()))
