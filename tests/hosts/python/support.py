# SPDX-License-Identifier: Apache-2.0
"""Organs and programs for the tests of the Python package; tests of programs that were not built
are skipped."""
import atexit
import functools
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
import stylet

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
BIN = pathlib.Path(os.environ["STYLET_BIN"])
DOWN = (0, 0, -1)
BLOCK_M = (0.06, 0.06, 0.04)
FAST = {"inertia": "added_mass", "substeps": 1}  # for tests that do not depend on the physics


@functools.cache
def folder():
    path = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, path)
    return pathlib.Path(path)


def program(name):
    path = BIN / name
    if not path.exists():
        raise unittest.SkipTest(f"{name} is not built")
    return str(path)


@functools.cache
def organ_file():
    """A block of liver of 12 x 12 x 8 voxels, held at its low end; it begins at x = 0, and y and z
    are centred on 0."""
    path = folder() / "block.organ"
    size = ",".join(str(1e3 * length) for length in BLOCK_M)
    subprocess.run([program("stylet-organ"), "phantom", "block", "--size-mm", size,
                    "--voxel-mm", "5", "--tissue", "liver", "--capsule", "none",
                    "--fix", "z<10%", "-o", path], check=True, capture_output=True)
    return path


@functools.cache
def organ():
    return stylet.Organ.read(organ_file())


def simulation(needles=None, **config):
    return stylet.Simulation(organ(), needles, stylet.Config(**{**FAST, **config}))


def insertion(ticks, at_m=(0, 0), deepest_m=0.02, needle=None):
    """Poses of a needle from 1 mm above the block's top to the given depth."""
    info = organ().info
    top_m = [*(np.add(info.low_m, info.high_m)[:2] / 2 + at_m), info.high_m[2] + 1e-3]
    tips_m = top_m + np.outer(np.linspace(0, deepest_m + 1e-3, ticks), DOWN)
    return stylet.poses_of_tips(tips_m, DOWN, (needle or stylet.Needle()).length_m)
