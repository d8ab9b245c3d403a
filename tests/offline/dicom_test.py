#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""DICOM segmentations and series of slices, written here by pydicom, against the same labels as
NRRD: the same counts, and the same organ in the same place. Damaged and incomplete files are
refused.

usage: dicom_test.py   (STYLET_BIN)
"""
import hashlib
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

try:
    import numpy
    import pydicom
    from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
    from pydicom.sequence import Sequence
    from pydicom.uid import ExplicitVRLittleEndian, generate_uid
except ImportError:
    pydicom = None

TOOL = pathlib.Path(os.environ.get("STYLET_BIN", "build/bin")) / "stylet-organ"
CT, SEG = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.66.4"

# A tilted frame: row and column directions, spacings along row, column and normal, first voxel.
ROW, COLUMN = (0.8, 0.6, 0.0), (-0.6, 0.8, 0.0)
SPACING, ORIGIN = (1.5, 2.0, 3.0), (-40.0, 25.0, 110.0)
SIZE = (40, 30, 20)


def labels():
    """Two balls, the second partly inside the first; index order z, y, x."""
    z, y, x = numpy.mgrid[0:SIZE[2], 0:SIZE[1], 0:SIZE[0]]
    place = numpy.stack([x * SPACING[0], y * SPACING[1], z * SPACING[2]], axis=-1)
    first = numpy.linalg.norm(place - [28, 30, 30], axis=-1) < 20
    second = numpy.linalg.norm(place - [36, 30, 30], axis=-1) < 8
    return numpy.where(second, 2, numpy.where(first, 1, 0)).astype(numpy.uint8)


def place_of(slice_index):
    normal = numpy.cross(ROW, COLUMN)
    return [float(v) for v in numpy.array(ORIGIN) + normal * SPACING[2] * slice_index]


def new_file(path, kind):
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = kind, generate_uid()
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID = kind, meta.MediaStorageSOPInstanceUID
    file.is_little_endian, file.is_implicit_VR = True, False
    file.PatientName = file.PatientID = "phantom"
    file.PatientBirthDate = file.PatientSex = file.StudyDate = file.StudyTime = ""
    file.AccessionNumber = file.ReferringPhysicianName = file.StudyID = ""
    file.StudyInstanceUID = "1.2.3.4"
    file.FrameOfReferenceUID = "1.2.3.5"
    file.PositionReferenceIndicator = ""
    file.SeriesNumber = file.InstanceNumber = 1
    file.Rows, file.Columns = SIZE[1], SIZE[0]
    file.SamplesPerPixel, file.PhotometricInterpretation = 1, "MONOCHROME2"
    file.PixelRepresentation = 0
    return file


def write_series(folder, skip=(), series="1.2.3.6"):
    """One file for each slice, in an order that is not the spatial one."""
    folder.mkdir(exist_ok=True)
    volume = labels()
    for i in range(SIZE[2]):
        if i in skip:
            continue
        file = new_file(folder / f"{(i * 7) % SIZE[2]:02d}-{series}.dcm", CT)
        file.Modality, file.SeriesInstanceUID, file.InstanceNumber = "CT", series, i + 1
        file.ImagePositionPatient, file.ImageOrientationPatient = place_of(i), [*ROW, *COLUMN]
        file.PixelSpacing, file.SliceThickness = [SPACING[1], SPACING[0]], SPACING[2]
        file.BitsAllocated, file.BitsStored, file.HighBit = 16, 16, 15
        file.PixelData = volume[i].astype("<u2").tobytes()
        file.save_as(file.filename, write_like_original=False)


def change_slices(folder, change):
    """Rewrites every slice of a series after `change(file, index along the normal)`."""
    normal = numpy.cross(ROW, COLUMN)
    for path in sorted(folder.iterdir()):
        file = pydicom.dcmread(str(path))
        along = numpy.dot(normal, numpy.array(file.ImagePositionPatient, float)
                          - numpy.array(ORIGIN)) / SPACING[2]
        change(file, int(round(along)))
        file.save_as(str(path), write_like_original=False)


def moved(position, millimetres, direction):
    return [float(p + millimetres * d) for p, d in zip(position, direction)]


def item(**values):
    dataset = Dataset()
    for name, value in values.items():
        setattr(dataset, name, value)
    return dataset


def code():
    return item(CodeValue="85756007", CodingSchemeDesignator="SCT", CodeMeaning="Tissue")


def write_seg(path, shift=None):
    """Segment after segment, only the slices in which it has pixels."""
    volume = labels()
    file = new_file(path, SEG)
    file.Modality, file.SeriesInstanceUID = "SEG", "1.2.3.7"
    file.ImageType = ["DERIVED", "PRIMARY"]
    file.ContentLabel, file.ContentDescription, file.ContentCreatorName = "SEG", "", ""
    file.ContentDate, file.ContentTime = "20200101", "000000"
    file.Manufacturer = file.ManufacturerModelName = "phantom"
    file.DeviceSerialNumber = file.SoftwareVersions = "1"
    file.BitsAllocated, file.BitsStored, file.HighBit = 1, 1, 0
    file.LossyImageCompression, file.SegmentationType = "00", "BINARY"
    file.SegmentSequence = Sequence(
        item(SegmentNumber=n, SegmentLabel=name, SegmentAlgorithmType="MANUAL",
             SegmentedPropertyCategoryCodeSequence=Sequence([code()]),
             SegmentedPropertyTypeCodeSequence=Sequence([code()]))
        for n, name in ((1, "Liver"), (2, "Lesion")))
    file.SharedFunctionalGroupsSequence = Sequence([item(
        PixelMeasuresSequence=Sequence([item(PixelSpacing=[SPACING[1], SPACING[0]],
                                             SliceThickness=SPACING[2])]),
        PlaneOrientationSequence=Sequence([item(ImageOrientationPatient=[*ROW, *COLUMN])]))])
    frames, bits = [], []
    for segment in (1, 2):
        for i in range(SIZE[2]):
            # The lesion lies in the liver: both claim its pixels.
            mask = volume[i] >= segment
            if not mask.any():
                continue
            position = place_of(i if shift is None or frames else i + shift)
            frames.append(item(
                FrameContentSequence=Sequence([item(DimensionIndexValues=[segment, i + 1])]),
                PlanePositionSequence=Sequence([item(ImagePositionPatient=position)]),
                SegmentIdentificationSequence=Sequence([item(ReferencedSegmentNumber=segment)])))
            bits.append(mask)
    file.NumberOfFrames = len(frames)
    file.DimensionOrganizationSequence = Sequence([item(DimensionOrganizationUID="1.2.3.8")])
    file.DimensionIndexSequence = Sequence([
        item(DimensionOrganizationUID="1.2.3.8", DimensionIndexPointer=0x0062000B,
             FunctionalGroupPointer=0x0062000A),
        item(DimensionOrganizationUID="1.2.3.8", DimensionIndexPointer=0x00200032,
             FunctionalGroupPointer=0x00209113)])
    file.PerFrameFunctionalGroupsSequence = Sequence(frames)
    flat = numpy.concatenate([mask.ravel() for mask in bits])
    file.PixelData = numpy.packbits(flat, bitorder="little").tobytes()
    if len(file.PixelData) % 2:
        file.PixelData += b"\0"
    file.save_as(str(path), write_like_original=False)


def write_nrrd(path):
    normal = numpy.cross(ROW, COLUMN)
    axes = [numpy.array(d) * s for d, s in zip((ROW, COLUMN, normal), SPACING)]
    text = " ".join("(" + ",".join(f"{v:.17g}" for v in axis) + ")" for axis in axes)
    head = (f"NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
            f"sizes: {SIZE[0]} {SIZE[1]} {SIZE[2]}\nspace directions: {text}\n"
            f"space origin: ({','.join(map(str, ORIGIN))})\nencoding: raw\n\n")
    path.write_bytes(head.encode() + labels().tobytes())


def sum_of(source):
    """Checksum of a file; for a folder the checksum of its files' checksums in the order of their
    names."""
    path = pathlib.Path(source)
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    sums = [hashlib.sha256(each.read_bytes()).hexdigest() for each in files]
    return sums[0] if len(sums) == 1 else hashlib.sha256("".join(sums).encode()).hexdigest()


@unittest.skipIf(pydicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class Dicom(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "r.toml").write_text("[tissues]\nliver = [1]\ntumour = [2]\n")
        write_nrrd(self.folder / "map.nrrd")

    def tool(self, *words):
        return subprocess.run([TOOL, *map(str, words)], capture_output=True, text=True,
                              timeout=120)

    def facts(self, *words):
        done = self.tool(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def organ(self, source):
        facts = self.facts("build", source, "--recipe", self.folder / "r.toml", "--voxel-mm", 4,
                           "--name", "x", "-o", self.folder / "x.organ")
        return facts["organ"]

    def check_same(self, source):
        found = self.facts("labels", source)["labels"]
        counts = [(each["label"], each["voxels"]) for each in found]
        self.assertEqual(counts, [(1, int((labels() == 1).sum())), (2, int((labels() == 2).sum()))])
        seen, wanted = self.organ(source), self.organ(self.folder / "map.nrrd")
        for key in ("voxels", "lattice_size", "surface_triangles"):
            self.assertEqual(seen[key], wanted[key], key)
        self.assertEqual(seen["provenance"]["sources"][0]["sha256"], sum_of(source))
        self.assertAlmostEqual(seen["volume_ml"], wanted["volume_ml"], delta=0.02)
        for a, b in zip(seen["origin_mm"], wanted["origin_mm"]):
            self.assertAlmostEqual(a, b, places=3)

    def check_refused(self, source, said):
        done = self.tool("labels", source)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(said, done.stderr)

    def test_segmentation(self):
        write_seg(self.folder / "seg.dcm")
        self.check_same(self.folder / "seg.dcm")
        names = [each["name"] for each in self.facts("labels", self.folder / "seg.dcm")["labels"]]
        self.assertEqual(names, ["Liver", "Lesion"])

    def test_series(self):
        write_series(self.folder / "series")
        self.check_same(self.folder / "series")

    def test_incomplete_series_are_refused(self):
        write_series(self.folder / "gap", skip=[9])
        self.check_refused(self.folder / "gap", "expected no slice missing or twice")
        write_series(self.folder / "two")
        write_series(self.folder / "two", series="1.2.3.9")
        self.check_refused(self.folder / "two",
                           "2 DICOM series (1.2.3.6: 20 files, 1.2.3.9: 20 files): expected one")
        (self.folder / "none").mkdir()
        self.check_refused(self.folder / "none", "0 DICOM series: expected one")

    def test_slices_that_fit_no_regular_grid_are_refused_with_their_place(self):
        random = numpy.random.default_rng(5)

        one = int(random.integers(1, SIZE[2]))

        def aside(file, i):
            if i == one:
                file.ImagePositionPatient = moved(file.ImagePositionPatient, 4.0, ROW)

        def below(file, i):  # a third of a pixel along the columns, nothing along the rows
            if i == one:
                file.ImagePositionPatient = moved(file.ImagePositionPatient, SPACING[1] / 3, COLUMN)

        def finer(file, i):
            if i >= SIZE[2] // 2:
                file.PixelSpacing = [SPACING[1] * 0.9, SPACING[0] * 0.9]

        def no_size(file, i):
            file.PixelSpacing = [0, 0]

        def unsized(file, i):
            if i == one:
                del file.PixelSpacing

        def coloured(file, i):
            if i == one:
                file.SamplesPerPixel, file.PhotometricInterpretation = 3, "RGB"
                file.PlanarConfiguration = 0
                file.BitsAllocated, file.BitsStored, file.HighBit = 8, 8, 7
                file.PixelData = bytes(3 * SIZE[0] * SIZE[1])

        def several(file, i):
            if i == one:
                file.NumberOfFrames = 2
                file.PixelData = file.PixelData * 2

        cases = ((aside, "lies 4 mm to the side"),
                 (below, f"lies {SPACING[1] / 3:.4g} mm to the side"),
                 (finer, "pixels of 1.35 mm"), (no_size, "PixelSpacing 0"),
                 (unsized, "PixelSpacing nan"), (coloured, "3 values a pixel"),
                 (several, "frame 1: lies 0 mm from"))
        for change, said in cases:
            with self.subTest(change.__name__):
                folder = self.folder / change.__name__
                write_series(folder)
                change_slices(folder, change)
                self.check_refused(folder, said)

    def test_a_slice_that_is_cut_off_is_refused(self):
        folder = self.folder / "cut"
        write_series(folder)
        path = sorted(folder.iterdir())[7]
        whole = path.read_bytes()
        for size in (len(whole) // 2, len(whole) - 10):
            path.write_bytes(whole[:size])
            done = self.tool("labels", folder)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(path.name, done.stderr)

    def test_a_single_slice_is_as_thick_as_it_says(self):
        folder = self.folder / "single"
        write_series(folder, skip=[i for i in range(SIZE[2]) if i != 10])
        volume = self.facts("labels", folder)["labels"][0]
        pixels = int((labels()[10] == 1).sum())
        expected = pixels * SPACING[0] * SPACING[1] * SPACING[2] * 1e-3
        self.assertAlmostEqual(volume["volume_ml"], expected, places=2)

        def thin(file, i):
            del file.SliceThickness

        change_slices(folder, thin)
        self.check_refused(folder, "without SliceThickness")

    def test_segments_far_apart_are_not_filled_up(self):
        """A lesion in two slices with nothing between them: its volume is that of two slices."""
        kept = labels
        z = numpy.arange(SIZE[2])[:, None, None]
        apart = numpy.where((z == 3) | (z == 15), (kept() > 0) * 0 + 1, 0)
        apart[:, : SIZE[1] // 2] = 0
        globals()["labels"] = lambda: apart.astype(numpy.uint8)
        try:
            write_seg(self.folder / "apart.dcm")
        finally:
            globals()["labels"] = kept
        found = self.facts("labels", self.folder / "apart.dcm")["labels"]
        self.assertEqual([each["voxels"] for each in found], [int(apart.sum())])
        expected = apart.sum() * SPACING[0] * SPACING[1] * SPACING[2] * 1e-3
        self.assertAlmostEqual(found[0]["volume_ml"], expected, places=2)

    def test_segmentations_are_read_by_content_and_position(self):
        write_seg(self.folder / "seg.dcm")
        bare = self.folder / "segmentation"
        bare.write_bytes((self.folder / "seg.dcm").read_bytes())
        self.check_same(bare)
        done = self.tool("build", bare, "-o", self.folder / "y.organ")
        self.assertEqual(done.returncode, 1)
        self.assertIn("segmentation: this is a label map: expected --recipe with it", done.stderr)
        file = pydicom.dcmread(str(bare))
        frames = file.PerFrameFunctionalGroupsSequence
        # A difference of 0.0001 mm does not decide which segment has a voxel.
        for frame in frames:
            if frame.SegmentIdentificationSequence[0].ReferencedSegmentNumber == 1:
                place = frame.PlanePositionSequence[0]
                normal = numpy.cross(ROW, COLUMN)
                place.ImagePositionPatient = moved(place.ImagePositionPatient, 1e-4, normal)
        file.save_as(str(bare), write_like_original=False)
        self.check_same(bare)
        place = frames[3].PlanePositionSequence[0]
        place.ImagePositionPatient = moved(place.ImagePositionPatient, 6.0, ROW)
        file.save_as(str(bare), write_like_original=False)
        self.check_refused(bare, "frame 3: lies 6 mm to the side")

    def test_other_segmentations_are_refused(self):
        path = self.folder / "seg.dcm"
        write_seg(path, shift=0.7)
        self.check_refused(path, "from the plane before: expected 3 mm")
        write_series(self.folder / "series")
        self.check_refused(next((self.folder / "series").iterdir()), "give its folder")
        write_seg(path)
        whole = path.read_bytes()
        for size in (0, 100, 200, len(whole) // 2, len(whole) - 400):
            path.write_bytes(whole[:size])
            self.check_refused(path, "expected")


if __name__ == "__main__":
    unittest.main(verbosity=2)
