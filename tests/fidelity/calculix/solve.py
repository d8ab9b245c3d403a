#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Solves the bodies of bodies.json with CalculiX (Debian's calculix-ccx) and writes calculix.csv.

Linear small-strain elasticity, bricks of twenty nodes with reduced integration (C3D20R), one deck
for every case, Poisson ratio and brick edge. Units: SI.

    ./solve.py [FOLDER]     decks and CalculiX's own output go to FOLDER, else to a temporary one
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

HERE = Path(__file__).resolve().parent
CCX = "ccx"

# Corners and middles of the edges of a brick, in half edges, in CalculiX's order.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
MIDDLES = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
           (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
BRICK = CORNERS + MIDDLES
# Even loads as node loads: the fractions for a brick's corners and middles, and for a line's ends
# and middle.
BRICK_SHARES = [-1 / 8] * 8 + [1 / 6] * 12
LINE = [((0, 0, 0), 1 / 6), ((0, 0, 1), 4 / 6), ((0, 0, 2), 1 / 6)]


def halves(point_m, edge_m):
    """A point as a count of half edges; it must lie on the grid."""
    counts = tuple(round(2 * x / edge_m) for x in point_m)
    if any(abs(2 * x / edge_m - c) > 1e-6 for x, c in zip(point_m, counts)):
        raise SystemExit(f"bodies.json: point {point_m} m is not on the grid of half {edge_m} m")
    return counts


def graded(place_m, edge_m, reach_m):
    """Moves positions near the edge of the box towards it, quadratically.

    At the edge of a rigid body stress grows without bound, as r^-1/2 under a punch: bricks that
    shrink towards it, the last of them with its middle node at a quarter of its length, follow it.
    """
    r = (place_m - edge_m) / reach_m
    return edge_m + reach_m * r * abs(r) if abs(r) < 1 else place_m


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


class Grid:
    """Nodes of a block of bricks, numbered from 1 in x, y, z order; keys count half edges."""

    def __init__(self, size_m, edge_m):
        self.edge_m = edge_m
        self.end = halves(size_m, edge_m)
        spans = [range(n + 1) for n in self.end]
        keys = (k for k in product(*spans) if sum(c % 2 for c in k) <= 1)
        self.number = {key: i for i, key in enumerate(keys, 1)}
        self.bricks = list(product(*(range(0, n, 2) for n in self.end)))

    def nodes_in(self, low, high):
        return [k for k in self.number if all(a <= c <= b for a, c, b in zip(low, k, high))]

    def at(self, point_m):
        return halves(point_m, self.edge_m)


def loads_of(grid, low, high, force):
    """Node loads of a force spread evenly over a box, or over a line along z."""
    loads = {}
    if low[:2] == high[:2]:
        pieces = [(add(low, (0, 0, z)), LINE) for z in range(0, high[2] - low[2], 2)]
    else:
        inside = [b for b in grid.bricks
                  if all(a <= c < e for a, c, e in zip(low, b, high))]
        pieces = [(b, list(zip(BRICK, BRICK_SHARES))) for b in inside]
    for start, shares in pieces:
        for offset, share in shares:
            key = add(start, offset)
            loads[key] = loads.get(key, 0) + force * share / len(pieces)
    return loads


def symmetry(axis):
    """Components held on x = 0 and on y = 0 when the body is moved along an axis."""
    held = []
    for plane in (0, 1):
        odd = [c for c in range(3) if c != plane] if axis == plane else [plane]
        held += [(plane, c) for c in odd]
    return held


def write_set(out, name, numbers):
    out.write(f"*NSET, NSET={name}\n" + "".join(f"{n},\n" for n in numbers))


def write_nodes(out, grid, act, reach_m):
    out.write("*NODE\n")
    for key, number in grid.number.items():
        place = [c * grid.edge_m / 2 for c in key]
        if "displacement_m" in act:
            edges = (*act["high_m"][:2], act["low_m"][2])
            place = [graded(x, edge, reach_m) for x, edge in zip(place, edges)]
        out.write(f"{number}, {', '.join(f'{x:.9g}' for x in place)}\n")


def write_bricks(out, grid, layers):
    low, count = 0, 0
    for i, layer in enumerate(layers):
        top = low + round(2 * layer["thickness_m"] / grid.edge_m)
        out.write(f"*ELEMENT, TYPE=C3D20R, ELSET=LAYER{i}\n")
        for brick in grid.bricks:
            if low <= brick[2] < top:
                count += 1
                numbers = [str(grid.number[add(brick, offset)]) for offset in BRICK]
                out.write(f"{count}, {', '.join(numbers[:10])},\n{', '.join(numbers[10:])}\n")
        low = top


def write_deck(path, body, case, poisson, edge_m):
    """Returns the grid and the node loads (empty when a displacement is prescribed)."""
    grid = Grid(body["quarter_m"], edge_m)
    act = case["act"]
    low, high = grid.at(act["low_m"]), grid.at(act["high_m"])
    loads = loads_of(grid, low, high, act["force_n"]) if "force_n" in act else {}
    number = grid.number
    with open(path, "w", encoding="ascii") as out:
        write_nodes(out, grid, act, max(body["brick_edges_m"]))
        write_bricks(out, grid, case["layers"])
        write_set(out, "BOTTOM", [number[k] for k in number if k[2] == 0])
        write_set(out, "ON0", [number[k] for k in number if k[0] == 0 and k[2] > 0])
        write_set(out, "ON1", [number[k] for k in number if k[1] == 0 and k[2] > 0])
        write_set(out, "ACTED", [number[k] for k in loads or grid.nodes_in(low, high)])
        write_set(out, "PROBES", [number[grid.at(p)] for p in case["probes_m"]])
        for i, layer in enumerate(case["layers"]):
            out.write(f"*MATERIAL, NAME=TISSUE{i}\n"
                      f"*ELASTIC\n{layer['youngs_modulus_pa']}, {poisson}\n"
                      f"*SOLID SECTION, ELSET=LAYER{i}, MATERIAL=TISSUE{i}\n")
        out.write("*BOUNDARY\nBOTTOM, 1, 3\n")
        for plane, component in symmetry(act["axis"]):
            out.write(f"ON{plane}, {component + 1}\n")
        out.write("*STEP\n*STATIC\n")
        component = act["axis"] + 1
        if loads:
            out.write("*CLOAD\n" + "".join(f"{number[k]}, {component}, {f:.12g}\n"
                                           for k, f in loads.items()))
        else:
            out.write(f"*BOUNDARY\nACTED, {component}, {component}, {act['displacement_m']}\n")
        out.write("*NODE PRINT, NSET=PROBES\nU\n*NODE PRINT, NSET=ACTED\nU\n"
                  "*NODE PRINT, NSET=ACTED, TOTALS=ONLY\nRF\n*END STEP\n")
    return grid, loads


def read_tables(path, kinds="displacements|total force"):
    """CalculiX's .dat file: for each heading, rows of numbers."""
    tables, rows = {}, None
    for line in path.read_text(encoding="ascii").splitlines():
        heading = re.match(rf" *({kinds}).* for set (\w+)", line)
        if heading:
            rows = tables.setdefault(heading.groups(), [])
        elif line.strip():
            rows.append([float(x) for x in line.split()])
    return tables


def solve(folder, body, case, poisson, edge_m):
    """Yields (quantity, value): the force or displacement of the quarter, then the probes."""
    name = f"{case['name']}_{round(poisson * 100)}_{round(edge_m * 1e6)}"
    grid, loads = write_deck(folder / f"{name}.inp", body, case, poisson, edge_m)
    run = subprocess.run([CCX, name], cwd=folder, capture_output=True, text=True, check=False)
    if run.returncode != 0 or "Job finished" not in run.stdout:
        raise SystemExit(f"ccx failed on {folder / name}.inp:\n{run.stdout[-2000:]}")
    tables = read_tables(folder / f"{name}.dat")
    axis = case["act"]["axis"]
    if not loads:
        yield "force_n", tables["total force", "ACTED"][0][axis]
    elif len(set(k[:2] for k in loads)) > 1:  # under a line load the displacement is infinite
        moved = {int(row[0]): row[1 + axis] for row in tables["displacements", "ACTED"]}
        work = sum(f * moved[grid.number[k]] for k, f in loads.items())
        yield "mean_displacement_m", work / sum(loads.values())
    probes = {int(row[0]): row[1:] for row in tables["displacements", "PROBES"]}
    for i, point in enumerate(case["probes_m"]):
        yield f"probe{i}_m", probes[grid.number[grid.at(point)]][axis]


def version():
    shown = subprocess.run([CCX, "-v"], capture_output=True, text=True, check=False).stdout
    return re.search(r"[Vv]ersion (\S+)", shown).group(1)


def main(folder):
    body = json.loads((HERE / "bodies.json").read_text(encoding="utf-8"))
    with open(HERE / "calculix.csv", "w", encoding="ascii", newline="") as file:
        file.write(f"# CalculiX {version()}, C3D20R; written by solve.py from bodies.json\n")
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "poisson_ratio", "edge_m", "quantity", "value"])
        for case, poisson, edge_m in product(body["cases"], body["poisson_ratios"],
                                             body["brick_edges_m"]):
            print(case["name"], poisson, edge_m, flush=True)
            for quantity, value in solve(folder, body, case, poisson, edge_m):
                out.writerow([case["name"], poisson, edge_m, quantity, f"{value:.6g}"])


def in_folder(work):
    """Calls `work` with the folder that the command names, or with one for the time being."""
    if len(sys.argv) > 1:
        os.makedirs(sys.argv[1], exist_ok=True)
        work(Path(sys.argv[1]).resolve())
    else:
        with tempfile.TemporaryDirectory() as temporary:
            work(Path(temporary))


if __name__ == "__main__":
    in_folder(main)
