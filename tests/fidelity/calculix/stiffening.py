#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Solves the bodies of stiffening.json with CalculiX and writes stiffening.csv.

Large strains, hyperelastic: Yeoh's law (1993), whose energy is a polynomial in I - 3, the first
invariant without the change of volume. For small strains I - 3 is 2 J, with J of PHYSICS 2.7. So
the coefficients are the first three of that law's series: G/2, G b/8, -G b^2/(32 M). Units: SI.

    ./stiffening.py [FOLDER]     decks and CalculiX's output go to FOLDER, else to a temporary one
"""
import csv
import json
import math
import subprocess

from solve import BRICK, CCX, HERE, Grid, add, in_folder, read_tables, version, write_set

MOST = 10  # M: by how many times its modulus at rest tissue may get stiffer
INCREMENTS = 2


def moved(case, place_m):
    """How a point of the top moves."""
    x, y = (place_m[c] - case["size_m"][c] / 2 for c in (0, 1))
    turn = case.get("twist_rad", 0)
    shift = case.get("move_m", [0, 0, 0])
    return [x * (math.cos(turn) - 1) - y * math.sin(turn) + shift[0],
            x * math.sin(turn) + y * (math.cos(turn) - 1) + shift[1], shift[2]]


def yeoh(layer, poisson):
    """C10, C20, C30, D1, D2, D3; a D that is large leaves its term out."""
    shear = layer["youngs_modulus_pa"] / (2 * (1 + poisson))
    bulk = layer["youngs_modulus_pa"] / (3 * (1 - 2 * poisson))
    b = layer["strain_stiffening"]
    return [shear / 2, shear * b / 8, -shear * b * b / (32 * MOST), 2 / bulk, 1e15, 1e15]


def write_deck(path, case, poisson, edge_m):
    grid = Grid(case["size_m"], edge_m)
    top = [k for k in grid.number if k[2] == grid.end[2]]
    with open(path, "w", encoding="ascii") as out:
        out.write("*NODE\n")
        for key, number in grid.number.items():
            out.write(f"{number}, {', '.join(f'{c * edge_m / 2:.9g}' for c in key)}\n")
        low, count = 0, 0
        for i, layer in enumerate(case["layers"]):
            end = low + round(2 * layer["thickness_m"] / edge_m)
            out.write(f"*ELEMENT, TYPE=C3D20R, ELSET=LAYER{i}\n")
            for brick in (b for b in grid.bricks if low <= b[2] < end):
                count += 1
                numbers = [str(grid.number[add(brick, offset)]) for offset in BRICK]
                out.write(f"{count}, {', '.join(numbers[:10])},\n{', '.join(numbers[10:])}\n")
            low = end
            law = ", ".join(f"{value:.12g}" for value in yeoh(layer, poisson))
            out.write(f"*MATERIAL, NAME=TISSUE{i}\n*HYPERELASTIC, YEOH\n{law}\n"
                      f"*SOLID SECTION, ELSET=LAYER{i}, MATERIAL=TISSUE{i}\n")
        write_set(out, "BOTTOM", [grid.number[k] for k in grid.number if k[2] == 0])
        write_set(out, "ACTED", [grid.number[k] for k in top])
        out.write("*BOUNDARY\nBOTTOM, 1, 3\n")
        out.write(f"*STEP, NLGEOM, INC=200\n*STATIC\n{1 / INCREMENTS:g}, 1\n*BOUNDARY\n")
        for key in top:
            for c, way in enumerate(moved(case, [n * edge_m / 2 for n in key])):
                out.write(f"{grid.number[key]}, {c + 1}, {c + 1}, {way:.12g}\n")
        out.write("*NODE PRINT, NSET=ACTED, FREQUENCY=1000\nRF\n*END STEP\n")
    return grid, top


def acting(case, place_m):
    """Direction in which a node's force counts: along the motion, or about the axis."""
    if "move_m" in case:
        size = math.hypot(*case["move_m"])
        return [c / size for c in case["move_m"]]
    way = moved(case, place_m)
    x, y = (place_m[c] + way[c] - case["size_m"][c] / 2 for c in (0, 1))
    return [-y, x, 0]


def solve(folder, case, poisson, edge_m):
    name = f"{case['name']}_{round(poisson * 100)}_{round(edge_m * 1e6)}"
    grid, top = write_deck(folder / f"{name}.inp", case, poisson, edge_m)
    run = subprocess.run([CCX, name], cwd=folder, capture_output=True, text=True, check=False)
    if run.returncode != 0 or "Job finished" not in run.stdout:
        raise SystemExit(f"ccx failed on {folder / name}.inp:\n{run.stdout[-2000:]}")
    rows = read_tables(folder / f"{name}.dat", "forces")["forces", "ACTED"]
    force = {int(row[0]): row[1:] for row in rows[-len(top):]}
    return sum(f * a for key in top
               for f, a in zip(force[grid.number[key]],
                               acting(case, [n * edge_m / 2 for n in key])))


def main(folder):
    bodies = json.loads((HERE / "stiffening.json").read_text(encoding="utf-8"))
    with open(HERE / "stiffening.csv", "w", encoding="ascii", newline="") as file:
        file.write(f"# CalculiX {version()}, C3D20R, Yeoh; by stiffening.py from stiffening.json\n")
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "poisson_ratio", "edge_m", "force"])
        for case in bodies["cases"]:
            for poisson in bodies["poisson_ratios"]:
                for edge_m in bodies["brick_edges_m"]:
                    force = solve(folder, case, poisson, edge_m)
                    if case.get("both_ways"):
                        other = {**case, "move_m": [-c for c in case["move_m"]]}
                        force = (force + solve(folder, other, poisson, edge_m)) / 2
                    print(case["name"], poisson, edge_m, force, flush=True)
                    out.writerow([case["name"], poisson, edge_m, f"{force:.6g}"])


if __name__ == "__main__":
    in_folder(main)
