#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""No scene buzzes or makes energy with the dynamics of a Touch or an omega.7; see limit_cycles.py.

usage: limit_cycles_test.py Measure   or   limit_cycles_test.py SCENE...   (without the names: both)
with STYLET_BIN in the environment
"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import limit_cycles  # noqa: E402
import play  # noqa: E402

LEAST_J = -1e-6
LEAST_SEEN = 0.6


class Measure(unittest.TestCase):
    """The measure finds a buzz, and nothing else."""

    PERIOD_S = 1e-3

    def worst(self, force, steps=(), lasting=False):
        """A wave along the second of three axes, on top of half a newton along the first."""
        whole = np.zeros((len(force), 3))
        whole[:, 0], whole[:, 1] = 0.3, force
        return limit_cycles.worst_ripple(whole, steps, self.PERIOD_S, lasting)

    def time_s(self, seconds=3):
        return np.arange(round(seconds / self.PERIOD_S)) * self.PERIOD_S

    def test_a_buzz_has_its_amplitude_and_its_place(self):
        for hz in (25, 60, 200, 450):
            time_s = self.time_s()
            buzz = 0.03 * np.sin(2 * np.pi * hz * time_s) * ((time_s > 1) & (time_s < 1.5))
            amplitude, bar, tick, seen = self.worst(buzz)
            self.assertAlmostEqual(amplitude, 0.03, delta=0.003, msg=f"{hz} Hz")
            self.assertEqual((bar, seen), (limit_cycles.BAR_N, 1))
            self.assertTrue(900 <= tick <= 1500)

    def test_a_moving_hand_is_no_buzz(self):
        for hz in (0.5, 2, 4):
            amplitude, *_ = self.worst(np.sin(2 * np.pi * hz * self.time_s()))
            self.assertLess(amplitude, 0.02, f"{hz} Hz")

    def test_a_known_step_is_left_out_and_its_ringing_is_not(self):
        time_s = self.time_s()
        step = np.where(time_s < 1, 1.0, 0.2)
        self.assertGreater(self.worst(step)[0], 0.1)
        self.assertLess(self.worst(step, steps=[1001])[0], 1e-9)
        ringing = step + (time_s > 1) * 0.05 * np.sin(2 * np.pi * 40 * time_s)
        self.assertGreater(self.worst(ringing, steps=[1001])[0], 0.045)

    def test_a_buzz_lasts_and_a_single_step_does_not(self):
        time_s = self.time_s()
        step = np.where(time_s < 1.5, 1.0, 0.2)
        self.assertLess(self.worst(step, lasting=True)[0], 0.02)
        buzz = 0.03 * np.sin(2 * np.pi * 50 * time_s)
        self.assertGreater(self.worst(step + buzz, lasting=True)[0], 0.027)

    def test_the_bar_of_a_large_force_is_a_fraction_of_it(self):
        whole = np.tile([3.0, 4.0, 0.0], (1000, 1))
        whole[:, 1] += 0.1 * np.sin(2 * np.pi * 50 * self.time_s(1))
        self.assertAlmostEqual(limit_cycles.worst_ripple(whole, [], 1e-3, False)[1], 0.25, 3)

    def test_every_scene_can_be_given_a_device(self):
        for name in play.scene_names():
            text = (play.HERE / f"{name}.toml").read_text()
            changed = limit_cycles.with_model(text, "touch")
            needles = max(text.count("[[needles]]"), 1)
            self.assertEqual(changed.count('model = "touch"'), needles, name)
            self.assertNotIn("max_force_n", changed.split("[[obstacles]]")[0], name)


class Scenes(unittest.TestCase):
    names = play.scene_names()

    def test_no_limit_cycle_and_no_energy_from_nowhere(self):
        measured = 0
        with tempfile.TemporaryDirectory() as folder:
            for name in self.names:
                of_scene = []
                for model in limit_cycles.MODELS:
                    with self.subTest(scene=name, device=model):
                        try:
                            rows = limit_cycles.measure(name, model, folder)
                        except play.DataMissing as missing:
                            print(f"{name}: skipped: {missing}")
                            break
                        measured += 1
                        of_scene.append(rows)
                        for row in rows:
                            self.check(row)
                self.check_page(name, of_scene)
        if measured == 0:
            self.skipTest("the data of these scenes are missing")

    def check_page(self, name, of_scene):
        """A run on a virtual clock has the same bits everywhere, and therefore the same line."""
        if len(of_scene) == len(limit_cycles.MODELS):
            with self.subTest(scene=name):
                self.assertIn(limit_cycles.line_of(name, of_scene),
                              limit_cycles.PAGE.read_text().splitlines(),
                              f"stale: tests/e2e/limit_cycles.py --write {name}")

    def check(self, row):
        text = str(row)
        self.assertLess(row["ripple_n"], row["bar_n"], text)
        self.assertGreater(row["seen"], LEAST_SEEN, text)
        self.assertGreater(row["largest_n"], 0.1, text)
        self.assertGreaterEqual(row["guard_j"], LEAST_J, text)
        if row["hand_j"] is not None:
            self.assertGreaterEqual(row["hand_j"], LEAST_J, text)
        self.assertEqual((row["fault"], row["damped"]), ("none", 0), text)


if __name__ == "__main__":
    chosen = [word for word in sys.argv[1:] if word in Scenes.names]
    if chosen:
        Scenes.names = chosen
        sys.argv[1:] = ["Scenes"]
    unittest.main()
