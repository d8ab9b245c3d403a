#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The README's table of speed, from the results that stylet-bench --results=FOLDER wrote.

usage: table.py FOLDER README
"""
import csv
import pathlib
import sys

BEGIN, END = "<!-- speed: tests/bench/table.py -->\n", "<!-- end of speed -->\n"
PAPER_FPS = 27.6  # simulation frames a second, paper section V
ORGANS = ["liver_1k", "liver_5k", "liver_20k", "liver_100k"]


def results(folder):
    """machine -> (measure, organ, variant) -> (voxels, us)"""
    found = {}
    for path in sorted(pathlib.Path(folder).glob("*.csv")):
        machine, _, variant = path.stem.rpartition("-")
        with path.open() as file:
            for row in csv.DictReader(file):
                if "measure" in row:
                    found.setdefault(machine, {})[row["measure"], row["organ"], variant] = (
                        int(float(row["voxels"])), float(row["median_us"]))
    return found


def rows(of):
    for organ in ORGANS:
        if ("tissue", organ, "avx2") not in of:
            continue
        voxels, avx2 = of["tissue", organ, "avx2"]
        _, avx512 = of.get(("tissue", organ, "avx512"), (0, 0))
        _, bullet = of.get(("bullet", organ, "peers"), (0, 0))
        _, eigen = of.get(("eigen", organ, "peers"), (0, 0))
        best = avx512 or avx2
        each = [f"{1e3 * us / voxels:.1f}" if us else "" for us in (avx512, avx2)]
        yield [f"{voxels:,}".replace(",", " "), f"{best:.0f}", *each,
               f"{1e6 / best:,.0f}".replace(",", " "), f"{1e6 / best / PAPER_FPS:.0f}",
               f"{bullet / best:.0f}" if bullet else "", f"{eigen / best:.0f}" if eigen else ""]


def table(found):
    for machine, of in found.items():
        yield f"\nOne thread of `{machine}`, one tissue step with a needle inserted, median:\n\n"
        head = ["voxels", "us", "ns a voxel, AVX-512", "AVX2", "steps a second",
                f"times the paper's {PAPER_FPS}", "Bullet takes", "Eigen takes"]
        yield f"| {' | '.join(head)} |\n|{' --- |' * len(head)}\n"
        for row in rows(of):
            row[-2:] = [f"{x} x" if x else "" for x in row[-2:]]
            yield f"| {' | '.join(row)} |\n"
    yield "\n"


def main(folder, readme):
    found = results(folder)
    if not found:
        return f"{folder}: expected files that stylet-bench --results=FOLDER wrote"
    path = pathlib.Path(readme)
    before, _, rest = path.read_text().partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        return f"{readme}: expected the lines {BEGIN.strip()} and {END.strip()}"
    path.write_text(before + BEGIN + "".join(table(found)) + END + after)
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: table.py FOLDER README")
    sys.exit(main(*sys.argv[1:]))
