# SPDX-License-Identifier: Apache-2.0
"""What an environment needs from a scene's file besides its targets: organ, obstacles and
direction.

hal/scene/README.md has the keys and defaults.
"""
import json
import pathlib
import subprocess
import tomllib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stylet import place
from stylet._stylet import Organ
from stylet.given import Array, Path, real
from stylet.motion import product, turns
from stylet.structs import Obstacle

SHAPES = {"box": "size_mm", "sphere": "radius_mm", "hull": "hull"}
RECIPE = "\n# organ: stylet-organ "  # hal/app/organ_recipe.h
KEYS = {"shape", "at_mm", "turn_deg", "stiffness_n_per_mm", "largest_force_n", "friction"}


def read(path: Path) -> dict[str, Any]:
    with open(path, "rb") as file:
        return tomllib.load(file)


def scene_file(given: Path) -> pathlib.Path:
    """The file of a scene. It is given as a file, or by the name of a scene that comes with Stylet,
    such as "lumbar-puncture"; if there is a file of that name, it is taken."""
    path = pathlib.Path(given)
    if path.exists() or path.parent != pathlib.Path() or path.suffix == ".toml":
        return path
    if place.program() is None:
        raise FileNotFoundError(f"{given}: no such file; scenes that are run by their name come "
                                "with the programs (Debian: package stylet)")
    known = {row["name"]: row["file"] for row in json.loads(asked("--json"))}
    if given not in known:
        raise FileNotFoundError(f"{given}: no such file, and no scene of this name: there are "
                                + " ".join(known))
    return pathlib.Path(known[given])


def scene_organ(path: Path) -> Organ:
    """The organ that a scene's file names, relative to that file. The organ of a scene that comes
    with Stylet is made on first use and kept, as `stylet run` does."""
    name = read(path).get("organ", {}).get("path")
    if not isinstance(name, str):
        raise ValueError(f"{path}: organ.path = {name!r}: expected an organ's file")
    organ = pathlib.Path(path).parent / name
    if not organ.exists() and RECIPE in pathlib.Path(path).read_text():
        organ = made_organ(path, organ)
    return Organ.read(organ)


def made_organ(path: Path, organ: pathlib.Path) -> pathlib.Path:
    """The file of the organ, which the program makes unless it is there."""
    if place.program() is None:
        raise FileNotFoundError(f"{organ}: no such file: `stylet run {path}` makes it once "
                                "(Debian: package stylet)")
    try:
        return pathlib.Path(asked("--organ", path).rstrip("\n"))
    except subprocess.CalledProcessError as error:
        raise FileNotFoundError(f"{organ}: no such file, and `stylet run {path}` does not make it: "
                                + error.stderr.strip()) from None


def asked(*words: Path) -> str:
    """What `stylet scenes` answers."""
    return subprocess.run([place.program() or "stylet", "scenes", *map(str, words)], check=True,
                          capture_output=True, text=True).stdout


def scene_direction(path: Path) -> Array:
    """The direction of insertion; its length is any but zero."""
    return read(path).get("approach", {}).get("direction", [1, 0, 0])


def read_obstacles(path: Path) -> list[Obstacle]:
    """The bodies of a scene's file that no needle enters, in its order; stylet-organ also writes
    such files, for a label map. An empty list if the scene has none."""
    rows = read(path).get("obstacles", [])
    return [obstacle(path, f"obstacles[{i}]", row) for i, row in enumerate(rows)]


def obstacle(path: Path, place: str, row: dict[str, Any]) -> Obstacle:
    shape = row.get("shape")
    if shape not in SHAPES:
        raise ValueError(f"{path}: {place}.shape = {shape!r}: expected one of {list(SHAPES)}")
    keys = KEYS | {SHAPES[shape]}
    for key in (SHAPES[shape], "at_mm"):
        if key not in row:
            raise ValueError(f"{path}: {place}.{key}: missing: expected with shape {shape!r}")
    for key in row.keys() - keys:
        raise ValueError(f"{path}: {place}.{key}: unknown: expected one of {sorted(keys)}")

    def number(key: str, default: ArrayLike | None, count: tuple[int, ...] = ()) -> Array:
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


def turned(degrees: ArrayLike) -> Array:
    """The quaternion of a rotation about the world's x, then y, then z."""
    result = np.array([1.0, 0, 0, 0])
    for axis, angle in zip(np.eye(3), np.radians(degrees)):
        result = product(turns(angle * axis, [1.0])[0], result)
    return result
