#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Regular and irregular DICOM series of random geometry, each with its content as numpy computes it
(dicom_files.py), or with the reason for which it is refused. Segmentations and structure sets:
dicom_objects_test.py.

usage: dicom_conformance_test.py   (STYLET_BIN)
"""
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

try:
    import numpy
    import pydicom
    import dicom_files as dicom
    from dicom_files import held, stack, write_slices
except ImportError:
    dicom = None

TOOL = pathlib.Path(os.environ.get("STYLET_BIN", "build/bin")) / "stylet-organ"
EXACT, NEAR = "exact", "near"  # the same pixels; within 1 %


def ran(path):
    return subprocess.run([TOOL, "labels", path, "--json"], capture_output=True, text=True,
                          timeout=60)


class Conformance(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def cases(self, seeds, *makers):
        """Yields a folder and a random generator for each maker and seed."""
        for maker in makers:
            for seed in range(seeds):
                with self.subTest(maker.__name__, seed=seed):
                    folder = self.folder / f"{maker.__name__}-{seed}"
                    folder.mkdir()
                    random = numpy.random.default_rng([seed, *maker.__name__.encode()])
                    maker(folder, random)

    def check(self, path, expected, mode=EXACT, said=(), within=0.1):
        """`within`: mm from the computed centroid."""
        done = ran(path)
        self.assertEqual(done.returncode, 0, done.stderr)
        facts = json.loads(done.stdout)
        found = {each["label"]: each for each in facts["labels"]}
        self.assertEqual(sorted(found), sorted(expected))
        for label, (pixels, ml, centroid) in expected.items():
            seen = found[label]
            if mode == EXACT:
                self.assertEqual(seen["voxels"], pixels, label)
            self.assertAlmostEqual(seen["volume_ml"] / ml, 1,
                                   delta=1e-6 if mode == EXACT else 0.01, msg=label)
            away = numpy.linalg.norm(numpy.array(seen["centroid_mm"]) - centroid)
            self.assertLess(away, within, label)
        for words in said:
            self.assertTrue(any(words in note for note in facts["notes"]), (words, facts["notes"]))
        if not said:
            self.assertEqual(facts["notes"], [])
        return facts

    def refused(self, path, *said):
        done = ran(path)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for words in said:
            self.assertIn(words, done.stderr)


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class RegularSeries(Conformance):
    def test_oblique_anisotropic_and_in_no_order(self):
        def any_order(folder, random):
            slices = stack(random)
            self.check(write_slices(folder, slices, random), held(slices))

        def backwards(folder, random):
            slices = stack(random)[::-1]
            self.check(write_slices(folder, slices, random), held(slices))

        def many_labels(folder, random):
            slices = stack(random, labels=random.choice(numpy.arange(300, 65535), 7, replace=False))
            self.check(write_slices(folder, slices, random), held(slices))

        def other_kind(folder, random):  # some libraries leave out position and spacing there
            slices = stack(random)
            self.check(write_slices(folder, slices, random, kind=dicom.CAPTURE), held(slices))

        def one_slice(folder, random):
            slices = stack(random, thickness=[2.7] * 9, distances=[1.0] * 8)[4:5]
            self.check(write_slices(folder, slices, random), held(slices))

        def cut(slices, rows, columns):
            for each in slices:
                each.at = (each.at + rows.start * each.spacing[0] * each.column
                           + columns.start * each.spacing[1] * each.row)
                each.pixels = each.pixels[rows, columns]
            return slices

        def one_row(folder, random):
            slices = stack(random)
            middle = slices[0].pixels.shape[0] // 2
            slices = cut(slices, slice(middle, middle + 1), slice(0, None))
            self.check(write_slices(folder, slices, random), held(slices))

        def one_column(folder, random):
            slices = stack(random)
            middle = slices[0].pixels.shape[1] // 2
            slices = cut(slices, slice(0, None), slice(middle, middle + 1))
            self.check(write_slices(folder, slices, random), held(slices))

        def apart(folder, random):  # thin slices with nothing between them
            slices = stack(random, thickness=[0.5] * 12, distances=[1.7] * 11)
            self.check(write_slices(folder, slices, random), held(slices),
                       said=["what lies between them"])

        def thick_without_end(folder, random):
            slices = stack(random)

            def change(file, _):
                file.SliceThickness = "1e9"

            self.check(write_slices(folder, slices, random, change=change), held(slices))

        self.cases(3, any_order)
        self.cases(1, backwards, many_labels, other_kind, one_slice, one_row, one_column, apart,
                   thick_without_end)

    def test_every_spelling_of_pixels(self):
        def bytes_(folder, random):
            slices = stack(random)
            self.check(write_slices(folder, slices, random, bits=8), held(slices))

        def signed(folder, random):
            slices = stack(random)
            self.check(write_slices(folder, slices, random, signed=True), held(slices))

        def signed_and_added(folder, random):
            slices = stack(random)

            def scaled(file, _):
                file.RescaleIntercept, file.RescaleSlope = "1024", "1"

            self.check(write_slices(folder, slices, random, signed=True, change=scaled,
                                    pixels=lambda p: p - 1024), held(slices))

        def twelve_bits(folder, random):  # the bits above them belong to an overlay
            slices = stack(random)
            self.check(write_slices(folder, slices, random, used=12, pixels=lambda p: p + 0xA000),
                       held(slices))

        def syntax(uid, **encoding):
            def written(folder, random):
                slices = stack(random)
                self.check(write_slices(folder, slices, random, syntax=uid, **encoding),
                           held(slices))
            written.__name__ = f"syntax {uid} {encoding}"
            return written

        self.cases(1, bytes_, signed, signed_and_added, twelve_bits,
                   syntax("1.2.840.10008.1.2"), syntax("1.2.840.10008.1.2", bits=8),
                   syntax("1.2.840.10008.1.2.2"),
                   syntax("1.2.840.10008.1.2.5"), syntax("1.2.840.10008.1.2.5", bits=8))

    def test_enhanced_images(self):
        def enhanced(folder, random):
            slices = stack(random)
            path = dicom.write_enhanced(folder / "all.dcm", slices, random)
            self.check(path, held(slices))
            self.check(folder, held(slices))

        self.cases(2, enhanced)

    def test_other_files_in_the_folder(self):
        def localizer(folder, random):
            slices = stack(random)
            write_slices(folder, slices, random)

            def marked(file, _):
                file.ImageType = ["ORIGINAL", "PRIMARY", "LOCALIZER"]

            write_slices(folder, stack(random)[:1], random, series="1.2.3.9", change=marked)
            self.check(folder, held(slices), said=["a localizer: left out"])

        def text(folder, random):
            slices = stack(random)
            write_slices(folder, slices, random)
            (folder / "README").write_text("slices of a phantom")
            self.check(folder, held(slices), said=["README: not a DICOM file: left out"])

        def subfolder(folder, random):
            slices = stack(random)
            write_slices(folder, slices, random)
            write_slices(folder / "other", stack(random), random)
            self.check(folder, held(slices))

        def text_that_claims_to_be_dicom(folder, random):
            for ending in (".dcm", ".DCM", ".ima", ".IMA"):
                (folder / f"a{ending}").write_text("slices of a phantom")
                self.refused(folder, f"a{ending}", "expected a whole DICOM file")
                (folder / f"a{ending}").unlink()

        def many_items(folder, random):  # but none in the other; in both byte orders
            for syntax in ("1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2"):
                slices = stack(random)

                def change(file, _):
                    file.ReferencedImageSequence = dicom.Sequence(
                        dicom.item(ReferencedFrameNumber=i) for i in range(2500))
                    file["ReferencedImageSequence"].is_undefined_length = True
                    for each in file.ReferencedImageSequence:
                        each.is_undefined_length_sequence_item = bool(random.integers(2))

                inner = folder / syntax
                self.check(write_slices(inner, slices[:3], random, syntax=syntax, change=change),
                           held(slices[:3]))

        def bytes_that_end_no_item(folder, random):  # but read so, in pixels and in an item
            ends = b"\xfe\xff\x0d\xe0\0\0\0\0"
            slices = stack(random, labels=[7, 57357, 65534])
            for each in slices:
                each.pixels[0, :4] = numpy.frombuffer(ends, "<u2")

            def change(file, _):
                block = dicom.item()
                block.add_new(0x00090010, "LO", "STYLET")
                block.add_new(0x00091001, "OB", ends * 3)
                file.ReferencedImageSequence = dicom.Sequence([block])

            self.check(write_slices(folder, slices, random, change=change), held(slices))

        self.cases(1, localizer, text, subfolder, text_that_claims_to_be_dicom, many_items,
                   bytes_that_end_no_item)


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class IrregularSeries(Conformance):
    def test_a_tilted_gantry_is_put_upright(self):
        def tilted(folder, random):
            degrees, way = random.uniform(3, 28), random.uniform(0, 2 * numpy.pi)
            lean = numpy.tan(numpy.radians(degrees)) * numpy.array([numpy.cos(way), numpy.sin(way)])
            slices = stack(random, lean=lean)
            half = 0.5 * numpy.hypot(*slices[0].spacing)
            self.check(write_slices(folder, slices, random), held(slices), within=half,
                       said=[f"lean by {degrees:.3g}"[:10], "put upright by whole pixels"])

        def tilted_and_uneven(folder, random):
            slices = stack(random, lean=random.uniform(-0.4, 0.4, 2),
                           distances=random.uniform(1.6, 2.6, 24))
            half = 0.5 * max(numpy.hypot(*slices[0].spacing), 2.6)
            self.check(write_slices(folder, slices, random), held(slices), NEAR, within=half,
                       said=["put upright by whole pixels", "mm apart: brought into layers"])

        def too_steep(folder, random):
            slices = stack(random, lean=(1.1, 0.5))
            self.refused(write_slices(folder, slices, random), "lean by", "expected at most 45")

        def too_far_aside(folder, random):  # 400 mm of pixels of a millionth of one, each
            slices = [dicom.Slice(numpy.array([400.0 * i, 0, 1000 * i]), numpy.eye(3)[0],
                                  numpy.eye(3)[1], (1e-6, 1e-6), 1000, numpy.ones((4, 4), int))
                      for i in range(4)]
            self.refused(write_slices(folder, slices, random), "pixels: expected a smaller")

        self.cases(4, tilted)
        self.cases(2, tilted_and_uneven)
        self.cases(1, too_steep, too_far_aside)

    def test_uneven_distances_are_read_or_refused(self):
        def uneven(folder, random):
            slices = stack(random, distances=random.uniform(1.5, 2.6, 26))
            self.check(write_slices(folder, slices, random), held(slices), NEAR, within=1.3,
                       said=["mm apart: brought into layers"])

        def two_thicknesses(folder, random):  # a head: thin at its base, thick above
            thin, thick = random.uniform(1.5, 2.5), random.uniform(4, 5)
            many = [thin] * 12 + [thick] * 10
            slices = stack(random, distances=[(a + b) / 2 for a, b in zip(many, many[1:])],
                           thickness=many)
            self.check(write_slices(folder, slices, random), held(slices), NEAR, within=thick / 2,
                       said=["mm apart: brought into layers"])

        def thin_with_some_missing(folder, random):  # most of them, so it is the rule
            distances = random.permutation([2.0] * 8 + [1.2] * 3)
            slices = stack(random, thickness=[1.0] * 12, distances=distances)
            self.check(write_slices(folder, slices, random), held(slices), NEAR, within=1,
                       said=["mm apart: brought into layers",
                             "slices of 1 mm lie 2 mm apart: what lies between them"])

        def some_without_thickness(folder, random):  # any slice but the first
            slices = stack(random, distances=random.uniform(1.5, 2.6, 26))
            for i in random.permutation(numpy.arange(1, 27))[:9]:
                slices[i].thickness = 0
            self.check(write_slices(folder, slices, random), held(slices), NEAR, within=1.3,
                       said=["mm apart: brought into layers"])

        self.cases(3, uneven)
        self.cases(2, two_thicknesses, thin_with_some_missing, some_without_thickness)

    def test_missing_and_duplicate_slices_are_refused(self):
        def missing(folder, random):
            slices = stack(random, distances=[2.0] * 15)
            del slices[int(random.integers(2, 13))]
            self.refused(write_slices(folder, slices, random), "4 mm from the slice before",
                         "expected no slice missing")

        def twice(folder, random):
            slices = stack(random)
            slices.insert(3, slices[int(random.integers(0, len(slices)))])
            self.refused(write_slices(folder, slices, random), "missing or twice")

        def overlapping(folder, random):
            distances = numpy.full(14, 3.0)
            distances[5:7] = 1.2, 4.0
            self.refused(write_slices(folder, stack(random, distances=distances), random),
                         "1.2 mm from the slice before")

        def cut(folder, random):
            write_slices(folder, stack(random), random)
            path = sorted(folder.iterdir())[4]
            for part in (0.1, 0.5, 0.99):
                whole = path.read_bytes()
                path.write_bytes(whole[:int(len(whole) * part)])
                self.refused(folder, path.name)
                path.write_bytes(whole)

        def deep(folder, random):  # sequences in sequences, as many as fit
            path = write_slices(folder, stack(random)[:1], random)
            path = next(path.iterdir())
            nested = struct.pack("<HH2sHIHHI", 8, 0x1115, b"SQ", 0, 2**32 - 1, 0xFFFE, 0xE000,
                                 2**32 - 1)
            whole = path.read_bytes()
            for count in (1000, 200_000):
                path.write_bytes(whole + nested * count)
                self.refused(folder, path.name)

        def empty_items(folder, random):  # each takes 260 bytes of memory
            for count in (1900, 60_000):
                def change(file, _):
                    file.ReferencedImageSequence = dicom.Sequence(
                        dicom.item() for _ in range(count))
                slices, inner = stack(random)[:1], folder / str(count)
                write_slices(inner, slices, random, change=change)
                if count < 2000:
                    self.check(inner, held(slices))
                else:
                    self.refused(inner, f"{count} items in", "at least 16 bytes for each")

        def no_order(folder, random):  # each is looked up among all
            slices = stack(random)[:1]
            path = next(write_slices(folder, slices, random).iterdir())
            whole = path.read_bytes()  # up to the pixels, so what follows belongs before them
            for count in (1000, 1001, 100_000):
                path.write_bytes(whole + b"".join(
                    struct.pack("<HH2sH", 0x4001 + 2 * (n // 60000), 0x1000 + n % 60000, b"LO", 0)
                    for n in random.permutation(count)))
                if count == 1000:
                    self.check(folder, held(slices))
                else:
                    self.refused(folder, path.name, "more than 1000 kinds are out of order")

        def own_order(folder, random):  # of a writer that has it in each of 3000 items
            slices = stack(random)[:1]
            path = next(write_slices(folder, slices, random).iterdir())
            item = b"".join((struct.pack("<HHI", 0xFFFE, 0xE000, 2**32 - 1),
                             struct.pack("<HH2sH", 0x4009, 0x1012, b"LO", 0),
                             struct.pack("<HH2sH", 0x4009, 0x1011, b"LO", 0),
                             struct.pack("<HHI", 0xFFFE, 0xE00D, 0)))
            path.write_bytes(path.read_bytes() + struct.pack(
                "<HH2sHI", 0x4009, 0x1010, b"SQ", 0, 2**32 - 1) + 3000 * item +
                struct.pack("<HHI", 0xFFFE, 0xE0DD, 0))
            self.check(folder, held(slices))

        def many_elements(folder, random):  # in which the numbers of each frame are looked up
            slices = stack(random)
            path = dicom.write_enhanced(folder / "image.dcm", slices, random)
            file = pydicom.dcmread(path)
            groups = file.SharedFunctionalGroupsSequence[0]
            for item, there in ((file, len(file)), (groups, 0)):
                for n in range(4000 - there):
                    item.add_new(0x40011000 + n, "LO", "")
                file.save_as(path)
                self.check(folder, held(slices))
                item.add_new(0x40011000 + 4000, "LO", "")
                file.save_as(path)
                self.refused(folder, "4001 elements on one level: expected at most 4000")
                del item[0x40011000 + 4000]

        def two_series(folder, random):
            slices = stack(random)
            write_slices(folder, slices, random)
            write_slices(folder, slices, random, series="1.2.3.9")
            self.refused(folder, "2 DICOM series", f"1.2.3.9: {len(slices)} files", "expected one")

        self.cases(2, missing)
        self.cases(1, twice, overlapping, cut, deep, empty_items, no_order, own_order,
                   many_elements,
                   two_series)

    def test_slices_that_differ_or_lack_something_are_refused(self):
        def changed(name, change, *said, all_=False):
            def written(folder, random):
                slices = stack(random)
                place = int(random.integers(1, len(slices)))

                def to_one(file, i):
                    if all_ or i == place:
                        change(file)

                self.refused(write_slices(folder, slices, random, change=to_one), *said)
            written.__name__ = name
            self.cases(1, written)

        def setter(**values):
            def change(file):
                for key, value in values.items():
                    setattr(file, key, value)
            return change

        def without(name):
            return lambda file: delattr(file, name)

        def aside(file):
            row = numpy.array(file.ImageOrientationPatient[:3], float)
            file.ImagePositionPatient = dicom.texts(
                numpy.array(file.ImagePositionPatient, float) + 4 * row)

        def turned_more(file):
            first, second = numpy.array(file.ImageOrientationPatient, float).reshape(2, 3)
            c, s = numpy.cos(0.05), numpy.sin(0.05)
            file.ImageOrientationPatient = dicom.texts([*(c * first + s * second),
                                                        *(c * second - s * first)])

        def leaning_columns(file):
            first, second = numpy.array(file.ImageOrientationPatient, float).reshape(2, 3)
            other = numpy.cos(0.05) * second + numpy.sin(0.05) * numpy.cross(first, second)
            file.ImageOrientationPatient = dicom.texts([*first, *other])

        def fewer_columns(file):
            file.Columns -= 1

        def larger(file):
            file.PixelSpacing = [float(v) * 1.1 for v in file.PixelSpacing]

        def coloured(file):
            file.SamplesPerPixel, file.PhotometricInterpretation = 3, "RGB"
            file.PlanarConfiguration = 0
            dicom.put_pixels(file, numpy.zeros((file.Rows, file.Columns, 3)), bits=8)

        def several(file):
            file.NumberOfFrames, file.PixelData = 2, file.PixelData * 2

        def fewer_rows(file):
            file.Rows -= 1

        def hounsfield(file):
            file.RescaleIntercept, file.RescaleSlope = "-1024", "1"

        def lossy(file):
            file.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.4.50"
            encapsulate(file)

        def deflated(file):
            file.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.1.99"

        def jpeg_2000(file):
            file.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.4.90"
            encapsulate(file)

        def encapsulate(file):
            from pydicom.encaps import encapsulate as items
            file.PixelData = items([bytes(2000)])
            file["PixelData"].VR, file["PixelData"].is_undefined_length = "OB", True

        def bytes_elsewhere(file):
            file.add_new(0x00090010, "LO", "STYLET")
            file.add_new(0x00091001, "OB", file.PixelData)
            del file.PixelData

        for case in (("aside", aside, "lies 4 mm to the side"),
                     ("turned_more", turned_more, "the same direction as in"),
                     ("leaning_columns", leaning_columns, "the same direction as in"),
                     ("larger", larger, "pixels of", "expected"),
                     ("fewer_columns", fewer_columns, "pixels: expected"),
                     ("no_frames", setter(NumberOfFrames=0), "NumberOfFrames 0: expected 1"),
                     ("no_rows", setter(Rows=0), "x 0 pixels: expected a slice"),
                     ("no_columns", setter(Columns=0), "0 x", "pixels: expected a slice"),
                     ("no_rows_of_two", setter(Rows=0, NumberOfFrames=2), "expected a slice"),
                     ("no_columns_of_two", setter(Columns=0, NumberOfFrames=2), "expected a slice"),
                     ("not_square", setter(ImageOrientationPatient=[1, 0, 0, 0.6, 0.8, 0]),
                      "ImageOrientationPatient 1 0 0 0.6 0.8 0"),
                     ("endless", setter(PixelSpacing=[1e9, 1]), "PixelSpacing 1000000000"),
                     ("no_bits", setter(BitsStored=0), "0 of 16 bits a pixel"),
                     ("more_bits", setter(BitsStored=20), "20 of 16 bits a pixel"),
                     ("low_bit", setter(HighBit=3), "HighBit 3: expected 15 to 15"),
                     ("high_bit", setter(HighBit=16), "HighBit 16: expected 15 to 15"),
                     ("no_size", setter(PixelSpacing=[0, 0]), "PixelSpacing 0"),
                     ("without_spacing", without("PixelSpacing"), "PixelSpacing nan"),
                     ("without_place", without("ImagePositionPatient"),
                      "ImagePositionPatient nan nan nan"),
                     ("without_turn", without("ImageOrientationPatient"),
                      "ImageOrientationPatient nan"),
                     ("skewed", setter(ImageOrientationPatient=[1, 0, 0, 0.1, 1, 0]),
                      "ImageOrientationPatient 1 0 0 0.1 1 0"),
                     ("coloured", coloured, "3 values a pixel"),
                     ("several", several, "frame 1", "missing or twice"),
                     ("fewer_rows", fewer_rows, "pixels: expected"),
                     ("other_frame", setter(FrameOfReferenceUID="1.2.9"), "FrameOfReferenceUID"),
                     ("no_frame", without("FrameOfReferenceUID"), "FrameOfReferenceUID : expected"),
                     ("hounsfield", hounsfield, "expected labels"),
                     ("without_pixels", without("PixelData"), "bytes are there"),
                     ("bytes_elsewhere", bytes_elsewhere, "0 bytes of pixels: expected"),
                     ("odd_bits", setter(BitsAllocated=12), "of 12 bits a pixel"),
                     ("lossy", lossy, "changes values"),
                     ("deflated", deflated, "the whole file is deflated"),
                     ("jpeg_2000", jpeg_2000, "JPEG 2000", "cannot be decompressed")):
            changed(*case)


if __name__ == "__main__":
    unittest.main(verbosity=2)
