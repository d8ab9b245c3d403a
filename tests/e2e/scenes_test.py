#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Each scene of hal/scenes shows what its figure in the paper shows, and can be drawn.

usage: scenes_test.py [CASE]   with STYLET_BIN and STYLET_SOURCE in the environment
"""
import json
import os
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
sys.path[:0] = [str(SOURCE / "hal/scenes"), str(SOURCE / "tests/golden")]

import draw  # noqa: E402
import golden  # noqa: E402
import play  # noqa: E402


class Scene(unittest.TestCase):
    """One run of the scene for all its checks."""

    name = ""
    more = ()  # options of the run

    @classmethod
    def setUpClass(cls):
        if not cls.name:
            raise unittest.SkipTest("has no scene of its own")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        try:
            recording, cls.report = play.play(cls.name, cls.folder, cls.more)
        except play.DataMissing as missing:
            raise unittest.SkipTest(str(missing)) from missing
        cls.run_ = draw.Run(recording)

    def check_quiet(self):
        """No pool was full, there was no guard fault, and the picture can be drawn."""
        counters = self.report["counters"]
        for key in ("cp_pool_full", "cp_voxel_pool_full", "kernel_fault", "guard_faults"):
            self.assertEqual(counters[key], 0, key)
        picture = self.folder / "picture.svg"
        draw.draw(self.name, self.run_, picture)
        self.assertGreater(len(picture.read_text()), 5000)

    def test_golden(self):
        """Bit for bit what it was when it was last looked at: tests/golden/README.md."""
        table = golden.read_table()
        self.assertIn(self.name, table, "no golden replay yet: tests/golden/golden.py")
        change = golden.difference(table[self.name], golden.digest(self.run_.path))
        self.assertFalse(change, f"{self.name}: {change}")

    def test_promises_hold_at_every_tick(self):
        """The promises of promises.h; and the wrench at the handle is the sum over the
        particles."""
        self.run_.shapes(len(self.run_.time_s))
        checks = self.run_.checks
        self.assertEqual(checks["ticks"], len(self.run_.time_s))
        self.assertEqual(checks["broken"], "")
        self.assertGreater(checks["force_fraction"], 0, "nothing was summed")
        self.assertLess(checks["force_fraction"], 1e-6, checks)
        self.assertLess(checks["torque_fraction"], 1e-6, checks)

    def kinds(self):
        return [kind for _, kind, _, _ in self.run_.events]

    def assert_within(self, value, expected, share):
        self.assertLessEqual(abs(value - expected), share * abs(expected),
                             f"{value:.6g}, expected {expected:.6g} within {100 * share:g} %")


STEEL_PA = 200e9


def bending_of(outer_m, inner_m):
    return STEEL_PA * np.pi / 64 * (outer_m**4 - inner_m**4)


def bending_energy(needle, bending_nm2, straight):
    """Energy of a chain of rods clamped along `straight`, with joints of stiffness EI / l and twice
    that at the clamp."""
    rods = np.diff(np.array(needle), axis=0)
    length = np.linalg.norm(rods[0])
    rods = np.vstack([[straight], rods / length])
    cosine = np.sum(rods[:-1] * rods[1:], axis=1)
    kink = 2 * np.cross(rods[:-1], rods[1:]) / (1 + cosine)[:, None]
    joints = np.sum(kink**2, axis=1) * bending_nm2 / (2 * length)
    return float(np.sum(joints) + joints[0])


class Fig02ConstraintParticles(Scene):
    name = "fig02-constraint-particles"

    def test_two_particles_hold_a_voxel_and_the_needle_bends(self):
        self.check_quiet()
        shape = self.run_.shapes(len(self.run_.time_s))[0]
        places = np.array([p["goal_m"] for p in shape["particles"]])
        voxels, held = np.unique(np.floor(places / 10e-3), axis=0, return_counts=True)
        self.assertGreaterEqual(held.max(), 2, voxels)
        needle = np.array(shape["needles"][0])
        chord = (needle[-1] - needle[0]) / np.linalg.norm(needle[-1] - needle[0])
        off = np.linalg.norm(np.cross(needle - needle[0], chord), axis=1).max()
        self.assertGreater(off, 0.2e-3)

    def test_force_is_the_slope_of_the_energy(self):
        # Central difference over 2 mm of three states at rest.
        run = self.run_
        ticks = [len(run.time_s) - 3500, len(run.time_s) - 1750, len(run.time_s)]
        bending = bending_of(0.7176e-3, 0.413e-3)
        energies = [s["coupling_energy_j"] + s["elastic_energy_j"] +
                    bending_energy(s["needles"][0], bending, run.along)
                    for s in run.shapes(*ticks)]
        side, force = draw.sideways(run)
        low, middle, high = (tick - 1 for tick in ticks)
        slope = (energies[2] - energies[0]) / (side[high] - side[low])
        self.assert_within(slope, force[middle], 0.01)


def clamped_stiffness(bending_nm2, foundation_n_per_m2, free_m, embedded_m, pieces=400):
    """Stiffness across the clamped end of a beam whose far part lies on an elastic foundation."""
    h = (free_m + embedded_m) / pieces
    beam = bending_nm2 / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    ground = foundation_n_per_m2 * h / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    whole = np.zeros((2 * pieces + 2, 2 * pieces + 2))
    for piece in range(pieces):
        at = slice(2 * piece, 2 * piece + 4)
        whole[at, at] += beam + (ground if (piece + 0.5) * h > free_m else 0)
    moved = np.linalg.solve(whole[2:, 2:], -whole[2:, 0])
    return whole[0, 0] + whole[0, 2:] @ moved


class Fig06Clamping(Scene):
    name = "fig06-clamping"
    SHEAR, POISSON = 10e3 / 2.9, 0.45  # gel
    RADIUS, FAR, LENGTH = 0.635e-3, 25e-3, 100e-3

    def foundation(self):
        """Rigid cylinder in an elastic ring."""
        n, a2, b2 = 3 - 4 * self.POISSON, self.RADIUS**2, self.FAR**2
        return (8 * np.pi * (1 - self.POISSON) * n * self.SHEAR /
                (n * n * np.log(self.FAR / self.RADIUS) - (b2 - a2) / (b2 + a2)))

    def test_reference_is_that_of_the_table(self):
        self.assert_within(clamped_stiffness(2.07e-2, 9400, 50e-3, 50e-3), 131.82, 5e-3)
        self.assert_within(clamped_stiffness(2.07e-2, 9400, 50e-3, 100e-3), 152.47, 5e-3)
        self.assert_within(clamped_stiffness(2.318e-3, 9400, 50e-3, 50e-3), 38.99, 5e-3)

    def test_handle_is_held_as_a_beam_in_a_foundation(self):
        self.check_quiet()
        run = self.run_
        side, force = draw.sideways(run)
        right, left = int(np.argmax(side)), int(np.argmin(side))
        stiffness = (force[right] - force[left]) / (side[right] - side[left])
        inside = float(run.depth_m[left])
        expected = clamped_stiffness(bending_of(1.27e-3, 0.838e-3), self.foundation(),
                                     self.LENGTH - inside, inside)
        self.assert_within(stiffness, expected, 0.05)


class Fig07LiverFlexible(Scene):
    name = "fig07-liver-flexible"

    def test_needle_bends_and_keeps_its_length(self):
        self.check_quiet()
        run = self.run_
        shape = run.shapes(len(run.time_s))[0]
        needle = np.array(shape["needles"][0])
        rods = np.linalg.norm(np.diff(needle, axis=0), axis=1)
        self.assert_within(float(rods.sum()), 0.15, 1e-5)
        chord = (needle[-1] - needle[0]) / np.linalg.norm(needle[-1] - needle[0])
        off = np.linalg.norm(np.cross(needle - needle[0], chord), axis=1).max()
        self.assertGreater(off, 2e-3)
        self.assertGreaterEqual(len(shape["particles"]), 12)
        for particle in shape["particles"]:
            gaps = np.linalg.norm(needle - np.array(particle["position_m"]), axis=1)
            self.assertLess(gaps.min(), 0.6 * rods[0])

    def test_force_on_the_hand_is_the_sum_over_the_particles(self):
        run = self.run_
        shape = run.shapes(len(run.time_s))[0]
        total = np.sum([p["force_n"] for p in shape["particles"]], axis=0)
        self.assertLess(np.linalg.norm(total - run.force_n[-1]),
                        1e-5 * np.linalg.norm(run.force_n[-1]))


class Fig03Puncture(Scene):
    name = "fig03-puncture"

    # Paper mode: the stiffness of a particle is a mass over a tick squared, that of a voxel's
    # corner with two of eight of its neighbours; gel, 5 mm, unit 5 mm.
    STIFFNESS = 1000 * 5e-3**3 / 4 / 1e-3**2
    UNIT = 5e-3

    def test_shows_the_figure(self):
        self.check_quiet()
        self.assertEqual(self.kinds()[:4], ["contact", "release", "contact", "puncture"])
        run = self.run_
        first = slice(0, run.index("release"))
        self.assertEqual(run.particles[first].max(), 1)
        self.assertLess(run.axial_n[first].max(), self.STIFFNESS * self.UNIT)
        self.assertGreater(run.axial_n[first].max(), 0.3 * self.STIFFNESS * self.UNIT)
        at = run.index("puncture")
        self.assertEqual(run.particles[at - 1], 1)
        self.assertGreaterEqual(run.particles[at], 2)
        _, _, _, force = run.events[3]
        self.assert_within(force, self.STIFFNESS * self.UNIT, 0.01)


class Fig04InsertRetract(Scene):
    name = "fig04-insert-retract"
    UNIT = 5e-3

    def test_one_particle_a_unit(self):
        self.check_quiet()
        run = self.run_
        inside = slice(run.index("puncture") + 1, run.index("exit"))
        units = run.depth_m[inside] / self.UNIT
        # the tip, the entry, and one for each whole unit between them
        wrong = np.abs(run.particles[inside] - (units + 1.5))
        self.assertLessEqual(wrong.max(), 1.0)
        # 25 mm of soft gel in 5 mm voxels are pressed in before the puncture, and the report says
        # so.
        self.assertGreater(self.report["dimple_voxels"], 3)
        steps = np.diff(run.particles[inside])
        deepest = int(np.argmax(run.depth_m[inside]))
        self.assertTrue(np.all(steps[:deepest] >= 0))
        self.assertTrue(np.all(steps[deepest:] <= 0))
        self.assertLessEqual(np.abs(steps).max(), 1)
        self.assertEqual(run.particles[-1], 0)


class Fig05StickSlip(Scene):
    name = "fig05-stick-slip"
    COULOMB, VISCOUS, SPEED = 40, 30, 6e-3  # muscle, N/m; N s/m2; m/s
    SHEAR = 40e3 / 2.9

    def test_saturates_at_the_friction(self):
        self.check_quiet()
        run = self.run_
        slipping = slice(13833, 14633)  # fourth stroke, on the way in
        friction = (self.COULOMB + self.VISCOUS * self.SPEED) * run.depth_m[slipping]
        self.assertLess(np.abs(run.parts_n["friction"][slipping] / friction - 1).max(), 0.02)

    def test_loop_has_the_area_of_an_elastoplastic_one(self):
        run = self.run_
        loop = slice(10648, 14648)  # strokes 3 and 4: out and back
        way, force = run.hand_m[loop], run.axial_n[loop]
        area = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(way)))
        amplitude = np.ptp(way) / 2
        # Friction grows with depth, so the second halves of both strokes are compared: they lie
        # symmetrically about the middle.
        limit = (force[3000:3900].mean() - force[1000:1900].mean()) / 2
        start = int(np.argmax(way[:200]))
        zero = start + int(np.argmax(force[start:] < 0))
        slide = way[start] - way[zero]
        self.assert_within(area, 4 * limit * (amplitude - slide), 0.05)
        stiffness = force[start] / slide / float(np.mean(run.depth_m[loop]))
        # Between that along a shaft (Randolph and Wroth, 1.3 G) and that across it (3.9 G): a
        # particle has one spring for all directions.
        self.assertTrue(1.3 * self.SHEAR < stiffness < 3.9 * self.SHEAR,
                        f"{stiffness / self.SHEAR:.3f} G of shear stiffness per length")


class Fig08LiverRigid(Scene):
    name = "fig08-liver-rigid"

    def test_stages(self):
        self.check_quiet()
        names = [row["name"] for row in self.report["phases"]]
        self.assertEqual(names[:7], ["approach", "contact", "puncture", "insertion", "hold",
                                     "retraction", "exit"])
        self.assertEqual(self.kinds().count("puncture"), 1)
        run = self.run_
        self.assertGreater(run.depth_m.max(), 0.035)
        after = run.force_n[run.index("exit") + 50:]
        self.assertLess(np.abs(after).max(), 0.01)

    def test_the_surface_is_drawn_in_and_comes_back(self):
        run = self.run_
        before, dented, after = run.shapes(1, run.index("puncture"), len(run.time_s))
        rest = np.array(before["surface_m"])
        depth = np.linalg.norm(np.array(dented["surface_m"]) - rest, axis=1).max()
        left = np.linalg.norm(np.array(after["surface_m"]) - rest, axis=1).max()
        self.assertGreater(depth, 1e-3)
        self.assertLess(left, 0.05 * depth)


class Fig09ForceCurve(Scene):
    """What its curve must show is in cli_test.py."""

    name = "fig09-force-curve"

    def test_all_phases(self):
        self.check_quiet()
        self.assertEqual(self.kinds()[:2], ["contact", "puncture"])


class Fig10Steering(Scene):
    name = "fig10-steering"
    TARGET = np.array([130, 0, 8]) * 1e-3
    HAND = """[hand]
