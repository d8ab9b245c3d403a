#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Names, numbers, fields and types of the Python package are those of the C header, and complete.

Expected values: the text of stylet.h.
"""
import ast
import inspect
import pickle
import re
import unittest

import numpy as np
import stylet
from stylet import _stylet
from support import SOURCE

HEADER = (SOURCE / "hal/hosts/c/include/stylet/stylet.h").read_text()
PACKAGE = SOURCE / "hal/hosts/python/package/stylet"


def numbers(prefix):
    found = re.findall(rf"STYLET_{prefix}(\w+) = ([^,/}}\n]+)", HEADER)
    return {name: eval(value) for name, value in found}  # of our own header: 1 << 3


def members(struct):
    """Names of the fields of a struct, in its order."""
    text = re.search(r"typedef struct \{([^}]*)\} " + struct + ";", HEADER)[1]
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    names = []
    for declaration in text.split(";"):
        parts = declaration.strip().split(None, 1)
        if len(parts) == 2:
            names += [re.sub(r"\[.*", "", name).split()[-1].strip("*")
                      for name in parts[1].split(",")]
    return [name for name in names if name != "reserved"]


class Header(unittest.TestCase):
    def test_numbers(self):
        status = {name: value for name, value in numbers("").items()
                  if (value >= 100 or name == "OK") and not name.startswith("FLAG_")}
        self.assertEqual({each.name: each.value for each in stylet.Status}, status)
        self.assertEqual({each.name: each.value for each in stylet.Event}, numbers("EVENT_"))
        flags = numbers("FLAG_")
        flags["FAULT"] = int(re.search(r"STYLET_FLAG_FAULT (0x\w+?)U", HEADER)[1], 16)
        self.assertEqual({each.name: each.value for each in stylet.Flag}, flags)
        phases = numbers("")
        self.assertEqual({each.name: each.value for each in stylet.Phase},
                         {name: phases[name] for name in stylet.Phase.__members__})
        self.assertIn(f"STYLET_NO_LAYER 0x{stylet.NO_LAYER:X}U", HEADER)

    def test_fields(self):
        pose = {"handle": ["position_m", "rotation_wxyz"], "pose": ["position_m", "rotation_wxyz"]}
        for struct in ("input", "output", "config", "needle", "obstacle", "voxel",
                       "constraint_particle", "obstacle_touch", "event"):
            expected = [field for name in members(f"stylet_{struct}")
                        for field in pose.get(name, [name])]
            if struct != "input":
                expected = [name for name in expected if name != "struct_bytes"]
            self.assertEqual(list(getattr(_stylet, f"{struct}_dtype").names), expected, struct)

    def test_annotations_name_exactly_the_fields(self):
        for kind, dtype in ((stylet.Config, _stylet.config_dtype),
                            (stylet.Needle, _stylet.needle_dtype),
                            (stylet.Obstacle, _stylet.obstacle_dtype)):
            self.assertEqual(list(inspect.get_annotations(kind)), list(dtype.names))

    def test_version(self):
        parts = re.findall(r"STYLET_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", HEADER)
        self.assertEqual(stylet.__version__, ".".join(parts))

    def test_names_come_from_the_library(self):
        self.assertEqual(stylet.event_name(stylet.Event.PUNCTURE), "puncture")
        self.assertNotEqual(stylet.status_name(stylet.Status.FILE_UNREADABLE),
                            stylet.status_name(999))


class Stubs(unittest.TestCase):
    def test_have_every_name_of_the_module(self):
        tree = ast.parse((PACKAGE / "_stylet.pyi").read_text())
        told = {getattr(node, "name", None) or node.target.id for node in tree.body
                if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign))}
        self.assertLessEqual({name for name in dir(_stylet) if not name.startswith("__")}, told)
        classes = {node.name: {getattr(item, "name", None) or item.target.id for item in node.body}
                   for node in tree.body if isinstance(node, ast.ClassDef)}
        for name in ("Organ", "Simulation", "Batch"):
            own = {member for member in vars(getattr(_stylet, name)) if not member.startswith("__")}
            self.assertEqual(own, {member for member in classes[name]
                                   if not member.startswith("__")})
        for name, struct in (("OrganInfo", "organ_info"), ("Material", "material"),
                             ("Stats", "stats"), ("Energy", "energy"), ("Pool", "pool")):
            fields = set(members(f"stylet_{struct}")) - {"struct_bytes"}
            if name == "OrganInfo":
                fields = fields - {"size_x", "size_y", "size_z"} | {"size"}
            self.assertEqual(classes[name], fields, name)

    def test_package_says_that_it_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())


class Structs(unittest.TestCase):
    def test_defaults_are_those_of_an_18g_needle(self):
        """hal/scene/by_name.md: 18G, 1.270 mm, 150 mm."""
        needle = stylet.Needle()
        self.assertAlmostEqual(needle.outer_radius_m, 0.635e-3, places=9)
        self.assertAlmostEqual(needle.length_m, 0.15, places=7)

    def test_change_copy_and_pickle(self):
        needle = stylet.Needle(bending_nm2=0.5, rods=16)
        longer = needle.replace(length_m=0.25)
        self.assertEqual((longer.length_m, longer.rods, longer.bending_nm2), (0.25, 16, 0.5))
        self.assertEqual(pickle.loads(pickle.dumps(longer)), longer)
        self.assertNotEqual(longer, needle)
        self.assertIn("rods=16", repr(needle))
        self.assertEqual(stylet.Config(inertia="added_mass", mode="paper"),
                         stylet.Config(inertia=0, mode=1))

    def test_bodies(self):
        box = stylet.Obstacle.box((0.01, 0.02, 0.03), friction=0.5)
        self.assertEqual((box.vertex_count, box.friction), (8, 0.5))
        np.testing.assert_allclose(np.abs(box.vertices_m[:8]) + box.rounding_m,
                                   np.tile([0.01, 0.02, 0.03], (8, 1)), atol=1e-6)
        ball = stylet.Obstacle.sphere(0.02)
        self.assertEqual(ball.vertex_count, 1)
        self.assertAlmostEqual(ball.rounding_m, 0.02)
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        hull = stylet.Obstacle.hull(np.multiply(0.01, corners))
        self.assertEqual(hull.vertex_count, 4)


if __name__ == "__main__":
    unittest.main()
