# SPDX-License-Identifier: Apache-2.0
"""Parameters of a simulation from a measured curve, with their uncertainty.

Every parameter is above 0 and is found by its logarithm, in which tissue's numbers differ. Sources:
Marquardt 1963 (the search); Seber and Wild, Nonlinear Regression, 1989, chapter 5 (intervals by the
Jacobian and by the profile); Abramowitz and Stegun 26.7.3 to 26.7.5 (Student's t).
"""
import dataclasses
import math
import statistics

import numpy as np

from stylet.draws import LogUniform, draw
from stylet.given import finite

MOST_STEPS = 40
FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-2, 1e-9, 1e6
TRIED_DAMPINGS = (0.1, 1, 10, 100)
LONGEST_STEP = np.log(2)  # a parameter at most doubles
NEAR = 0.02         # a step that is this small a part of the standard errors ends the search
# Ways of differences, in the logarithm: standard errors, but not less, as the tick in which tissue
# gives way would be seen, nor more, where the curve bends.
LEAST_WAY, MOST_WAY = 0.02, 0.1
# Part of the steepest way down of the curve below which a way is none. Chosen, not measured: forces
# are of single precision, so differences over LEAST_WAY cannot know slopes much better.
FLAT = 1e-6
DRAWN_FOR_EACH = 16  # parameter, before the search goes down
SEED = 1


@dataclasses.dataclass(frozen=True)
class Fit:
    """What `fit` found. `values` by name; `low` and `high` hold each with the `confidence`."""
    values: dict
    low: dict
    high: dict
    confidence: float
    covariance: np.ndarray  # of the logarithms, in the order of `values`
    sigma: float            # of the curve's points: as given, or as the residuals say
    residuals: np.ndarray   # measured less simulated
    converged: bool
    search: object = dataclasses.field(repr=False)

    def profile(self, name):
        """Low and high by the profile: where the best fit of all others is worse by as much as the
        confidence allows. It needs no straight line, and many more simulations."""
        return self.search.profile(self, list(self.values).index(name))


def fit(simulate, ranges, measured, sigma=None, confidence=0.95, starts=3):
    """Finds the parameters whose simulated curve is nearest to the measured one.

    `simulate` takes a list of dicts of parameters, and returns a curve for each, as long as
    `measured`: so it may run them all at once. `ranges`: for each parameter where it is expected,
    two numbers above 0. A Latin hypercube in them is simulated, and the search goes down from the
    best `starts` of it, beyond the ranges if need be: for where tissue gives way, curves have
    several nearest ones. `sigma`: standard deviation of the measured points, one or one each; None:
    it follows from the residuals, and then holds what the model cannot do as well."""
    drawn = draw({name: LogUniform(*finite(name, ends, (2,)).tolist())
                  for name, ends in ranges.items()}, DRAWN_FOR_EACH * len(ranges), SEED)
    points = np.log(np.stack(list(drawn.values()), axis=1))
    measured = finite("measured", measured, np.shape(measured)).astype(float).ravel()
    if len(measured) <= len(ranges):
        raise ValueError(f"measured: {len(measured)} points: expected more than parameters")
    deviation = np.asarray(1.0 if sigma is None else sigma, float)
    if not (np.isfinite(deviation) & (deviation > 0)).all():
        raise ValueError(f"sigma = {sigma}: expected numbers above 0")
    search = Search(simulate, list(ranges), measured, deviation)
    order = np.argsort((search.residuals(points) ** 2).sum(axis=1))[:starts]
    return search.fit(points[order], sigma, confidence)


