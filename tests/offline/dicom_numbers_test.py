#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Numbers that DICOM stores as text, in every spelling that was seen in files: each is read as
Python's float reads it, or refused with its file, its attribute and the text. A prefix is never
taken for the number (1,5 was once read as 1).

usage: dicom_numbers_test.py   (STYLET_BIN)
"""
import decimal
import json
import unittest

try:
    import numpy
    import pydicom
    import dicom_files as dicom
    from dicom_files import Slice, held, stack, write_seg, write_slices
    from pydicom.dataelem import RawDataElement
except ImportError:
    dicom = None

from dicom_conformance_test import NEAR, Conformance, ran


def put_text(item, name, text, vr=None):
    """Raw bytes that pydicom would not write."""
    tag = pydicom.tag.Tag(pydicom.datadict.tag_for_keyword(name))
    data = text.encode() + b" " * (len(text.encode()) % 2)
    vr = vr or pydicom.datadict.dictionary_VR(tag)
    try:
        pydicom.valuerep.IS(text)
    except (OverflowError, TypeError):  # pydicom cannot write these as integer strings
        vr = vr.replace("IS", "DS")
    except ValueError:
        pass
    item[tag] = RawDataElement(tag, vr, len(data), data, 0, False, True)


def put_binary(item, name, vr, kind, values):
    data = numpy.array(values, dtype=kind).tobytes()
    tag = pydicom.tag.Tag(pydicom.datadict.tag_for_keyword(name))
    item[tag] = RawDataElement(tag, vr, len(data), data, 0, False, True)


def blank_out(path, name, text):
    """Overwrites a value with blanks in the finished file, because pydicom would not write such a
    value."""
    tag = pydicom.datadict.tag_for_keyword(name)
    head = numpy.array([tag >> 16, tag & 0xFFFF], "<u2").tobytes()
    head += pydicom.datadict.dictionary_VR(tag).encode() + numpy.array(len(text), "<u2").tobytes()
    data = path.read_bytes()
    assert data.count(head + text.encode()) == 1, name
    path.write_bytes(data.replace(head + text.encode(), head + b" " * len(text)))


def changed_text(item, name, change, random):
    """Changes a random one of an attribute's values; returns its index and new text."""
    values = item.data_element(name).value
    values = [values] if isinstance(values, (str, int, float)) else list(values)
    place = int(random.integers(len(values)))
    texts = [str(v) for v in values]
    texts[place] = change(texts[place])
    put_text(item, name, "\\".join(texts))
    return place, texts[place]


def fractional(text):
    """The number with a fraction, so that there is a place for a comma or a `d`."""
    return text if "." in text else text + ".0"


def exponent(text, letter):
    mantissa, power = f"{float(text):.17e}".split("e")
    return mantissa + letter + power


