#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every field of the structs that a tick leaves to the next one is described: by a comment behind
it, or by one above it and its neighbours, up to an empty line.

usage: fields.py HEADER_OR_FOLDER...
"""
import pathlib
import re
import sys

STRUCT = re.compile(r"^\s*struct \w+ \{")
FIELD = re.compile(r"^\s+[\w:<>&*]+(?: const)?[&* ]+\w[^()]*;")  # a function has parentheses
END = re.compile(r"^\s*\}")


def faults_of(path):
    depth, described = 0, False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if STRUCT.match(line):
            depth += 1
            described = False
        elif depth and END.match(line):
            depth -= 1
            described = False
        elif depth and not line.strip():
            described = False
        elif depth and line.strip().startswith("//"):
            described = True
        elif depth and FIELD.match(line) and "//" not in line and not described:
            yield f"{path}:{number}: no comment says what `{line.strip()}` is"


def faults(places):
    headers = [header for place in map(pathlib.Path, places)
               for header in (sorted(place.rglob("*.h")) if place.is_dir() else [place])]
    if not headers:
        yield f"no header in {', '.join(map(str, places))}"
    for header in headers:
        yield from faults_of(header)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: fields.py HEADER_OR_FOLDER...")
    found = list(faults(sys.argv[1:]))
    print("\n".join(found))
    sys.exit(bool(found))
