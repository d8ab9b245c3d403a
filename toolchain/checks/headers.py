#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the kernel's public headers include only each other and a few headers without heap.

usage: headers.py FOLDER
"""
import pathlib
import re
import sys

ALLOWED = {"<cstdint>", "<cstddef>", "<span>", "<bit>", "<type_traits>"}
ALLOWED_C = {"<stdint.h>", "<stddef.h>"}  # for the C interface
INCLUDE = re.compile(r'\s*#\s*include\s*(<[^>]*>|"[^"]*")')


def faults(folder):
    headers = sorted(pathlib.Path(folder).rglob("*.h"))
    if not headers:
        yield f"{folder}: no header found"
    for header in headers:
        for number, line in enumerate(header.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            good = not match or match[1] in ALLOWED | ALLOWED_C or match[1].startswith('"stylet/')
            if not good:
                yield (f"{header}:{number}: includes {match[1]}; allowed are stylet/ headers and "
                       f"{' '.join(sorted(ALLOWED))}")


if __name__ == "__main__":
    found = list(faults(sys.argv[1]))
    print("\n".join(found))
    sys.exit(bool(found))
