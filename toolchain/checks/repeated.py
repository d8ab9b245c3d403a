#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Numbers that documents repeat are those of the files that tests hold: within a percent, or as
near as the document's last digit.

The files are written by the tests' own programs (--update); a document that repeats their numbers
would stay behind. --write puts the files' numbers where a document no longer agrees. Others stay:
the README's are what tests measured on that day (promises.py).

usage: repeated.py REPOSITORY [--write]
"""
import importlib.util
import pathlib
import re
import sys

TOLERANCE = 0.01
README, PROMISES, PHYSICS = "README.md", "kernel/PROMISES.md", "kernel/PHYSICS.md"
BENCH = "tests/bench/README.md"
HALVING, CALCULIX = "tests/e2e/halving.md", "tests/fidelity/calculix/README.md"


def table(path):
    """Name of a row -> its numbers, of a committed table whose rows begin with their name."""
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return {row[0]: [int(word) for word in row[1:]] for row in rows}


def constant(path, name):
    """A constant of a Python file, which is not run as a program."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return getattr(module, name)


def bytes_of(path, block):
    """Model, state and scratch in the row of memory.txt for this block."""
    row = re.search(rf"^{block} (\d+) (\d+) (\d+)", path.read_text(), re.M)
    return [int(number) for number in row.groups()]


def columns(path, head, wanted):
    """The numbers in these columns of the first table whose first column has this head."""
    found = []
    for line in path.read_text().partition(f"\n| {head} |")[2].splitlines()[2:]:
        cells = line.strip("|").split("|")
        if len(cells) <= max(wanted):
            break
        found.append([float(cells[column].strip(" %")) if cells[column].strip() else None
                      for column in wanted])
    return [[each for each in column if each is not None] for column in zip(*found)]


def rows_of_tables(top):
    """As rows: what the tables of validation repeat of other documents' tables."""
    voxel, unit, step = columns(top / HALVING, "scene", (2, 3, 4))
    yield PHYSICS, r"unit ([\d.]+) to ([\d.]+) %, step ([\d.]+) to ([\d.]+) % \(H\)", [
        min(unit), max(unit), min(step), max(step)]
    yield PHYSICS, r"\| ([\d.]+) to ([\d.]+) % \(H\)", [min(voxel), max(voxel)]
    *forces, probe, other_probe = columns(top / CALCULIX, "body", (2, 3, 4, 5))
    forces, probes = sum(forces, []), probe + other_probe
    yield PHYSICS, (r"force −([\d.]+) to \+([\d.]+) %, worst probe "
                    r"\+([\d.]+) / −([\d.]+) % \(C\)"), [
        -min(forces), max(forces), max(probes), -min(probes)]
    said = re.search(r"(\d+) bytes at most, (\d+) used", (top / README).read_text())
    yield (PROMISES, r"(\d+) bytes on the longest path, without recursion; (\d+) were used",
           [int(number) for number in said.groups()] if said else [])
    for edge in (2, 46):
        block = f"{edge} {edge} {edge} 1 0"
        yield (PROMISES, rf"\| {block[:-4].replace(' ', ' × ')} voxels[^|]*"
               r"\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|",
               [each / 1e6 for each in bytes_of(top / "tests/rt/memory.txt", block)])


def rows(top):
    """(document, expression whose groups are numbers it repeats, what they should be)"""
    costs = table(top / "tests/rt/costs.txt")
    for scene, (_, dearest, _, _) in costs.items():
        yield README, rf"`rt\.costs\.\*` \|[^|]*\b{re.escape(scene)} (\d+)", [dearest]
    for document in (PROMISES, PHYSICS):
        yield document, r"take[s]? ([\d.]+) G instructions", [costs["worst"][1] / 1e9]
    cortex = table(top / "tests/cross/virtual_time.txt")
    yield README, r"`cross\.virtual_time` \|[^|]*worst (\d+), median (\d+)", cortex["elastic"]
    budget = constant(top / "tests/bench/growth.py", "BUDGET")
    budgets = [budget[what][of] for what in ("step", "sweep") for of in ("avx2", "avx512")]
    yield BENCH, r"the test allows (\d+), (\d+), (\d+) and (\d+)\.", budgets
    yield from rows_of_tables(top)
    yield ("tests/README.md", r"than its budget \((\d+) a voxel with AVX2, (\d+) with\s+added",
           [budget["step"]["avx2"], budget["sweep"]["avx2"]])


def rounded(number, like):
    """`number` with as many digits behind the point as the text `like`."""
    return f"{number:.{len(like.partition('.')[2])}f}"


def agrees(text, number):
    return text == rounded(number, text) or abs(float(text) - number) <= TOLERANCE * number


def compared(top, document, expression, numbers):
    """(the document's text, with these numbers in it if its own do not agree; faults)"""
    text = (top / document).read_text()
    match = re.search(expression, text)
    if match is None:
        return text, [f"{document}: says no more what was looked for: {expression}"]
    faults, written = [], text
    for group in reversed(range(len(numbers))):
        start, end = match.span(group + 1)
        said, right = match[group + 1], rounded(numbers[group], match[group + 1])
        written = written[:start] + right + written[end:]
        if not agrees(said, numbers[group]):
            line = text.count("\n", 0, start) + 1
            faults.append(f"{document}:{line}: says {said}, measured is {right}; "
                          "toolchain/checks/repeated.py . --write")
    return written if faults else text, faults


def main(top, write):
    found = []
    for document, expression, numbers in rows(top):
        text, faults = compared(top, document, expression, numbers)
        if write:
            (top / document).write_text(text)
            faults = [fault for fault in faults if "--write" not in fault]
        found += faults
    print("\n".join(found))
    return bool(found)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit("usage: repeated.py REPOSITORY [--write]")
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2:] == ["--write"]))
