#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""stylet.dll has the functions of the header and the bits of libstylet.so: random sessions, guards
and loops, states that go from one system to the other, and what devices do there.

usage: windows_test.py SOURCE BUILD_FOLDER FOLDER_OF_LIBSTYLET STYLET_ORGAN
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, LIBRARY, ORGAN_MAKER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "tests/support"))
import wine  # noqa: E402
from command import output, source_is_missing  # noqa: E402

SKIPPED = 77
FOLDER = BUILD / "tests/hosts/windows"
DLL = FOLDER / "build/bin/stylet.dll"
HERE = SOURCE / "tests/hosts/windows"
INCLUDE = SOURCE / "hal/hosts/c/include"
STRICT_C = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-I{INCLUDE}"]
C_COMPILER = wine.COMPILER.replace("g++", "gcc")
SEEDS = range(1, 9)


def build():
    """Builds the library and the examples. Without libccd's source there is nothing to test."""
    done = subprocess.run(["cmake", "--preset", "windows", "-B", str(FOLDER / "build")], cwd=SOURCE,
                          capture_output=True, text=True)
    if done.returncode != 0:
        if source_is_missing(done.stderr):
            print(f"skipped: {source_is_missing(done.stderr)}")
            sys.exit(SKIPPED)
        sys.exit(done.stdout + done.stderr)
    output("cmake", "--build", FOLDER / "build", "-j2")


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        cls.env = wine.environment(FOLDER / "wine", WINEPATH=str(DLL.parent))
        cls.organ = cls.top / "liver.organ"
        output(ORGAN_MAKER, "phantom", "liver", "--voxel-mm", 10, "-o", cls.organ)
        session = HERE / "session.c"
        output("cc", *STRICT_C, session, f"-L{LIBRARY}", "-lstylet", f"-Wl,-rpath,{LIBRARY}",
               "-o", cls.top / "session")
        output(C_COMPILER, *STRICT_C, session, FOLDER / "build/lib/stylet.lib", "-static",
               "-o", cls.top / "session.exe")

    def here(self, *words):
        return output(self.top / "session", *words)

    def there(self, *words, status=0, **env):
        return output("wine", self.top / "session.exe", *words, status=status,
                      env={**self.env, **env})

    def expect_same(self, *words):
        told = self.here(*words)
        self.assertEqual(self.there(*words), told)
        return told


class Library(Windows):
    def test_exports_the_functions_of_the_list_and_nothing_else(self):
        text = output("x86_64-w64-mingw32-objdump", "-p", DLL)
        table = text.split("[Ordinal/Name Pointer] Table")[1].split("\n\n")[0]
        lines = (SOURCE / "hal/hosts/c/symbols.txt").read_text().splitlines()
        self.assertEqual(sorted(re.findall(r"\]\s+(?:\+base\[\s*\d+\]\s+\w+\s+)?(\w+)$", table,
                                           re.M)),
                         [line.split()[0] for line in lines if not line.startswith("#")])

    def test_needs_what_every_windows_has(self):
        text = output("x86_64-w64-mingw32-objdump", "-p", DLL)
        self.assertLessEqual(set(re.findall(r"DLL Name: (\S+)", text)),
                             {"KERNEL32.dll", "msvcrt.dll", "bcrypt.dll"})

    def test_contains_no_path_of_the_build(self):
        for place in SOURCE, BUILD:
            self.assertNotIn(str(place).encode(), DLL.read_bytes())

    def test_makes_no_aligned_move_of_a_vector_on_the_stack(self):
        """GCC's bug 54412: Windows may not have aligned the stack for it. The steps have no other
        aligned moves either."""
        for name in "avx2", "avx512":
            objects = list((FOLDER / "build").rglob(f"step_{name}.cpp.obj"))
            self.assertEqual(len(objects), 1)
            code = output("x86_64-w64-mingw32-objdump", "-d", *objects)
            self.assertIn("%zmm" if name == "avx512" else "%ymm", code)
            self.assertEqual(re.findall(r"vmov(?:ap[sd]|dqa\d*)\s.*\(.*", code), [])

    def test_is_installed_with_the_licences_of_its_parts(self):
        prefix = self.top / "prefix"
        output("cmake", "--install", FOLDER / "build", "--component", "libraries", "--prefix",
               prefix)
        found = {str(path.relative_to(prefix)) for path in prefix.rglob("*") if path.is_file()}
        self.assertEqual(found, {"bin/stylet.dll", "licences/LICENSE", "licences/libccd.txt",
                                 "licences/mingw-w64.txt"})

    def test_the_example_prints_the_same_as_on_linux(self):
        program = BUILD / "bin/stylet_example_insert_c"
        told = output(program, self.organ)
        self.assertRegex(told, r"state [0-9a-f]{16}\n$")
        windows = FOLDER / "build/bin" / (program.name + ".exe")
        self.assertEqual(output("wine", windows, self.organ, env=self.env), told)