WRONG = {
    "comma": lambda t: fractional(t).replace(".", ","),
    "thousands": lambda t: "1," + fractional(t).lstrip("-"),
    "fortran": lambda t: exponent(t, "d"),
    "FORTRAN": lambda t: exponent(t, "D"),
    "hexadecimal": lambda t: float(t).hex(),
    "whole hexadecimal": lambda t: "0x1F",
    "unit": lambda t: t + "mm",
    "blank and unit": lambda t: t + " mm",
    "two numbers": lambda t: t + " 1",
    "blank inside": lambda t: fractional(t).replace(".", ". "),
    "line inside": lambda t: t + "\n1",
    "zero inside": lambda t: t + "\0001",
    "two signs": lambda t: "+-" + t.lstrip("-"),
    "sign alone": lambda t: "-",
    "sign behind": lambda t: t + "-",
    "point alone": lambda t: ".",
    "two points": lambda t: fractional(t) + ".5",
    "no power": lambda t: t + "e",
    "power alone": lambda t: "e5",
    "fraction of a power": lambda t: t + "e0.5",
    "not a number": lambda t: "nan",
    "infinite": lambda t: "-Infinity",
    "beyond a double": lambda t: "1e999",
    "other digits": lambda t: "\u0661",
    "lines between digits": lambda t: "1_0",
    "a word": lambda t: "one",
    "brackets": lambda t: f"[{t}]",
    "longer than any number": lambda t: fractional(t) + "0" * 5000,
}
RIGHT = {
    "plus": lambda t: t if t.startswith("-") else "+" + t,
    "blanks": lambda t: f"   {t}  ",
    "power": lambda t: exponent(t, "e"),
    "POWER": lambda t: exponent(t, "E"),
    "zeros in front": lambda t: t.replace("-", "-000") if "-" in t else "000" + t,
    "zeros behind": lambda t: fractional(t) + "0" * 40,
    "plus in the power": lambda t: f"{decimal.Decimal(t).scaleb(-2):f}e+2",
    "no zero before the point": lambda t: t.replace("0.", ".", 1) if "0." == t.lstrip("-")[:2]
                                else t,
    "nothing behind the point": lambda t: t if "." in t else t + ".",
}
# The attributes of a slice that matter.
OF_SLICES = ("PixelSpacing", "ImagePositionPatient", "ImageOrientationPatient", "SliceThickness",
             "RescaleSlope", "RescaleIntercept", "NumberOfFrames")


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class Numbers(Conformance):
    def shown(self, text):
        """The part of the text that a refusal quotes."""
        return "".join(c if c.isprintable() else "?" for c in text)[:50]

    def series(self, folder, random, name, change, of_all):
        """A series in which one number, or one in each slice, is spelled in another way; and the
        texts."""
        slices, seen = stack(random, distances=[2.0] * 15), []
        some = range(len(slices)) if of_all else [int(random.integers(len(slices)))]

        def respelled(file, i):
            file.RescaleSlope, file.RescaleIntercept, file.NumberOfFrames = "1", "0", "1"
            if i in some:
                seen.append(changed_text(file, name, change, random)[1])
        return slices, write_slices(folder / "series", slices, random, change=respelled), seen

    def test_text_that_is_no_number_is_refused_in_slices(self):
        for name in OF_SLICES:
            for spelling, change in WRONG.items():
                def wrong(folder, random):
                    _, path, texts = self.series(folder, random, name, change,
                                                 bool(random.integers(2)))
                    self.refused(path, ".dcm", name, "expected a")
                    said = ran(path).stderr
                    self.assertTrue(any(f" {self.shown(t)}" in said for t in texts), said)
                    self.assertEqual("..." in said, len(texts[0].strip(" ")) > 60, said)
                wrong.__name__ = f"{name} {spelling}"
                self.cases(1, wrong)

    def test_other_spellings_are_read_as_python_reads_them(self):
        for name in OF_SLICES:
            for spelling, change in RIGHT.items():
                def right(folder, random):
                    def checked(text):
                        self.assertEqual(float(change(text)), float(text))
                        return change(text)
                    slices, path, _ = self.series(folder, random, name, checked, True)
                    self.check(path, held(slices))
                right.__name__ = f"{name} {spelling}"
                self.cases(1, right)

    def test_empty_and_further_values(self):
        def written(folder, random, name, text, *said):
            def change(file, _):
                put_text(file, name, text)
            slices = stack(random, distances=[2.0] * 15)
            path = write_slices(folder, slices, random, change=change)
            if said:
                self.refused(path, name, *said)
            else:
                self.check(path, held(slices))

        def empty(folder, random):
            for i, (name, text) in enumerate((
                    ("PixelSpacing", "\\1.5"), ("PixelSpacing", "1.5\\ "),
                    ("ImagePositionPatient", "1\\\\2"), ("ImagePositionPatient", "1\\2\\"),
                    ("ImageOrientationPatient", "1\\0\\0\\\\1\\0"))):
                written(folder / f"empty {i}", random, name, text, "is empty: expected a number")

        def further(folder, random):  # for example a comma as a separator
            for i, (name, text, most) in enumerate((
                    ("PixelSpacing", "1\\5\\1\\5", 2), ("SliceThickness", "2\\5", 1),
                    ("RescaleSlope", "1\\1", 1), ("ImagePositionPatient", "1\\2\\3\\", 3),
                    ("ImageOrientationPatient", "1\\0\\0\\0\\1\\0\\0", 6))):
                written(folder / f"further {i}", random, name, text,
                        f"expected at most {most} numbers")

        def nothing(folder, random):  # as if the attribute were absent
            for i, text in enumerate(("", " ", "    ")):
                for name in ("RescaleSlope", "RescaleIntercept", "NumberOfFrames"):
                    written(folder / f"{name} {i}", random, name, text)
                written(folder / f"spacing {i}", random, "PixelSpacing", text, "expected two")

        def blanks(folder, random):
            def change(file, _):
                file.RescaleSlope, file.RescaleIntercept = "1.00", "0.00"
            slices = stack(random, distances=[2.0] * 15)
            path = write_slices(folder, slices, random, change=change)
            for each in path.glob("*.dcm"):
                blank_out(each, "RescaleSlope", "1.00")
                blank_out(each, "RescaleIntercept", "0.00")
            self.check(path, held(slices))

        def too_many(folder, random):
            written(folder, random, "NumberOfFrames", "99999999999", "expected 1 to 2147483647")

        def half(folder, random):  # of an attribute with whole numbers
            written(folder / "half", random, "NumberOfFrames", "1.5", "1.5: expected a whole")

        def as_text(folder, random):  # text of another type is read as strictly
            def change(text):
                return lambda file, _: put_text(file, "RescaleSlope", text, "LO")
            slices = stack(random)
            self.check(write_slices(folder / "one", slices, random, change=change("1")),
                       held(slices))
            self.refused(write_slices(folder / "comma", slices, random, change=change("1,0")),
                         "RescaleSlope", "1,0", "expected a number")

        def as_bytes(folder, random):  # bytes that are no type of number
            def change(file, _):
                put_text(file, "RescaleSlope", "1 ", "OB")
            self.refused(write_slices(folder / "bytes", stack(random), random, change=change),
                         "RescaleSlope", "OB", "expected a number")

        self.cases(1, empty, further, nothing, blanks, too_many, half, as_text, as_bytes)

    def test_binary_numbers_are_numbers_too(self):
        def binary(folder, random):
            slices = stack(random)

            def change(file, _):
                for name, vr, kind in (("PixelSpacing", "FD", "<f8"), ("RescaleSlope", "FL", "<f4"),
                                       ("RescaleIntercept", "SS", "<i2"),
                                       ("NumberOfFrames", "UL", "<u4"),
                                       ("SliceThickness", "FD", "<f8")):
                    values = {"RescaleSlope": 1, "RescaleIntercept": 0, "NumberOfFrames": 1}.get(
                        name) or (file.get(name) if name in file else 0)
                    put_binary(file, name, vr, kind, values)
            self.check(write_slices(folder / "series", slices, random, change=change), held(slices))

        def wrong(folder, random):
            for i, (name, vr, kind, values, said) in enumerate((
                    ("RescaleSlope", "FD", "<f8", [numpy.nan], "expected a number"),
                    ("PixelSpacing", "FD", "<f8", [1, numpy.inf], "expected a number"),
                    ("SliceThickness", "FL", "<f4", [-numpy.inf], "expected a number"),
                    ("PixelSpacing", "FD", "<f8", [1.5], "expected two"),
                    ("Rows", "US", "<u2", [9, 9], "2 values: expected at most 1"),
                    ("Rows", "SL", "<i4", [-9], "-9: expected 0 to 65535"),
                    ("Columns", "UL", "<u4", [70000], "70000: expected 0 to 65535"))):
                path = write_slices(folder / str(i), stack(random), random, change=lambda file, _:
                                    put_binary(file, name, vr, kind, values))
                self.refused(path, name, said)

        self.cases(1, binary, wrong)


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class NumbersOfObjects(Conformance):
    def spellings(self, *makers):
        """Calls maker(folder, random, change, said) with each wrong spelling."""
        for maker in makers:
            for spelling, change in WRONG.items():
                def wrong(folder, random):
                    maker(folder, random, change)
                wrong.__name__ = f"{maker.__name__} {spelling}"
                self.cases(1, wrong)

    def test_segmentations(self):
        def written(folder, random, respell):
            slices = stack(random, distances=[2.0] * 12, labels=[1])
            frames = [Slice(s.at, s.row, s.column, s.spacing, s.thickness, s.pixels, 1)
                      for s in slices if s.pixels.any()]
            path = write_seg(folder / "seg.dcm", frames, {1: "Liver"}, apart=2, change=respell)
            return path, held(frames, alone=2, widest=3)

        def measures(file):
            return file.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0]

        def in_groups(name, item_of):
            def spelled(folder, random, change):
                path, _ = written(folder, random, lambda file: changed_text(
                    item_of(file, random), name, change, random))
                self.refused(path, "seg.dcm", name, "expected a")
            spelled.__name__ = name
            return spelled

        def frame(file, random):
            groups = file.PerFrameFunctionalGroupsSequence
            return groups[int(random.integers(len(groups)))].PlanePositionSequence[0]

        self.spellings(
            in_groups("SpacingBetweenSlices", lambda file, _: measures(file)),
            in_groups("PixelSpacing", lambda file, _: measures(file)),
            in_groups("SliceThickness", lambda file, _: measures(file)),
            in_groups("ImageOrientationPatient", lambda file, _:
                      file.SharedFunctionalGroupsSequence[0].PlaneOrientationSequence[0]),
            in_groups("ImagePositionPatient", frame),
            in_groups("NumberOfFrames", lambda file, _: file))
        for spelling, change in RIGHT.items():
            def right(folder, random):
                path, expected = written(folder, random, lambda file: [
                    changed_text(measures(file), "SpacingBetweenSlices", change, random),
                    changed_text(measures(file), "PixelSpacing", change, random),
                    changed_text(frame(file, random), "ImagePositionPatient", change, random)])
                self.check(path, expected)
            right.__name__ = f"right {spelling}"
            self.cases(1, right)

    def outlines(self, random, count=9):
        middle = random.uniform(-50, 50, 3)
        for i in range(count):
            flat = dicom.polygon(random, 24, middle[:2])
            yield numpy.column_stack([flat, numpy.full(len(flat), middle[2] + 2 * i)])

    def structures(self, folder, random, respell):
        contours = list(self.outlines(random))
        path = dicom.write_structures(folder / "rt.dcm", [(1, "Liver", contours)], change=respell)
        areas = [dicom.area_and_centroid(c[:, :2]) for c in contours]
        ml = sum(area for area, _ in areas) * 2 * 1e-3
        flat = sum(area * place for area, place in areas) / sum(area for area, _ in areas)
        up = sum(area * c[0, 2] for (area, _), c in zip(areas, contours))
        up /= sum(area for area, _ in areas)
        return path, {1: (0, ml, numpy.array([*flat, up]))}

    def test_structure_sets(self):
        def contour(file, random):
            contours = file.ROIContourSequence[0].ContourSequence
            return contours[int(random.integers(len(contours)))]

        def in_sets(name, item_of, *said):
            def spelled(folder, random, change):
                seen = []
                path, _ = self.structures(folder, random, lambda file: seen.append(changed_text(
                    item_of(file, random), name, change, random)))
                place = [f"point {seen[0][0] // 3}"] if name == "ContourData" else []
                self.refused(path, "rt.dcm", name, "expected a", *place)
            spelled.__name__ = name
            return spelled

        self.spellings(
            in_sets("ContourData", contour),
            in_sets("NumberOfContourPoints", contour),
            in_sets("ROINumber", lambda file, _: file.StructureSetROISequence[0]),
            in_sets("ReferencedROINumber", lambda file, _: file.ROIContourSequence[0]))

        def halves(folder, random):
            for name, item_of in (("NumberOfContourPoints", contour),
                                  ("ROINumber", lambda f, _: f.StructureSetROISequence[0]),
                                  ("ReferencedROINumber", lambda f, _: f.ROIContourSequence[0])):
                path, _ = self.structures(folder, random, lambda file: put_text(
                    item_of(file, random), name, "1.5"))
                self.refused(path, name, "1.5: expected a whole number")

        def empty(folder, random):
            for spoil in (lambda t: t + "\\", lambda t: "\\" + t,
                          lambda t: t.replace("\\", "\\ \\", 1)):
                def respell(file):
                    one = contour(file, random)
                    put_text(one, "ContourData",
                             spoil("\\".join(str(v) for v in one.ContourData)))
                path, _ = self.structures(folder, random, respell)
                self.refused(path, "ContourData", "is empty: expected a number")

        def no_points(folder, random):
            def respell(file):
                put_text(contour(file, random), "ContourData", "")
            path, _ = self.structures(folder, random, respell)
            self.refused(path, "0 numbers in ContourData: expected three points or more")
        self.cases(1, halves, empty, no_points)

    def test_spellings_of_contours(self):
        def all_commas(folder, random):  # with decimal commas, as some exporters write
            def respell(file):
                for each in file.ROIContourSequence[0].ContourSequence:
                    put_text(each, "ContourData", "\\".join(
                        f"{float(v):.3f}".replace(".", ",") for v in each.ContourData))
            path, _ = self.structures(folder, random, respell)
            self.refused(path, "Liver", "contour 0", "point 0", "ContourData", "expected a number")

        def right(folder, random):  # every number in any of the spellings
            def respell(file):
                ways = list(RIGHT.values())
                for each in file.ROIContourSequence[0].ContourSequence:
                    put_text(each, "ContourData", "\\".join(
                        ways[int(random.integers(len(ways)))](str(v)) for v in each.ContourData))
            path, expected = self.structures(folder, random, respell)
            self.check(path, expected, NEAR, within=0.3)
            plain, _ = self.structures(folder, numpy.random.default_rng(1), None)
            self.assertEqual(json.loads(ran(plain).stdout)["notes"], [])

        self.cases(1, all_commas)
        self.cases(3, right)


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")  # pydicom warns about each of them
