#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An organ file as numpy arrays: read_organ(path). As a program it prints what it found."""
import pathlib
import struct
import sys

import numpy as np

RECORDS = {"runs": "u2,u2,u2,u2", "voxel_material": "u1", "voxel_fill": "u1", "voxel_fixed": "u1",
           "vertices": "u4,u2,u2,u2,u2", "triangles": "u4,u4,u4",
           "sphere_nodes": "f4,f4,f4,f4,u4,u4", "mixed": "u4,u2,u2,f4,f4,f4,f4"}
FIELDS = ("format_version name voxel_edge_m origin_x_m origin_y_m origin_z_m size_x size_y size_z "
          "runs voxel_material voxel_fill voxel_fixed materials vertices triangles sphere_nodes "
          "provenance mixed").split()  # in the order of kernel/schema/organ.fbs
SCALARS = {"format_version": "<I", "voxel_edge_m": "<f", "origin_x_m": "<f", "origin_y_m": "<f",
           "origin_z_m": "<f", "size_x": "<H", "size_y": "<H", "size_z": "<H"}


def read_organ(path):
    data = pathlib.Path(path).read_bytes()
    at = lambda place, form="<I": struct.unpack_from(form, data, place)[0]  # noqa: E731
    if data[4:8] != b"STLO":
        raise ValueError(f"{path}: not an organ file: expected the letters STLO at byte 4")
    root = at(0)
    table = root - at(root, "<i")
    organ = {}
    for i, name in enumerate(FIELDS):
        offset = at(table + 4 + 2 * i, "<H") if 4 + 2 * i < at(table, "<H") else 0
        if offset and name in SCALARS:
            organ[name] = at(root + offset, SCALARS[name])
        elif offset and name in RECORDS:
            vector = root + offset + at(root + offset)
            organ[name] = np.frombuffer(data, RECORDS[name], at(vector), vector + 4)
    if organ["format_version"] not in (1, 2):
        raise ValueError(f"{path}: format version {organ['format_version']}: expected 1 or 2")
    return organ


if __name__ == "__main__":
    for key, value in read_organ(sys.argv[1]).items():
        print(f"{key:15}", value if np.isscalar(value) else f"{len(value)} records")
