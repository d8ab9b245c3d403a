#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A tissue's numbers are found again from the force on a needle: in the example, and from curves
that were simulated with random numbers and noise.

The random numbers are those that an insertion can show: the tissue's surface breaks before the end,
at a force larger than the needle needs afterwards. Expected values: the random numbers themselves;
the binomial distribution.

usage: calibrate_test.py Once|Often|Example
"""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import stylet
from support import SOURCE

sys.path.insert(0, str(SOURCE / "offline/python/examples"))
import calibrate  # noqa: E402

SIGMA_N = 0.02
SPEED_M_PER_S = 0.02  # a curve takes a seventh of the example's time


def curves(points):
    return calibrate.curves(points, SPEED_M_PER_S)


def recovered(seed):
    """The random numbers, and the fit of their curve with noise."""
    drawn = stylet.draw({"youngs_modulus_pa": stylet.LogUniform(8e4, 2e5),
                         "puncture_force_n": stylet.Uniform(0.7, 1.2),
                         "friction_n_per_m": stylet.Uniform(8, 25)}, 1, seed)
    truth = {name: float(column[0]) for name, column in drawn.items()}
    noise = SIGMA_N * np.random.default_rng(seed).standard_normal(len(calibrate.PUBLISHED_N))
    return truth, stylet.fit(curves, calibrate.RANGES, curves([truth])[0] + noise, SIGMA_N)


class Once(unittest.TestCase):
    def test_within_four_standard_errors(self):
        truth, found = recovered(1)
        self.assertTrue(found.converged)
        for i, (name, value) in enumerate(truth.items()):
            off = np.log(found.values[name] / value)
            self.assertLess(abs(off), 4 * np.sqrt(found.covariance[i, i]), name)
            self.assertLess(found.high[name] / found.low[name], 1.5, name)
        # Chi-squared of 14 degrees of freedom: above 36.1 once in a thousand times.
        self.assertLess(np.sum((found.residuals / SIGMA_N) ** 2), 36.1)


class Often(unittest.TestCase):
    def test_intervals_contain_the_truth_as_often_as_they_say(self):
        """Of 20 correct intervals of 95 %, 5 or more miss with a probability of 0.3 %; so do 9 or
        more of all 60, if these were independent."""
        misses = dict.fromkeys(calibrate.RANGES, 0)
        for seed in range(100, 120):
            truth, found = recovered(seed)
            for name, value in truth.items():
                misses[name] += not found.low[name] <= value <= found.high[name]
        self.assertLess(max(misses.values()), 5, misses)
        self.assertLess(sum(misses.values()), 9, misses)


class Example(unittest.TestCase):
    def test_published_curve(self):
        """Nobody knows this tissue's numbers, but the curve itself says: the surface breaks at the
        peak, 1.21 N on average over the last millimetre before it; and afterwards the force rises
        by 0.23 N in 5 mm, which is an upper bound for friction."""
        with tempfile.TemporaryDirectory() as top:
            picture = os.path.join(top, "curve.png")
            said = subprocess.run([SOURCE / "offline/python/examples/calibrate.py", picture],
                                  check=True, capture_output=True, text=True).stdout
            with open(picture, "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        linear, stiffening, _ = said.split("N off the curve\n")
        numbers, further = (
            {line.split()[0]: float(line.split()[1].strip(",")) for line in part.splitlines()[:-1]}
            for part in (linear, stiffening))
        self.assertEqual(list(numbers), list(calibrate.RANGES))
        self.assertEqual(list(further), list(calibrate.STIFFENING))
        self.assertTrue(0.8 < numbers["puncture_force_n"] < 1.5, said)
        self.assertTrue(0 < numbers["friction_n_per_m"] < 1.2 * 0.23 / 0.005, said)
        # Two thirds of the peak in the first 9 mm.
        self.assertTrue(5e4 < numbers["youngs_modulus_pa"] < 3e5, said)
        off_n = [float(part.split("the model is ")[1]) for part in (linear, stiffening)]
        self.assertLess(off_n[0], 0.15, said)
        # The curve is hollow. By shear bovine liver has 23 to 30 kPa at rest (Gokgol et al. 2012).
        self.assertTrue(1e4 < further["youngs_modulus_pa"] < 6e4, said)
        self.assertGreater(further["strain_stiffening"], 1, said)
        self.assertLess(off_n[1], 0.7 * off_n[0], said)


if __name__ == "__main__":
    unittest.main()
