#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A recording of `stylet run` read, drawn and replayed from Python.

Expected values: the hash that the program wrote, and its columns as h5py reads them.
"""
import subprocess
import sys
import unittest

import h5py
import numpy as np
import stylet
from support import folder, organ, organ_file, program

SCENE = """
[organ]
path = "block.organ"
[loop]
period_us = 1000
inertia = "added_mass"
substeps = 1
hash_every_ticks = 100
[breathing]
amplitude_mm = [0.5, 0, 0]
period_s = 2
{needle}
[[obstacles]]
shape = "box"
size_mm = [10, 10, 4]
at_mm = [30, 0, 2]
turn_deg = [0, 10, 20]
"""
NEEDLE = """
[{table}]
gauge = "18G"
flexible = {flexible}
[{table}.approach]
direction = [0.1, 0, -1]
start_mm = 2
[{table}.device]
kind = "simulated"
[[{table}.hand.waypoint]]
travel_mm = 25
speed_mm_s = 20
[[{table}.hand.waypoint]]
travel_mm = -2
speed_mm_s = 50
"""
# With a single needle the other tables are at the top level.
ONE = NEEDLE.format(table="needle", flexible="true").replace("needle.", "")
TWO = "".join(NEEDLE.format(table="needles", flexible=flexible).replace("[needles]", "[[needles]]")
              for flexible in ("true", "false"))


def recorded(name, needles):
    scene, out = folder() / f"{name}.toml", folder() / f"{name}.h5"
    if not out.exists():
        organ_file()
        scene.write_text(SCENE.format(needle=needles))
        subprocess.run([program("stylet"), "run", scene, "--fast", "--record", out], check=True,
                       capture_output=True)
    return out


class Recording(unittest.TestCase):
    def test_replay_has_the_same_state_and_outputs(self):
        for name, needles, count in (("one", ONE, 1), ("two", TWO, 2)):
            with self.subTest(name):
                recording = stylet.Recording(recorded(name, needles))
                self.assertEqual((len(recording.needles), len(recording.obstacles)), (count, 1))
                self.assertEqual(recording.config.inertia, 0)
                run = recording.replay(organ())
                self.assertEqual(run.hash(), recording.final_state_hash)
                self.assertEqual(run.stats().ticks, recording.ticks)
                again = stylet.Simulation(organ(), recording.needles, recording.config,
                                          recording.obstacles).run(recording.inputs())
                for needle in range(count):
                    for field in stylet.output_dtype.names:
                        np.testing.assert_array_equal(again[field][:, needle],
                                                      recording.outputs(needle)[field], field)

    def test_columns_events_and_texts(self):
        path = recorded("one", ONE)
        recording = stylet.Recording(path)
        with h5py.File(path) as file:
            np.testing.assert_array_equal(recording["output/force_n"], file["output/force_n"])
            np.testing.assert_array_equal(recording.events["tick"], file["events/tick"])
            self.assertEqual(recording.organ_hash, organ().info.hash)
            axial = -file["output/force_n"][:] @ file["needles/direction"][0]
            np.testing.assert_allclose(recording.force_n(), axial)
        self.assertGreater(recording.force_n().max(), 0)
        self.assertIn(stylet.Event.PUNCTURE, recording.events["kind"])
        self.assertIn("flexible = true", recording.scene_text)
        self.assertAlmostEqual(recording.time_s[-1], recording.ticks * recording.period_s)
        with self.assertRaises(IndexError):
            recording.column("output/force_n", 1)

    def test_view_draws_a_picture(self):
        picture = folder() / "view.png"
        subprocess.run([sys.executable, "-m", "stylet.view", recorded("one", ONE), "-o", picture],
                       check=True)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        wrong = subprocess.run([sys.executable, "-m", "stylet.view", folder() / "none.h5"],
                               capture_output=True, text=True)
        self.assertEqual((wrong.returncode, wrong.stdout), (1, ""))
        self.assertNotIn("Traceback", wrong.stderr)

    def test_rows_that_are_claimed_but_not_stored_are_refused(self):
        """A small file cannot make the reader allocate the rows, texts and chunks that it merely
        claims."""
        draw = np.random.default_rng(4)
        whole = recorded("two", TWO)
        changed = folder() / "claimed.h5"

        def tick_columns(file):
            return [column for place in ("", "needle1/")
                    for group in ("input", "output", "device", "guard", "loop")
                    for column in file[place + group].values()]

        def grow_all(file):
            rows = int(draw.integers(10**7, 10**10))
            for column in tick_columns(file):
                column.resize(rows, axis=0)
            file.attrs["ticks"] = np.uint64(rows)
            return f"{rows} rows, of which the file holds"

        def grow_one(file):
            columns = tick_columns(file)
            column = columns[draw.integers(len(columns))]
            column.resize(len(column) + 1, axis=0)
            return f"claimed.h5: {column.name[1:]}: "

        def grow_events(file):
            for column in file["events"].values():
                column.resize(10**9, axis=0)
            return "events/.*: 1000000000 rows, of which the file holds 64"

        def many_ticks(file):
            file.attrs["ticks"] = np.uint64(2**63)
            return f"rows: expected {2**63}"

        def long_text(file):
            del file["scene_text"]
            file.create_dataset("scene_text", (), dtype="S2000000000")
            return "scene_text: text of another type"

        def large_chunk(file):
            del file["output/force_n"]
            file.create_dataset("output/force_n", (file.attrs["ticks"], 3), maxshape=(None, 3),
                                dtype="f4", chunks=(200_000, 3), compression="gzip")[0] = 1
            return "output/force_n: chunks of 200000 x 3 numbers"

        for change in 3 * [grow_all, grow_one] + [grow_events, many_ticks, long_text, large_chunk]:
            with self.subTest(change.__name__):
                changed.write_bytes(whole.read_bytes())
                with h5py.File(changed, "r+") as file:
                    words = change(file)
                self.assertLess(changed.stat().st_size, 2 * whole.stat().st_size)
                with self.assertRaisesRegex(ValueError, words):
                    stylet.Recording(changed)
        changed.write_bytes(whole.read_bytes())
        with h5py.File(changed, "r+") as file:
            grow_all(file)
            file.attrs["ticks"] = np.uint64(0)  # as after a run that was killed
            chunks = file["output/force_n"].id.get_num_chunks() * file["output/force_n"].chunks[0]
        self.assertEqual(stylet.Recording(changed).ticks, chunks)

    def test_refusals(self):
        changed = folder() / "changed.h5"
        changed.write_bytes(recorded("one", ONE).read_bytes())
        for attribute, value, words in (("final_state_hash", 1, "state "),
                                        ("lost_records", 3, "incomplete"),
                                        ("organ_hash", 5, "organ 0000000000000005"),
                                        ("format_version", 3, "expected stylet-recording 6")):
            with h5py.File(changed, "r+") as file:
                before = file.attrs[attribute]
                file.attrs[attribute] = np.array(value, before.dtype)
            with self.assertRaisesRegex(ValueError, words):
                stylet.Recording(changed).replay(organ())
            with h5py.File(changed, "r+") as file:
                file.attrs[attribute] = before
        stylet.Recording(changed).replay(organ())


if __name__ == "__main__":
    unittest.main()
