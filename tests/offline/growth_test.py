#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Time and peak memory of a build grow linearly with triangles, to 10 million, and with voxels, to
2 million.

usage: growth_test.py   (STYLET_BIN)
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

TOOL = pathlib.Path(os.environ.get("STYLET_BIN", "build/bin")) / "stylet-organ"
LINEAR = 1.5  # largest ratio of the cost of one more, large half to small half
# Builds of a second are timed so often, in turn, and the shortest time counts: other processes can
# only make them slower. (Instructions cannot be counted: CGAL needs rounding modes that valgrind
# lacks.)
ROUNDS = 5


def write_ball(path, triangles, diameter_mm):
    """Binary STL of a ball in rings and columns."""
    columns = int(triangles ** 0.5)
    rings = triangles // (2 * columns) + 1
    polar, around = numpy.meshgrid(numpy.linspace(0, numpy.pi, rings + 1),
                                   numpy.linspace(0, 2 * numpy.pi, columns + 1), indexing="ij")
    around[:, -1] = 0  # points at the seam are equal to the bit
    radius = diameter_mm / 2
    sine = numpy.sin(polar)
    sine[0] = sine[-1] = 0
    p = numpy.stack([radius * sine * numpy.cos(around), radius * sine * numpy.sin(around),
                     radius * numpy.cos(polar)], axis=-1).astype("<f4")
    low, high, low_next, high_next = p[:-1, :-1], p[1:, :-1], p[:-1, 1:], p[1:, 1:]
    upper = numpy.stack([low[1:], high[1:], low_next[1:]], axis=2).reshape(-1, 3, 3)
    lower = numpy.stack([high[:-1], high_next[:-1], low_next[:-1]], axis=2).reshape(-1, 3, 3)
    corners = numpy.concatenate([upper, lower])
    records = numpy.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)),
                                               ("spare", "<u2")])
    records["corners"] = corners
    with open(path, "wb") as file:
        file.write(b" " * 80 + numpy.uint32(len(records)).tobytes())
        records.tofile(file)
    return len(records)


def ball(path, triangles, diameter_mm=120):
    """In a separate process, because a child's peak memory includes what its parent had before."""
    done = subprocess.run([sys.executable, __file__, "ball", path, str(triangles),
                           str(diameter_mm)], check=True, capture_output=True, text=True)
    return int(done.stdout)


def cost(*words):
    """Processor seconds and peak MiB of a build."""
    child = os.posix_spawn(TOOL, [str(TOOL), *map(str, words)], os.environ, file_actions=[
        (os.POSIX_SPAWN_OPEN, 1, "/dev/null", os.O_WRONLY, 0)])
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        raise AssertionError(f"{words}: status {status}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


class Growth(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def check_linear(self, what, points):
        """Three points of (amount, seconds, MiB)."""
        for amount, seconds, mib in points:
            print(f"{what}: {amount:9} {seconds:7.2f} s {mib:7.0f} MiB")
        (n0, *c0), (n1, *c1), (n2, *c2) = points
        for kind, a, b, c in zip(("seconds", "MiB"), c0, c1, c2):
            self.assertLess((c - b) / (n2 - n1), LINEAR * (b - a) / (n1 - n0), f"{kind} of {what}")

    def test_triangles(self):
        points = []
        for triangles in (1_000_000, 4_000_000, 10_000_000):
            count = ball(self.folder / "ball.stl", triangles)
            points.append((count, *cost("build", self.folder / "ball.stl", "--voxel-mm", 5, "-o",
                                        self.folder / "a.organ")))
        self.assertGreater(points[-1][0], 9_900_000)
        self.check_linear("triangles", points)

    def test_voxels(self):
        ball(self.folder / "ball.stl", 20_000, diameter_mm=156)
        edges_mm = (2, 1.4, 1)
        rounds = [[cost("build", self.folder / "ball.stl", "--voxel-mm", edge_mm, "-o",
                        self.folder / "a.organ") for edge_mm in edges_mm] for _ in range(ROUNDS)]
        self.check_linear("voxels", [
            (int(1.99e6 / edge_mm ** 3), *map(min, zip(*costs)))
            for edge_mm, costs in zip(edges_mm, zip(*rounds))])


if __name__ == "__main__":
    if sys.argv[1:2] == ["ball"]:
        print(write_ball(sys.argv[2], int(sys.argv[3]), float(sys.argv[4])))
    else:
        unittest.main(verbosity=2)
