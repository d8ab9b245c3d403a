# SPDX-License-Identifier: Apache-2.0
"""Parameters drawn from named distributions, as columns for sweep.

Source of the hypercube: McKay, Beckman and Conover 1979, A comparison of three methods for
selecting values of input variables in the analysis of output from a computer code.
"""
from __future__ import annotations

import dataclasses
import math
import statistics
from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from stylet.given import Array, count as count_of

STANDARD_NORMAL = statistics.NormalDist()
MOST_TURNS = 9.0  # standard deviations beyond which no draw of 53 bits is
LEAST_SHARE = 2.0 ** -54


class Distribution(Protocol):
    def at(self, share: Array) -> Array:
        """The number below which this fraction of the draws lies."""


@dataclasses.dataclass(frozen=True)
class Uniform:
    """Every number from low to high is equally probable."""
    low: float
    high: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise ValueError(f"{self}: expected low below high")

    def at(self, share: Array) -> Array:
        """The number below which this fraction of the draws lies."""
        width = self.high - self.low
        number = (self.low + share * width if math.isfinite(width)
                  else (1 - share) * self.low + share * self.high)
        return np.clip(number, self.low, self.high)


@dataclasses.dataclass(frozen=True)
class LogUniform(Uniform):
    """The logarithm is uniform from low to high; both are above 0."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.low > 0:
            raise ValueError(f"{self}: expected low above 0")

    def at(self, share: Array) -> Array:
        ratio = self.high / self.low
        number = (self.low * ratio ** share if math.isfinite(ratio) else
                  np.exp((1 - share) * math.log(self.low) + share * math.log(self.high)))
        return np.clip(number, self.low, self.high)


@dataclasses.dataclass(frozen=True)
class Normal:
    """Normal about the mean; with low or high, only the part between them."""
    mean: float
    deviation: float
    low: float = -math.inf
    high: float = math.inf

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mean) and 0 < self.deviation < math.inf
                and self.low < self.high):
            raise ValueError(f"{self}: expected a deviation above 0, and low below high")
        ends = [min(max(self.mean + turns * self.deviation, self.low), self.high)
                for turns in (-MOST_TURNS, MOST_TURNS)]
        if not all(map(math.isfinite, ends)):
            raise ValueError(f"{self}: expected draws that are finite")
        below, above = self._shares()
        if not below < above:
            raise ValueError(f"{self}: expected that draws between low and high are possible")

    def _upper(self) -> bool:
        """Whether all draws are above the mean. Shares are close together there; those of the other
        side, which are the same, have all their digits."""
        return self.low > self.mean

    def _shares(self) -> list[float]:
        turns = [(end / 2 - self.mean / 2) / (self.deviation / 2) for end in (self.low, self.high)]
        if self._upper():
            turns = [-turns[1], -turns[0]]
        return [math.erfc(-each / math.sqrt(2)) / 2 for each in turns]

    def at(self, share: Array) -> Array:
        below, above = self._shares()
        share = np.clip(share, LEAST_SHARE, 1 - LEAST_SHARE)
        shares = below + (1 - share if self._upper() else share) * (above - below)
        turns = np.vectorize(STANDARD_NORMAL.inv_cdf, otypes=[float])(
            np.clip(shares, np.finfo(float).tiny, 1 - np.finfo(float).epsneg))
        turns = -turns if self._upper() else turns
        with np.errstate(over="ignore"):  # beyond an end, to which it is cut
            return np.clip(self.mean + self.deviation * turns, self.low, self.high)


@dataclasses.dataclass(frozen=True)
class LogNormal:
    """The logarithm is normal: two draws in three lie between median / ratio and median * ratio.
    The numbers of tissues are often given in this way."""
    median: float
    ratio: float

    def __post_init__(self) -> None:
        if not (0 < self.median < math.inf and 1 < self.ratio < math.inf):
            raise ValueError(f"{self}: expected a median above 0 and a ratio above 1")
        most, reach = np.finfo(float), MOST_TURNS * math.log(self.ratio)
        if not (math.log(self.median) + reach < math.log(most.max)
                and math.log(self.median) - reach > math.log(most.tiny)):
            raise ValueError(f"{self}: expected draws that are finite and above 0")

    def at(self, share: Array) -> Array:
        return self.median * self.ratio ** Normal(0, 1).at(share)


@dataclasses.dataclass(frozen=True)
class Choice:
    """Each of these values is equally probable."""
    values: tuple[Any, ...]

    def __init__(self, *values: Any) -> None:
        if not values:
            raise ValueError("Choice: expected one value at least")
        object.__setattr__(self, "values", values)

    def at(self, share: Array) -> Array:
        index = np.minimum((np.asarray(share) * len(self.values)).astype(int),
                           len(self.values) - 1)
        return np.asarray(self.values)[index]


def draw(distributions: Mapping[str, Distribution], count: int, seed: int,
         plain: bool = False) -> dict[str, Array]:
    """`count` draws of each distribution, as columns by name. The same seed gives the same draws on
    every machine.

    The draws are a Latin hypercube: each distribution is divided into `count` parts of equal
    probability, and one number is drawn from each part. So means vary less than those of `plain`,
    independent draws. The draws of a name do not depend on what else is drawn."""
    number, columns = count_of("count", count), {}
    for name, distribution in distributions.items():
        random = np.random.default_rng([seed, *name.encode()])
        shares = random.random(number)
        if not plain:
            shares = (random.permutation(number) + shares) / number
        columns[name] = distribution.at(shares)
    return columns
