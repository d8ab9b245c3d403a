#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What happens to a run when its processes are killed.

usage: process_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import random
import signal
import subprocess
import time
import unittest

import h5py

from cli_test import BIN, SCENE, Folder, call


class Run:
    """A run in real time beside the test; the machine need not be fit for it."""

    def __init__(self, organ, *arguments, scene=SCENE):
        self.process = subprocess.Popen(
            [str(part) for part in (BIN / "stylet", "run", scene, "--organ", organ,
                                    "--allow-non-rt", *arguments)],
            cwd=organ.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.process.stdout.readline()  # it has begun

    def end(self, number=signal.SIGINT, timeout=60):
        """Exit code, standard output and standard error."""
        self.process.send_signal(number)
        out, error = self.process.communicate(timeout=timeout)
        return self.process.returncode, out, error


class Killed(Folder):
    """kill -9 at any time: at most a second is lost, and what is left can be read."""

    def test_recording_survives(self):
        organ = self.make_phantom()
        for each in range(3):
            recording = self.top / f"killed{each}.h5"
            run = Run(organ, "--record", recording)
            time.sleep(random.uniform(1.2, 3))
            run.end(signal.SIGKILL)
            killed_ns = time.monotonic_ns()
            self.assertFalse(recording.exists())
            left, = self.top.glob(recording.name + ".*.tmp")
            with h5py.File(left, "r", swmr=True) as file:
                rows = min(len(file["output/tick"]), len(file["device/t_ns"]))
                self.assertEqual(list(file["output/tick"][:rows]), list(range(1, rows + 1)))
                lost_s = 1e-9 * (killed_ns - int(file["device/t_ns"][rows - 1]))
            self.assertLess(lost_s, 1)
            self.assertIn("same bits", call("stylet", "replay", left).stdout)
            call("stylet", "plot", left, "-o", self.top / "left.svg")
            hint = call("stylet", "replay", recording, expect=1).stderr
            self.assertIn(str(left), hint)


if __name__ == "__main__":
    unittest.main()
