#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""stylet_organ: organs made from arrays are those that stylet-organ makes from files, byte for
byte; what the program refuses is refused in its words; a build does not block the interpreter and
obeys Ctrl-C.

Expected values: the files and messages of the program stylet-organ.
"""
import ast
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import tomllib
import unittest
import warnings

import numpy as np
import stylet
import stylet_organ
from support import SOURCE, program

MM = 1e-3
RECIPE = """[tissues]
liver = [1, "lobe"]
tumour = [7]
[names]
lobe = 3
[surface]
smoothing = 4
[obstacles]
rib = [200]
[targets]
lesion = [7]
"""
AS_DICT = {"tissues": {"liver": [1, "lobe"], "tumour": (7,)}, "names": {"lobe": 3},
           "surface": {"smoothing": np.int64(4)}, "obstacles": {"rib": [200]},
           "targets": {"lesion": np.array([7])}}
OWN = {"liver": {"youngs_modulus_kpa": 31.5, "source": "a test"}}
OWN_TEXT = '[liver]\nyoungs_modulus_kpa = 31.5\nsource = "a test"\n'


def random_labels(random):
    """A ball of liver in two parts with a lesion, and a rib beside it: z, y, x."""
    size = random.integers(18, 26, 3)
    at = np.stack(np.meshgrid(*(np.arange(n) - n / 2 for n in size), indexing="ij"), axis=-1)
    far = np.linalg.norm(at, axis=-1) + random.normal(0, 0.3, tuple(size))
    labels = np.where(far < 8, np.where(at[..., 2] > 1, 1, 3), 0).astype(np.uint8)
    labels[np.linalg.norm(at - [1, 1, -2], axis=-1) < 3] = 7
    labels[1:4, :, 0:3] = 200
    return labels


class Frame:
    """Geometry of a map: steps in mm along the axes of voxels, in columns, and the position of the
    first voxel."""

    def __init__(self, random, oblique):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0] if oblique else np.eye(3)
        self.steps_mm = np.round(turn * random.uniform(3, 5, 3), 6)
        self.origin_mm = np.round(random.uniform(-90, 90, 3), 6)

    def affine_m(self):
        affine = np.eye(4)
        affine[:3, :3], affine[:3, 3] = self.steps_mm * MM, self.origin_mm * MM
        return affine

    def nrrd(self, labels):
        kind = {"u1": "uint8", "u2": "uint16", "i4": "int32", "f8": "double"}[labels.dtype.str[1:]]
        steps = " ".join("({!r},{!r},{!r})".format(*map(float, step)) for step in self.steps_mm.T)
        origin = "({!r},{!r},{!r})".format(*map(float, self.origin_mm))
        sizes = " ".join(map(str, labels.shape[::-1]))
        return (f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {sizes}\nendian: little\n"
                f"space: left-posterior-superior\nspace directions: {steps}\n"
                f"space origin: {origin}\nencoding: raw\n\n").encode() + labels.tobytes()


class Case(unittest.TestCase):
    def setUp(self):
        top = tempfile.TemporaryDirectory()
        self.addCleanup(top.cleanup)
        self.top = pathlib.Path(top.name)
        self.map, self.recipe = self.top / "map.nrrd", self.top / "recipe.toml"
        self.recipe.write_text(RECIPE)
        self.materials = self.top / "own.toml"
        self.materials.write_text(OWN_TEXT)
        warnings.simplefilter("ignore")

    def program(self, *words):
        """The organ that the program makes, and what it prints as JSON."""
        made = self.top / "program.organ"
        done = subprocess.run([program("stylet-organ"), "build", *words, "-o", made, "--json"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return made.read_bytes(), json.loads(done.stdout)


class Labels(Case):
    SETTINGS = (((), {}),
                (("--voxel-mm", "4.7", "--capsule", "none", "--fix", "x<20%"),
                 {"voxel_edge_m": 0.0047, "capsule": "none", "fix": "x<20%"}),
                (("--voxels-across", "9", "--name", "mine", "--split-gaps", "--crop", "z>30%"),
                 {"voxels_across": 9, "name": "mine", "split_gaps": True, "crop": ["z>30%"]}),
                (("--slide", "tumour:liver:0.3"), {"slides": ["tumour:liver:0.3"]}),
                (("--refine", "labels:tumour:2", "--refine", "surface"),
                 {"refine": ["labels:tumour:2", "surface"]}),
                (("--layers-of", "liver", "--layers-along", "-y", "--layer", "fat:8", "--layer",
                  "muscle:90", "--fill-gaps", "fat:3"),
                 {"layers_of": "liver", "layers_along": "-y", "layers": ["fat:8", "muscle:90"],
                  "fill_gaps": "fat:3"}))

    def test_bytes_are_those_of_the_program(self):
        random = np.random.default_rng(17)
        for i, (words, options) in enumerate(self.SETTINGS * 2):
            labels = random_labels(random).astype(["<u1", "<u2", "<i4", "<f8"][i % 4])
            frame = Frame(random, oblique=i % 2 == 1)
            self.map.write_bytes(frame.nrrd(labels))
            expected, _ = self.program(self.map, "--recipe", self.recipe, "--materials",
                                       self.materials, *words)
            built = stylet_organ.from_labels(
                labels, recipe=self.recipe, affine_m=frame.affine_m(), source=self.map,
                materials=self.materials, **options)
            self.assertEqual(built.content, expected, words)
            self.assertEqual(built.organ.info.hash, stylet.Organ.from_bytes(expected).info.hash)

    def test_orders_types_and_layouts_in_memory_give_the_same(self):
        random = np.random.default_rng(5)
        labels = random_labels(random)
        spread = np.zeros(tuple(2 * n for n in labels.shape), np.uint8)
        spread[::2, ::2, ::2] = labels

        def made(given, order="zyx"):
            return stylet_organ.from_labels(given, recipe=AS_DICT, order=order,
                                            spacing_m=(4 * MM, 3 * MM, 5 * MM)).content
        expected = made(labels)
        for dtype in ("u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8", ">u2", ">f8"):
            self.assertEqual(made(labels.astype(dtype)), expected, dtype)
        self.assertEqual(made(np.asfortranarray(labels)), expected)
        self.assertEqual(made(spread[::2, ::2, ::2]), expected)
        self.assertEqual(made(labels.T, "xyz"), expected)
        self.assertEqual(made(np.ascontiguousarray(labels.T), "xyz"), expected)
        self.assertEqual(made(labels.transpose(1, 2, 0), "yxz"), expected)
        turned = labels[::-1, ::-1, ::-1]
        self.assertNotEqual(made(turned), expected)
        self.assertEqual(made(turned[::-1, ::-1, ::-1]), expected)
        self.assertEqual(stylet_organ.from_labels(
            labels == 1, {1: "liver"}, spacing_m=3 * [4 * MM]).organ.info.materials, 2)

    def test_tables_give_the_same_as_files(self):
        """Except for what the provenance says about them."""
        labels, frame = random_labels(np.random.default_rng(6)), Frame(np.random.default_rng(6), 0)
        self.map.write_bytes(frame.nrrd(labels))
        spacing_m, origin_m = np.diag(frame.steps_mm) * MM, frame.origin_mm * MM
        files = stylet_organ.from_labels(labels, recipe=self.recipe, spacing_m=spacing_m,
                                         origin_m=origin_m, materials=self.materials)
        dicts = stylet_organ.from_labels(labels, recipe=AS_DICT, spacing_m=spacing_m,
                                         origin_m=origin_m, materials=OWN)
        pairs = stylet_organ.from_labels(
            labels, {1: "liver", 3: "liver", 7: "tumour"}, spacing_m=spacing_m, origin_m=origin_m,
            materials=OWN)
        for name in ("voxels", "vertices", "triangles"):
            np.testing.assert_array_equal(getattr(files.organ, name), getattr(dicts.organ, name))
        self.assertEqual(files.organ.materials, dicts.organ.materials)
        self.assertEqual(pairs.content, stylet_organ.from_labels(
            labels, recipe={"tissues": {"liver": [1, 3], "tumour": [7]}}, spacing_m=spacing_m,
            origin_m=origin_m, materials=OWN).content)
        self.assertEqual(files.organ.materials[0].youngs_modulus_pa, 31500)
        self.assertEqual(files.organ.materials[0].source, "a test")

    def test_targets_and_obstacles_beside_the_organ(self):
        labels, frame = random_labels(np.random.default_rng(8)), Frame(np.random.default_rng(8), 1)
        self.map.write_bytes(frame.nrrd(labels))
        _, facts = self.program(self.map, "--recipe", self.recipe)
        built = stylet_organ.from_labels(labels, recipe=self.recipe, affine_m=frame.affine_m())
        self.assertEqual(list(built.warnings), facts["warnings"])
        self.assertTrue(built.warnings)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            stylet_organ.from_labels(labels, recipe=self.recipe, affine_m=frame.affine_m())
        self.assertEqual([str(each.message) for each in told], list(built.warnings))
        self.assertEqual(list(built.obstacles), ["rib"])
        hull = tomllib.loads(pathlib.Path(facts["scene"]["obstacles"][0]["file"]).read_text())
        np.testing.assert_allclose(hull["vertices_m"], built.obstacles["rib"], atol=1e-6)
        self.assertEqual(stylet.Obstacle.hull(built.obstacles["rib"]).vertex_count,
                         len(built.obstacles["rib"]))
        name, at_m, radius_m = built.targets[0]
        place = (labels == 7).nonzero()
        middle = frame.affine_m() @ [*np.mean(place, axis=1)[::-1], 1]
        self.assertEqual(name, "lesion")
        self.assertLess(np.linalg.norm(middle[:3] - at_m), 4 * MM)  # a voxel of the map
        volume = len(place[0]) * abs(np.linalg.det(frame.affine_m()[:3, :3]))
        self.assertAlmostEqual(radius_m, (volume * 3 / 4 / np.pi) ** (1 / 3), places=6)
        built.write(self.top / "again.organ")
        self.assertEqual((self.top / "again.organ").read_bytes(), built.content)

    def test_an_affine_of_nifti(self):
        """NIfTI's axes are right, anterior, superior, in mm: 2 mm to the right are -2 mm to the
        left."""
        ras = np.array([[2, 0, 0, 10], [0, 3, 0, -20], [0, 0, 4, 30], [0, 0, 0, 1.0]])
        np.testing.assert_allclose(stylet_organ.affine_m_of_nifti(ras),
                                   [[-.002, 0, 0, -.01], [0, -.003, 0, .02], [0, 0, .004, .03],
                                    [0, 0, 0, 1]], atol=1e-15)


    def test_takes_no_more_memory_than_the_program(self):
        """The program frees the file's bytes before it builds: with 61 MB of voxels, a second copy
        of the array would be noticed."""
        frame = Frame(np.random.default_rng(1), False)
        labels = np.zeros((400, 400, 400), np.uint8)
        labels[180:220, 180:220, 180:220] = 1
        self.map.write_bytes(frame.nrrd(labels))
        self.recipe.write_text("[tissues]\ngel = [1]\n")
        np.save(self.top / "labels.npy", labels)
        (self.top / "peaks.py").write_text(textwrap.dedent("""
            import re, resource, subprocess, sys
            subprocess.run(sys.argv[1:], check=True, capture_output=True)
            program_kb = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            import numpy, stylet_organ
            def peak_kb():
                return int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1])
            labels = numpy.load("labels.npy")
            def build(given):
                stylet_organ.from_labels(given, {1: "gel"}, spacing_m=3 * [0.004])
            build(numpy.ones((5, 5, 5), int))
            before_kb = peak_kb()
            build(labels)
            print(program_kb, peak_kb() - before_kb)
            """))
        said = subprocess.run(
            [sys.executable, "peaks.py", program("stylet-organ"), "build", self.map, "--recipe",
             self.recipe, "-o", "o.organ"], cwd=self.top, check=True, capture_output=True,
            text=True)
        program_kb, here_kb = map(int, said.stdout.split())
        self.assertLess(here_kb, program_kb + 20e3)


class Meshes(Case):
    def off(self, name, vertices, faces):
        path = self.top / name
        path.write_text(f"OFF\n{len(vertices)} {len(faces)} 0\n" + "".join(
            "{!r} {!r} {!r}\n".format(*map(float, v)) for v in vertices) + "".join(
            "3 {} {} {}\n".format(*f) for f in faces))
        return path

    def box(self, low, high):
        corners = np.array([[(high if i >> axis & 1 else low)[axis] for axis in range(3)]
                            for i in range(8)])
        faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3),
                 (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
        return corners, np.array(faces, np.uint32)

    def test_bytes_are_those_of_the_program(self):
        random = np.random.default_rng(3)
        for words, options in (((), {}),
                               (("--voxel-mm", "3", "--capsule", "none", "--wrap"),
                                {"voxel_edge_m": 0.003, "capsule": "none", "wrap": True}),
                               (("--refine", "way:-50,0,0:50,0,0:8.5:2"),
                                {"refine": "way:-50,0,0:50,0,0:8.5:2"})):
            low = random.uniform(-0.02, 0.0, 3)
            outer = self.box(low, low + random.uniform(0.03, 0.05, 3))
            inner = self.box(low + 0.01, low + 0.02)
            paths = [self.off("outer.off", *outer), self.off("inner.off", *inner)]
            expected, _ = self.program(f"{paths[0]}:muscle", f"{paths[1]}:tumour:2", "--units", "m",
                                       *words)
            meshes = [stylet_organ.Mesh(*outer, "muscle", source=paths[0]),
                      stylet_organ.Mesh(*inner, "tumour", 2, paths[1])]
            self.assertEqual(stylet_organ.from_meshes(meshes, **options).content, expected)
            expected, _ = self.program(paths[0], "--units", "m", *words)
            one = stylet_organ.from_mesh(*outer, **options)
            np.testing.assert_array_equal(one.organ.voxels,
                                          stylet.Organ.from_bytes(expected).voxels)

    def test_cubes_of_all_levels_fill_the_mesh(self):
        random = np.random.default_rng(9)
        low = random.uniform(-0.02, 0.02, 3)
        high = low + random.uniform(0.03, 0.05, 3)
        way = "way:{0[0]},{0[1]},{0[2]}:{1[0]},{1[1]},{1[2]}:4:2".format(1e3 * low, 1e3 * high)
        organ = stylet_organ.from_mesh(*self.box(low, high), voxel_edge_m=0.004, refine=way).organ
        cubes, fill = organ.cubes, organ.voxels["fill"]
        edges_um = {round(1e6 * edge) for edge in cubes["edge_m"].tolist()}
        self.assertEqual(edges_um, {1000, 2000, 4000})
        volume = np.sum(fill.astype(float) * cubes["edge_m"].astype(float) ** 3)
        self.assertAlmostEqual(volume / np.prod(high - low), 1, delta=0.02)
        # Every place in the box lies in one cube, and cubes reach no farther than the box.
        edges = cubes["edge_m"][:, None]
        for place in random.uniform(low, high, (400, 3)):
            within = (cubes["low_m"] <= place) & (place < cubes["low_m"] + edges)
            self.assertEqual(np.count_nonzero(within.all(1)), 1, place)
        self.assertTrue((cubes["low_m"] + edges > low).all() and (cubes["low_m"] < high).all())

    def test_refusals(self):
        vertices, faces = self.box(np.zeros(3), np.full(3, 0.03))
        for words, kind, mesh in (
                ("face 0: vertex 9: expected 0 to 7", ValueError, (vertices, [[0, 1, 9]])),
                ("vertex 8: expected finite", ValueError,
                 (np.vstack([vertices, [[np.nan, 0, 0]]]), faces)),
                ("no faces", ValueError, (vertices, np.zeros((0, 3), int))),
                ("vertices of shape", ValueError, (vertices[:, :2], faces)),
                ("faces of shape", ValueError, (vertices, faces[:, :2])),
                ("faces of float64", TypeError, (vertices, faces.astype(float))),
                ("vertices of complex128", TypeError, (vertices.astype(complex), faces)),
                ("mesh: vertices: 3 of 24 are masked", ValueError,
                 (np.ma.masked_array(vertices, np.arange(24).reshape(8, 3) > 20), faces)),
                ("mesh: faces: 1 of 36 are masked", ValueError,
                 (vertices, np.ma.masked_array(faces, np.arange(36).reshape(12, 3) == 7))),
                ("or wrap=True", stylet_organ.Refused, (vertices, faces[:1])),
                ("tissue 'livr'", stylet_organ.Refused, (vertices, faces, "livr"))):
            with self.assertRaisesRegex(kind, words):
                stylet_organ.from_mesh(*mesh)
        with self.assertRaisesRegex(ValueError, "one at least"):
            stylet_organ.from_meshes([])


class Refused(Case):
    def test_in_the_programs_words(self):
        labels, frame = random_labels(np.random.default_rng(2)), Frame(np.random.default_rng(2), 0)
        self.map.write_bytes(frame.nrrd(labels))
        for words, options, names in (
                (("--fix", "q>5"), {"fix": ["q>5"]}, {"--fix": "fix"}),
                (("--fix", "x<-999"), {"fix": "x<-999"},
                 {"--fix none": "fix='none'", "--fix": "fix"}),
                (("--crop", "x>999"), {"crop": "x>999"}, {"--crop": "crop"}),
                (("--voxel-mm", "1e9"), {"voxel_edge_m": 1e6}, {}),
                (("--voxels-across", "5000"), {"voxels_across": 5000},
                 {"--voxels-across": "voxels_across",
                  "check --units and --scale": "check that all lengths are in m"}),
                (("--fill-gaps", "fat:900"), {"fill_gaps": "fat:900"},
                 {"--fill-gaps": "fill_gaps"}),
                (("--capsule", "livr"), {"capsule": "livr"}, {}),
                (("--layers-of", "skin", "--layer", "fat:3"),
                 {"layers_of": "skin", "layers": "fat:3"},
                 {"--layers-of": "layers_of", "--layer": "layers"})):
            done = subprocess.run([program("stylet-organ"), "build", self.map, "--recipe",
                                   self.recipe, "-o", self.top / "o.organ", *words],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            with self.assertRaises(stylet_organ.Refused) as refused:
                stylet_organ.from_labels(labels, recipe=self.recipe, affine_m=frame.affine_m(),
                                         **options)
            said = done.stderr.splitlines()[-1].removeprefix("stylet-organ: ").removeprefix(
                "error: ")
            for option, argument in names.items():
                self.assertIn(option, said)
                said = said.replace(option, argument)
            self.assertEqual(str(refused.exception), said)
            self.assertNotIn("--", said)

    def test_arrays_and_arguments(self):
        good = np.ones((6, 6, 6), np.uint8)
        tissue, spacing = {"tissues": {1: "gel"}}, {"spacing_m": 3 * [5 * MM]}
        both = {**tissue, **spacing}
        for words, kind, labels, named in (
                ("labels of complex128", TypeError, good.astype(complex), both),
                ("labels of object", TypeError, good.astype(object), both),
                ("labels of float16", TypeError, good.astype(np.float16), both),
                (r"labels of shape \(6, 6\)", ValueError, good[0], both),
                ("voxel 0: 1.5: expected labels", ValueError, good * 1.5, both),
                ("voxel 0: -1: expected labels", ValueError, -good.astype(int), both),
                ("more than 500 different", ValueError,
                 np.arange(1000, dtype=np.uint16).reshape(10, 10, 10), both),
                ("0 voxels along an axis", ValueError, good[:0], both),
                ("either tissues or a recipe", TypeError, good, spacing),
                ("either spacing_m or affine_m", TypeError, good, tissue),
                (r"spacing_m of shape \(2,\)", ValueError, good, {**tissue, "spacing_m": (1, 2)}),
                ("expected more than 0", ValueError, good, {**tissue, "spacing_m": (1, 2, 0)}),
                ("spacing_m = .*more than 0.*affine_m", ValueError, good,
                 {**tissue, "spacing_m": (-1 * MM, MM, MM)}),
                ("spacing_m = .*finite", ValueError, good,
                 {**tissue, "spacing_m": (MM, np.inf, MM)}),
                ("origin_m = .*finite", ValueError, good, {**both, "origin_m": (0, np.nan, 0)}),
                ("tissues: 'gel': expected a dict", TypeError, good, {**spacing, "tissues": "gel"}),
                ("tissues: \\[1, 2\\]: expected a dict", TypeError, good,
                 {**spacing, "tissues": [1, 2]}),
                ("origin_m beside affine_m", TypeError, good,
                 {**tissue, "affine_m": np.eye(4), "origin_m": (0, 0, 0)}),
                ("labels: 1 of 216 are masked.*numpy.ma.filled", ValueError,
                 np.ma.masked_array(good, np.arange(216).reshape(good.shape) == 5), both),
                ("spacing_m: 1 of 3 are masked", ValueError, good,
                 {**tissue, "spacing_m": np.ma.masked_less([5., 5, 1], 2) * MM}),
                ("voxel_edge_m: 'a': expected a number", TypeError, good,
                 {**both, "voxel_edge_m": "a"}),
                ("voxel_edge_m beside voxels_across", TypeError, good,
                 {**both, "voxel_edge_m": .005, "voxels_across": 9}),
                ("affine_m: last row", ValueError, good, {**tissue, "affine_m": np.ones((4, 4))}),
                ("names: 65536: expected a label", ValueError, good,
                 {**both, "names": {65536: "liver"}}),
                ("order 'abc'", ValueError, good, {**both, "order": "abc"}),
                ("voxel_size: there is no such option", TypeError, good, {**both, "voxel_size": 1}),
                ("layers: 3: expected a list", TypeError, good, {**both, "layers": 3}),
                ("voxels_across: 2.5: expected a whole", TypeError, good,
                 {**both, "voxels_across": 2.5}),
                ("recipe: 3: expected a path or a dict", TypeError, good,
                 {**spacing, "recipe": 3}),
                ("recipe.tissues.gel: None: expected", TypeError, good,
                 {**spacing, "recipe": {"tissues": {"gel": None}}}),
                ("recipe: gel: expected a label from 1", ValueError, good,
                 {**spacing, "recipe": {"tissues": {"gel": [70000]}}}),
                ("materials: stiff: unknown key", ValueError, good,
                 {**both, "materials": {"gel": {"stiff": 1}}})):
            with self.assertRaisesRegex(kind, words):
                stylet_organ.from_labels(labels, **named)


    def test_an_empty_mask_is_refused(self):
        good = np.ones((6, 6, 6), np.uint8)
        made = [stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [5 * MM]).content
                for labels in (good, np.ma.masked_array(good, False))]
        self.assertEqual(*made)

    def test_labels_without_a_name(self):
        labels = np.ones((6, 6, 6), np.uint8)
        labels[:2], labels[2, 0, 0] = 5, 9  # 72 and 1 of 216

        def told(tissues, **named):
            return [text for text in stylet_organ.from_labels(
                labels, tissues, spacing_m=3 * [5 * MM], **named).warnings if "no tissue" in text]
        self.assertEqual(told({1: "gel"}), [
            "labels: 5, 9: 34 % of what is labelled is of no tissue, and becomes nothing: expected "
            "these labels in tissues, with None if that is meant"])
        self.assertIn("labels: 9: 0.46 %", told({1: "gel", 5: None})[0])
        self.assertIn("labels: 9: 0.46 %", told({1: "gel", "five": "fat"}, names={5: "five"})[0])
        self.assertEqual(told({1: "gel", np.int64(5): None, 9: "fat"}), [])
        self.assertEqual(told(None, recipe={"tissues": {"gel": [1]}}), [])  # a recipe chooses


class Package(unittest.TestCase):
    def test_readme(self):
        text = (SOURCE / "offline/python/README.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", text, re.S)
        self.assertEqual(len(blocks), 1)
        names = {"numpy": np, "stylet": stylet, "stylet_organ": stylet_organ}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            exec(blocks[0], names)
        self.assertEqual([each.name for each in names["built"].organ.materials],
                         ["liver", "tumour", "liver_capsule"])
        self.assertEqual(names["simulation"].needles, 1)

    def test_stub_has_everything_of_the_module(self):
        stub = ast.parse((SOURCE / "offline/python/package/stylet_organ/_stylet_organ.pyi")
                         .read_text())
        module = stylet_organ._stylet_organ
        public = {name for name in dir(module) if not name.startswith("_")}
        told = {node.name: node for node in stub.body if hasattr(node, "name")}
        self.assertEqual(set(told), public)
        for name, node in told.items():
            if isinstance(node, ast.FunctionDef):
                # pybind11 gives the arguments in the first line of the docstring.
                line = getattr(module, name).__doc__.splitlines()[0]
                given = re.findall(r"(\w+): ", line)
                self.assertEqual([argument.arg for argument in node.args.args], given, name)

    def test_presets_are_those_of_the_program(self):
        """Each number is that in the organ, in the units of its key."""
        built = stylet_organ.from_labels(np.ones((5, 5, 5), np.uint8), {1: "muscle"},
                                         spacing_m=3 * [5 * MM])
        muscle, preset = built.organ.materials[0], stylet_organ.TISSUES["muscle"]
        self.assertEqual(muscle.source, preset["source"])
        self.assertAlmostEqual(muscle.youngs_modulus_pa, 1e3 * preset["youngs_modulus_kpa"])
        self.assertAlmostEqual(muscle.coulomb_friction_n_per_m,
                               1e3 * preset["coulomb_friction_n_per_mm"], places=4)
        again = stylet_organ.from_labels(np.ones((5, 5, 5), np.uint8), {1: "muscle"},
                                         spacing_m=3 * [5 * MM], materials={"muscle": preset})
        self.assertEqual(again.organ.materials, built.organ.materials)


LONG = """
import numpy, stylet_organ, sys
labels = numpy.ones((160, 160, 160), numpy.uint8)
def build(progress=None):
    return stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [1e-3], voxel_edge_m=1e-3,
                                    progress=progress)
