# SPDX-License-Identifier: Apache-2.0
"""Series of slices and segmentations with random geometry, written by pydicom, and their content by
the definition of ImagePositionPatient, ImageOrientationPatient and PixelSpacing (PS3.3 C.7.6.2.1):
volume and centroid of each label, by numpy. Units: mm, ml. Frame: the patient's (LPS)."""
import dataclasses

import numpy
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.sequence import Sequence
from pydicom.uid import ExplicitVRLittleEndian, RLELossless, generate_uid

CT, CAPTURE = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.7"
ENHANCED, SEG = "1.2.840.10008.5.1.4.1.1.2.1", "1.2.840.10008.5.1.4.1.1.66.4"


def item(**values):
    dataset = Dataset()
    for name, value in values.items():
        setattr(dataset, name, value)
    return dataset


def one(**values):
    return Sequence([item(**values)])


@dataclasses.dataclass
class Slice:
    """A plane of pixels: its position and its content."""
    at: numpy.ndarray            # ImagePositionPatient
    row: numpy.ndarray           # direction along a row
    column: numpy.ndarray
    spacing: tuple               # of rows, of columns, as PixelSpacing
    thickness: float
    pixels: numpy.ndarray
    segment: int = 0


def turned(random):
    """Any rotation: the rows are directions along row, column and normal."""
    q, _ = numpy.linalg.qr(random.normal(size=(3, 3)))
    q[2] = numpy.cross(q[0], q[1])
    return q


def blobs(random, shape, labels):
    """Ellipsoids inside the volume, some of them overlapping."""
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(n) for n in shape], indexing="ij"), -1)
    volume = numpy.zeros(shape, int)
    for label in labels:
        radius = numpy.array(shape) * random.uniform(0.16, 0.3, 3)
        middle = [random.uniform(r + 1, n - r - 2) for r, n in zip(radius, shape)]
        volume[(((grid - middle) / radius) ** 2).sum(-1) < 1] = label
    return volume


def stack(random, distances=None, lean=(0, 0), labels=None, thickness=None):
    """Slices along a random normal; `lean`: mm along row and column for each mm along the
    normal."""
    frame, shape = turned(random), random.integers((16, 24, 28), (24, 40, 44))
    if distances is None:
        distances = numpy.full(shape[0] - 1, random.uniform(0.9, 3.5))
    shape[0] = len(distances) + 1
    if labels is None:
        labels = random.choice(numpy.arange(1, 250), 3, replace=False)
    volume = blobs(random, shape, labels)
    spacing = tuple(float(numpy.round(v, 6)) for v in random.uniform(0.6, 1.6, 2))
    origin, along = random.uniform(-200, 200, 3), numpy.concatenate([[0], numpy.cumsum(distances)])
    if thickness is None:
        thickness = [float(numpy.median(distances))] * shape[0]
    return [Slice(origin + z * (frame[2] + lean[0] * frame[0] + lean[1] * frame[1]), frame[0],
                  frame[1], spacing, thickness[i], volume[i]) for i, z in enumerate(along)]


def slabs(slices, widest=None, alone=None):
    """The slab of each slice along the normal, relative to the slice: half of the way to the next;
    if that is farther than `widest`, half of `alone`."""
    normal = numpy.cross(slices[0].row, slices[0].column)
    along = numpy.array([s.at @ normal for s in slices])
    places = numpy.unique(numpy.round(along, 9))
    result = []
    for z in along:
        k = int(numpy.argmin(abs(places - z)))
        ways = [places[k] - places[k - 1] if k > 0 else None,
                places[k + 1] - places[k] if k + 1 < len(places) else None]
        if alone is not None:
            ways = [alone if w is None or w > widest else w for w in ways]
        elif len(places) > 1:
            ways = [w if w is not None else ways[1 - j] for j, w in enumerate(ways)]
        else:
            ways = [slices[0].thickness] * 2
        result.append((-ways[0] / 2, ways[1] / 2))
    return result


def held(slices, **rule):
    """{label: (pixels, ml, centroid)}. A pixel is a box as long as its slab along the normal, which
    leans as the stack does."""
    normal, found = numpy.cross(slices[0].row, slices[0].column), {}
    ends = sorted((slices[0], slices[-1]), key=lambda s: s.at @ normal)
    height = (ends[1].at - ends[0].at) @ normal
    course = (ends[1].at - ends[0].at) / height if height > 0 else normal
    for each, (low, high) in zip(slices, slabs(slices, **rule)):
        area = each.spacing[0] * each.spacing[1]
        for label in numpy.unique(each.pixels[each.pixels > 0]):
            rows, columns = numpy.nonzero(each.pixels == label)
            place = (each.at + course * (low + high) / 2
                     + each.row * each.spacing[1] * columns.mean()
                     + each.column * each.spacing[0] * rows.mean())
            ml = len(rows) * area * (high - low) * 1e-3
            pixels, volume, moment = found.get(label, (0, 0, 0))
            found[label] = (pixels + len(rows), volume + ml, moment + ml * place)
    return {int(k): (n, ml, moment / ml) for k, (n, ml, moment) in found.items()}


