#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Simulations from Python give the bits of the C interface, and refusals have place and limits.

Expected values: what the example in C prints, which is compiled here; geometry in closed form; the
limits of stylet.h and of the files' format.
"""
import os
import subprocess
import threading
import time
import unittest

import numpy as np
import stylet
from support import BUILD, DOWN, SOURCE, folder, insertion, organ, organ_file, simulation


def bytes_of(outputs):
    return np.ascontiguousarray(outputs).tobytes()


class SameBits(unittest.TestCase):
    def test_example_is_that_in_c(self):
        program = folder() / "insert"
        library = BUILD / "lib"
        subprocess.run(["cc", "-std=c99", SOURCE / "hal/hosts/c/examples/insert.c", "-o", program,
                        f"-I{SOURCE}/hal/hosts/c/include", f"-L{library}", "-lstylet",
                        f"-Wl,-rpath,{library}"], check=True)
        in_c = subprocess.run([program, organ_file()], check=True, capture_output=True, text=True)
        example = SOURCE / "hal/hosts/python/examples/insert.py"
        picture = folder() / "force.png"
        in_python = subprocess.run(["/usr/bin/python3", example, organ_file(), picture],
                                   check=True, capture_output=True, text=True)
        self.assertIn("state ", in_c.stdout)
        self.assertEqual(in_python.stdout, in_c.stdout)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_ticks_one_by_one_and_in_a_run(self):
        poses = insertion(1500)  # more than a run takes in one part
        one, many, ready = simulation(), simulation(), simulation()
        outputs = many.run(poses)
        given = np.empty(len(poses), stylet.output_dtype)
        self.assertIs(ready.run(stylet.inputs(poses), out=given), given)
        for i, pose in enumerate(poses):
            self.assertEqual(bytes_of(one.tick(pose)), bytes_of(outputs[i]))
        self.assertEqual(bytes_of(given), bytes_of(outputs))
        self.assertEqual({one.hash(), many.hash(), ready.hash()}, {one.hash()})
        self.assertGreater(outputs["depth_m"][-1], 0.01)

    def test_two_needles(self):
        poses = np.stack([insertion(600, (-0.01, 0)), insertion(600, (0.01, 0))], axis=1)
        needles = [stylet.Needle(), stylet.Needle(bending_nm2=0.02)]
        one, many = simulation(needles), simulation(needles)
        outputs = many.run(poses)
        self.assertEqual(outputs.shape, (600, 2))
        for i, pose in enumerate(poses):
            self.assertEqual(bytes_of(one.tick(pose)), bytes_of(outputs[i]))
        self.assertEqual(one.hash(), many.hash())

    def test_a_tick_without_sample_keeps_the_pose_and_counts(self):
        poses = insertion(400)
        told, left_out, none = simulation(), simulation(), simulation()
        valid = np.ones(400, bool)
        valid[200:300] = False
        shaken = poses.copy()
        shaken[200:300] += 0.5
        a = told.run(stylet.inputs(poses, valid))
        b = left_out.run(shaken, valid)
        for i, pose in enumerate(poses):
            none.tick(pose if valid[i] else None)
        self.assertEqual(bytes_of(a), bytes_of(b))
        self.assertEqual(told.hash(), none.hash())
        self.assertEqual(told.stats().input_missing, 100)
        self.assertTrue((a["flags"][200:300] & stylet.Flag.INPUT_MISSING).all())


    def test_a_syringe_is_pressed(self):
        """Pressed where no fluid flows, a plunger goes as far as its bubble gives: Boyle's law."""
        needle = stylet.Needle(hub="syringe", syringe_gas_m3=1e-7, plunger_friction_n=0)
        poses = insertion(900)
        rows = stylet.inputs(poses, plunger_n=np.where(np.arange(900) < 850, 0, 10))
        out = simulation([needle]).run(rows)[-1]
        area = np.pi * needle.plunger_radius_m**2
        self.assertAlmostEqual(out["hub_pa"] * area / 10, 1, 4)
        squeezed = 1e-7 * (1 - 101325 / (101325 + 10 / area))
        self.assertAlmostEqual(out["plunger_m"] * area / squeezed, 1, 3)
        self.assertEqual(out["flow_m3_per_s"], 0)


