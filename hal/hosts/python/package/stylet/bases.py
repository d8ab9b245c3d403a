# SPDX-License-Identifier: Apache-2.0
"""What environments and spaces inherit from: Gymnasium's classes if it is installed, so that its
wrappers and learners accept them; otherwise the part of these classes that is used here.

Source: Gymnasium's published interface (gymnasium.Env, gymnasium.vector.VectorEnv,
gymnasium.spaces.Box).
"""
from __future__ import annotations

from typing import Any

import numpy as np

NEXT_STEP: Any = "NextStep"  # an environment that has ended begins anew in the next step


class Drawing:
    """A generator of random numbers that remembers its seed."""
    _np_random: Any = None
    _np_random_seed: Any = None

    def _seed(self, seed: int | None) -> np.random.Generator:
        sequence = np.random.SeedSequence(seed)
        self._np_random_seed = sequence.entropy
        self._np_random = generator = np.random.default_rng(sequence)
        return generator

    @property
    def np_random(self) -> np.random.Generator:
        return self._seed(None) if self._np_random is None else self._np_random

    @np_random.setter
    def np_random(self, generator: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = generator, -1

    @property
    def np_random_seed(self) -> int:
        """-1: unknown."""
        if self._np_random is None:
            self._seed(None)
        return self._np_random_seed


class OwnEnv(Drawing):
    metadata: dict[str, Any] = {"render_modes": []}
    render_mode: str | None = None
    spec = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> Any:
        if seed is not None:
            self._seed(seed)

    @property
    def unwrapped(self) -> Any:
        return self

    def has_wrapper_attr(self, name: str) -> bool:
        return hasattr(self, name)

    def get_wrapper_attr(self, name: str) -> Any:
        return getattr(self, name)

    def set_wrapper_attr(self, name: str, value: Any, *, force: bool = True) -> bool:
        if not force and not hasattr(self, name):
            return False
        setattr(self, name, value)
        return True

    def close(self) -> None:
        pass

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class OwnVectorEnv(Drawing):
    metadata: dict[str, Any] = {}
    render_mode: str | None = None
    spec = None
    closed = False

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> Any:
        if seed is not None:
            self._seed(seed)

    @property
    def unwrapped(self) -> Any:
        return self

    def close(self, **options: Any) -> None:
        if not self.closed:
            self.close_extras(**options)
            self.closed = True

    def close_extras(self, **options: Any) -> None:
        pass


class OwnBox(Drawing):
    def __init__(self, low: np.ndarray, high: np.ndarray, shape: tuple[int, ...], dtype: Any,
                 seed: int | None) -> None:
        self.low, self.high, self.shape, self.dtype = low, high, shape, np.dtype(dtype)
        if seed is not None:
            self.seed(seed)

    def seed(self, seed: int | None = None) -> int:
        self._seed(seed)
        return self.np_random_seed


Env: Any = OwnEnv
VectorEnv: Any = OwnVectorEnv
BoxBase: Any = OwnBox
try:
    import gymnasium
    import gymnasium.vector
except ImportError:
    pass
else:
    Env, VectorEnv, BoxBase = gymnasium.Env, gymnasium.vector.VectorEnv, gymnasium.spaces.Box
    if hasattr(gymnasium.vector, "AutoresetMode"):
        NEXT_STEP = gymnasium.vector.AutoresetMode.NEXT_STEP
