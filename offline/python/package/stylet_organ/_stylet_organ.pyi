# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

class Refused(ValueError): ...

# Origin and steps of the axes in m, names of labels, the file that the array was read from or "".
Frame = tuple[Sequence[float], Sequence[Sequence[float]], dict[int, str], str]
# Name, file or "", vertices in m, faces, tissue, priority.
MeshArrays = tuple[str, str, NDArray[np.float64], NDArray[np.int64], str, int]

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
