#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The project for Godot, run by Debian's engine without a window: it has the bits of the interface
in C in every frame, and Godot's own layout of a surface; refusals are explained in words.

usage: godot_test.py SOURCE BUILD_FOLDER FOLDER_OF_LIBSTYLET STYLET_ORGAN
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
from command import run, source_is_missing

SOURCE, BUILD, LIBRARY, ORGAN_MAKER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
GODOT = SOURCE / "hal/hosts/godot"
HERE = SOURCE / "tests/hosts/godot"
HEADERS = BUILD / "headers"
STRICT_C = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{SOURCE}/hal/hosts/c/include"]
LINK = [f"-L{LIBRARY}", "-lstylet", "-lm", f"-Wl,-rpath,{LIBRARY}"]
SKIPPED, TICKS_OF_A_FRAME = 77, 10


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


class Godot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        cls.project = cls.top / "project"
        shutil.copytree(GODOT / "project", cls.project)
        for name in "frames.gd", "automatic.gd":
            shutil.copy(HERE / name, cls.project)
        scene = (cls.project / "insert.tscn").read_text()
        (cls.project / "automatic.tscn").write_text(scene.replace("insert.gd", "automatic.gd"))
        cls.organ = cls.project / "liver.organ"
        run(ORGAN_MAKER, "phantom", "liver", "--voxel-mm", 10, "-o", cls.organ)
        run(*STRICT_C, "-shared", "-fPIC", f"-I{HEADERS}", f"-I{SOURCE}",
            GODOT / "src/stylet_godot.c", *LINK, "-o", cls.project / "libstylet_godot.so")
        run("cc", "-std=gnu11", "-shared", "-fPIC", "-DLARGE=20000", HERE / "large_blocks.c",
            "-ldl", "-o", cls.top / "large_blocks.so")
        run(*STRICT_C, HERE / "replay.c", *LINK, "-o", cls.top / "replay")

    def godot(self, *words, status=0, **env):
        return run("godot3-server", "--no-window", "--path", self.project, *words,
                   status=status, timeout=300, env={**os.environ, "HOME": str(self.top), **env})

    def frames(self, count, **env):
        return self.godot("-s", "res://frames.gd", FRAMES=str(count), **env)

    def test_frames_ask_for_no_memory_as_large_as_a_surface(self):
        """The surface has 50 kB. If a loop of the script held it, it would be copied in every
        frame."""
        counts = [re.search(r"^large blocks (\d+)$", self.frames(
            count, LD_PRELOAD=str(self.top / "large_blocks.so")), re.M)[1] for count in (200, 1500)]
        self.assertGreater(int(counts[0]), 0)
        self.assertEqual(*counts)

    def test_every_frame_has_the_force_of_the_interface_in_c(self):
        log = self.top / "log"
        said = self.godot("res://automatic.tscn", STYLET_INSERT_LOG=str(log))
        told = run(self.top / "replay", self.organ, log, TICKS_OF_A_FRAME)
        frames, others, most_n = re.match(r"frames (\d+), other forces (\d+), at most (\S+) N",
                                          told).groups()
        self.assertEqual((frames, others), ("210", "0"))
        self.assertGreater(float(most_n), 0.3)  # the needle has been in the liver
        self.assertEqual(re.search(r"state (\w{16})", said)[1],
                         re.search(r"state (\w{16})", told)[1])

    def test_without_an_organ_the_project_says_so_and_ends(self):
        self.organ.rename(self.top / "away")
        try:
            self.assertIn("liver.organ cannot be read", self.godot(status=1))
        finally:
            (self.top / "away").rename(self.organ)

    def test_answers_of_the_class(self):
        said = self.frames(1500)
        for line in ("before (0, 0, 0) 0 0", "after 0 -1", "opened True", "layout True",
                     "box True True", "ray True -1", "needle 9 phase 2 pushed back True",
                     "reset True []"):
            self.assertRegex(said, "(?m)^" + re.escape(line) + "$")
        # The phantom's volume, which is 1111.67 ml according to stylet-organ.
        self.assertIn("volume 1111.7 ml", said)

    def test_refusals_say_what_was_expected(self):
        said = self.frames(1500)
        for pattern in (r"^bytes: .+", r"^words: Stylet.open: expected a PoolByteArray of an organ",
                        r"^key: needle\.lenght_m: expected a number of stylet_needle",
                        r"^value: needle\.length_m \[0\]: 7: expected \S+ to \S+"):
            self.assertRegex(said, "(?m)" + pattern)


if __name__ == "__main__":
    if shutil.which("godot3-server") is None:
        skip("no godot3-server here; toolchain/setup.sh full installs it")
    if not HEADERS.exists():
        made = subprocess.run([GODOT / "headers.py", HEADERS], capture_output=True, text=True)
        if source_is_missing(made.stderr):
            skip(source_is_missing(made.stderr))
        if made.returncode != 0:
            sys.exit(made.stderr)
    unittest.main(argv=sys.argv[:1])
