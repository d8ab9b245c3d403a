#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Force of a needle's tip on a half space that stiffens with its strain, by finite elements:
stiff_tip.csv.

A cone that goes over into a cylinder, rigid and without friction, pressed into an axisymmetric half
space (bilinear rings, their change of volume averaged over each). Strains are linear in the
displacements, as in Sneddon's solution; the material is that of PHYSICS 2.7. With the cone's half
angle a, strains go with cot a, so its tissue's stiffening b counts as b cot^2 a, and the cone here
has 45 degrees. Which nodes touch is found by steps from set to set, the equilibrium of each by
Newton's method. `ratio` is the force over that of tissue that does not stiffen, by the same
elements; `depth` is over l, at which contact is as wide as the needle.

    ./stiff_tip.py            writes stiff_tip.csv (two minutes)
    ./stiff_tip.py --check    solves one case in nine anew and compares
"""
import csv
import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

TABLE = Path(__file__).resolve().parent / "stiff_tip.csv"
COLUMNS = ["poisson", "stiffening", "depth", "ratio"]
MOST = 10.0  # by how many times its modulus at rest tissue may get stiffer
FINEST, FINE, GROWTH, EXTENT = 0.05, 1.4, 1.2, 40.0  # in radii of the needle
LENGTH = np.pi / 2  # l
POISSONS = [0.3, 0.4, 0.45, 0.49]
STIFFENINGS = [1, 3, 10, 30, 100, 300, 1000, 3000]
DEPTHS = [1, 2, 4, 8]
ROOT2 = np.sqrt(2)


def places():
    """From 0 to EXTENT; each step is longer than the last outside FINE."""
    at, step = [0.0], FINEST
    while at[-1] < EXTENT:
        at.append(at[-1] + step)
        step *= GROWTH if at[-1] > FINE else 1
    return np.array(at)


class HalfSpace:
    """Young's modulus 1. Nodes by rows from the surface down, the axis first in each; u_r and u_z,
    upwards, of each in turn."""

    def __init__(self, poisson):
        self.r = places()
        self.shear = 1 / (2 * (1 + poisson))
        self.bulk = 1 / (3 * (1 - 2 * poisson))
        count = len(self.r)
        across, down = (x.ravel() for x in np.meshgrid(*2 * [np.arange(count - 1)], indexing="ij"))
        node = down * count + across
        nodes = np.stack([node, node + 1, node + count + 1, node + count], axis=1)
        self.dofs = np.stack([2 * nodes, 2 * nodes + 1], axis=2).reshape(-1, 8)
        self.size = 2 * count * count
        self.rows = np.repeat(self.dofs, 8, axis=1).ravel()
        self.columns = np.tile(self.dofs, (1, 8)).ravel()
        step = np.diff(self.r)
        self.measure(self.r[across], step[across], step[down])
        held = np.zeros((count, count, 2), bool)
        held[:, 0, 0] = True  # no u_r on the axis
        held[:, -1] = held[-1] = True
        self.held = held.ravel()
        self.surface = 2 * np.arange(count) + 1

    def measure(self, inner, width, height):
        """Strain at four points of each ring (change of shape: rr, tt, zz, and rz times root 2;
        mean change of volume) of its displacements, and what volume each point stands for."""
        x_of, y_of = np.array([-1, 1, 1, -1]), np.array([1, 1, -1, -1])
        rings = len(inner)
        strain, self.volume = np.zeros((rings, 4, 4, 8)), np.zeros((rings, 4))
        for point in range(4):
            x, y = x_of[point] / np.sqrt(3), y_of[point] / np.sqrt(3)
            shape = (1 + x_of * x) * (1 + y_of * y) / 4
            along = x_of * (1 + y_of * y) / 2 / width[:, None]
            up = y_of * (1 + x_of * x) / 2 / height[:, None]
            radius = inner + width * (1 + x) / 2
            strain[:, point, 0, 0::2] = along
            strain[:, point, 1, 0::2] = shape / radius[:, None]
            strain[:, point, 2, 1::2] = up
            strain[:, point, 3, 0::2], strain[:, point, 3, 1::2] = up / ROOT2, along / ROOT2
            self.volume[:, point] = 2 * np.pi * radius * width * height / 4
        swelling = strain[:, :, :3].sum(axis=2)
        self.shape = strain
        self.shape[:, :, :3] -= swelling[:, :, None] / 3
        self.swelling = np.einsum("eqk,eq->ek", swelling, self.volume)  # times the ring's volume

    def balance(self, u, stiffening):
        """Forces on all nodes, and their derivative."""
        own = u[self.dofs]
        strain = np.einsum("eqik,ek->eqi", self.shape, own)
        x = stiffening * (strain * strain).sum(axis=2) / (2 * MOST)
        modulus = 2 * self.shear * (1 + MOST * x * (2 + x) / (1 + x) ** 2) * self.volume
        growth = 4 * self.shear * stiffening / (1 + x) ** 3 * self.volume
        pressure = self.bulk / self.volume.sum(axis=1)
        slope = np.einsum("eqik,eqi->eqk", self.shape, strain)
        force = np.einsum("eqk,eq->ek", slope, modulus)
        force += self.swelling * (pressure * (self.swelling * own).sum(axis=1))[:, None]
        matrix = np.einsum("eqik,eqil,eq->ekl", self.shape, self.shape, modulus)
        matrix += np.einsum("eqk,eql,eq->ekl", slope, slope, growth)
        matrix += np.einsum("ek,el,e->ekl", self.swelling, self.swelling, pressure)
        total = np.bincount(self.dofs.ravel(), force.ravel(), self.size)
        return total, sparse.csc_matrix((matrix.ravel(), (self.rows, self.columns)),
                                        shape=(self.size, self.size))

    def rest(self, u, free, stiffening):
        for _ in range(40):
            force, matrix = self.balance(u, stiffening)
            size = np.abs(force[free]).max()
            if size < 1e-10:
                return u, force
            step, part = spsolve(matrix[free][:, free], -force[free]), 1.0
            for _ in range(8):  # no farther than the balance gets better, or little worse
                tried = u.copy()
                tried[free] += part * step
                if np.abs(self.balance(tried, stiffening)[0][free]).max() < 1.5 * size:
                    break
                part /= 2
            u = tried
        raise SystemExit(f"no equilibrium at stiffening {stiffening}")

    def press(self, depth, stiffening, start):
        """Force on a needle `depth` l deep, and the state to start the next case from."""
        tool = np.where(self.r <= 1 + 1e-9, depth * LENGTH - self.r, -np.inf)
        u, touching = start if start is not None else (np.zeros(self.size), tool > 0)
        for _ in range(60):
            free = ~self.held
            free[self.surface[touching]] = False
            u = u.copy()
            u[self.surface[touching]] = -tool[touching]
            u, force = self.rest(u, free, stiffening)
            push = -force[self.surface]
            now = touching & (push > -1e-12) | ~touching & (u[self.surface] + tool > 1e-9)
            if (now == touching).all():
                return push[touching].sum(), (u, touching)
            touching = now
        raise SystemExit(f"no contact at depth {depth}")


def solve(poisson, depth, stiffenings):
    half = HalfSpace(poisson)
    linear, state = half.press(depth, 0, None)
    for stiffening in stiffenings:
        force, state = half.press(depth, stiffening, state)
        yield [poisson, stiffening, depth, float(f"{force / linear:.5g}")]


def main():
    if sys.argv[1:] == ["--check"]:
        with open(TABLE, encoding="ascii") as file:
            rows = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
        for poisson, depth in ((0.45, 2), (0.3, 1)):
            for row in solve(poisson, depth, STIFFENINGS):
                kept = next(r for r in rows if r[:3] == row[:3])
                if abs(kept[3] / row[3] - 1) > 1e-4:
                    raise SystemExit(f"{TABLE.name} is stale: {kept} is {row} now")
        print("the same")
        return
    with open(TABLE, "w", encoding="ascii", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(COLUMNS)
        for poisson in POISSONS:
            for depth in DEPTHS:
                out.writerows(solve(poisson, depth, STIFFENINGS))


if __name__ == "__main__":
    main()