class Pose(unittest.TestCase):
    def test_of_a_tip(self):
        """The needle leaves the handle along its -z: straight down needs no rotation, and its base
        is one needle length above the tip."""
        pose = stylet.pose_of_tip((0.01, 0.02, 0.03), DOWN, 0.15)
        np.testing.assert_allclose(pose, [0.01, 0.02, 0.18, 1, 0, 0, 0], atol=1e-7)
        for direction in [(1, 0, 0), (0.6, 0, 0.8), (-2, 1, 3)]:
            x, y, z, qw, *axis = stylet.pose_of_tip((0, 0, 0), direction, 0.1).astype(float)
            unit = np.divide(direction, np.linalg.norm(direction))
            np.testing.assert_allclose([x, y, z], -0.1 * unit, atol=1e-7)
            twice = 2 * np.cross(axis, DOWN)
            turned = DOWN + qw * twice + np.cross(axis, twice)
            np.testing.assert_allclose(turned, unit, atol=1e-6)

    def test_of_many_tips_are_those_of_each(self):
        tips = np.float32([[0.1, 0.2, 0.3], [0.11, 0.21, 0.31]])
        poses = stylet.poses_of_tips(tips, (1, 2, -3), 0.15)
        for tip, pose in zip(tips, poses):
            np.testing.assert_array_equal(pose, stylet.pose_of_tip(tip, (1, 2, -3), 0.15))

    def test_tip_is_where_the_pose_says(self):
        output = simulation().tick(stylet.pose_of_tip((0.3, 0.2, 0.1), DOWN, 0.15))
        np.testing.assert_allclose(output.tip_m, [0.3, 0.2, 0.1], atol=1e-7)
        self.assertEqual(output.phase, stylet.Phase.FREE)
        self.assertEqual(output.layer, stylet.NO_LAYER)


class State(unittest.TestCase):
    def test_a_clone_and_a_snapshot_go_on_in_the_same_way(self):
        poses = insertion(800)
        first = simulation()
        first.run(poses[:400])
        kept, clone = first.snapshot(), first.clone()
        self.assertIsInstance(clone, stylet.Simulation)
        self.assertIsNone(clone.difference(first))
        end = bytes_of(first.run(poses[400:]))
        self.assertIsNotNone(clone.difference(first))
        self.assertEqual(bytes_of(clone.run(poses[400:])), end)
        self.assertEqual(clone.hash(), first.hash())
        first.restore(kept)
        self.assertEqual(bytes_of(first.run(poses[400:])), end)

    def test_reset_gives_a_new_simulation(self):
        used, new = simulation(), simulation()
        used.run(insertion(500))
        used.reset()
        self.assertIsNone(used.difference(new))

    def test_obstacle_pushes_back_with_its_stiffness(self):
        """PHYSICS 13.3: K d / sqrt(1 + (K d / F)^2), where the needle's axis is 1 mm deep in the
        ball, and d is that plus the needle's radius. The ball stands beside the organ."""
        ball = stylet.Obstacle.sphere(0.01, position_m=(0.5, 0, 0), stiffness_n_per_m=1000,
                                      largest_force_n=10, friction=0)
        run = stylet.Simulation(organ(), obstacles=[ball])
        tips = np.float32([[0.5, 0, 0.02]] * 1500)
        tips[:, 2] -= np.minimum(np.arange(1500) * 1e-5, 0.011)
        output = run.run(stylet.poses_of_tips(tips, DOWN, 0.15))[-1]
        pressed_n = 1000 * (0.001 + stylet.Needle().outer_radius_m)
        expected_n = pressed_n / np.sqrt(1 + (pressed_n / 10) ** 2)
        np.testing.assert_allclose(output.obstacle_n, [0, 0, expected_n], atol=1e-4)
        touches = run.obstacle_touches()
        np.testing.assert_allclose(touches["force_on_needle_n"].sum(axis=0), output.obstacle_n,
                                   atol=1e-6)


class Needles(unittest.TestCase):
    def test_have_the_presets_of_their_names(self):
        """18G: E pi (OD^4 - ID^4) / 64 with 200 GPa, 1.270 and 0.838 mm."""
        needle = stylet.Needle.preset("18G-tuohy", unit_m=0.004)
        self.assertAlmostEqual(needle.outer_radius_m, 0.635e-3, places=9)
        self.assertAlmostEqual(needle.bending_nm2 / 2.070e-2, 1, places=3)
        self.assertAlmostEqual(needle.torn_diameters, np.pi / 2, places=6)
        self.assertAlmostEqual(needle.unit_m, 0.004, places=9)
        with self.assertRaisesRegex(ValueError, "'18G-sharp': expected one of 17G, .*18G-tuohy"):
            stylet.Needle.preset("18G-sharp")


