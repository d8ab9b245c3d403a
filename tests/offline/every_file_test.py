#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every label map and organ mesh of the shared data becomes an organ or is refused with a reason;
every label keeps its volume; Python reads organ files as the program does, and damage is
recognised.

usage: every_file_test.py [CASE]   (STYLET_BIN, STYLET_SOURCE; STYLET_DATA overrides)
"""
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(os.environ.get("STYLET_SOURCE", pathlib.Path(__file__).parents[2]))
TOOL = pathlib.Path(os.environ.get("STYLET_BIN", SOURCE / "build/bin")) / "stylet-organ"
DATA = pathlib.Path(os.environ.get("STYLET_DATA", SOURCE.parent / "shared/data"))
RECIPE = SOURCE / "offline/recipes/totalsegmentator.toml"

# Files that must be refused, with a part of the reason; all others must build.
NO_MAPS = {"ts_example_ct_sm.nii.gz": "whole numbers", "sofa_tooth_closed.mhd": "whole numbers",
           "tooth_closed.raw": "expected a label map", "README.md": "expected a label map"}
NO_MESHES = {"README.md": "expected"}
TISSUE = """density_kg_per_m3 = 1000
youngs_modulus_kpa = 10
poisson_ratio = 0.45
relaxing_fraction = 0
relaxation_time_s = 1
puncture_force_n = 0.3
cutting_force_n = 0.2
recut_fraction = 0.1
coulomb_friction_n_per_mm = 0.001
static_friction_n_per_mm = 0.001
stribeck_velocity_mm_per_s = 1
viscous_friction_n_s_per_m2 = 5
"""


class Case(unittest.TestCase):
    def setUp(self):
        if not DATA.exists():
            self.skipTest(f"{DATA} is not there; set STYLET_DATA")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def tool(self, *words):
        return subprocess.run([TOOL, *map(str, words)], capture_output=True, text=True,
                              timeout=600)

    def facts(self, *words):
        done = self.tool(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def check_refused(self, done, said):
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(said, done.stderr)


class LabelMaps(Case):
    def write_recipe(self, labels):
        """A recipe that makes every label a tissue of its own."""
        names = [f"label{each['label']}" for each in labels]
        (self.folder / "tissues.toml").write_text("".join(f"[{name}]\n{TISSUE}" for name in names))
        (self.folder / "recipe.toml").write_text("[tissues]\n" + "".join(
            f"{name} = [{each['label']}]\n" for name, each in zip(names, labels)))

    def check_volumes(self, path):
        labels = self.facts("labels", path)["labels"]
        self.write_recipe(labels)
        # About 60 000 voxels.
        whole_mm3 = sum(each["volume_ml"] for each in labels) * 1e3
        edge_mm = float(f"{min(25, max(1, (whole_mm3 / 60000) ** (1 / 3))):.3g}")
        built = self.facts("build", path, "--recipe", self.folder / "recipe.toml", "--materials",
                           self.folder / "tissues.toml", "--voxel-mm", edge_mm, "-o",
                           self.folder / "map.organ")
        seen = {each["tissue"]: each["filled_volume_ml"] for each in built["labels"]}
        for each in labels:
            # There are 64 samples for each voxel of the lattice, too few for one percent of a
            # speck. If samples were random, their number would be right to its root, and in 95 % of
            # cases to twice that.
            samples = each["volume_ml"] * 1e3 / edge_mm ** 3 * 64
            allowed = max(0.01, 2 / math.sqrt(samples))
            self.assertAlmostEqual(seen[f"label{each['label']}"] / each["volume_ml"], 1,
                                   delta=allowed, msg=f"{path.name} label {each['label']}")

    def test_every_file_is_an_organ_or_refused_and_labels_keep_their_volume(self):
        files = sorted((DATA / "labelmaps").iterdir())
        self.assertGreater(len(files), 10)
        for path in files:
            with self.subTest(path.name):
                if path.name in NO_MAPS:
                    self.check_refused(self.tool("labels", path), NO_MAPS[path.name])
                else:
                    self.check_volumes(path)


class Meshes(Case):
    def test_every_file_is_an_organ_or_refused(self):
        files = sorted((DATA / "organs").iterdir())
        self.assertGreater(len(files), 10)
        for path in files:
            with self.subTest(path.name):
                done = self.tool("build", path, "--voxels-across", 30, "--scale", self.scale(path),
                                 "-o", self.folder / "mesh.organ", "--sum")
                if path.name in NO_MESHES:
                    self.check_refused(done, NO_MESHES[path.name])
                    continue
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(self.tool("check", self.folder / "mesh.organ").returncode, 0)

    def scale(self, path):
        """Scales the mesh to an organ of centimetres, because some files have no unit."""
        if "femur" in path.name or "pelvis" in path.name or "slab" in path.name:
            return 100
        return 10 if path.name.startswith("sofa_") and "aneurysm" not in path.name else 1


class OrganFiles(Case):
    def build(self):
        self.tool("phantom", "layered", "--voxel-mm", 5, "-o", self.folder / "a.organ", "--sum")
        return self.folder / "a.organ"

    def test_python_reads_what_the_program_wrote(self):
        sys.path.insert(0, str(SOURCE / "offline/analysis"))
        from read_organ import read_organ
        organ, facts = read_organ(self.build()), self.facts("info", self.folder / "a.organ")
        self.assertEqual(len(organ["voxel_material"]), facts["voxels"])
        self.assertEqual(len(organ["vertices"]), facts["surface_vertices"])
        self.assertEqual(len(organ["triangles"]), facts["surface_triangles"])
        self.assertEqual(len(organ["sphere_nodes"]), facts["sphere_nodes"])
        self.assertEqual(int(organ["runs"]["f3"].sum()), facts["voxels"])
        self.assertAlmostEqual(organ["voxel_edge_m"] * 1e3, facts["voxel_edge_mm"], places=5)
        fill = organ["voxel_fill"].astype(float) / 255
        for i, material in enumerate(facts["materials"]):
            ml = fill[organ["voxel_material"] == i].sum() * (organ["voxel_edge_m"] * 100) ** 3
            self.assertAlmostEqual(ml, material["volume_ml"], delta=1e-5 * ml)

    def test_python_places_the_voxels_of_all_levels(self):
        sys.path.insert(0, str(SOURCE / "offline/analysis"))
        from read_organ import read_organ, voxel_cubes
        path = self.folder / "a.organ"
        self.tool("phantom", "ball", "--voxel-mm", 8, "--refine", "box:0,0,0:9,9,9:2", "-o", path)
        organ, facts = read_organ(path), self.facts("info", path)
        self.assertEqual([level["voxels"] > 0 for level in facts["levels"]], 3 * [True])
        low_m, edge_m = voxel_cubes(organ)
        for level in facts["levels"]:
            there = abs(edge_m * 1e3 - level["voxel_edge_mm"]) < 1e-5
            self.assertEqual(there.sum(), level["voxels"])
        # On a ball, however large the voxels are; and a vertex lies where its voxel says.
        v = organ["vertices"]
        part = np.stack([v["f1"], v["f2"], v["f3"]], 1) / 65535
        place_m = low_m[v["f0"]] + part * edge_m[v["f0"], None]
        np.testing.assert_allclose(np.linalg.norm(place_m, axis=1), 0.03, rtol=1e-4)
        # Each place inside is in one voxel.
        inside_m = np.random.default_rng(1).normal(size=(200, 3))
        inside_m *= 0.028 * np.random.default_rng(2).random((200, 1)) / np.linalg.norm(
            inside_m, axis=1, keepdims=True)
        off_m = inside_m[:, None] - low_m
        within = ((off_m >= 0) & (off_m < edge_m[:, None])).all(2)
        np.testing.assert_array_equal(within.sum(1), 1)

    def test_other_versions_and_files_are_refused_by_both(self):
        sys.path.insert(0, str(SOURCE / "offline/analysis"))
        from read_organ import read_organ
        path = self.build()
        data = bytearray(path.read_bytes())
        root = int.from_bytes(data[0:4], "little")
        table = root - int.from_bytes(data[root:root + 4], "little", signed=True)
        version = root + int.from_bytes(data[table + 4:table + 6], "little")
        self.assertIn(data[version], (1, 2))
        data[version] = 7
        path.write_bytes(data)
        self.check_refused(self.tool("check", path), "expected version 1 to 6")
        with self.assertRaisesRegex(ValueError, "format version 7: expected 1 to 6"):
            read_organ(path)
        with self.assertRaisesRegex(ValueError, "expected the letters STLO"):
            read_organ(RECIPE)

    def test_any_changed_byte_is_recognised_by_every_reader(self):
        sys.path.insert(0, str(SOURCE / "offline/analysis"))
        from read_organ import read_organ
        path = self.build()
        self.assertIn("its bytes are those that were built", self.tool("check", path).stdout)
        whole, by_the_sum = path.read_bytes(), 0
        for at in range(0, len(whole), len(whole) // 97):
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            done = self.tool("check", path)
            self.check_refused(done, "expected")
            by_the_sum += "content_sha256" in done.stderr
            with self.assertRaises((ValueError, struct.error)):
                read_organ(path)
            if at % 8 == 0:
                self.assertEqual(self.tool("info", path).returncode, 1)
        self.assertGreater(by_the_sum, 20)

    def test_the_checksum_beside_a_file_tells_whether_it_is_that_file(self):
        path = self.build()
        self.assertIn("those of the .sha256 file beside it", self.tool("check", path).stdout)
        subprocess.run(["sha256sum", "--status", "-c", f"{path.name}.sha256"], cwd=self.folder,
                       check=True)
        other = self.folder / "other.organ"
        self.tool("phantom", "layered", "--voxel-mm", 6, "-o", other)
        path.write_bytes(other.read_bytes())
        self.check_refused(self.tool("check", path), "the file is undamaged, but not the one")
        # A new organ without a checksum removes that of the old one.
        self.tool("phantom", "layered", "--voxel-mm", 6, "-o", path)
        self.assertFalse((self.folder / "a.organ.sha256").exists())
        self.assertEqual(self.tool("check", path).returncode, 0)


class Memory(Case):
    def test_the_memory_limit_is_kept_and_reported(self):
        words = ["build", DATA / "organs/openhelp_Liver.stl", "--voxel-mm", 1, "-o",
                 self.folder / "a.organ", "--memory-limit"]
        self.check_refused(self.tool(*words, "100MiB"), "out of memory")
        self.check_refused(self.tool(*words, "10MiB"), "expected at least 64MiB")
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertEqual(self.tool(*words, "1GiB").returncode, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
