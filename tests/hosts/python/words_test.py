#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What objects and refusals say: which organ, how many, and of a wrong value its name, itself and
what was expected.

Expected values: the organ's own numbers, and what was given.
"""
import re
import subprocess
import unittest

import numpy as np
import stylet
from support import FAST, folder, insertion, organ, organ_file, program, simulation

GOAL = stylet.Target("goal", (0.03, 0, 0.005), 0.0035)


def environment(**options):
    return stylet.NeedleEnv(organ(), [GOAL], config=stylet.Config(**FAST), **options)


class Objects(unittest.TestCase):
    def test_say_what_they_are(self):
        block = (f"<stylet.Organ {organ().info.name!r}: {organ().info.voxels} voxels of 5 mm, "
                 f"{organ().info.materials} materials>")
        two = simulation([stylet.Needle(), stylet.Needle()])
        device = stylet.Device.simulated(0.01, 0.01)
        for thing, words in (
                (organ(), block),
                (simulation(), f"<stylet.Simulation in {block}: needles 1>"),
                (two, f"<stylet.Simulation in {block}: needles 2>"),
                (stylet.VectorSimulation([two, two.clone()], 3),
                 "<stylet.VectorSimulation of 2, threads 3>"),
                (environment(), f"<stylet.NeedleEnv in {block}, targets goal>"),
                (stylet.VectorNeedleEnv([environment()]),
                 f"<stylet.VectorNeedleEnv of 1: <stylet.NeedleEnv in {block}, targets goal>>"),
                (stylet.Guard(), "<stylet.Guard: LET_GO, fault NONE, samples 0>"),
                (device, "<stylet.Device simulated>")):
            with self.subTest(words):
                self.assertEqual(repr(thing), words)
        device.close()
        self.assertEqual(repr(device), "<stylet.Device simulated: closed, or a loop has it>")
        self.assertRegex(repr(stylet.Needle()), r"^Needle\(length_m=0\.15\d*, .*rods=32")

    def test_an_organ_says_the_edges_of_all_its_voxels(self):
        path = folder() / "fine.organ"
        subprocess.run([program("stylet-organ"), "phantom", "block", "--size-mm", "48,32,24",
                        "--voxel-mm", "8", "--refine", "surface:2", "-o", path],
                       check=True, capture_output=True)
        self.assertIn(" voxels of 8 to 2 mm, ", repr(stylet.Organ.read(path)))

    def test_say_how_a_loop_is(self):
        device, hand = stylet.Device.simulated(0.01, 0.01), stylet.Hand()
        config = stylet.LoopConfig(virtual_time=1, ticks=20, priority=0)
        with stylet.Loop(simulation(), device, hand, config) as loop:
            self.assertEqual(repr(loop), "<stylet.Loop: does not run, tick 0>")
            loop.run()
            self.assertEqual(repr(loop), "<stylet.Loop: does not run, tick 20>")
        self.assertEqual(repr(loop), "<stylet.Loop: closed>")

    def test_say_what_a_recording_holds(self):
        path, scene = folder() / "out.h5", folder() / "scene.toml"
        scene.write_text(f'[organ]\npath = "{organ_file()}"\n[approach]\ndirection = [0, 0, -1]\n'
                         '[[hand.waypoint]]\ntravel_mm = 5\nspeed_mm_s = 50\n')
        subprocess.run([program("stylet"), "run", scene, "--fast", "--duration-s", "0.05",
                        "--record", path], check=True, capture_output=True)
        recording = stylet.Recording(path)
        self.assertEqual(repr(recording), f"<stylet.Recording {str(path)!r}: {recording.ticks} "
                         f"ticks of 1 ms in {organ().info.name!r}, needles 1>")
        for name, words in (("output/forces_n", "output/forces_n: no such column: .*force_n"),
                            ("force_n", "force_n: no such column: expected one of input, output")):
            with self.assertRaisesRegex(KeyError, words):
                recording[name]

    def test_fits_say_their_numbers(self):
        way = np.linspace(1, 2, 20)
        found = stylet.fit(lambda points: [point["slope"] * way for point in points],
                           {"slope": (0.1, 10)}, 2 * way, sigma=0.1)
        self.assertRegex(str(found), r"^slope +2, 95 %: 1\.9\d+ to 2\.0\d+$")
        self.assertNotIn("array", repr(found))


class Refusals(unittest.TestCase):
    def test_say_what_was_given_and_what_was_expected(self):
        two = simulation([stylet.Needle(), stylet.Needle()])
        poses = insertion(4)
        for call, words in (
                (lambda: two.tick(poses[0]), "poses: 1: expected 2, one for each needle"),
                (lambda: two.run(poses), "poses: (4,) of them: expected (ticks, 2), for ticks"),
                (lambda: simulation().run(np.zeros((4, 3, 7))),
                 "poses: (4, 3) of them: expected (ticks, 1), for ticks and needles, or (ticks,)"),
                (lambda: simulation().run(poses, [True] * 3), "valid: 3 truths: expected 4"),
                (lambda: simulation().run(poses, out=np.zeros(4)), "out: an array of shape (4,): "
                 "expected an array of output_dtype of shape (4,)"),
                (lambda: simulation().run(poses, out=[1]), "out: <class 'list'>: expected an"),
                (lambda: simulation().needle_shape(3), "needle 3: expected 0 to 0"),
                (lambda: stylet.VectorSimulation([two, simulation()]),
                 "simulations: needles: 1: expected 2, as the first one has"),
                (lambda: stylet.VectorSimulation([two]).run(np.zeros((3, 4, 2, 7))),
                 "poses: (3, 4, 2) of them: expected (1, ticks, 2), for simulations"),
                (lambda: stylet.Loop(two, stylet.Device.simulated(0.01, 0.01), stylet.Hand()),
                 "devices, hands, guards: 1, 1, 0: expected 2 of each"),
                (lambda: stylet.VectorNeedleEnv([]), "environments: none: expected one at least"),
                (lambda: stylet.VectorNeedleEnv([environment(), environment(ticks_of_step=3)]),
                 "environments: ticks_of_step [20, 3]: expected the same of all"),
                (lambda: environment().step(np.zeros(6)), "expected a call of reset first"),
                (lambda: stylet.Box(1, 0), "low = 1.0, high = 0.0: expected low up to high"),
                (lambda: stylet.draw({}, -1, 1), "count = -1: expected 1 or more"),
                (lambda: stylet.sweep(dict, [{"a": 1}, {"b": 1}], workers=0),
                 "parameters[1]: b: expected the names of the first row: a"),
                (lambda: stylet.sweep(dict, {"a": [1], "b": [1, 2]}, workers=0),
                 "parameters: a has 1, b has 2: expected columns of one length"),
                (lambda: stylet.insertion_poses(organ(), stylet.Needle(), (0.03, 0, 0), (0, 0, -1),
                                                0.01, 0.01, hold_s=-1), "hold_s = -1: expected 0")):
            with self.subTest(words):
                with self.assertRaisesRegex((ValueError, TypeError, IndexError, RuntimeError),
                                            re.escape(words)):
                    call()

    def test_of_a_scenes_targets_name_the_key(self):
        scene = folder() / "targets.toml"
        for text, words in (("", "no [[targets]]: expected at least one"),
                            ('[[targets]]\nname = "a"\nat_mm = [0, 0, 0]', "targets[0].radius_mm"),
                            ('[[targets]]\nname = "a"\nat_mm = [0, 0]\nradius_mm = 1',
                             "targets[0].at_mm of shape (2,): expected 3 numbers"),
                            ('[[targets]]\nname = "a"\nat_mm = [0, 0, 0]\nradius_mm = 0',
                             "targets[0].radius_mm = 0.0: expected more than 0")):
            scene.write_text(text)
            with self.assertRaisesRegex(ValueError, re.escape(f"{scene}: {words}")):
                stylet.read_targets(scene)


if __name__ == "__main__":
    unittest.main()
