#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What is made from the descriptors of drivers is as they say: the udev rules and the table of
devices in hal/device/README.md. With --write they are made anew.

usage: drivers.py PROGRAM REPOSITORY [--write]
PROGRAM is stylet_driver_texts.
"""
import pathlib
import subprocess
import sys

RULES = "toolchain/rt-host/tree/etc/udev/rules.d/70-stylet-haptic.rules"
README = "hal/device/README.md"
BEGIN, END = "<!-- from the drivers: toolchain/checks/drivers.py -->\n", "<!-- end -->\n"


def with_table(text, table):
    """`text` with `table` between its two marks; ValueError where they are not there once."""
    before, mark, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not mark or not end:
        raise ValueError(f"no table between {BEGIN.strip()} and {END.strip()}")
    return before + BEGIN + table + END + after


def texts_of(repository, udev, table):
    """What stands of the drivers elsewhere, by its file."""
    return {RULES: udev, README: with_table((repository / README).read_text(), table)}


def faults(repository, udev, table):
    for name, text in texts_of(repository, udev, table).items():
        if (repository / name).read_text() != text:
            yield f"{name}: not what the drivers say: run drivers.py PROGRAM REPOSITORY --write"


def main(program, repository, *options):
    def made(what):
        return subprocess.run([program, what], check=True, capture_output=True, text=True).stdout

    repository, made_texts = pathlib.Path(repository), (made("udev"), made("table"))
    if "--write" in options:
        for name, text in texts_of(repository, *made_texts).items():
            (repository / name).write_text(text)
    found = list(faults(repository, *made_texts))
    print("\n".join(found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
