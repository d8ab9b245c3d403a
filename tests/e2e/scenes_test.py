#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each scene of hal/scenes shows what its figure in the paper shows, and can be drawn.

usage: scenes_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
sys.path.insert(0, str(SOURCE / "hal/scenes"))

import draw  # noqa: E402
import play  # noqa: E402


class Scene(unittest.TestCase):
    """One run of the scene for all its checks."""

    name = ""
    more = ()  # options of the run

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        try:
            recording, cls.report = play.play(cls.name, cls.folder, cls.more)
        except play.DataMissing as missing:
            raise unittest.SkipTest(str(missing)) from missing
        cls.run_ = draw.Run(recording)

    def check_quiet(self):
        """Nothing ran full, no guard fault, and the picture can be drawn."""
        counters = self.report["counters"]
        for key in ("cp_pool_full", "cp_voxel_pool_full", "kernel_fault", "guard_faults"):
            self.assertEqual(counters[key], 0, key)
        picture = self.folder / "picture.svg"
        draw.draw(self.name, self.run_.path, picture)
        self.assertGreater(len(picture.read_text()), 5000)

    def kinds(self):
        return [kind for _, kind, _, _ in self.run_.events]

    def assert_within(self, value, expected, share):
        self.assertLessEqual(abs(value - expected), share * abs(expected),
                             f"{value:.6g}, expected {expected:.6g} within {100 * share:g} %")


class Fig03Puncture(Scene):
    name = "fig03-puncture"

    # Paper mode: the stiffness of a particle is a mass over a tick squared, that of a voxel's
    # corner with two of eight of its neighbours; gel, 5 mm, unit 5 mm.
    STIFFNESS = 1000 * 5e-3**3 / 4 / 1e-3**2
    UNIT = 5e-3

    def test_shows_the_figure(self):
        self.check_quiet()
        self.assertEqual(self.kinds()[:4], ["contact", "release", "contact", "puncture"])
        run = self.run_
        first = slice(0, run.index("release"))
        self.assertEqual(run.particles[first].max(), 1)
        self.assertLess(run.axial_n[first].max(), self.STIFFNESS * self.UNIT)
        self.assertGreater(run.axial_n[first].max(), 0.3 * self.STIFFNESS * self.UNIT)
        at = run.index("puncture")
        self.assertEqual(run.particles[at - 1], 1)
        self.assertGreaterEqual(run.particles[at], 2)
        _, _, _, force = run.events[3]
        self.assert_within(force, self.STIFFNESS * self.UNIT, 0.01)


class Fig04InsertRetract(Scene):
    name = "fig04-insert-retract"
    UNIT = 5e-3

    def test_one_particle_a_unit(self):
        self.check_quiet()
        run = self.run_
        inside = slice(run.index("puncture") + 1, run.index("exit"))
        units = run.depth_m[inside] / self.UNIT
        # tip, entry, and one for each whole unit between them
        wrong = np.abs(run.particles[inside] - (units + 1.5))
        self.assertLessEqual(wrong.max(), 1.0)
        steps = np.diff(run.particles[inside])
        deepest = int(np.argmax(run.depth_m[inside]))
        self.assertTrue(np.all(steps[:deepest] >= 0))
        self.assertTrue(np.all(steps[deepest:] <= 0))
        self.assertLessEqual(np.abs(steps).max(), 1)
        self.assertEqual(run.particles[-1], 0)


class Fig05StickSlip(Scene):
    name = "fig05-stick-slip"
    COULOMB, VISCOUS, SPEED = 40, 30, 4e-3  # muscle, N/m; N s/m2; m/s
    SHEAR = 40e3 / 2.9

    def test_saturates_at_the_friction(self):
        self.check_quiet()
        run = self.run_
        slipping = slice(14500, 15300)  # fourth stroke, on the way in
        friction = (self.COULOMB + self.VISCOUS * self.SPEED) * run.depth_m[slipping]
        self.assertLess(np.abs(run.parts_n["friction"][slipping] / friction - 1).max(), 0.02)

    def test_loop_has_the_area_of_an_elastoplastic_one(self):
        run = self.run_
        loop = slice(11315, 15315)  # strokes 3 and 4: out and back
        way, force = run.hand_m[loop], run.axial_n[loop]
        area = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(way)))
        amplitude = np.ptp(way) / 2
        limit = (np.percentile(force, 95) - np.percentile(force, 5)) / 2
        start = int(np.argmax(way[:200]))
        zero = start + int(np.argmax(force[start:] < 0))
        slide = way[start] - way[zero]
        self.assert_within(area, 4 * limit * (amplitude - slide), 0.05)
        stiffness = force[start] / slide / float(np.mean(run.depth_m[loop]))
        # Between that along a shaft (Randolph and Wroth, 1.3 G) and that across it (3.9 G): a
        # particle has one spring for all directions.
        self.assertTrue(1.3 * self.SHEAR < stiffness < 3.9 * self.SHEAR,
                        f"{stiffness / self.SHEAR:.3f} G of shear stiffness per length")


class Fig08LiverRigid(Scene):
    name = "fig08-liver-rigid"

    def test_stages(self):
        self.check_quiet()
        names = [row["name"] for row in self.report["phases"]]
        self.assertEqual(names[:7], ["approach", "contact", "puncture", "insertion", "hold",
                                     "retraction", "exit"])
        self.assertEqual(self.kinds().count("puncture"), 1)
        run = self.run_
        self.assertGreater(run.depth_m.max(), 0.035)
        after = run.force_n[run.index("exit") + 50:]
        self.assertLess(np.abs(after).max(), 0.01)

    def test_the_surface_is_drawn_in_and_comes_back(self):
        run = self.run_
        before, dented, after = run.shapes(1, run.index("puncture"), len(run.time_s))["shapes"]
        rest = np.array(before["surface_m"])
        depth = np.linalg.norm(np.array(dented["surface_m"]) - rest, axis=1).max()
        left = np.linalg.norm(np.array(after["surface_m"]) - rest, axis=1).max()
        self.assertGreater(depth, 1e-3)
        self.assertLess(left, 0.05 * depth)


class LumbarPuncture(Scene):
    name = "lumbar-puncture"
    SKIN, FAT, LIGAMENT, FLAVUM, EPIDURAL = range(5)

    def test_layers_in_order(self):
        self.check_quiet()
        entered = [(kind, layer) for _, kind, layer, _ in self.run_.events
                   if kind in ("puncture", "layer")][:5]
        self.assertEqual(entered, [("puncture", self.SKIN), ("layer", self.FAT),
                                   ("puncture", self.LIGAMENT), ("puncture", self.FLAVUM),
                                   ("layer", self.EPIDURAL)])

    def test_loss_of_resistance_within_one_tick(self):
        run = self.run_
        at = next(tick for tick, _, layer, _ in run.events if layer == self.EPIDURAL) - 1
        cutting = run.parts_n["cutting"]
        self.assert_within(cutting[at - 1], 9, 0.02)  # what it takes to cut the ligamentum flavum
        self.assertLess(cutting[at], 0.1)
        # The tissue the tip had dragged along springs back and rubs: the whole follows.
        self.assertLess(run.axial_n[at], 0.7 * run.axial_n[at - 1])
        self.assertLess(run.axial_n[at + 150], 0.25 * run.axial_n[at - 1])


if __name__ == "__main__":
    unittest.main()
