#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The README's tables of speed, from the results that stylet-bench --results=FOLDER wrote.

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
        added = [of.get(("tissue_added", organ, lanes), (0, 0))[1] for lanes in ("avx512", "avx2")]
        _, bullet = of.get(("bullet", organ, "peers"), (0, 0))
        _, eigen = of.get(("eigen", organ, "peers"), (0, 0))
        best = avx512 or avx2
        each = [f"{1e3 * us / voxels:.1f}" if us else "" for us in (avx512, avx2, *added)]
        yield [f"{voxels:,}".replace(",", " "), f"{best:.0f}", *each,
               f"{1e6 / best:,.0f}".replace(",", " "), f"{1e6 / best / PAPER_FPS:.0f}",
               f"{bullet / best:.0f} x" if bullet else "",
               f"{eigen / best:.0f} x" if eigen else ""]


def faster(of, measure, organ, variant):
    if (measure, organ, variant) not in of:
        return ""
    quiet, of_all = (of["alone" + which, organ, variant][1] / of[measure + which, organ, variant][1]
                     for which in ("", "_any"))
    return f"{quiet:.2f} x ({of_all:.2f})"


def rows_of_two_threads(of):
    for organ in ORGANS:
        if ("shared", organ, "avx2") in of:
            yield [f"{of['alone', organ, 'avx2'][0]:,}".replace(",", " "),
                   *(faster(of, measure, organ, variant) for measure in ("shared", "beside")
                     for variant in ("avx512", "avx2"))]


def lines(head, rows):
    yield f"| {' | '.join(head)} |\n|{' --- |' * len(head)}\n"
    for row in rows:
        yield f"| {' | '.join(row)} |\n"


def table(found):
    for machine, of in found.items():
        yield (f"\nOne thread of `{machine}`, one tissue step of 1 ms with a needle inserted, "
               "median:\n\n")
        head = ["voxels", "us", "ns a voxel, AVX-512", "AVX2", "with added mass, AVX-512", "AVX2",
                "steps a second", f"times the paper's {PAPER_FPS}", "Bullet takes", "Eigen takes"]
        yield from lines(head, rows(of))
        yield ("\n*Helped*: how many times as fast the same step is with one helper thread.\n"
               "*Nothing in common*: how many times the work of one thread two independent\n"
               "threads do. Other programs may use the second processor, so only the quarter of\n"
               "the repetitions counts in which those two threads were fastest; in brackets the\n"
               "median of all:\n\n")
        head = ["voxels", "helped, AVX-512", "AVX2", "nothing in common, AVX-512", "AVX2"]
        yield from lines(head, rows_of_two_threads(of))
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
