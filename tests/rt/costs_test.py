#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The judge of costs, judged: a tick that is dearer or cheaper than committed is noticed."""
import sys
import unittest

sys.dont_write_bytecode = True
import costs  # noqa: E402

ROW = (7, 1000, 900)  # tick, worst, median


def with_costs(**changed):
    found = {tick: (900, True) for tick in range(20)} | {7: (1000, True)}
    return found | {int(name[1:]): (cost, True) for name, cost in changed.items()}


class Costs(unittest.TestCase):
    def test_accepts_the_committed_and_one_percent(self):
        self.assertEqual(list(costs.faults(ROW, with_costs())), [])
        self.assertEqual(list(costs.faults(ROW, with_costs(t7=1009, t3=1010))), [])

    def test_refuses_a_dearer_tick_anywhere(self):
        self.assertIn("tick 3 takes 1011", next(costs.faults(ROW, with_costs(t3=1011))))

    def test_refuses_a_number_that_is_too_large(self):
        self.assertIn("less than", next(costs.faults(ROW, with_costs(t7=989))))

    def test_refuses_a_spread_beyond_the_bar(self):
        self.assertIn("1.160 x", next(costs.faults((7, 1044, 900), with_costs(t7=1044))))

    def test_windows_join_neighbours_and_stay_inside(self):
        self.assertEqual(costs.windows_of([5, 3, 4, 4, 9, -1, 12], 10), ["3:6", "9:10"])

    def test_reads_dumps(self):
        dump = ("desc: Trigger: Client Request: 12 inserted\n\nfn=(1)\n0 5\ntotals: 345\n\n"
                "desc: Trigger: Client Request: 13 other\n\ntotals: 7\n")
        self.assertEqual(costs.DUMP.findall(dump),
                         [("12", "inserted", "345"), ("13", "other", "7")])

    def test_worst_and_median(self):
        found = {0: (5, False), 1: (10, True), 2: (12, True), 3: (30, True)}
        self.assertEqual(costs.summary(found), (3, 30, 12))


if __name__ == "__main__":
    unittest.main()
