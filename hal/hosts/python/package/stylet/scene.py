# SPDX-License-Identifier: Apache-2.0
"""What of a scene's file an environment needs besides its targets: organ, obstacles, the way in.

Keys and defaults are those of hal/scene/README.md.
"""
import pathlib
import tomllib

import numpy as np

from stylet import _stylet
from stylet.given import real
from stylet.motion import product, turns
from stylet.structs import Obstacle

SHAPES = {"box": "size_mm", "sphere": "radius_mm", "hull": "hull"}
KEYS = {"shape", "at_mm", "turn_deg", "stiffness_n_per_mm", "largest_force_n", "friction"}


def read(path):
    with open(path, "rb") as file:
        return tomllib.load(file)


def scene_organ(path):
    """The organ that a scene's file names, relative to it."""
    name = read(path).get("organ", {}).get("path")
    if not isinstance(name, str):
        raise ValueError(f"{path}: organ.path = {name!r}: expected an organ's file")
    return _stylet.Organ.read(pathlib.Path(path).parent / name)


def scene_direction(path):
    """Of insertion, of any length but zero."""
    return read(path).get("approach", {}).get("direction", [1, 0, 0])


def read_obstacles(path):
    """The bodies that no needle enters, of a scene's file, in its order; also such as stylet-organ
    writes for a label map. Of a scene without any, an empty list."""
    rows = read(path).get("obstacles", [])
    return [obstacle(path, f"obstacles[{i}]", row) for i, row in enumerate(rows)]


def obstacle(path, place, row):
    shape = row.get("shape")
    if shape not in SHAPES:
        raise ValueError(f"{path}: {place}.shape = {shape!r}: expected one of {list(SHAPES)}")
    keys = KEYS | {SHAPES[shape]}
    for key in (SHAPES[shape], "at_mm"):
        if key not in row:
            raise ValueError(f"{path}: {place}.{key}: missing: expected with shape {shape!r}")
    for key in row.keys() - keys:
        raise ValueError(f"{path}: {place}.{key}: unknown: expected one of {sorted(keys)}")

    def number(key, default, count=()):
        return real(f"{path}: {place}.{key}", row.get(key, default), count)
    if shape == "box":
        body = Obstacle.box(0.5e-3 * number("size_mm", None, (3,)))
    elif shape == "sphere":
        body = Obstacle.sphere(1e-3 * number("radius_mm", None))
    else:
        body = Obstacle.hull(read(pathlib.Path(path).parent / row["hull"])["vertices_m"])
    return body.replace(position_m=1e-3 * number("at_mm", None, (3,)),
                        rotation_wxyz=turned(number("turn_deg", [0, 0, 0], (3,))),
                        stiffness_n_per_m=1e3 * number("stiffness_n_per_mm",
                                                       1e-3 * body.stiffness_n_per_m),
                        largest_force_n=number("largest_force_n", body.largest_force_n),
                        friction=number("friction", body.friction))


def turned(degrees):
    """The quaternion of turns about the world's x, then y, then z."""
    result = np.array([1.0, 0, 0, 0])
    for axis, angle in zip(np.eye(3), np.radians(degrees)):
        result = product(turns(angle * axis, [1.0])[0], result)
    return result
