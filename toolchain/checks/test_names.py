#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that test names are the same in every run, and that parameters have a text in them.

usage: test_names.py PROGRAM...    programs of googletest
"""
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import built  # noqa: E402


def listed(program):
    done = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True,
                          timeout=60, check=True)
    return done.stdout


def faults(program):
    name, text = pathlib.Path(program).name, listed(program)
    if not text.strip():
        yield f"{name}: lists no test"
    for line in text.splitlines():
        if "byte object <" in line or not line.isprintable():
            yield f"{name}: {line.strip()}: a parameter without text; give it a PrintTo"
    if listed(program) != text:
        yield f"{name}: lists other tests when it is asked again"


def main(programs):
    built.require(*programs)
    found = [fault for program in programs for fault in faults(program)]
    print("\n".join(found))
    return bool(found) or not programs


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
