#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The phantom by its name: it is the one that stylet-organ makes, and a message says if it is
missing."""
import subprocess
import sys
import unittest
import unittest.mock

import stylet
from support import folder, program


class Phantom(unittest.TestCase):
    def test_is_the_one_that_the_program_makes(self):
        path = folder() / "liver.organ"
        subprocess.run([program("stylet-organ"), "phantom", "liver", "--voxel-mm", "5", "-o", path],
                       check=True, capture_output=True)
        self.assertEqual(stylet.phantom("liver").info.hash, stylet.Organ.read(path).info.hash)

    def test_an_unknown_name_is_refused_with_the_known_ones(self):
        program("stylet-organ")
        with self.assertRaisesRegex(ValueError, r"phantom 'kidney': expected one of \['liver'\]"):
            stylet.phantom("kidney")
        self.assertRaisesRegex(TypeError, "name of int: expected a text", stylet.phantom, 7)

    def test_says_what_to_install(self):
        with unittest.mock.patch.object(sys.modules["stylet.phantom"], "folders",
                                        lambda: [folder() / "nowhere"]):
            with self.assertRaisesRegex(FileNotFoundError, "nowhere.*Debian: package stylet.*"
                                        "stylet-organ phantom liver -o liver.organ"):
                stylet.phantom("liver")


if __name__ == "__main__":
    unittest.main()