stiffness_n_per_m = 20000
damping_n_s_per_m = 100
[[hand.waypoint]]
travel_mm = {travel}
speed_mm_s = 10
hold_s = 0.5
"""

    def pushed(self, travel_mm, obstacles=True, modulus_kpa=50):
        """The same needle pushed straight in by a hand that does not roll it."""
        text = (play.HERE / f"{self.name}.toml").read_text()
        before, after = text.split("[steering]")
        bodies = "[[obstacles]]" + after.split("[[obstacles]]", 1)[1] if obstacles else ""
        text = before.replace('"steered"', '"simulated"') + self.HAND.format(travel=travel_mm)
        scene = self.folder / "pushed.toml"
        scene.write_text(text + bodies)
        gel = (play.HERE / "steering-gel.tissues").read_text()
        tissue = self.folder / "gel.tissues"
        tissue.write_text(gel.replace("youngs_modulus_kpa = 50",
                                      f"youngs_modulus_kpa = {modulus_kpa}"))
        command = [str(tissue) if word.endswith("steering-gel.tissues") else word
                  for word in play.organ_command_of(self.name)]
        organ = self.folder / "pushed.organ"
        play.call([play.BIN / command[0], *command[1:], "-o", organ])
        recording = self.folder / "pushed.h5"
        play.call([play.BIN / "stylet", "run", scene, "--organ", organ, "--fast", "--force",
                   "--record", recording])
        return draw.Run(recording)

    def test_reaches_the_target_past_the_cubes(self):
        self.check_quiet()
        self.assertNotIn("obstacle", self.kinds())
        miss = np.linalg.norm(self.run_.tip_m[-1] - self.TARGET)
        self.assertLess(miss, 2e-3)
        self.assertLess(self.run_.bevel[:, 2].min(), -0.9)  # rolled to one side and the other
        self.assertGreater(self.run_.bevel[:, 2].max(), 0.9)

    def test_without_the_roll_it_hits(self):
        kinds = [kind for _, kind, _, _ in self.pushed(60).events]
        self.assertIn("obstacle", kinds)

    def test_stiffer_tissue_deflects_it_more(self):
        aside = [abs(self.pushed(90, obstacles=False, modulus_kpa=modulus).tip_m[-1, 2])
                 for modulus in (5, 20, 100)]
        self.assertGreater(aside[1], 1.5 * aside[0])
        self.assertGreater(aside[2], 1.3 * aside[1])


class LumbarPuncture(Scene):
    name = "lumbar-puncture"
    SKIN, FAT, LIGAMENT, FLAVUM, EPIDURAL = range(5)

    def test_layers_in_order(self):
        self.check_quiet()
        entered = [(kind, layer) for _, kind, layer, _ in self.run_.events
                   if kind in ("puncture", "layer")][:5]
        self.assertEqual(entered, [("puncture", self.SKIN), ("layer", self.FAT),
                                   ("puncture", self.LIGAMENT), ("puncture", self.FLAVUM),
                                   ("layer", self.EPIDURAL)])

    def test_loss_of_resistance_within_one_tick(self):
        run = self.run_
        at = next(tick for tick, _, layer, _ in run.events if layer == self.EPIDURAL) - 1
        cutting = run.parts_n["cutting"]
        self.assert_within(cutting[at - 1], 9, 0.02)  # what it takes to cut the ligamentum flavum
        self.assertLess(cutting[at], 0.1)
        # The tissue that the tip had dragged along springs back and rubs on the needle, so the
        # total follows later.
        self.assertLess(run.axial_n[at], 0.7 * run.axial_n[at - 1])
        self.assertLess(run.axial_n[at + 150], 0.25 * run.axial_n[at - 1])


class LiverBiopsy(Scene):
    name = "liver-biopsy"
    LIVER, TUMOUR, SKIN, FAT, MUSCLE, CAPSULE = range(6)
    GAP = 0xFFFFFFFF  # between wall and liver
    CENTRE, RADIUS = np.array([-20, 109, 190]) * 1e-3, 12e-3

    def test_each_layer_is_entered_in_turn_and_punctured_at_its_force(self):
        self.check_quiet()
        entered = [(kind, layer) for _, kind, layer, _ in self.run_.events
                   if kind in ("puncture", "layer")][:7]
        self.assertEqual(entered, [("puncture", self.SKIN), ("layer", self.FAT),
                                   ("puncture", self.MUSCLE), ("layer", self.GAP),
                                   ("puncture", self.CAPSULE),
                                   ("layer", self.LIVER), ("puncture", self.TUMOUR)])
        forces = [force for _, kind, _, force in self.run_.events if kind == "puncture"]
        for force, expected in zip(forces, (0.4, 1.2, 0.7, 1), strict=True):
            self.assert_within(force, expected, 0.02)

    def test_tip_comes_to_the_tumour(self):
        tips = self.run_.tip_m
        self.assertLess(np.linalg.norm(tips - self.CENTRE, axis=1).min(), self.RADIUS)


class SmallTumour(Scene):
    name = "small-tumour"
    LIVER, TUMOUR, CAPSULE = range(3)
    CENTRE, RADIUS = np.array([-60, 120, 150]) * 1e-3, 4e-3

    def test_capsule_and_tumour_are_punctured_at_their_forces(self):
        self.check_quiet()
        entered = [(kind, layer, force) for _, kind, layer, force in self.run_.events
                   if kind in ("puncture", "layer")][:3]
        self.assertEqual([(kind, layer) for kind, layer, _ in entered],
                         [("puncture", self.CAPSULE), ("layer", self.LIVER),
                          ("puncture", self.TUMOUR)])
        self.assert_within(entered[0][2], 0.7, 0.02)
        self.assert_within(entered[2][2], 1, 0.02)

    def test_tip_comes_to_the_tumour(self):
        tips = self.run_.tip_m
        self.assertLess(np.linalg.norm(tips - self.CENTRE, axis=1).min(), self.RADIUS)

    def test_the_tumour_has_voxels_of_its_own(self):
        """Of its 268 mm3, which one voxel of 5 mm would exceed by half."""
        report = json.loads(play.call([play.BIN / "stylet-organ", "info",
                                       self.folder / f"{self.name}.organ", "--json"]))
        tumour = next(m for m in report["materials"] if m["name"] == "tumour")
        self.assertGreater(tumour["voxels"], 100)


class ProstateTemplate(Scene):
    name = "prostate-template"

    def test_each_needle_meets_the_layers_on_its_own(self):
        self.check_quiet()
        with h5py.File(self.run_.path) as file:
            rows = list(zip(file["events/needle"], file["events/kind"], file["events/layer"],
                            file["events/force_n"]))
        for needle in (0, 1):
            met = [(draw.EVENTS[kind], int(layer)) for n, kind, layer, _ in rows if n == needle]
            self.assertEqual(met, [("contact", 0), ("puncture", 0), ("layer", 1), ("layer", 2),
                                   ("puncture", 3), ("layer", 4)])
        forces = [[force for n, kind, _, force in rows if n == needle and
                   draw.EVENTS[kind] == "puncture"] for needle in (0, 1)]
        np.testing.assert_allclose(forces[0], forces[1], rtol=0.01)
        np.testing.assert_allclose(forces[0], [2, 2], rtol=0.02)


class ProstateSpinning(Scene):
    name = "prostate-spinning"
    DUTY = (0, 0.5, 1)

    def test_spinning_leaves_the_needles_bent_by_the_rest(self):
        self.check_quiet()
        runs = [draw.Run(self.run_.path, needle) for needle in range(3)]
        aside = [run.tip_m[-1, 2] - run.tip_m[0, 2] for run in runs]
        self.assertGreater(aside[0], 2e-3)  # out of the target on its line
        for duty, way in zip(self.DUTY, aside):
            self.assertLess(abs(way / aside[0] - (1 - duty)), 0.05, aside)

    def test_middle_needle_rolls_half_of_the_time(self):
        with h5py.File(self.run_.path) as file:
            w, _, _, z = np.asarray(file["needle1/device/rotation_wxyz"], float).T
        turns = np.unwrap(2 * np.arctan2(z, w)) / (2 * np.pi)
        self.assert_within(turns[-1], 38, 1e-6)
        rolls = np.diff(turns[:9000]) > 1e-6  # 80 and 10 mm at 10 mm/s
        self.assert_within(float(np.mean(rolls)), 0.5, 0.02)
        self.assert_within(float(np.max(np.diff(turns))), 38 / 9 / 0.5 * 1e-3, 0.02)


def poiseuille(bore_m, length_m, viscosity_pa_s):
    """Resistance of a needle's bore, Pa s/m^3."""
    return 128 * viscosity_pa_s * length_m / (np.pi * bore_m**4)


