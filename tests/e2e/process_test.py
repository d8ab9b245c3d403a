#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What happens to a run when its processes are killed.

usage: process_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import json
import os
import pathlib
import random
import re
import resource
import signal
import socket
import subprocess
import time
import unittest

import h5py

from cli_test import BIN, SCENE, Folder, call, wait_until


class Run:
    """A run in real time beside the test; the machine may be too slow for it."""

    def __init__(self, organ, *arguments, scene=SCENE):
        self.process = subprocess.Popen(
            [str(part) for part in (BIN / "stylet", "run", scene, "--organ", organ,
                                    "--allow-non-rt", *arguments)],
            cwd=organ.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.process.stdout.readline()  # it has begun

    def end(self, number=signal.SIGINT, timeout=60):
        """Exit code, standard output and standard error."""
        self.process.send_signal(number)
        out, error = self.process.communicate(timeout=timeout)
        return self.process.returncode, out, error


def has_ended(process):
    status = pathlib.Path(f"/proc/{process}/status")
    try:
        return "State:\tZ" in status.read_text()
    except FileNotFoundError:
        return True


def loop_runs(process):
    names = pathlib.Path(f"/proc/{process}/task").glob("*/comm")
    return "stylet-loop" in [name.read_text().strip() for name in names]


class Killed(Folder):
    """After kill -9 at any time at most a second is lost, and the rest can be read."""

    def test_recording_survives(self):
        organ = self.make_phantom()
        for each in range(3):
            recording = self.top / f"killed{each}.h5"
            run = Run(organ, "--record", recording)
            time.sleep(random.uniform(1.2, 3))
            child = beside(run, "recorder")
            run.end(signal.SIGKILL)
            killed_ns = time.monotonic_ns()
            wait_until(lambda: has_ended(child), 5)
            self.assertFalse(recording.exists())
            left, = self.top.glob(recording.name + ".*.tmp")
            with h5py.File(left, "r", swmr=True) as file:
                rows = min(len(file["output/tick"]), len(file["device/t_ns"]))
                self.assertEqual(list(file["output/tick"][:rows]), list(range(1, rows + 1)))
                lost_s = 1e-9 * (killed_ns - int(file["device/t_ns"][rows - 1]))
            self.assertLess(lost_s, 1)
            self.assertIn("same bits", call("stylet", "replay", left).stdout)
            call("stylet", "plot", left, "-o", self.top / "left.svg")
            hint = call("stylet", "replay", recording, expect=1).stderr
            self.assertIn(str(left), hint)

    def start_into_a_full_pipe(self, recording, streams, fill_when):
        """A run whose streams nobody reads; the pipe is full when `fill_when` holds."""
        reader, writer = os.pipe()
        self.addCleanup(os.close, reader)
        self.addCleanup(os.close, writer)
        def fill():
            os.set_blocking(writer, False)
            for piece in (b"x" * 512, b"x"):
                try:
                    while True:
                        os.write(writer, piece)
                except BlockingIOError:
                    pass
            os.set_blocking(writer, True)
        if fill_when is None:
            fill()
        ways = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL,
                **dict.fromkeys(streams, writer)}
        run = subprocess.Popen([BIN / "stylet", "run", SCENE, "--organ", self.organ,
                                "--allow-non-rt", "--record", recording, "--flight",
                                self.top / "late.h5"], stdin=subprocess.DEVNULL, **ways)
        self.addCleanup(run.kill)
        if fill_when is not None:
            wait_until(lambda: fill_when(run))
            fill()
        return run

    def test_a_reader_that_reads_no_more_holds_no_run(self):
        """One signal ends the run. If it comes before the first tick, nothing is left; otherwise
        the recording is completed."""
        self.organ = self.make_phantom()
        for i, streams in enumerate((["stdout"], ["stdout", "stderr"])):
            recording = self.top / f"held{i}.h5"
            run = self.start_into_a_full_pipe(recording, streams, None)
            wait_until(lambda: list(self.top.glob(f"held{i}.h5.*.tmp")))
            time.sleep(random.uniform(0, 1))
            run.send_signal(signal.SIGTERM)
            self.assertEqual(run.wait(timeout=30), 1)
            self.assertEqual(list(self.top.glob(f"held{i}.*")), [])
            run = self.start_into_a_full_pipe(recording, streams, lambda run: loop_runs(run.pid))
            time.sleep(random.uniform(0.5, 1))
            run.send_signal(signal.SIGTERM)
            self.assertEqual(run.wait(timeout=30), 1)
            self.assertEqual(list(self.top.glob(f"held{i}.*")), [recording])
            call("stylet", "replay", recording)


