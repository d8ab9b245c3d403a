#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The comparison of golden replays finds a difference and says where it is."""
import copy
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import golden  # noqa: E402
import play  # noqa: E402

NAME = "prostate-template"  # two needles


class Comparison(unittest.TestCase):
    def setUp(self):
        self.golden = golden.read_table()[NAME]
        self.now = copy.deepcopy(self.golden)

    def found(self):
        return golden.difference(self.golden, self.now)

    def test_finds_no_difference_between_equal_replays(self):
        self.assertEqual(self.found(), "")

    def test_names_the_stretch_and_the_number(self):
        point = self.now["points"][3]
        point[1], point[3], point[9][0] = "0" * 16, "0" * 8, 1.5
        for later in self.now["points"][4:]:
            later[1] = "1" * 16
        text = self.found()
        self.assertIn("ticks 3001 to 4000: ", text)
        self.assertIn("state hash, outputs, needle1/output/force_n differ", text)
        self.assertIn("first at tick 4000: needle1/output/force_n [1.5, ", text)

    def test_names_checksums_where_no_number_differs(self):
        self.now["points"][-1][2] = "00000000"
        self.assertIn(f"to {self.golden['ticks']}: inputs differ", self.found())

    def test_names_an_organ_that_differs_before_all_else(self):
        self.now["organ"] = "0" * 16
        self.now["points"][0][1] = "0" * 16
        self.assertIn("organ file: hash 0000000000000000, golden ", self.found())

    def test_names_length_and_events(self):
        self.now["ticks"] -= 1
        self.assertIn("ticks: ", self.found())
        self.now = copy.deepcopy(self.golden)
        self.now["puncture"][1] += 1
        self.assertIn("puncture: ", self.found())

    def test_names_points_that_are_missing(self):
        del self.now["points"][-1]
        self.assertIn("points: ", self.found())
        self.now = copy.deepcopy(self.golden)
        del self.now["points"][-1][8:]  # of the second needle
        self.assertIn("values", self.found())


class Packages(unittest.TestCase):
    def test_a_python_without_packages_is_told_which_has_them(self):
        scenes = pathlib.Path(play.__file__).resolve().parent
        for program, words in ((golden.__file__, []), (scenes / "play.py", [NAME])):
            done = subprocess.run([sys.executable, "-S", program, *words], capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"^\w+\.py: No module named 'h5py': run with /usr/bin/")


class Table(unittest.TestCase):
    def test_the_table_has_every_scene_and_no_other(self):
        self.assertEqual(sorted(golden.read_table()), play.scene_names())


if __name__ == "__main__":
    unittest.main()