def new_file(path, kind, syntax=ExplicitVRLittleEndian):
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = kind, generate_uid()
    meta.TransferSyntaxUID = syntax
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID = kind, meta.MediaStorageSOPInstanceUID
    file.is_little_endian = syntax != "1.2.840.10008.1.2.2"
    file.is_implicit_VR = syntax == "1.2.840.10008.1.2"
    file.PatientName = file.PatientID = "phantom"
    file.PatientBirthDate = file.PatientSex = file.StudyDate = file.StudyTime = ""
    file.StudyInstanceUID, file.FrameOfReferenceUID = "1.2.3.4", "1.2.3.5"
    file.SamplesPerPixel, file.PhotometricInterpretation = 1, "MONOCHROME2"
    file.PixelRepresentation = 0
    return file


def texts(values):
    """Numbers as decimal strings of at most 16 characters, as usual."""
    return [f"{float(v):.9g}"[:16] for v in values]


def put_pixels(file, pixels, bits=16, signed=False, used=None):
    file.BitsAllocated, file.BitsStored = bits, used or bits
    file.HighBit, file.PixelRepresentation = file.BitsStored - 1, int(signed)
    order = "<" if file.is_little_endian else ">"
    data = pixels.astype(f"{order}{'i' if signed else 'u'}{bits // 8}").tobytes()
    file.PixelData = data + b"\0" * (len(data) % 2)
    file["PixelData"].VR = "OW" if bits == 16 else "OB"


def write_slices(folder, slices, random, kind=CT, syntax=ExplicitVRLittleEndian, series="1.2.3.6",
                 change=None, pixels=None, **encoding):
    """One file for each slice, with names and instance numbers in random order; `change(file,
    number)` is called last."""
    folder.mkdir(exist_ok=True)
    names = random.permutation(len(slices))
    for i, each in enumerate(slices):
        file = new_file(folder / f"{series[-1]}{names[i]:03d}.dcm", kind, syntax)
        file.Modality, file.SeriesInstanceUID = "CT", series
        file.InstanceNumber = int(names[-1 - i]) + 1
        file.ImagePositionPatient = texts(each.at)
        file.ImageOrientationPatient = texts([*each.row, *each.column])
        file.PixelSpacing, file.SliceThickness = texts(each.spacing), texts([each.thickness])[0]
        file.Rows, file.Columns = each.pixels.shape
        put_pixels(file, each.pixels if pixels is None else pixels(each.pixels), **encoding)
        if syntax == RLELossless:
            file.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
            file.compress(RLELossless)
        if change is not None:
            change(file, i)
        file.save_as(file.filename, write_like_original=False)
    return folder


def frame_groups(each):
    return item(PlanePositionSequence=one(ImagePositionPatient=texts(each.at)),
                PlaneOrientationSequence=one(
                    ImageOrientationPatient=texts([*each.row, *each.column])),
                PixelMeasuresSequence=one(PixelSpacing=texts(each.spacing),
                                          SliceThickness=texts([each.thickness])[0]))


def write_enhanced(path, slices, random):
    """All slices in one file, in random order, with all functional groups in each frame."""
    file = new_file(path, ENHANCED)
    file.Modality, file.SeriesInstanceUID = "CT", "1.2.3.6"
    file.NumberOfFrames = len(slices)
    file.Rows, file.Columns = slices[0].pixels.shape
    order = random.permutation(len(slices))
    file.PerFrameFunctionalGroupsSequence = Sequence(frame_groups(slices[i]) for i in order)
    file.SharedFunctionalGroupsSequence = Sequence([item()])
    put_pixels(file, numpy.stack([slices[i].pixels for i in order]))
    file.save_as(str(path), write_like_original=False)
    return path


