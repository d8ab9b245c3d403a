#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The C# package under mono: the same bits as from C, no allocation in a frame, refusals that name
fields, organs and simulations that end in any order, the library's own loop.

usage: csharp_test.py LIBRARY_FOLDER EXAMPLE_IN_C STYLET_ORGAN
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

LIBRARY, EXAMPLE_IN_C, STYLET_ORGAN = sys.argv[1:4]
HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parents[2] / "hal/hosts/unity"


@unittest.skipUnless(shutil.which("mcs") and shutil.which("mono"),
                     "mono is missing (Debian: mono-mcs mono-runtime)")
class CSharp(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        cls.organ = folder / "liver.organ"
        subprocess.run([STYLET_ORGAN, "phantom", "liver", "--voxel-mm", "7", "-o", cls.organ],
                       check=True, capture_output=True)
        runtime = sorted(map(str, (PACKAGE / "Runtime").glob("*.cs")))
        cls.program = {}
        for sources in ([PACKAGE / "Examples~/Insert.cs"],
                        [HERE / f"{name}.cs" for name in ("Frames", "Lives", "Drawn")]):
            name = sources[0].stem
            cls.program[name] = folder / f"{name}.exe"
            subprocess.run(["mcs", "-unsafe", "-optimize+", "-warnaserror",
                            f"-out:{cls.program[name]}", *map(str, sources), *runtime], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_program(self, name, *arguments):
        done = subprocess.run(["mono", self.program[name], *arguments], text=True,
                              capture_output=True, timeout=300,
                              env={**os.environ, "LD_LIBRARY_PATH": LIBRARY})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.split("\n")[:-1]

    def ask(self, question):
        return self.run_program("Frames", question, self.organ)

    def test_inserts_as_the_example_in_c(self):
        in_c = subprocess.run([EXAMPLE_IN_C, self.organ], check=True, capture_output=True,
                              text=True).stdout
        self.assertEqual(self.run_program("Insert", self.organ), in_c.split("\n")[:-1])
        self.assertIn("state ", in_c)

    def test_example_is_short(self):
        lines = (PACKAGE / "Examples~/Insert.cs").read_text().splitlines()
        self.assertLessEqual(len(lines), 60)

    def test_unitys_sample_compiles(self):
        """Against a stand-in of Unity's types, in the version of C# and with the rights that its
        asmdef gives."""
        runtime = PACKAGE / "Runtime"
        self.assertTrue(json.loads((runtime / "Stylet.Needle.asmdef").read_text())
                        ["allowUnsafeCode"])
        library = pathlib.Path(self.folder.name) / "package.dll"
        own = ["mcs", "-langversion:7", "-warnaserror", "-define:UNITY_2020_3_OR_NEWER",
               "-target:library"]
        stand_in = library.with_name("UnityEngine.dll")
        subprocess.run([*own, HERE / "UnityStandIn.cs", f"-out:{stand_in}"], check=True)
        subprocess.run([*own, "-unsafe", *sorted(runtime.glob("*.cs")), f"-r:{stand_in}",
                        f"-out:{library}"], check=True)
        # A sample is part of the project's own assembly, which may not use unsafe code. Unity sets
        # its fields.
        subprocess.run([*own, "-nowarn:649", PACKAGE / "Samples~/Insert/Insert.cs",
                        f"-r:{stand_in}", f"-r:{library}", f"-out:{library.with_name('s.dll')}"],
                       check=True)

    def test_a_frame_allocates_nothing(self):
        # Mono counts blocks that it gives to a thread: the console may have taken one of them.
        grown, collections = map(int, self.ask("allocation")[0].split())
        self.assertEqual(collections, 0)
        self.assertLessEqual(grown, 8192)

    def test_refusals_name_the_field(self):
        needle, organ, empty_organ, empty_snapshot = self.ask("refusal")
        self.assertEqual(needle, "needle.length_m 1 0.700 0.001 0.500")
        self.assertEqual(organ, "101 identifier")
        self.assertRegex(empty_organ, r"^1\d\d \w+")  # of an organ, not of an argument
        self.assertIn("snapshot", empty_snapshot)

    def test_snapshots(self):
        self.assertEqual(self.ask("snapshot"), ["True True"])

    def test_objects_end_in_any_order(self):
        self.assertEqual(self.ask("life"), ["True"])

    def test_the_collector_frees_nothing_that_a_call_is_in(self):
        self.assertEqual(self.ask("collector"), ["True"])

    def test_another_thread_frees_nothing_that_a_call_is_in(self):
        same, ended = self.ask("disposal")
        self.assertEqual(same, "True")
        self.assertEqual(ended, "True")

    def test_closed_objects_say_so(self):
        self.assertEqual(self.ask("closed"), 3 * ["ObjectDisposedException"])

    def test_every_call_holds_the_objects_it_uses(self):
        """Only functions that free take a bare pointer; new functions are found by reflection."""
        self.assertEqual(self.ask("handles"), ["stylet_device_close", "stylet_loop_free",
                                               "stylet_organ_free", "stylet_simulation_free"])

    def test_drawn_arguments_end_in_an_exception_with_words(self):
        called, silent = self.ask("drawn")
        self.assertGreater(int(called), 30)
        self.assertEqual(silent, "")

    def test_a_loop_of_the_library(self):
        first, second, state = self.ask("loop")
        self.assertEqual(first, "True 1500 none True")
        happened, depth_m, nodes = second.split()
        self.assertEqual((happened, nodes), ("True", "2"))
        # 20 mm of travel, 1 mm of it in the air; the hand is a spring of 2000 N/m.
        self.assertGreater(float(depth_m), 0.012)
        self.assertLess(float(depth_m), 0.019)
        self.assertEqual(len(state), 16)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