def beside(run, role):
    """The process of this role beside a run."""
    children = pathlib.Path(f"/proc/{run.process.pid}/task/{run.process.pid}/children")
    for child in map(int, children.read_text().split()):
        words = pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")
        if words[1:3] == [b"beside", role.encode()]:
            return child
    raise AssertionError(f"no {role} beside {run.process.pid}")


class Disturbed(Folder):
    """If a process beside the loop crashes, hangs or starves, the run goes on with the same bits.

    In virtual time, in which a busy machine cannot change the bits.
    """

    DURATION_S = 10  # two of real time

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.organ = cls.make_phantom()
        began = time.monotonic()
        alone = call("stylet", "run", SCENE, "--organ", cls.organ, "--fast", "--json",
                     "--duration-s", cls.DURATION_S)
        cls.wall_s = time.monotonic() - began
        cls.alone = json.loads(alone.stdout)
        cls.random = random.Random(28)

    def start(self, *arguments, duration_s=DURATION_S, clock="--fast"):
        run = Run.__new__(Run)
        run.process = subprocess.Popen(
            [str(part) for part in (BIN / "stylet", "run", SCENE, "--organ", self.organ, clock,
                                    "--json", "--duration-s", duration_s, *arguments)],
            cwd=self.top, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.process.communicate)
        self.addCleanup(run.process.kill)
        return run

    def some_time(self):
        """A time somewhere in the run."""
        time.sleep(self.random.uniform(0, 0.6 * self.wall_s))

    @staticmethod
    def of_the_loop(report):
        return {name: value for name, value in report["counters"].items()
                if not name.startswith("lost_")}

    def same_run(self, run, timeout=120):
        """Its report and its output, after it has ended as if nothing had happened."""
        out, error = run.process.communicate(timeout=timeout)
        self.assertNotEqual(out, "", error)
        report = json.loads(out)
        self.assertEqual(report["state_hash"], self.alone["state_hash"], error)
        self.assertEqual(report["timing"]["ticks"], self.alone["timing"]["ticks"])
        self.assertEqual(self.of_the_loop(report), self.of_the_loop(self.alone))
        return report, error


class Igtl(Disturbed):
    """The process of OpenIGTLink's server ends in any way, or hangs."""

    def follow(self, **how):
        run = self.start("--igtl=0", **how)
        line = run.process.stderr.readline()
        if "built without" in line:
            self.skipTest("libopenigtlink-dev is missing")
        port = int(re.search(r"OpenIGTLink at 127\.0\.0\.1:(\d+)", line)[1])
        client = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.addCleanup(client.close)
        self.assertTrue(client.recv(1))
        return run, port

    def test_killed(self):
        for number in (signal.SIGKILL, signal.SIGABRT):
            run, _ = self.follow()
            self.some_time()
            os.kill(beside(run, "igtl"), number)
            report, error = self.same_run(run)
            self.assertIn(f"OpenIGTLink ended: signal {number.value} ", error)
            self.assertEqual(report["counters"]["lost_processes"], 1)
            self.assertEqual(run.process.returncode, 3)

    def test_killed_in_real_time(self):
        run, _ = self.follow(duration_s=5, clock="--allow-non-rt")
        wait_until(lambda: loop_runs(run.process.pid))
        time.sleep(self.random.uniform(0, 0.5))
        os.kill(beside(run, "igtl"), signal.SIGKILL)
        out, error = run.process.communicate(timeout=60)
        report = json.loads(out)
        self.assertEqual(report["timing"]["ticks"], 5000)
        self.assertEqual(report["counters"]["lost_processes"], 1)
        self.assertEqual(error.count("OpenIGTLink ended"), 1)

    def test_stopped(self):
        run, _ = self.follow()
        self.some_time()
        os.kill(beside(run, "igtl"), signal.SIGSTOP)
        self.same_run(run)
        self.assertEqual(run.process.returncode, 0)

    def test_starved(self):
        run, port = self.follow()
        limit = 1 << 20
        resource.prlimit(beside(run, "igtl"), resource.RLIMIT_AS, (limit, limit))
        for _ in range(5):
            client = socket.create_connection(("127.0.0.1", port), timeout=20)
            self.addCleanup(client.close)
        report, error = self.same_run(run)
        lost = report["counters"]["lost_processes"]
        self.assertEqual("OpenIGTLink ended" in error, lost == 1)
        self.assertEqual(run.process.returncode, 3 * lost)

    def test_outside_signals_are_not_for_it(self):
        run, _ = self.follow()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT,
                       signal.SIGPIPE):
            os.kill(beside(run, "igtl"), number)
        self.same_run(run)
        self.assertEqual(run.process.returncode, 0)

    def test_it_ends_with_the_run(self):
        run, _ = self.follow()
        child = beside(run, "igtl")
        run.end(signal.SIGKILL)
        wait_until(lambda: has_ended(child), 1)


