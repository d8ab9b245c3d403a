#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Campaigns: many insertions with random parameters in one table, on processes, on Dask, and on
Dask under a Slurm that the test starts; killed half-way and resumed, no row is run twice.

Expected values: the same rows, run here one by one; marks that each row leaves as it is run.

usage: campaign_test.py Small|Large|UnderSlurm
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest

import h5py
import numpy as np
import stylet
from support import SOURCE, folder, program

sys.path[:0] = [str(SOURCE / "hal/hosts/python/examples"), str(SOURCE / "tests/offline")]
import campaign  # noqa: E402
import one_node_slurm  # noqa: E402

unit_of = sys.modules["stylet.sweep"].unit_of  # stylet.sweep is also the name of a function

HERE = pathlib.Path(__file__).resolve()
EXAMPLE = SOURCE / "hal/hosts/python/examples/campaign.py"
SEED = 5
RESULTS = ("peak_force_n", "puncture_force_n", "end_depth_m", "deflection_m", "flags", "state")


def marked(number, marks, **row):
    """An insertion that leaves a mark each time that it is run."""
    with open(os.path.join(marks, str(number)), "a") as file:
        file.write("x")
    return campaign.insertion(**row)


def small_organ():
    """100 voxels: what is tested is not the physics."""
    path = folder() / "small.organ"
    if not path.exists():
        subprocess.run([program("stylet-organ"), "phantom", "block", "--size-mm", "40,40,32",
                        "--voxel-mm", "8", "--tissue", "liver", "--fix", "z<10%", "-o", path],
                       check=True, capture_output=True)
    return str(path)


def rows(count, marks, organ=None):
    return {"number": np.arange(count), "marks": [str(marks)] * count,
            "organ": [organ or small_organ()] * count, **stylet.draw(campaign.DRAWN, count, SEED)}


class Case(unittest.TestCase):
    def setUp(self):
        top = tempfile.TemporaryDirectory()
        self.addCleanup(top.cleanup)
        self.top = pathlib.Path(top.name)
        self.marks, self.path = self.top / "marks", str(self.top / "table.h5")
        self.marks.mkdir()

    def done(self):
        if not os.path.exists(self.path):
            return np.zeros(0, bool)
        with h5py.File(self.path) as file:
            return file["rows/done"][:]

    def wait_for(self, least, work=None):
        """Waits until so many rows are in the file; returns which."""
        end = time.monotonic() + 300
        while time.monotonic() < end:
            done = self.done()
            if np.count_nonzero(done) >= least:
                return done
            self.assertTrue(work is None or work.poll() is None, "it ended before")
            time.sleep(0.05)
        self.fail(f"{least} rows were not done after 300 s")

    def times_run(self, count):
        paths = [self.marks / str(i) for i in range(count)]
        return np.array([path.stat().st_size if path.exists() else 0 for path in paths])

    def start(self, count, where, **more):
        """The campaign in a process group of its own."""
        script = self.top / "run.py"
        script.write_text(textwrap.dedent(f"""
            import sys
            sys.path.insert(0, {str(HERE.parent)!r})
            import campaign_test as test
            import stylet
            if __name__ == "__main__":
                rows = test.rows({count}, {str(self.marks)!r}, {small_organ()!r})
                stylet.sweep(test.marked, rows, path={self.path!r},
                             attributes={{"seed": test.SEED}}, {where})
            """))
        return subprocess.Popen([sys.executable, script], start_new_session=True, **more)

    def check(self, count, table, before):
        """All rows are there; none of those that were there `before` was run again; some that are
        run here are the same."""
        self.assertEqual(set(table["error"]), {""})
        times = self.times_run(count)
        np.testing.assert_array_equal(times[np.flatnonzero(before)], 1)
        parameters = rows(count, self.marks)
        for i in np.random.default_rng(3).choice(count, 12, replace=False):
            expected = campaign.insertion(**{name: column[i] for name, column in parameters.items()
                                             if name not in ("number", "marks")})
            for name in RESULTS:
                np.testing.assert_array_equal(table[name][i], expected[name])

    def killed_and_resumed(self, count, least):
        work = self.start(count, "workers=2")
        self.wait_for(least, work)
        os.killpg(work.pid, signal.SIGKILL)
        work.wait()
        before = self.done()
        self.assertLess(np.count_nonzero(before), count)
        self.assertEqual(self.start(count, "workers=2").wait(timeout=1200), 0)
        table, attributes = stylet.read_table(self.path)
        self.assertEqual(attributes["seed"], SEED)
        self.check(count, table, before)


