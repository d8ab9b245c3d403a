# SPDX-License-Identifier: Apache-2.0
"""A picture of an organ with a needle in it, drawn without a screen."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from stylet.given import Array
from stylet.simulation import Simulation

if TYPE_CHECKING:
    from stylet.targets import Target

INK, NEEDLE, TARGET, FORBIDDEN = "#1d2733", "#1d2733", "#009e73", "#c24e00"
SKIN = np.array([0.86, 0.62, 0.58])
SIZE_PX = (480, 480)
SEE_THROUGH = 0.35  # share of light that the surface keeps back, so that needle and targets show


def picture(simulation: Simulation, targets: Iterable[Target] = (),
            direction: ArrayLike = (0, 0, -1)) -> Array:
    """The deformed surface, the needles and the targets as an array (height, width, 3) of bytes.

    It is a parallel projection from the side, in which `direction` points down."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    right, down, away = axes_of(direction)
    flat = np.stack([right, -down], 1)
    corners = simulation.surface()[simulation.organ.triangles]
    corners = corners[np.argsort(-(corners @ away).mean(axis=1))]  # the far ones first
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sizes = np.linalg.norm(normals, axis=1)
    light = 0.55 + 0.45 * np.abs(normals @ away) / np.where(sizes > 0, sizes, 1)

    figure = Figure(figsize=(SIZE_PX[0] / 100, SIZE_PX[1] / 100), dpi=100)
    canvas = FigureCanvasAgg(figure)
    panel = figure.add_axes((0, 0, 1, 1))
    panel.add_collection(PolyCollection(corners @ flat, facecolors=light[:, None] * SKIN,
                                        edgecolors="none", alpha=SEE_THROUGH))
    for target in targets:
        middle = np.asarray(target.at_m) @ flat
        colour = FORBIDDEN if target.forbidden else TARGET
        panel.add_artist(circle(middle, target.radius_m, colour))
    for needle in range(simulation.needles):
        shape = simulation.needle_shape(needle) @ flat
        panel.plot(*shape.T, color=NEEDLE, linewidth=1.5)
    places = corners.reshape(-1, 3) @ flat
    low, high = places.min(axis=0), places.max(axis=0)
    middle, half = (low + high) / 2, 0.6 * (high - low).max()
    panel.set(xlim=(middle[0] - half, middle[0] + half),
              ylim=(middle[1] - half, middle[1] + half), aspect="equal")
    panel.axis("off")
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()


def circle(middle: Array, radius: float, colour: str) -> Any:
    from matplotlib.patches import Circle
    return Circle(middle, radius, facecolor="none", edgecolor=colour, linewidth=1.5)


def axes_of(direction: ArrayLike) -> tuple[Array, Array, Array]:
    """Unit vectors to the right, down and away from the viewer, at right angles; down is the
    direction."""
    down = np.asarray(direction, float) / np.linalg.norm(direction)
    away = np.cross(down, np.eye(3)[np.argmin(np.abs(down))])
    away /= np.linalg.norm(away)
    return np.cross(down, away), down, away
