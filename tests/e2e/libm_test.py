#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Organ files, scenes and recordings have the same bits with any mathematical library.

Runs the programs a second time with libm's seventh digit changed (shaken_libm.cpp, preloaded).

usage: libm_test.py   with STYLET_BIN and STYLET_SHAKEN in the environment
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["STYLET_BIN"])
SHAKEN = {**os.environ, "LD_PRELOAD": os.environ["STYLET_SHAKEN"]}

# Everything that is computed from an angle, a power or a curve: turned obstacles, EI, bevel and
# bend, breath, spin.
SCENE = """
[breathing]
amplitude_mm = [0, 3, -4]
period_s = 2

[[obstacles]]
shape = "box"
size_mm = [20, 20, 20]
at_mm = [12, 20, 0]
turn_deg = [17, -31, 53]
stiffness_n_per_mm = 20

[[needles]]
gauge = "22G"
flexible = true
tip = "bevel"
[needles.approach]
direction = [1, 0.3, 0.1]
point_mm = [0, 0, 0]
[[needles.hand.waypoint]]
travel_mm = 25
speed_mm_s = 30
turns = 3
duty = 0.5

[[needles]]
od_mm = 0.6
id_mm = 0.2
flexible = true
tip = "bent"
bent_length_mm = 8
bent_angle_deg = 12
[needles.approach]
direction = [1, 0, 0]
point_mm = [0, -20, 0]
[needles.device]
kind = "steered"
[needles.steering]
target_mm = [15, -18, 1]
speed_mm_per_s = 30
curvature_per_m = 4
hold_s = 0.1
"""


def call(*words, env=None):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, env=env)
    if done.returncode != 0:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


class SameBits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def organ(self, *words, env=None):
        path = self.folder / "made.organ"
        call(BIN / "stylet-organ", *words, "-o", path, env=env)
        return path

    def test_the_library_is_shaken(self):
        script = "import math; print([math.sin(1), math.pow(3, 0.3), math.atan2(1, 3)])"
        words = ("/usr/bin/python3", "-c", script)
        for exact, shaken in zip(json.loads(call(*words)), json.loads(call(*words, env=SHAKEN))):
            self.assertNotEqual(exact, shaken)
            self.assertAlmostEqual(exact, shaken, delta=1e-6)

    def test_organ_files(self):
        for words in (("phantom", "liver", "--voxel-mm", "6"),
                      ("phantom", "ball", "--diameter-mm", "40", "--voxel-mm", "4"),
                      ("phantom", "block", "--voxel-mm", "6")):
            exact = self.organ(*words).read_bytes()
            shaken = self.organ(*words, env=SHAKEN).read_bytes()
            self.assertTrue(exact == shaken, f"{' '.join(words)}: another file")

    def test_organ_files_of_meshes(self):
        mesh = self.folder / "ball.off"
        self.organ("phantom", "ball", "--diameter-mm", "40", "--voxel-mm", "4", "--mesh-out", mesh)
        words = ("build", mesh, "--units", "m", "--voxel-mm", "3")
        exact = self.organ(*words).read_bytes()
        self.assertTrue(exact == self.organ(*words, env=SHAKEN).read_bytes())

    def test_runs(self):
        scene = self.folder / "scene.toml"
        scene.write_text(SCENE)
        organ = self.organ("phantom", "block", "--size-mm", "50,60,60", "--voxel-mm", "5",
                           "--tissue", "muscle")
        words = (BIN / "stylet", "run", scene, "--organ", organ, "--fast", "--json")
        exact, shaken = json.loads(call(*words)), json.loads(call(*words, env=SHAKEN))
        self.assertIn("puncture", {event["kind"] for event in exact["events"]})
        self.assertIn("obstacle", {event["kind"] for event in exact["events"]})
        for key in ("state_hash", "needles", "events"):
            self.assertEqual(exact[key], shaken[key], key)


if __name__ == "__main__":
    unittest.main()
