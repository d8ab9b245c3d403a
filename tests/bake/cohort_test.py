#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""offline/cohort over phantoms and real label maps: the same bytes however many at once, through
kills, on one machine and under a real Slurm; bad patients are listed and stop no other.

usage: cohort_test.py OneMachine|UnderSlurm   (STYLET_BIN, STYLET_SOURCE; STYLET_DATA overrides)
"""
import base64
import csv
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
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
        """Outcomes that Snakemake knows to be whole. It marks a file before its job and takes the
        mark away a moment after; what is marked after a kill is made anew."""
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
        """Sums of everything but reports that name their folder."""
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
    def test_same_bytes_through_a_kill_and_whatever_the_parallelism(self):
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

    def test_a_wrong_table_is_one_line(self):
        for text, said in (("patient,file\na,b\n", "patients.csv:1: expected the columns"),
                           ("patient,input\na/b,c\n", "patients.csv:2: patient 'a/b'"),
                           ("patient,input\na,b\na,b\n", "patients.csv:3: patient 'a' is there"),
                           ("patient,input,memory_mb\na,b,x\n", "patients.csv:2: memory_mb 'x'"),
                           ("patient,input\na,\n", "patients.csv:2: input: expected")):
            folder = self.folder / "wrong"
            folder.mkdir(exist_ok=True)
            (folder / "patients.csv").write_text(text)
            done = subprocess.run([str(word) for word in self.command("out")], cwd=folder,
                                  text=True, capture_output=True, timeout=60)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(said, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


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
        """Kills the processes of a running job, as a node that dies would."""
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
