#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads an organ file as numpy arrays: read_organ(path); voxel_cubes(organ) says where its voxels
lie. As a program it prints what it found.

usage: read_organ.py ORGAN
"""
import hashlib
import pathlib
import struct
import sys

import numpy as np

# In the order of kernel/schema/organ.fbs; "": left out.
MEMBRANES = {"membrane_points": "f4,f4,f4", "membrane_triangles": "u4,u4,u4",
             "membrane_cells": "u2,u2,u2,u2,u4,u4,f4"}
SLIDES = {"slide_points": "u4,u2,u2,u2,u2,f4,u4,f4", "slide_grounds": "u4,8f4",
          "slide_bodies": "u1"}
SHEETS = {"rows": "<H", "ties": "u2,u2,u2,u2", "parts": "u2,u2,u2,u2,u8"}
LEVELS = {"levels": "<B", "level_planes": "<H", "hanging": "u2,u2,u2,u2,u2,u2"}
ORGAN = {"format_version": "<I", "name": "", "voxel_edge_m": "<f", "origin_x_m": "<f",
         "origin_y_m": "<f", "origin_z_m": "<f", "size_x": "<H", "size_y": "<H", "size_z": "<H",
         "runs": "u2,u2,u2,u2", "voxel_material": "u1", "voxel_fill": "u1", "voxel_fixed": "u1",
         "materials": "", "vertices": "u4,u2,u2,u2,u2", "triangles": "u4,u4,u4",
         "sphere_nodes": "f4,f4,f4,f4,u4,u4", "provenance": "",
         "mixed": "u4,u2,u2,f4,f4,f4,f4", "sheets": SHEETS,
         "content_sha256": "u1", "membranes": MEMBRANES, "slides": SLIDES, "levels": LEVELS,
         "skins": "u4,f4"}


def read_table(data, root, fields, out):
    at = lambda place, form="<I": struct.unpack_from(form, data, place)[0]  # noqa: E731
    table = root - at(root, "<i")
    for i, (name, form) in enumerate(fields.items(), 2):
        here = root + (at(table + 2 * i, "<H") if 2 * i < at(table, "<H") else 0)
        if here == root or not form:
            continue
        if isinstance(form, dict):
            read_table(data, here + at(here), form, out)
        elif form[0] == "<":
            out[name] = at(here, form)
        else:
            out[name] = np.frombuffer(data, form, at(here + at(here)), here + at(here) + 4)
    return out


def read_organ(path):
    data = pathlib.Path(path).read_bytes()
    if data[4:8] != b"STLO":
        raise ValueError(f"{path}: not an organ file: expected the letters STLO at byte 4")
    organ = read_table(data, struct.unpack_from("<I", data)[0], ORGAN, {})
    version = organ.get("format_version", 0)
    if version not in range(1, 7):
        raise ValueError(f"{path}: format version {version}: expected 1 to 6")
    known = organ.get("content_sha256", np.empty(0)).tobytes()
    if (version > 1 or known) and hashlib.sha256(data.replace(known, b"", 1)).digest() != known:
        raise ValueError(f"{path}: content_sha256: not the sum of its bytes: some byte has changed")
    return organ


def voxel_cubes(organ):
    """The low corner (n, 3) and the edge (n) of each voxel at rest, m."""
    x, y, z, count = (organ["runs"][f"f{i}"].astype(int) for i in range(4))
    levels, planes = organ.get("levels", 1), organ.get("level_planes", organ["size_z"])
    starts = np.array([level + planes * (2**level - 1) for level in range(levels)])
    level = np.searchsorted(starts, z, "right") - 1  # they lie one after the other along z
    y %= organ.get("rows", organ["size_y"])          # sheets lie at the same place
    place = np.repeat(np.stack([x, y, z - starts[level]], 1), count, 0)
    place[:, 0] += np.arange(len(place)) - np.repeat(np.cumsum(count) - count, count)
    edge_m = np.repeat(organ["voxel_edge_m"] / 2.0**level, count)
    origin_m = np.array([organ[f"origin_{axis}_m"] for axis in "xyz"])
    return origin_m + place * edge_m[:, None], edge_m


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: read_organ.py ORGAN")
    try:
        found = read_organ(sys.argv[1])
    except (OSError, ValueError) as error:
        sys.exit(f"read_organ.py: {error}")
    for key, value in found.items():
        print(f"{key:15}", value if np.isscalar(value) else f"{len(value)} records")
