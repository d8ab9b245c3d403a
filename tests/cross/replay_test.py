#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Recorded insertions give the same bits on another processor: every hash, and the tick of every
contact and puncture. If they do not, it names the first tick and field that differ. On Windows each
instruction set is asked for by its name, too.

usage: replay_test.py REPOSITORY BUILD_FOLDER i686|aarch64|cortex_m7|wasm|windows
"""
import subprocess
import sys

sys.dont_write_bytecode = True
import target  # noqa: E402

EVERY, TICKS = 50, 1000
# Code that allocates brings one of these symbols; the image must have none.
HEAP = {"malloc", "_malloc_r", "_sbrk", "_sbrk_r", "_Znwj", "_Znaj", "_ZdlPv", "__cxa_throw"}


def first_difference(here, there, name, case, tests_build):
    """What differs first; `here` and `there` run the replay with the words they are given."""
    wrong = next((a for a, b in zip(here("hashes", EVERY, 1, TICKS),
                                    there("hashes", EVERY, 1, TICKS)) if a != b), None)
    if wrong is None or not wrong.startswith("hash"):
        return f"{case}: another number of hashes or other events on {name}"
    last = int(wrong.split()[1])
    span = ("hashes", 1, max(1, last - EVERY), last)
    tick = next(int(a.split()[1]) for a, b in zip(here(*span), there(*span)) if a != b)
    states = []
    for place, replay in (("here", here), (name, there)):
        path = tests_build / f"{case}-{tick}-{place}.state"
        path.write_text("\n".join(replay("state", tick)))
        states.append(path)
    own = tests_build / "cases" / f"{case}_organ.bin"
    organ = own.name if own.exists() else "organ.bin"
    field = subprocess.run(
        [tests_build.parents[1] / "bin/stylet_field", tests_build / "cases" / organ,
         tests_build / f"cases/{case}.bin", *states], capture_output=True, text=True)
    return (f"{case}: differs first after tick {tick}, in {field.stdout.strip()}"
            f"{field.stderr.strip()}\n  states: {states[0]} {states[1]}")


def heap_symbols(program):
    names = {line.split()[-1] for line in target.call(["arm-none-eabi-nm", program]).splitlines()}
    return sorted(names & HEAP)


def other_hashes(tests_build, program):
    """Of the scripted sessions in which the step of an instruction set differs from the host's."""
    reference = target.call([tests_build.parents[1] / "bin/stylet_hash"]).splitlines()
    there = target.run("windows", program.with_name("hashes.exe"))
    helped = target.run("windows", program.with_name("hashes.exe"), 1000, 3)
    widest = [line for line in reference if line.split()[0] == reference[-1].split()[0]]
    print(f"sets: {sorted({line.split()[0] for line in reference})}, {len(reference)} hashes")
    pairs = [*zip(reference, there, strict=True), *zip(widest, helped, strict=True)]
    return [f"expected {a}, found {b}" for a, b in pairs if a != b]


def main(repository, tests_build, name):
    target.skip_without(name)
    program = target.build(repository, tests_build, name)
    reference = tests_build.parents[1] / "bin/stylet_replay"
    faults = []
    for case in target.CASES:
        def here(*words):
            return target.call([reference, case, *words]).splitlines()

        def there(*words):
            return target.run(name, program, case, *words)
        expected, found = here("hashes", EVERY, 1, TICKS), there("hashes", EVERY, 1, TICKS)
        if expected != found:
            faults.append(first_difference(here, there, name, case, tests_build))
            continue
        for event in ("contact", "puncture", "exit"):
            if not any(line.startswith(f"event {event}") for line in expected):
                faults.append(f"{case}: no {event} in the recording, so it proves little")
        print(f"{case}: {TICKS} ticks, {', '.join(expected[-8:])}")
    if name == "cortex_m7":
        print(target.call(["arm-none-eabi-size", program]))
        faults += [f"the image holds {symbol}" for symbol in heap_symbols(program)]
    if name == "windows":
        faults += other_hashes(tests_build, program)
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    place, build_folder, rest = target.arguments()
    sys.exit(main(place, build_folder, *rest))
