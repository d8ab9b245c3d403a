# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

class Refused(ValueError): ...

class Frame:
    def __init__(self, origin_m: Sequence[float], step_m: Sequence[Sequence[float]],
                 names: dict[int, str], source: str) -> None: ...

class MeshArrays:
    def __init__(self, name: str, source: str, vertices_m: NDArray[np.float64],
                 faces: NDArray[np.int64], tissue: str, priority: int) -> None: ...

def build_from_labels(labels: NDArray[Any], axes: Sequence[int], frame: Frame,
                      recipe: str | dict[str, Any], recipe_text: str,
                      materials: str | dict[str, Any] | None, materials_text: str,
                      options: dict[str, Any],
                      progress: Callable[[str, float], object] | None) -> dict[str, Any]: ...
def build_from_meshes(meshes: list[MeshArrays], materials: str | dict[str, Any] | None,
                      materials_text: str, options: dict[str, Any],
                      progress: Callable[[str, float], object] | None) -> dict[str, Any]: ...
def presets() -> dict[str, dict[str, Any]]: ...
def version() -> str: ...
