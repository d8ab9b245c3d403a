#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the udev rules and the tables of devices in hal/device/README.md and, for Windows, in
hal/hosts/c/windows.md agree with the descriptors of the drivers, from which they are made. --write
makes them again.

usage: drivers.py PROGRAM REPOSITORY [--write]
PROGRAM is stylet_driver_texts.
"""
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import built  # noqa: E402

RULES = "toolchain/rt-host/tree/etc/udev/rules.d/70-stylet-haptic.rules"
README = "hal/device/README.md"
WINDOWS = "hal/hosts/c/windows.md"
BEGIN, END = "<!-- from the drivers: toolchain/checks/drivers.py -->\n", "<!-- end -->\n"


def with_table(text, table):
    """`text` with `table` between its two marks; ValueError if a mark is missing."""
    before, mark, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not mark or not end:
        raise ValueError(f"no table between {BEGIN.strip()} and {END.strip()}")
    return before + BEGIN + table + END + after


def texts_of(repository, udev, table, windows):
    """File -> the text that it should have according to the drivers."""
    return {RULES: udev, README: with_table((repository / README).read_text(), table),
            WINDOWS: with_table((repository / WINDOWS).read_text(), windows)}


def faults(repository, udev, table, windows):
    for name, text in texts_of(repository, udev, table, windows).items():
        if (repository / name).read_text() != text:
            yield f"{name}: not what the drivers say: run drivers.py PROGRAM REPOSITORY --write"


def main(program, repository, *options):
    built.require(program)

    def made(what):
        return subprocess.run([program, what], check=True, capture_output=True, text=True).stdout

    repository = pathlib.Path(repository)
    made_texts = [made(each) for each in ("udev", "table", "windows")]
    if "--write" in options:
        for name, text in texts_of(repository, *made_texts).items():
            (repository / name).write_text(text)
    found = list(faults(repository, *made_texts))
    print("\n".join(found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
