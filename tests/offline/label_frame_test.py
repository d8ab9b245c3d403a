#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The frames of NRRD, MetaImage and Inrimage, by every field of their headers that concerns them.

Maps, spacings, rotations and origins are random; expected volumes and centroids are computed by
numpy from the definitions of the formats. If a header leaves something open there is a warning or a
refusal, never silence.

usage: label_frame_test.py [CASE]   (STYLET_BIN)
"""
import bz2
import gzip
import itertools
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
# A step along each axis of a space, in LPS.
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

    def changed(self, path, old, new):
        """The file with one part of its header replaced."""
        whole = path.read_bytes()
        self.assertIn(old, whole)
        path.write_bytes(whole.replace(old, new, 1))
        return path

    def run_labels(self, path):
        return subprocess.run([TOOL, "labels", "--json", path], capture_output=True, text=True,
                              timeout=60)

    def held(self, path, steps, origin, *notes):
        """Checks that the map lies there, and that its reader says this and nothing else."""
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
        """A header without `space` has no directions either."""
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
        unnamed = self.changed(self.write(), b"space: LPS", b"space dimension: 3")
        self.held(unnamed, self.steps, self.origin, UNKNOWN)
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
        for word in ("centers", "centerings"):
            self.held(self.write(least, most, word + ": node node node", space=None), between,
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

    def test_a_missing_origin_is_reported(self):
        self.held(self.write(origin=False), self.steps, numpy.zeros(3), "no space origin")

    def test_invalid_directions(self):
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

    def test_every_type_of_number(self):
        for kind, name in {"i1": "int8", "u1": "unsigned char", "i2": "signed short int",
                           "u2": "uint16", "i4": "int", "u4": "uint32_t", "i8": "int64",
                           "u8": "unsigned long long", "f4": "float", "f8": "double"}.items():
            for order, endian in ("<", "little"), (">", "big"):
                path = self.write()
                head = path.read_bytes().split(b"\n\n", 1)[0].replace(
                    b"uint8", f"{name}\nendian: {endian}".encode())
                path.write_bytes(head + b"\n\n" + self.map.astype(order + kind).tobytes("F"))
                with self.subTest(name, endian=endian):
                    self.held(path, self.steps, self.origin)

    def test_voxels_in_files_of_their_own(self):
        """By name, as a list, and numbered, with a file for each plane; lines may end as on
        Windows."""
        planes = [self.map[:, :, z].tobytes("F") for z in range(self.map.shape[2])]
        head = self.write().read_bytes().split(b"\n\n", 1)[0]
        header, last = self.folder / "a.nhdr", len(planes)
        for name, end in (("s%03d.raw", b"\n"), ("s%3d.raw", b"\r\n"), ("s%d.raw", b"\n"),
                          ("s%10d.raw", b"\n"), ("s%010d.raw", b"\n")):
            names = [name % (i + 1) for i in range(last)]
            for each, plane in zip(names, planes):
                (self.folder / each).write_bytes(plane)
            for data in (f"{name} 1 {last} 1", "\n".join(["LIST", *names])):
                if " " in names[0] and data.startswith("LIST"):
                    continue  # NRRD's lists allow no blanks
                header.write_bytes((head + b"\ndata file: " + data.encode() + b"\n")
                                   .replace(b"\n", end))
                with self.subTest(data):
                    self.held(header, self.steps, self.origin)
        header.write_bytes(head + "\n".join(["\ndata file: LIST", *names, "", ""]).encode())
        self.refused(header, "cannot be read")  # teem counts the blank line, too
        for wrong in ("LIST", "s%d 1 2", "s%d 1 2 0", "s%d", "s%0012d 1 2 1", "s%d%d 1 2 1",
                      "s% 1 2 1", "s%03 1 2 1", "s%", "s%d 1 2 -1", "s%d -1 2 1"):
            header.write_bytes(head + f"\ndata file: {wrong}\n".encode())
            self.refused(header, "expected")
        # Up to 99 were once accepted, and teem wrote beyond its buffer for ten digits.
        for digits in ("11", "011", "99", "100", "4294967297", "99999999999999999999"):
            header.write_bytes(head + f"\ndata file: s%{digits}d.raw 1 2 1\n".encode())
            self.refused(header, "expected a name with one %d or %0Nd, N at most 10")

    def test_files_hold_as_many_axes_as_the_header_says(self):
        """Files of lines, planes, slabs of any thickness or all voxels, numbered upwards and
        downwards: raw ones are read by teem itself, as part of ITK, bzip2 and text by our own
        code."""
        while self.map.shape[2] % 4 != 0:
            self.draw()
        head = self.write().read_bytes().split(b"\n\n", 1)[0]
        header, last = self.folder / "a.nhdr", self.map.shape[2]
        lines = [self.map[:, y, z] for z in range(last) for y in range(self.map.shape[1])]
        slabs = {count: [self.map[:, :, z:z + last // count] for z in range(0, last, last // count)]
                 for count in range(1, last + 1) if last % count == 0}
        pieces = [(1, lines), (2, slabs[last])] + [(3, each) for each in slabs.values()]
        packings = {b"raw": lambda piece: piece.tobytes("F"),
                    b"bzip2": lambda piece: bz2.compress(piece.tobytes("F")),
                    b"ascii": lambda piece: " ".join(map(str, piece.ravel("F"))).encode() + b"\n"}
        self.assertIn(b"encoding: raw", head)
        for (axes, parts), (encoding, packed) in itertools.product(pieces, packings.items()):
            count = len(parts)
            names = [f"p{axes}-{count}-{i}.{encoding.decode()}" for i in range(count)]
            pattern = f"p{axes}-{count}-%d.{encoding.decode()}"
            mine = head.replace(b"encoding: raw", b"encoding: " + encoding)
            for way in (1, -1):
                for name, part in zip(names, parts[::way]):
                    (self.folder / name).write_bytes(packed(part))
                first, final = (0, count - 1)[::way]
                for data in (f"{pattern} {first} {final} {way} {axes}",
                             "\n".join([f"LIST {axes}", *names[::way]])):
                    header.write_bytes(mine + b"\ndata file: " + data.encode() + b"\n")
                    with self.subTest(data, encoding=encoding):
                        self.held(header, self.steps, self.origin)
            wrongs = [f"{pattern} 0 {count - 1} 1 0", f"{pattern} 0 {count - 1} 1 4",
                      f"{pattern} 0 {count - 1} 1 {axes} 1", "\n".join(["LIST 4", *names]),
                      "\n".join(["LIST 1 1", *names]),
                      "\n".join([f"LIST {axes}", *names, *[names[0]] * last])]
            if axes < 3:
                wrongs.append(f"{pattern} 0 0 1 {axes}")
            if axes < 3 or last % (count + 1) != 0:
                wrongs.append(f"{pattern} 0 {count} 1 {axes}")
            for wrong in wrongs:
                header.write_bytes(mine + b"\ndata file: " + wrong.encode() + b"\n")
                with self.subTest(wrong, encoding=encoding):
                    self.refused(header, "expected")

    def test_names_of_segments_are_those_of_utf_8(self):
        def shown(name):
            """Expected by Python's codec: bytes that are no character of UTF-8, and characters that
            cannot be shown, become '?'."""
            out = ""
            while name:
                for size in range(1, 5):
                    try:
                        each = name[:size].decode()
                        break
                    except UnicodeDecodeError:
                        each = None
                out += "?" if each is None or each < " " or each == "\x7f" else each
                name = name[size if each is not None else 1:]
            return out.strip(" ")

        near = [b"\xc3", b"\xa4", b"\xe2", b"\x82", b"\xac", b"\xf0", b"\x9f", b"\xab", b"\x80",
                b"\xe0", b"\x9f", b"\xed", b"\xa0", b"\xf4", b"\x90", b"\xc0", b"\xff", b"\x7f",
                "ä".encode(), "€".encode(), "\U0001fac0".encode(), "\ud7ff".encode(),
                "\u0800".encode(), "\U00010000".encode(), "\U0010ffff".encode(),
                b"a", b" ", b"Z", b"\t"]
        drawn = [b"".join(self.random.choice(numpy.array(near, object), 6)) for _ in range(200)]
        surrogate, too_long, too_far = b"\xed\xa0\x80", b"\xf0\x8f\xbf\xbf", b"\xf4\x90\x80\x80"
        for part in [*drawn, surrogate, too_long, too_far]:
            name = b"x" + part + b"x"
            path = self.changed(self.write(), b"\n\n", b"\nSegment0_ID:=s\nSegment0_Name:=" + name +
                                b"\n\n")
            done = self.run_labels(path)
            self.assertEqual(done.returncode, 0, done.stderr)
            facts = json.loads(done.stdout)
            self.assertEqual({each["label"]: each.get("name") for each in facts["labels"]}[1],
                             shown(name), name)

    def test_keys_that_look_like_those_of_segments_name_nothing(self):
        path = self.changed(self.write(), b"\n\n", b"\nSegmentX_ID:=a\nSegment1x_ID:=b"
                            b"\nOther1_ID:=c\nSegment_ID:=d\nSegment00_Name:=e"
                            b"\nSegment01_ID:=f\n\n")
        facts = json.loads(self.run_labels(path).stdout)
        self.assertTrue(facts["labels"])
        self.assertEqual({each["name"] for each in facts["labels"]}, {""})

    def test_headers_that_say_too_little_or_too_much(self):
        for old, new, *said in (
                (b"NRRD0005", b"NRRD9", "expected the header of an NRRD"),
                (b"type: uint8", b"type: block", "type: block", "expected whole or real"),
                (b"encoding: raw", b"encoding: zstd", "encoding: zstd", "expected raw"),
                (b"dimension: 3", b"dimension: 3 3", "expected as many as the dimension"),
                (b"dimension: 3", b"dimension 3", "expected FIELD: VALUE"),
                (b"dimension: 3", b"dimension: 3\nkinds: domain domain", "expected 3 kinds"),
                (b"dimension: 3", b"dimension: 3\nspace dimension: 2", "expected 3"),
                (b"dimension: 3", b"dimension: 3\nbyte skip: x", "byte skip: x", "expected"),
                (b"dimension: 3", b"dimension: 3\a", "control character"),
                (b"space origin: (", b"space origin: (1,2,3) (", "expected one vector"),
                (b"space origin: (", b"space origin: 1 (", "expected vectors")):
            with self.subTest(new):
                self.refused(self.changed(self.write(), old, new), *said)
        path = self.changed(self.write(), b"dimension: 3", b"# a note: 3\ndimension: 3")
        self.held(path, self.steps, self.origin)
        kinds = b"dimension: 3\nkinds: domain list domain"
        self.refused(self.changed(self.write(), b"dimension: 3", kinds), "2 dimensions: expected 3")
        ends = "axis mins: 1 2 3", "axis maxs: 9 9 9"
        self.refused(self.write(*ends, "centers: cell cell", space=None), "3 of cell or node")
        self.refused(self.write("axis mins: nan 2 3", ends[1], space=None), "expected")
        self.refused(self.write("axis mins: inf 2 3", "spacings: 1 1 1", space=None), "axis mins",
                     "expected numbers")

    def test_a_fourth_dimension_is_empty(self):
        x, y, z = self.map.shape
        said = "spacings: " + row([*self.spacing, 1])
        for kinds in (), ("kinds: domain domain domain time",):
            self.held(self.write(said, *kinds, space=None, shape=(x, y, z, 1)),
                      numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)
            path = self.write(said, *kinds, space=None, shape=(x, y, z, 2))
            path.write_bytes(path.read_bytes() + self.map.tobytes("F"))
            self.refused(path, "2 values along axis 3: expected a volume of three")

    def test_numbers_may_be_spelt_in_any_way(self):
        self.spacing = numpy.array([2, 0.5, 1.25])
        said = "spacings: \t +2\t5e-1  1.25\t "
        self.held(self.write(said, space=None), numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)
        for wrong in ("1x 1 1", "++1 1 1", "0x1 1 1"):
            self.refused(self.write(f"spacings: {wrong}", space=None), "expected 3 numbers")

    def test_layers_without_segments_are_refused(self):
        path = self.write(shape=(2, *self.map.shape))
        head, voxels = path.read_bytes().split(b"\n\n", 1)
        path.write_bytes(head + b"\nkinds: list domain domain domain\n\n" + voxels * 2)
        self.changed(path, b"space directions: ", b"space directions: none ")
        self.refused(path, "2 values a voxel and 0 segments: expected labels")
        many = "".join(f"\nSegment{i}_ID:=s\nSegment{i}_LabelValue:={i + 1}"
                       for i in range(501))
        self.refused(self.changed(path, b"\n\n", many.encode() + b"\n\n"),
                     "2 values a voxel and 501 segments: expected labels")

    def test_two_segments_of_one_value_are_refused(self):
        two = b"\nSegment0_ID:=a\nSegment1_ID:=b\n\n"
        self.refused(self.changed(self.write(), b"\n\n", two), "label value 1 of layer 0 is a")
        for wrong in (b"-1", b"70000", b"x", b"1.5", b""):
            one = b"\nSegment0_ID:=a\nSegment0_LabelValue:=" + wrong + b"\n\n"
            self.refused(self.changed(self.write(), b"\n\n", one), "Segment0_LabelValue",
                         "expected a whole number from 0 to 65535")


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

    def test_fields_that_are_missing(self):
        self.held(self.write(spacing="ElementSize"), self.steps, self.origin)
        self.held(self.write("ElementSize = 9 9 9"), self.steps, self.origin)
        self.refused(self.write(spacing=None), "expected ElementSpacing")
        self.held(self.write(matrix=None), numpy.diag(self.spacing), self.origin, UNKNOWN)
        self.held(self.write(offset=None), self.steps, numpy.zeros(3), "no Offset")

    def test_invalid_numbers(self):
        for wrong in ("1 1", "1 1 1 1", "1 x 1", "1 nan 1", "1 inf 1", "0 1 1", "1 0 1", "1 1 0",
                      "-1 1 1", "1 -1 1", "1 1 -1", ""):
            self.refused(self.write(f"ElementSpacing = {wrong}", spacing=None), "ElementSpacing",
                         "expected")
        self.refused(self.write("TransformMatrix = 1 0 0 0 1 0", matrix=None), "TransformMatrix",
                     "expected 9")
        self.refused(self.write("Offset = 1 2", offset=None), "Offset", "expected 3")
        self.refused(self.write("Offset = inf 1 2", offset=None), "expected")
        self.refused(self.write("ElementSpacing = 1e200 1e200 1e200", spacing=None), "expected")

    def test_an_anatomical_orientation_that_contradicts_the_matrix_is_reported(self):
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

    def test_every_type_of_number_and_packed_without_a_size(self):
        for kind, name in {"i1": "CHAR", "u1": "UCHAR", "i2": "SHORT", "u2": "USHORT", "i4": "INT",
                           "u4": "UINT", "<i4": "LONG", "<u4": "ULONG", "i8": "LONG_LONG",
                           "u8": "ULONG_LONG", "f4": "FLOAT", "f8": "DOUBLE"}.items():
            with self.subTest(name):
                voxels = self.map.astype(kind).tobytes("F")
                self.held(self.write(kind=f"MET_{name}", voxels=voxels), self.steps, self.origin)
        self.refused(self.write("CompressedData = True"), "expected CompressedDataSize = ")
        for size in (-1, 4):
            self.refused(self.write("BinaryData = False", f"HeaderSize = {size}"),
                         "voxels as text, but the header says to skip")
        self.refused(self.write("ElementNumberOfChannels = 0"), "expected whole numbers from 1")
        self.refused(self.write("HeaderSize = -2"), "HeaderSize", "expected whole numbers from -1")

    def test_voxels_in_files_of_their_own(self):
        planes = [self.map[:, :, z].tobytes("F") for z in range(self.map.shape[2])]
        whole, header, last = self.write().read_bytes(), self.folder / "a.mhd", len(planes)
        head = whole[:whole.index(b"ElementDataFile")]
        for name in ("s%03d.raw", "s%d.raw"):
            names = [name % (i + 1) for i in range(last)]
            for each, plane in zip(names, planes):
                (self.folder / each).write_bytes(plane)
            for data in (f"{name} 1 {last} 1", "\n".join(["LIST", *names, "", ""]),
                         "\n".join(["LIST 2", *names])):
                header.write_bytes(head + f"ElementDataFile = {data}\n".encode())
                with self.subTest(data):
                    self.held(header, self.steps, self.origin)
        for wrong in ("LIST", "", "s%d 1 2 0", "s%x 1 2 1", "s%d 2 1 -1", "s%d 1 2 1 2"):
            header.write_bytes(head + f"ElementDataFile = {wrong}\n".encode())
            self.refused(header, "expected")
        (self.folder / "all.raw").write_bytes(b"".join(planes))
        header.write_bytes(head + b"ElementDataFile = LIST\nall.raw\n")  # only the first plane
        self.refused(header, "the voxels end or are damaged after")
        for wrong in ("LIST 3", "LIST 2 2", "LIST two"):  # of the first MetaIO would read nothing
            header.write_bytes(head + f"ElementDataFile = {wrong}\nall.raw\n".encode())
            self.refused(header, f"ElementDataFile = {wrong}: expected")

    def test_headers_that_say_too_little_or_too_much(self):
        for old, new, *said in (
                (b"NDims = 3", b"NDims 3", "expected KEY = VALUE"),
                (b"NDims = 3", b"NDims = 3 3", "expected one number"),
                (b"NDims = 3", b"NDims = 3\nNDims = 3", "NDims: expected it once"),
                (b"NDims = 3\n", b"", "expected NDims and DimSize"),
                (b"DimSize", b"DimSizes", "expected NDims and DimSize"),
                (b"MET_UCHAR", b"MET_STRING", "MET_STRING", "expected MET_UCHAR"),
                (b"ElementType = MET_UCHAR\n", b"", "ElementType ''", "expected MET_UCHAR"),
                (b"NDims", b"Comment = " + b"c" * 251 + b"\nNDims", "251 characters"),
                (b"NDims", b"Spans = " + b"1 " * 2001 + b"\nNDims", "4001 characters"),
                (b"NDims", b"k" * 251 + b" = 1\nNDims", "expected KEY = VALUE"),
                (b"NDims", b"Comment = \a\nNDims", "control character")):
            with self.subTest(new):
                self.refused(self.changed(self.write(), old, new), *said)
        sized = b"DimSize = " + " ".join(map(str, self.map.shape)).encode()
        four = self.changed(self.write(), b"NDims = 3", b"NDims = 4")
        self.changed(four, sized, sized + b" 2")
        four.write_bytes(four.read_bytes() + self.map.tobytes("F"))
        self.refused(four, "expected")
        for same in (b"\n \nNDims", b"\nComment =\nNDims", b"\nCompressedData =\nNDims"):
            self.held(self.changed(self.write(), b"\nNDims", same), self.steps, self.origin)
        flat = self.changed(self.write(), b"NDims = 3", b"NDims = 2")
        x, y, z = self.map.shape
        self.refused(self.changed(flat, f"DimSize = {x} {y} {z}".encode(),
                                  f"DimSize = {x} {y * z}".encode()), "2 dimensions: expected 3")


class Inrimage(Case):
    def write(self, *lines, spacing="XYZ", kind="u1"):
        x, y, z = self.map.shape
        name = {"u": "unsigned fixed", "i": "signed fixed", "f": "float"}[kind[0]]
        head = ["#INRIMAGE-4#{", f"XDIM={x}", f"YDIM={y}", f"ZDIM={z}", "VDIM=1",
                f"TYPE={name}", f"PIXSIZE={8 * int(kind[1])} bits", "CPU=decm", *lines]
        head += [f"V{axis}={self.spacing['XYZ'.index(axis)]!r}" for axis in spacing]
        text = "\n".join(head) + "\n"
        path = self.folder / "a.inr"
        path.write_bytes((text + "\n" * (252 - len(text)) + "##}\n").encode() +
                         self.map.astype("<" + kind).tobytes("F"))
        return path

    def test_every_type_of_number(self):
        self.spacing = self.spacing.astype(numpy.float32).round(4).astype(float)
        for kind in ("u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"):
            with self.subTest(kind):
                self.held(self.write(kind=kind), numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)

    def test_headers_that_say_too_little_or_too_much(self):
        for old, new, *said in ((b"VDIM=1", b"VDIM=2", "one value a voxel"),
                                (b"VDIM=1", b"VDIMS=1", "expected VDIM"),
                                (b"XDIM=", b"XDIM=3\nXDIM=", "XDIM: expected it once"),
                                (b"CPU=", b"C" * 256 + b"\nCPU=", "at most 255 characters"),
                                (b"XDIM=", b"XDIM=3 ", "XDIM: expected it once, and one number"),
                                (b"PIXSIZE=8 bits", b"PIXSIZE=64 bits", "bytes are there"),
                                (b"unsigned fixed", b"imaginary fixe", "expected the header of"),
                                (b"#INRIMAGE-4", b"#INRIMAGE-5", "expected the header of")):
            with self.subTest(new):
                self.refused(self.changed(self.write(), old, new), *said)
        self.refused(self.write(kind="u8"), "voxels of 8 bytes: expected 1, 2 or 4")
        self.refused(self.write(kind="f2"), "expected")
        for said_too in (b"no field\nCPU=", b"NOTE = a = b\nCPU="):
            self.held(self.changed(self.write(), b"CPU=", said_too),
                      numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)
        path = self.write()
        whole = path.read_bytes()
        text = whole[:252].rstrip(b"\n") + b"\nNOTE="  # no empty line before the end
        path.write_bytes(text.ljust(251, b"x") + b"\n" + whole[252:])
        self.held(path, numpy.diag(self.spacing), numpy.zeros(3), UNKNOWN)
        path = self.write()
        path.write_bytes(path.read_bytes()[:-5])  # the header's own bytes would hide the loss
        self.refused(path, "the voxels end early")
        path.write_bytes(path.read_bytes()[:180].rstrip(b"\n") + b"\n")
        self.refused(path, "expected")
        path = self.folder / "a.inr.gz"
        path.write_bytes(gzip.compress(b""))
        self.refused(path, "expected the header of an Inrimage")

    def test_has_a_position_but_no_directions(self):
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
