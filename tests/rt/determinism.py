#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The same bits from every compiler, level and instruction set, and with helper threads.

Builds the kernel and the program stylet_hash once per row of the table, runs it, and compares the
hashes of every instruction set of every row with the first; those of the first row's widest
instruction set with helper threads, too.

usage: determinism.py REPOSITORY BUILD_FOLDER fast|full
"""
import pathlib
import re
import shutil
import subprocess
import sys

SANITIZED = "-O1 -fsanitize=address,undefined -fno-sanitize-recover=all -Wno-maybe-uninitialized"
ROWS = {
    "fast": [("g++", "-O3"), ("g++", "-O2"), ("g++", "-O1"), ("g++", "-O0"), ("clang++", "-O2")],
    # The whole kernel for newer processors, not only the lattice; with link-time optimisation; and
    # with sanitizers.
    "full": [("g++", "-O3"), ("g++", "-O3 -march=x86-64-v3"), ("g++", "-O3 -march=x86-64-v4"),
             ("g++", "-Os"), ("g++", "-O2 -flto"), ("g++", SANITIZED), ("clang++", "-O3"),
             ("clang++", "-O3 -march=x86-64-v3"), ("clang++", "-O3 -march=x86-64-v4")],
}
HELPERS = {"fast": (1, 2), "full": (3,)}  # every other row has none
TICKS = "4500"  # one insertion with pause, pull and retraction, and the start of the next


def call(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout[-4000:]}\n{done.stderr[-4000:]}")
    return done.stdout


def lacking(compiler, level):
    """The compiler or instruction set that this row needs and this machine lacks; None if it can
    run."""
    if shutil.which(compiler) is None:
        return compiler
    has = pathlib.Path("/proc/cpuinfo").read_text().split()
    return next((instructions for name, instructions in (("x86-64-v3", "avx2"),
                                                         ("x86-64-v4", "avx512vl"))
                 if name in level and instructions not in has), None)


def build(repository, folder, compiler, level):
    call("cmake", "-G", "Ninja", "-S", repository, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
         f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_CXX_FLAGS_RELEASE={level}",
         "-DSTYLET_WITH_HAL=OFF", "-DSTYLET_WITH_OFFLINE=OFF")
    call("cmake", "--build", folder, "-j", "1", "--target", "stylet_hash")
    return folder / "bin" / "stylet_hash"


def hashes(program, helpers=0):
    """(instruction set, mode) -> list of (tick, hash)."""
    series = {}
    for line in call(program, TICKS, helpers).splitlines():
        variant, mode, tick, value = line.split()
        series.setdefault((variant, mode), []).append((tick, value))
    return series


def compare(reference, series, name):
    for mode in ("physical", "paper", "elastic"):
        expected = reference["baseline", mode]
        for (variant, this_mode), values in series.items():
            if this_mode != mode:
                continue
            for (tick, a), (_, b) in zip(expected, values, strict=True):
                if a != b:
                    yield f"{name} {variant} {mode}: differs first at tick {tick}: {b}, not {a}"
                    break


def main(repository, folder, tier):
    reference, found = None, []
    for compiler, level in ROWS[tier]:
        missing = lacking(compiler, level)
        if missing:
            print(f"skipped: {compiler} {level}: no {missing} here")
            continue
        name = f"{compiler} {level}"
        place = pathlib.Path(folder) / re.sub("[^a-zA-Z0-9+-]", "_", compiler + level)
        program = build(repository, place, compiler, level)
        for helpers in (0,) if reference else (0, *HELPERS[tier]):
            series = hashes(program, helpers)
            reference = reference or series
            label = f"{name}, {helpers} helpers" if helpers else name
            found += compare(reference, series, label)
            last = next(value for (_, mode), value in series.items() if mode == "physical")[-1]
            print(f"{label}: {len(series)} series, last hash {last[1]}", flush=True)
    changing = {value for _, value in reference["baseline", "physical"]}
    if len(changing) < len(reference["baseline", "physical"]):
        found.append("the hash did not change in a hundred ticks, so it proves nothing")
    print("\n".join(found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
