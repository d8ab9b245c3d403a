#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that all symbols which the kernel's libraries need from outside are on a list.

No heap, no exceptions, no streams, no threads: a symbol that is not on the list is either a defect,
or is added to the list with its reason.

usage: symbols.py ALLOW_LIST LIBRARY...
"""
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import built  # noqa: E402


def read_list(path):
    lines = pathlib.Path(path).read_text().splitlines()
    return {line.split("#")[0].strip() for line in lines} - {""}


def undefined(libraries):
    """Symbol that no library defines -> objects that need it."""
    wanted, defined = {}, set()
    for library in libraries:
        listing = subprocess.run(["nm", "--format=posix", "--print-file-name", library],
                                 check=True, capture_output=True, text=True).stdout
        for line in listing.splitlines():
            place, symbol, kind = line.rsplit(": ", 1)[0], *line.rsplit(": ", 1)[1].split()[:2]
            if kind in "Uw":
                wanted.setdefault(symbol, set()).add(place)
            else:
                defined.add(symbol)
    return {symbol: places for symbol, places in wanted.items() if symbol not in defined}


def demangle(symbol):
    return subprocess.run(["c++filt", symbol], capture_output=True, text=True).stdout.strip()


def faults(allow_list, libraries):
    allowed = read_list(allow_list)
    for symbol, places in sorted(undefined(libraries).items()):
        if symbol not in allowed:
            yield f"{', '.join(sorted(places))}: needs {demangle(symbol)} ({symbol}), not allowed"


if __name__ == "__main__":
    built.require(*sys.argv[2:])
    found = list(faults(sys.argv[1], sys.argv[2:]))
    print("\n".join(found))
    sys.exit(bool(found))
