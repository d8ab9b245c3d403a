# SPDX-License-Identifier: Apache-2.0
"""Places to reach and zones to keep out of, as the [[targets]] of a scene.

They are places in the organ at rest: they do not move with the tissue.
"""
import dataclasses

import numpy as np
from numpy.typing import ArrayLike

from stylet.given import Path
from stylet.scene import read


@dataclasses.dataclass(frozen=True)
class Target:
    name: str
    at_m: tuple[float, ...]
    radius_m: float
    forbidden: bool = False


def read_targets(path: Path) -> list[Target]:
    """Those of a scene's file, in its order. Keys: hal/scene/README.md."""
    rows = read(path).get("targets", [])
    targets = [Target(row["name"], tuple(1e-3 * float(x) for x in row["at_mm"]),
                      1e-3 * float(row["radius_mm"]), bool(row.get("forbidden", False)))
               for row in rows]
    if not targets:
        raise ValueError(f"{path}: no [[targets]]")
    return targets


def distance_to_segment_m(at_m: ArrayLike, from_m: ArrayLike, to_m: ArrayLike) -> float:
    """How far a place is from a straight piece, such as the shaft."""
    at, start, way = (np.asarray(at_m, float), np.asarray(from_m, float),
                      np.subtract(to_m, from_m, dtype=float))
    square = way @ way
    share = np.clip((at - start) @ way / square, 0, 1) if square > 0 else 0
    return float(np.linalg.norm(at - start - share * way))
