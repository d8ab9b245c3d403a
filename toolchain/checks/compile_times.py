#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""No file takes more than 20 s to compile. The files that may take longer are compiled once more
without the cache, one after the other, and judged by their processor time, which other programs
change less than elapsed time: by up to a half on a busy machine.

A file may take longer if the last build took longer by ninja's log. The log says nothing of an
object that came out of ccache, so each of those that is large is compiled as well.

usage: compile_times.py BUILD_FOLDER [SECONDS]
"""
import os
import pathlib
import resource
import shlex
import subprocess
import sys

FROM_CACHE_S = 1.0  # ccache hands out an object in less
LARGE_BYTES = 200_000  # what took more than 15 s of 526 objects was larger


def logged(build):
    """Seconds that each object file took when it was last made."""
    took = {}
    for line in (build / ".ninja_log").read_text().splitlines():
        if not line.startswith("#"):
            begin, end, _, output, _ = line.split("\t")
            took[output] = (int(end) - int(begin)) / 1000
    return {output: seconds for output, seconds in took.items() if output.endswith(".o")}


def command_of(build, output):
    """(the compiler's words, without a launcher and with the object thrown away; whether there was
    a launcher). No words: a file that is no longer part of the build."""
    done = subprocess.run(["ninja", "-C", build, "-t", "commands", "-s", output],
                          capture_output=True, text=True, check=False)
    words = shlex.split(done.stdout.splitlines()[-1]) if done.returncode == 0 else []
    cached = bool(words) and pathlib.Path(words[0]).name == "ccache"
    words = words[cached:]
    if "-o" in words:
        words[words.index("-o") + 1] = os.devnull
    if "-MF" in words:
        words[words.index("-MF") + 1] = os.devnull
    return words, cached


def processor_s(build, command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=build, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def from_cache(build, output, seconds):
    """Whether ccache may have handed out this object, if the build uses it, and it is large."""
    path = build / output
    return seconds < FROM_CACHE_S and path.is_file() and path.stat().st_size > LARGE_BYTES


def faults(build, bar_s):
    for output, seconds in sorted(logged(build).items()):
        slow, unknown = seconds > bar_s, from_cache(build, output, seconds)
        command, cached = command_of(build, output) if slow or unknown else ([], False)
        if command and (slow or cached):
            taken = processor_s(build, command)
            print(f"{output}: {taken:.1f} s", flush=True)
            if taken > bar_s:
                yield f"{output}: {taken:.1f} s to compile, allowed are {bar_s:g}"


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: compile_times.py BUILD_FOLDER [SECONDS]")
    found = list(faults(pathlib.Path(sys.argv[1]), float((sys.argv[2:] or ["20"])[0])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