class Recorder(Disturbed):
    """If the recorder ends in any way, or hangs, what it wrote stays and the user is told."""

    def record(self, name, **how):
        recording = self.top / name
        run = self.start("--record", recording, **how)
        wait_until(lambda: loop_runs(run.process.pid))
        return run, recording

    def what_is_left(self, recording, report, error):
        """The file is a recording, with the ticks that the user was told of.

        It may have one block of half a second more, if the end fell between the moment when a block
        was on the disk and the moment when that was known.
        """
        self.assertFalse(recording.exists())
        left, = self.top.glob(f"{recording.name}.*.tmp")
        told = re.search(r"ends at tick (\d+) and stays as (\S+)", error)
        self.assertEqual(pathlib.Path(told[2]), left)
        with h5py.File(left, "r", swmr=True) as file:
            rows = len(file["output/tick"])
        kept = int(told[1])
        self.assertIn(rows, (kept, kept + 500))
        self.assertEqual(report["counters"]["lost_processes"], 1)
        self.assertEqual(report["counters"]["lost_records"], report["timing"]["ticks"] - kept)
        return left

    def test_killed(self):
        for number in (signal.SIGKILL, signal.SIGABRT):
            run, recording = self.record(f"ended{number.value}.h5")
            self.some_time()
            os.kill(beside(run, "recorder"), number)
            report, error = self.same_run(run)
            self.assertIn(f"the recorder ended: signal {number.value} ", error)
            self.assertEqual(run.process.returncode, 3)
            self.what_is_left(recording, report, error)

    def test_stopped(self):
        run, recording = self.record("stopped.h5")
        self.some_time()
        os.kill(beside(run, "recorder"), signal.SIGSTOP)
        report, error = self.same_run(run)
        self.assertIn("the recorder ended: signal 9 ", error)
        self.assertEqual(run.process.returncode, 3)
        self.what_is_left(recording, report, error)

    def test_starved(self):
        run, recording = self.record("starved.h5")
        self.some_time()
        limit = 1 << 20
        resource.prlimit(beside(run, "recorder"), resource.RLIMIT_AS, (limit, limit))
        report, error = self.same_run(run)
        if recording.exists():  # it already had the memory it needed
            self.assertEqual((run.process.returncode, error.count("recorder")), (0, 0))
            return
        self.assertIn(run.process.returncode, (1, 3))
        self.assertRegex(error, "out of memory|cannot be written|cannot be completed|exit code")

    def test_a_fast_run_does_not_wait_for_a_dead_recorder(self):
        """Nor for one that hangs, although no room is left for the records that it should take."""
        for number in (signal.SIGKILL, signal.SIGSTOP):
            run, _ = self.record(f"hurried{number.value}.h5", duration_s=40)
            os.kill(beside(run, "recorder"), number)
            out, error = run.process.communicate(timeout=300)
            self.assertEqual(json.loads(out)["timing"]["ticks"], 40000)
            self.assertEqual(error.count("the recorder ended"), 1)
            self.assertEqual(run.process.returncode, 3)

    def test_nothing_is_lost_when_the_loop_is_killed(self):
        run, recording = self.record("alone.h5", duration_s=20, clock="--allow-non-rt")
        time.sleep(self.random.uniform(0.2, 2))
        child = beside(run, "recorder")
        killed_ns = time.monotonic_ns()
        run.end(signal.SIGKILL)
        wait_until(lambda: has_ended(child), 5)
        left, = self.top.glob("alone.h5.*.tmp")
        with h5py.File(left, "r") as file:
            last_ns = int(file["device/t_ns"][-1])
        # Less than a block is lost, which waits for half a second; the loop itself may have been
        # held up.
        self.assertLess(1e-9 * (killed_ns - last_ns), 0.4)

    def test_outside_signals_are_not_for_it(self):
        run, recording = self.record("deaf.h5")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT,
                       signal.SIGPIPE):
            os.kill(beside(run, "recorder"), number)
        self.same_run(run)
        self.assertEqual(run.process.returncode, 0)
        self.assertIn("same bits", call("stylet", "replay", recording).stdout)


