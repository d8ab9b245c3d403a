# SPDX-License-Identifier: GPL-3.0-or-later
"""Organs for stylet from numpy: label arrays of segmentations, and surface meshes.

The same organ, byte for byte, as the program stylet-organ makes of a file with the same content.

    built = stylet_organ.from_labels(labels, {1: "liver"}, spacing_m=(0.001, 0.001, 0.002))
    simulation = stylet.Simulation(built.organ, stylet.Needle())

Units: SI, but in texts that the program's options have too, such as "z<10%" or "fat:10" (mm).
Frame: the patient's, x to the left, y to the back, z to the head (LPS).
"""
import collections.abc
import dataclasses
import decimal
import functools
import json
import operator
import os
import re
import warnings

import numpy as np

from stylet_organ import _stylet_organ
from stylet_organ._stylet_organ import Refused

__all__ = ["Built", "Mesh", "Refused", "TISSUES", "affine_m_of_nifti", "from_labels", "from_mesh",
           "from_meshes"]
__version__ = _stylet_organ.version().split()[-1]

# The presets: a dict of numbers for each, by the keys of a table of --materials.
TISSUES = _stylet_organ.presets()

OPTIONS = ("name", "voxel_edge_m", "voxels_across", "capsule", "fix", "crop", "layers", "layers_of",
           "layers_along", "membranes", "slides", "refine", "fill_gaps", "split_gaps")
LISTS = ("fix", "crop", "layers", "membranes", "slides", "refine")


@dataclasses.dataclass(frozen=True)
class Built:
    """What a build made: `content`, the bytes of an organ's file, and what lies beside it."""
    content: bytes
    warnings: tuple[str, ...]
    obstacles: dict[str, np.ndarray]  # vertices in m, for stylet.Obstacle.hull
    targets: tuple[tuple[str, tuple[float, float, float], float], ...]  # name, at_m, radius_m

    @functools.cached_property
    def organ(self):
        """As a stylet.Organ."""
        import stylet
        return stylet.Organ.from_bytes(self.content)

    def write(self, path):
        """The organ's file; it appears whole or not at all."""
        partial = f"{os.fspath(path)}.{os.getpid()}.tmp"
        try:
            with open(partial, "wb") as file:
                file.write(self.content)
            os.replace(partial, path)
        finally:
            if os.path.exists(partial):
                os.remove(partial)


@dataclasses.dataclass(frozen=True)
class Mesh:
    """A surface: vertices (n, 3) in m, triangles (m, 3) of their numbers. Where several overlap,
    the one with the higher priority has the voxel. `source`: the file that it was read from."""
    vertices_m: np.ndarray
    faces: np.ndarray
    tissue: str = "liver"
    priority: int = 0
    source: str | os.PathLike | None = None


def from_labels(labels, tissues=None, *, recipe=None, spacing_m=None, origin_m=None, affine_m=None,
                order="zyx", names=None, source=None, materials=None, progress=None,
                **options):
    """An organ of a label array, 0 where there is nothing.

    `tissues` says which label is which tissue, {1: "liver", 2: "vessel", 7: None}; what it does not
    name becomes nothing, with a warning unless it is None there. Or `recipe` says so, which chooses
    among labels: the path of a recipe's file or a dict of its tables. `order` names the array's
    axes: "zyx" as SimpleITK and pydicom have them, "xyz" as nibabel has. `spacing_m` and
    `origin_m`, the middle of the first voxel (0, 0, 0 if not given), are along x, y and z; or
    `affine_m`, 4 x 4, leads from numbers of voxels (x, y, z) to places. `names` are those of
    labels, for recipes that use them. `source` is the file that the array was read from: the organ
    then tells its name and SHA-256, otherwise those of the array. `materials` is the path of a file
    with tissues of your own, or a dict of its tables.
    `progress` is called with a stage and how much of it is done; what it raises ends the build, as
    Ctrl-C does. Options, with the program's defaults: name, voxel_edge_m, voxels_across, capsule,
    fix, crop, layers, layers_of, layers_along, membranes, slides, refine, fill_gaps, split_gaps;
    texts as the program's: in mm, and so is a membrane's mesh file.

    Returns Built. What the program would warn of is a UserWarning here, what it would refuse is
    Refused, a ValueError: in its words, with the names of arguments for its options."""
    labels = unmasked("labels", labels)
    if not labels.dtype.isnative:
        labels = labels.astype(labels.dtype.newbyteorder("="))
    if (tissues is None) == (recipe is None):
        raise TypeError("expected either tissues or a recipe")
    if recipe is None:
        recipe = recipe_of(tissues)
    frame = (*placed(spacing_m, origin_m, affine_m), names_of(names or {}),
             "" if source is None else os.fspath(source))
    recipe, recipe_text = path_or_tables("recipe", recipe)
    result = called(_stylet_organ.build_from_labels, labels, axes_of(order), frame, recipe,
                    recipe_text, *path_or_tables("materials", materials), checked(options, OPTIONS),
                    progress)
    if tissues is not None:
        result["warnings"] += unnamed(result["voxels_of_labels"], tissues, names or {})
    return finished(result)