class Bits(Windows):
    def test_of_drawn_sessions(self):
        punctures = 0
        for seed in SEEDS:
            with self.subTest(seed):
                told = self.expect_same("drawn", self.organ, seed)
                state = re.search(r"^state (\w+)$", told, re.M)[1]
                self.assertEqual(re.findall(r"^copy (\w+)$", told, re.M), 3 * [state])
                punctures += told.count("event puncture")
        self.assertGreater(punctures, 0)  # otherwise little was compared

    def test_of_states_that_go_from_one_system_to_the_other(self):
        for seed in list(SEEDS)[:3]:
            ours, theirs = self.top / f"{seed}.linux", self.top / f"{seed}.windows"
            self.here("save", self.organ, seed, ours)
            self.there("save", self.organ, seed, theirs)
            self.assertEqual(ours.read_bytes(), theirs.read_bytes())
            self.assertEqual(self.there("load", self.organ, seed, ours),
                             self.here("load", self.organ, seed, theirs))

    def test_of_guards(self):
        told = self.expect_same("guard", 1)
        self.assertIn("touch:", told)
        self.assertGreater(len(set(re.findall(r"sum (\w+)", told))), 5)

    def test_of_loops_in_virtual_time(self):
        for seed in SEEDS:
            with self.subTest(seed):
                self.expect_same("loop", self.organ, seed)


class Devices(Windows):
    def test_a_loop_in_real_time_says_that_windows_promises_no_time(self):
        told = self.there("live", self.organ, "own")
        self.assertIn("ticks 500\n", told)
        self.assertIn("Windows promises no time", told)

    def test_kinds_of_devices_that_only_linux_has_are_refused(self):
        for uri in "udp:7755", "shm:needle", "spnav:", "pointer:", "nobody:":
            told = self.there("live", self.organ, uri, status=1)
            self.assertIn(f"refused 406 {uri}: expected", told)
            self.assertIn("one of hd:, dhd:\n", told)

    def test_a_missing_vendors_library_is_named(self):
        for uri, name in ("hd:", "hd.dll"), ("dhd:", "dhd64.dll"):
            told = self.there("live", self.organ, uri, status=1)
            self.assertRegex(told, rf"refused 406 .*{name}: .*expected the vendor's library")

    def test_a_vendors_library_gives_a_device(self):
        """The library is a stand-in, compiled for Windows."""
        for uri, source in ("hd:", "standin_hd.cpp"), ("dhd:", "standin_dhd.cpp"):
            with self.subTest(uri):
                library = self.top / source.replace(".cpp", ".dll")
                output(wine.COMPILER, "-std=c++20", "-O1", "-shared", "-static",
                       SOURCE / "tests/hal/standin" / source, "-o", library)
                variable = "STYLET_LIB" + uri[:-1].upper()
                told = self.there("live", self.organ, uri, **{variable: f"Z:{library}"})
                self.assertIn("ticks 500\nanswered 1\n", told)


if __name__ == "__main__":
    if (lacking := wine.missing()) is not None:
        print(f"skipped: no {lacking} here; toolchain/setup.sh full installs it")
        sys.exit(SKIPPED)
    build()
    unittest.main(argv=sys.argv[:1])
