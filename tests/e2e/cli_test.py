#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""From mesh to force curve through the two programs, as a user runs them.

usage: cli_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import contextlib
import fcntl
import importlib.util
import json
import os
import pathlib
import random
import re
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest

import h5py
import numpy as np

import force_curve

BIN = pathlib.Path(os.environ["STYLET_BIN"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
DATA = pathlib.Path(os.environ.get("STYLET_DATA", SOURCE / "../shared/data"))
SCENE = SOURCE / "hal/scenes/fig09-force-curve.toml"
STAGES = ["approach", "contact", "puncture", "insertion", "hold", "retraction", "exit"]


def call(program, *arguments, expect=0, env=None):
    command = [str(part) for part in (BIN / program, *arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, env=env)
    if (done.returncode == 0) != (expect == 0):
        raise AssertionError(f"{' '.join(command)}: exit code {done.returncode}\n"
                             f"{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return done


def wait_until(holds, most_s=20):
    deadline = time.monotonic() + most_s
    while not holds():
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {most_s} s")
        time.sleep(0.01)


class Folder(unittest.TestCase):
    """A folder of its own, and what the programs make in it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)

    @classmethod
    def make_phantom(cls):
        organ = cls.top / "phantom.organ"
        maker = os.environ.get("STYLET_ORGAN", "stylet-organ")  # of another build
        call(maker, "phantom", "liver", "--voxel-mm", "5", "-o", organ)
        return organ

    @classmethod
    def make_openhelp(cls):
        mesh = DATA / "organs/openhelp_Liver.stl"
        if not mesh.exists():
            raise unittest.SkipTest(f"{mesh} is not there; set STYLET_DATA")
        organ = cls.top / "liver.organ"
        call("stylet-organ", "build", mesh, "--units", "mm", "--voxel-mm", "5", "-o", organ)
        return organ

    @classmethod
    def run_fast(cls, organ, recording, mode="physical"):
        """The one object that `run --json` leaves on standard output."""
        done = call("stylet", "run", SCENE, "--organ", organ, "--mode", mode, "--fast", "--json",
                    "--record", recording)
        return json.loads(done.stdout)


def friction_of(organ):
    """The friction that the material inside has in the file, N/m at 10 mm/s."""
    materials = json.loads(call("stylet-organ", "info", organ, "--json").stdout)["materials"]
    inside = [m for m in materials if "capsule" not in m["name"]]
    if len(inside) != 1:
        raise AssertionError(f"expected one material beside the capsule, found {materials}")
    return (1e3 * inside[0]["coulomb_friction_n_per_mm"] +
            inside[0]["viscous_friction_n_s_per_m2"] * 0.01)


class Insertion(Folder):
    """Fig. 9 of the paper, in both modes."""

    def check(self, organ, mode):
        recording = self.top / f"{mode}.h5"
        report = self.run_fast(organ, recording, mode)
        for key in ("phases", "events", "timing", "memory", "counters", "state_hash",
                    "organ_hash"):
            self.assertIn(key, report)
        names = [row["name"] for row in report["phases"]]
        # On its way out the tip may brush the surface once more.
        self.assertEqual(names[:len(STAGES)], STAGES, report["phases"])
        self.assertLessEqual(set(names[len(STAGES):]), {"contact", "exit"}, report["phases"])
        for earlier, later in zip(report["phases"], report["phases"][1:]):
            self.assertEqual(earlier["end_tick"], later["start_tick"])
        memory = report["memory"]
        for block in ("model", "state", "scratch"):
            self.assertGreater(memory[block]["used_bytes"], 0)
            self.assertEqual(memory[block]["predicted_bytes"], memory[block]["used_bytes"])
        with h5py.File(recording) as file:
            curve = force_curve.read_curve(file)
            self.assertFalse(np.asarray(file["guard/fault"]).any(), "the guard latched a fault")
        faults = force_curve.check_physical(curve) if mode == "physical" else \
            force_curve.check_paper(curve)
        self.assertFalse(faults, "\n" + "\n".join(faults))
        if mode == "physical":
            friction = friction_of(organ)
            slope, _, _ = force_curve.insertion(curve)
            self.assertAlmostEqual(slope / friction, 1, delta=0.02)
            reported = report["phases"][STAGES.index("insertion")]["slope_n_per_mm"]
            self.assertAlmostEqual(1e3 * reported / friction, 1, delta=0.02)

    def test_phantom_physical(self):
        self.check(self.make_phantom(), "physical")

    def test_phantom_paper(self):
        self.check(self.make_phantom(), "paper")

    def test_openhelp_physical(self):
        self.check(self.make_openhelp(), "physical")

    def test_openhelp_paper(self):
        self.check(self.make_openhelp(), "paper")


class Levels(Folder):
    """What is said of an organ with voxels of several edges."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.organ = cls.top / "fine.organ"
        call("stylet-organ", "phantom", "liver", "--voxel-mm", "12", "--refine", "surface:2", "-o",
             cls.organ)

    def test_edges_and_unit_are_those_of_all_levels(self):
        said = call("stylet", "run", SCENE, "--organ", self.organ, "--fast", "--force",
                    "--duration-s", "0.01").stdout
        self.assertIn("voxels of 12 to 3 mm", said)
        self.assertRegex(said, "the needle's unit is 1.7 voxels long.*a unit of at most 3 mm")
        facts = call("stylet-organ", "info", self.organ).stdout
        self.assertRegex(facts, r"lattice +\d+ voxels of 12 to 3 mm in .* \(stored one level after")

    def test_a_dimple_is_told_in_the_voxels_of_all_levels(self):
        run = ["stylet", "run", SCENE, "--organ", self.organ, "--fast", "--duration-s", "1.6"]
        report = json.loads(call(*run, "--json").stdout)
        contact_mm = max(1e3 * row["travel_m"] for row in report["phases"]
                         if row["name"] == "contact")
        self.assertGreater(contact_mm, 3)
        self.assertAlmostEqual(report["dimple_voxels"], contact_mm / 12, delta=1e-3)
        self.assertAlmostEqual(report["dimple_finest_voxels"], contact_mm / 3, delta=1e-3)
        self.assertIn(f"dimple      as deep as {contact_mm / 3:.1f} of the finest voxels, or "
                      f"{contact_mm / 12:.1f} of the coarsest: ", call(*run).stdout)


class Recording(Folder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.organ = cls.make_phantom()
        cls.recording = cls.top / "run.h5"
        cls.report = cls.run_fast(cls.organ, cls.recording)

    def test_two_runs_have_the_same_bits(self):
        again = self.run_fast(self.organ, self.top / "again.h5")
        self.assertEqual(again["state_hash"], self.report["state_hash"])
        self.assertEqual(again["organ_hash"], self.report["organ_hash"])

    def test_helper_threads_have_the_same_bits(self):
        for threads in (2, 3):
            done = call("stylet", "run", SCENE, "--organ", self.organ, "--fast", "--json",
                        "--threads", threads)
            report = json.loads(done.stdout)
            self.assertEqual(report["state_hash"], self.report["state_hash"])
            self.assertEqual(report["timing"]["threads"], threads)
            self.assertGreater(report["timing"]["helped_parts"], 0)

    def test_replay_has_the_same_bits(self):
        call("stylet", "replay", self.recording)

    def test_recordings_are_kept(self):
        """The same command again keeps what the first recorded; --force goes over it."""
        kept, second = self.top / "kept.h5", self.top / "kept-2.h5"
        kept.write_bytes(b"what cannot be had again")
        words = ["run", SCENE, "--organ", self.organ, "--fast", "--duration-s", "0.2", "--record",
                 kept]
        done = call("stylet", *words, "--json")
        self.assertEqual(json.loads(done.stdout)["recording"], str(second))
        self.assertEqual(done.stderr, f"stylet: {kept} exists and is kept: this recording is "
                                      f"{second} (--force overwrites)\n")
        self.assertEqual(kept.read_bytes(), b"what cannot be had again")
        call("stylet", "replay", second)
        done = call("stylet", *words, "--json", "--force")
        self.assertEqual(json.loads(done.stdout)["recording"], str(kept))
        call("stylet", "replay", kept)
        self.assertEqual(sorted(self.top.glob("kept*")), [second, kept])

    def test_links_are_followed(self):
        target = self.top / "far.h5"
        link = self.top / "link.h5"
        link.symlink_to(target.name)
        for more in ([], ["--force"]):
            call("stylet", "run", SCENE, "--organ", self.organ, "--fast", "--duration-s", "0.1",
                 "--record", link, *more)
            self.assertTrue(link.is_symlink() and target.is_file())
        picture = self.top / "link.svg"
        picture.symlink_to("far.svg")
        call("stylet", "plot", link, "-o", picture)
        self.assertTrue(picture.is_symlink() and (self.top / "far.svg").is_file())
        with open(self.top / "stdout", "w", encoding="utf-8") as out:
            done = subprocess.run(
                [BIN / "stylet", "run", SCENE, "--organ", self.organ, "--fast", "--duration-s",
                 "0.1", "--force", "--record", "/dev/fd/1"],
                stdout=out, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("/dev/fd/1: is a device", done.stderr)

    def test_recordings_of_runs_at_once_are_all_kept(self):
        """So is a file that somebody puts there while a run goes on."""
        wanted = self.top / "busy.h5"
        lengths = [0.6, 0.9, 1.2]
        runs = [subprocess.Popen([BIN / "stylet", "run", SCENE, "--organ", self.organ,
                                  "--allow-non-rt", "--duration-s", str(length), "--json",
                                  "--record", wanted, "--flight", self.top / "late.h5"],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                for length in lengths]
        wait_until(lambda: len(list(self.top.glob("busy.h5.*.tmp"))) == len(runs))
        wanted.write_bytes(b"precious")
        names = set()
        for run in runs:
            out, error = run.communicate(timeout=120)
            self.assertIn(run.returncode, (0, 3), error)  # on a busy machine they are late
            report = json.loads(out)
            name = report["recording"]
            names.add(name)
            self.assertIn(f"{wanted} appeared during the run and is kept: "
                          f"this recording is {name}\n",
                          error)
            with h5py.File(name) as file:
                self.assertEqual(len(file["output/tick"]), report["timing"]["ticks"])
        self.assertEqual(names, {str(self.top / f"busy-{i}.h5") for i in (2, 3, 4)})
        self.assertEqual(wanted.read_bytes(), b"precious")
        self.assertEqual(len(list(self.top.glob("busy*"))), 4)

    def test_full_disk_leaves_no_picture(self):
        """Under a limit on file sizes gnuplot draws half of the picture and reports no error;
        /dev/full is always full."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        for name in ("full.svg", "full.png"):
            done = subprocess.run([BIN / "stylet", "plot", self.recording, "-o", self.top / name],
                                  preexec_fn=limit, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, "^stylet: gnuplot: its picture is incomplete")
            self.assertEqual(list(self.top.glob("full*")), [])
        for program, *words in (["stylet", "score", self.recording],
                                ["stylet-organ", "info", self.organ]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([BIN / program, *words], stdout=full, text=True,
                                      stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(done.returncode, 1, program)
            self.assertIn("No space left on device", done.stderr)

    def test_too_little_memory_is_said_in_plain_words(self):
        def within(mebibytes, *words):
            most = mebibytes << 20
            return subprocess.run(
                [BIN / "stylet", *words], capture_output=True, text=True, timeout=60,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
        if within(1024, "--version").returncode != 0:
            self.skipTest("this build reserves more addresses than it may have")
        fewest = next(most for most in range(16, 1024, 2)
                      if within(most, "--version").returncode == 0)
        told, folder = 0, self.top / "little"
        folder.mkdir()
        for words in (["plot", self.recording, "-o", folder / "little.svg"],
                      ["score", self.recording], ["replay", self.recording],
                      ["run", SCENE, "--organ", self.organ, "--fast", "--duration-s", "0.05",
                       "--record", folder / "little.h5", "--force"]):
            done, most = None, fewest - 2
            while (done is None or done.returncode != 0) and most < fewest + 80:
                most += 2
                done = within(most, *words)
                where = (most, words[0], done.stderr)
                # The program ends by itself, without a signal or exception, and does not blame a
                # sound file.
                self.assertIn(done.returncode, (0, 1, 3), where)
                self.assertNotRegex(done.stderr, "bad_alloc|terminate|damaged", where)
                if done.returncode == 1:
                    self.assertIn("stylet: ", done.stderr, where)
                    self.assertEqual([*folder.glob("*.tmp")], [], where)
                for left in folder.glob("*.tmp"):
                    left.unlink()
                told += "stylet: not enough memory: expected a smaller organ" in done.stderr
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(told, 0)

    def test_replay_names_what_differs(self):
        changed = self.top / "changed.h5"
        changed.write_bytes(self.recording.read_bytes())
        with h5py.File(changed, "r+") as file:
            force = file["output/force_n"]
            middle = len(force) // 2
            row = force[middle]
            row[0] += 1
            force[middle] = row
            tick = int(file["output/tick"][middle])
        done = call("stylet", "replay", changed, expect=1)
        self.assertIn("force_n", done.stdout + done.stderr)
        self.assertIn(str(tick), done.stdout + done.stderr)

    def test_plots(self):
        picture = self.top / "force.svg"
        call("stylet", "plot", self.recording, "-o", picture)
        text = picture.read_text()
        self.assertIn("<svg", text[:1000])
        self.assertGreater(len(text), 5000)
        self.assertGreater(text.count("<path"), 5)
        labels = [float(x) for x in re.findall(r"translate\(([0-9.]+),[0-9.]+\) rotate\(-35", text)]
        self.assertEqual(len(labels), len(self.report["phases"]))
        self.assertTrue(np.all(np.diff(labels) > 20), f"names of phases overlap: {labels}")
        picture = self.top / "force.png"
        call("stylet", "plot", self.recording, "-o", picture)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(picture.stat().st_size, 5000)

    def test_plots_are_the_same_for_every_user(self):
        (self.top / ".gnuplot").write_text("set xrange [0:1]\n")
        texts = set()
        for user in ({"HOME": str(self.top), "LC_ALL": "C"}, {"HOME": "/nowhere"}):
            picture = self.top / "user.svg"
            done = call("stylet", "plot", self.recording, "-o", picture,
                        env={"PATH": os.environ["PATH"], **user})
            self.assertEqual(done.stderr, "")
            texts.add(picture.read_text())
        self.assertEqual(len(texts), 1)


class Patient(Folder):
    """From a patient's segmentation to a needle in the liver, from the front."""

    MAP = DATA / "labelmaps/ts_example_seg_fast_force_split.nii.gz"
    # The column of the map that meets liver as the first tissue from the front, and most of it: its
    # voxel 69, 81, 107 is at 29 mm right, 254.3 mm front, 415.3 mm up in the header's frame.
    SCENE = """
[organ]
path = "patient.organ"
[approach]
direction = [0, 1, 0]
point_mm = [-29, -220, 415]
start_mm = 5
[guard]
ramp_ms = 0
[[hand.waypoint]]
travel_mm = 50
speed_mm_s = 25
"""

    def build(self, voxel_mm=5):
        """Materials of the patient's organ."""
        if not self.MAP.exists():
            self.skipTest(f"{self.MAP} is not there; set STYLET_DATA")
        call("stylet-organ", "build", self.MAP, "--recipe",
             SOURCE / "offline/recipes/totalsegmentator.toml", "--fix", "y>80%",
             "--voxel-mm", voxel_mm, "-o", self.top / "patient.organ")
        return [m["name"] for m in json.loads(
            call("stylet-organ", "info", self.top / "patient.organ", "--json").stdout)["materials"]]

    def test_biopsy_scene_runs_in_the_patient(self):
        """The trainer's scene as it is, except for the organ and the way in."""
        names = self.build(voxel_mm=6)
        text = (SOURCE / "hal/scenes/liver-biopsy.toml").read_text()
        for old, new in (('path = "liver-biopsy.organ"', 'path = "patient.organ"'),
                         ("direction = [0.24, -0.34, -0.91]", "direction = [0, 1, 0]"),
                         ("point_mm = [-20, 109, 190]", "point_mm = [-29, -220, 415]")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        scene = self.top / "biopsy.toml"
        scene.write_text(text)
        report = json.loads(call("stylet", "run", scene, "--fast", "--json").stdout)
        self.assertEqual(report["fault"], "none")
        met = [(event["kind"], names[event["layer"]]) for event in report["events"]]
        self.assertEqual(met[:3], [("contact", "liver_capsule"), ("puncture", "liver_capsule"),
                                   ("layer", "liver")])
        kinds = [phase["name"] for phase in report["phases"]]
        self.assertIn("insertion", kinds)
        self.assertIn("retraction", kinds)

    def test_recipe_for_biopsies_makes_a_scene_that_runs(self):
        """The needle goes through the wall; ribs and spine are obstacles."""
        if not self.MAP.exists():
            self.skipTest(f"{self.MAP} is not there; set STYLET_DATA")
        made = json.loads(call(
            "stylet-organ", "build", self.MAP, "--recipe",
            SOURCE / "offline/recipes/totalsegmentator-biopsy.toml", "--fix", "y>80%",
            "--voxel-mm", 7, "-o", self.top / "patient.organ", "--json").stdout)
        bodies = made["scene"]["obstacles"]  # a bent one in several convex pieces
        self.assertEqual(len({body["name"].partition("-")[0] for body in bodies}), 7)
        self.assertLessEqual(len(bodies), 16)
        names = [m["name"] for m in made["organ"]["materials"]]
        report = json.loads(call("stylet", "run", self.top / "patient.scene.toml", "--fast",
                                 "--json").stdout)
        self.assertEqual(report["fault"], "none")
        met = [(event["kind"], names[event["layer"]]) for event in report["events"]]
        self.assertEqual([kind for kind, name in met[:2]], ["contact", "puncture"])
        self.assertLessEqual({"fat", "muscle"}, {name for kind, name in met})

    def test_needle_meets_the_liver_where_the_map_has_it(self):
        names = self.build()
        scene = self.top / "patient.toml"
        scene.write_text(self.SCENE)
        report = json.loads(call("stylet", "run", scene, "--fast", "--json", "--record",
                                 self.top / "patient.h5").stdout)
        self.assertEqual(report["fault"], "none")
        with h5py.File(self.top / "patient.h5") as file:
            entry = file["needles/entry_m"][0]
        # The front face of the voxel, half of its 3 mm nearer, smoothed.
        self.assertLess(abs(entry[1] - (-0.2543 - 0.0015)), 0.003)
        met = [(event["kind"], names[event["layer"]]) for event in report["events"]]
        self.assertEqual(met, [("contact", "liver_capsule"), ("puncture", "liver_capsule"),
                               ("layer", "liver")])
        self.assertAlmostEqual(report["events"][1]["force_n"], 0.7, delta=0.014)
        slope = next(p["slope_n_per_mm"] for p in report["phases"] if p["name"] == "insertion")
        self.assertAlmostEqual(slope, 0.010 + 20 * 0.025 * 1e-3, delta=0.0005)


class Flight(Folder):
    """A device that falls silent: exit code 3, and its last second in a file that can be drawn."""

    SCENE = """
[organ]
path = "block.organ"
[device]
kind = "{device}"
{recording}
[approach]
start_mm = 2
{waypoint}
"""

    def test_a_fault_leaves_its_last_second(self):
        call("stylet-organ", "phantom", "block", "--size-mm", "40,40,40", "--voxel-mm", "10", "-o",
             self.top / "block.organ")
        waypoint = "[[hand.waypoint]]\ntravel_mm = 10\nspeed_mm_s = 10"
        good, silent = self.top / "good.toml", self.top / "silent.toml"
        good.write_text(self.SCENE.format(device="simulated", recording="", waypoint=waypoint))
        silent.write_text(self.SCENE.format(device="replay", recording='recording = "all.h5"',
                                            waypoint=""))
        call("stylet", "run", good, "--fast", "--record", self.top / "all.h5")
        done = call("stylet", "run", silent, "--fast", "--duration-s", "3", "--flight",
                    self.top / "flight.h5", expect=3)
        self.assertEqual(done.returncode, 3)
        self.assertIn(f"device silent of needle 0 in tick 1204: what led to it is in "
                      f"{self.top}/flight-1.h5", done.stderr)
        with h5py.File(self.top / "flight-1.h5") as file:
            ticks, fault = file["output/tick"][:], file["guard/fault"][:]
        self.assertEqual([ticks[0], ticks[-1]], [205, 1304])
        self.assertEqual(int(ticks[np.flatnonzero(fault)[0]]), 1204)
        call("stylet", "plot", self.top / "flight-1.h5", "-o", self.top / "flight.svg")


class Doctor(Folder):
    """On whatever machine this is: every check has a result, and histograms hold every cycle."""

    def test_looks_at_this_machine_and_measures_it(self):
        call("stylet-organ", "phantom", "block", "--size-mm", "40,40,40", "--voxel-mm", "10", "-o",
             self.top / "block.organ")
        scene, recording = self.top / "scene.toml", self.top / "short.h5"
        scene.write_text('[organ]\npath = "block.organ"\n[loop]\nsubsteps = 2\n'
                         "[[hand.waypoint]]\ntravel_mm = 1\nspeed_mm_s = 100\n")
        call("stylet", "run", scene, "--fast", "--record", recording)
        done = subprocess.run([BIN / "stylet", "doctor", "--measure", "1.5", "--replay", recording,
                               "--json"], capture_output=True, text=True, timeout=60)
        report = json.loads(done.stdout)
        verdicts = [finding["verdict"] for finding in report["findings"]]
        self.assertEqual(len(verdicts), 30 + 3 + 5 + 1)
        inertia, = (f for f in report["findings"] if f["name"] == "inertia")
        resonance = re.fullmatch(
            r"first resonance ([\d.]+) Hz instead of the tissue's ([\d.]+) Hz", inertia["value"])
        # Voxels of 10 mm are so large that two substeps need no filter.
        self.assertEqual((resonance[1], inertia["verdict"]), (resonance[2], "ok"))
        expected = 4 if "fail" in verdicts else 3 if report["verdict"] == "degraded" else 0
        self.assertEqual(done.returncode, expected, done.stderr)
        self.assertEqual([m["name"] for m in report["measurements"]], ["quiet", "busy", "loaded"])
        for measured in report["measurements"]:
            self.assertEqual(measured["cycles"], 500)
            for name in {"wake_up", "tick"} & measured.keys():
                counts = measured[name]["counts_from_us"]
                self.assertEqual(sum(count for _, count in counts), 500)
                self.assertLessEqual(measured[name]["p50_us"], measured[name]["max_us"])
        self.assertNotIn("tick", report["measurements"][0])


class Help(unittest.TestCase):
    """A user of the terminal who knows nothing yet finds every command, with an example."""

    COMMANDS = {"stylet": ["run", "replay", "plot", "devices", "station", "doctor", "bench"],
                "stylet-organ": ["build", "phantom", "hull", "labels", "info", "check"]}

    def test_names_every_command_with_an_example(self):
        for program, commands in self.COMMANDS.items():
            text = call(program, "--help").stdout
            for command in commands:
                self.assertRegex(text, rf"\n  {command} ")
            self.assertIn(f"\n  {program} ", text)
            self.assertLessEqual(max(map(len, text.splitlines())), 110)

    def test_needles_are_listed_with_their_materials(self):
        listed = json.loads(call("stylet", "needles", "--json").stdout)
        materials = {each["name"]: each["material"] for each in listed}
        self.assertEqual((materials["22G"], materials["nitinol-0.58"]), ("steel", "nitinol"))
        self.assertRegex(call("stylet", "needles").stdout, r"\nnitinol-0\.58 .*nitinol +4\.17e-04 ")

    def test_an_unknown_command_is_named(self):
        for program, commands in self.COMMANDS.items():
            self.assertIn("frobnicate", call(program, "frobnicate", expect=1).stderr)
            for command in commands:
                self.assertIn(command, call(program, expect=1).stderr)


class Devices(Folder):
    """A device is found, probed, and holds a needle; here it is the example client."""

    CLIENT = SOURCE / "hal/device/example_client.py"

    def client(self, port, seconds):
        client = subprocess.Popen([sys.executable, self.CLIENT, "127.0.0.1", str(port),
                                   str(seconds)], stdout=subprocess.PIPE, text=True)
        self.addCleanup(client.stdout.close)
        self.addCleanup(client.wait)
        self.addCleanup(client.terminate)
        return client

    def free_port(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            return probe.getsockname()[1]

    def test_every_kind_is_listed_with_a_remedy_where_it_is_missing(self):
        kinds = json.loads(call("stylet", "devices", "--json").stdout)
        known = {"hd:", "dhd:", "haply:", "spacemouse:", "pointer:", "udp:7755", "shm:NAME"}
        self.assertLessEqual(known, {kind["uri"] for kind in kinds})
        for kind in kinds:
            self.assertEqual(kind["ready"] is False, bool(kind["remedy"]), kind)

    def test_a_device_in_a_network_is_not_ready_before_anybody_has_looked(self):
        kinds = {kind["uri"]: kind for kind in
                 json.loads(call("stylet", "devices", "--json").stdout)}
        self.assertIsNone(kinds["udp:7755"]["ready"])
        self.assertIsNone(kinds["shm:NAME"]["ready"])
        self.assertRegex(call("stylet", "devices").stdout,
                         r"udp:7755 +unknown +.*: shows itself only when it is opened\n")

    def test_usb_device_without_its_library_is_seen(self):
        usb = self.top / "tree/sys/bus/usb/devices/1-2"
        usb.mkdir(parents=True)
        for name, text in {"idVendor": "1451", "idProduct": "0301", "busnum": "1",
                           "devnum": "7"}.items():
            (usb / name).write_text(text + "\n")
        env = dict(os.environ, STYLET_LIBDHD="/nowhere/libdhd.so")
        listed = call("stylet", "devices", "--root", self.top / "tree", "--json", env=env).stdout
        dhd, = (each for each in json.loads(listed) if each["uri"] == "dhd:")
        self.assertFalse(dhd["ready"])
        self.assertIn("USB 1-2, but dhd: /nowhere/libdhd.so", dhd["seen"])

    def test_probe_writes_what_it_saw(self):
        port, record = self.free_port(), self.top / "probe.json"
        self.client(port, 20)
        done = subprocess.run([BIN / "stylet", "devices", "probe", f"udp:{port}", "--seconds", "2",
                               "-o", record], capture_output=True, text=True, timeout=60)
        self.assertIn(done.returncode, (0, 3), done.stderr)  # 3: this machine was late
        seen = json.loads(record.read_text())
        self.assertGreater(seen["samples_per_s"], 300)
        self.assertLess(seen["low_mm"][2], -5)
        self.assertEqual(seen["low_mm"][0], 0)
        self.assertIsNone(seen["serial_number"])
        self.assertTrue(seen["sends_times"])
        self.assertNotIn("sends no sample times", done.stdout)

    def test_client_pushes_the_needle_and_feels_it(self):
        organ = self.make_phantom()
        for _ in range(5):  # a busy machine may make the client late: then the guard ends the force
            port = self.free_port()
            client = self.client(port, 5)
            done = subprocess.run(
                [BIN / "stylet", "run", SCENE, "--organ", organ, "--device", f"udp:{port}",
                 "--allow-non-rt", "--duration-s", "3", "--flight", self.top / "flight.h5",
                 "--json"], capture_output=True, text=True, timeout=120)
            said = client.communicate()[0]
            felt = [float(word) for word in re.findall(r"([+-][0-9.]+) N on", said)]
            self.assertIn(done.returncode, (0, 3), done.stderr)
            if max(felt) > 0.05:
                return
            if done.returncode == 0:
                self.fail(f"no force was felt: {felt}")
        self.skipTest("this machine was late in every try")

    TWO_HANDS = """
[[needles]]
[needles.approach]
direction = [1, 0, 0]
[needles.device]
uri = "hd:Left"
[[needles]]
[needles.approach]
direction = [-1, 0, 0]
[needles.device]
uri = "hd:Right"
"""

    def with_touch(self):
        """The environment in which the vendor's library is the tests' own."""
        return dict(os.environ, STYLET_LIBHD=os.environ["STYLET_STANDIN_HD"])

    def test_two_devices_hold_two_needles(self):
        scene = self.top / "two.toml"
        scene.write_text(self.TWO_HANDS)
        done = subprocess.run(
            [BIN / "stylet", "run", scene, "--organ", self.make_phantom(), "--allow-non-rt",
             "--duration-s", "0.5", "--flight", self.top / "flight.h5", "--json"],
            env=self.with_touch(), capture_output=True, text=True, timeout=120)
        self.assertIn(done.returncode, (0, 3), done.stderr)  # 3: this machine was late
        self.assertEqual(len(json.loads(done.stdout)["needles"]), 2)

    def test_run_says_what_was_taken_from_the_device(self):
        done = subprocess.run(
            [BIN / "stylet", "run", SCENE, "--organ", self.make_phantom(), "--device", "hd:",
             "--allow-non-rt", "--duration-s", "0.3", "--flight", self.top / "flight.h5"],
            env=self.with_touch(), capture_output=True, text=True, timeout=120)
        self.assertIn(done.returncode, (0, 3), done.stderr)  # 3: this machine was late
        for words in ('hd:: Stand-in Touch, taken for "touch"', "at most 2.97 N (device)",
                      "buzz 0.297 N (device)", "friction 0.26 N"):
            self.assertIn(words, done.stdout)

    def test_probe_and_doctor_tell_the_serial_number(self):
        record = self.top / "touch.json"
        env = dict(self.with_touch(), STYLET_STANDIN_SERIAL="40915001")
        for words, told in (
                (["devices", "probe", "hd:", "--seconds", "0.2", "-o", record],
                 "serial    40915001\n"),
                (["doctor", "--device", "hd:"], "Stand-in Touch, serial number 40915001, at most")):
            done = subprocess.run([BIN / "stylet", *words], env=env, capture_output=True, text=True,
                                  timeout=60)
            self.assertIn(told, done.stdout, done.stderr)
            self.assertIn("sends no sample times", " ".join(done.stdout.split()))
        self.assertEqual(json.loads(record.read_text())["serial_number"], "40915001")
        self.assertFalse(json.loads(record.read_text())["sends_times"])

    def test_period_too_long_for_a_device_is_refused(self):
        scene = self.top / "slow.toml"
        scene.write_text("[loop]\nperiod_us = 4000\n")  # and no script: a device holds the needle
        done = subprocess.run([BIN / "stylet", "run", scene, "--organ", self.make_phantom(),
                               "--device", "hd:"], env=self.with_touch(), capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("loop.period_us: 4000: expected at most 2000 with hd:", done.stderr)

    def test_driver_that_hangs_does_not_hold_up_the_end(self):
        organ = self.make_phantom()
        for place in ("open", "read", "write", "close"):
            with self.subTest(place):
                record = self.top / f"{place}.h5"
                run = subprocess.Popen(
                    [BIN / "stylet", "run", SCENE, "--organ", organ, "--device", "hd:",
                     "--allow-non-rt", "--record", record, "--flight", self.top / "flight.h5"],
                    env=dict(self.with_touch(), STYLET_STANDIN_HANGS=place),
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.addCleanup(run.kill)
                time.sleep(4)
                run.send_signal(signal.SIGINT)
                told = time.monotonic()
                _, said = run.communicate(timeout=60)
                self.assertLess(time.monotonic() - told, 30)  # 2 s, on a machine that is not busy
                self.assertIn(run.returncode, (1, 3), said)
                self.assertIn("hd:: its driver hangs in", said)
                if place != "open":
                    self.assertIn("same bits", call("stylet", "replay", record, "--organ",
                                                    organ).stdout)

    def test_station_joins_another_machine(self):
        port = self.free_port()
        station = subprocess.Popen([BIN / "stylet", "station", "hd:", f"127.0.0.1:{port}",
                                    "--duration-s", "20"], env=self.with_touch(),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(station.communicate)
        self.addCleanup(station.terminate)
        record = self.top / "station.json"
        done = subprocess.run([BIN / "stylet", "devices", "probe", f"udp:{port}", "--seconds", "1",
                               "-o", record], capture_output=True, text=True, timeout=60)
        self.assertIn(done.returncode, (0, 3), done.stderr)  # 3: this machine was late
        self.assertGreater(json.loads(record.read_text())["samples"], 100)

    def keep_sending(self, port, silent, done, goes=None):
        """Samples of a device, a thousand a second, but while it is told to be silent; it rests
        until it is told to go 30 mm into the tissue."""
        spec = importlib.util.spec_from_file_location("example_client", self.CLIENT)
        client = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(client)
        seq, way_m = 0, 0
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            while not done.is_set():
                seq += 1
                if goes is not None and goes.is_set():
                    way_m = min(way_m + 30e-6, 30e-3)
                if not silent.is_set():
                    packet = client.sample_packet(seq, time.monotonic_ns(), (0, 0, -way_m))
                    link.sendto(packet, ("127.0.0.1", port))
                time.sleep(0.001)

    def test_fault_is_told_and_acknowledged_with_enter(self):
        port, silent, done = self.free_port(), threading.Event(), threading.Event()
        goes = threading.Event()
        sender = threading.Thread(target=self.keep_sending, args=(port, silent, done, goes))
        sender.start()
        self.addCleanup(sender.join)
        self.addCleanup(done.set)
        keys, terminal = os.openpty()

        def in_that_terminal():
            os.setsid()
            fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)

        run = subprocess.Popen(
            [BIN / "stylet", "run", SCENE, "--organ", self.make_phantom(), "--device",
             f"udp:{port}", "--allow-non-rt", "--duration-s", "60", "--flight",
             self.top / "flight.h5", "--json"], stdin=terminal, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, text=True, preexec_fn=in_that_terminal)
        self.addCleanup(run.communicate)
        self.addCleanup(run.terminate)
        for line in run.stderr:
            if "waiting for" in line:
                threading.Timer(0.5, goes.set).start()
                threading.Timer(2.5, silent.set).start()
            if "no force until it is acknowledged: Enter" in line:
                self.assertIn("device silent (nothing came: 15.", line)
                os.write(keys, b"\n")  # too early: the device is silent
                threading.Timer(1, silent.clear).start()
            if "not acknowledged: it gives no usable sample yet" in line:
                threading.Timer(0.5, os.write, (keys, b"\n")).start()
            if "acknowledged: forces fade in" in line:
                return
        self.fail("it was never acknowledged")

    def test_fault_before_any_force_is_not_called_acknowledged(self):
        port, silent, done = self.free_port(), threading.Event(), threading.Event()
        sender = threading.Thread(target=self.keep_sending, args=(port, silent, done))
        sender.start()
        self.addCleanup(sender.join)
        self.addCleanup(done.set)
        run = subprocess.Popen(
            [BIN / "stylet", "run", SCENE, "--organ", self.make_phantom(), "--device",
             f"udp:{port}", "--allow-non-rt", "--duration-s", "60", "--flight",
             self.top / "flight.h5", "--json"], stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.communicate)
        self.addCleanup(run.terminate)
        for line in run.stderr:
            self.assertNotIn("acknowledged", line)
            self.assertNotIn("\033", line, "no terminal reads it")
            if "waiting for" in line:
                threading.Timer(2, silent.set).start()
            if "no force until it gives a usable sample" in line:
                silent.clear()
            if "a usable sample came before any force: forces fade in" in line:
                return
        self.fail("it never came back")

    def test_unknown_kind_of_device_is_refused(self):
        done = call("stylet", "run", SCENE, "--device", "phantom:", expect=1)
        self.assertIn("--device: phantom:: expected a device's URI", done.stderr)


class Bench(unittest.TestCase):
    def test_standard_output_holds_the_measurements_alone(self):
        names = call("stylet", "bench", "--benchmark_list_tests").stdout.splitlines()
        self.assertGreater(len(names), 3)
        for name in names:
            self.assertRegex(name, r"^((tissue|tick|tick_elastic)(_added)?|threads|cadence_\w+"
                                   r"|bullet|eigen)/")

    def test_help_says_what_is_measured(self):
        text = call("stylet", "bench", "--help").stdout
        for word in ("--results", "tissue", "threads", "tick", "cadence", "--benchmark_filter"):
            self.assertIn(word, text)

    def two_threads(self, processors):
        words = [BIN / "stylet", "bench", "--benchmark_filter=threads/liver_1k",
                 "--benchmark_min_time=0.001", "--benchmark_repetitions=1"]
        done = subprocess.run(words, capture_output=True, text=True, timeout=300,
                              preexec_fn=lambda: os.sched_setaffinity(0, processors))
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_two_threads_are_compared_with_one_in_the_same_seconds(self):
        """If others used the processors meanwhile, it says that instead."""
        table = self.two_threads(os.sched_getaffinity(0))
        refused = re.findall(r"(?m)^threads/liver_1k/\w+: no figure: .* ([\d.]+) x as", table)
        for times in refused:  # in two digits: 1.896 is refused, and written 1.90
            self.assertFalse(1.9 < float(times) < 2.1)
        for variant in re.findall(r"(?m)^\w+/liver_1k/(\w+) ", table):
            for measure in ("alone", "beside", "shared", "alone_any", "beside_any", "shared_any"):
                self.assertRegex(table, rf"(?m)^{measure}/liver_1k/{variant} +[\d.]+")
        self.assertTrue(refused or "shared/liver_1k" in table, table)

    def test_two_threads_on_one_processor_are_no_figure(self):
        table = self.two_threads({max(os.sched_getaffinity(0))})
        self.assertRegex(table, r"(?m)^threads/liver_1k/\w+: two threads need two processors")
        self.assertNotRegex(table, "alone|beside|shared")


class Recipe(Folder):
    def test_a_scene_of_as_many_targets_as_a_recipe_may_have_runs(self):
        """The targets have the longest names, and the first one lies outside the organ."""
        labels = self.top / "map.nrrd"
        labels.write_bytes(
            b"NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\nspace directions: "
            b"(10,0,0) (0,10,0) (0,0,10)\nspace origin: (0,0,0)\nencoding: raw\n\n" +
            32 * b"\5" + 32 * b"\7")
        recipe = self.top / "t.toml"
        recipe.write_text("[tissues]\nliver = [5]\n[targets]\n" + "".join(
            f"{i:040} = [{5 if i else 7}]\n" for i in range(32)), encoding="utf-8")
        call("stylet-organ", "build", labels, "--recipe", recipe, "--voxel-mm", "5", "-o",
             self.top / "t.organ")
        call("stylet", "run", self.top / "t.scene.toml", "--fast", "--duration-s", "0.05")


class Refusals(Folder):
    """A user's mistake ends in one line with the place, and leaves no file behind."""

    def expect_refusal(self, words, program, *arguments):
        done = call(program, *arguments, expect=1)
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 2, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_missing_organ(self):
        self.expect_refusal(["nowhere.organ"], "stylet", "run", SCENE, "--fast", "--organ",
                            self.top / "nowhere.organ")

    def test_scene_whose_organ_is_not_built_says_how(self):
        """Its message is a command that a shell accepts, and after it the scene runs."""
        scenes = self.top / "scenes of mine"
        scenes.mkdir()
        for name in ("fig10-steering.toml", "steering-gel.tissues"):
            (scenes / name).write_bytes((SOURCE / "hal/scenes" / name).read_bytes())
        words = ["run", scenes / "fig10-steering.toml", "--fast", "--duration-s", "0.01"]
        self.expect_refusal(["fig10-steering.organ: no such file"], "stylet", *words)
        told = call("stylet", *words, expect=1).stderr
        command = told.split(" is made by: ", 1)[1].strip()
        subprocess.run(command, shell=True, check=True, timeout=120, stdout=subprocess.DEVNULL)
        call("stylet", *words)

    def input_readers(self):
        """By the file's ending: each command, with each of its options, that reads such a file in
        place of {}."""
        organ, picture = self.top / "never.organ", self.top / "never.svg"
        label_map, mesh, recording = self.top / "a.nrrd", self.top / "a.off", self.top / "a.h5"
        label_map.write_text("NRRD0004\n")
        body = self.top / "body.organ"
        call("stylet-organ", "phantom", "ball", "--voxel-mm", 10, "-o", body, "--mesh-out", mesh)
        call("stylet", "run", SCENE, "--organ", body, "--fast", "--duration-s", 0.05, "--force",
             "--record", recording)
        of_recording = ["--measure", 0.1, "--replay"]
        return {
            "organ": [["stylet", "run", SCENE, "--fast", "--organ", "{}"],
                      ["stylet", "replay", recording, "--organ", "{}"],
                      ["stylet", "score", recording, "--organ", "{}"],
                      ["stylet", "console", recording, "--port", 0, "--organ", "{}"],
                      ["stylet", "doctor", *of_recording, recording, "--organ", "{}"],
                      ["stylet-organ", "info", "{}"], ["stylet-organ", "check", "{}"]],
            "toml": [["stylet", "run", "{}", "--fast"],
                     ["stylet", "score", recording, "--scene", "{}"],
                     ["stylet-organ", "build", label_map, "-o", organ, "--recipe", "{}"],
                     ["stylet-organ", "phantom", "ball", "-o", organ, "--materials", "{}"]],
            "h5": [["stylet", "replay", "{}"], ["stylet", "score", "{}"],
                   ["stylet", "console", "{}"], ["stylet", "plot", "-o", picture, "{}"],
                   ["stylet", "doctor", *of_recording, "{}"]],
            "stl": [["stylet-organ", "build", "-o", organ, "{}"],
                    ["stylet-organ", "phantom", "ball", "-o", organ, "--fix", "touching:{}"],
                    ["stylet-organ", "hull", "-o", organ, "{}"]],
            "csv": [["stylet-organ", "build", mesh, "-o", organ, "--units", "m", "--fit", "1kHz",
                     "--machine", "{}"]],
            "nrrd": [["stylet-organ", "labels", "{}"]]}

    def test_every_kind_of_input_says_why_it_cannot_be_read(self):
        """A missing file, a directory, a pipe, an unreadable and an empty file each have a message
        of their own, for every kind of input."""
        folder = self.top / "inputs"
        folder.mkdir()
        whys = {"missing": "no such file", "folder": "is a directory", "empty": "is empty",
                "pipe": " pipe"}  # without a writer
        if os.geteuid() != 0:  # root may read everything
            whys["locked"] = "Permission denied"
        cases = []
        for ending, commands in self.input_readers().items():
            (folder / f"folder.{ending}").mkdir()
            (folder / f"empty.{ending}").touch()
            os.mkfifo(folder / f"pipe.{ending}")
            (folder / f"locked.{ending}").write_text("locked")
            (folder / f"locked.{ending}").chmod(0)
            cases += [(folder / f"{name}.{ending}", why, words) for name, why in whys.items()
                      for words in commands
                      # A folder could hold DICOM slices: then the message says that it has none.
                      if name != "folder" or ending not in ("nrrd", "stl")]
        random.Random(6).shuffle(cases)
        for path, why, (program, *words) in cases:
            words = [str(word).replace("{}", str(path)) for word in words]
            with self.subTest(" ".join([program, *words])):
                self.expect_refusal([str(path), why], program, *words)
        for name in ("never.organ", "never.svg"):
            self.assertFalse((self.top / name).exists())

    def test_a_scene_may_come_through_a_pipe(self):
        """It is read whole from a writer that is slow or late; a pipe without a writer, an empty
        and an endless one are refused."""
        organ, chosen = self.make_phantom(), random.Random(8)
        text = SCENE.read_text()
        words = ["--fast", "--duration-s", 0.01, "--organ", organ]
        command = " ".join(map(str, [BIN / "stylet", "run", *words]))
        for script in (f"{command} <(cat {SCENE})", f"cat {SCENE} | {command} /dev/stdin",
                       f"{command} <(sleep 6; cat {SCENE})"):
            subprocess.run(["bash", "-c", script], check=True, timeout=60, capture_output=True)
        path = self.top / "scene.pipe"
        os.mkfifo(path)

        def run_with(write):
            writer = threading.Thread(target=write, daemon=True)
            writer.start()
            done = subprocess.run([BIN / "stylet", "run", path, *map(str, words)], timeout=60,
                                  capture_output=True, text=True)
            writer.join(10)
            return done.returncode, done.stderr

        def late():
            time.sleep(1.5)
            with path.open("w") as pipe:
                for part in sorted(chosen.sample(range(1, len(text)), 3)) + [len(text)]:
                    pipe.write(text[late.at:part])
                    late.at = part
                    pipe.flush()
                    time.sleep(0.2)
        late.at = 0

        def endless():
            with contextlib.suppress(BrokenPipeError), path.open("w") as pipe:
                while True:
                    pipe.write("# and so on\n" * 10000)

        self.assertEqual(run_with(late)[0], 0)
        self.assertEqual(late.at, len(text))
        for write, why in ((lambda: path.open("w").close(), "is empty"),
                           (endless, "has more than 16777216 bytes"),
                           (lambda: None, "is a pipe that nobody writes to")):
            code, said = run_with(write)
            self.assertEqual(code, 1)
            self.assertIn(f"{path}: {why}: expected a scene", said)

    def test_unknown_option_of_bench(self):
        self.expect_refusal(["--resuls=x", "--help"], "stylet", "bench", "--resuls=x")

    def test_damaged_organ(self):
        organ = self.make_phantom()
        organ.write_bytes(organ.read_bytes()[:1000])
        self.expect_refusal([organ.name], "stylet", "run", SCENE, "--fast", "--organ", organ)

    def test_organ_with_another_value_than_was_written(self):
        organ = self.make_phantom()
        whole = organ.read_bytes()
        fills = whole.index(bytes([255]) * 200) + 100
        organ.write_bytes(whole[:fills] + bytes([17]) + whole[fills + 1:])
        self.expect_refusal([organ.name, "content_sha256"], "stylet", "run", SCENE, "--fast",
                            "--organ", organ)

    def test_wrong_key_in_scene(self):
        scene = self.top / "scene.toml"
        scene.write_text(SCENE.read_text() + "\n[needel]\nlength_mm = 1\n")
        line = scene.read_text().splitlines().index("[needel]") + 1
        self.expect_refusal([scene.name, f":{line}", "needel"], "stylet", "run", scene, "--fast",
                            "--organ", self.make_phantom())

    def test_more_threads_than_processors(self):
        if len(os.sched_getaffinity(0)) >= 16:
            self.skipTest("this machine has a processor for each")
        done = call("stylet", "run", SCENE, "--organ", "none.organ", "--threads", "16", expect=1)
        self.assertRegex(done.stderr, r"loop\.threads: 16: expected at most \d+, so that each has")
        done = call("stylet", "run", SCENE, "--threads", "17", expect=1)
        self.assertIn("--threads: Value 17 not in range 1 to 16", done.stderr + done.stdout)

    def test_a_file_that_is_no_recording(self):
        fake = self.top / "fake.h5"
        fake.write_text("no recording")
        self.expect_refusal([fake.name], "stylet", "replay", fake)
        picture = self.top / "none.svg"
        self.expect_refusal([fake.name], "stylet", "plot", fake, "-o", picture)
        self.assertFalse(picture.exists())

    def test_a_file_that_is_no_mesh(self):
        mesh = self.top / "empty.stl"
        mesh.write_text("")
        organ = self.top / "none.organ"
        self.expect_refusal([mesh.name], "stylet-organ", "build", mesh, "--units", "mm",
                            "--voxel-mm", "5", "-o", organ)
        self.assertEqual(list(self.top.glob("none.organ*")), [])


if __name__ == "__main__":
    unittest.main()