class Search:
    """The way down, in logarithms `x` of the parameters and residuals in standard deviations."""

    def __init__(self, simulate, names, measured, deviation):
        self.simulate, self.names = simulate, names
        self.measured, self.deviation = measured, deviation

    def residuals(self, points):
        curves = np.asarray(self.simulate([dict(zip(self.names, map(float, np.exp(x))))
                                           for x in points]), float)
        wanted = (len(points), len(self.measured))
        if curves.shape != wanted:
            raise ValueError(f"simulate: curves of shape {curves.shape}: expected {wanted}")
        return (self.measured - curves) / self.deviation

    def slopes(self, x, free, ways):
        """Residuals at x, and their derivatives by differences to both sides."""
        aside = [way * np.eye(len(x))[i] for i, way in zip(free, ways)]
        all_ = self.residuals([x] + [x + each for each in aside] + [x - each for each in aside])
        ahead, behind = all_[1:1 + len(free)], all_[1 + len(free):]
        return all_[0], ((ahead - behind) / (2 * np.asarray(ways)[:, None])).T

    def down(self, x, free):
        """The nearest minimum over the free ones: x, residuals, Jacobian, whether it was found.

        Steps of several dampings are tried at once, as curves are best simulated together."""
        x, damping, ways = np.array(x), FIRST_DAMPING, np.full(len(free), LEAST_WAY)
        here, jacobian = self.slopes(x, free, ways)
        for _ in range(MOST_STEPS):
            normal = jacobian.T @ jacobian
            errors = errors_of(normal, here)
            tried = damping * np.array(TRIED_DAMPINGS)
            points = np.tile(x, (len(tried), 1))
            points[:, free] += [step_of(normal, jacobian.T @ here, each) for each in tried]
            ahead = self.residuals(points)
            best = np.argmin((ahead ** 2).sum(axis=1))
            small = (np.abs(points[best] - x)[free] <= NEAR * errors).all()
            better = ahead[best] @ ahead[best] < here @ here
            damping = max(tried[best], LEAST_DAMPING) if better else damping * 1e3
            if better:
                x, ways = points[best], np.clip(errors, LEAST_WAY, MOST_WAY)
                here, jacobian = self.slopes(x, free, ways)
            if small or damping > MOST_DAMPING:
                return x, here, jacobian, True
        return x, here, jacobian, False

    def fit(self, starts, sigma, confidence):
        ends = [self.down(start, np.arange(len(start))) for start in starts]
        x, residuals, jacobian, converged = min(ends, key=lambda end: end[1] @ end[1])
        freedom = len(residuals) - len(x)
        scale = np.sqrt(residuals @ residuals / freedom) if sigma is None else 1.0
        covariance = scale ** 2 * covariance_of(jacobian)
        half = quantile(confidence, freedom if sigma is None else np.inf) * np.sqrt(
            np.diag(covariance))
        ends = [dict(zip(self.names, map(float, np.exp(x + side)))) for side in (0, -half, half)]
        return Fit(*ends, confidence, covariance, float(scale * np.mean(self.deviation)),
                   residuals * self.deviation, converged, self)

    def profile(self, found, index):
        if not np.isfinite(found.covariance[index, index]):
            return 0.0, float("inf")
        x = np.log(list(found.values.values()))
        free = np.delete(np.arange(len(x)), index)
        scale = found.sigma / np.mean(self.deviation)
        half = np.log(list(found.high.values()))[index] - x[index]
        allowed = half / np.sqrt(found.covariance[index, index])
        best = found.residuals @ (found.residuals / self.deviation ** 2)
        ends = []
        for side in (-half, half):
            for _ in range(8):
                at = x.copy()
                at[index] += side
                # Where the straight line says that the others would be.
                at[free] += found.covariance[free, index] / found.covariance[index, index] * side
                here = self.down(at, free)[1] if len(free) else self.residuals([at])[0]
                rise = np.sqrt(max(here @ here - best, 1e-12)) / scale
                side *= np.clip(allowed / rise, 0.5, 2)
                if abs(rise / allowed - 1) < 0.02:
                    break
            ends.append(float(np.exp(x[index] + side)))
        return tuple(ends)


def covariance_of(jacobian):
    """Of the parameters, for residuals of deviation 1. The curve does not determine those that it
    follows FLAT times less than others, alone or together: their variance is infinite."""
    _, sizes, ways = np.linalg.svd(jacobian, full_matrices=False)
    flat = ~(sizes > FLAT * sizes.max())
    steep = ways[~flat] / sizes[~flat, None]
    covariance = steep.T @ steep
    undetermined = (np.abs(ways[flat]) > FLAT).any(axis=0)
    covariance[undetermined] = covariance[:, undetermined] = 0
    covariance[undetermined, undetermined] = np.inf
    return covariance


def step_of(normal, gradient, damping):
    """Marquardt's step, at most LONGEST_STEP for any parameter."""
    step = -np.linalg.lstsq(normal + damping * np.diag(np.diag(normal)), gradient, rcond=None)[0]
    return step * min(1, LONGEST_STEP / max(np.abs(step).max(), 1e-300))


def errors_of(normal, residuals):
    """Standard errors as the curve's residuals say them."""
    variance = residuals @ residuals / max(len(residuals) - len(normal), 1)
    return np.sqrt(np.maximum(np.diag(np.linalg.pinv(normal)) * variance, 0))


def quantile(confidence, freedom):
    """How many standard errors to either side hold it: Student's t."""
    if not 0 < confidence < 1:
        raise ValueError(f"confidence = {confidence}: expected 0 to 1")
    if freedom == 1:
        return math.tan(math.pi * confidence / 2)
    if freedom == 2:
        return confidence * math.sqrt(2 / (1 - confidence ** 2))
    z = statistics.NormalDist().inv_cdf((1 + confidence) / 2)
    terms = ((z ** 3 + z) / 4, (5 * z ** 5 + 16 * z ** 3 + 3 * z) / 96,
             (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / 384)
    return z + sum(term / freedom ** (i + 1) for i, term in enumerate(terms))