class FluidScene(Scene):
    """A scene with fluid in its needle."""

    def entered(self):
        return [layer for _, kind, layer, _ in self.run_.events if kind in ("puncture", "layer")]

    def the_only(self, kind):
        """Tick and layer of the only event of this kind."""
        (tick, _, layer, _), = (event for event in self.run_.events if event[1] == kind)
        return tick, layer


class EpiduralSyringe(FluidScene):
    name = "epidural-syringe"
    SKIN, FAT, LIGAMENT, FLAVUM, EPIDURAL, CSF, DURA = range(7)
    PLUNGER_M2, THUMB_N, FRICTION_N = np.pi * 7.5e-3**2, 11.4, 0.5

    def test_the_plunger_holds_until_the_epidural_space(self):
        self.check_quiet()
        run = self.run_
        tick, layer = self.the_only("loss of resistance")
        self.assertEqual(layer, self.EPIDURAL)
        self.assertEqual(self.entered()[:5], list(range(5)))
        self.assertNotIn(self.DURA, self.entered())
        self.assertNotIn("obstacle", self.kinds())
        # The opening is 1.5 mm behind the tip, the face 45 mm deep in tissue at rest.
        self.assertLess(abs(run.depth_m[tick - 1] - 46.5e-3), 0.5e-3)
        held = (run.plunger_n > 11) & (np.arange(1, len(run.time_s) + 1) < tick)
        self.assertGreater(np.count_nonzero(held), 1000)
        pressed_pa = (self.THUMB_N - self.FRICTION_N) / self.PLUNGER_M2
        np.testing.assert_allclose(run.hub_pa[held], pressed_pa, rtol=1e-3)
        self.assertEqual(np.abs(run.flow_m3_per_s[held]).max(), 0)

    def test_then_it_gives_way_as_the_bore_lets_it(self):
        run = self.run_
        tick, _ = self.the_only("loss of resistance")
        resistance = poiseuille(1.067e-3, 90e-3, 1e-3) + 1 / 2000e-12
        pressed_pa = (self.THUMB_N - self.FRICTION_N) / self.PLUNGER_M2 + 40
        self.assert_within(run.flow_m3_per_s[tick], pressed_pa / resistance, 1e-3)
        self.assertGreater(run.injected_m3.max(), 2e-6)
        self.assertLessEqual(run.injected_m3.max(), 6.1e-6)


