#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws convergence.svg: both solvers over the distance of their nodes, one panel a body.

    ./plot.py ../../../build/release/bin/stylet_calculix_lattice

Runs that program for the lattice's values, reads calculix.csv, needs gnuplot. It draws the leading
value of each body (the force on a box that is moved, the mean displacement of one that is pulled,
the first probe of a needle) over that of CalculiX's finest bricks.
"""
import csv
import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Colours of Okabe and Ito: told apart with every kind of colour vision.
COLOURS = {0.3: "#0072B2", 0.45: "#D55E00"}
LEADING = ["force_n", "mean_displacement_m", "probe0_m"]

HEAD = """set terminal svg size 1200,520 dynamic font 'DejaVu Sans,11' background '#FFFFFF'
set multiplot layout 2,5
set logscale x 2
set xrange [0.5:6]
set xtics (0.625, 1.25, 2.5, 5)
set yrange [-8:8]
set grid lt 1 lc '#DDDDDD'
set xlabel 'distance of nodes, mm'
set ylabel 'from CalculiX, finest: %'
set object 1 rectangle from graph 0, first -5 to graph 1, first 5 fc '#F4F4F4' fs noborder behind
unset key
"""


def read(lines):
    """{body: {Poisson ratio: {quantity: [(edge in mm, value), ...]}}}"""
    table = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        body = table.setdefault(row["case"], {}).setdefault(float(row["poisson_ratio"]), {})
        body.setdefault(row["quantity"], []).append((1e3 * float(row["edge_m"]),
                                                     float(row["value"])))
    return table


def leading(quantities):
    return next(quantities[name] for name in LEADING if name in quantities)


def curves_of(bricks, voxels):
    """(points, gnuplot style, title) of one body."""
    for poisson, colour in COLOURS.items():
        wanted = leading(bricks[poisson])[-1][1]
        # Nodes of a brick with twenty nodes are half its edge apart.
        for rows, nodes, look, name in (
                (leading(voxels[poisson]), 1, "lw 2 pt 7 ps 0.6", "Stylet"),
                (leading(bricks[poisson]), 0.5, "lw 1 dt 2 pt 6 ps 0.7", "CalculiX")):
            points = [(edge * nodes, 100 * (value / wanted - 1)) for edge, value in rows]
            yield points, f"{look} lc '{colour}'", f"{name}, nu {poisson}"


def panel(title, curves, bare=False):
    plots = ", ".join(f"'-' with linespoints {style} title '{name}'" for _, style, name in curves)
    data = "".join("".join(f"{x} {y}\n" for x, y in points) + "e\n" for points, _, _ in curves)
    if not bare:
        return f"set title '{title}'\nplot {plots}\n{data}"
    # The last panel is the legend for all: the same curves, outside the visible range.
    return ("set key center center\nset border 0\nunset tics\nunset xlabel\nunset ylabel\n"
            "unset grid\nunset object 1\nunset title\nset yrange [1000:1001]\n"
            f"plot {plots}\n{data}")


def main(program):
    bodies = json.loads((HERE / "bodies.json").read_text(encoding="utf-8"))
    run = subprocess.run([program], capture_output=True, text=True, check=True)
    voxels = read(run.stdout.splitlines())
    bricks = read((HERE / "calculix.csv").read_text(encoding="ascii").splitlines())
    script = HEAD
    for case in bodies["cases"]:
        name = case["name"]
        curves = list(curves_of(bricks[name], voxels[name]))
        script += panel(name.replace("_", " "), curves)
    script += panel("", curves, bare=True) + "unset multiplot\n"
    drawn = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True, check=True)
    (HERE / "convergence.svg").write_text(drawn.stdout, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    main(sys.argv[1])
