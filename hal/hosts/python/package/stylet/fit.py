# SPDX-License-Identifier: Apache-2.0
"""Finds parameters of a simulation from a measured curve, with their uncertainty.

Every parameter is above 0, and its logarithm is searched, because the numbers of tissues differ by
factors. Sources:
Marquardt 1963 (the search); Seber and Wild, Nonlinear Regression, 1989, chapter 5 (intervals by the
Jacobian and by the profile); Abramowitz and Stegun 26.7.3 to 26.7.5 (Student's t).

Where the curve has a step, such as a puncture, a parameter that moves the step is known only to the
distance of the curve's points, and the Jacobian says nothing about it. So each end of an interval
is tried: if the curve differs less there than the Jacobian says, the end is searched at which it
does differ.
"""
from __future__ import annotations

import dataclasses
import math
import statistics
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from stylet.draws import LogUniform, draw
from stylet.given import Array, finite, real

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
TRUSTED = 0.5       # an end of an interval where the curve differs less than this part is sought
EXACT = 0.02        # part of the allowed rise, and of the way to it, to which an end is sought
MOST_LOOKS = 32     # for an end: ways are doubled, then halved
FAR = math.log(1e9)  # an end that is farther away is none
LOOKED_ALONG = 32   # places of a parameter in which the curve breaks
MOST_BREAKS = 4     # as many times one leads on to another
EXACT_FREEDOM = 300  # beyond it the series in 1 / freedom is right to 1e-8

Simulate = Callable[[list[dict[str, float]]], ArrayLike]
End = tuple[Array, Array, Array, bool]  # x, residuals, Jacobian, whether it was found


@dataclasses.dataclass(frozen=True)
class Fit:
    """What `fit` found: `values` by name. With the `confidence`, each lies between `low` and
    `high`."""
    values: dict[str, float]
    low: dict[str, float]
    high: dict[str, float]
    confidence: float
    # Of the logarithms, in the order of `values`.
    covariance: Array = dataclasses.field(repr=False)
    sigma: float  # of the curve's points: as given, or as the residuals say
    residuals: Array = dataclasses.field(repr=False)  # measured less simulated
    converged: bool
    search: Search = dataclasses.field(repr=False)
    allowed: float = dataclasses.field(repr=False)  # standard errors to either side

    def __str__(self) -> str:
        """A line for each parameter, with its interval."""
        return "\n".join(f"{name:18} {value:9.4g}, {100 * self.confidence:g} %: "
                         f"{self.low[name]:.4g} to {self.high[name]:.4g}"
                         for name, value in self.values.items())

    def profile(self, name: str) -> tuple[float, float]:
        """The interval by the profile: from where to where the best fit of all other parameters is
        no worse than the confidence allows. It does not assume that the curve follows the
        parameters in a straight line, but needs many more simulations."""
        return self.search.profile(self, list(self.values).index(name))


def fit(simulate: Simulate, ranges: Mapping[str, Sequence[float]], measured: ArrayLike,
        sigma: ArrayLike | None = None, confidence: float = 0.95, starts: int = 3) -> Fit:
    """Finds the parameters whose simulated curve is nearest to the measured one.

    `simulate` takes a list of dicts of parameters and returns a curve for each, as long as
    `measured`, so that it can run them all at once. `ranges`: for each parameter, two numbers above
    0 between which it is expected. A Latin hypercube in these ranges is simulated, and the search
    goes down from its best `starts` points, because curves of tissue that gives way have several
    local minima; it may leave the ranges. `sigma`: the standard deviation of the measured points,
    as one number or one for each; None: it is estimated from the residuals, and then includes what
    the model cannot describe. A curve that has a number that is not finite is avoided by the
    search."""
    if not ranges:
        raise ValueError("ranges: expected one parameter at least")
    drawn = draw({name: LogUniform(*finite(name, ends, (2,)).tolist())
                  for name, ends in ranges.items()}, DRAWN_FOR_EACH * len(ranges), SEED)
    points = np.log(np.stack(list(drawn.values()), axis=1))
    measured = finite("measured", measured, np.shape(measured)).astype(float).ravel()
    if len(measured) <= len(ranges):
        raise ValueError(f"measured: {len(measured)} points: expected more than parameters")
    deviation = real("sigma", 1.0 if sigma is None else sigma).astype(float)
    if deviation.shape not in ((), measured.shape):
        raise ValueError(f"sigma of shape {deviation.shape}: expected one number, or one for each "
                         f"of {len(measured)} points")
    if not (np.isfinite(deviation) & (deviation > 0)).all():
        raise ValueError(f"sigma = {deviation}: expected numbers above 0")
    if isinstance(starts, bool) or not isinstance(starts, (int, np.integer)) or starts < 1:
        raise ValueError(f"starts = {starts!r}: expected a whole number of at least 1")
    allowed = quantile(confidence, np.inf if sigma is not None else len(measured) - len(ranges))
    search = Search(simulate, list(ranges), measured, deviation)
    costs = search.costs(points)
    order = [i for i in np.argsort(costs)[:starts] if np.isfinite(costs[i])]
    if not order:
        raise ValueError(f"simulate: no curve of finite numbers for any of {len(points)} draws "
                         "from the ranges: expected at least one")
    ends = np.log([list(each) for each in ranges.values()])
    return search.fit(points[order], sigma, confidence, allowed, ends)


