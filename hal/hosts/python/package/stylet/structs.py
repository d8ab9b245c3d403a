# SPDX-License-Identifier: Apache-2.0
"""What a simulation is made of: needles, obstacles and configuration.

Fields have the names and defaults of stylet.h; other names are refused. Only the library knows
which values are accepted: it refuses others when a simulation is made.
"""
from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from stylet import _stylet
from stylet.given import Array, real

# Words that scenes use for numbers.
WORDS = {"mode": ("physical", "paper"), "inertia": ("added_mass", "true_mass"),
         "hub": ("closed", "open", "syringe")}


Own = TypeVar("Own", bound="Struct")


class Struct:
    """One row of a structured array, whose fields are attributes."""
    _defaults: Callable[[], Array]
    _row: Any

    def __init__(self, **fields: Any) -> None:
        object.__setattr__(self, "_row", type(self)._defaults())
        for name, value in fields.items():
            setattr(self, name, value)

    def _checked(self, name: str) -> None:
        if name not in self._row.dtype.names:
            raise AttributeError(f"{type(self).__name__} has no field {name}; it has "
                                 + ", ".join(self._row.dtype.names))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        self._checked(name)
        value = self._row[name][0]
        return value.copy() if value.ndim else value.item()

    def __setattr__(self, name: str, value: Any) -> None:
        self._checked(name)
        if self._row.dtype[name].kind == "u":
            value = whole(name, value)
        elif self._row.dtype[name].kind == "i":
            value = operator.index(value)
        else:
            value = real(name, value, self._row[name][0].shape)
        self._row[name][0] = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Struct) and type(other) is type(self) and bool(
            (self._row == other._row).all())

    def __repr__(self) -> str:
        values = [f"{name}={getattr(self, name)!r}" for name in self._row.dtype.names]
        return f"{type(self).__name__}({', '.join(values)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (type(self), self._row)

    def replace(self: Own, **fields: Any) -> Own:
        """A copy with other values in these fields."""
        made = restored(type(self), self._row)
        for name, value in fields.items():
            setattr(made, name, value)
        return made


def restored(kind: type[Own], row: Array) -> Own:
    made = kind.__new__(kind)
    object.__setattr__(made, "_row", row.copy())
    return made


def whole(name: str, value: Any) -> int:
    """The value as an unsigned number of 32 bits; numpy would take larger ones modulo 2^32."""
    if isinstance(value, str):
        words = WORDS.get(name, ())
        if value not in words:
            raise ValueError(f"{name}: {value!r}: expected a number"
                             + "".join(f' or "{word}"' for word in words))
        return words.index(value)
    value = operator.index(value)
    if not 0 <= value < 2 ** 32:
        raise ValueError(f"{name}: {value}: expected 0 to {2 ** 32 - 1}")
    return value


class Config(Struct):
    """How the tissue is computed."""
    _defaults = _stylet.default_config
    mode: int  # or "physical", "paper"
    period_s: float
    substeps: int
    inertia: int  # or "added_mass", "true_mass"
    tissue_damping_s: float
    surround_drag_per_s: float
    hourglass_weight: float
    paper_alpha: float
    breathing_amplitude_m: Array
    breathing_period_s: float
    gravity_m_per_s2: Array  # beyond that which shaped the organ


class Needle(Struct):
    """A needle; bevel and bend face the handle's +x."""
    _defaults = _stylet.default_needle
    length_m: float
    outer_radius_m: float
    unit_m: float
    bending_nm2: float
    rods: int
    bevel_per_m: float
    bent_length_m: float
    bent_angle_rad: float
    torsion_nm2: float
    tip_half_angle_rad: float
    torn_diameters: float
    hub: int  # or "closed", "open", "syringe"; the rest is only read if it is not closed
    bore_radius_m: float
    opening_m: float  # distance of its middle from the tip
    filling_pa_s: float
    plunger_radius_m: float
    plunger_friction_n: float
    syringe_m3: float
    syringe_filled: float
    syringe_gas_m3: float

    @classmethod
    def preset(cls, name: str, **fields: Any) -> Needle:
        """The needle of this name, such as "22G-quincke"; it bends, unless bending_nm2 is 0."""
        names = _stylet.needle_presets()
        if name not in names:
            raise ValueError(f"preset: {name!r}: expected one of {', '.join(names)}")
        return restored(cls, _stylet.preset_needle(name)).replace(**fields)


class Obstacle(Struct):
    """A body that no needle enters: the convex hull of its vertices, grown by rounding_m."""
    _defaults = _stylet.default_obstacle
    vertex_count: int
    position_m: Array
    rotation_wxyz: Array
    vertices_m: Array  # (64, 3); the first vertex_count count
    rounding_m: float
    stiffness_n_per_m: float
    largest_force_n: float
    friction: float

    @classmethod
    def box(cls, half_m: ArrayLike, **fields: Any) -> Obstacle:
        """A box from -half_m to half_m around its own position."""
        x_m, y_m, z_m = map(float, real("half_m", half_m, (3,)))
        return restored(cls, _stylet.box_obstacle(x_m, y_m, z_m)).replace(**fields)

    @classmethod
    def sphere(cls, radius_m: ArrayLike, **fields: Any) -> Obstacle:
        of = float(real("radius_m", radius_m, ()))
        return restored(cls, _stylet.sphere_obstacle(of)).replace(**fields)

    @classmethod
    def hull(cls, vertices_m: ArrayLike, **fields: Any) -> Obstacle:
        """The convex hull of at most 64 points."""
        vertices_m = real("vertices_m", vertices_m)
        places = np.zeros((64, 3), np.float32)
        if vertices_m.ndim != 2 or vertices_m.shape[1] != 3 or len(vertices_m) > len(places):
            raise ValueError(f"vertices_m of shape {vertices_m.shape}: expected (n, 3), n at most"
                             f" {len(places)}")
        places[:len(vertices_m)] = vertices_m
        return cls(vertex_count=len(vertices_m), vertices_m=places, rounding_m=0).replace(**fields)
