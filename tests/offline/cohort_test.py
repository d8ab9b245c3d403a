#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""offline/cohort over phantoms and real label maps: the same bytes with any number of jobs at once
and after kills, on one machine and under a real Slurm; bad patients are listed and stop no others.

usage: cohort_test.py OneMachine|Table|UnderSlurm
STYLET_BIN and STYLET_SOURCE in the environment; STYLET_DATA wins over the data beside it.
"""
import base64
import codecs
import csv
import hashlib
import io
import os
import pathlib
import random
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import one_node_slurm

SOURCE = pathlib.Path(os.environ.get("STYLET_SOURCE", pathlib.Path(__file__).parents[2]))
BIN = pathlib.Path(os.environ.get("STYLET_BIN", SOURCE / "build/bin"))
DATA = pathlib.Path(os.environ.get("STYLET_DATA", SOURCE.parent / "shared/data"))
TOOL = BIN / "stylet-organ"
COHORT = SOURCE / "offline/cohort"
RECIPE = SOURCE / "offline/recipes/totalsegmentator.toml"


def table_of(folder, phantoms):
    """Writes the table; returns the patients that must be refused."""
    liver = folder / "liver.toml"
    liver.write_text("[tissues]\nliver = [1]\n")
    rows = [["patient", "input", "recipe", "options", "memory_mb"]]
    for i in range(phantoms):
        mesh = folder / f"ball{i}.off"
        subprocess.run([TOOL, "phantom", "ball", "--diameter-mm", str(40 + i), "--mesh-out", mesh,
                        "-o", folder / "unused.organ"], check=True, capture_output=True)
        rows.append([f"phantom{i}", f"{mesh.name}:gel", "", "--units m --voxel-mm 3", "400"])
    maps = DATA / "labelmaps"
    for name in ("ts_example_seg", "ts_example_seg_fast_force_split"):
        rows.append([name, maps / f"{name}.nii.gz", RECIPE, "--voxel-mm 6", ""])
    rows.append(["spine", maps / "dcmqi_liver_seg.nrrd", liver.name, "", ""])
    bad = [["grey", maps / "ts_example_ct_sm.nii.gz", RECIPE, "", ""],
           ["gone", "nowhere.nii.gz", RECIPE, "", ""],
           ["wrong", "liver.toml", "", "", ""]]
    rows[2:2] = bad
    with open(folder / "patients.csv", "w", newline="") as file:
        csv.writer(file).writerows(rows)
    return [row[0] for row in bad], [row[0] for row in rows[1:]]


class Case(unittest.TestCase):
    PHANTOMS = 3

    @classmethod
    def setUpClass(cls):
        if shutil.which("snakemake") is None:
            raise unittest.SkipTest("snakemake is not installed: apt-get install snakemake")
        if not (DATA / "labelmaps").exists():
            raise unittest.SkipTest(f"{DATA}/labelmaps is not there; set STYLET_DATA")
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        cls.bad, cls.patients = table_of(cls.folder, cls.PHANTOMS)

    def command(self, out, *more, profile="local"):
        return ["snakemake", "-s", COHORT / "Snakefile", "--profile", COHORT / profile, *more,
                "--config", "patients=patients.csv", f"out={out}", f"stylet_organ={TOOL}"]

    def run_to_end(self, out, *more, **options):
        done = subprocess.run([str(word) for word in self.command(out, *more, **options)],
                              cwd=self.folder, text=True, capture_output=True, timeout=900)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])
        return done.stderr

    def start(self, out, *more, environment=None, **options):
        return subprocess.Popen([str(word) for word in self.command(out, *more, **options)],
                                cwd=self.folder, stdout=subprocess.DEVNULL, env=environment,
                                stderr=subprocess.DEVNULL, start_new_session=True)

    def outcomes(self, out):
        return {path.stem: path.stat().st_mtime_ns
                for path in (self.folder / out / "outcome").glob("*.json")}

    def noted(self, out):
        """Outcomes that Snakemake takes for complete. It marks a file before its job and removes
        the mark a moment after it; files that are marked after a kill are made again."""
        marks = self.folder / ".snakemake/incomplete"
        mark_of = {name: base64.urlsafe_b64encode(f"{out}/outcome/{name}.json".encode()).decode()
                   for name in self.patients}
        return {name: when for name, when in self.outcomes(out).items()
                if not (marks / mark_of[name]).exists()}

    def wait_for_outcomes(self, out, least):
        for _ in range(1200):
            if len(self.noted(out)) >= least:
                return
            time.sleep(0.05)
        self.fail(f"{least} outcomes were not there after a minute")

    def bytes_of(self, out):
        """Checksums of all files except reports that name their folder."""
        folder = self.folder / out
        sums = {}
        for path in sorted(folder.rglob("*")):
            if path.is_file() and not (path.name == "report.json"):
                sums[str(path.relative_to(folder))] = hashlib.sha256(path.read_bytes()).hexdigest()
        return sums

    def check_index(self, out):
        with open(self.folder / out / "index.csv", newline="") as file:
            rows = {row["patient"]: row for row in csv.DictReader(file)}
        self.assertEqual(list(rows), self.patients)
        for name, row in rows.items():
            self.assertEqual(bool(row["refused"]), name in self.bad, row)
            self.assertEqual((self.folder / out / "organ" / f"{name}.organ").exists(),
                             name not in self.bad)
        self.assertIn("whole numbers", rows["grey"]["refused"])
        self.assertIn("no such file", rows["gone"]["refused"])
        page = (self.folder / out / "index.html").read_text()
        good = len(self.patients) - len(self.bad)
        self.assertIn(f"{len(self.patients)} patients: {good} organs", page)
        for name in self.patients:
            self.assertIn(f">{name}<", page)


class OneMachine(Case):
    def test_same_bytes_after_a_kill_and_with_any_parallelism(self):
        killed = self.start("killed", "--cores", "2")
        self.wait_for_outcomes("killed", 3)
        os.killpg(killed.pid, signal.SIGKILL)
        killed.wait()
        before = self.noted("killed")
        self.assertLess(len(before), len(self.patients), "killed too late to prove anything")
        self.run_to_end("killed", "--cores", "2")
        after = self.outcomes("killed")
        for name, when in before.items():
            self.assertEqual(after[name], when, f"{name} was built twice")
        self.run_to_end("alone", "--cores", "1")
        self.assertEqual(self.bytes_of("killed"), self.bytes_of("alone"))
        self.check_index("alone")
        self.assertIn("Nothing to be done", self.run_to_end("alone", "--cores", "1"))

    def test_a_wrong_table_is_refused_in_one_line(self):
        for text, said in (("patient,file\na,b\n", "patients.csv:1: file: expected the columns"),
                           ("patient,patient,input\n",
                            "patients.csv:1: patient, patient: expected"),
                           ("", "patients.csv:1: patient, input: expected the columns"),
                           ('patient,input\n"a,b\n', "expected a table as CSV")):
            folder = self.folder / "wrong"
            folder.mkdir(exist_ok=True)
            (folder / "patients.csv").write_text(text)
            done = subprocess.run([str(word) for word in self.command("out")], cwd=folder,
                                  text=True, capture_output=True, timeout=60)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(said, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_bad_row_is_listed_and_does_not_stop_others(self):
        folder = self.folder / "rows"
        folder.mkdir()
        shutil.copy(self.folder / "ball0.off", folder)
        crash = folder / "tool"
        crash.write_text(f"#!/bin/sh\ncase \"$*\" in *crash*) kill -SEGV $$;; esac\n"
                         f"exec {TOOL} \"$@\"\n")
        crash.chmod(0o755)
        good = "ball0.off:gel"
        rows = [("good", good, "--units m --voxel-mm 9", ""), ("a/b", good, "", ""),
                ("good", good, "", ""), ("memory", good, "", "lots"), ("none", "", "", ""),
                ("quote", "'ball0.off", "", ""), ("usage", good, "--voxel-mm soft", ""),
                ("twice", good, "-o other.organ", ""), ("crash", good, "--name crash", ""),
                ("..", good, "", ""), ("last", good, "--units m --voxel-mm 8", "")]
        with open(folder / "patients.csv", "w", newline="", encoding="utf-16") as file:
            table = csv.writer(file, delimiter=";", quoting=csv.QUOTE_ALL)
            table.writerow(["Patient", "Input", "Options", "Memory_MB"])
            table.writerows(rows)
        done = subprocess.run([str(word) for word in self.command("out", "--cores", "2")][:-1] +
                              [f"stylet_organ={crash}"], cwd=folder, text=True,
                              capture_output=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])
        with open(folder / "out/index.csv", newline="", encoding="utf-8") as file:
            index = list(csv.DictReader(file))
        self.assertEqual([row["patient"] for row in index], [row[0] for row in rows])
        said = [row["refused"] for row in index]
        self.assertEqual([bool(each) for each in said], [False] + [True] * 9 + [False])
        for each, reason in zip(said[1:], ("patients.csv:3: patient 'a/b'", "is there already",
                                           "memory_mb 'lots'", "expected a label map or meshes",
                                           "No closing quotation", "options: ", "options: ",
                                           "each time", "patient '..'")):
            self.assertIn(reason, each)
        self.assertEqual(len(list((folder / "out/organ").glob("*.organ"))), 2)


class Table(unittest.TestCase):
    """The table as spreadsheets write it is read as it was meant."""

    def test_every_spelling_gives_the_same_patients(self):
        sys.path.insert(0, str(COHORT))
        import patients  # pylint: disable=import-outside-toplevel
        draw = random.Random(11)
        marks = {"utf-8": b"", "utf-8-sig": b"", "utf-16": b"", "utf-16-le": codecs.BOM_UTF16_LE,
                 "utf-16-be": codecs.BOM_UTF16_BE, "cp1252": b""}
        with tempfile.TemporaryDirectory() as folder:
            for number in range(200):
                encoding = draw.choice(list(marks))
                separator, end = draw.choice(",;\t"), draw.choice(["\n", "\r\n"])
                columns = ["patient", "input"] + draw.sample(["recipe", "options", "memory_mb"],
                                                             draw.randint(0, 3))
                draw.shuffle(columns)
                rows = [{"patient": f"p{i}",
                         "input": draw.choice(["a b.off:gel:1", "m\u00e4p.nii"]),
                         "recipe": draw.choice(["", "r; x,y.toml"]),
                         "options": draw.choice(["", "--fix 'x>5, 6'", "--name \"a; b\""]),
                         "memory_mb": draw.choice(["", "700"])} for i in range(5)]
                text = io.StringIO(newline="")
                table = csv.writer(text, delimiter=separator, lineterminator=end,
                                   quoting=draw.choice([csv.QUOTE_ALL, csv.QUOTE_MINIMAL]))
                table.writerow([draw.choice([name, name.upper(), f" {name}"]) for name in columns])
                for row in rows:
                    table.writerow([row[name] for name in columns])
                    if draw.random() < 0.2:
                        table.writerow([""] * len(columns))
                told = f"sep={separator}{end}" if draw.random() < 0.2 else ""
                path = pathlib.Path(folder) / f"{number}.csv"
                path.write_bytes(marks[encoding] + (told + text.getvalue()).encode(encoding))
                read = patients.read_patients(path)
                self.assertEqual(list(read), [row["patient"] for row in rows])
                for row, patient in zip(rows, read.values()):
                    self.assertEqual(patient.refused, "")
                    known = {name: row[name] if name in columns else "" for name in row}
                    self.assertEqual(patient.inputs, [f"{folder}/{word}" for word in
                                                      known["input"].split()])
                    self.assertEqual(patient.options, shlex.split(known["options"]))
                    self.assertEqual(patient.memory_mb, int(known["memory_mb"] or 1500))
                    recipe = f"{folder}/{known['recipe']}" if known["recipe"] else ""
                    self.assertEqual(patient.recipe, recipe)


class UnderSlurm(Case):
    PHANTOMS = 8

    @classmethod
    def setUpClass(cls):
        if one_node_slurm.missing():
            raise unittest.SkipTest(f"{', '.join(one_node_slurm.missing())} not installed: "
                                    "apt-get install slurmctld slurmd slurm-client munge")
        super().setUpClass()

    def wait_for_job(self, slurm):
        for _ in range(600):
            running = slurm.run("squeue", "-ht", "RUNNING", "-o", "%A").split()
            if running:
                return running[0]
            time.sleep(0.05)
        self.fail("no job runs")

    def kill_a_worker(self, slurm):
        """Kills the processes of a running job, as a failing node would."""
        job = self.wait_for_job(slurm)
        slurm.run("scancel", "--signal=KILL", "--full", job)
        return job

    def test_same_bytes_as_one_machine_with_a_worker_killed_half_way(self):
        self.run_to_end("alone", "--cores", "1")
        with tempfile.TemporaryDirectory() as folder, one_node_slurm.OneNodeSlurm(folder) as slurm:
            work = self.start("slurm", "--latency-wait", "5", profile="slurm",
                              environment=slurm.environment)
            self.wait_for_outcomes("slurm", 3)
            self.assertLess(len(self.outcomes("slurm")), len(self.patients))
            job = self.kill_a_worker(slurm)
            self.assertEqual(work.wait(timeout=600), 0)
            told = slurm.run("scontrol", "-o", "show", "job", job)
            self.assertNotIn("JobState=COMPLETED", told)
        self.assertEqual(self.bytes_of("slurm"), self.bytes_of("alone"))
        self.check_index("slurm")


if __name__ == "__main__":
    unittest.main(verbosity=2)
