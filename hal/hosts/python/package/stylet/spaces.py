# SPDX-License-Identifier: Apache-2.0
"""A space of numbers between two bounds, like Gymnasium's: the part of it that learners use."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from stylet.bases import BoxBase


class Box(BoxBase):
    """Arrays between `low` and `high`, which may be infinite. If Gymnasium is installed, it is a
    gymnasium.spaces.Box; the same seed draws the same numbers with and without Gymnasium."""

    def __init__(self, low: ArrayLike, high: ArrayLike, shape: tuple[int, ...] | None = None,
                 dtype: DTypeLike = np.float32, seed: int | None = None) -> None:
        shape = np.broadcast(low, high).shape if shape is None else tuple(shape)
        low, high = (np.broadcast_to(np.asarray(bound, dtype), shape) for bound in (low, high))
        if not (low <= high).all():
            raise ValueError(f"low = {low}, high = {high}: expected low up to high")
        super().__init__(low, high, shape, dtype, seed)

    def sample(self, mask: None = None, probability: None = None, *,
               seed: int | None = None) -> np.ndarray:
        """A random array: uniform between two finite bounds, exponential from a single one, normal
        without any."""
        if mask is not None or probability is not None:
            raise ValueError("a Box takes no mask and no probability")
        if seed is not None:
            self.seed(seed)
        random, low, high = self.np_random, self.low.astype(float), self.high.astype(float)
        below, above = np.isfinite(low), np.isfinite(high)
        # One of each for every number, so that a sample does not depend on the others' bounds.
        share, far, normal = (random.random(self.shape), random.exponential(size=self.shape),
                              random.normal(size=self.shape))
        start, end = np.where(below, low, 0), np.where(above, high, 0)
        drawn = np.where(below & above, start + share * (end - start), normal)
        drawn = np.where(below & ~above, start + far, drawn)
        drawn = np.where(~below & above, end - far, drawn)
        return drawn.astype(self.dtype).clip(self.low, self.high)

    def contains(self, value: Any) -> bool:
        value = np.asarray(value)
        return (value.shape == self.shape and np.can_cast(value.dtype, self.dtype)
                and bool((value >= self.low).all() and (value <= self.high).all()))

    __contains__ = contains

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, BoxBase) and self.shape == other.shape
                and self.dtype == other.dtype and np.array_equal(self.low, other.low)
                and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


def stacked(box: Box, count: int) -> Box:
    """The space of `count` such arrays, one in each row."""
    return Box(np.tile(box.low, (count,) + (1,) * box.low.ndim),
               np.tile(box.high, (count,) + (1,) * box.high.ndim), dtype=box.dtype)
