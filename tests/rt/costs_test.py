#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the judge of costs: it notices a tick that is more or less expensive than committed, or
beyond its bound; and the committed costs agree with each other."""
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
import costs  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROW = (7, 1000, 900, 1100)  # tick, worst, median, bound
EVEN = list(range(0, 20, 2))


def with_costs(**changed):
    found = {tick: (900, True, 1100) for tick in range(20)} | {7: (1000, True, 1100)}
    return found | {int(name[1:]): (cost, True, 1100) for name, cost in changed.items()}


def faults(found):
    return list(costs.faults(ROW, found, EVEN))


class Costs(unittest.TestCase):
    def test_accepts_the_committed_and_one_percent(self):
        self.assertEqual(faults(with_costs()), [])
        self.assertEqual(faults(with_costs(t7=1009, t3=1010)), [])

    def test_refuses_a_dearer_tick_anywhere(self):
        self.assertIn("tick 3 takes 1011", faults(with_costs(t3=1011))[0])

    def test_refuses_a_number_that_is_too_large(self):
        self.assertIn("less than", faults(with_costs(t7=989))[0])

    def test_refuses_a_tick_beyond_its_bound(self):
        self.assertIn("tick 3 takes 901 instructions, more than its bound 900",
                      faults(with_costs() | {3: (901, True, 900)})[0])

    def test_refuses_another_median(self):
        dearer = {tick: (950, True, 1100) for tick in EVEN}
        self.assertIn("median of the inserted phase is 950", faults(with_costs() | dearer)[0])

    def test_windows_join_neighbours_and_stay_inside(self):
        self.assertEqual(costs.windows_of([5, 3, 4, 4, 9, -1, 12], 10), ["3:6", "9:10"])

    def test_reads_dumps(self):
        dump = ("desc: Trigger: Client Request: 12 inserted 400\n\nfn=(1)\n0 5\ntotals: 345\n\n"
                "desc: Trigger: Client Request: 13 other 9\n\ntotals: 7\n")
        self.assertEqual(costs.DUMP.findall(dump),
                         [("12", "inserted", "400", "345"), ("13", "other", "9", "7")])

    def test_worst_and_median(self):
        found = {0: (5, False, 9), 1: (10, True, 9), 2: (12, True, 9), 3: (30, True, 31)}
        self.assertEqual(costs.summary(found, [0, 1, 3]), (3, 30, 20, 31))

    def test_spread_says_what_became_of_the_bar(self):
        self.assertEqual(costs.spread((1, 1150, 1000, 0)), "1.150, held")
        self.assertEqual(costs.spread((1, 1151, 1000, 0)), "1.151, missed")


class Committed(unittest.TestCase):
    rows = costs.read_rows(HERE / "costs.txt")

    def test_every_scene_has_a_row(self):
        scenes = {path.stem for path in (HERE / "../../hal/scenes").glob("*.toml")
                  if "# organ: " in path.read_text()}
        self.assertEqual(set(self.rows), scenes | {costs.WORST})

    def test_the_table_is_that_of_the_rows(self):
        readme = (HERE / "README.md").read_text()
        self.assertEqual(readme, costs.with_table(readme, self.rows))

    def test_no_scene_is_dearer_than_the_worst_case(self):
        most = self.rows[costs.WORST][1]
        for scene, row in self.rows.items():
            self.assertLessEqual(row[1], row[3], scene)
            if scene != costs.WORST:
                self.assertLessEqual(row[3], most, scene)

    def test_random_sessions_are_held_against_the_worst_case(self):
        text = (HERE / "tick_work.h").read_text()
        limit = int(re.search(r"kDearestTick = ([\d']+);", text)[1].replace("'", ""))
        self.assertEqual(limit, self.rows[costs.WORST][1])


if __name__ == "__main__":
    unittest.main()
