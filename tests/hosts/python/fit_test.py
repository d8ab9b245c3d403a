#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Parameters are found again from a noisy curve in closed form, and their intervals contain them as
often as promised.

Expected values: the parameters that the curves were made with; the binomial distribution; Student's
t of Fisher and Yates' table.
"""
import math
import random
import unittest

import numpy as np
import stylet
from stylet.fit import quantile

X = np.linspace(0, 6, 25)
RANGES = {"height": (0.3, 3), "rate": (0.2, 2), "slope": (0.02, 0.2)}


def curves(points):
    return [p["height"] * (1 - np.exp(-p["rate"] * X)) + p["slope"] * X for p in points]


def truth_of(number):
    return {"height": number.uniform(0.7, 1.5), "rate": number.uniform(0.5, 1.5),
            "slope": number.uniform(0.05, 0.15)}


def least_and_most(count, share):
    """Limits that a binomial number exceeds with a probability of a thousandth at either end."""
    chances = np.cumsum([math.comb(count, i) * share ** i * (1 - share) ** (count - i)
                         for i in range(count + 1)])
    return int(np.searchsorted(chances, 1e-3)), int(np.searchsorted(chances, 1 - 1e-3))


class Found(unittest.TestCase):
    def misses(self, fits, sigma, confidence, interval):
        """How often each parameter is outside its interval."""
        out = dict.fromkeys(RANGES, 0)
        for seed in range(fits):
            number = random.Random(seed)
            truth = truth_of(number)
            noise = [number.gauss(0, 0.03) for _ in X]
            found = stylet.fit(curves, RANGES, curves([truth])[0] + noise, sigma, confidence, 1)
            self.assertTrue(found.converged, seed)
            for name, value in truth.items():
                low, high = interval(found, name)
                out[name] += not low <= value <= high
        return out

    def test_without_noise_it_finds_them(self):
        for seed in range(30):
            truth = truth_of(random.Random(seed))
            found = stylet.fit(curves, RANGES, curves([truth])[0], 0.001)
            for name, value in truth.items():
                self.assertAlmostEqual(found.values[name] / value, 1, places=4)

    def test_intervals_contain_the_truth_as_often_as_they_say(self):
        for sigma, confidence, fits in ((0.03, 0.95, 300), (None, 0.95, 300), (None, 0.8, 200)):
            least, most = least_and_most(fits, 1 - confidence)
            for name, count in self.misses(fits, sigma, confidence, lambda found, name: (
                    found.low[name], found.high[name])).items():
                self.assertTrue(least <= count <= most, (name, sigma, count, least, most))

    def test_so_do_intervals_of_the_profile(self):
        least, most = least_and_most(60, 0.2)
        misses = self.misses(60, None, 0.8, lambda found, name: found.profile(name))
        for name, count in misses.items():
            self.assertTrue(least <= count <= most, (name, count, least, most))

    def test_a_break_between_points_has_the_interval_of_its_gap(self):
        """A force rises and then falls at some depth: the curve is the same for every depth between
        two points. Depths and noise are random, on coarse and on fine grids."""
        for count, fits in ((25, 40), (121, 16)):
            x = np.linspace(0, 6, count)

            def broken(points):
                return [np.where(x < p["at"], p["rise"] * x, p["after"]) for p in points]
            ranges, held = {"rise": (0.2, 2), "at": (1, 5), "after": (0.05, 1)}, 0
            for seed in range(fits):
                number = random.Random(seed)
                truth = {"rise": number.uniform(0.5, 1.5), "at": number.uniform(1.5, 4.5),
                         "after": number.uniform(0.1, 0.4)}
                noise = [number.gauss(0, 0.03) for _ in x]
                found = stylet.fit(broken, ranges, broken([truth])[0] + noise,
                                   0.03 if seed % 2 else None)
                # The smallest step of force there is 0.35 N, 11 standard deviations: there is no
                # doubt in which gap it is. The gap's ends are known to the precision with which an
                # end is sought.
                gap = np.searchsorted(x, truth["at"])
                for low, high in ((found.low["at"], found.high["at"]), found.profile("at")):
                    self.assertLess(abs(low / x[gap - 1] - 1), 0.03, seed)
                    self.assertLess(abs(high / x[gap] - 1), 0.03, seed)
                held += found.low["at"] <= truth["at"] <= found.high["at"]
            self.assertGreaterEqual(held, least_and_most(fits, 0.95)[0])

    def test_parameters_without_a_curve_are_avoided(self):
        """A model that gives nan in half of its range, as an unstable one does."""
        for seed in range(10):
            truth = {"height": 1.0, "rate": random.Random(seed).uniform(0.6, 1), "slope": 0.1}

            def partly(points):
                return [curve if p["rate"] < truth["rate"] * 1.01 else np.full(len(X), np.nan)
                        for p, curve in zip(points, curves(points))]
            found = stylet.fit(partly, RANGES, curves([truth])[0], 0.001)
            for name, value in truth.items():
                self.assertAlmostEqual(found.values[name] / value, 1, places=3)
        with self.assertRaisesRegex(ValueError, "no curve of finite numbers for any of 48 draws"):
            stylet.fit(lambda points: np.full((len(points), len(X)), np.nan), RANGES, X)

    def test_both_intervals_of_a_linear_parameter_are_the_closed_form(self):
        """log y = log a + noise of known size: the interval of a mean."""
        number = random.Random(4)
        logs = np.log(2.0) + np.array([number.gauss(0, 0.1) for _ in range(40)])
        found = stylet.fit(lambda points: [np.full(40, math.log(p["a"])) for p in points],
                           {"a": (0.5, 5)}, logs, 0.1)
        mean, half = logs.mean(), 1.959964 * 0.1 / math.sqrt(40)
        self.assertAlmostEqual(math.log(found.values["a"]), mean, places=6)
        for low, high in ((found.low["a"], found.high["a"]), found.profile("a")):
            self.assertAlmostEqual(math.log(low), mean - half, places=3)
            self.assertAlmostEqual(math.log(high), mean + half, places=3)

    def test_sigma_is_that_of_the_noise(self):
        number = random.Random(9)
        truth = truth_of(number)
        found = [stylet.fit(curves, RANGES, curves([truth])[0] + np.array(
            [number.gauss(0, 0.05) for _ in X])).sigma for _ in range(40)]
        # Chi-squared of 22 degrees of freedom, 40 times.
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(found))), 0.05,
                               delta=4 * 0.05 / math.sqrt(2 * 22 * 40))

    def test_students_t(self):
        for confidence, freedom, expected in (
                (0.95, 1, 12.706), (0.95, 2, 4.303), (0.95, 3, 3.182), (0.95, 5, 2.571),
                (0.95, 14, 2.145), (0.99, 1, 63.657), (0.99, 2, 9.925), (0.99, 3, 5.841),
                (0.99, 4, 4.604), (0.99, 10, 3.169), (0.999, 3, 12.924), (0.999, 4, 8.610),
                (0.999, 30, 3.646), (0.95, 30, 2.042), (0.99, 120, 2.617), (0.95, math.inf, 1.960)):
            self.assertAlmostEqual(quantile(confidence, freedom), expected, delta=6e-4)
        # Near the place where the sum ends and the series begins.
        self.assertAlmostEqual(quantile(0.999, 300), quantile(0.999, 301), delta=2e-4)

    def test_parameters_that_the_curve_does_not_show_have_no_interval(self):
        """One has no effect at all, and of two others only the product has one."""
        noise = np.random.default_rng(1).normal(0, 0.02, len(X))
        wide = {name: (0.1, 10) for name in "abc"}
        for power in (0, 1):
            found = stylet.fit(lambda points: [p["a"] * p["c"] ** power * np.exp(-p["b"] * X)
                                               for p in points], wide, 2 * np.exp(-0.4 * X) + noise)
            untold = {"c"} if power == 0 else {"a", "c"}
            for name in "abc":
                told = (found.low[name], found.high[name])
                if name in untold:
                    self.assertEqual(told, (0, np.inf), name)
                    self.assertEqual(found.profile(name), (0, np.inf), name)
                else:
                    truth = {"a": 2, "b": 0.4}[name]
                    self.assertTrue(0.9 * truth < told[0] < truth < told[1] < 1.1 * truth, told)

    def test_refusals(self):
        """Mistakes that can be known beforehand are refused before the first simulation."""
        def never(points):
            raise AssertionError("simulated")
        for words, arguments in (("3 points: expected more", (never, RANGES, [1, 2, 3])),
                                 ("low above 0", (never, {**RANGES, "rate": (0, 1)}, X)),
                                 ("low below high", (never, {**RANGES, "rate": (2, 1)}, X)),
                                 ("rate of shape", (never, {**RANGES, "rate": (1, 2, 3)}, X)),
                                 ("expected finite", (never, {**RANGES, "rate": (1, np.nan)}, X)),
                                 ("one parameter at least", (never, {}, X)),
                                 ("expected finite", (never, RANGES, X * np.nan)),
                                 ("sigma = 0", (never, RANGES, X, 0)),
                                 ("sigma = nan", (never, RANGES, X, np.nan)),
                                 (r"sigma of shape \(7,\): expected one number, or one for each",
                                  (never, RANGES, X, np.ones(7))),
                                 ("confidence = 2", (never, RANGES, X, 1.0, 2)),
                                 ("confidence = nan", (never, RANGES, X, 1.0, np.nan)),
                                 ("starts = 0", (never, RANGES, X, 1.0, 0.9, 0)),
                                 ("starts = nan", (never, RANGES, X, 1.0, 0.9, np.nan)),
                                 (r"curves of shape \(48, 5\): expected \(48, 25\)",
                                  (lambda points: np.zeros((len(points), 5)), RANGES, X))):
            with self.assertRaisesRegex(ValueError, words):
                stylet.fit(*arguments)


if __name__ == "__main__":
    unittest.main()
