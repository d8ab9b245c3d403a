# SPDX-License-Identifier: Apache-2.0
"""Checks of numbers that users give, before numpy changes them: it would take None as nan, drop
imaginary parts, and name lengths where the name of the argument would help."""
import operator
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]
Path = str | os.PathLike[str]


def real(name: str, value: ArrayLike | None, shape: tuple[int, ...] | None = None,
         none: str = "expected numbers") -> Array:
    """The value as an array of real numbers. Integers and floats of any size are accepted as they
    are; anything else is refused, with `name` in the message. `shape`: which the array must have.
    `none`: what the message says if the value is None."""
    if value is None:
        raise TypeError(f"{name} is None: {none}")
    if isinstance(value, (list, tuple)):
        for i, each in enumerate(value):
            if each is None:
                raise TypeError(f"{name}[{i}] is None: {none}")
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(f"{name}: rows of different lengths: expected an array") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} of {array.dtype}: expected real numbers")
    if shape is not None and array.shape != shape:
        wanted = "one number" if shape == () else " x ".join(map(str, shape)) + " numbers"
        raise ValueError(f"{name} of shape {array.shape}: expected {wanted}")
    return array


def finite(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Array:
    """The same, but nan and infinities are refused as well."""
    array = real(name, value, shape)
    if not np.isfinite(array).all():
        raise ValueError(f"{name} = {array}: expected finite numbers")
    return array


def positive(name: str, value: ArrayLike) -> float:
    """A number above 0, as a float."""
    value = float(finite(name, value, ()))
    if not value > 0:
        raise ValueError(f"{name} = {value}: expected more than 0")
    return value


def count(name: str, value: Any) -> int:
    """A whole number of at least 1."""
    try:
        value = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r}: expected a whole number") from None
    if value < 1:
        raise ValueError(f"{name} = {value}: expected 1 or more")
    return value


def direction(name: str, value: ArrayLike) -> Array:
    """A direction as a vector of length 1."""
    array = finite(name, value, (3,)).astype(float)
    length = np.linalg.norm(array)
    if not length > 0:
        raise ValueError(f"{name} = {array}: expected a length above 0")
    return array / length