class SpinalTap(FluidScene):
    name = "spinal-tap"
    CSF, DURA = 5, 6
    PRESSURE_PA, VISCOSITY_PA_S, BORE_M, LENGTH_M = 1420, 0.8e-3, 0.413e-3, 90e-3

    def test_fluid_comes_up_as_washburn_says(self):
        self.check_quiet()
        run = self.run_
        tick, layer = self.the_only("flashback")
        self.assertEqual(layer, self.CSF)
        self.assertEqual(self.entered()[:7], [0, 1, 2, 3, 4, self.DURA, self.CSF])
        began = int(np.flatnonzero(run.filled > 0.01)[0])
        washburn_s = 16 * self.VISCOSITY_PA_S * self.LENGTH_M**2 / (
            self.PRESSURE_PA * self.BORE_M**2)
        self.assert_within((tick - 1 - began) * 1e-3, washburn_s, 0.05)

    def test_then_it_drips_as_poiseuille_says(self):
        run = self.run_
        tick, _ = self.the_only("flashback")
        resistance = poiseuille(self.BORE_M, self.LENGTH_M, self.VISCOSITY_PA_S) + 1 / 1e-8
        self.assert_within(run.flow_m3_per_s[tick + 500], -self.PRESSURE_PA / resistance, 1e-3)