def of_session(session):
    """Processes of the run that have not ended."""
    for each in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (each / "stat").read_text().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):
            continue
        if int(words[3]) == session and words[0] not in "ZX":
            yield int(each.name)


class Signals(Disturbed):
    """After a signal from outside all processes end, and a recording is whole or does not exist.

    The signal comes before the program has begun, or while it reads, starts its processes, runs or
    ends.
    """

    SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGPIPE]
    DURATION_S = 5

    def test_at_any_time(self):
        for number in range(30):
            sent = self.random.choice(self.SIGNALS)
            with self.subTest(number=number, signal=sent.name):
                self.signal_once(self.top / f"signal{number}.h5", sent)

    def signal_once(self, recording, sent):
        process = subprocess.Popen(
            [str(part) for part in (BIN / "stylet", "run", SCENE, "--organ", self.organ, "--fast",
                                    "--duration-s", self.DURATION_S, "--record", recording,
                                    "--igtl=0")],
            cwd=self.top, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            start_new_session=True)
        self.addCleanup(process.kill)
        early = self.random.random() < 0.4
        time.sleep(self.random.uniform(0, 0.2 if early else 1.1 * self.wall_s))
        process.send_signal(sent)
        _, error = process.communicate(timeout=60)
        # Ended by the signal itself, before the program could handle it.
        self.assertIn(process.returncode, (0, 3, -sent), error)
        wait_until(lambda: not list(of_session(process.pid)), 5)
        self.assertEqual(list(self.top.glob(f"{recording.name}.*")), [])
        if process.returncode >= 0 and "no tick was run: there is no recording" not in error:
            with h5py.File(recording, "r") as file:
                self.assertEqual(int(file.attrs["ticks"]), len(file["output/tick"]))
                self.assertGreater(int(file.attrs["ticks"]), 0)
        else:
            self.assertFalse(recording.exists())


class Starved(Disturbed):
    """If an allocation fails in a thread, no exception leaves it."""

    THREADS = {"stylet-loop": [], "stylet-helper": ["--threads", "2"],
               "stylet-recorder": ["--record", "starved.h5"], "stylet-igtl": ["--igtl=0"]}

    def test_every_thread(self):
        for name, arguments in self.THREADS.items():
            for after in (0, self.random.randrange(1, 40)):
                with self.subTest(thread=name, after=after):
                    self.starve(name, after, arguments)

    def starve(self, name, after, arguments):
        if name == "stylet-igtl" and "built without" in call(
                "stylet", "run", SCENE, "--organ", self.organ, "--fast", "--igtl=0", "--duration-s",
                "0.01", "--allow-non-rt").stderr:
            return
        env = dict(os.environ, LD_PRELOAD=os.environ["STYLET_STARVE"], STYLET_STARVE_THREAD=name,
                   STYLET_STARVE_AFTER=str(after))
        done = subprocess.run(
            [BIN / "stylet", "run", SCENE, "--organ", self.organ, "--allow-non-rt", "--force",
             "--duration-s", "0.5", "--flight", self.top / "flight.h5", "--fast", *arguments],
            cwd=self.top, env=env, capture_output=True, text=True, timeout=120)
        # A signal ended it, so terminate() was called.
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        self.assertNotIn("terminate called", done.stderr)
        self.assertNotIn("Aborted", done.stderr)


if __name__ == "__main__":
    unittest.main()
