# SPDX-License-Identifier: Apache-2.0
"""A space of numbers between two bounds, as Gymnasium has it: the part of it that learners use."""
import numpy as np


class Box:
    """Arrays between `low` and `high`, which may be infinite."""

    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        shape = np.broadcast(low, high).shape if shape is None else tuple(shape)
        self.low = np.broadcast_to(np.asarray(low, dtype), shape)
        self.high = np.broadcast_to(np.asarray(high, dtype), shape)
        if not (self.low <= self.high).all():
            raise ValueError("low is above high")
        self.shape, self.dtype = shape, np.dtype(dtype)
        self.seed(seed)

    def seed(self, seed=None):
        self._random = np.random.default_rng(seed)

    def sample(self, seed=None):
        """Uniform between two bounds, exponential from one, normal without any."""
        if seed is not None:
            self.seed(seed)
        random, low, high = self._random, self.low.astype(float), self.high.astype(float)
        below, above = np.isfinite(low), np.isfinite(high)
        # One of each for every number, so that a sample does not depend on the others' bounds.
        share, far, normal = (random.random(self.shape), random.exponential(size=self.shape),
                              random.normal(size=self.shape))
        start, end = np.where(below, low, 0), np.where(above, high, 0)
        drawn = np.where(below & above, start + share * (end - start), normal)
        drawn = np.where(below & ~above, start + far, drawn)
        drawn = np.where(~below & above, end - far, drawn)
        return drawn.astype(self.dtype).clip(self.low, self.high)

    def contains(self, value):
        value = np.asarray(value)
        return (value.shape == self.shape and np.can_cast(value.dtype, self.dtype)
                and bool((value >= self.low).all() and (value <= self.high).all()))

    __contains__ = contains

    def __eq__(self, other):
        return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self):
        return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


def stacked(box, count):
    """The space of `count` of them, one a row."""
    return Box(np.tile(box.low, (count,) + (1,) * box.low.ndim),
               np.tile(box.high, (count,) + (1,) * box.high.ndim), dtype=box.dtype)