class Search:
    """The search, in logarithms `x` of the parameters and residuals in standard deviations."""

    def __init__(self, simulate: Simulate, names: list[str], measured: Array,
                 deviation: Array) -> None:
        self.simulate, self.names = simulate, names
        self.measured, self.deviation = measured, deviation

    def residuals(self, points: Sequence[Array] | Array) -> Array:
        curves = np.asarray(self.simulate([dict(zip(self.names, map(float, np.exp(x))))
                                           for x in points]), float)
        wanted = (len(points), len(self.measured))
        if curves.shape != wanted:
            raise ValueError(f"simulate: curves of shape {curves.shape}: expected {wanted}")
        return (self.measured - curves) / self.deviation

    def costs(self, points: Sequence[Array] | Array) -> Array:
        return costs_of(self.residuals(points))

    def slopes(self, x: Array, free: Array, ways: Array) -> tuple[Array, Array]:
        """Residuals at x, and their derivatives by differences to both sides, or to the one side on
        which there is a curve."""
        aside = [way * np.eye(len(x))[i] for i, way in zip(free, ways)]
        all_ = self.residuals([x] + [x + each for each in aside] + [x - each for each in aside])
        here, ahead, behind = all_[0], all_[1:1 + len(free)], all_[1 + len(free):]
        first = np.isfinite(ahead).all(axis=1)[:, None]
        second = np.isfinite(behind).all(axis=1)[:, None]
        for i, index in enumerate(free):
            if not first[i] and not second[i]:
                raise ValueError(f"simulate: no curve of finite numbers on either side of "
                                 f"{self.names[index]} = {math.exp(x[index]):g}")
        sides = np.where(first, ahead, here) - np.where(second, behind, here)
        return here, (sides / ((first * 1.0 + second) * np.asarray(ways)[:, None])).T

    def down(self, x: Array, free: Array) -> End:
        """The nearest minimum over the free parameters: x, residuals, Jacobian, whether it was
        found.

        Steps of several dampings are tried at once, because curves are best simulated together."""
        x, damping, ways = np.array(x), FIRST_DAMPING, np.full(len(free), LEAST_WAY)
        here, jacobian = self.slopes(x, free, ways)
        for _ in range(MOST_STEPS):
            normal = jacobian.T @ jacobian
            errors = errors_of(normal, here)
            tried = damping * np.array(TRIED_DAMPINGS)
            points = np.tile(x, (len(tried), 1))
            points[:, free] += [step_of(normal, jacobian.T @ here, each) for each in tried]
            costs = self.costs(points)
            best = np.argmin(costs)
            small = (np.abs(points[best] - x)[free] <= NEAR * errors).all()
            better = costs[best] < here @ here
            damping = max(tried[best], LEAST_DAMPING) if better else damping * 1e3
            if better:
                x, ways = points[best], np.clip(errors, LEAST_WAY, MOST_WAY)
                here, jacobian = self.slopes(x, free, ways)
            if small or damping > MOST_DAMPING:
                return x, here, jacobian, True
        return x, here, jacobian, False

    def past_break(self, end: End, index: int, ends: Array) -> End:
        """A better minimum, or the same one. No slope leads past a step of the curve, so the
        parameter that moves the step is tried over its whole range, and then closely where it was
        best."""
        for _ in range(2):
            places = np.linspace(ends[0], ends[1], LOOKED_ALONG)
            points = np.tile(end[0], (LOOKED_ALONG, 1))
            points[:, index] = places
            costs = self.costs(points)
            best = np.argmin(costs)
            if costs[best] < end[1] @ end[1]:
                end = self.down(points[best], np.arange(len(points[best])))
            ends = end[0][index] + np.array([-1, 1]) * (places[1] - places[0])
        return end

    def fit(self, starts: Array, sigma: ArrayLike | None, confidence: float, allowed: float,
            ranges: Array) -> Fit:
        best = min((self.down(start, np.arange(len(start))) for start in starts),
                   key=lambda end: float(end[1] @ end[1]))
        told = self.told(best, sigma, allowed)
        for _ in range(MOST_BREAKS):
            before = best
            for index in told.breaks:
                best = self.past_break(best, index, ranges[index])
            if best is before:
                break
            told = self.told(best, sigma, allowed)
        x, residuals, _, converged = best
        values, low, high = (dict(zip(self.names, map(float, np.exp(each))))
                             for each in (x, *told.ends))
        return Fit(values, low, high, confidence, told.covariance,
                   float(told.scale * np.mean(self.deviation)), residuals * self.deviation,
                   converged, self, allowed)

    def told(self, best: End, sigma: ArrayLike | None, allowed: float) -> Told:
        x, residuals, jacobian, _ = best
        freedom = len(residuals) - len(x)
        scale = np.sqrt(residuals @ residuals / freedom) if sigma is None else 1.0
        covariance = scale ** 2 * covariance_of(jacobian)
        return Told(covariance, scale, *self.interval(best, covariance, scale, allowed))

    def interval(self, best: End, covariance: Array, scale: float,
                 allowed: float) -> tuple[Array, Sequence[int]]:
        """The interval of each logarithm: by the Jacobian, or where the curve says otherwise; and
        the parameters for which it does."""
        x, residuals, jacobian, _ = best
        half = allowed * np.sqrt(np.diag(covariance))
        ends = np.stack([x - half, x + half])
        if not scale > 0:
            return ends, ()

        def rises(points: Sequence[Array]) -> Array:
            return np.sqrt(np.maximum(self.costs(points) - residuals @ residuals, 0)) / scale
        lone = idle(jacobian)
        breaks = set(np.flatnonzero(lone))
        tried = [(side, i, ways) for i in np.flatnonzero(np.isfinite(half) | lone)
                 for ways in (ways_of(i, half, covariance, lone[i]),) for side in (-1, 1)]
        points = [x + side * way for side, _, ways in tried for way in ways]
        here = iter(rises(points) if points else np.zeros(0))
        for side, i, ways in tried:
            if min([next(here) for _ in ways]) < TRUSTED * allowed or lone[i]:
                breaks.add(i)
                ends[int(side > 0), i] = x[i] + side * max(
                    edge(lambda by: rises([x + side * by * way])[0], 1.0, allowed, FAR / way[i])
                    * way[i] for way in ways)
        return ends, sorted(breaks)

    def profile(self, found: Fit, index: int) -> tuple[float, float]:
        if not np.isfinite(found.covariance[index, index]):
            name = self.names[index]
            return found.low[name], found.high[name]
        x = np.log(list(found.values.values()))
        free = np.delete(np.arange(len(x)), index)
        scale = found.sigma / np.mean(self.deviation)
        error = np.sqrt(found.covariance[index, index])
        best = found.residuals @ (found.residuals / self.deviation ** 2)

        def rise(way: float) -> float:
            at = x.copy()
            at[index] += way
            # Where the straight line says that the others would be.
            at[free] += found.covariance[free, index] / error ** 2 * way
            least = costs_of(self.down(at, free)[1]) if len(free) else self.costs([at])[0]
            return np.sqrt(max(least - best, 0)) / scale
        low, high = (float(np.exp(x[index] + side * edge(
            lambda way: rise(side * way), found.allowed * error, found.allowed, FAR)))
            for side in (-1, 1))
        return low, high


