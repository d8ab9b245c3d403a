#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The seeds of fuzz_label: a small map in every format, after a byte that names the format.

usage: make_label_seeds.py tests/fuzz/seeds/label
"""
import bz2
import gzip
import pathlib
import struct
import sys
import tempfile
import zlib

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "offline"))
import dicom_files as dicom

NRRD, NIFTI, NIFTI_GZ, META, INR, INR_GZ, DICOM, SERIES = range(8)
SIZE = (4, 3, 2)  # columns, rows, slices
PREAMBLE = 132  # what the target writes itself


def voxels():
    return numpy.random.default_rng(1).integers(0, 3, SIZE[::-1])


def nrrd(text="", layers=1, encoding="raw"):
    sizes = " ".join(map(str, SIZE))
    layered = f"{layers} " if layers > 1 else ""
    data = numpy.repeat(voxels().astype(numpy.uint8).ravel(), layers).tobytes()
    pack = {"raw": bytes, "gzip": gzip.compress, "bzip2": bz2.compress,
            "hex": lambda raw: raw.hex().encode(),
            "ascii": lambda raw: " ".join(map(str, raw)).encode()}[encoding]
    return (f"NRRD0004\ntype: uchar\ndimension: {3 + (layers > 1)}\nspace: "
            f"left-posterior-superior\nsizes: {layered}{sizes}\nspace directions: "
            f"{'none ' if layers > 1 else ''}(0.8,0.6,0) (-1.2,1.6,0) (0,0,3)\n"
            f"{'kinds: list domain domain domain' + chr(10) if layers > 1 else ''}"
            f"space origin: (-4,2,11)\nencoding: {encoding}\n{text}\n").encode() + pack(data)


def layers_last():
    """Layers on the last axis, a line and a byte to skip."""
    data = numpy.repeat(voxels().astype(numpy.uint8)[None], 2, axis=0).tobytes()
    return (f"NRRD0004\ntype: uchar\ndimension: 4\nsizes: {' '.join(map(str, SIZE))} 2\n"
            f"spacings: 1 2 3 nan\nkinds: domain domain domain list\nencoding: bzip2\n"
            f"line skip: 1\nbyte skip: 1\n{SEGMENTS}\na line\n").encode() + \
        bz2.compress(b"x" + data)


SEGMENTS = ("Segment0_ID:=a\nSegment0_Name:=Liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
            "Segment1_Name:=Portal vein\nSegment1_LabelValue:=2\nSegment1_Layer:=1\n")
TABLE = (b"<CaretExtension><LabelTable><Label Key='1'>liver</Label><Label Key='2'>aorta</Label>"
         b"</LabelTable></CaretExtension>")


def nifti(two=False):
    head = bytearray(540 if two else 348)
    text = TABLE + b"\0" * (-len(TABLE) % 16)
    extension = b"\1\0\0\0" + struct.pack("<ii", len(text) + 8, 30) + text
    at = len(head) + len(extension)
    dim, pixdim = (3, *SIZE, 1, 1, 1, 1), (1, 1.5, 2, 3, 0, 0, 0, 0)
    srow = (1.5, 0, 0, -4, 0, 2, 0, 7, 0, 0, 3, 11)
    if two:
        struct.pack_into("<i8s", head, 0, 540, b"n+2\0\r\n\032\n")
        struct.pack_into("<hh", head, 12, 2, 8)
        struct.pack_into("<8q", head, 16, *dim)
        struct.pack_into("<8dq", head, 104, *pixdim, at)
        struct.pack_into("<dd", head, 176, 1, 0)
        struct.pack_into("<ii", head, 344, 0, 1)
        struct.pack_into("<12d", head, 400, *srow)
        struct.pack_into("<i", head, 500, 2)
    else:
        struct.pack_into("<i", head, 0, 348)
        struct.pack_into("<8h", head, 40, *dim)
        struct.pack_into("<hh", head, 70, 2, 8)
        struct.pack_into("<8f", head, 76, *pixdim)
        struct.pack_into("<fff", head, 108, at, 1, 0)
        head[123] = 2
        struct.pack_into("<hh", head, 252, 1, 1)
        struct.pack_into("<6f", head, 256, 0, 0, 0, -4, 7, 11)
        struct.pack_into("<12f", head, 280, *srow)
        head[344:348] = b"n+1\0"
    return bytes(head) + extension + voxels().astype(numpy.uint8).tobytes()


def meta(packed=False):
    data = voxels().astype("<u2").tobytes()
    if packed:
        data = zlib.compress(data)
    return (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = {packed}\n"
            + (f"CompressedDataSize = {len(data)}\n" if packed else "") +
            f"TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -4 2 11\nElementSpacing = 1.5 2 3\n"
            f"DimSize = {' '.join(map(str, SIZE))}\nElementType = MET_USHORT\n"
            f"ElementDataFile = LOCAL\n").encode() + data


def inr():
    head = (f"#INRIMAGE-4#{{\nXDIM={SIZE[0]}\nYDIM={SIZE[1]}\nZDIM={SIZE[2]}\nVDIM=1\n"
            f"TYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\nVX=1.5\nVY=2\nVZ=3\n")
    return (head + "\n" * (252 - len(head)) + "##}\n").encode() + \
        voxels().astype(numpy.uint8).tobytes()


def slices():
    turned = dicom.turned(numpy.random.default_rng(2))
    return [dicom.Slice(numpy.array([-4, 2, 11]) + 3 * i * turned[2], turned[0], turned[1],
                        (2, 1.5), 3, voxels()[i]) for i in range(SIZE[2])]


def dicom_seeds(folder):
    random = numpy.random.default_rng(3)
    series = dicom.write_slices(folder / "series", slices(), random)
    first, second = (path.read_bytes()[PREAMBLE:] for path in sorted(series.iterdir()))
    yield "series", SERIES, struct.pack("<H", len(first)) + first + second
    packed = dicom.write_slices(folder / "rle", slices(), random, syntax=dicom.RLELossless)
    first, second = (path.read_bytes()[PREAMBLE:] for path in sorted(packed.iterdir()))
    yield "series-rle", SERIES, struct.pack("<H", len(first)) + first + second
    frames = [dicom.Slice(s.at, s.row, s.column, s.spacing, s.thickness,
                          (s.pixels == n).astype(int), n) for n in (1, 2) for s in slices()]
    names = {1: "Liver", 2: "Lesion"}
    for kind in ("BINARY", "FRACTIONAL"):
        path = dicom.write_seg(folder / "seg.dcm", frames, names, kind=kind)
        yield f"seg-{kind.lower()}", DICOM, path.read_bytes()[PREAMBLE:]
    path = dicom.write_enhanced(folder / "all.dcm", slices(), random)
    yield "enhanced", DICOM, path.read_bytes()[PREAMBLE:]
    outline = numpy.array([[0, 0], [9, 0], [9, 7], [4, 3], [0, 7]])
    contours = [s.at + outline @ numpy.stack([s.row, s.column]) for s in slices()]
    path = dicom.write_structures(folder / "rt.dcm", [(1, "Liver", contours),
                                                      (2, "Vein", contours[:1])])
    yield "structures", DICOM, path.read_bytes()[PREAMBLE:]


def main():
    out = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        seeds = [("plain.nrrd", NRRD, nrrd(SEGMENTS)), ("layers.nrrd", NRRD, nrrd(SEGMENTS, 2)),
                 ("gzip.nrrd", NRRD, nrrd(encoding="gzip")),
                 ("bzip2.nrrd", NRRD, nrrd(SEGMENTS, 2, "bzip2")),
                 ("skips.nrrd", NRRD, layers_last()), ("hex.nrrd", NRRD, nrrd(encoding="hex")),
                 ("text.nrrd", NRRD, nrrd(encoding="ascii")), ("one.nii", NIFTI, nifti()),
                 ("two.nii", NIFTI, nifti(True)), ("gz.nii", NIFTI_GZ, gzip.compress(nifti())),
                 ("plain.mha", META, meta()), ("packed.mha", META, meta(True)),
                 ("plain.inr", INR, inr()),
                 ("gz.inr", INR_GZ, gzip.compress(inr())), *dicom_seeds(pathlib.Path(folder))]
    for name, kind, data in seeds:
        (out / f"{name}.bin").write_bytes(bytes([kind]) + data)


if __name__ == "__main__":
    main()
