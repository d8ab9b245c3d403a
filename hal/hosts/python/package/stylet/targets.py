# SPDX-License-Identifier: Apache-2.0
"""Targets to reach and zones to keep out of, such as the [[targets]] of a scene.

They are places in the organ at rest, and do not move with the tissue.
"""
import dataclasses

import numpy as np
from numpy.typing import ArrayLike

from stylet.given import Path, finite, positive
from stylet.scene import read


@dataclasses.dataclass(frozen=True)
class Target:
    name: str
    at_m: tuple[float, ...]
    radius_m: float
    forbidden: bool = False


def read_targets(path: Path) -> list[Target]:
    """The targets of a scene's file, in its order. hal/scene/README.md has their keys."""
    rows = read(path).get("targets", [])
    if not rows:
        raise ValueError(f"{path}: no [[targets]]: expected at least one")
    for i, row in enumerate(rows):
        for key in ("name", "at_mm", "radius_mm"):
            if key not in row:
                raise ValueError(f"{path}: targets[{i}].{key}: missing: expected it in each target")
        finite(f"{path}: targets[{i}].at_mm", row["at_mm"], (3,))
        positive(f"{path}: targets[{i}].radius_mm", row["radius_mm"])
    return [Target(row["name"], tuple(1e-3 * float(x) for x in row["at_mm"]),
                   1e-3 * float(row["radius_mm"]), bool(row.get("forbidden", False)))
            for row in rows]


def distance_to_segment_m(at_m: ArrayLike, from_m: ArrayLike, to_m: ArrayLike) -> float:
    """The distance of a place from a straight line segment, such as the shaft."""
    at, start, way = (np.asarray(at_m, float), np.asarray(from_m, float),
                      np.subtract(to_m, from_m, dtype=float))
    square = way @ way
    share = np.clip((at - start) @ way / square, 0, 1) if square > 0 else 0
    return float(np.linalg.norm(at - start - share * way))
