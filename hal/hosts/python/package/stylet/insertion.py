# SPDX-License-Identifier: Apache-2.0
"""Straight insertions, such as robots make and papers report."""
import functools

import numpy as np
from numpy.typing import ArrayLike

from stylet._stylet import Organ
from stylet.given import Array, direction as unit, finite, positive
from stylet.simulation import poses_of_tips
from stylet.structs import Needle


@functools.lru_cache(maxsize=8)
def kept_organ(path: str) -> Organ:
    """The organ in a file, which is read only once in each process: for functions that sweep
    calls."""
    return Organ.read(path)


def insertion_poses(organ: Organ, needle: Needle, through_m: ArrayLike, direction: ArrayLike,
                    depth_m: float, speed_m_per_s: float, hold_s: float = 0.0,
                    retract: bool = False, before_m: float = 2e-3,
                    period_s: float = 1e-3) -> Array:
    """Poses (ticks, 7) with which the tip moves along a line at constant speed: from `before_m`
    before the organ's surface to `depth_m` below it. There it rests for `hold_s`, and comes back if
    `retract` is true.

    `through_m`: a point on the line."""
    way, through = unit("direction", direction), finite("through_m", through_m, (3,)).astype(float)
    size_m = float(np.linalg.norm(np.subtract(organ.info.high_m, organ.info.low_m)))
    far = through - 2 * size_m * way
    meets_m = organ.raycast(far, way)
    if meets_m is None:
        raise ValueError(f"through_m = {through}: the line along {way} does not meet the organ")
    for name, value in (("depth_m", depth_m), ("speed_m_per_s", speed_m_per_s),
                        ("period_s", period_s)):
        positive(name, value)
    for name, value in (("hold_s", hold_s), ("before_m", before_m)):
        if finite(name, value, ()) < 0:
            raise ValueError(f"{name} = {value}: expected 0 or more")
    step_m = speed_m_per_s * period_s
    ticks = int(np.ceil((before_m + depth_m) / step_m))
    along_m = np.minimum(np.arange(ticks + 1) * step_m - before_m, depth_m)
    held = np.full(round(hold_s / period_s), depth_m)
    back = along_m[::-1] if retract else along_m[:0]
    tips_m = far + np.outer(meets_m + np.concatenate([along_m, held, back]), way)
    return poses_of_tips(tips_m, way, needle.length_m)
