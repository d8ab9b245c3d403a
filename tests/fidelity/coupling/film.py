#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Force of a point on a thin skin that is bonded to a half space, by finite elements: film.csv.

The half space is linear and axisymmetric (bilinear rings, their change of volume averaged over
each), condensed to its surface layer by layer. The skin on it is a row of rings that stretch, by
any amount, and do not bend: energy of its stretches in plane stress, incompressible. The point is a
cone of 15 degrees, on which the skin may slide; contact stays far narrower than the dimple.
Newton's steps lead from depth to depth. Units: SI.

    ./film.py            writes film.csv (a minute)
    ./film.py --check    solves every fourth case anew and compares
"""
import csv
import sys
from pathlib import Path

import numpy as np

TABLE = Path(__file__).resolve().parent / "film.csv"
COLUMNS = ["youngs_pa", "poisson", "membrane_n_per_m", "depth_m", "force_n"]
HALF_ANGLE_RAD = np.radians(15)
FINEST_M, GROWTH, EXTENT_M = 2.5e-5, 1.06, 0.5
DEPTHS_M = [0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3]
# One tissue is enough: if skins scale with its modulus, forces do.
YOUNGS_PA = 20000.0
POISSONS = [0.3, 0.45, 0.49]
MEMBRANES_N_PER_M = [100.0, 500.0, 2000.0, 5000.0]


def places(growth):
    """From 0 to EXTENT_M, each step longer than the last."""
    at, step = [0.0], FINEST_M
    while at[-1] < EXTENT_M:
        at.append(at[-1] + step)
        step *= growth
    return np.array(at)


def strip(r, height_m, poisson):
    """Stiffness of a strip of rings; nodes (r, upper), (r, lower) alternate, with u_r and u_z of
    each."""
    volume = YOUNGS_PA * poisson / ((1 + poisson) * (1 - 2 * poisson))
    shear = YOUNGS_PA / (2 * (1 + poisson))
    law = np.diag([2 * shear, 2 * shear, 2 * shear, shear])
    law[:3, :3] += volume
    out = np.zeros((4 * len(r), 4 * len(r)))
    gauss = 1 / np.sqrt(3)
    for i, width in enumerate(np.diff(r)):
        strains, weights = [], []
        for x in (-gauss, gauss):
            for y in (-gauss, gauss):
                shape = np.array([(1 - x) * (1 - y), (1 - x) * (1 + y),
                                  (1 + x) * (1 - y), (1 + x) * (1 + y)]) / 4
                along = np.array([-(1 - y), -(1 + y), 1 - y, 1 + y]) / (2 * width)
                down = np.array([-(1 - x), 1 - x, -(1 + x), 1 + x]) / (2 * height_m)
                radius = shape @ [r[i], r[i], r[i + 1], r[i + 1]]
                b = np.zeros((4, 8))
                b[0, 0::2], b[1, 1::2], b[2, 0::2] = along, down, shape / radius
                b[3, 0::2], b[3, 1::2] = down, along
                strains.append(b)
                weights.append(2 * np.pi * radius * width * height_m / 4)
        change = [b[:3].sum(axis=0) for b in strains]
        mean = np.average(change, axis=0, weights=weights)
        for b, own, weight in zip(strains, change, weights):
            b[:3] += (mean - own) / 3
            out[4 * i:4 * i + 8, 4 * i:4 * i + 8] += weight * b.T @ law @ b
    return out


def half_space(r, poisson):
    """Stiffness of the surface: u_z on the axis, then u_r and u_z of each node but the last."""
    z = places(GROWTH * 1.02)
    count = len(r)
    upper = np.array([4 * i + c for i in range(count) for c in (0, 1)])
    lower = upper + 2
    free = np.arange(1, 2 * count - 2)  # no u_r on the axis, nothing at the rim
    below = None
    for height in np.diff(z)[::-1]:
        k = strip(r, height, poisson)
        here = k[np.ix_(upper, upper)][np.ix_(free, free)]
        if below is not None:  # the lowest nodes are fixed
            across = k[np.ix_(upper, lower)][np.ix_(free, free)]
            under = below + k[np.ix_(lower, lower)][np.ix_(free, free)]
            here = here - across @ np.linalg.solve(under, across.T)
        below = here
    return below


def stretch(r, membrane_n_per_m, x):
    """Gradient and (positive) Hessian of the skin's energy."""
    poisson = 0.5
    count = len(r)
    u, w = np.zeros(count), np.zeros(count)
    w[0], u[1:-1], w[1:-1] = x[0], x[1::2], x[2::2]
    length, middle = np.diff(r), (r[1:] + r[:-1]) / 2
    along, down = length + np.diff(u), np.diff(w)
    now = np.hypot(along, down)
    c, s = along / now, down / now
    radial, hoop = now / length - 1, (u[1:] + u[:-1]) / 2 / middle
    size = 2 * np.pi * middle * length * membrane_n_per_m / (1 - poisson**2)
    pull, ring = size * (radial + poisson * hoop), size * (hoop + poisson * radial)
    gradient, hessian = np.zeros(2 * count), np.zeros((2 * count, 2 * count))
    for i in range(count - 1):
        of_radial = np.array([-c[i], -s[i], c[i], s[i]]) / length[i]
        of_hoop = np.array([0.5, 0, 0.5, 0]) / middle[i]
        turn = np.array([s[i], -c[i], -s[i], c[i]])
        at = slice(2 * i, 2 * i + 4)
        gradient[at] += pull[i] * of_radial + ring[i] * of_hoop
        hessian[at, at] += size[i] * (
            np.outer(of_radial, of_radial) + np.outer(of_hoop, of_hoop) +
            poisson * (np.outer(of_radial, of_hoop) + np.outer(of_hoop, of_radial)))
        hessian[at, at] += max(pull[i], 0) / (now[i] * length[i]) * np.outer(turn, turn)
    keep = slice(1, 2 * count - 2)
    return gradient[keep], hessian[keep, keep]


