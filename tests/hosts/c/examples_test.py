#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The examples of a hand run and are short: there is a force, and at the end it is gone.

usage: examples_test.py GUARD LOOP ORGAN_MAKER      the programs of guard.c and loop.c
"""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
from command import output

GUARD, LOOP, ORGAN_MAKER = sys.argv[1:4]


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.organ = pathlib.Path(folder.name) / "liver.organ"
        output(ORGAN_MAKER, "phantom", "liver", "--voxel-mm", 10, "-o", cls.organ)

    def forces_n(self, program):
        """Output of a run in which this machine was on time; a guard notices when it was not."""
        for _ in range(5):
            said = output(program, self.organ)
            if "too many missed ticks" not in said:
                break
        else:
            self.skipTest("this machine was late five times")
        self.assertEqual(set(re.findall(r"N  (.*)$", said, re.M)), {"none"})
        return [float(force) for force in re.findall(r"(\S+) N  none", said)]

    def test_guard(self):
        forces_n = self.forces_n(GUARD)
        self.assertEqual(len(forces_n), 16)
        # "touch": at most 3.3 N. The phantom's capsule withstands 0.7 N.
        self.assertTrue(0.1 < max(forces_n) <= 3.3, forces_n)
        self.assertLess(abs(forces_n[0]), 1e-3)

    def test_loop(self):
        forces_n = self.forces_n(LOOP)
        self.assertTrue(0.1 < max(forces_n) < 5, forces_n)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