@dataclasses.dataclass(frozen=True)
class Told:
    """What the best fit says about the logarithms, with the parameters whose intervals the Jacobian
    gets wrong."""
    covariance: Array
    scale: float
    ends: Array
    breaks: Sequence[int]


def ways_of(index: int, half: Array, covariance: Array, alone: bool) -> tuple[Array, ...]:
    """Ways to the upper end of an interval: along the line on which the Jacobian says that the
    other parameters follow, and with this parameter alone, since the Jacobian may be wrong. Either
    is at most as long as the way to the profile's end."""
    if alone:
        return (LEAST_WAY * np.eye(len(half))[index],)
    return (covariance[:, index] * half[index] / covariance[index, index],
            half[index] * np.eye(len(half))[index])


def edge(rise_at: Callable[[float], float], first: float, allowed: float, most: float) -> float:
    """The distance from the best fit at which the curve differs by as much as is allowed; if it
    jumps there, a distance just beyond the jump. Infinite if it does not differ so much up to
    `most`."""
    inner, outer, at = 0.0, np.inf, first
    for _ in range(MOST_LOOKS):
        if at > most:
            break
        rise = rise_at(at)
        if abs(rise / allowed - 1) < EXACT:
            return at
        inner, outer = (at, outer) if rise < allowed else (inner, at)
        if outer - inner < EXACT * outer:
            break
        at *= np.clip(allowed / max(rise, 1e-6), 0.5, 2)
        if not inner < at < outer:
            at = (inner + outer) / 2
    return outer


