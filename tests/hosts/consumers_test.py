#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Other people's projects build with Stylet and get its bits: installed, moved, by CMake and by
pkg-config, and with its sources inside them, whatever flags they have.

usage: consumers_test.py CASE...    with STYLET_BUILD, STYLET_SOURCE and STYLET_INSERT_KERNEL (the
program of insert_kernel.cpp that was built with Stylet itself) in the environment
"""
import os
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import output

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
PROJECTS = SOURCE / "tests/hosts/consumers"
EXAMPLE = SOURCE / "hal/hosts/c/examples/insert.c"
SEED = SOURCE / "tests/fuzz/seeds/organ/two-materials.organ"
STRICT_C = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]


def environment(**more):
    """The environment of a user who has set nothing for Stylet and has no flatc in the PATH."""
    kept = {key: value for key, value in os.environ.items()
            if not key.startswith(("STYLET_", "CMAKE_", "PKG_CONFIG", "LD_LIBRARY"))}
    return {**kept, **more}


def state_of(text):
    return re.search(r"state ([0-9a-f]{16})", text)[1]


class Consumers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        cls.organ = cls.make_organ()
        # The results that all others must have: those of the library and the kernel as built here.
        library = BUILD / "lib"
        reference = cls.top / "reference"
        output("cc", *STRICT_C, EXAMPLE, f"-I{SOURCE}/hal/hosts/c/include", f"-L{library}",
               "-lstylet", f"-Wl,-rpath,{library}", "-o", reference)
        cls.state = state_of(output(reference, cls.organ))
        cls.kernel_state = state_of(output(os.environ["STYLET_INSERT_KERNEL"], cls.organ))

    @classmethod
    def make_organ(cls):
        """A liver, if the program for it was built: the needle goes in, sticks and slips."""
        program = BUILD / "bin/stylet-organ"
        if not program.exists():
            return SEED
        organ = cls.top / "liver.organ"
        output(program, "phantom", "liver", "--voxel-mm", 10, "-o", organ)
        return organ

    def configure(self, project, folder, *settings, **env):
        output("cmake", "-S", PROJECTS / project, "-B", folder, "-G", "Ninja",
               f"-DCONSUMER_SOURCE={SOURCE}", *settings, env=environment(**env))
        output("cmake", "--build", folder, "-j2", env=environment(
            CCACHE_BASEDIR=str(SOURCE), CCACHE_NOHASHDIR="1"))

    def state_after(self, program, **env):
        return state_of(output(program, self.organ, env=environment(**env)))


class Installed(Consumers):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        first, cls.prefix = cls.top / "first", cls.top / "moved to"
        for component in ("libraries", "development"):
            output("cmake", "--install", BUILD, "--component", component, "--prefix", first)
        first.rename(cls.prefix)
        # A flatc that fails: an installed tree has the generated header, so nobody may call it.
        cls.tools = cls.top / "tools"
        cls.tools.mkdir()
        (cls.tools / "flatc").write_text("#!/bin/sh\nexit 1\n")
        (cls.tools / "flatc").chmod(0o755)

    def build(self, languages, standard, static, components=""):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.top))
        self.configure("installed", folder, f"-DCONSUMER_LANGUAGES={languages}",
                       f"-DCONSUMER_STANDARD={standard}", f"-DCONSUMER_STATIC={static}",
                       f"-DCONSUMER_COMPONENTS={components}", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                       PATH=f"{self.tools}:{os.environ['PATH']}")
        return folder

    def test_lines_of_the_page(self):
        """The lines of hal/hosts/c/README.md, in the smallest possible project."""
        page = (SOURCE / "hal/hosts/c/README.md").read_text()
        block = re.search(r"## Built with CMake\n+```cmake\n(.*?)```", page, re.S)[1]
        find, link = block.strip().splitlines()
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.top))
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.16)\nproject(page LANGUAGES C)\n"
            f"{find}\nadd_executable(trainer {EXAMPLE})\n{link}\n")
        output("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}",
               env=environment())
        output("cmake", "--build", folder / "build", env=environment())
        self.assertEqual(self.state_after(folder / "build/trainer"), self.state)

    def test_c99_by_find_package(self):
        self.assertEqual(self.state_after(self.build("C", 99, "OFF") / "insert_c"), self.state)

    def test_cxx17_by_find_package(self):
        folder = self.build("CXX", 17, "OFF")
        self.assertRegex(output(folder / "insert_cxx", self.organ), r"^same of \d+\.\d+\.\d+$")

    def test_static_libraries_by_find_package(self):
        """The project asks for standard 17; the libraries ask for 20, which their headers need."""
        for standard in (17, 20):
            folder = self.build("CXX", standard, "ON")
            self.assertEqual(self.state_after(folder / "insert_kernel"), self.kernel_state)
            self.assertRegex(output(folder / "loop", SEED), r"^a hand: 45[01] ticks, .*none$")
        # Inside a plugin nothing else sees them, not even a libstylet.so beside it.
        plugin = folder / "libplugin.so"
        exported = output("nm", "-DC", "--defined-only", plugin)
        self.assertIn(" T main", exported)
        self.assertNotIn("stylet", exported)
        self.assertEqual(state_of(output(folder / "player", plugin, self.organ)), self.kernel_state)

    def test_components(self):
        self.build("C", 99, "OFF", "stylet;kernel;hal")
        with self.assertRaisesRegex(AssertionError, "nonsense: expected stylet, kernel or hal"):
            self.build("C", 99, "OFF", "stylet;nonsense")

    def test_versions(self):
        """A project gets this version and none that promises something else."""
        project = re.search(r"project\(stylet VERSION (\d+)\.(\d+)", (
            SOURCE / "CMakeLists.txt").read_text())
        major, minor = map(int, project.groups())
        env = environment(PKG_CONFIG_PATH=str(next(self.prefix.glob("**/pkgconfig"))))
        for wanted, fits in ((f"{major}.{minor}", True), (f"{major}.{minor + 1}", False),
                             (f"{major + 1}.0", False)):
            folder = pathlib.Path(tempfile.mkdtemp(dir=self.top))
            (folder / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.16)\nproject(page LANGUAGES C)\n"
                f"find_package(stylet {wanted})\nmessage(STATUS \"found: ${{stylet_FOUND}}\")\n")
            said = output("cmake", "-S", folder, "-B", folder / "build",
                          f"-DCMAKE_PREFIX_PATH={self.prefix}", env=environment())
            self.assertIn(f"found: {int(fits)}", said, wanted)
            output("pkg-config", "--atleast-version", wanted, "stylet", env=env,
                   status=0 if fits else 1)

    def test_c99_by_pkg_config(self):
        folder = next(self.prefix.glob("**/pkgconfig"))
        env = environment(PKG_CONFIG_PATH=str(folder))
        words = output("pkg-config", "--cflags", "--libs", "stylet", env=env)
        program = self.top / "by_pkg_config"
        # The folder's name has a blank, which pkg-config escapes for the shell.
        output("sh", "-c", f"cc {' '.join(STRICT_C)} {EXAMPLE} {words.strip()} -o {program}")
        self.assertEqual(self.state_after(program, LD_LIBRARY_PATH=str(folder.parent)), self.state)
        self.assertEqual(output("pkg-config", "--modversion", "stylet", env=env).strip(),
                         re.search(r"project\(stylet VERSION (\S+)",
                                   (SOURCE / "CMakeLists.txt").read_text())[1])

    def test_contains_no_path_of_the_build(self):
        for path in self.prefix.rglob("*"):
            if path.suffix in (".cmake", ".pc", ".h", ".inc") and path.is_file():
                for place in (SOURCE, BUILD, self.top):
                    self.assertNotIn(str(place), path.read_text(), path)


class Inside(Consumers):
    """Flags of the parent that would change the bits, or stop at a warning, do not reach Stylet."""
    PARENTS = {"strict": "-Werror -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wuseless-cast",
               "engine": "-O2 -flto -fno-exceptions -fno-rtti -fno-threadsafe-statics"
                         " -fvisibility=hidden -fvisibility-inlines-hidden -ffunction-sections"
                         " -fassociative-math -freciprocal-math -fno-signed-zeros"
                         " -fno-trapping-math -ffinite-math-only",
               "unoptimised": "-O0",
               "fast": "-O3 -ffast-math -funroll-loops",
               "fastest": "-Ofast -ffp-contract=fast -march=haswell"}

    def expect_same_bits(self, name, alone):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.top))
        # Its build type sets no level of optimisation.
        self.configure("inside", folder, "-DCMAKE_BUILD_TYPE=None",
                       f"-DCONSUMER_KERNEL_ALONE={alone}",
                       f"-DCMAKE_CXX_FLAGS={self.PARENTS[name]}")
        self.assertEqual(self.state_after(folder / "insert_kernel"), self.kernel_state, name)
        if alone == "OFF":
            self.assertEqual(self.state_after(folder / "insert_c"), self.state, name)

    def test_strict_parent(self):
        self.expect_same_bits("strict", "OFF")
        self.expect_same_bits("strict", "ON")

    def test_parent_with_the_flags_of_engines(self):
        """Without exceptions and run-time types, and with parts of -ffast-math."""
        self.expect_same_bits("engine", "OFF")

    def test_parent_without_optimisation(self):
        self.expect_same_bits("unoptimised", "ON")

    def test_fast_parents(self):
        self.expect_same_bits("fast", "OFF")
        self.expect_same_bits("fastest", "ON")


if __name__ == "__main__":
    unittest.main()