def forces(r, surface, membrane_n_per_m):
    """Force of the cone at each depth."""
    flank = np.tan(HALF_ANGLE_RAD)
    # Stiffness of the cone's surface, next to the skin's: it changes the force by less than a
    # thousandth.
    hard = 1e3 * membrane_n_per_m
    slope = np.array([1 / flank, 1.0])
    x, out = np.zeros(len(surface)), []
    for depth in DEPTHS_M:
        for _ in range(500):
            gradient, hessian = stretch(r, membrane_n_per_m, x)
            gradient, hessian = gradient + surface @ x, hessian + surface
            force = 0.0
            inside = np.concatenate(([depth - x[0]], depth - (r[1:-1] + x[1::2]) / flank - x[2::2]))
            for i in np.nonzero(inside > 0)[0]:
                at, by = slice(max(2 * i - 1, 0), 2 * i + 1), slope if i > 0 else slope[1:]
                gradient[at] -= hard * inside[i] * by
                hessian[at, at] += hard * np.outer(by, by)
                force += hard * inside[i]
            step = -np.linalg.solve(hessian, gradient)
            longest = np.abs(step).max()
            x = x + min(1.0, 3e-4 / longest) * step
            if longest < 1e-10:
                break
        else:
            raise SystemExit(f"no equilibrium at {depth} m on {membrane_n_per_m} N/m")
        out.append(force)
    return out


def cases(every):
    """Rows of the table, of every `step`-th skin."""
    r = places(GROWTH)
    number = 0
    for poisson in POISSONS:
        surface = None
        for membrane in MEMBRANES_N_PER_M:
            number += 1
            if number % every != 0:
                continue
            if surface is None:
                surface = half_space(r, poisson)
            for depth, force in zip(DEPTHS_M, forces(r, surface, membrane)):
                yield [YOUNGS_PA, poisson, membrane, depth, float(f"{force:.4g}")]


def check():
    with TABLE.open() as file:
        written = {tuple(map(float, row[:4])): float(row[4]) for row in list(csv.reader(file))[1:]}
    off = [row for row in cases(4) if abs(written[tuple(row[:4])] / row[4] - 1) > 1e-3]
    for row in off:
        print("film.csv differs from", dict(zip(COLUMNS, row)))
    return 1 if off else 0


def main():
    if sys.argv[1:] == ["--check"]:
        sys.exit(check())
    with TABLE.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(cases(1))


if __name__ == "__main__":
    main()