def write_seg(path, frames, names, apart=None, kind="BINARY", change=None):
    """`frames`: slices with a segment each; pixels are 0 or 1 (for a fraction: to 255), in this
    order."""
    file = new_file(path, SEG)
    file.Modality, file.SeriesInstanceUID, file.SegmentationType = "SEG", "1.2.3.7", kind
    file.Rows, file.Columns = frames[0].pixels.shape
    file.SegmentSequence = Sequence(
        item(SegmentNumber=n, SegmentLabel=name, SegmentedPropertyTypeCodeSequence=one(
            CodeValue="85756007", CodingSchemeDesignator="SCT", CodeMeaning="Tissue"))
        for n, name in names.items())
    measures = item(PixelSpacing=texts(frames[0].spacing))
    measures.SliceThickness = texts([frames[0].thickness])[0]
    if apart is not None:
        measures.SpacingBetweenSlices = texts([apart])[0]
    file.SharedFunctionalGroupsSequence = Sequence([item(
        PixelMeasuresSequence=Sequence([measures]),
        PlaneOrientationSequence=one(
            ImageOrientationPatient=texts([*frames[0].row, *frames[0].column])))])
    file.PerFrameFunctionalGroupsSequence = Sequence(item(
        PlanePositionSequence=one(ImagePositionPatient=texts(each.at)),
        SegmentIdentificationSequence=one(ReferencedSegmentNumber=each.segment))
        for each in frames)
    file.NumberOfFrames = len(frames)
    flat = numpy.concatenate([each.pixels.ravel() for each in frames])
    if kind == "FRACTIONAL":
        file.SegmentationFractionalType, file.MaximumFractionalValue = "OCCUPANCY", 255
        put_pixels(file, flat, bits=8)
    else:
        file.BitsAllocated, file.BitsStored, file.HighBit = 1, 1, 0
        data = numpy.packbits(flat > 0, bitorder="little").tobytes()
        file.PixelData = data + b"\0" * (len(data) % 2)
        file["PixelData"].VR = "OB"
    if change is not None:
        change(file)
    file.save_as(str(path), write_like_original=False)
    return path


LABELMAP = "1.2.840.10008.5.1.4.1.1.66.7"


def write_label_map(path, slices, names, bits=8, background=0, change=None):
    """A segmentation whose pixels are numbers of segments (PS3.3 C.8.20.2, LABELMAP), the slices in
    this order; `background`: the number of pixels without a segment, described as highdicom
    does."""
    def as_map(file):
        file.SOPClassUID = file.file_meta.MediaStorageSOPClassUID = LABELMAP
        file.SegmentationType, file.PixelPaddingValue = "LABELMAP", background
        file.SegmentSequence.insert(0, item(SegmentNumber=background, SegmentLabel="Background"))
        for groups in file.PerFrameFunctionalGroupsSequence:
            del groups.SegmentIdentificationSequence
        pixels = numpy.stack([each.pixels for each in slices])
        put_pixels(file, numpy.where(pixels > 0, pixels, background), bits=bits)
        if change is not None:
            change(file)
    return write_seg(path, slices, names, kind="LABELMAP", change=as_map)


RTSTRUCT = "1.2.840.10008.5.1.4.1.1.481.3"


def write_structures(path, structures, frame="1.2.3.5", kind="CLOSED_PLANAR", change=None):
    """`structures`: (ROINumber, ROIName, contours), a contour being its points, n by 3."""
    file = new_file(path, RTSTRUCT)
    file.Modality, file.SeriesInstanceUID = "RTSTRUCT", "1.2.3.8"
    file.StructureSetROISequence = Sequence(
        item(ROINumber=number, ROIName=name, ReferencedFrameOfReferenceUID=frame)
        for number, name, _ in structures)
    file.ROIContourSequence = Sequence(
        item(ReferencedROINumber=number, ContourSequence=Sequence(
            item(ContourGeometricType=kind, NumberOfContourPoints=len(points),
                 ContourData=texts(points.ravel())) for points in contours))
        for number, _, contours in structures)
    if change is not None:
        change(file)
    file.save_as(str(path), write_like_original=False)
    return path


def polygon(random, radius, middle):
    """A lobed outline in a plane, n by 2."""
    angle = numpy.linspace(0, 2 * numpy.pi, 80, endpoint=False)
    lobes, phase = random.integers(2, 6), random.uniform(0, 6)
    r = radius * (1 + 0.2 * numpy.sin(lobes * angle + phase))
    return numpy.array(middle) + numpy.stack([r * numpy.cos(angle), r * numpy.sin(angle)], -1)


def area_and_centroid(points):
    x, y = points.T
    x2, y2 = numpy.roll(x, -1), numpy.roll(y, -1)
    w = x * y2 - x2 * y
    area = w.sum() / 2
    centroid = numpy.array([((x + x2) * w).sum(), ((y + y2) * w).sum()]) / (6 * area)
    return abs(area), centroid