"""


class Interpreter(unittest.TestCase):
    def run_script(self, text):
        return subprocess.Popen([sys.executable, "-c", LONG + textwrap.dedent(text)], text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def test_ctrl_c_ends_a_build(self):
        work = self.run_script("""
            print("begins", flush=True)
            try:
                build()
            except KeyboardInterrupt:
                print("interrupted")
            """)
        self.assertEqual(work.stdout.readline(), "begins\n")
        time.sleep(0.3)
        work.send_signal(signal.SIGINT)
        said, errors = work.communicate(timeout=300)
        self.assertEqual((said, work.returncode), ("interrupted\n", 0), errors)

    def test_several_threads_build_at_once(self):
        labels = np.ones((24, 24, 24), np.uint8)
        made = [None] * 4

        def build(i):
            made[i] = stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [3 * MM],
                                               voxel_edge_m=(3 + i % 2) * MM).content
        threads = [threading.Thread(target=build, args=(i,)) for i in range(4)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertEqual(made[0], made[2])
        self.assertEqual(made[1], made[3])
        self.assertNotEqual(made[0], made[1])

    def test_progress_is_reported_and_may_end_the_build(self):
        labels = np.ones((20, 20, 20), np.uint8)
        told = []
        stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [2 * MM],
                                 progress=lambda stage, share: told.append((stage, share)))
        stages = [stage for stage, _ in told]
        self.assertEqual(stages[0], "reading the array")
        self.assertIn("sampling labels", stages)
        self.assertTrue(all(0 <= share <= 1 for _, share in told))

        def stop(stage, share):
            if stage == "sampling labels":
                raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [2 * MM], progress=stop)

    def test_the_interpreter_is_free_while_an_organ_is_built(self):
        """Another thread goes on within each long stage: if a build blocked the interpreter, the
        thread could not count between two calls of progress."""
        counted, stop, at = [0], threading.Event(), []

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0)
        thread = threading.Thread(target=count)
        thread.start()
        try:
            stylet_organ.from_labels(np.ones((60, 60, 60), np.uint8), {1: "gel"},
                                     spacing_m=3 * [2 * MM], voxel_edge_m=2 * MM,
                                     progress=lambda stage, share: at.append(counted[0]))
        finally:
            stop.set()
            thread.join()
        self.assertGreater(np.diff(at).max(), 100)


if __name__ == "__main__":
    os.environ.setdefault("PYTHONUNBUFFERED", "1")
    unittest.main()
