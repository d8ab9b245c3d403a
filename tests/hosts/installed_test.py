#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The installed program: all files that it reads are there; its scenes run by name from any folder;
their organs are made on first use, except for the phantom, which is installed.

usage: installed_test.py    with STYLET_BUILD and STYLET_SOURCE in the environment
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
SEED = SOURCE / "tests/fuzz/seeds/organ/two-materials.organ"
SCENES = sorted(path.stem for path in (SOURCE / "hal/scenes").glob("*.toml")
                if "# organ: stylet-organ " in path.read_text())
RUN = ("run", "fig03-puncture", "--fast", "--duration-s", "0.05", "--json")
# Replaces stylet-organ in tests that are not about organs: notes its arguments and writes a small
# organ.
STAND_IN = """#!/bin/sh
echo "making an organ"
echo "$@" >> "$STAND_IN_CALLS"
for last; do :; done
cp "$STAND_IN_ORGAN" "$last"
"""


def install(prefix, *components):
    for component in components:
        subprocess.run(["cmake", "--install", BUILD, "--component", component, "--prefix", prefix],
                       check=True, capture_output=True)


def anchors(page):
    """The names that a forge (as GitHub) gives to a page's headings."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.S | re.M)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ +(.+)$", text, re.M)}


def dead_links(top):
    """Links of the pages in a folder that lead to nothing in it."""
    for page in sorted(top.rglob("*.md")):
        for number, line in enumerate(page.read_text().splitlines(), 1):
            for link in re.findall(r"\]\((?!\w+:)([^)\s]+)\)", line):
                name, _, anchor = link.partition("#")
                there = (page.parent / name).resolve() if name else page
                if (not there.exists() or top not in there.parents or
                        anchor and anchor not in anchors(there)):
                    yield f"{page.relative_to(top)}:{number}: {link}"


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = pathlib.Path(folder.name) / "a prefix"
        install(cls.prefix, "program", "doc")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = pathlib.Path(folder.name)
        self.tools = self.home / "tools"
        self.tools.mkdir()
        self.env = {"HOME": str(self.home), "PATH": f"{self.tools}:/usr/bin:/bin",
                    "STAND_IN_CALLS": str(self.home / "calls"), "STAND_IN_ORGAN": str(SEED)}

    def stand_in(self):
        (self.tools / "stylet-organ").write_text(STAND_IN)
        (self.tools / "stylet-organ").chmod(0o755)

    def call(self, *words, expect=0, **env):
        done = subprocess.run([self.prefix / "bin/stylet", *words], cwd=self.home, text=True,
                              capture_output=True, env={**self.env, **env})
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def organs(self, top=".cache"):
        return sorted((self.home / top / "stylet/organs").glob("*"))

    def test_has_all_that_it_reads(self):
        share = self.prefix / "share"
        for place in ("stylet/hal/palette.csv", "stylet/hal/device/example_client.py",
                      "stylet/LICENSE", "stylet/README.md", "stylet/hal/hosts/c/README.md",
                      "stylet/hal/hosts/c/examples/insert.c", "man/man1/stylet.1",
                      "stylet/toolchain/debian_source.sh", "stylet/toolchain/common.sh",
                      "bash-completion/completions/stylet", "zsh/site-functions/_stylet",
                      "fish/vendor_completions.d/stylet.fish",
                      *(f"stylet/hal/scenes/{name}.toml" for name in SCENES)):
            self.assertTrue((share / place).is_file(), place)
        rules = self.prefix / "lib/udev/rules.d/70-stylet-haptic.rules"
        made = subprocess.run([BUILD / "bin/stylet_driver_texts", "udev"], capture_output=True,
                              text=True).stdout if (
                                  BUILD / "bin/stylet_driver_texts").exists() else None
        self.assertEqual(made or rules.read_text(), rules.read_text())

    def test_lists_scenes(self):
        lines = self.call("scenes").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], SCENES)
        for line in lines:
            self.assertRegex(line, r"^[a-z0-9-]+ {2,}[A-Z].*[.:]$")
            self.assertNotIn("stylet-organ", line)

    def test_makes_an_organ_on_first_use(self):
        self.stand_in()
        done = self.call(*RUN)
        json.loads(done.stdout)  # without the output of the organ's maker
        self.assertIn("making an organ", done.stderr)
        organ, = self.organs()
        self.assertRegex(organ.name, r"^fig03-puncture-[0-9a-f]{16}\.organ$")
        self.assertNotIn("making", self.call(*RUN).stderr)
        self.assertEqual(len((self.home / "calls").read_text().splitlines()), 1)
        self.assertEqual(self.call("run", self.prefix / "share/stylet/hal/scenes/"
                                   "fig03-puncture.toml", *RUN[2:]).returncode, 0)

    def test_has_the_liver_phantom(self):
        """Its scenes run without the program that makes organs, with the bits of a phantom that is
        made now."""
        if not (BUILD / "bin/stylet-organ").exists():
            self.skipTest("stylet-organ was not built, which makes it")
        organ = self.home / "liver.organ"
        subprocess.run([BUILD / "bin/stylet-organ", "phantom", "liver", "--voxel-mm", "5", "-o",
                        organ], check=True, capture_output=True)
        for scene in ("fig07-liver-flexible", "fig08-liver-rigid", "fig09-force-curve"):
            run = ("run", scene, *RUN[2:])
            ready, made = (json.loads(self.call(*run, *words).stdout)
                           for words in ((), ("--organ", organ)))
            self.assertEqual(ready["state_hash"], made["state_hash"], scene)
        self.assertEqual(self.organs(), [])

    def test_keeps_organs_in_the_folder_it_is_given(self):
        self.stand_in()
        self.call(*RUN, XDG_CACHE_HOME=str(self.home / "caches"))
        self.assertEqual((len(self.organs("caches")), self.organs()), (1, []))
        self.call(*RUN, XDG_CACHE_HOME="relative")  # which has to be ignored
        self.assertEqual(len(self.organs()), 1)
        del self.env["HOME"]
        self.assertIn("XDG_CACHE_HOME", self.call(*RUN, expect=1).stderr)

    def test_an_organ_of_another_command_is_another(self):
        self.stand_in()
        self.call(*RUN)
        scene = self.prefix / "share/stylet/hal/scenes/fig03-puncture.toml"
        text = scene.read_text()
        self.addCleanup(scene.write_text, text)
        scene.write_text(text.replace("--voxel-mm 5", "--voxel-mm 6"))
        self.call(*RUN)
        self.assertEqual(len(self.organs()), 2)

    def test_says_what_is_missing(self):
        said = self.call(*RUN, expect=1).stderr
        self.assertIn("Debian: package stylet-organ", said)
        self.assertRegex(said, r"is made by: stylet-organ phantom block .* -o \S+\.organ\n$")
        (self.tools / "stylet-organ").write_text("#!/bin/sh\nexit 7\n")
        (self.tools / "stylet-organ").chmod(0o755)
        self.assertIn("exit code 7", self.call(*RUN, expect=1).stderr)

    def test_says_whose_meshes_are_missing(self):
        self.stand_in()
        run = ("run", "liver-biopsy", *RUN[2:])
        self.assertRegex(self.call(*run, expect=1).stderr,
                         r"expected STYLET_DATA to name their folder; there is no folder .+\n$")
        self.assertFalse((self.home / "calls").exists())
        self.call(*run, expect=1, STYLET_DATA=str(self.home))  # the small organ is elsewhere
        self.assertIn(f" {self.home}/organs/", (self.home / "calls").read_text())

    def test_a_changed_scene_runs_no_command(self):
        self.stand_in()
        own = self.home / "fig09-force-curve.toml"  # not even with the phantom of the original
        shutil.copy(self.prefix / "share/stylet/hal/scenes/fig09-force-curve.toml", own)
        self.assertIn("is made by: ", self.call("run", own, *RUN[2:], expect=1).stderr)
        self.assertFalse((self.home / "calls").exists())

    def test_an_unknown_name_is_told_with_the_known(self):
        said = self.call("run", "lumbar", expect=1).stderr
        self.assertIn("lumbar: no such file, and no scene of this name", said)
        self.assertIn("lumbar-puncture", said)

    def test_finds_its_benchmarks(self):
        if not (BUILD / "bin/stylet-bench").exists():
            self.skipTest("stylet-bench was not built")
        self.assertIn("benchmark", self.call("bench", "--help").stdout)

    def test_makes_real_organs(self):
        if not (BUILD / "bin/stylet-organ").exists():
            self.skipTest("stylet-organ was not built")
        install(self.home / "whole", "program", "organ")
        self.prefix = self.home / "whole"
        recipes = self.prefix / "share/stylet/offline/recipes"
        self.assertTrue((recipes / "totalsegmentator.toml").exists())
        report = json.loads(self.call("run", "lumbar-puncture", "--fast", "--duration-s", "0.5",
                                      "--json").stdout)
        self.assertTrue(re.fullmatch(r"[0-9a-f]{16}", report["state_hash"]))


class Pages(unittest.TestCase):
    """All installed files, of every component."""

    def test_link_to_what_is_installed(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix = pathlib.Path(folder).resolve() / "prefix"
            subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], check=True,
                           capture_output=True)
            self.assertEqual(list(dead_links(prefix)), [])
            page = prefix / "share/stylet/README.md"
            links = re.findall(r"\]\((?!\w+:)([^)\s]+\.md)\)", page.read_text())
            self.assertGreater(len(links), 10)
            (page.parent / links[0]).unlink()  # a missing page must be noticed
            self.assertIn(f": {links[0]}", "\n".join(dead_links(prefix)))

    def test_anchors_are_those_of_a_forge(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder).resolve() / "page.md"
            page.write_text("# Build it: by `make`!\n```\n# none\n```\n[a](#build-it-by-make)\n"
                            "[b](#none) [c](page.md#build-it-by-make) [d](https://a.b/c#d)\n"
                            "[e](../outside) [f](other.md)\n")
            self.assertEqual(list(dead_links(page.parent)), [
                "page.md:6: #none", "page.md:7: ../outside", "page.md:7: other.md"])


if __name__ == "__main__":
    unittest.main()
