#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the fuzz targets with clang's libFuzzer and sanitizers, and runs them.

usage: fuzz.py BUILD_FOLDER TARGET... [--runs N | --seconds N] [--seed N]

As many targets at a time as there are processors, each started from the seeds committed in
tests/fuzz/seeds/TARGET. With --runs the same inputs are tried every time (CI); with --seconds as
many as fit, from a seed of the day or --seed. Inputs worth keeping stay in
BUILD_FOLDER/corpus/TARGET for the next run. An input that breaks a promise is left in
BUILD_FOLDER/finds; once the defect is mended it belongs in the seeds, which every build replays,
with a suffix (.bin if it is not text).
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
TARGETS = ["organ", "tick", "snapshot", "mesh", "tissues", "label", "recipe", "scene", "recording",
           "packet"]
# Longest inputs worth trying: longer ones are slower and find nothing else.
MAX_BYTES = {"organ": 8192, "tick": 1024, "snapshot": 96, "mesh": 2048, "tissues": 2048,
             "label": 4096, "recipe": 2048, "scene": 4096, "recording": 64, "packet": 512}


def run_quietly(command):
    """Runs a command; its output is shown only if it fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nfuzz.py: failed: {' '.join(map(str, command))}")


def build(folder, targets):
    run_quietly(["cmake", "--preset", "fuzz", "-S", SOURCE, "-B", folder])
    run_quietly(["cmake", "--build", folder, "--target"] + [f"fuzz_{each}" for each in targets])


def command_of(folder, target, options):
    corpus, finds = folder / "corpus" / target, folder / "finds"
    for each in (corpus, finds):
        each.mkdir(parents=True, exist_ok=True)
    command = [folder / "bin" / f"fuzz_{target}", f"-max_len={MAX_BYTES[target]}", "-timeout=20",
               "-rss_limit_mb=3000", "-print_final_stats=1", f"-artifact_prefix={finds}/{target}-"]
    if options.runs:
        shutil.rmtree(corpus)
        corpus.mkdir()
        command += [f"-runs={options.runs}", f"-seed={options.seed or 1}"]
    else:
        command += [f"-max_total_time={options.seconds}",
                    f"-seed={options.seed or int(time.time()) // 86400}"]
    dictionary = HERE / f"{target}.dict"
    if dictionary.exists():
        command.append(f"-dict={dictionary}")
    # libFuzzer writes new inputs into the first folder.
    return command + [corpus, HERE / "seeds" / target]


def fuzz(folder, target, options):
    """Whether every promise held, and a line to print about it."""
    environment = dict(os.environ, UBSAN_OPTIONS="print_stacktrace=1", TMPDIR=str(folder),
                       LSAN_OPTIONS=f"suppressions={SOURCE}/toolchain/leaks.txt")
    done = subprocess.run(command_of(folder, target, options), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", env=environment)
    lines = done.stdout.splitlines()
    if done.returncode == 0:
        inputs = [line.split()[-1] for line in lines if "number_of_executed_units" in line]
        covered = [line for line in lines if " cov: " in line]
        reached = covered[-1].split(" cov: ")[1].split()[0] if covered else "?"
        return True, f"{target}: {inputs[0]} inputs, {reached} edges reached, all promises kept"
    quiet = [line for line in lines if not line.startswith(("#", "\tNEW_FUNC"))]
    return False, (f"{chr(10).join(quiet)[-6000:]}\n{target}: a promise is broken; the input is "
                   f"named above and lies in {folder}/finds")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("targets", nargs="*", help=f"of {', '.join(TARGETS)}; none: all")
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    targets = options.targets or TARGETS
    for each in targets:
        if each not in TARGETS:
            parser.error(f"{each}: expected one of {', '.join(TARGETS)}")
    folder = options.build.resolve()
    start = time.monotonic()
    build(folder, targets)
    print(f"built in {time.monotonic() - start:.0f} s", flush=True)
    held = True
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for kept, text in pool.map(lambda each: fuzz(folder, each, options), targets):
            print(text, flush=True)
            held = held and kept
    sys.exit(0 if held else 1)


if __name__ == "__main__":
    main()