class Small(Case):
    def test_killed_and_resumed_on_processes(self):
        self.killed_and_resumed(200, 40)

    def test_the_example(self):
        said = subprocess.run([EXAMPLE, small_organ(), self.path, "--insertions", "24",
                               "--workers", "2", "--seed", "8"], check=True, capture_output=True,
                              text=True).stdout
        self.assertIn("24 insertions, 0 failed", said)
        table, attributes = stylet.read_table(self.path)
        self.assertEqual((attributes["seed"], attributes["version"]), (8, stylet.version()))
        drawn = stylet.draw(campaign.DRAWN, 24, 8)
        for name, column in drawn.items():
            np.testing.assert_array_equal(table[name], column)
        self.assertEqual(list(table), ["organ", *drawn, *RESULTS, "error"])
        self.assertEqual(list(attributes["columns"]), list(table))
        with h5py.File(self.path) as file:
            units = {name: column.attrs.get("unit") for group in ("parameters", "results")
                     for name, column in file[group].items()}
        self.assertEqual(units, {
            "organ": None, "aside_m": "m", "tilt_rad": "rad", "depth_m": "m",
            "speed_m_per_s": "m/s", "outer_radius_m": "m", "bending_nm2": "N m2",
            "peak_force_n": "N", "puncture_force_n": "N", "end_depth_m": "m", "deflection_m": "m",
            "flags": None, "state": None})
        # A deeper insertion has a longer path, and every needle entered.
        self.assertGreater(np.corrcoef(table["depth_m"], table["end_depth_m"])[0, 1], 0.5)
        refused = subprocess.run([EXAMPLE, small_organ(), self.path, "--insertions", "24",
                                  "--seed", "9"], capture_output=True, text=True)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("seed is 8, and here 9", refused.stderr)

    def test_units_of_names(self):
        for name, unit in (("force_n", "N"), ("stiffness_n_per_m", "N/m"), ("way", ""),
                           ("viscous_friction_n_s_per_m2", "N s/m2"), ("bevel_per_m", "1/m"),
                           ("torque_nm", "N m"), ("n", ""), ("youngs_modulus_kpa", "kPa"),
                           ("density_kg_per_m3", "kg/m3")):
            self.assertEqual(unit_of(name), unit, name)

    def test_a_worker_of_dask_dies(self):
        try:
            from dask.distributed import Client, LocalCluster
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        os.environ["PYTHONPATH"] = os.pathsep.join([str(HERE.parent), os.environ["PYTHONPATH"]])
        count, told = 200, []
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                          local_directory=str(self.top)) as cluster, Client(cluster) as client:
            pids = list(client.run(os.getpid).values())

            def kill():
                before = self.wait_for(30)
                os.kill(pids[0], signal.SIGKILL)
                told.append(before)
            killer = threading.Thread(target=kill)
            killer.start()
            import campaign_test as importable  # under the name by which workers import it
            table = stylet.sweep(importable.marked, rows(count, self.marks), client=client,
                                 path=self.path, attributes={"seed": SEED})
            killer.join()
        self.check(count, table, told[0])


class Large(Case):
    def test_two_thousand_on_processes(self):
        self.killed_and_resumed(2000, 300)


class UnderSlurm(Case):
    """As in README.md: a scheduler of Dask, its workers as jobs of Slurm, and the campaign."""

    def setUp(self):
        if one_node_slurm.missing():
            self.skipTest(f"{', '.join(one_node_slurm.missing())} not installed: "
                          "apt-get install slurmctld slurmd slurm-client munge")
        super().setUp()

    def client(self, scheduler):
        return f"client=__import__('distributed').Client(scheduler_file={str(scheduler)!r})"

    def test_two_thousand_with_a_job_and_the_campaign_killed(self):
        count, scheduler = 2000, self.top / "scheduler.json"
        slurm_folder = self.top / "slurm"
        slurm_folder.mkdir()
        with one_node_slurm.OneNodeSlurm(slurm_folder) as slurm:
            environment = {**slurm.environment, "PYTHONPATH": os.pathsep.join(
                [str(HERE.parent), os.environ["PYTHONPATH"]])}
            serves = subprocess.Popen(
                ["dask-scheduler", "--scheduler-file", scheduler, "--port", "0", "--no-dashboard"],
                env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(serves.wait)
            self.addCleanup(serves.terminate)
            slurm.environment = environment  # sbatch hands it to its jobs
            slurm.run("sbatch", "--array=1-2", "--output=/dev/null", f"--chdir={self.top}",
                      f"--wrap=dask-worker --scheduler-file {scheduler} --nthreads 1 --no-dashboard"
                      f" --local-directory {self.top}")
            work = self.start(count, self.client(scheduler), env=environment)
            first = self.wait_for(300, work)
            job = slurm.run("squeue", "-ht", "RUNNING", "-o", "%A").split()[0]
            slurm.run("scancel", "--signal=KILL", "--full", job)
            self.wait_for(np.count_nonzero(first) + 300, work)
            os.killpg(work.pid, signal.SIGKILL)
            work.wait()
            before = self.done()
            self.assertLess(np.count_nonzero(before), count)
            # The job's last row may have been lost with the job, and then another ran it again.
            times = self.times_run(count)[before]
            again = self.start(count, self.client(scheduler), env=environment)
            self.assertEqual(again.wait(timeout=1200), 0)
            told = slurm.run("scontrol", "-o", "show", "job", job)
            self.assertNotIn("JobState=COMPLETED", told)
            slurm.run("scancel", "--full", "--user", str(os.getuid()))
        table, attributes = stylet.read_table(self.path)
        self.assertEqual(attributes["seed"], SEED)
        self.check(count, table, first)
        np.testing.assert_array_equal(self.times_run(count)[before], times)


if __name__ == "__main__":
    unittest.main()
