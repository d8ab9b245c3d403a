#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws have the distributions whose names they bear, and are the same for the same seed.

Expected values: distribution functions in closed form (math.erf); Kolmogorov's bound, which a
correct sample exceeds once in a million times: sqrt(-ln(1e-6 / 2) / 2 / n); the variance of a mean.
"""
import math
import random
import unittest

import numpy as np
import stylet

COUNT = 4000
KOLMOGOROV = math.sqrt(-math.log(1e-6 / 2) / 2 / COUNT)


def normal(x):
    return 0.5 * (1 + math.erf(x / math.sqrt(2)))


def cases(seed=4):
    """Distributions of random numbers, each with its distribution function."""
    number = random.Random(seed)
    low, width = number.uniform(-5, 5), number.uniform(0.1, 9)
    mean, deviation = number.uniform(-5, 5), number.uniform(0.1, 3)
    ratio = number.uniform(1.1, 4)
    a, b = normal(-1), normal(0.5)
    return {
        "uniform": (stylet.Uniform(low, low + width), lambda x: (x - low) / width),
        "log_uniform": (stylet.LogUniform(width, width * ratio),
                        lambda x: math.log(x / width) / math.log(ratio)),
        "normal": (stylet.Normal(mean, deviation), lambda x: normal((x - mean) / deviation)),
        "cut": (stylet.Normal(mean, deviation, mean - deviation, mean + 0.5 * deviation),
                lambda x: (normal((x - mean) / deviation) - a) / (b - a)),
        "log_normal": (stylet.LogNormal(width, ratio),
                       lambda x: normal(math.log(x / width) / math.log(ratio)))}


class Draws(unittest.TestCase):
    def distance(self, drawn, function):
        shares = np.array([function(x) for x in np.sort(drawn)])
        steps = np.arange(len(drawn) + 1) / len(drawn)
        return max(np.abs(shares - steps[1:]).max(), np.abs(shares - steps[:-1]).max())

    def test_distributions(self):
        for seed in range(5):
            named = cases(seed)
            drawn = {name: each for name, (each, _) in named.items()}
            columns = stylet.draw(drawn, COUNT, seed, plain=True)
            cube = stylet.draw(drawn, COUNT, seed)
            for name, (_, function) in named.items():
                self.assertLess(self.distance(columns[name], function), KOLMOGOROV, name)
                # With one draw in each part, the sample's distribution is nowhere off by more than
                # one part.
                self.assertLessEqual(self.distance(cube[name], function), 1 / COUNT + 1e-9, name)

    def test_cube_has_one_draw_in_each_part(self):
        cube = stylet.draw({name: stylet.Uniform(0, 1) for name in "abc"}, COUNT, 9)
        for column in cube.values():
            np.testing.assert_array_equal(np.sort((column * COUNT).astype(int)), np.arange(COUNT))
        # Uncorrelated: a coefficient's standard deviation is 1 / sqrt(n).
        off = np.abs(np.corrcoef(list(cube.values())) - np.eye(3)).max()
        self.assertLess(off, 5 / math.sqrt(COUNT))

    def test_choice(self):
        drawn = stylet.draw({"c": stylet.Choice("a", "b", "c")}, 3000, 2)["c"]
        self.assertEqual(sorted(zip(*np.unique(drawn, return_counts=True))),
                         [("a", 1000), ("b", 1000), ("c", 1000)])

    def test_seed_and_names_decide(self):
        one = stylet.draw({"x": stylet.Uniform(0, 1), "y": stylet.Uniform(0, 1)}, 50, 7)
        same = stylet.draw({"y": stylet.Uniform(0, 1), "x": stylet.Uniform(0, 1),
                            "z": stylet.Normal(0, 1)}, 50, 7)
        np.testing.assert_array_equal(one["x"], same["x"])
        np.testing.assert_array_equal(one["y"], same["y"])
        self.assertTrue((one["x"] != one["y"]).any())
        other = stylet.draw({"x": stylet.Uniform(0, 1)}, 50, 8)
        self.assertTrue((one["x"] != other["x"]).all())

    def test_far_from_the_mean(self):
        """Tails of a normal distribution by the complementary error function (C's, exact to the
        last digits), relative to the first one, down to 1e-200."""
        for seed in range(12):
            number = random.Random(seed)
            mean, deviation = number.uniform(-5, 5), number.uniform(0.1, 3)
            near = number.uniform(3, 30)
            far = near + number.uniform(0.1, 2)

            def beyond(turns):
                return math.erfc(turns / math.sqrt(2))
            for side in (-1, 1):
                low, high = sorted(mean + side * each * deviation for each in (near, far))
                drawn = stylet.draw({"x": stylet.Normal(mean, deviation, low, high)}, COUNT, seed)
                turns = side * (drawn["x"] - mean) / deviation
                self.assertTrue(((drawn["x"] >= low) & (drawn["x"] <= high)).all())
                whole = beyond(near) - beyond(far)
                self.assertLessEqual(self.distance(
                    turns, lambda x: (beyond(near) - beyond(x)) / whole), 1 / COUNT + 1e-6)
                self.assertEqual(len(np.unique(turns)), COUNT)

    def test_as_far_as_numbers_reach(self):
        cube = stylet.draw({"u": stylet.Uniform(-1.5e308, 1.7e308),
                            "l": stylet.LogUniform(1e-300, 1e308),
                            "n": stylet.Normal(0, 1e308, -1e308, 1e308)}, COUNT, 3)
        uneven = [(cube["u"] / 1e307 + 15) / 32, (np.log10(cube["l"]) + 300) / 608,
                  (np.array([normal(x) for x in cube["n"] / 1e308]) - normal(-1))
                  / (normal(1) - normal(-1))]
        for each in uneven:
            self.assertLessEqual(self.distance(each, float), 1 / COUNT + 1e-9)

    def test_invalid_distributions_are_refused(self):
        for make in (lambda: stylet.Uniform(1, 1), lambda: stylet.Uniform(0, math.inf),
                     lambda: stylet.LogUniform(0, 1), lambda: stylet.Normal(0, 0),
                     lambda: stylet.Normal(0, math.nan), lambda: stylet.Normal(0, 1, 2, 1),
                     lambda: stylet.Normal(0, 1, 50, 51), lambda: stylet.LogNormal(1, 1),
                     lambda: stylet.Normal(0, 1e308), lambda: stylet.Normal(1.7e308, 1e307),
                     lambda: stylet.LogNormal(1, 1e40), lambda: stylet.LogNormal(1e300, 10),
                     lambda: stylet.LogNormal(1e-300, 10),
                     lambda: stylet.LogNormal(-1, 2), stylet.Choice):
            with self.assertRaises(ValueError):
                make()


if __name__ == "__main__":
    unittest.main()
