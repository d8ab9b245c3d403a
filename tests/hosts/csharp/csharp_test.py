#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The C# package under mono: the same bits as from C, no allocation in a frame, refusals that name
fields, organs and simulations that end in any order, the library's own loop.

usage: csharp_test.py LIBRARY_FOLDER EXAMPLE_IN_C STYLET_ORGAN
"""
import json
import os
import pathlib
import re
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

    def test_every_asset_has_a_number_of_its_own(self):
        """Unity gives files without .meta new numbers on every machine, and warns of a .meta that
        has no file. It does not look into folders whose name ends with ~, but their content is
        copied into a project."""
        assets = {path for path in PACKAGE.rglob("*") if path.suffix != ".meta"
                  and not path.name.endswith("~") and "Examples~" not in path.parts
                  and path != PACKAGE / "Samples~/Insert"}
        metas = set(PACKAGE.rglob("*.meta"))
        self.assertEqual({path.with_name(path.name + ".meta") for path in assets}, metas)
        numbers = [re.search(r"^guid: ([0-9a-f]{32})$", path.read_text(), re.MULTILINE)[1]
                   for path in metas]
        self.assertEqual(len(set(numbers)), len(numbers))

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
        self.assertEqual(self.ask("closed"), 7 * ["ObjectDisposedException"])

    def test_every_call_holds_the_objects_it_uses(self):
        """Only functions that free take a bare pointer; new functions are found by reflection."""
        self.assertEqual(self.ask("handles"), [
            "stylet_batch_free", "stylet_device_close", "stylet_guard_free", "stylet_loop_free",
            "stylet_organ_free", "stylet_simulation_free"])

    def test_declares_all_functions_and_structs_of_the_interface(self):
        c = PACKAGE.parent / "c"
        functions = re.findall(r"stylet_\w+", (c / "symbols.txt").read_text())
        lines = self.ask("declared")
        self.assertEqual(sorted(line for line in lines if " " not in line), sorted(functions))
        sizes = {name: int(size) for name, size in (line.split() for line in lines if " " in line)}
        # As C's names are: stylet_loop_config is LoopConfig.
        structs = re.findall(r"^} (stylet_\w+);", "".join(
            (c / f"include/stylet/{name}.h").read_text() for name in ("stylet", "stylet_loop")),
            re.MULTILINE)
        own = {"stylet_event": "Happened", "stylet_organ_info": "OrganInfo"}
        left_out = {"stylet_command", "stylet_device_functions"}  # of callbacks: README.md
        names = {own.get(each) or each[7:].title().replace("_", ""): each for each in structs
                 if each not in left_out}
        self.assertEqual(set(sizes), set(names))
        program = pathlib.Path(self.folder.name) / "sizes.c"
        program.write_text("#include <stdio.h>\n#include <stylet/stylet_loop.h>\nint main(void) {\n"
                           + "".join(f'printf("%zu\\n", sizeof({names[name]}));\n'
                                     for name in sizes) + "return 0;\n}\n")
        subprocess.run(["cc", program, f"-I{c / 'include'}", "-o", program.with_suffix("")],
                       check=True)
        told = subprocess.run([program.with_suffix("")], check=True, text=True,
                              capture_output=True).stdout
        self.assertEqual(list(sizes.values()), list(map(int, told.split())), list(sizes))

    def test_many_at_once(self):
        same, copy, refused = self.ask("batch")
        self.assertEqual(same, "True True True 200")
        self.assertEqual(copy, "200 201")
        self.assertIn("3 inputs, 2 outputs: expected as many of both", refused)

    def test_a_guard(self):
        cut, field, model = self.ask("guard")
        most, fault, used, rearmed = cut.split("|")
        self.assertEqual((most, used, rearmed), ("1.000", "3000", "False"))
        self.assertIn("kernel", fault)
        self.assertEqual(field, "guard.max_force_n -1")
        self.assertNotEqual(model, "")

    def test_what_is_seen(self):
        material, counts, needle, rest = self.ask("more")
        self.assertRegex(material, "^[a-z]+ True True$")
        self.assertEqual(counts, "True True True")
        self.assertEqual(needle, "True 0 600 True")
        self.assertRegex(rest, r"^True \d+\.\d+\.\d+ puncture$")

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