def costs_of(residuals: Array) -> Array:
    """Sums of squares; infinite for a curve with numbers that are not finite."""
    squares = (residuals ** 2).sum(axis=-1)
    return np.where(np.isfinite(squares), squares, np.inf)


def idle(jacobian: Array) -> Array:
    """Which parameters have no effect on the curve by themselves."""
    effects = np.linalg.norm(jacobian, axis=0)
    return effects <= FLAT * effects.max()


def covariance_of(jacobian: Array) -> Array:
    """The covariance of the parameters, for residuals of deviation 1. If a parameter, or several
    together, changes the curve FLAT times less than the others, the curve does not determine it:
    the variance is infinite."""
    _, sizes, ways = np.linalg.svd(jacobian, full_matrices=False)
    flat = ~(sizes > FLAT * sizes.max())
    steep = ways[~flat] / sizes[~flat, None]
    covariance = steep.T @ steep
    undetermined = (np.abs(ways[flat]) > FLAT).any(axis=0)
    covariance[undetermined] = covariance[:, undetermined] = 0
    covariance[undetermined, undetermined] = np.inf
    return covariance


def step_of(normal: Array, gradient: Array, damping: float) -> Array:
    """Marquardt's step, at most LONGEST_STEP for any parameter."""
    step = -np.linalg.lstsq(normal + damping * np.diag(np.diag(normal)), gradient, rcond=None)[0]
    return step * min(1, LONGEST_STEP / max(np.abs(step).max(), 1e-300))


def errors_of(normal: Array, residuals: Array) -> Array:
    """Standard errors that follow from the curve's residuals."""
    variance = residuals @ residuals / max(len(residuals) - len(normal), 1)
    return np.sqrt(np.maximum(np.diag(np.linalg.pinv(normal)) * variance, 0))


def quantile(confidence: float, freedom: float) -> float:
    """The number of standard errors to either side within which it lies: Student's t."""
    if not 0 < confidence < 1:
        raise ValueError(f"confidence = {confidence}: expected 0 to 1")
    if freedom <= EXACT_FREEDOM:
        low, high = 0.0, math.pi / 2
        for _ in range(60):  # to the last bit of an angle
            angle = (low + high) / 2
            below = share_within(angle, int(freedom)) < confidence
            low, high = (angle, high) if below else (low, angle)
        return math.tan(low) * math.sqrt(freedom)
    z = statistics.NormalDist().inv_cdf((1 + confidence) / 2)
    terms = ((z ** 3 + z) / 4, (5 * z ** 5 + 16 * z ** 3 + 3 * z) / 96,
             (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / 384)
    return z + sum(term / freedom ** (i + 1) for i, term in enumerate(terms))


def share_within(angle: float, freedom: int) -> float:
    """The probability that Student's t, of a whole number of degrees of freedom, lies within
    tan(angle) sqrt(freedom)."""
    odd, cosine = freedom % 2, math.cos(angle)
    term = cosine if odd else 1.0
    total = 0.0
    for k in range(odd + 2, freedom + 1, 2):
        total += term
        term *= cosine ** 2 * (k - 1) / k
    if odd:
        return 2 / math.pi * (angle + math.sin(angle) * total)
    return math.sin(angle) * total
