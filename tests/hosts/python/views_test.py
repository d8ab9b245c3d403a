#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Arrays of a simulation and an organ are the library's own memory: not copied, read-only, correct.

Expected values: the size and the attached end of the block that the test ordered.
"""
import unittest

import numpy as np
import stylet
from support import BLOCK_M, DOWN, insertion, organ, organ_file, simulation


def address(array):
    return array.__array_interface__["data"][0]


class Views(unittest.TestCase):
    def test_stay_in_place_and_are_filled_again(self):
        run = simulation(stylet.Needle(bending_nm2=0.02))
        poses = insertion(1000)
        run.run(poses[:300])
        for show in (run.surface, run.particles, run.constraint_particles, run.needle_shape):
            run.restore(snapshot := run.snapshot())
            first = show()
            kept, where = first.copy(), address(first)
            run.run(poses[300:])
            again = show()
            self.assertEqual(address(again), where, show.__name__)
            self.assertTrue(np.shares_memory(first, again))
            self.assertFalse(again.shape == kept.shape and (again == kept).all(), show.__name__)
            run.restore(snapshot)

    def test_output_of_a_tick(self):
        run = simulation()
        pose = insertion(2)[0]
        first = run.tick(pose)
        copy = first.copy()
        self.assertIs(run.tick(pose), first)
        self.assertEqual((copy.tick, first.tick), (1, 2))

    def test_are_read_only(self):
        run = simulation()
        for array in (run.surface(), run.particles(), run.voxel_corners(), run.events(),
                      organ().vertices, organ().triangles, organ().voxels,
                      run.tick(insertion(2)[:1])):
            with self.assertRaises(ValueError):
                array[...] = 0

    def test_outlive_their_owner(self):
        shown = simulation().surface()
        np.testing.assert_array_equal(shown, organ().vertices)

    def test_inputs_are_read_without_a_copy(self):
        """Nothing is converted: changes of the array after the call count."""
        inputs = stylet.inputs(insertion(10))
        inputs["struct_bytes"][0] = 0
        with self.assertRaisesRegex(ValueError, "struct_bytes 0"):
            simulation().run(inputs)


class Organ(unittest.TestCase):
    def test_the_organ_is_the_block_that_was_ordered(self):
        info = organ().info
        self.assertEqual(info.voxels, 12 * 12 * 8)
        self.assertEqual(info.size, (12, 12, 8))
        again = stylet.Organ.from_bytes(organ_file().read_bytes())
        self.assertEqual(again.info.hash, info.hash)
        np.testing.assert_allclose(np.subtract(info.high_m, info.low_m), BLOCK_M, atol=1e-6)
        self.assertEqual([m.name for m in organ().materials], ["liver"])
        voxels = organ().voxels
        np.testing.assert_array_equal(voxels["fill"], 1)
        held = voxels["fixed"] != 0
        self.assertTrue(held[voxels["z"] == 0].all() and not held[voxels["z"] > 1].any())

    def test_surface_is_closed_and_encloses_the_block(self):
        corners = organ().vertices[organ().triangles].astype(float)
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        self.assertAlmostEqual(volume.sum() / np.prod(BLOCK_M), 1, places=4)
        edges = np.sort(organ().triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())
        self.assertEqual(len(organ().vertex_materials), len(organ().vertices))

    def test_raycast(self):
        middle, top = np.add(organ().info.low_m, organ().info.high_m) / 2, organ().info.high_m[2]
        above = (*middle[:2], top + 0.03)
        self.assertAlmostEqual(organ().raycast(above, (0, 0, -2)), 0.03, places=6)
        self.assertIsNone(organ().raycast((1, 1, 1), DOWN))

    def test_neighbouring_voxels_share_corners(self):
        """Particle of corner dx + 2 dy + 4 dz: the neighbour along x has it as its corner 0."""
        corners, voxels = simulation().voxel_corners(), organ().voxels
        number = {(int(v["x"]), int(v["y"]), int(v["z"])): i for i, v in enumerate(voxels)}
        for (x, y, z), i in number.items():
            for corner, neighbour in ((1, (x + 1, y, z)), (2, (x, y + 1, z)), (4, (x, y, z + 1))):
                if neighbour in number:
                    self.assertEqual(corners[i, corner], corners[number[neighbour], 0])
        self.assertEqual(len(np.unique(corners)), 13 * 13 * 9)
        self.assertLess(corners.max(), len(simulation().particles()))

    def test_mass_is_density_times_volume(self):
        real_kg, _ = simulation().mass(0)
        self.assertAlmostEqual(
            real_kg / (organ().materials[0].density_kg_per_m3 * np.prod(BLOCK_M)), 1, places=4)


class Physics(unittest.TestCase):
    def test_energy_and_events_of_an_insertion(self):
        """A hand that pushes does work, and no more than that is dissipated."""
        run = simulation(substeps=2)
        run.run(insertion(2000))
        events = [stylet.event_name(event["kind"]) for event in run.events()]
        self.assertEqual(events[:2], ["contact", "puncture"])
        energy = run.energy()
        lost_j = energy.friction_j + energy.cutting_j + energy.relaxation_j
        self.assertGreater(energy.work_by_hand_j, lost_j)
        self.assertGreater(lost_j, 0)
        self.assertEqual(run.stats().ticks, 2000)


if __name__ == "__main__":
    unittest.main()
