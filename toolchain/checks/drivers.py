#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the udev rules, the tables of devices in hal/device/README.md and, for Windows, in
hal/hosts/c/windows.md, and the tables in hal/scene/by_name.md of what a scene may name agree with
the code, from which they are made. --write makes them again.

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
BY_NAME = "hal/scene/by_name.md"
BEGIN, END = "<!-- from the drivers: toolchain/checks/drivers.py -->\n", "<!-- end -->\n"


def with_tables(text, *tables):
    """`text` with `tables` between its pairs of marks, in this order; ValueError if it has not as
    many pairs."""
    parts = text.split(BEGIN)
    if len(parts) != len(tables) + 1 or not all(END in part for part in parts[1:]):
        raise ValueError(f"expected {len(tables)} tables between {BEGIN.strip()} and {END.strip()}")
    return parts[0] + "".join(BEGIN + table + END + part.partition(END)[2]
                              for table, part in zip(tables, parts[1:]))


def texts_of(repository, made):
    """File -> the text that it should have. `made`: what PROGRAM says to each of its words."""
    tables = {README: ["table"], WINDOWS: ["windows"],
              BY_NAME: ["needles", "materials", "tips", "devices"]}
    return {RULES: made("udev"), **{
        name: with_tables((repository / name).read_text(), *map(made, words))
        for name, words in tables.items()}}


def faults(repository, made):
    for name, text in texts_of(repository, made).items():
        if (repository / name).read_text() != text:
            yield f"{name}: not what the code says: run drivers.py PROGRAM REPOSITORY --write"


def main(program, repository, *options):
    built.require(program)

    def made(what):
        return subprocess.run([program, what], check=True, capture_output=True, text=True).stdout

    repository = pathlib.Path(repository)
    if "--write" in options:
        for name, text in texts_of(repository, made).items():
            (repository / name).write_text(text)
    found = list(faults(repository, made))
    print("\n".join(found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
