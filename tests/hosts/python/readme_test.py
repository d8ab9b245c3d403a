#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The Python code of hal/hosts/python/README.md runs as it is written, and draws what the page
says."""
import os
import re
import unittest

import matplotlib
import stylet
from support import SOURCE, folder, program

matplotlib.use("Agg")


class Readme(unittest.TestCase):
    def test_blocks_of_python(self):
        text = (SOURCE / "hal/hosts/python/README.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", text, re.S)
        self.assertEqual(len(blocks), 1)
        self.assertLessEqual(len([line for line in blocks[0].splitlines() if line]), 10)
        program("stylet-organ")  # which makes the phantom
        before = os.getcwd()
        os.chdir(folder())
        self.addCleanup(os.chdir, before)
        names = {}
        exec(blocks[0], names)
        self.assertTrue((folder() / "force.png").exists())
        self.assertIn(stylet.Event.PUNCTURE, names["simulation"].events()["kind"])
        last = names["outputs"][-1]
        self.assertEqual(last.phase, stylet.Phase.INSERTED)
        self.assertTrue(0 < last.depth_m < 0.03)  # 30 mm, less what tissue gave way


if __name__ == "__main__":
    unittest.main()
