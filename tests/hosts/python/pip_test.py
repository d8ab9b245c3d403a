#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The package that pip builds of its folder alone, over a Stylet installed below a prefix of its
own: phantom and scenes are found there, and nothing is left in the folder.

usage: pip_test.py      with STYLET_BUILD and STYLET_SOURCE in the environment
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])


def run(*words, **options):
    done = subprocess.run(words, text=True, capture_output=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}: {done.stdout}{done.stderr}")
    return done.stdout


class Pip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (BUILD / "share/stylet/organs/liver-phantom.organ").exists():
            raise unittest.SkipTest("the phantom is not built")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        cls.prefix, cls.own, cls.copy = (cls.top / name for name in ("a prefix", "own", "copy"))
        for component in ("libraries", "development", "program"):
            run("cmake", "--install", BUILD, "--component", component, "--prefix", cls.prefix)
        shutil.copytree(SOURCE / "hal/hosts/python", cls.copy,
                        ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        cls.before = cls.files()
        kept = {key: value for key, value in os.environ.items()
                if not key.startswith(("STYLET_", "PYTHON"))}
        cls.env = {**kept, "PYTHONPATH": str(cls.own), "HOME": str(cls.top),
                   "PYTHONDONTWRITEBYTECODE": "1", "CFLAGS": "-O0",
                   "PKG_CONFIG_PATH": str(next(cls.prefix.glob("**/pkgconfig")))}
        run(sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index",
            "--no-deps", "--target", cls.own, cls.copy, env=cls.env)

    @classmethod
    def files(cls):
        return sorted(cls.copy.rglob("*"))

    def python(self, program):
        return run(sys.executable, "-c", program, env=self.env, cwd=self.top).strip()

    def test_finds_the_phantom_of_the_prefix(self):
        self.assertEqual(self.python("import stylet; print(stylet.phantom('liver').info.hash)"),
                         self.python("import stylet; print(stylet.Organ.read("
                                     f"{str(self.prefix)!r} + '/share/stylet/organs/"
                                     "liver-phantom.organ').info.hash)"))

    def test_finds_the_scenes_of_the_prefix(self):
        self.assertEqual(self.python(
            "import stylet; env = stylet.NeedleEnv.of_scene('fig09-force-curve', targets=["
            "stylet.Target('middle', (0, 0, 0), 0.01)]); print(env.organ.info.name)"),
            self.python("import stylet; print(stylet.phantom('liver').info.name)"))

    def test_leaves_nothing_in_the_folder(self):
        self.assertEqual(self.files(), self.before)


if __name__ == "__main__":
    unittest.main()
