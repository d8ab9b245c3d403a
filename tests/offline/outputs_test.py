#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Outputs of stylet-organ never destroy anything: every output against every input under random
names, devices, folders, full disks, failures half-way, permissions, checksums of older files.

usage: outputs_test.py   (STYLET_BIN)
"""
import hashlib
import os
import pathlib
import random
import resource
import stat
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ.get("STYLET_BIN",
                                  pathlib.Path(__file__).parents[2] / "build/release/bin"))
TOOL = BIN / "stylet-organ"
CUBE = ("OFF\n8 12 0\n" + "".join(f"{30 * (i & 1)} {30 * (i >> 1 & 1)} {30 * (i >> 2)}\n"
                                  for i in range(8)) +
        "3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n"
        "3 1 3 7\n3 1 7 5\n")
MAP = (b"NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\n"
       b"space directions: (10,0,0) (0,10,0) (0,0,10)\nspace origin: (0,0,0)\nencoding: raw\n"
       b"%s\n" + 32 * b"\5" + 32 * b"\7")
HEADER = MAP.split(b"%s")[0]


class Case(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.write("cube.off", CUBE.encode())
        self.write("map.nrrd", MAP % b"")
        self.write("map.nhdr", HEADER + b"data file: map.raw\n")
        self.write("map.raw", 32 * b"\5" + 32 * b"\7")
        self.write("r.toml", b"[tissues]\nliver = [5]\n[obstacles]\nrib = [7]\n"
                             b"[targets]\naim = [5]\n")
        self.write("own.toml", b"[liver]\nyoungs_modulus_kpa = 12.5\nsource = \"lab\"\n")
        self.write("box.csv", b"measure,organ,voxels,substeps,passes,median_us,ns\n"
                              b"tick_elastic_added,a,1000,2,0,70,35\n"
                              b"tick_elastic_added,b,20000,2,0,830,20.75\n"
                              b"tick_elastic,b,20000,1,7,850,42.5\n")

    def write(self, name, data):
        (self.folder / name).write_bytes(data)

    def run_tool(self, *arguments, **options):
        return subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, stdin=subprocess.DEVNULL, **options)

    def state(self):
        """Kind, link and bytes of everything in the folder."""
        found = {}
        for path in sorted(self.folder.rglob("*")):
            mode = path.lstat().st_mode
            data = (os.readlink(path) if stat.S_ISLNK(mode) else
                    hashlib.sha256(path.read_bytes()).hexdigest() if stat.S_ISREG(mode) else "")
            found[str(path.relative_to(self.folder))] = (stat.S_IFMT(mode), data)
        return found

    def alias(self, draw, name):
        """Another name of a file."""
        number = f"alias{draw.randrange(10**9)}"
        kind = draw.randrange(6)
        if kind == 0:
            return name
        if kind == 1:
            return str(self.folder / name)
        if kind == 2:
            (self.folder / number).mkdir()
            return f"{number}/../{name}"
        if kind == 3:
            os.link(self.folder / name, self.folder / number)
            return number
        if kind == 4:
            os.symlink(draw.choice([name, self.folder / name]), self.folder / number)
            return number
        os.symlink(".", self.folder / number)
        return f"{number}/{name}"

    def refused(self, before, done, *words):
        self.assertEqual(done.returncode, 1, done)
        lines = [line for line in done.stderr.splitlines() if "warning:" not in line]
        self.assertEqual(len(lines), 1, done.stderr)
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual(self.state(), before)

    # What each command reads, and its arguments, in which one output takes the place of "OUT".
    COMMANDS = [
        (["cube.off"], ["build", "cube.off", "-o", "OUT"]),
        (["cube.off", "own.toml"], ["build", "cube.off", "--materials", "own.toml", "-o", "OUT"]),
        (["cube.off", "box.csv"], ["build", "cube.off", "--fit", "1kHz", "--machine", "box.csv",
                                   "-o", "OUT"]),
        (["cube.off"], ["build", "cube.off", "--fix", "touching:cube.off", "-o", "OUT"]),
        (["map.nrrd", "r.toml"], ["build", "map.nrrd", "--recipe", "r.toml", "-o", "OUT"]),
        (["map.nhdr", "map.raw", "r.toml"], ["build", "map.nhdr", "--recipe", "r.toml", "-o",
                                             "OUT"]),
        (["cube.off"], ["hull", "cube.off", "-o", "OUT"]),
        (["own.toml"], ["phantom", "block", "--materials", "own.toml", "-o", "OUT"]),
        (["own.toml"], ["phantom", "block", "--materials", "own.toml", "-o", "a.organ",
                        "--mesh-out", "OUT"]),
    ]

    def test_no_input_under_any_name_is_written(self):
        for seed in range(60):
            draw = random.Random(seed)
            reads, command = draw.choice(self.COMMANDS)
            output = self.alias(draw, draw.choice(reads))
            before = self.state()
            done = self.run_tool(*[output if word == "OUT" else word for word in command])
            self.refused(before, done, "this command reads this file")

    def test_outputs_beside_the_organ_are_no_inputs_either(self):
        """Hulls and the scene get their names from the organ's."""
        for name in ("a.rib.toml", "a.scene.toml", "a.organ.sha256"):
            os.rename(self.folder / "r.toml", self.folder / name)
            before = self.state()
            done = self.run_tool("build", "map.nrrd", "--recipe", name, "--sum", "-o", "a.organ")
            self.refused(before, done, "this command reads this file")
            os.rename(self.folder / name, self.folder / "r.toml")

    def test_two_outputs_may_not_be_one_file(self):
        before = self.state()
        for seed in range(6):
            draw = random.Random(seed)
            other = draw.choice(["a.organ", "./a.organ", str(self.folder / "a.organ")])
            self.refused(before, self.run_tool("phantom", "block", "-o", "a.organ", "--mesh-out",
                                               other), "written twice")

    def test_devices_and_folders_stay(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "folder").mkdir()
        os.symlink("/dev/full", self.folder / "link")
        before = self.state()
        for output in ("/dev/full", "/dev/null", "link", "pipe", "folder", "folder/"):
            for command in (["build", "cube.off", "-o"], ["hull", "cube.off", "-o"],
                            ["phantom", "block", "-o", "a.organ", "--mesh-out"]):
                self.refused(before, self.run_tool(*command, output), "expected")
        for device in ("/dev/full", "/dev/null"):
            self.assertTrue(stat.S_ISCHR(os.stat(device).st_mode))

    def test_as_many_targets_as_a_scene_takes(self):
        """e2e/cli_test.py runs a scene with as many."""
        def built(targets):
            self.write("t.toml", ("[tissues]\nliver = [5]\n[targets]\n" + targets).encode())
            return self.run_tool("build", "map.nrrd", "--recipe", "t.toml", "--voxel-mm", "5",
                                 "-o", "t.organ")

        def names(count, size):
            return "".join(f"{i:0{size}} = [{5 if i else 7}]\n" for i in range(count))
        done = built(names(32, 40))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("target " + 40 * "0" + ": its labels are in none of the tissues", done.stderr)
        for targets, said in ((names(33, 40), "33 targets: expected at most 32"),
                              (names(1, 41), "expected a name of at most 40 bytes")):
            done = built(targets)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"t\.toml:[34]: .*" + said)

    def test_an_unknown_tissue_is_named_with_its_recipe(self):
        self.write("w.toml", b"[tissues]\nlover = [5]\n")
        before = self.state()
        done = self.run_tool("build", "map.nrrd", "--recipe", "w.toml", "-o", "w.organ")
        self.refused(before, done, "w.toml: tissue 'lover': expected one of")

    def test_links_to_open_files_stay(self):
        """These are links of the system, also if standard output is a file."""
        names = ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")
        before = [os.readlink(name) for name in names[:1]]
        with open(self.folder / "out.txt", "w", encoding="utf-8") as out:
            for name in names:
                done = subprocess.run([TOOL, "hull", "cube.off", "-o", name], cwd=self.folder,
                                      stdout=out, stderr=subprocess.PIPE, text=True, timeout=120)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"{name}: is a device", done.stderr)
        self.assertEqual([os.readlink(name) for name in names[:1]], before)
        self.assertEqual((self.folder / "out.txt").read_bytes(), b"")

    def test_links_are_followed(self):
        (self.folder / "far").mkdir()
        for link, target in (("hull", "far/hull.toml"), ("organ", "far/a.organ")):
            os.symlink(target, self.folder / link)
            for _ in range(2):  # a link to nothing yet, and then to a file
                command = ["hull", "cube.off"] if link == "hull" else ["phantom", "block"]
                self.assertEqual(self.run_tool(*command, "-o", link).returncode, 0)
                self.assertEqual(os.readlink(self.folder / link), target)
                self.assertTrue((self.folder / target).is_file())
        self.assertEqual({path.name for path in (self.folder / "far").iterdir()},
                         {"hull.toml", "a.organ"})

    def test_links_without_end_are_refused(self):
        os.symlink("loop", self.folder / "loop")
        before = self.state()
        for output, said in (("loop", "loop: leads from link to link without end"),
                             ("loop/hull.toml", "cannot be written: Too many levels")):
            self.refused(before, self.run_tool("hull", "cube.off", "-o", output), said)

    def test_a_full_disk_leaves_what_was_there(self):
        counted_nowhere = {**os.environ, "LLVM_PROFILE_FILE": os.devnull}  # set by coverage.sh
        def no_room(most):
            return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        for older in (False, True):
            if older:
                done = self.run_tool("build", "cube.off", "--voxel-mm", "6", "--sum", "--report",
                                     "report", "-o", "a.organ")
                self.assertEqual(done.returncode, 0, done.stderr)
            before = self.state()
            for most in (0, 100, 1500, 5000):
                done = self.run_tool("build", "cube.off", "--sum", "--report", "report", "-o",
                                     "a.organ", preexec_fn=no_room(most), env=counted_nowhere)
                self.refused(before, done, "cannot be written")

    def test_a_later_output_that_fails_leaves_none(self):
        self.write("file", b"")
        before = self.state()
        self.refused(before, self.run_tool("build", "cube.off", "--report", "file", "-o",
                                           "a.organ"), "expected the name of a folder")
        self.refused(before, self.run_tool("build", "cube.off", "--report", "file/report", "-o",
                                           "a.organ"))
        (self.folder / "a.rib.toml").mkdir()
        before = self.state()
        self.refused(before, self.run_tool("build", "map.nrrd", "--recipe", "r.toml", "--report",
                                           "new/report", "-o", "a.organ"), "is a directory")

    def test_permissions_follow_the_umask(self):
        for mask in (0o077, 0o022, 0o027, 0o002):
            done = self.run_tool("build", "map.nrrd", "--recipe", "r.toml", "--sum", "--report",
                                 f"report{mask}", "-o", f"a{mask}.organ", umask=mask)
            self.assertEqual(done.returncode, 0, done.stderr)
            made = [f"a{mask}.organ", f"a{mask}.organ.sha256", f"a{mask}.scene.toml",
                    f"a{mask}.rib.toml", f"report{mask}/report.html", f"report{mask}/report.json"]
            for name in made:
                mode = stat.S_IMODE((self.folder / name).stat().st_mode)
                self.assertEqual(mode, 0o666 & ~mask, name)

    def test_no_checksum_of_an_older_file_stays(self):
        self.assertEqual(self.run_tool("phantom", "block", "--sum", "-o", "a.organ").returncode, 0)
        before = self.state()
        self.refused(before, self.run_tool("build", "nothing.off", "-o", "a.organ"), "no such file")
        self.assertEqual(self.run_tool("phantom", "ball", "-o", "a.organ").returncode, 0)
        self.assertFalse((self.folder / "a.organ.sha256").exists())
        self.assertEqual(self.run_tool("check", "a.organ").returncode, 0)

    def test_a_file_that_is_no_checksum_of_it_stays(self):
        digits = hashlib.sha256(b"other").hexdigest()
        for text in ("important", "", f"{digits}  b.organ\n", f"{digits}  a.organ\nand more\n",
                     f"{digits[:-1]}g  a.organ\n"):
            (self.folder / "a.organ.sha256").write_text(text)
            self.assertEqual(self.run_tool("phantom", "ball", "-o", "a.organ").returncode, 0)
            self.assertEqual((self.folder / "a.organ.sha256").read_text(), text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