class CentralVein(FluidScene):
    name = "central-vein"
    SKIN, FAT, MUSCLE, VEIN = range(4)

    def test_the_vein_gives_way_before_it_is_punctured(self):
        self.check_quiet()
        run = self.run_
        row = next(tick for tick, kind, layer, _ in run.events
                   if kind == "puncture" and layer == self.VEIN) - 1
        self.assertGreater(run.travel_m[row] - 17.5e-3, 0.5e-3)

    def test_blood_comes_once_the_opening_is_in_it(self):
        run = self.run_
        tick, layer = self.the_only("flashback")
        self.assertEqual(layer, self.VEIN)
        punctured = next(t for t, kind, each, _ in run.events
                         if kind == "puncture" and each == self.VEIN)
        self.assertGreater(tick, punctured)
        self.assertEqual(self.entered()[:4], list(range(4)))
        drawn_pa = (-2 + 0.5) / (np.pi * 6e-3**2)
        resistance = poiseuille(0.838e-3, 70e-3, 3.5e-3) + 1 / 1e-7
        self.assert_within(run.flow_m3_per_s[tick + 300], (drawn_pa - 1000) / resistance, 1e-3)


class LiverUnderWall(Scene):
    name = "liver-under-wall"
    FAT, FASCIA, LIVER, CAPSULE = 3, 4, 0, 5
    SUNK, REST, BREATH = 4999, (11000, 17000), (9000, 15000)

    def faces(self, tick):
        """Points of the wall's inner face and of the liver's face on it, far from edges."""
        start, now = (np.array(shape["surface_m"]) for shape in self.run_.shapes(1, tick))
        near = (np.abs(start - (15e-3, 0, 0)) < (1e-5, 16e-3, 31e-3)).all(1)
        wall = np.arange(len(start)) < 210  # the vertices of liver-under-wall-wall.off are first
        return now[near & wall] - start[near & wall], now[near & ~wall] - start[near & ~wall]

    def slid(self, tick):
        wall, liver = self.faces(tick)
        return liver[:, 2].mean() - wall[:, 2].mean()

    def test_the_liver_has_sunk_along_the_wall_as_its_bed_is_sheared(self):
        self.check_quiet()
        liver_m, bed_m, length_m, pull, press, friction = 45e-3, 15e-3, 100e-3, 4.9, 1.31, 0.1
        liver_pa, bed_pa, poisson, density, bed_density = 23.2e3, 3e3, 0.45, 1060, 1000
        weight_pa = density * liver_m * (pull - friction * press)
        bed_shear_pa = bed_pa / 2 / (1 + poisson)
        sheared = (weight_pa + bed_density * bed_m * pull / 2) / bed_shear_pa * bed_m
        sheared += weight_pa / 2 / (liver_pa / 2 / (1 + poisson)) * liver_m
        # It also turns, as a stiff body on a bed that is pressed between two plates.
        confined_pa = bed_pa * (1 - poisson) / (1 + poisson) / (1 - 2 * poisson)
        turned = weight_pa * length_m * liver_m / 2 / (confined_pa / bed_m * length_m**3 / 12)
        self.assert_within(self.slid(self.SUNK), -sheared - turned * liver_m, 0.1)

    def test_the_needle_goes_through_both_and_the_wall_lies_on_the_liver(self):
        entered = [layer for _, kind, layer, _ in self.run_.events if kind in ("puncture", "layer")]
        self.assertEqual(entered[1:5], [self.FAT, self.FASCIA, self.CAPSULE, self.LIVER])
        for tick in (self.SUNK, *self.REST, *self.BREATH):
            wall, liver = self.faces(tick)
            self.assertLess(wall[:, 0].mean() - liver[:, 0].mean(), 0.3e-3, tick)

    def test_a_breath_bends_the_needle_as_a_beam_and_force_and_place_come_back(self):
        run, (before, after) = self.run_, self.REST
        free_m = 75e-3  # from the hand to the skin; what holds it there is no hinge and no clamp
        bends = bending_of(1.27e-3, 0.838e-3) * 8e-3 / free_m**3
        for tick in self.BREATH:
            force_n = run.force_n[11999, 2] - run.force_n[tick - 1, 2]
            self.assertGreater(force_n, 3 * bends * 0.9)
            self.assertLess(force_n, 12 * bends)
        change_n = np.linalg.norm(run.force_n[after - 1] - run.force_n[before - 1])
        self.assertLess(change_n, 0.05 * np.linalg.norm(run.force_n[before - 1]))
        self.assertLess(abs(self.slid(after) - self.slid(before)), 0.1e-3)
        # Withdrawn, the liver lies where it lay, but for friction.
        self.assert_within(self.slid(len(run.time_s)), self.slid(self.SUNK), 0.1)


if __name__ == "__main__":
    unittest.main()
