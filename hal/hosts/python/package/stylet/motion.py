# SPDX-License-Identifier: Apache-2.0
"""A handle that a learner moves: velocities in its own axes, as poses of every tick.

Frames: the handle's, whose needle points along -z, and the world. Source: Kuipers, Quaternions and
Rotation Sequences, 1999.
"""
import numpy as np

# Unit quaternions to 32 bits; a pose is normalised again where it is this far off.
QUATERNION_DRIFT = 1e-7


def product(a, b):
    """The rotation by b, then by a; quaternions w, x, y, z."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return np.array([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw])


def rotated(q, v):
    """The vector, turned from the handle's axes to the world's."""
    return product(product(q, np.array([0.0, *v])), q * [1, -1, -1, -1])[1:]


def turn(angle_rad):
    """The rotation about the vector by its length."""
    angle = float(np.linalg.norm(angle_rad))
    if angle == 0:
        return np.array([1.0, 0, 0, 0])
    return np.array([np.cos(angle / 2), *(np.sin(angle / 2) / angle * np.asarray(angle_rad))])


def moved(pose, velocity_m_per_s, turning_rad_per_s, period_s, ticks):
    """Poses (ticks, 7) of 64 bits that follow the pose with constant velocities in its axes."""
    poses = np.empty((ticks, 7))
    at, q = pose[:3], pose[3:]
    way, step = np.asarray(velocity_m_per_s) * period_s, turn(
        np.asarray(turning_rad_per_s) * period_s)
    for i in range(ticks):
        at = at + rotated(q, way)
        q = product(q, step)
        size = np.linalg.norm(q)
        if abs(size - 1) > QUATERNION_DRIFT:
            q = q / size
        poses[i, :3], poses[i, 3:] = at, q
    return poses
