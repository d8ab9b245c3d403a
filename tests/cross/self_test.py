#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the replay matrix itself: it names the tick and field that differ, and its image has no
heap.

usage: self_test.py REPOSITORY BUILD_FOLDER
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
import replay_test  # noqa: E402
import target  # noqa: E402
import virtual_time  # noqa: E402

REPOSITORY, TESTS_BUILD, _ = target.arguments()
HEADER_BYTES = 48  # of a snapshot, the last eight of them the sum of its state
WRONG_TICK = 333


def here(*words):
    program = TESTS_BUILD.parents[1] / "bin/stylet_replay"
    return target.call([program, "elastic", *words]).splitlines()


def sum_of(text):
    """The checksum of a state (kernel/src/state/snapshot.cpp): 16 digits, as in a snapshot."""
    total = 0xcbf29ce484222325
    for at in range(0, len(text), 16):
        word = int(text[at + 8:at + 16] + text[at:at + 8], 16)  # the lower half comes first
        total = (total ^ word) * 0x100000001b3 % 2**64
        total ^= total >> 29
    return f"{total % 2**32:08x}{total >> 32:08x}"


def one_bit_wrong(lines):
    """The snapshot with the lowest bit of the state's first number, the tick, flipped, and with the
    sum of these bytes: as a target that computes differently would write it."""
    text = "".join(lines)
    header, state = text[:2 * HEADER_BYTES - 16], text[2 * HEADER_BYTES:]
    state = state[:7] + format(int(state[7], 16) ^ 1, "x") + state[8:]
    return [header + sum_of(state) + state]


class Difference(unittest.TestCase):
    def test_names_the_tick_and_the_field(self):
        def there(*words):
            lines = here(*words)
            if words[0] == "state":
                return one_bit_wrong(lines) if int(words[1]) >= WRONG_TICK else lines
            return [line + "x" if line.startswith("hash") and int(line.split()[1]) >= WRONG_TICK
                    else line for line in lines]
        said = replay_test.first_difference(here, there, "sample", "elastic", TESTS_BUILD)
        self.assertIn(f"after tick {WRONG_TICK}, in head[0]\n", said)

    def test_knows_the_sum_of_a_state(self):
        text = "".join(here("state", WRONG_TICK))
        self.assertEqual(sum_of(text[2 * HEADER_BYTES:]),
                         text[2 * HEADER_BYTES - 16:2 * HEADER_BYTES])

    def test_other_events_are_a_difference(self):
        said = replay_test.first_difference(here, lambda *words: here(*words)[:-1], "sample",
                                            "elastic", TESTS_BUILD)
        self.assertIn("other events", said)


class VirtualTime(unittest.TestCase):
    def test_tolerates_one_percent(self):
        committed = {"a": 1000, "b": 1000, "c": 1000}
        found = {"a": (1009, 0), "b": (1011, 0), "c": (989, 0)}
        said = list(virtual_time.faults(committed, found))
        self.assertEqual([line[0] for line in said], ["b", "c"])

    def test_an_update_measures_insertions_recorded_by_this_source(self):
        done = []

        def step(name, result=None):
            return lambda *_: (done.append(name), result)[1]

        with tempfile.TemporaryDirectory() as folder, \
                mock.patch.object(target, "skip_without", step("look")), \
                mock.patch.object(virtual_time, "record_cases", step("record")), \
                mock.patch.object(target, "build", step("build")), \
                mock.patch.object(virtual_time, "measure", step("measure", {"one": (7, 5)})):
            repository = pathlib.Path(folder)
            (repository / "tests/cross").mkdir(parents=True)
            virtual_time.main(repository, TESTS_BUILD, ["--update"])
            self.assertEqual(done, ["look", "record", "build", "measure"])
            found = virtual_time.read_numbers(repository / "tests/cross/virtual_time.txt")
            self.assertEqual(found, {"one": 7})

    def test_a_missing_case_is_a_failure(self):
        self.assertEqual(len(list(virtual_time.faults({}, {"a": (1, 0)}))), 1)


@unittest.skipUnless(shutil.which("arm-none-eabi-g++"), "no arm-none-eabi-g++ here")
class Image(unittest.TestCase):
    def link(self, body):
        with tempfile.TemporaryDirectory() as folder:
            source = f"{folder}/a.cpp"
            with open(source, "w", encoding="ascii") as file:
                file.write(f'#include <cstdlib>\nextern "C" void reset_handler() {{ {body} }}\n')
            script = REPOSITORY / "tests/cross/target/mps2.ld"
            return subprocess.run(["arm-none-eabi-g++", "-mcpu=cortex-m7", "-mthumb", source,
                                   "-nostartfiles", "-T", script, "-o", f"{folder}/a"],
                                  capture_output=True, text=True)

    def test_links_without_a_heap(self):
        done = self.link("")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_does_not_link_with_a_heap(self):
        done = self.link("*static_cast<int volatile*>(std::malloc(4)) = 1;")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("_sbrk", done.stderr)

    def test_does_not_link_with_a_static_constructor(self):
        done = self.link("} extern int f(); int f() { return 1; } "
                         "static int volatile a = f(); extern \"C\" void g() {")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("static constructor", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
