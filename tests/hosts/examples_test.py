#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every example is short: who begins reads it as a whole.

usage: examples_test.py SOURCE
"""
import pathlib
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
MOST_LINES = 60
FOLDERS = ("hal/examples", "hal/hosts/*/examples", "hal/hosts/unity/Examples~",
           "hal/hosts/unity/Samples~/*", "hal/hosts/godot/project", "offline/python/examples")
CODE = {".c", ".cpp", ".cs", ".gd", ".m", ".mjs", ".py"}


class Examples(unittest.TestCase):
    def test_have_at_most_sixty_lines(self):
        files = {folder: sorted(path for path in SOURCE.glob(folder + "/*") if path.suffix in CODE)
                 for folder in FOLDERS}
        self.assertEqual([folder for folder, found in files.items() if not found], [])
        kinds = {path.suffix for found in files.values() for path in found}
        self.assertEqual(kinds, CODE)
        lines = {str(path.relative_to(SOURCE)): len(path.read_text().splitlines())
                 for found in files.values() for path in found}
        self.assertEqual({name: count for name, count in lines.items() if count > MOST_LINES}, {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
