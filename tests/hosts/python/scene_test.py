#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Environments of a patient's scene, as stylet-organ writes it for a label map: its targets can be
reached and are rewarded, its bones block the way, its forbidden zones end an episode.

Expected values: the labels that the test wrote itself; what the program `stylet` made of the same
file, according to its recording; rotation matrices.
"""
import functools
import math
import os
import pathlib
import subprocess
import unittest
import unittest.mock

import numpy as np
import stylet
from stylet.scene import turned
from support import FAST, SOURCE, folder, program

IN = [0, 0, -1, 0, 0, 0]
SPACING_MM, RADIUS = 3.0, 3         # of the map's voxels; of the lesion, in voxels
LIVER, LESION, BONE = 1, 2, 3
FRONT = 6                           # first layer of liver along y
DRAW = np.random.default_rng(20)
ORIGIN_MM = DRAW.uniform(-200, 200, 3).round(2)
MIDDLE = DRAW.integers(10, 14, 3)   # of the lesion
RECIPE = """[names]
liver = 1
lesion = 2
bone = 3
[tissues]
liver = ["liver", "lesion"]
[targets]
lesion = ["lesion"]
[obstacles]
bone = ["bone"]
"""


def labels():
    """A block of liver with a ball in it, and a plate of bone 6 mm thick before it."""
    map_ = np.zeros((24, 24, 24), np.uint8)  # x, y, z
    map_[3:21, FRONT:21, 3:21] = LIVER
    away = np.linalg.norm(np.indices(map_.shape).T - MIDDLE, axis=-1).T
    map_[away <= RADIUS] = LESION
    map_[3:21, FRONT - 2:FRONT, 3:21] = BONE
    return map_


@functools.cache
def scene():
    top = folder() / "patient"
    top.mkdir()
    rows = " ".join(f"({','.join(map(str, SPACING_MM * row))})" for row in np.eye(3))
    header = ("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 24 24\nencoding: raw\n"
              f"space: left-posterior-superior\nspace directions: {rows}\n"
              f"space origin: ({','.join(map(str, ORIGIN_MM))})\n\n")
    (top / "map.nrrd").write_bytes(header.encode() + labels().tobytes(order="F"))
    (top / "recipe.toml").write_text(RECIPE)
    return built(top / "map.nrrd", top / "recipe.toml", "4")


def built(map_, recipe, voxel_mm):
    organ = recipe.parent / "patient.organ"
    subprocess.run([program("stylet-organ"), "build", map_, "--recipe", recipe, "--voxel-mm",
                    voxel_mm, "-o", organ], check=True, capture_output=True)
    return recipe.parent / "patient.scene.toml"


def environment(path=None, **options):
    return stylet.NeedleEnv.of_scene(path or scene(), **{
        "config": stylet.Config(**FAST), "ticks_of_step": 50, "most_steps": 200, **options})


def episode(env):
    env.reset(seed=0)
    rewards = []
    while True:
        _, reward, terminated, truncated, info = env.step(IN)
        rewards.append(reward)
        if terminated or truncated:
            return rewards, terminated, info


class Patient(unittest.TestCase):
    def test_target_is_where_the_label_is(self):
        target, = environment().targets
        np.testing.assert_allclose(target.at_m, 1e-3 * (ORIGIN_MM + SPACING_MM * MIDDLE), atol=1e-5)
        volume_mm3 = np.count_nonzero(labels() == LESION) * SPACING_MM ** 3
        radius_mm = (volume_mm3 * 3 / (4 * math.pi)) ** (1 / 3)
        self.assertAlmostEqual(target.radius_m, 1e-3 * radius_mm, places=5)

    def test_way_in_is_rewarded(self):
        """From the front (y): from 10 mm before the liver, 1 mm a step into the lesion."""
        env = environment(obstacles=())
        _, info = env.reset(seed=0)
        whole_m = info["distance_m"]
        depth_m = 1e-3 * SPACING_MM * (MIDDLE[1] - (FRONT - 0.5))
        self.assertAlmostEqual(whole_m, 0.01 + depth_m, delta=0.5e-3 * SPACING_MM)
        rewards, terminated, info = episode(env)
        self.assertTrue(terminated)
        self.assertEqual(len(rewards), math.ceil((whole_m - env.target.radius_m) / 0.001 - 1e-3))
        np.testing.assert_allclose(rewards[:-1], 0.001 / whole_m, atol=1e-4)
        self.assertAlmostEqual(sum(rewards), 1 + 1 - info["distance_m"] / whole_m, places=6)

    def test_bone_is_in_the_way(self):
        """Bone of 20 N/mm lies 4 mm in front of the needle; liver alone would give less than 2 N
        there."""
        felt_n = {}
        for name, options in (("bone", {}), ("none", {"obstacles": ()})):
            env = environment(**options)
            env.reset(seed=0)
            felt_n[name] = [env.step(IN)[4]["force_n"] for _ in range(6)]
        self.assertEqual(felt_n["none"], [0] * 6)
        self.assertEqual(felt_n["bone"][:3], [0] * 3)
        self.assertGreater(felt_n["bone"][5], 10)

    def test_forbidden_zone_ends_it(self):
        target, = stylet.read_targets(scene())
        path = scene().with_name("guarded.scene.toml")
        at_mm = 1e3 * np.subtract(target.at_m, [0, target.radius_m + 0.004, 0])
        path.write_text(scene().read_text() + f'\n[[targets]]\nname = "vessel"\nat_mm = '
                        f"{at_mm.tolist()}\nradius_mm = 2\nforbidden = true\n")
        rewards, terminated, info = episode(environment(path, obstacles=()))
        self.assertTrue(terminated)
        self.assertAlmostEqual(rewards[-1], -1, delta=0.1)
        self.assertGreater(info["distance_m"], target.radius_m)

    def test_of_a_real_map(self):
        data = pathlib.Path(os.environ.get("STYLET_DATA", SOURCE.parent / "shared/data"))
        if not data.is_dir():
            self.skipTest(f"{data} is not there (STYLET_DATA names another place)")
        top = folder() / "real"
        top.mkdir()
        (top / "recipe.toml").write_text(
            '[tissues]\nliver = ["liver"]\nvessel = ["portal_vein_and_splenic_vein"]\n[targets]\n'
            'vein = ["portal_vein_and_splenic_vein"]\n[obstacles]\nrib = ["rib_right_9"]\n')
        path = built(data / "labelmaps/ts_example_seg.nii.gz", top / "recipe.toml",
                     "8")
        env = environment(path, speed_m_per_s=0.04)
        rewards, terminated, info = episode(env)
        self.assertTrue(terminated)
        self.assertEqual(info["target"], "vein")
        self.assertLessEqual(info["distance_m"], env.target.radius_m)
        _, first = env.reset(seed=0)
        self.assertAlmostEqual(sum(rewards), 2 - info["distance_m"] / first["distance_m"], places=6)


class ByName(unittest.TestCase):
    """Scenes that come with Stylet, as `stylet run NAME` takes them."""

    def setUp(self):
        program("stylet-organ")
        program("stylet")
        caches = unittest.mock.patch.dict(os.environ, {"XDG_CACHE_HOME": str(folder() / "caches")})
        caches.start()
        self.addCleanup(caches.stop)

    def test_organ_is_made_once_and_is_the_programs(self):
        env = environment("lumbar-puncture")
        self.assertEqual([target.name for target in env.targets], ["epidural space", "dura"])
        kept, = (folder() / "caches/stylet/organs").iterdir()
        self.assertEqual(env.organ.info.hash, stylet.Organ.read(kept).info.hash)
        before = kept.stat().st_mtime_ns
        environment(SOURCE / "hal/scenes/lumbar-puncture.toml")  # the file of the same scene
        self.assertEqual(kept.stat().st_mtime_ns, before)
        ran = subprocess.run([program("stylet"), "run", "lumbar-puncture", "--fast",
                              "--duration-s", "0.01"], capture_output=True, text=True)
        self.assertNotIn("is made once", ran.stderr)

    def test_messages_name_the_command(self):
        with self.assertRaisesRegex(FileNotFoundError, "lumbar: no such file, and no scene of this "
                                    "name: there are .*lumbar-puncture"):
            environment("lumbar")
        own = folder() / "own.toml"
        own.write_text((SOURCE / "hal/scenes/lumbar-puncture.toml").read_text())
        with self.assertRaisesRegex(FileNotFoundError, "stylet run .*own.toml.*stylet-organ phant"):
            environment(own)
        with unittest.mock.patch.object(stylet.scene.place, "program", lambda: None):
            with self.assertRaisesRegex(FileNotFoundError, "Debian: package stylet"):
                environment("lumbar-puncture")
            with self.assertRaisesRegex(FileNotFoundError, "`stylet run .*lumbar-puncture.toml`"):
                environment(SOURCE / "hal/scenes/lumbar-puncture.toml")


class Obstacles(unittest.TestCase):
    def test_are_those_of_the_program(self):
        """Bodies of all shapes, with and without defaults, are those in a recording of the
        program."""
        bodies = ['shape = "sphere"\nradius_mm = 7\nat_mm = [500, 0, 0]\n']
        for _ in range(3):
            size, turn, at = (DRAW.uniform(*ends, 3).tolist() for ends in
                              ((5, 50), (-180, 180), (400, 600)))
            bodies.append(f'shape = "box"\nsize_mm = {size}\nat_mm = {at}\nturn_deg = {turn}\n'
                          'stiffness_n_per_mm = 5\nlargest_force_n = 20\nfriction = 0.1\n')
        path = scene().with_name("bodies.scene.toml")
        path.write_text(scene().read_text() + "".join(f"\n[[obstacles]]\n{each}"
                                                      for each in bodies))
        recording = path.with_name("bodies.h5")
        subprocess.run([program("stylet"), "run", path, "--fast", "--duration-s", "0.01",
                        "--record", recording], check=True, capture_output=True)
        here, there = stylet.read_obstacles(path), stylet.Recording(recording).obstacles
        self.assertEqual(len(here), 5)  # with the plate of bone
        for name in ("stiffness_n_per_m", "largest_force_n", "friction"):
            # The defaults of the program's scenes and of the interface in C are the same to the
            # bit.
            self.assertEqual(getattr(there[1], name), getattr(stylet.Obstacle(), name), name)
        for ours, theirs in zip(here, there, strict=True):
            for name in ("vertex_count", "vertices_m", "position_m", "rotation_wxyz", "rounding_m",
                         "stiffness_n_per_m", "largest_force_n", "friction"):
                np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), rtol=1e-6,
                                           atol=1e-7, err_msg=name)

    def test_rotations_are_about_x_then_y_then_z(self):
        for degrees in DRAW.uniform(-360, 360, (20, 3)):
            (cx, cy, cz), (sx, sy, sz) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
            expected = (np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
                        @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
                        @ np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]))
            np.testing.assert_allclose(stylet.motion.rotated(turned(degrees), [1, 0, 0]),
                                       expected[:, 0], atol=1e-12)
            np.testing.assert_allclose(stylet.motion.rotated(turned(degrees), [0, 1, 0]),
                                       expected[:, 1], atol=1e-12)

    def test_mistakes_are_reported_with_their_place(self):
        for text, told in (('shape = "cone"', r"obstacles\[0\]\.shape = 'cone': expected one of"),
                           ('shape = "box"\nat_mm = [0, 0, 0]', "size_mm: missing"),
                           ('shape = "sphere"\nradius_mm = 1', "at_mm: missing"),
                           ('shape = "sphere"\nradius_mm = 1\nat_mm = [0, 0, 0]\nsize_mm = 1',
                            "size_mm: unknown: expected one of"),
                           ('shape = "sphere"\nradius_mm = 1\nat_mm = [0, 0]',
                            r"at_mm of shape \(2,\): expected 3 numbers")):
            path = folder() / "wrong.toml"
            path.write_text(f"[[obstacles]]\n{text}\n")
            with self.assertRaisesRegex(ValueError, "wrong.toml: .*" + told):
                stylet.read_obstacles(path)


if __name__ == "__main__":
    unittest.main()