def from_mesh(vertices_m, faces, tissue="liver", **options):
    """An organ of one closed surface; options are those of from_meshes."""
    return from_meshes([Mesh(vertices_m, faces, tissue)], **options)


def from_meshes(meshes, *, materials=None, progress=None, **options):
    """An organ of surfaces, each a Mesh. Options are those of from_labels (but a membrane's
    mesh file is in m, as these are), and `wrap`: a closed
    skin around each, for those that are not closed; what it does to holes and volume is told."""
    meshes = list(meshes)
    if not meshes:
        raise ValueError("meshes: expected one at least")
    arrays = [arrays_of(f"mesh{i}" if len(meshes) > 1 else "mesh", each)
              for i, each in enumerate(meshes)]
    return finished(called(_stylet_organ.build_from_meshes, arrays,
                           *path_or_tables("materials", materials),
                           checked(options, (*OPTIONS, "wrap")), progress))


def affine_m_of_nifti(affine):
    """`affine_m` of an affine as nibabel has it, which leads to mm, right, front and head (RAS)."""
    return np.diag([-1e-3, -1e-3, 1e-3, 1]) @ np.asarray(affine, float)


# ---- what the module takes ----------------------------------------------------------------------

def recipe_of(tissues):
    """The tables of a recipe in which a tissue has these labels."""
    if not isinstance(tissues, collections.abc.Mapping):
        raise TypeError(f"tissues: {tissues!r}: expected a dict, such as {{1: 'liver'}}")
    labels = {}
    for label, tissue in tissues.items():
        if tissue is not None:
            labels.setdefault(str(tissue), []).append(label)
    return {"tissues": labels}


def unnamed(voxels, tissues, names):
    """The warning of labels that are there and that nobody named."""
    others = [label for label in voxels if label not in tissues and names.get(label) not in tissues]
    if not others:
        return []
    most, share = 8, sum(voxels[label] for label in others) / sum(voxels.values())
    told = ", ".join(map(str, others[:most])) + (", ..." if len(others) > most else "")
    return [f"labels: {told}: {100 * share:.2g} % of what is labelled is of no tissue, and becomes "
            "nothing: expected these labels in tissues, with None if that is meant"]


def names_of(names):
    for label in names:
        if not 0 < operator.index(label) < 65536:
            raise ValueError(f"names: {label}: expected a label from 1 to 65535")
    return {operator.index(label): str(name) for label, name in names.items()}


def placed(spacing_m, origin_m, affine_m):
    """The first voxel's middle, and the step along each axis of voxels."""
    if (spacing_m is None) == (affine_m is None):
        raise TypeError("expected either spacing_m or affine_m")
    if affine_m is None:
        spacing = numbers("spacing_m", spacing_m, (3,))
        if not (spacing > 0).all():
            raise ValueError(f"spacing_m = {spacing}: expected more than 0; axes that run the "
                             "other way are for affine_m")
        steps = np.diag(spacing)
        origin = numbers("origin_m", (0, 0, 0) if origin_m is None else origin_m, (3,))
        return origin.tolist(), steps.tolist()
    if origin_m is not None:
        raise TypeError("origin_m beside affine_m, whose last column is the origin: expected one "
                        "of them")
    affine = numbers("affine_m", affine_m, (4, 4))
    if not np.array_equal(affine[3], [0, 0, 0, 1]):
        raise ValueError(f"affine_m: last row {affine[3]}: expected 0, 0, 0, 1")
    return affine[:3, 3].tolist(), affine[:3, :3].T.tolist()


