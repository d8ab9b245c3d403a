# SPDX-License-Identifier: Apache-2.0
"""The motion of a handle that a learner moves: velocities in the handle's axes become a pose for
each tick.

Frames: the handle's, whose needle points along -z, and the world. Source: Kuipers, Quaternions and
Rotation Sequences, 1999.
"""
import numpy as np
from numpy.typing import ArrayLike

from stylet.given import Array


def product(a: Array, b: Array) -> Array:
    """The rotation by b, then by a; quaternions w, x, y, z in the last axis."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw],
                    axis=-1)


def rotated(q: Array, v: Array) -> Array:
    """The vector, turned from the handle's axes to the world's."""
    around = product(product(q, np.array([0.0, *v])), q * [1, -1, -1, -1])
    return around[..., 1:]


def turns(velocity_rad_per_s: ArrayLike, times_s: ArrayLike) -> Array:
    """The rotations by which a constant velocity has turned it at each time."""
    velocity = np.asarray(velocity_rad_per_s, float)
    speed = np.linalg.norm(velocity)
    half = 0.5 * speed * np.asarray(times_s)
    axis = velocity / speed if speed > 0 else velocity
    return np.concatenate([np.cos(half)[:, None], np.sin(half)[:, None] * axis], axis=1)


def moved(pose: Array, velocity_m_per_s: ArrayLike, turning_rad_per_s: ArrayLike, period_s: float,
          ticks: int) -> Array:
    """Poses (ticks, 7) in double precision that follow the pose, with constant velocities in the
    handle's axes."""
    rotations = product(pose[3:], turns(turning_rad_per_s, period_s * np.arange(ticks + 1)))
    # Unit length again each time, so that no error grows over an episode.
    rotations /= np.linalg.norm(rotations, axis=1)[:, None]
    ways = rotated(rotations[:-1], np.asarray(velocity_m_per_s) * period_s)
    return np.concatenate([pose[:3] + np.cumsum(ways, axis=0), rotations[1:]], axis=1)