class Refused(unittest.TestCase):
    def refusal(self, call, *arguments, **named):
        with self.assertRaises(stylet.StyletError) as caught:
            call(*arguments, **named)
        return caught.exception

    def test_configuration_names_field_value_and_limits(self):
        why = self.refusal(stylet.Simulation, organ(),
                           [stylet.Needle(), stylet.Needle(length_m=-1)])
        self.assertEqual(why.status, stylet.Status.CONFIG_VALUE_OUT_OF_RANGE)
        self.assertEqual((why.place, why.index, why.value), ("needle.length_m", 1, -1))
        self.assertGreater(why.least, 0)
        self.assertIn("needle.length_m", str(why))
        why = self.refusal(simulation, substeps=33)
        self.assertEqual((why.place, why.value, why.most), ("substeps", 33, 32))

    def test_organ_names_the_place(self):
        content = bytearray(organ_file().read_bytes())
        content[-1] ^= 1
        self.refusal(stylet.Organ.from_bytes, bytes(content))
        why = self.refusal(stylet.Organ.from_bytes, b"short")
        self.assertEqual(why.status, stylet.Status.ORGAN_TOO_SMALL)
        why = self.refusal(stylet.Organ.read, folder() / "missing.organ")
        self.assertEqual(why.status, stylet.Status.FILE_UNREADABLE)
        self.assertIn("missing.organ", str(why))

    def test_any_path_of_the_system_can_be_opened(self):
        """So can names that are not UTF-8, for which Python has surrogates; and no name ends at a
        zero byte."""
        for name in ("Leber \u809d.organ", os.fsdecode(b"Leber \xff.organ"), b"\xfe.organ"):
            path = os.path.join(os.fsencode(folder()), os.fsencode(name))
            with open(path, "wb") as file:
                file.write(organ_file().read_bytes())
            for given in (path, os.fsdecode(path)):
                self.assertEqual(stylet.Organ.read(given).info.hash, organ().info.hash)
        with self.assertRaisesRegex(ValueError, "path.*byte 0"):
            stylet.Organ.read(f"{organ_file()}\0.txt")

    def test_snapshot_of_another(self):
        other = simulation(substeps=2).snapshot()
        why = self.refusal(simulation().restore, other)
        self.assertEqual(why.status, stylet.Status.SNAPSHOT_DOES_NOT_MATCH)

    def test_obstacles_after_the_first_tick(self):
        run = simulation()
        run.tick(None)
        why = self.refusal(run.set_obstacles, [stylet.Obstacle()])
        self.assertEqual(why.status, stylet.Status.OBSTACLES_TOO_LATE)

    def test_wrong_names_types_and_shapes(self):
        for call, kind in [(lambda: stylet.Needle(lenth_m=1), AttributeError),
                           (lambda: stylet.Config(substeps=-1), ValueError),
                           (lambda: stylet.Config(substeps=1.5), TypeError),
                           (lambda: stylet.Config(mode="exact"), ValueError),
                           (lambda: stylet.Simulation(organ(), needles=[1]), TypeError),
                           (lambda: simulation().tick(np.zeros(6)), ValueError),
                           (lambda: simulation().tick(np.zeros((2, 7))), ValueError),
                           (lambda: simulation().run(np.zeros((5, 2, 7))), ValueError),
                           (lambda: simulation().run(np.zeros((5, 7)), valid=[True]), ValueError),
                           (lambda: simulation().run(np.zeros((5, 7)), out=np.zeros(5)),
                            ValueError),
                           (lambda: simulation().needle_shape(1), IndexError)]:
            with self.assertRaises(kind):
                call()

    def test_a_second_thread_in_the_same_simulation(self):
        run, refused = simulation(), []
        poses = np.tile(insertion(2)[0], (20_000, 1))
        thread = threading.Thread(target=run.run, args=(poses,))
        thread.start()
        while thread.is_alive() and not refused:
            try:
                run.hash()
            except RuntimeError as error:
                refused.append(str(error))
        thread.join()
        self.assertEqual(refused, ["another thread is using this simulation"])


class Interpreter(unittest.TestCase):
    def test_the_interpreter_is_free_while_ticks_are_computed(self):
        """While one call of C runs, another thread of Python counts. One part of a run is one call:
        if it blocked the interpreter, the other thread could not count during it."""
        run, counted, stop = simulation(substeps=8), [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0)
        poses = insertion(1000)
        thread = threading.Thread(target=count)
        thread.start()
        try:
            before = counted[0]
            run.run(poses)
            during = counted[0] - before
        finally:
            stop.set()
            thread.join()
        self.assertGreater(during, 100)


if __name__ == "__main__":
    unittest.main()
