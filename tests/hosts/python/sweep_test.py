#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Sweeps: every row runs once and is in one table, wherever it ran; killed and resumed.

Expected values: closed forms of the rows' own parameters; insertions that are run here one by one.
"""
import functools
import os
import pathlib
import shlex
import signal
import subprocess
import sys
import textwrap
import time
import unittest

import h5py
import numpy as np
import stylet
from support import folder, insertion, organ_file, simulation


def squared(x, name):
    return {"square": x * x, "label": name.upper(), "pair": np.array([x, -x])}


def half_of_odd(i):
    if i == 3:
        raise ValueError("three")
    return {"half": i / 2 if i % 2 else i // 2}


def counted(i, folder):
    """Leaves a mark each time that it runs."""
    with open(os.path.join(folder, f"{i}"), "a") as file:
        file.write("x")
    return {"twice": 2 * i}


def deadly(i):
    """Row 3 ends its worker every time."""
    if i == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"twice": 2 * i}


def interrupted(i):
    if i == 2:
        raise KeyboardInterrupt
    return {"y": i}


class Silent(Exception):
    def __str__(self):
        raise RuntimeError


def odd(i):
    if i == 6:
        sys.exit(3)
    if i == 7:
        raise Silent
    if i == 8:
        return {"error": "mine"}
    if i == 9:
        raise ValueError("a\0b\udc80")
    if i == 10:
        return {"i": 1}
    return {"y": {2: [1, 2, 3], 3: None, 4: "text", 5: object()}.get(i, [i, i])}


def hash_of(digits):
    return {"hash": int(digits, 16)}


def insertion_of(deepest_m, path):
    import stylet as own
    from support import FAST
    run = own.Simulation(own.Organ.read(path), config=own.Config(**FAST))
    outputs = run.run(insertion(300, deepest_m=deepest_m))
    return {"peak_n": float(outputs["force_n"][:, 2].max()), "hash": run.hash()}


def named(module, qualname, function):
    """Takes the place of another function that has changed since a table was written."""
    function.__module__, function.__qualname__ = module, qualname
    return function


def slow(i, folder):
    """Waits until the file `go` is there."""
    while not os.path.exists(os.path.join(folder, "go")):
        time.sleep(0.01)
    return {"twice": 2 * i}


PARAMETERS = {"x": [1.5, -2.0, 3.0], "name": ["a", "b", "c"]}


class Sweep(unittest.TestCase):
    def path(self):
        return str(folder() / f"{self.id()}.h5")

    def test_columns(self):
        rows = [{"x": x, "name": name} for x, name in zip(*PARAMETERS.values())]
        for parameters, workers in ((PARAMETERS, 0), (rows, 0), (PARAMETERS, 2)):
            table = stylet.sweep(squared, parameters, workers)
            self.assertEqual(list(table), ["x", "name", "square", "label", "pair", "error"])
            np.testing.assert_array_equal(table["square"], [2.25, 4, 9])
            np.testing.assert_array_equal(table["pair"], [[1.5, -1.5], [-2, 2], [3, -3]])
            self.assertEqual(list(table["label"]), ["A", "B", "C"])
            self.assertEqual(list(table["error"]), ["", "", ""])

    def test_insertions_have_the_bits_of_single_runs(self):
        depths = [0.005, 0.01, 0.02]
        parameters = {"deepest_m": depths, "path": [str(organ_file())] * 3}
        table = stylet.sweep(insertion_of, parameters, 2)
        for depth, state in zip(depths, table["hash"]):
            run = simulation()
            run.run(insertion(300, deepest_m=depth))
            self.assertEqual(int(state), run.hash())

    def test_failure_is_kept_and_run_again(self):
        table = stylet.sweep(half_of_odd, {"i": range(5)}, 0, path=self.path())
        self.assertEqual(table["error"][3], "ValueError: three")
        np.testing.assert_array_equal(table["half"], [0, 0.5, 1, np.nan, 2])
        repaired = functools.wraps(half_of_odd)(lambda i: {"half": -1.0})
        again = stylet.sweep(repaired, {"i": range(5)}, 0, path=self.path())
        np.testing.assert_array_equal(again["half"], [0, 0.5, 1, -1, 2])
        self.assertEqual(set(again["error"]), {""})

    def test_progress_is_reported(self):
        """Rows that were there before count, too; if the callback raises, finished rows stay."""
        path, told = folder() / "progress.h5", []
        rows = {"i": list(range(8))}

        def stop(done, of):
            told.append((done, of))
            if done == 3:
                raise InterruptedError
        with self.assertRaises(InterruptedError):
            stylet.sweep(half_of_odd, rows, 0, path=path, progress=stop)
        self.assertEqual(told, [(0, 8), (1, 8), (2, 8), (3, 8)])
        told.clear()
        stylet.sweep(half_of_odd, rows, 2, path=path, progress=lambda *both: told.append(both))
        self.assertEqual(told, [(done, 8) for done in range(3, 9)])  # row 3 was still missing
        told.clear()
        stylet.sweep(half_of_odd, rows, 0, path=path, progress=lambda *both: told.append(both))
        self.assertEqual(told, [(7, 8), (8, 8)])  # it fails again

    def test_file_has_the_table(self):
        stylet.sweep(squared, PARAMETERS, 0, path=self.path())
        with h5py.File(self.path()) as file:
            np.testing.assert_array_equal(file["parameters/x"], PARAMETERS["x"])
            np.testing.assert_array_equal(file["results/square"], [2.25, 4, 9])
        calls = []
        same = functools.wraps(squared)(lambda **row: calls.append(row))
        kept = stylet.sweep(same, PARAMETERS, 0, path=self.path())
        self.assertEqual(calls, [])
        self.assertEqual(list(kept["label"]), ["A", "B", "C"])
        with self.assertRaisesRegex(ValueError, "other parameters"):
            stylet.sweep(squared, {**PARAMETERS, "x": [1, 2, 3]}, 0, path=self.path())

    def test_killed_worker_and_resumed(self):
        marks = folder() / "marks"
        marks.mkdir()
        script = folder() / "killed.py"
        script.write_text(textwrap.dedent(f"""
            import os, signal, sys
            import stylet
            def function(i):
                if i in (11, 30):
                    os.kill(os.getpid(), signal.SIGKILL)
                open({str(marks)!r} + f"/{{i}}", "a").write("x")
                return {{"twice": 2 * i}}
            if __name__ == "__main__":
                stylet.sweep(function, {{"i": range(40)}}, 1, path={self.path()!r})
            """))
        ended = subprocess.run([sys.executable, script], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        columns, _ = stylet.read_table(self.path())
        deadly_ones = {11, 30}
        for i, error in enumerate(columns["error"]):  # each ends only its own row
            self.assertEqual(error, "its process ended" if i in deadly_ones else "")
        done = [i not in deadly_ones for i in range(40)]
        resumed = named("killed", "function", lambda i: counted(i, marks))
        table = stylet.sweep(resumed, {"i": range(40)}, 0, path=self.path())
        np.testing.assert_array_equal(table["twice"], 2 * np.arange(40))
        for i in np.flatnonzero(done):
            self.assertEqual((marks / f"{i}").read_text(), "x")

    def test_processes_end_with_a_parent_that_is_killed(self):
        script = folder() / "parent.py"
        script.write_text(textwrap.dedent("""
            import os, time
            import stylet
            def function(i):
                os.write(1, f"{os.getpid()}\\n".encode())  # in one piece
                time.sleep(60)
            if __name__ == "__main__":
                stylet.sweep(function, {"i": range(2)}, 2)
            """))
        parent = subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True)
        self.addCleanup(parent.kill)
        workers = [int(parent.stdout.readline()) for _ in range(2)]
        parent.kill()
        begin = time.monotonic()
        parent.communicate()  # until no process holds its output
        self.assertLess(time.monotonic() - begin, 30)
        self.assertEqual(len(set(workers)), 2)

    def test_rows_that_were_not_run_are_marked(self):
        path = self.path()
        with self.assertRaises(KeyboardInterrupt):
            stylet.sweep(interrupted, {"i": range(5)}, 0, path=path)
        self.assertEqual(list(stylet.read_table(path)[0]["error"]), ["", ""] + 3 * ["not run yet"])

    def test_a_function_that_cannot_be_imported_is_refused_at_once(self):
        with self.assertRaisesRegex(TypeError, "another process can import"):
            stylet.sweep(lambda i: {"y": i}, {"i": [0, 1, 2]}, 2)

    def test_an_odd_row_fails_alone(self):
        path = self.path()
        table = stylet.sweep(odd, {"i": range(12)}, 2, path=path)
        good = [0, 1, 11]
        self.assertEqual([i for i in range(12) if table["error"][i] == ""], good)
        np.testing.assert_array_equal(table["y"][good], [[0, 0], [1, 1], [11, 11]])
        self.assertIn("result y", table["error"][2])
        self.assertEqual(table["error"][9], "ValueError: a\\0b\\udc80")
        np.testing.assert_array_equal(stylet.read_table(path)[0]["error"], table["error"])

    def test_whole_numbers_keep_every_bit(self):
        hashes = [5, 0x5f3bc61de0f59c9b, 0xdf3bc61de0f59c9b, 2 ** 64 - 1]
        for order in (hashes, hashes[::-1]):
            table = stylet.sweep(hash_of, {"digits": [hex(each) for each in order]}, 0)
            self.assertEqual([int(each) for each in table["hash"]], order)
        table = stylet.sweep(hash_of, {"digits": ["-0x1", hex(2 ** 63)]}, 0)
        self.assertIn("below 0 and from 2^63", table["error"][1])

    def refuses(self, text, function=half_of_odd, **named_ones):
        with self.assertRaisesRegex(ValueError, text):
            stylet.sweep(function, {"i": range(5)}, 0, path=self.path(), **named_ones)

    def test_table_of_another_function_is_refused(self):
        stylet.sweep(half_of_odd, {"i": range(5)}, 0, path=self.path())
        self.refuses("function is .*half_of_odd, and here .*interrupted: expected the same",
                     interrupted)
        self.refuses("function is .*half_of_odd, and here .*deadly", functools.partial(deadly))
        # It has the same name but is another function: it gives no column of the table.
        self.refuses("has the results half, and the function gives other: expected the function",
                     functools.wraps(half_of_odd)(lambda i: {"other": i}))
        table = stylet.read_table(self.path())[0]
        np.testing.assert_array_equal(table["half"], [0, 0.5, 1, np.nan, 2])
        self.refuses("attributes: function: sweep writes it itself", attributes={"function": "f"})

    def test_table_without_a_function_says_how_to_go_on(self):
        """Earlier versions wrote tables without the function: such a table is refused, and resumed
        with the command that the refusal gives."""
        first = stylet.sweep(half_of_odd, {"i": range(5)}, 0, path=self.path())
        with h5py.File(self.path(), "r+") as file:
            del file.attrs["function"]
        before = pathlib.Path(self.path()).read_bytes()
        with self.assertRaisesRegex(ValueError, "expected another path; or, if it was .*half_of_odd"
                                    ) as refused:
            stylet.sweep(half_of_odd, {"i": range(5)}, 0, path=self.path())
        self.assertEqual(pathlib.Path(self.path()).read_bytes(), before)
        command = str(refused.exception).rpartition("in the file: ")[2]
        self.assertEqual(shlex.split(command)[:2], ["python3", "-c"])
        subprocess.run([sys.executable, *shlex.split(command)[1:]], check=True)
        ran = []
        again = functools.wraps(half_of_odd)(lambda i: ran.append(i) or half_of_odd(i))
        table = stylet.sweep(again, {"i": range(5)}, 0, path=self.path())
        np.testing.assert_array_equal(table["half"], first["half"])
        self.assertEqual(ran, [3])  # the row that failed before

    def test_a_script_and_its_module_are_one_function(self):
        script = folder() / "campaign_of_one.py"
        script.write_text(textwrap.dedent(f"""
            import stylet
            def one(i):
                return {{"i_again": i}}
            if __name__ == "__main__":
                stylet.sweep(one, {{"i": [1, 2]}}, 0, path={self.path()!r})
            """))
        subprocess.run([sys.executable, script], check=True)
        again = named("campaign_of_one", "one", lambda i: {})
        table = stylet.sweep(again, {"i": [1, 2]}, 0, path=self.path())
        np.testing.assert_array_equal(table["i_again"], [1, 2])

    def test_table_that_somebody_changed_is_refused(self):
        for change, text in (
                (lambda file: file.__delitem__("results/half"), "column half is missing"),
                (lambda file: file.__delitem__("parameters/i"), "column i is missing"),
                (lambda file: file.__setitem__("results/mine", np.zeros(5)),
                 "column mine is not of this table"),
                (lambda file: (file.__delitem__("results/half"),
                               file.__setitem__("results/half", np.zeros(4))),
                 "column half: expected 5 rows of numbers or texts"),
                (lambda file: (file.__delitem__("results/half"), file.create_group("results/half")),
                 "column half: expected 5 rows"),
                (lambda file: file.__delitem__("rows/done"), "not a table of sweep"),
                (lambda file: file.attrs.__delitem__("columns"), "not a table of sweep")):
            stylet.sweep(half_of_odd, {"i": range(5)}, 0, path=self.path())
            with h5py.File(self.path(), "r+") as file:
                change(file)
            before = pathlib.Path(self.path()).read_bytes()
            self.refuses(text)
            self.assertEqual(pathlib.Path(self.path()).read_bytes(), before)
            os.unlink(self.path())

    def test_only_one_writes_a_table(self):
        rows, path = {"i": range(3), "folder": [str(folder())] * 3}, self.path()
        script = folder() / "first.py"
        script.write_text(textwrap.dedent(f"""
            import sys
            sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
            import stylet, sweep_test
            if __name__ == "__main__":
                print("begins", flush=True)
                stylet.sweep(sweep_test.slow, {rows!r}, int(sys.argv[1]), path={path!r})
            """))
        here = named("sweep_test", "slow", slow)
        for workers, killed in ((0, False), (2, True), (0, False)):
            (folder() / "go").unlink(missing_ok=True)
            first = subprocess.Popen([sys.executable, script, str(workers)], text=True,
                                     stdout=subprocess.PIPE)
            self.addCleanup(first.kill)
            first.stdout.readline()
            while not os.path.exists(path + ".lock"):
                time.sleep(0.01)
            time.sleep(0.5)  # a lock that exists may be the earlier process's
            with self.assertRaisesRegex(RuntimeError, "another sweep is writing it"):
                stylet.sweep(here, rows, 0, path=path)
            if killed:
                first.kill()  # its lock ends with it, and so do its workers' locks
            (folder() / "go").touch()
            first.communicate()
            table = stylet.sweep(here, rows, 0, path=path)
            np.testing.assert_array_equal(table["twice"], [0, 2, 4])
            self.assertEqual(os.path.exists(path + ".lock"), False)
            os.unlink(path)

    def on_dask(self, *arguments, **named):
        try:
            from dask.distributed import Client, LocalCluster
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        path = os.pathsep.join([str(pathlib.Path(__file__).parent), os.environ["PYTHONPATH"]])
        os.environ["PYTHONPATH"] = path
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                          local_directory=str(folder())) as cluster, Client(cluster) as client:
            return stylet.sweep(*arguments, client=client, **named)

    def test_cluster_of_dask(self):
        table = self.on_dask(squared, PARAMETERS)
        np.testing.assert_array_equal(table["square"], [2.25, 4, 9])

    def test_a_row_that_kills_its_workers_counts_as_failed(self):
        """Dask gives the row up after its fourth worker; rows that waited for the same workers may
        fail with it."""
        table = self.on_dask(deadly, {"i": range(12)}, path=self.path())
        self.assertIn("KilledWorker", table["error"][3])
        good = table["error"] == ""
        np.testing.assert_array_equal(table["twice"][good], 2 * np.flatnonzero(good))
        self.assertGreater(np.count_nonzero(good), 5)
        repaired = functools.wraps(deadly)(lambda i: {"twice": 2 * i})
        again = stylet.sweep(repaired, {"i": range(12)}, 0, path=self.path())
        np.testing.assert_array_equal(again["twice"], 2 * np.arange(12))


if __name__ == "__main__":
    unittest.main()
