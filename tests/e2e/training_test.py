#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a trainer and a laboratory use: scores, OpenIGTLink, recordings in Python and Octave.

usage: training_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import json
import os
import re
import shutil
import socket
import struct
import subprocess
import sys
import threading
import unittest
import urllib.request

import h5py
import numpy as np

from cli_test import BIN, SOURCE, Folder, call

SCENE = """
[[targets]]
name = "seed"
at_mm = [{seed}, 1, 0]
radius_mm = 1.5
[[targets]]
name = "far side"
at_mm = [70, 0, 0]
radius_mm = 10
forbidden = true
[needle]
length_mm = 150
[[hand.waypoint]]
travel_mm = 40
speed_mm_s = {speed}
hold_s = 0.5
[[hand.waypoint]]
travel_mm = -5
speed_mm_s = 100
"""


class Attempts(Folder):
    """An organ of two layers, and an attempt at it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.organ = cls.top / "layers.organ"
        call("stylet-organ", "phantom", "layered", "--size-mm", "60,40,40", "--voxel-mm", "5",
             "--fix", "x>90%", "--layer", "skin:5", "--layer", "fat:55", "-o", cls.organ)
        cls.report = cls.attempt("one", seed=40, speed=40)

    @classmethod
    def attempt(cls, name, **values):
        scene = cls.top / f"{name}.toml"
        scene.write_text(SCENE.format(**values))
        done = call("stylet", "run", scene, "--organ", cls.organ, "--fast", "--json",
                    "--record", cls.top / f"{name}.h5", "--flight", cls.top / "fault.h5")
        return json.loads(done.stdout)


class Score(Attempts):
    def by_hand(self):
        with h5py.File(self.top / "one.h5") as file:
            tip = file["output/tip_m"][:].astype(float)
            force = file["output/force_n"][:].astype(float)
            deep = file["output/depth_m"][:] > 0
        return tip, force, deep

    def test_run_reports_it_and_it_agrees_with_the_recording(self):
        score = self.report["score"]
        tip, force, deep = self.by_hand()
        size = np.linalg.norm(force, axis=1)
        way = np.linalg.norm(np.diff(tip, axis=0), axis=1).sum()
        self.assertAlmostEqual(score["duration_s"], 1e-3 * len(tip), places=9)
        self.assertAlmostEqual(score["peak_force_n"], size.max(), places=5)
        self.assertAlmostEqual(score["mean_force_n"], size[deep].mean(), places=5)
        self.assertAlmostEqual(score["path_m"], way, delta=4e-4)  # a turn and the recoil
        self.assertEqual(score["withdrawals"], 1)
        self.assertEqual(score["faults"], 0)
        self.assertEqual([each["layer"] for each in score["punctures"]], ["skin"])
        seed, far = score["targets"]
        nearest = np.linalg.norm(tip - [0.040, 0.001, 0], axis=1).min()
        self.assertAlmostEqual(seed["closest_m"], nearest, places=5)
        self.assertTrue(seed["reached"])
        self.assertEqual((far["name"], far["forbidden"], far["reached"]), ("far side", True, False))

    def test_command_says_the_same_and_compares(self):
        self.attempt("two", seed=45, speed=20)
        one, two = self.top / "one.h5", self.top / "two.h5"
        listed = json.loads(call("stylet", "score", one, two, "--json").stdout)
        self.assertEqual(listed[0]["score"], self.report["score"])
        self.assertFalse(listed[1]["score"]["targets"][0]["reached"])
        table = call("stylet", "score", one, two).stdout
        self.assertRegex(table, r"score +one\.h5 +two\.h5\n")
        self.assertRegex(table, r"target seed +\d\.\d mm reached +\d\.\d mm missed\n")
        self.assertRegex(table, r"keep out of far side +\d+\.\d mm clear +\d+\.\d mm clear\n")
        self.assertRegex(table, r"  1 +skin \d\.\d\d N +skin \d\.\d\d N\n")

    def test_targets_of_another_scene_and_an_organ_that_is_gone(self):
        other = self.top / "other.toml"
        other.write_text(SCENE.format(seed=10, speed=1))
        moved = self.top / "elsewhere"
        moved.mkdir()
        shutil.copy(self.top / "one.h5", moved / "one.h5")
        with h5py.File(moved / "one.h5", "r+") as file:
            del file["organ_file"]
            file["organ_file"] = np.bytes_("/nowhere/gone.organ")
        done = call("stylet", "score", moved / "one.h5", "--scene", other)
        self.assertRegex(done.stdout, r"target seed +1\.0 mm reached")
        self.assertIn("layer 0", done.stdout)
        self.assertRegex(done.stderr, r"^stylet: note: layers have numbers instead of names: .*\n$")

    def test_refusals_are_one_line(self):
        done = call("stylet", "score", self.top / "none.h5", expect=1)
        self.assertRegex(done.stderr, r"^stylet: .*none\.h5: .*\n$")
        (self.top / "bad.toml").write_text("[[targets]]\nname = \"a\"\n")
        done = call("stylet", "run", self.top / "bad.toml", expect=1)
        self.assertRegex(done.stderr, r"bad\.toml:1: targets\.at_mm: missing: .*\n$")


class Igtl(Attempts):
    """A client written from the description of the protocol, without the library."""

    def receive(self, client, size):
        data = b""
        while len(data) < size:
            part = client.recv(size - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def message(self, client):
        head = self.receive(client, 58)
        version, kind, name, _, size, _ = struct.unpack(">H12s20sQQQ", head)
        self.assertEqual(version, 1)
        return kind.rstrip(b"\0").decode(), name.rstrip(b"\0").decode(), self.receive(client, size)

    def test_run_is_followed_live(self):
        scene = self.top / "slow.toml"
        scene.write_text(SCENE.format(seed=40, speed=10))
        run = subprocess.Popen(
            [BIN / "stylet", "run", scene, "--organ", self.organ, "--igtl=0", "--allow-non-rt",
             "--duration-s", "5.5", "--flight", self.top / "live.h5"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        line = run.stderr.readline()
        found = re.search(r"OpenIGTLink at 127\.0\.0\.1:(\d+)", line)
        if "built without" in line:
            self.skipTest("libopenigtlink-dev is missing")
        self.assertTrue(found, line)
        # Its later output must not make it wait for this test.
        drain = threading.Thread(target=run.communicate, daemon=True)
        drain.start()
        tips, kinds = [], set()
        with socket.create_connection(("127.0.0.1", int(found[1])), timeout=20) as client:
            try:
                while True:
                    kind, name, body = self.message(client)
                    kinds.add((kind, name))
                    if (kind, name) == ("TRANSFORM", "StyletTip"):
                        tips.append(struct.unpack(">12f", body)[9:])
            except (EOFError, ConnectionResetError):
                pass
        drain.join(30)
        self.assertEqual(kinds, {("TRANSFORM", "StyletBase"), ("TRANSFORM", "StyletTip"),
                                 ("POSITION", "StyletTip"), ("SENSOR", "StyletForce"),
                                 ("STRING", "StyletState"), ("STATUS", "Stylet"),
                                 ("POINT", "StyletTargets")})
        tips = np.array(tips)
        self.assertGreater(len(tips), 5)  # of a hundred; a busy machine sends fewer
        # In along the world's +x, which is to the left in RAS: -x, mm.
        self.assertLess(tips[:, 0].min(), -30)
        self.assertGreater(tips[:, 0].max(), -20)
        self.assertLess(np.abs(tips[:, 1:]).max(), 1)

    def test_wrong_addresses_are_one_line(self):
        done = call("stylet", "run", self.top / "one.toml", "--igtl-listen", "0.0.0.0",
                    expect=2)
        self.assertIn("--igtl", done.stdout + done.stderr)
        done = call("stylet", "run", self.top / "one.toml", "--organ", self.organ, "--fast",
                    "--igtl=0", "--igtl-listen", "192.0.2.1", expect=1)
        self.assertRegex(done.stderr, r"^stylet: OpenIGTLink: .*\n$")


class Metrics(Attempts):
    def test_console_serves_them_and_takes_a_pointer(self):
        run = subprocess.Popen(
            [BIN / "stylet", "run", self.top / "one.toml", "--organ", self.organ, "--console=0",
             "--device", "pointer:", "--allow-non-rt"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.terminate)
        found = re.search(r"console at (http://[\w.:]+)", run.stdout.readline())
        self.assertTrue(found)
        with urllib.request.urlopen(f"{found[1]}/metrics", timeout=20) as answer:
            self.assertIn("version=0.0.4", answer.headers["Content-Type"])
            text = answer.read().decode()
        self.assertIn('stylet_info{version="', text)
        self.assertRegex(text, r"\nstylet_running 0\n")
        self.assertRegex(text, r"\nstylet_console_connections [1-9]\n")


class Examples(Attempts):
    SCRIPT = SOURCE / "offline/analysis/recording.py"
    ROW = re.compile(r"^(free|contact|inserted|retracting) +([\d.]+) +([\d.]+) +([\d.-]+) ", re.M)

    def python(self, *arguments, expect=0):
        env = dict(os.environ, MPLBACKEND="Agg", MPLCONFIGDIR=str(self.top))
        done = subprocess.run([sys.executable, self.SCRIPT, *map(str, arguments)], env=env,
                              capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def setUp(self):
        have = subprocess.run([sys.executable, "-c", "import matplotlib"], capture_output=True,
                              check=False)
        if have.returncode != 0:
            self.skipTest("python3-matplotlib is missing")

    def test_python_prints_phases_and_draws(self):
        picture = self.top / "curves.png"
        printed = self.python(self.top / "one.h5", "-o", picture).stdout
        rows = self.ROW.findall(printed)
        self.assertEqual([row[0] for row in rows][:3], ["free", "contact", "inserted"])
        with h5py.File(self.top / "one.h5") as file:
            deepest = 1e3 * float(file["output/depth_m"][:].max())
            ticks = len(file["output/tick"])
        self.assertAlmostEqual(max(float(row[3]) for row in rows), deepest, places=2)
        self.assertAlmostEqual(float(rows[-1][2]), 1e-3 * ticks, places=3)
        self.assertIn("puncture", printed)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_python_refuses_in_one_line(self):
        one = self.top / "one.h5"
        for arguments in ([self.organ], [self.top / "gone.h5"], [one, "--needle", 7]):
            done = self.python(*arguments, expect=1)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    @unittest.skipUnless(shutil.which("octave-cli"), "octave is missing")
    def test_octave_gives_the_same_numbers(self):
        text = (f"c = recording('{self.top}/one.h5', ''); "
                "printf('%.6f\\n', max(c.force_n), sum(c.causes_n.friction));")
        lines = subprocess.run(["octave-cli", "--no-gui", "--path", self.SCRIPT.parent, "--eval",
                                text], capture_output=True, text=True, timeout=300,
                               check=False).stdout
        numbers = [float(each) for each in lines.splitlines()[-2:]]
        with h5py.File(self.top / "one.h5") as file:
            force = -file["output/force_n"][:, 0].astype(float)
            friction = -file["output/friction_n"][:, 0].astype(float)
        self.assertAlmostEqual(numbers[0], force.max(), places=4)
        self.assertAlmostEqual(numbers[1], friction.sum(), delta=1e-3 * abs(friction.sum()))
        printed = self.python(self.top / "one.h5", "-o", self.top / "c.svg").stdout
        self.assertEqual(self.ROW.findall(lines), self.ROW.findall(printed))


if __name__ == "__main__":
    unittest.main()
