#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the judge of force curves: an ideal curve passes, and each kind of wrong one is named."""
import dataclasses
import unittest

import numpy as np

import force_curve

CONTACT, PUNCTURE, HOLD, RETRACTION, EXIT, END = 1000, 1800, 7000, 10000, 16000, 17000
FRICTION = 10  # N/m


def ideal():
    tick = np.arange(END)
    travel = np.where(tick < RETRACTION, np.clip((tick - CONTACT) * 1e-5, None, 0.06),
                      0.06 - (tick - RETRACTION) * 1e-5)
    depth = np.where((tick >= PUNCTURE) & (tick < EXIT), np.maximum(travel, 0), 0)
    friction = FRICTION * depth
    hold_time = (tick - HOLD) * 1e-3
    force = np.zeros(END)
    force[CONTACT:PUNCTURE] = 100 * travel[CONTACT:PUNCTURE]
    force[PUNCTURE:HOLD] = 0.3 + friction[PUNCTURE:HOLD]
    relaxed = 0.9 * (1 - 0.4 * (1 - np.exp(-hold_time)))
    force[HOLD:RETRACTION] = relaxed[HOLD:RETRACTION]
    back = (tick - RETRACTION) * 1e-5
    force[RETRACTION:EXIT] = np.maximum(force[RETRACTION - 1] - 1000 * back,
                                        -friction)[RETRACTION:EXIT]
    return force_curve.Curve(tick * 1e-3, force, travel, depth, friction, CONTACT, PUNCTURE,
                             *force_curve.resting_part(travel, PUNCTURE, EXIT), EXIT)


class Judge(unittest.TestCase):
    def changed(self, begin, end, change):
        curve = ideal()
        force = curve.force_n.copy()
        force[begin:end] = change(force[begin:end])
        return force_curve.check_physical(dataclasses.replace(curve, force_n=force))

    def expect(self, faults, *words):
        for word in words:
            self.assertTrue(any(word in fault for fault in faults), (word, faults))

    def test_ideal_passes(self):
        self.assertEqual(force_curve.check_physical(ideal()), [])

    def test_wrong_rise(self):
        self.expect(self.changed(CONTACT, PUNCTURE, lambda f: 0.3 * f),
                    "puncture force", "slope of the rise")
        self.expect(self.changed(CONTACT, PUNCTURE, lambda f: np.sqrt(0.8 * f)), "concave")
        self.expect(self.changed(1400, 1500, lambda f: 0.5 * f), "not monotone")

    def test_wrong_drop(self):
        self.expect(self.changed(PUNCTURE, PUNCTURE + 60, lambda f: f + 0.35), "falls from")
        self.expect(self.changed(PUNCTURE, PUNCTURE + 60, lambda f: f - 0.5), "reverses")

    def test_wrong_insertion(self):
        self.expect(self.changed(PUNCTURE, HOLD, lambda f: 0 * f + 0.5), "insertion slope")
        wave = np.sin(np.arange(HOLD - PUNCTURE) / 80)
        self.expect(self.changed(PUNCTURE, HOLD, lambda f: f + 0.02 * wave), "ripple")

    def test_wrong_hold(self):
        self.expect(self.changed(HOLD, RETRACTION, lambda f: 0 * f + 0.9), "decay in the hold")
        self.expect(self.changed(8500, 9000, lambda f: f + 0.03), "swing")
        self.expect(self.changed(HOLD + 50, RETRACTION, lambda f: 0 * f + 0.6), "time constant")

    def test_wrong_retraction(self):
        self.expect(self.changed(RETRACTION, EXIT, np.abs), "never changes its sign")
        self.expect(self.changed(RETRACTION, EXIT, lambda f: 2 * f), "largest pull")
        self.expect(self.changed(RETRACTION, RETRACTION + 800, lambda f: 0 * f + 0.5), "way back")

    def test_wrong_exit(self):
        self.expect(self.changed(EXIT, END, lambda f: f + 0.02), "after the exit")


if __name__ == "__main__":
    unittest.main()
