#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Where NRRD, MetaImage and Inrimage lie, by every field of their headers that speaks of it.

Maps, spacings, rotations and origins are drawn; expected volumes and centroids are numpy's, from
the definitions of the formats. What a header leaves open is a warning or a refusal, never silence.

usage: label_frame_test.py [CASE]   (STYLET_BIN)
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

try:
    import numpy
except ImportError:
    numpy = None

TOOL = pathlib.Path(os.environ.get("STYLET_BIN", "build/release/bin")) / "stylet-organ"
UNKNOWN = "left and right are not known"
# What a step along each axis of a space is in LPS.
SPACES = {"left-posterior-superior": (1, 1, 1), "LPS": (1, 1, 1),
          "right-anterior-superior": (-1, -1, 1), "ras": (-1, -1, 1),
          "left-anterior-superior": (1, -1, 1), "LAS": (1, -1, 1),
          "right anterior superior": (-1, -1, 1)}
UNITS_MM = {"mm": 1, "cm": 10, "m": 1000, "um": 1e-3}


def row(numbers):
    return " ".join(map(repr, map(float, numbers)))


@unittest.skipIf(numpy is None, "numpy is not installed: apt-get install python3-numpy")
class Case(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.random = numpy.random.default_rng(20)
        self.draw()

    def draw(self):
        """A map of three boxes, its steps in mm as columns and its origin."""
        shape = self.random.integers(6, 14, 3)
        self.map = numpy.zeros(shape, numpy.uint8)
        for label in (1, 2, 3):
            low = [self.random.integers(0, n - 3) for n in shape]
            high = [self.random.integers(a + 2, n + 1) for a, n in zip(low, shape)]
            self.map[tuple(slice(a, b) for a, b in zip(low, high))] = label
        self.turn = numpy.linalg.qr(self.random.normal(size=(3, 3)))[0]
        self.spacing = self.random.uniform(0.4, 4, 3)
        self.steps = self.turn * self.spacing
        self.origin = self.random.uniform(-300, 300, 3)

    def run_labels(self, path):
        return subprocess.run([TOOL, "labels", "--json", path], capture_output=True, text=True,
                              timeout=60)

    def held(self, path, steps, origin, *notes):
        """The map lies there, and its reader says this and no more."""
        done = self.run_labels(path)
        self.assertEqual(done.returncode, 0, done.stderr)
        facts = json.loads(done.stdout)
        self.assertEqual([each["label"] for each in facts["labels"]],
                         [n for n in numpy.unique(self.map) if n > 0])
        for each in facts["labels"]:
            index = numpy.argwhere(self.map == each["label"])
            volume = len(index) * abs(numpy.linalg.det(steps)) / 1000
            self.assertAlmostEqual(each["volume_ml"] / volume, 1, delta=1e-6)
            place = steps @ index.mean(0) + origin
            numpy.testing.assert_allclose(each["centroid_mm"], place, rtol=1e-6,
                                          atol=1e-6 * numpy.abs(steps).max())
        self.assertEqual(len(facts["notes"]), len(notes), facts["notes"])
        for said, expected in zip(facts["notes"], notes):
            self.assertIn(expected, said)

    def refused(self, path, *said):
        done = self.run_labels(path)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for each in (path.name, *said):
            self.assertIn(each, done.stderr)


class Nrrd(Case):
    def write(self, *lines, space="LPS", steps=None, origin=True, shape=None):
        """Without `space` no directions, too."""
        steps = self.steps if steps is None else steps
        head = ["NRRD0005", "type: uint8", f"dimension: {len(shape or self.map.shape)}"]
        head += [f"space: {space}"] if space else []
        head += ["sizes: " + " ".join(map(str, shape or self.map.shape)), "encoding: raw"]
        if space:
            head.append("space directions: " + " ".join(
                "(%s)" % ",".join(map(repr, map(float, steps[:, i]))) for i in range(3)))
            if origin:
                head.append("space origin: (%s)" % ", ".join(map(repr, map(float, self.origin))))
        path = self.folder / "a.nrrd"
        path.write_bytes("\n".join([*head, *lines, "", ""]).encode() + self.map.tobytes("F"))
        return path

    def test_spaces(self):
        for space, signs in SPACES.items():
            self.draw()
            signs = numpy.array(signs)
            with self.subTest(space):
                self.held(self.write(space=space), signs[:, None] * self.steps,
                          signs * self.origin)
        for space in ("scanner-xyz", "3D-right-handed"):
            self.held(self.write(space=space), self.steps, self.origin, UNKNOWN)
        for space in ("3D-left-handed", "left-posterior-inferior", "LPST"):
            self.refused(self.write(space=space), f"space: {space}", "expected left-posterior")

    def test_units_of_the_space(self):
        for _ in range(8):
            self.draw()
            units = self.random.choice(list(UNITS_MM), 3)
            mm = numpy.array([UNITS_MM[each] for each in units])
            self.held(self.write("space units: " + " ".join(f'"{each}"' for each in units)),
                      mm[:, None] * self.steps, mm * self.origin)
        for units in ('"mm" "mm" "in"', '"mm" "mm"', '"mm" "mm" "mm', "mm mm mm"):
            self.refused(self.write(f"space units: {units}"), f"space units: {units}",
                         "expected")

    def test_spacings_alone_leave_left_and_right_unknown(self):
        bare = numpy.diag(self.spacing)
        said = "spacings: " + row(self.spacing)
        self.held(self.write(said, space=None), bare, numpy.zeros(3), UNKNOWN)
        self.held(self.write(said, 'units: "cm" "m" "mm"', space=None),
                  bare * [10, 1000, 1], numpy.zeros(3), UNKNOWN)
        self.refused(self.write(said, 'units: "cm" "m" "pixel"', space=None), "pixel", "expected")

    def test_ends_of_axes_give_spacing_and_origin(self):
        ends = self.origin + self.spacing * self.map.shape
        least, most = "axis mins: " + row(self.origin), "axis maxs: " + row(ends)
        bare = numpy.diag(self.spacing)
        for centers in ("", "centers: cell cell cell", "centerings: cell ??? cell"):
            self.held(self.write(least, most, *filter(None, [centers]), space=None), bare,
                      self.origin + self.spacing / 2, UNKNOWN)
        between = numpy.diag((ends - self.origin) / (numpy.array(self.map.shape) - 1))
        self.held(self.write(least, most, "centers: node node node", space=None), between,
                  self.origin, UNKNOWN)
        said = "spacings: " + row(self.spacing)
        self.held(self.write(least, said, "centers: cell cell cell", space=None), bare,
                  self.origin + self.spacing / 2, UNKNOWN)
        self.refused(self.write(least, most, "spacings: " + row(self.spacing * [1, 1.1, 1]),
                                space=None), "axis 1", "expected the same")

    def test_no_spacing_is_refused(self):
        for lines in ([], ["thicknesses: 3 3 3"], ["axis mins: 1 2 3"], ["spacings: 1 nan 1"],
                      ["spacings: 1 0 1"], ["spacings: 1 -2 1"], ["spacings: 1 1"],
                      ["spacings: 1 inf 1"], ["spacings: 1 x 1"]):
            with self.subTest(lines):
                self.refused(self.write(*lines, space=None), "spac", "expected")

    def test_no_origin_is_said(self):
        self.held(self.write(origin=False), self.steps, numpy.zeros(3), "no space origin")

    def test_directions_that_are_none(self):
        path = self.write()
        for wrong in ("none (1,0,0) (0,1,0)", "(1,0,0) (0,1,0)", "(1,0) (0,1) (0,0)",
                      "(1,0,0) (0,1,0) (0,nan,1)", "(1,0,0) (0,1,0) (0,0,1", "1 0 0"):
            head, voxels = self.write().read_bytes().split(b"\n\n", 1)
            lines = head.decode().split("\n")
            at = next(i for i, line in enumerate(lines) if line.startswith("space directions"))
            lines[at] = f"space directions: {wrong}"
            path.write_bytes("\n".join(lines).encode() + b"\n\n" + voxels)
            with self.subTest(wrong):
                self.refused(path, "space directions: " + wrong, "expected")

    def test_whole_numbers_of_eight_bytes(self):
        path = self.write()
        head = path.read_bytes().split(b"\n\n", 1)[0].replace(b"uint8", b"int64\nendian: little")
        path.write_bytes(head + b"\n\n" + self.map.astype("<i8").tobytes("F"))
        self.held(path, self.steps, self.origin)


class MetaImage(Case):
    def write(self, *lines, matrix="TransformMatrix", offset="Offset", spacing="ElementSpacing",
              kind="MET_UCHAR", voxels=None):
        head = ["ObjectType = Image", "NDims = 3", *lines]
        head += [f"{matrix} = {row(self.turn.T.flatten())}"] if matrix else []
        head += [f"{offset} = {row(self.origin)}"] if offset else []
        head += [f"{spacing} = {row(self.spacing)}"] if spacing else []
        head += ["DimSize = " + " ".join(map(str, self.map.shape)), f"ElementType = {kind}",
                 "ElementDataFile = LOCAL", ""]
        path = self.folder / "a.mha"
        path.write_bytes("\n".join(head).encode() + (voxels or self.map.tobytes("F")))
        return path

    def test_every_name_of_matrix_and_offset(self):
        for matrix in ("TransformMatrix", "Rotation", "Orientation"):
            for offset in ("Offset", "Position", "Origin"):
                self.draw()
                self.held(self.write(matrix=matrix, offset=offset), self.steps, self.origin)
        self.refused(self.write("Rotation = 1 0 0 0 1 0 0 0 1"), "Rotation", "expected one of")
        self.refused(self.write("Position = 1 2 3"), "Position", "expected one of")

    def test_units(self):
        for unit, mm in {"mm": 1, "cm": 10, "um": 1e-3, "?": 1}.items():
            self.draw()
            self.held(self.write(f"DistanceUnits = {unit}"), mm * self.steps, mm * self.origin)
        for unit in ("in", "km", "mmm"):
            self.refused(self.write(f"DistanceUnits = {unit}"), f"DistanceUnits = {unit}",
                         "expected")

    def test_what_is_not_said(self):
        self.held(self.write(spacing="ElementSize"), self.steps, self.origin)
        self.held(self.write("ElementSize = 9 9 9"), self.steps, self.origin)
        self.refused(self.write(spacing=None), "expected ElementSpacing")
        self.held(self.write(matrix=None), numpy.diag(self.spacing), self.origin, UNKNOWN)
        self.held(self.write(offset=None), self.steps, numpy.zeros(3), "no Offset")

    def test_numbers_that_are_none(self):
        for wrong in ("1 1", "1 1 1 1", "1 x 1", "1 nan 1", "1 inf 1", "1 0 1", "1 -1 1", ""):
            self.refused(self.write(f"ElementSpacing = {wrong}", spacing=None), "ElementSpacing",
                         "expected")
        self.refused(self.write("TransformMatrix = 1 0 0 0 1 0", matrix=None), "TransformMatrix",
                     "expected 9")
        self.refused(self.write("Offset = 1 2", offset=None), "Offset", "expected 3")

    def test_an_anatomical_orientation_that_contradicts_the_matrix_is_said(self):
        ends = ("RL", "AP", "IS")  # where an axis of LPS comes from, and where it goes
        for _ in range(8):
            self.draw()
            self.turn = self.turn[:, self.random.permutation(3)]
            self.steps = self.turn * self.spacing
            nearest = numpy.abs(self.turn).argmax(0)
            if len(set(nearest)) < 3:
                continue
            letters = [ends[a][int(self.turn[a, i] < 0)] for i, a in enumerate(nearest)]
            right = "".join(letters)
            self.held(self.write(f"AnatomicalOrientation = {right}"), self.steps, self.origin)
            at = self.random.integers(3)
            letters[at] = ends[nearest[at]].replace(letters[at], "")
            wrong = "".join(letters)
            self.held(self.write(f"AnatomicalOrientation = {wrong}"), self.steps, self.origin,
                      f"AnatomicalOrientation {wrong}")
        self.held(self.write("AnatomicalOrientation = ???"), self.steps, self.origin)
        self.held(self.write("AnatomicalOrientation = RAI", matrix=None),
                  numpy.diag(self.spacing), self.origin)
        self.refused(self.write("AnatomicalOrientation = LPI", matrix=None),
                     "AnatomicalOrientation", "LPI", "expected")

    def test_scaled_values_are_refused(self):
        self.refused(self.write("ElementToIntensityFunctionSlope = 2"),
                     "ElementToIntensityFunctionSlope", "expected 1")
        self.refused(self.write("ElementToIntensityFunctionOffset = -1"),
                     "ElementToIntensityFunctionOffset", "expected 0")
        self.held(self.write("ElementToIntensityFunctionSlope = 1.0",
                             "ElementToIntensityFunctionOffset = 0"), self.steps, self.origin)

    def test_whole_numbers_of_eight_bytes_and_packed_without_a_size(self):
        self.held(self.write(kind="MET_LONG_LONG", voxels=self.map.astype("<i8").tobytes("F")),
                  self.steps, self.origin)
        self.refused(self.write("CompressedData = True"), "expected CompressedDataSize")


class Inrimage(Case):
    def write(self, *lines, spacing="XYZ"):
        x, y, z = self.map.shape
        head = ["#INRIMAGE-4#{", f"XDIM={x}", f"YDIM={y}", f"ZDIM={z}", "VDIM=1",
                "TYPE=unsigned fixed", "PIXSIZE=8 bits", "CPU=decm", *lines]
        head += [f"V{axis}={self.spacing['XYZ'.index(axis)]!r}" for axis in spacing]
        text = "\n".join(head) + "\n"
        path = self.folder / "a.inr"
        path.write_bytes((text + "\n" * (252 - len(text)) + "##}\n").encode() +
                         self.map.tobytes("F"))
        return path

    def test_knows_no_directions_but_a_place(self):
        self.spacing = self.spacing.astype(numpy.float32).round(4).astype(float)
        self.held(self.write(), numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)
        self.held(self.write("TX=10.5", "TY=-20", "TZ=30"), numpy.diag(self.spacing),
                  numpy.array([10.5, -20, 30]), UNKNOWN)

    def test_spacing_that_is_missing_and_rotations_are_refused(self):
        for missing in "XYZ":
            self.refused(self.write(spacing="XYZ".replace(missing, "")), f"expected V{missing}")
        self.refused(self.write("RX=0.5"), "RX", "0.5", "expected")
        self.held(self.write("RX=0", "RY=0.0"), numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)


if __name__ == "__main__":
    unittest.main(verbosity=2)
