#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Guard, devices and loop from Python.

Expected values: the limits of GUARD.md; geometry in closed form; the header's numbers.
"""
import math
import os
import random
import re
import signal
import time
import unittest

import numpy as np
import stylet
from stylet import _stylet
from support import SOURCE, organ, simulation

HEADER = (SOURCE / "hal/hosts/c/include/stylet/stylet_loop.h").read_text()


def hand(needle_length_m=0.15):
    """A pose one millimetre above the middle of the block's top, pointing down."""
    info = organ().info
    tip_m = [*(np.add(info.low_m, info.high_m)[:2] / 2), info.high_m[2] + 1e-3]
    return stylet.Hand.at(stylet.pose_of_tip(tip_m, (0, 0, -1), needle_length_m))


class Names(unittest.TestCase):
    def test_numbers_are_those_of_the_header(self):
        for kind, prefix in ((stylet.Fault, "FAULT_"), (stylet.GuardMode, "GUARD_")):
            found = re.findall(rf"STYLET_{prefix}(\w+) = (\d+)", HEADER)
            self.assertEqual({each.name: each.value for each in kind},
                             {name: int(value) for name, value in found})

    def test_models_have_guards(self):
        models = _stylet.device_models()
        self.assertIn("touch", models)
        for model in models:
            stylet.Guard(stylet.GuardConfig.for_model(model))
        with self.assertRaises(stylet.StyletError):
            stylet.GuardConfig.for_model("a broomstick")


class Guarded(unittest.TestCase):
    def test_limits_hold_whatever_is_asked(self):
        draw = random.Random(5)
        config = stylet.GuardConfig(max_force_n=3, max_slew_n_per_s=500)
        guard, now_ns, last = stylet.Guard(config), 10 ** 9, np.zeros(3)
        for tick in range(5000):
            now_ns += 1_000_000
            pose = [0, 0, 1e-3 * math.sin(tick / 200), 1, 0, 0, 0]
            guard.sample(pose if draw.random() < 0.999 else None, now_ns, seq=tick)
            asked = [draw.uniform(-30, 30) for _ in range(3)]
            if draw.random() < 2e-3:
                asked[1] = float("nan")
            sent = np.array(guard.force(asked))
            if np.isfinite(asked).all():
                # 500 N/s in 1 ms; a fault fades in 20 ms, which is slower for 3 N.
                self.assertLessEqual(np.linalg.norm(sent - last), 0.5 + 1e-5)
            self.assertLessEqual(np.linalg.norm(sent), 3 * (1 + 1e-6))
            last = sent
            if draw.random() < 0.01:
                guard.rearm(guard.report().fault)
        self.assertGreater(guard.report().faults, 0)
        self.assertGreater(guard.report().force_limited, 0)

    def test_a_silent_device_has_no_force_25_ms_later(self):
        guard = stylet.Guard()
        for tick in range(1000):
            guard.sample([0, 0, 0, 1, 0, 0, 0], 10 ** 9 + tick * 1_000_000, seq=tick)
            sent = guard.force([0, 0, 2])
        self.assertAlmostEqual(sent[2], 2, places=5)
        for tick in range(1000, 1026):
            guard.sample(None, 10 ** 9 + tick * 1_000_000)
            sent = guard.force([0, 0, 2])
        self.assertEqual(sent, [0, 0, 0])
        self.assertEqual(guard.report().fault, stylet.Fault.DEVICE_SILENT)

    def test_refusals_name_the_field(self):
        with self.assertRaises(stylet.StyletError) as refused:
            stylet.Guard(stylet.GuardConfig(max_force_n=8, max_slew_n_per_s=300))
        self.assertEqual(refused.exception.place, "guard.max_slew_n_per_s")
        self.assertAlmostEqual(refused.exception.least, 8 / 0.02, delta=0.1)


class Looped(unittest.TestCase):
    def loop(self, moved, **config):
        device = stylet.Device.simulated(0.02, 0.04, 0.2)
        return stylet.Loop(moved, device, hand(), stylet.LoopConfig(priority=0, **config)), device

    def test_runs_in_virtual_time_with_the_same_bits(self):
        hashes = []
        for _ in range(2):
            moved = simulation()
            loop, device = self.loop(moved, virtual_time=1, ticks=600)
            with loop:
                with self.assertRaises(RuntimeError):  # the first loop has it
                    stylet.Loop(simulation(), device, hand())
                loop.run()
                self.assertTrue(loop.take())
                self.assertEqual(loop.output().tick, 600)
                self.assertGreater(loop.output().depth_m, 0.01)  # 20 mm, 1 mm of it in the air
                self.assertLess(loop.output().depth_m, 0.0195)
                self.assertGreater(loop.hand().sent_force_n[2], 0.05)
                self.assertEqual(loop.hand().fault, stylet.Fault.NONE)
                surface = loop.surface().copy()
                self.assertEqual(len(loop.needle_shape()), 2)
                kinds = [each["kind"] for each in loop.events()]
                self.assertIn(stylet.Event.PUNCTURE, kinds)
                self.assertEqual(loop.report().ticks, 600)
                with self.assertRaises(stylet.StyletError) as refused:
                    moved.reset()
                self.assertEqual(refused.exception.status, stylet.Status.LOOP_RUNS)
            np.testing.assert_allclose(surface, moved.surface(), atol=1e-7)
            hashes.append(moved.hash())
        self.assertEqual(*hashes)

    def test_runs_beside_python_until_it_is_stopped(self):
        loop, _ = self.loop(simulation())
        with loop:
            loop.start()
            end = time.monotonic() + 20
            while time.monotonic() < end and not (loop.take() and loop.output().tick > 50):
                time.sleep(0.005)
            self.assertGreater(loop.output().tick, 50)
            loop.stop()
            loop.wait()
            self.assertFalse(loop.report().runs)
        with self.assertRaises(RuntimeError):
            loop.start()

    def test_forked_processes_leave_the_loop_to_the_first(self):
        """The first process has the device, and the thread that would end the loop."""
        loop, _ = self.loop(simulation())
        with loop:
            loop.start()
            child = os.fork()
            if child == 0:
                signal.alarm(60)  # ends a process that would wait for ever
                try:
                    loop.wait()
                except stylet.StyletError as refused:
                    told = refused.status == stylet.Status.LOOP_RUNS
                    loop.close()
                    os._exit(0 if told else 1)
                os._exit(2)
            self.assertEqual(os.waitpid(child, 0)[1], 0)
            self.assertTrue(loop.report().runs)
            loop.stop()
            loop.wait()

    def test_a_device_that_cannot_be_opened_is_reported(self):
        with self.assertRaises(stylet.StyletError) as refused:
            stylet.Device.open("phantom:", 0)
        self.assertEqual(refused.exception.status, stylet.Status.DEVICE_FAILED)
        self.assertIn("phantom:", str(refused.exception))


if __name__ == "__main__":
    unittest.main()