def unmasked(name, value):
    """As an array, which would forget what is masked."""
    if np.ma.is_masked(value):
        raise ValueError(f"{name}: {np.ma.count_masked(value)} of {np.size(value)} are masked: "
                         "expected an array without a mask, such as numpy.ma.filled(array, 0)")
    return np.asarray(value)


def numbers(name, value, shape):
    value = unmasked(name, value).astype(float)
    if value.shape != shape:
        raise ValueError(f"{name} of shape {value.shape}: expected {shape}")
    if not np.isfinite(value).all():
        raise ValueError(f"{name} = {value}: expected finite numbers")
    return value


def axes_of(order):
    if sorted(order) != ["x", "y", "z"]:
        raise ValueError(f"order {order!r}: expected the axes' names, such as 'zyx' or 'xyz'")
    return [order.index(axis) for axis in "xyz"]


def path_or_tables(name, value):
    """What the module takes, and how the organ's provenance tells it."""
    if value is None:
        return None, ""
    if isinstance(value, dict):
        return value, json.dumps(value, default=lambda each: np.asarray(each).tolist())
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name}: {value!r}: expected a path or a dict")
    return os.fspath(value), os.path.basename(os.fspath(value))


def checked(options, known):
    """Options as Settings has them: the program's, whose edge is in mm."""
    for name in options:
        if name not in known:
            raise TypeError(f"{name}: there is no such option; expected one of {', '.join(known)}")
    out = {name: texts(name, value) if name in LISTS else value for name, value in options.items()}
    if "voxel_edge_m" in out:
        if "voxels_across" in out:
            raise TypeError("voxel_edge_m beside voxels_across: expected one of them")
        # By its digits, not times 1000: 0.0047 m is 4.7 mm and no other number.
        edge_m = decimal.Decimal(repr(number("voxel_edge_m", out.pop("voxel_edge_m"))))
        out["voxel_mm"] = float(edge_m.scaleb(3))
    return out


def number(name, value):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {value!r}: expected a number") from None


def texts(name, value):
    """None, one text or several, as a list."""
    if value is None or isinstance(value, str):
        return [value] if value else []
    if not isinstance(value, (list, tuple)):
        raise TypeError(f"{name}: {value!r}: expected a list of texts")
    return list(value)


def arrays_of(name, mesh):
    vertices = unmasked(f"{name}: vertices", mesh.vertices_m)
    faces = unmasked(f"{name}: faces", mesh.faces)
    if vertices.dtype.kind not in "fiu":
        raise TypeError(f"{name}: vertices of {vertices.dtype}: expected numbers")
    if faces.dtype.kind not in "iu":
        raise TypeError(f"{name}: faces of {faces.dtype}: expected whole numbers")
    source = "" if mesh.source is None else os.fspath(mesh.source)
    return name, source, vertices, faces, mesh.tissue, mesh.priority


# What the program says of its options, and what is said here; of others, the name is enough.
PHRASES = {"check --units and --scale": "check that all lengths are in m",
           "other --units": "lengths in m", "or --wrap": "or wrap=True", "--fix none": "fix='none'"}
ARGUMENTS = {"--layer": "layers", "--voxel-mm": "voxel_edge_m"}


def in_arguments(text):
    """The program's words, with the names of arguments for those of its options."""
    for phrase, ours in PHRASES.items():
        text = text.replace(phrase, ours)
    return re.sub(r"(?<![\w-])--[a-z]+(?:-[a-z]+)*", lambda found: ARGUMENTS.get(
        found[0], found[0].lstrip("-").replace("-", "_")), text)


def called(function, *arguments):
    """The module's function, whose refusals and warnings are told in arguments."""
    try:
        result = function(*arguments)
    except Refused as refused:
        raise Refused(in_arguments(str(refused))) from None
    result["warnings"] = [in_arguments(text) for text in result["warnings"]]
    return result


def finished(result):
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    return Built(result["content"], tuple(result["warnings"]), dict(result["obstacles"]),
                 tuple(result["targets"]))
