# SPDX-License-Identifier: Apache-2.0
"""Simulations of needles in an organ: one, or many at once."""
from __future__ import annotations

import copy
from collections.abc import Iterable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from stylet import _stylet
from stylet._stylet import Organ
from stylet.given import Array, real
from stylet.structs import Config, Needle, Obstacle, Struct

Own = TypeVar("Own", bound="Simulation")


def rows_of(structs: Struct | Iterable[Struct], kind: type[Struct]) -> list[Array]:
    """The rows of one struct or several."""
    structs = [structs] if isinstance(structs, kind) else list(structs)
    for each in structs:
        if not isinstance(each, kind):
            raise TypeError(f"{each!r}: expected a stylet.{kind.__name__}")
    return [each._row for each in structs]


class Simulation(_stylet.Simulation):
    """Needles in an organ.

    The arrays that `tick`, `surface` and `particles` return are the simulation's own memory: they
    can only be read, and the next such call overwrites them, so copy what you want to keep. The
    array that `run` returns belongs to the caller. Use a simulation in one thread at a time; other
    Python threads can run while ticks are computed.
    """

    def __init__(self, organ: Organ, needles: Needle | Iterable[Needle] | None = None,
                 config: Config | None = None,
                 obstacles: Obstacle | Iterable[Obstacle] = ()) -> None:
        _stylet.refuse_second_init(self)
        needles = Needle() if needles is None else needles
        config = Config() if config is None else config
        super().__init__(organ, rows_of(needles, Needle), *rows_of(config, Config),
                         rows_of(obstacles, Obstacle))
        self.organ = organ

    def __repr__(self) -> str:
        return f"<stylet.{type(self).__name__} in {self.organ!r}: needles {self.needles}>"

    def clone(self: Own) -> Own:
        """A second simulation in the same state; both share the organ."""
        other = type(self).__new__(type(self))
        _stylet.Simulation.__init__(other, self)
        vars(other).update(vars(self))  # also what a class of one's own has
        return other

    def __copy__(self: Own) -> Own:
        return self.clone()

    def __deepcopy__(self: Own, memo: dict[int, Any]) -> Own:
        other = self.clone()
        memo[id(self)] = other
        vars(other).update(copy.deepcopy(vars(self), memo))
        return other

    def set_obstacles(self, obstacles: Obstacle | Iterable[Obstacle]) -> None:
        """Bodies fixed in the world; they replace those given before. Only before the first
        tick."""
        self._set_obstacles(rows_of(obstacles, Obstacle))


class VectorSimulation:
    """Many simulations, which threads of the library run at once.

    `threads`: how many; 0: one on each processor. The results do not depend on it.
    """

    def __init__(self, simulations: Iterable[Simulation], threads: int = 0) -> None:
        self.simulations, self._threads = tuple(simulations), threads
        self._batch = _stylet.Batch(self.simulations, threads)

    def __repr__(self) -> str:
        return f"<stylet.VectorSimulation of {len(self)}, threads {self._threads}>"

    def __len__(self) -> int:
        return len(self.simulations)

    def __deepcopy__(self, memo: dict[int, Any]) -> VectorSimulation:
        return type(self)(copy.deepcopy(self.simulations, memo), self._threads)

    def run(self, poses: ArrayLike, valid: ArrayLike | None = None,
            out: Array | None = None) -> Any:
        """Poses (simulations, ticks, needles, 7) give outputs (simulations, ticks, needles).

        If there is one needle, its axis may be left out. If `out` is given, it is filled and
        returned."""
        outputs = self._batch.run(poses, valid, out)
        return outputs.view(np.recarray) if out is None else outputs


def inputs(poses: ArrayLike, valid: ArrayLike = True, plunger_n: ArrayLike = 0) -> Array:
    """Poses (..., 7), and the force on a syringe's plunger at each, as an array of `input_dtype`,
    which simulations read where it lies."""
    poses = real("poses", poses, none="where a tick has no sample, say so in valid")
    if poses.shape[-1:] != (7,):
        raise ValueError(f"poses of shape {poses.shape}: expected (..., 7)")
    rows = np.empty(poses.shape[:-1], _stylet.input_dtype)
    rows["struct_bytes"] = _stylet.input_dtype.itemsize
    rows["valid"] = valid
    rows["position_m"] = poses[..., :3]
    rows["rotation_wxyz"] = poses[..., 3:]
    rows["plunger_n"] = plunger_n
    return rows


def poses_of_tips(tips_m: ArrayLike, direction: ArrayLike, length_m: float) -> Array:
    """Poses (ticks, 7) whose unbent needle has its tip at each place and points in a direction."""
    tips_m = real("tips_m", tips_m).astype(np.float32, copy=False)
    if tips_m.ndim != 2 or tips_m.shape[1] != 3:
        raise ValueError(f"tips_m of shape {tips_m.shape}: expected (ticks, 3)")
    poses = np.empty((len(tips_m), 7), np.float32)
    poses[:] = _stylet.pose_of_tip((0, 0, 0), direction, length_m)
    poses[:, :3] += tips_m
    return poses
