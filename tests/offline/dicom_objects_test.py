#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""DICOM segmentations and structure sets of random geometry, as dicom_conformance_test.py has
series.

usage: dicom_objects_test.py   (STYLET_BIN)
"""
import hashlib
import json
import resource
import subprocess
import unittest

try:
    import numpy
    import dicom_files as dicom
    from dicom_files import Slice, blobs, held, stack, write_seg, write_slices
except ImportError:
    dicom = None

from dicom_conformance_test import NEAR, TOOL, Conformance, ran


def segments(random, slices, numbers, overlap=False):
    """Frames of each segment for the planes in which it has pixels; and what a reader must make of
    them, where the higher number wins."""
    frames, seen = [], []
    shape = (len(slices), *slices[0].pixels.shape)
    won = numpy.zeros(shape, int)
    for number in sorted(numbers):
        mask = blobs(random, shape, [1]) > 0
        if not overlap:
            mask &= won == 0
        won[mask] = number
        frames += [Slice(s.at, s.row, s.column, s.spacing, s.thickness, mask[i].astype(int), number)
                   for i, s in enumerate(slices) if mask[i].any()]
    seen = [Slice(s.at, s.row, s.column, s.spacing, s.thickness, won[i])
            for i, s in enumerate(slices) if won[i].any()]
    return frames, seen


def shuffled(random, frames):
    return [frames[i] for i in random.permutation(len(frames))]


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class Segmentations(Conformance):
    NAMES = {3: "Liver", 4: "Portal vein", 9: "Lesion"}

    def rule(self, slices):
        step = slices[0].thickness
        return {"alone": step, "widest": 1.5 * step}

    def test_several_segments_in_any_order(self):
        def apart(folder, random):
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            facts = self.check(path, held(seen, **self.rule(slices)))
            self.assertEqual([each["name"] for each in facts["labels"]], list(self.NAMES.values()))
            bare = path.rename(folder / "segmentation")
            self.check(bare, held(seen, **self.rule(slices)))

        def overlapping(folder, random):
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES, overlap=True)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            self.check(path, held(seen, **self.rule(slices)), said=["the one with the higher"])

        def named_by_type(folder, random):
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", frames, {n: "" for n in self.NAMES})
            facts = self.check(path, held(seen, **self.rule(slices)))
            self.assertEqual({each["name"] for each in facts["labels"]}, {"Tissue"})

        def fractional(folder, random):
            slices = stack(random)
            frames, _ = segments(random, slices, [3])
            for each in frames:
                each.pixels = random.integers(0, 256, each.pixels.shape) * each.pixels
            path = write_seg(folder / "seg.dcm", frames, self.NAMES, kind="FRACTIONAL")
            for each in frames:
                each.pixels = 3 * (each.pixels >= 127.5)
            self.check(path, held(frames, **self.rule(slices)), said=["a fraction of one half"])

        def told_twice(folder, random):  # for all frames and again for each, with equal values
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES)

            def change(file):
                shared = file.SharedFunctionalGroupsSequence[0]
                for each in file.PerFrameFunctionalGroupsSequence:
                    each.PixelMeasuresSequence = shared.PixelMeasuresSequence
                    each.PlaneOrientationSequence = shared.PlaneOrientationSequence
            path = write_seg(folder / "seg.dcm", frames, self.NAMES, change=change)
            self.check(path, held(seen, **self.rule(slices)))

        self.cases(2, apart, told_twice)
        self.cases(1, overlapping, named_by_type, fractional)

    def test_frames_are_placed_by_their_position(self):
        def holes(folder, random):
            slices = stack(random, distances=[1.9] * 20)
            frames, _ = segments(random, slices, [3])
            kept = [f for i, f in enumerate(frames) if i in (0, 1, len(frames) - 1)]
            for each in kept:
                each.pixels = each.pixels * 3
            path = write_seg(folder / "seg.dcm", shuffled(random, kept), self.NAMES)
            self.check(path, held(kept, **self.rule(slices)), said=["taken as empty"])

        def leaning(folder, random):
            slices = stack(random, lean=random.uniform(-0.4, 0.4, 2))
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            self.check(path, held(seen, **self.rule(slices)), said=["put upright"],
                       within=0.5 * numpy.hypot(*slices[0].spacing))

        def uneven(folder, random):
            slices = stack(random, distances=random.uniform(1.5, 2.6, 26), thickness=[2.0] * 27)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            self.check(path, held(seen, **self.rule(slices)), NEAR, within=1.3,
                       said=["brought into layers"])

        def spaced(folder, random):  # the file says 1.8 mm apart, although 1 mm thick
            slices = stack(random, distances=[1.8] * 20, thickness=[1.0] * 21)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", frames, self.NAMES, apart=1.8)
            self.check(path, held(seen, alone=1.8, widest=2.7))

        def told_by_its_frames(folder, random):  # if nothing else gives it
            slices = stack(random, distances=[2.3] * 20, thickness=[2.3] * 21)
            frames, seen = segments(random, slices, self.NAMES)

            def change(file):
                del file.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SliceThickness

            places = sorted({round(float(s.at @ numpy.cross(s.row, s.column)), 6) for s in seen})
            path = write_seg(folder / "seg.dcm", frames, self.NAMES, change=change)
            if numpy.ptp(numpy.diff(places)) < 0.01:
                self.check(path, held(seen, alone=2.3, widest=3.5))
            some = [f for f in frames if f.segment == 3]
            # Only two slices; then the narrowest gap is the first, one in the middle, the last.
            for picked in ((0, 1), (0, 1, 3, 5), (0, 2, 3, 5), (0, 2, 4, 5)):
                path = write_seg(folder / "some.dcm", [some[i] for i in picked], self.NAMES,
                                 change=change)
                self.refused(path, "neither SpacingBetweenSlices nor SliceThickness",
                             "expected one")

        def thinner_than_apart(folder, random):  # thin, at an unknown distance
            slices = stack(random, distances=[3.0] * 20, thickness=[1.0] * 21)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", frames, self.NAMES, apart=2e6)
            self.check(path, held(seen, alone=3.0, widest=4.5), said=["taken from the nearest"])

        def thin_and_uneven(folder, random):
            distances = random.uniform(1.6, 2.35, 26)
            slices = stack(random, distances=distances, thickness=[random.uniform(0.2, 0.9)] * 27)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            normal = numpy.cross(slices[0].row, slices[0].column)
            ways = numpy.sort(numpy.diff(numpy.unique([round(s.at @ normal, 6) for s in seen])))
            self.check(path, held(seen, alone=ways[(len(ways) - 1) // 2], widest=99), NEAR,
                       within=1.3, said=["taken from the nearest", "brought into layers"])

        def nameless(folder, random):
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES)

            def change(file):
                for segment in file.SegmentSequence:
                    del segment.SegmentLabel
                del file.SegmentSequence[0].SegmentedPropertyTypeCodeSequence

            path = write_seg(folder / "seg.dcm", frames, self.NAMES, change=change)
            facts = self.check(path, held(seen, **self.rule(slices)))
            self.assertEqual([each.get("name", "") for each in facts["labels"]],
                             ["", "Tissue", "Tissue"])

        def uneven_with_a_hole(folder, random):
            distances = random.uniform(1.5, 2.6, 26)
            distances[random.integers(8, 18)] = 9.3
            slices = stack(random, distances=distances, thickness=[2.0] * 27)
            frames, seen = segments(random, slices, self.NAMES)
            path = write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            self.check(path, held(seen, **self.rule(slices)), NEAR, within=1.3,
                       said=["brought into layers"])

        self.cases(1, holes, spaced, told_by_its_frames, thinner_than_apart, nameless)
        self.cases(2, leaning, uneven, uneven_with_a_hole, thin_and_uneven)

    def test_pixels_that_are_numbers_of_segments(self):
        def with_all_planes(folder, random):
            numbers = random.choice(numpy.arange(1, 250), 3, replace=False)
            slices = stack(random, labels=numbers)
            names = {int(n): f"tissue {n}" for n in numbers}
            kept = [s for s in slices if s.pixels.any()]
            path = dicom.write_label_map(folder / "map.dcm", shuffled(random, kept), names)
            facts = self.check(path, held(kept, **self.rule(slices)))
            self.assertEqual({each["label"]: each["name"] for each in facts["labels"]}, names)
            self.check(folder, held(kept, **self.rule(slices)))

        def with_wide_numbers(folder, random):
            numbers = random.choice(numpy.arange(300, 60000), 3, replace=False)
            slices = stack(random, labels=numbers)
            kept = [s for s in slices if s.pixels.any()]
            path = dicom.write_label_map(folder / "map", kept, {}, bits=16, background=65535)
            self.check(path, held(kept, **self.rule(slices)))

        def with_no_word_of_a_background(folder, random):
            """Without PixelPaddingValue every pixel belongs to a segment, unless segment 0 is the
            background or is not described at all."""
            def written(described):
                def change(file):
                    del file.PixelPaddingValue
                    del file.SegmentSequence[0]
                    if described is not None:
                        file.SegmentSequence.insert(0, described)
                return dicom.write_label_map(folder / "map", kept, names, change=change)

            def segment_0(label, scheme, value):
                return dicom.item(
                    SegmentNumber=0, SegmentLabel=label,
                    SegmentedPropertyTypeCodeSequence=dicom.one(
                        CodeValue=value, CodingSchemeDesignator=scheme, CodeMeaning=label))
            kept = [s for s in stack(random) if s.pixels.any()]
            empty = sum(int((s.pixels == 0).sum()) for s in kept)
            names = {int(n): f"tissue {n}" for s in kept for n in numpy.unique(s.pixels) if n > 0}
            for described in (None, segment_0("Nothing", "DCM", "125040")):
                self.check(written(described), held(kept, **self.rule(kept)),
                           said=[f"no PixelPaddingValue: its {empty} pixels of 0 were taken as"])
            for scheme, value in (("SCT", "85756007"), ("SCT", "125040"), ("DCM", "125041")):
                self.refused(written(segment_0("Muscle", scheme, value)),
                             "no PixelPaddingValue, and segment 0 is Muscle: expected")

        def with_a_segment_in_every_pixel(folder, random):  # in which no pixel is background
            def change(file):
                del file.PixelPaddingValue
                del file.SegmentSequence[0]
            slices = stack(random)
            for each in slices:
                each.pixels = each.pixels + 1
            path = dicom.write_label_map(folder / "map", slices, {}, change=change)
            self.check(path, held(slices, **self.rule(slices)))

        def with_a_plane_twice(folder, random):
            slices = stack(random)
            path = dicom.write_label_map(folder / "map", slices + [slices[5]], {})
            self.refused(path, f"frame {len(slices)}: there is this plane in frame 5 already")

        def with_a_segment_0(folder, random):
            def change(file):
                file.PixelPaddingValue = 255
                del file.SegmentSequence[0]
            path = dicom.write_label_map(folder / "map", stack(random), {}, change=change)
            self.refused(path, "expected segments from 1 on")

        self.cases(3, with_all_planes, with_wide_numbers)
        self.cases(1, with_no_word_of_a_background, with_a_segment_in_every_pixel,
                   with_a_plane_twice, with_a_segment_0)

    def test_contradictions_are_refused(self):
        def written(folder, random, spoil, *said, change=None, apart=None):
            slices = stack(random, distances=[2.0] * 18)
            frames, _ = segments(random, slices, self.NAMES)
            spoil(frames)
            self.refused(write_seg(folder / "seg.dcm", frames, self.NAMES, change=change,
                                   apart=apart), *said)

        def aside(folder, random):
            def spoil(frames):
                frames[4].at = frames[4].at + 6 * frames[4].row
            written(folder, random, spoil, "frame 4", "to the side")

        def twice(folder, random):
            written(folder, random, lambda frames: frames.append(frames[4]), "already")

        def far(folder, random):
            written(folder, random, lambda frames: None, "from the plane before", apart=5)

        def undescribed(folder, random):
            def change(file):
                file.PerFrameFunctionalGroupsSequence[5].SegmentIdentificationSequence[
                    0].ReferencedSegmentNumber = 6
            written(folder, random, lambda frames: None,
                    "frame 5: ReferencedSegmentNumber 6: expected the number of a segment",
                    change=change)

        def named_twice(folder, random):
            def change(file):
                file.SegmentSequence[1].SegmentNumber = file.SegmentSequence[0].SegmentNumber
            written(folder, random, lambda frames: None,
                    "label 3 is called Liver and Portal vein: expected one name", change=change)

        def two_places(folder, random):  # a functional group for all frames and for one of them
            frame = int(random.integers(0, 12))
            factor = float(random.choice([0.5, 0.999, 1.001, 2]))

            def set_in(file, group, name, values):
                groups = file.PerFrameFunctionalGroupsSequence[frame]
                setattr(groups, group, dicom.one(**{name: values}))

            def measures(file):
                shared = file.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0]
                set_in(file, "PixelMeasuresSequence", "PixelSpacing",
                       dicom.texts([shared.PixelSpacing[0], shared.PixelSpacing[1] * factor]))

            def thickness(file):
                measures = file.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0]
                set_in(file, "PixelMeasuresSequence", "SliceThickness",
                       dicom.texts([measures.SliceThickness * factor])[0])

            def orientation(file):
                shared = file.SharedFunctionalGroupsSequence[0].PlaneOrientationSequence[0]
                turned = numpy.array(shared.ImageOrientationPatient, float)
                set_in(file, "PlaneOrientationSequence", "ImageOrientationPatient",
                       dicom.texts(-turned))

            for change, name in ((measures, "PixelSpacing"), (thickness, "SliceThickness"),
                                 (orientation, "ImageOrientationPatient")):
                written(folder, random, lambda frames: None, f"frame {frame}: {name} ",
                        " for this frame, but ", "expected it in one place", change=change)

        def two_items(folder, random):  # of a functional group, which may have only one
            frame = int(random.integers(0, 12))

            def change(file):
                group = file.PerFrameFunctionalGroupsSequence[frame].PlanePositionSequence
                group.append(group[0])
            written(folder, random, lambda frames: None,
                    f"frame {frame}: 2 items in PlanePositionSequence: expected one", change=change)

        def no_item(folder, random):
            def change(file):
                file.PerFrameFunctionalGroupsSequence[3].PlanePositionSequence = dicom.Sequence([])
            written(folder, random, lambda frames: None, "frame 3: ImagePositionPatient nan",
                    change=change)

        def fewer(folder, random):
            def change(file):
                file.NumberOfFrames += 1
            written(folder, random, lambda frames: None, "functional groups", change=change)

        def no_segment(folder, random):
            def change(file):
                del file.PerFrameFunctionalGroupsSequence[2].SegmentIdentificationSequence
            written(folder, random, lambda frames: None, "frame 2", "ReferencedSegmentNumber",
                    change=change)

        def unknown_kind(folder, random):
            def change(file):
                file.SegmentationType = "OTHER"
            written(folder, random, lambda frames: None, "SegmentationType OTHER", change=change)

        def short(folder, random):
            def change(file):
                file.PixelData = file.PixelData[:-20]
            written(folder, random, lambda frames: None, "bytes of pixels", change=change)

        def far_segment(folder, random):
            def change(file):
                group = file.PerFrameFunctionalGroupsSequence[1]
                group.SegmentIdentificationSequence[0].ReferencedSegmentNumber = 0
            written(folder, random, lambda frames: None, "ReferencedSegmentNumber 0", change=change)

        def segments_beyond_all_labels(folder, random):  # as numbers of 32 bits
            def frame(file):
                group = file.PerFrameFunctionalGroupsSequence[1].SegmentIdentificationSequence[0]
                del group.ReferencedSegmentNumber
                group.add_new(0x0062000B, "SL", 70000)
            written(folder, random, lambda frames: None, "ReferencedSegmentNumber 70000",
                    change=frame)

            def name(file):
                del file.SegmentSequence[1].SegmentNumber
                file.SegmentSequence[1].add_new(0x00620004, "SL", 70000)
            written(folder, random, lambda frames: None, "SegmentNumber 70000: expected 1 to",
                    change=name)

        def no_rows(folder, random):
            def change(file):
                file.Rows = 0
            written(folder, random, lambda frames: None, "0 voxels along an axis", change=change)

        def segment_0(folder, random):
            def change(file):
                file.SegmentSequence[1].SegmentNumber = 0
            written(folder, random, lambda frames: None, "SegmentNumber 0: expected 1 to",
                    change=change)

        def fraction_of_what(folder, random):
            for most in (0, 256):
                def change(file):
                    file.SegmentationType, file.MaximumFractionalValue = "FRACTIONAL", most
                written(folder, random, lambda frames: None, f"MaximumFractionalValue {most}",
                        change=change)

        self.cases(2, two_places, two_items)
        self.cases(1, no_item)
        self.cases(1, aside, twice, named_twice, undescribed, far, fewer, no_segment, unknown_kind,
                   short, far_segment, segments_beyond_all_labels, no_rows, segment_0,
                   fraction_of_what)

    def test_a_segmentation_alone_in_a_folder_is_the_map(self):
        def alone(folder, random):
            slices = stack(random)
            frames, seen = segments(random, slices, self.NAMES)
            write_seg(folder / "seg.dcm", shuffled(random, frames), self.NAMES)
            self.check(folder, held(seen, **self.rule(slices)))

        def beside_its_series(folder, random):
            slices = stack(random)
            frames, _ = segments(random, slices, self.NAMES)
            write_slices(folder, slices, random)
            write_seg(folder / "seg.dcm", frames, self.NAMES)
            self.refused(folder, f"1 segmentations (SEG), {len(slices)} images", "give its file",
                         "seg.dcm")

        def two(folder, random):
            frames, _ = segments(random, stack(random), self.NAMES)
            for name in ("a", "b"):
                write_seg(folder / name, frames, self.NAMES)
            self.refused(folder, "2 segmentations (SEG)", "give its file")

        self.cases(1, alone, beside_its_series, two)

    def test_memory_and_time_are_bounded_by_the_bytes(self):
        def bounded(path, *said):
            done = subprocess.run(
                [TOOL, "labels", path, "--json"], capture_output=True, text=True, timeout=20,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20)))
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for words in said:
                self.assertIn(words, done.stderr)

        def frames_that_are_not_there(folder, random):
            slices = stack(random)
            frames, _ = segments(random, slices, [3])
            for number in 10 ** 7, 2 ** 28 - 1:
                def change(file):
                    file.NumberOfFrames, file.Rows, file.Columns = number, 1, 1
                    shared = file.SharedFunctionalGroupsSequence[0]
                    own = file.PerFrameFunctionalGroupsSequence[0]
                    shared.PlanePositionSequence = own.PlanePositionSequence
                    shared.SegmentIdentificationSequence = own.SegmentIdentificationSequence
                    file.PixelData = b"\1\0"
                    del file.PerFrameFunctionalGroupsSequence
                path = write_seg(folder / "seg.dcm", frames[:1], {3: "Lesion"}, change=change)
                bounded(path, "bytes are there")

                def image(file):
                    change(file)
                    file.SOPClassUID = "1.2.840.10008.5.1.4.1.1.2.1"
                path = write_seg(folder / "image.dcm", frames[:1], {3: "Lesion"}, change=image)
                bounded(path, "bytes are there")

        def planes_far_apart(folder, random):
            for apart, pixels in (0.01, 36), (1e-3, 1), (0.5, 600):
                first = stack(random)[0]
                first.pixels = numpy.ones((pixels, pixels), int)
                far = Slice(first.at + 2000 * numpy.cross(first.row, first.column), first.row,
                            first.column, first.spacing, first.thickness, first.pixels, 3)
                near = Slice(first.at, first.row, first.column, first.spacing, first.thickness,
                             first.pixels, 3)
                path = write_seg(folder / "seg.dcm", [near, far], {3: "Lesion"}, apart=apart)
                bounded(path, "layers: expected at most")

        self.cases(1, frames_that_are_not_there, planes_far_apart)


class Drawn:
    """Outlines in parallel planes, and what they enclose: volume and centroid from those of the
    polygons."""

    def __init__(self, random, frame=None, planes=14):
        self.frame = dicom.turned(random) if frame is None else frame
        self.origin, self.step = random.uniform(-100, 100, 3), random.uniform(1.5, 3.5)
        self.planes, self.random = planes, random

    def outlines(self, radius, middle):
        """One outline in each plane, of a body that is round along the normal, too."""
        along = (numpy.arange(self.planes) + 0.5) / self.planes * 2 - 1
        return [dicom.polygon(self.random, radius * (0.6 + 0.4 * numpy.sqrt(1 - a * a)), middle)
                for a in along]

    def placed(self, points, plane):
        at = self.origin + self.frame[2] * self.step * plane
        return at + points @ self.frame[:2]

    def contours(self, outlines):
        return [self.placed(points, i) for i, points in enumerate(outlines)]

    def held(self, outlines, holes=()):
        ml, moment = 0, 0
        for i, points in enumerate(outlines):
            for outline, sign in ((points, 1), *((hole[i], -1) for hole in holes)):
                area, centroid = dicom.area_and_centroid(outline)
                volume = sign * area * self.step * 1e-3
                ml += volume
                moment = moment + volume * self.placed(centroid, i)
        return 0, ml, moment / ml


@unittest.skipIf(dicom is None, "pydicom is not installed: apt-get install python3-pydicom")
class StructureSets(Conformance):
    def test_outlines_become_labels(self):
        def oblique(folder, random):
            drawn = Drawn(random)
            liver, lesion = drawn.outlines(28, (0, 0)), drawn.outlines(16, (60, 20))
            structures = [(7, "Liver", shuffled(random, drawn.contours(liver))),
                          (3, "Lesion 1", shuffled(random, drawn.contours(lesion)))]
            path = dicom.write_structures(folder / "rt.dcm", structures)
            facts = self.check(path, {7: drawn.held(liver), 3: drawn.held(lesion)}, NEAR)
            self.assertEqual([each["name"] for each in facts["labels"]], ["Lesion 1", "Liver"])

        def axial(folder, random):
            drawn = Drawn(random, frame=numpy.eye(3))
            liver = drawn.outlines(25, (3, 4))
            path = dicom.write_structures(folder / "rt", [(1, "Liver", drawn.contours(liver))])
            self.check(path, {1: drawn.held(liver)}, NEAR)

        def sagittal_and_coronal(folder, random):  # clockwise or not
            for turn in ((1, 2, 0), (2, 0, 1), (2, 1, 0), (0, 2, 1)):
                drawn = Drawn(random, frame=numpy.eye(3)[list(turn)])
                liver = drawn.outlines(25, (3, 4))
                path = dicom.write_structures(folder / "rt", [(1, "Liver", drawn.contours(liver))])
                self.check(path, {1: drawn.held(liver)}, NEAR)

        def wide(folder, random):  # more pixels across than the grid has at first
            drawn = Drawn(random)
            body = drawn.outlines(600, (0, 0))
            path = dicom.write_structures(folder / "rt", [(1, "Body", drawn.contours(body))])
            self.check(path, {1: drawn.held(body)}, NEAR, within=2)

        def exclusive(folder, random):  # outer and inner by exclusive or
            drawn = Drawn(random)
            outer, inner = drawn.outlines(30, (0, 0)), drawn.outlines(14, (2, -1))
            both = drawn.contours(outer) + drawn.contours(inner)
            path = dicom.write_structures(folder / "rt.dcm", [(1, "Wall", both)],
                                          kind="CLOSEDPLANAR_XOR")
            self.check(path, {1: drawn.held(outer, [inner])}, NEAR)

        def of_many_points(folder, random):  # 64 kB and more, for which there is no VR
            drawn = Drawn(random, planes=4)
            way = numpy.linspace(0, 1, 60, endpoint=False)[:, None]
            liver = [numpy.concatenate([a + way * (b - a) for a, b in zip(p, numpy.roll(p, -1, 0))])
                     for p in drawn.outlines(28, (0, 0))]
            path = dicom.write_structures(folder / "rt.dcm", [(7, "x", drawn.contours(liver))])
            self.check(path, {7: drawn.held(liver)}, NEAR)

        def holes(folder, random):
            drawn = Drawn(random)
            outer, inner = drawn.outlines(30, (0, 0)), drawn.outlines(14, (2, -1))
            both = drawn.contours(outer) + drawn.contours(inner)
            path = dicom.write_structures(folder / "rt.dcm",
                                          [(1, "Wall", shuffled(random, both))])
            self.check(path, {1: drawn.held(outer, [inner])}, NEAR)

        def repeated(folder, random):  # with exclusive or they would cancel themselves
            drawn = Drawn(random)
            liver = drawn.outlines(30, (0, 0))
            contours = drawn.contours(liver)
            path = dicom.write_structures(folder / "rt.dcm", [
                (1, "Liver", shuffled(random, contours + contours[2:5] + contours[3:4]))])
            self.check(path, {1: drawn.held(liver)}, NEAR,
                       said=["Liver: 4 contours are there twice: each was taken once"])

        def lying_on_another(folder, random):  # another first point, backwards, rounded, closed
            drawn = Drawn(random)
            liver = drawn.outlines(30, (0, 0))
            contours = drawn.contours(liver)
            again = [numpy.roll(points, int(random.integers(1, len(points))), 0)
                     for points in contours[2:6]]
            again[1] = again[1][::-1]
            again[2] = again[2] + random.uniform(-3e-3, 3e-3, again[2].shape)
            again[3] = numpy.concatenate([again[3], again[3][:1]])
            path = dicom.write_structures(folder / "rt.dcm", [
                (1, "Liver", shuffled(random, contours + again))])
            self.check(path, {1: drawn.held(liver)}, NEAR,
                       said=["Liver: 4 contours are there twice: each was taken once"])

        def mirrored(folder, random):  # the same area and middle, but another outline
            drawn = Drawn(random, frame=numpy.eye(3))
            one = numpy.array([[0, 0], [20, 0], [20, 12], [30, 12], [30, 20], [10, 20], [10, 8],
                               [0, 8]], float)
            box = lambda a, b, c, d: numpy.array([[a, c], [b, c], [b, d], [a, d]], float)
            count = drawn.planes
            contours = drawn.contours([one] * count) + drawn.contours(
                [one * [-1, 1] + [30, 0]] * count)
            path = dicom.write_structures(folder / "rt.dcm", [(1, "Z", contours)])
            both = [[box(10, 20, 0, 20)] * count, [box(0, 10, 8, 12)] * count,
                    [box(20, 30, 8, 12)] * count]
            # Edges along pixels of 0.5 mm: each may be off by half a pixel.
            self.check(path, {1: drawn.held([box(0, 30, 0, 20)] * count, both)}, NEAR, within=0.36)

        def rods(folder, random):  # in a pattern, with many edges at the same place along a line
            drawn = Drawn(random, planes=20)
            way = numpy.linspace(0, 2 * numpy.pi, 12, endpoint=False)
            circle = 1.2 * numpy.stack([numpy.cos(way), numpy.sin(way)], 1)
            single = [points for i in range(12) for j in range(12)
                      for points in drawn.contours([circle + [3 * i, 4 * j]] * drawn.planes)]
            again = [points[::-1] + random.uniform(-1e-3, 1e-3, points.shape)
                     for points in single]
            seen = []
            for name, contours in (("single", single), ("twice", shuffled(random, single + again))):
                path = dicom.write_structures(folder / f"{name}.dcm", [(1, "Rods", contours)])
                seen.append(json.loads(ran(path).stdout))
            self.assertIn(f"{len(single)} contours are there twice", seen[1]["notes"][0])
            volumes = [facts["labels"][0]["volume_ml"] for facts in seen]
            self.assertAlmostEqual(volumes[1] / volumes[0], 1, delta=0.01)

        def two_of_the_same_kind(folder, random):  # halves of a square, one in another
            drawn = Drawn(random)
            corner = numpy.array([[-20, -20], [20, -20], [20, 20], [-20, 20]], float)
            halves = [corner[[0, 1, 2]], corner[[0, 2, 3]]]
            count = len(drawn.outlines(30, (0, 0)))
            contours = [c for half in halves for c in drawn.contours([half] * count)]
            path = dicom.write_structures(folder / "rt.dcm", [(1, "Box", contours)])
            self.check(path, {1: drawn.held([corner] * count)}, NEAR)
            inner = numpy.array([[0, -20], [20, 0], [0, 20], [-20, 0]], float)
            contours = drawn.contours([corner] * count) + drawn.contours([inner] * count)
            path = dicom.write_structures(folder / "rt.dcm", [(1, "Frame", contours)])
            self.check(path, {1: drawn.held([corner] * count, [[inner] * count])}, NEAR)

        def keyholes(folder, random):
            drawn = Drawn(random)
            outer, inner = drawn.outlines(30, (0, 0)), drawn.outlines(14, (2, -1))
            joined = [numpy.concatenate([a, a[:1], b[:1], b[::-1]]) for a, b in zip(outer, inner)]
            path = dicom.write_structures(folder / "rt.dcm",
                                          [(1, "Wall", drawn.contours(joined))])
            self.check(path, {1: drawn.held(outer, [inner])}, NEAR)

        def inside(folder, random):
            drawn = Drawn(random)
            body, liver = drawn.outlines(50, (0, 0)), drawn.outlines(24, (8, 5))
            structures = [(1, "Liver", drawn.contours(liver)), (2, "Body", drawn.contours(body))]
            path = dicom.write_structures(folder / "rt.dcm", structures)
            self.check(path, {1: drawn.held(liver), 2: drawn.held(body, [liver])}, NEAR,
                       said=["each was given to the smallest of them"])

        self.cases(3, oblique)
        self.cases(1, axial, of_many_points, holes, repeated, lying_on_another, mirrored, rods,
                   two_of_the_same_kind, keyholes, inside,
                   sagittal_and_coronal, wide, exclusive)

    def on_series(self, folder, random, planes=14, change=None):
        """A series, and outlines on its slices."""
        slices = stack(random, distances=[float(random.uniform(1.5, 3.0))] * 17)
        drawn = Drawn(random, numpy.stack([slices[0].row, slices[0].column,
                                           numpy.cross(slices[0].row, slices[0].column)]), planes)
        drawn.origin, drawn.step = slices[2].at, (slices[1].at - slices[0].at) @ drawn.frame[2]
        write_slices(folder, slices, random, change=change)
        return drawn

    def test_outlines_lie_on_their_series(self):
        def series(folder, random):
            drawn = self.on_series(folder, random)
            liver = drawn.outlines(24, (25, 30))
            path = dicom.write_structures(folder / "rt.dcm",
                                          [(5, "Liver", drawn.contours(liver))])
            self.check(folder, {5: drawn.held(liver)}, NEAR, within=0.2)
            (self.folder / "r.toml").write_text("[tissues]\nliver = [5]\n")
            done = subprocess.run([TOOL, "build", folder, "--recipe", self.folder / "r.toml",
                                   "--voxel-mm", "8", "-o", self.folder / "a.organ", "--json"],
                                  capture_output=True, text=True, timeout=60, check=True)
            source = json.loads(done.stdout)["organ"]["provenance"]["sources"][0]
            self.assertEqual(source["sha256"], hashlib.sha256(path.read_bytes()).hexdigest())

        def closer_than_slices(folder, random):
            drawn = self.on_series(folder, random)
            drawn.step /= random.choice([2, 3, 1.7])
            liver = drawn.outlines(24, (25, 30))
            dicom.write_structures(folder / "rt.dcm", [(5, "Liver", drawn.contours(liver))])
            self.check(folder, {5: drawn.held(liver)}, NEAR, within=0.2)

        def one_plane(folder, random):
            drawn = self.on_series(folder, random, planes=1)
            lesion = drawn.outlines(24, (25, 30))
            path = dicom.write_structures(folder / "rt.dcm", [(5, "x", drawn.contours(lesion))])
            self.check(folder, {5: drawn.held(lesion)}, NEAR, within=0.3)
            self.refused(path, "contours in 1 plane", "expected several")

        def elsewhere(folder, random):
            drawn = self.on_series(folder, random)
            contours = drawn.contours(drawn.outlines(20, (0, 0)))
            dicom.write_structures(folder / "rt.dcm", [(5, "x", contours)], frame="1.2.9")
            self.refused(folder, "ReferencedFrameOfReferenceUID 1.2.9")

        def of_no_frame(folder, random):  # without a frame of reference, but the only series
            drawn = self.on_series(folder, random)
            liver = drawn.outlines(24, (25, 30))
            dicom.write_structures(folder / "rt.dcm", [(5, "x", drawn.contours(liver))], frame="")
            self.check(folder, {5: drawn.held(liver)}, NEAR, within=0.2)

        def on_one_slice(folder, random):  # a slice that gives its thickness
            one = stack(random)[9:10]
            drawn = Drawn(random, numpy.stack([one[0].row, one[0].column,
                                               numpy.cross(one[0].row, one[0].column)]), planes=1)
            drawn.origin, drawn.step = one[0].at, one[0].thickness
            write_slices(folder, one, random)
            liver = drawn.outlines(24, (25, 30))
            dicom.write_structures(folder / "rt.dcm", [(5, "x", drawn.contours(liver))])
            self.check(folder, {5: drawn.held(liver)}, NEAR, within=0.3)

        def on_a_series_of_no_frame(folder, random):
            def change(file, number):
                del file.FrameOfReferenceUID
            drawn = self.on_series(folder, random, change=change)
            liver = drawn.outlines(24, (25, 30))
            dicom.write_structures(folder / "rt.dcm", [(5, "x", drawn.contours(liver))])
            self.check(folder, {5: drawn.held(liver)}, NEAR, within=0.2)

        def points_alone(folder, random):
            drawn = self.on_series(folder, random)
            dicom.write_structures(folder / "rt.dcm",
                                   [(5, "x", drawn.contours(drawn.outlines(20, (0, 0))))],
                                   kind="POINT")
            self.refused(folder, "expected closed contours in planes")

        def far_beyond_it(folder, random):
            drawn = self.on_series(folder, random)
            dicom.write_structures(folder / "rt.dcm",
                                   [(5, "x", drawn.contours(drawn.outlines(9000, (0, 0))))])
            self.refused(folder, "pixels: expected at most 4096")

        def two_sets(folder, random):
            drawn = self.on_series(folder, random)
            contours = drawn.contours(drawn.outlines(20, (0, 0)))
            for name in "ab":
                dicom.write_structures(folder / f"{name}.dcm", [(5, "x", contours)])
            self.refused(folder, "2 structure sets: expected one")

        self.cases(2, series)
        self.cases(3, closer_than_slices)
        self.cases(1, one_plane, elsewhere, of_no_frame, on_one_slice, on_a_series_of_no_frame,
                   points_alone, far_beyond_it, two_sets)

    def drawn_apart(self, drawn, distances, middle):
        """Contours at distances of their own, starting at a random place, and what they enclose:
        each is as thick as half of the way to its neighbours of the same structure."""
        along = numpy.concatenate([[0], numpy.cumsum(distances)]) + drawn.random.uniform(0, 4)
        ways = numpy.concatenate([distances[:1], distances, distances[-1:]])
        drawn.planes, drawn.step = len(along), 1
        contours, ml, moment = [], 0, 0
        for i, points in enumerate(drawn.outlines(22, middle)):
            contours.append(drawn.placed(points, along[i]))
            area, centroid = dicom.area_and_centroid(points)
            volume = area * (ways[i] + ways[i + 1]) / 2 * 1e-3
            ml += volume
            moment = moment + volume * drawn.placed(centroid,
                                                    along[i] + (ways[i + 1] - ways[i]) / 4)
        return contours, (0, ml, moment / ml)

    def test_each_structure_is_as_thick_as_it_was_drawn(self):
        def together(folder, random, distances):
            drawn, structures, expected = Drawn(random), [], {}
            for i, ways in enumerate(distances):
                contours, expected[i + 1] = self.drawn_apart(drawn, ways, (60 * i, 0))
                structures.append((i + 1, f"s{i}", contours))
            path = dicom.write_structures(folder / "rt.dcm", shuffled(random, structures))
            self.check(path, expected, NEAR, within=0.6)

        def of_different_distances(folder, random):
            together(folder, random, [numpy.full(14, d) for d in random.uniform(1, 5, 3)])

        def beside_each_other(folder, random):
            together(folder, random, [numpy.full(14, random.uniform(2, 4))] * 2)

        def finer_in_the_middle(folder, random):
            together(folder, random, [numpy.repeat([5, random.uniform(2, 3), 4.5], 5)])

        def much_finer_in_the_middle(folder, random):
            together(folder, random, [numpy.repeat([5, random.uniform(1.5, 2), 4.5], [4, 9, 4])])

        def at_uneven_places(folder, random):
            together(folder, random, [random.uniform(2.4, 3.4, 14) for _ in range(2)])

        def in_one_plane(folder, random):  # as thick as those of structures with several planes
            drawn, usual = Drawn(random), random.uniform(2.5, 3.5)
            several, expected = self.drawn_apart(drawn, numpy.full(14, usual), (0, 0))
            two, of_two = self.drawn_apart(drawn, numpy.array([usual / 2]), (60, 0))
            drawn.planes, place = 1, random.uniform(0, 10)
            one = drawn.outlines(22, (120, 0))[0]
            area, centroid = dicom.area_and_centroid(one)
            of_one = 0, area * usual * 1e-3, drawn.placed(centroid, place)
            path = dicom.write_structures(
                folder / "rt.dcm", [(1, "a", several), (2, "b", two),
                                    (3, "c", [drawn.placed(one, place)])])
            self.check(path, {1: expected, 2: of_two, 3: of_one}, NEAR, within=0.6)

        self.cases(2, of_different_distances, beside_each_other, finer_in_the_middle,
                   much_finer_in_the_middle, at_uneven_places, in_one_plane)

    def test_structures_that_are_left_out_are_reported(self):
        def drawn_here_and_there(folder, random):
            drawn = Drawn(random)
            liver, sparse = drawn.outlines(24, (0, 0)), drawn.outlines(20, (60, 0))
            kept = drawn.contours(sparse)[:6:5]
            path = dicom.write_structures(
                folder / "rt.dcm", [(1, "Liver", drawn.contours(liver)), (2, "Vein", kept)])
            one = drawn.held(sparse)[1]
            facts = json.loads(ran(path).stdout)
            self.assertTrue(any("Vein has no contour in 4 layers" in n for n in facts["notes"]))
            self.assertLess(facts["labels"][1]["volume_ml"], 0.2 * one)

        def numbered_from_0(folder, random):
            drawn = Drawn(random)
            liver, other = drawn.outlines(24, (0, 0)), drawn.outlines(20, (60, 0))
            for numbers in (0, 7), (7, 0):  # the first one that is impossible is named
                structures = [(numbers[0], "a", drawn.contours(liver)),
                              (numbers[1], "b", drawn.contours(other))]
                path = dicom.write_structures(folder / "rt.dcm", structures)
                self.check(path, {1: drawn.held(liver), 2: drawn.held(other)}, NEAR,
                           said=["ROINumber 0 cannot be a label", "numbered in their"])

        def numbered_too_high(folder, random):
            drawn = Drawn(random)
            liver = drawn.outlines(24, (0, 0))
            for number in (70000, -5):
                path = dicom.write_structures(folder / "rt.dcm",
                                              [(number, "a", drawn.contours(liver))])
                self.check(path, {1: drawn.held(liver)}, NEAR,
                           said=[f"ROINumber {number} cannot be a label"])

        def to_and_fro(folder, random):  # through every row: 800 crossings for each point
            drawn = Drawn(random)
            contours = drawn.contours(drawn.outlines(30, (0, 0)))
            far = drawn.contours([numpy.array([[-200, -200], [200, 200], [0, 0]], float)])[0]
            contours.append(numpy.concatenate([far[:2]] * 50_000 + [far[2:]]))
            path = dicom.write_structures(folder / "rt.dcm", [(1, "Liver", contours)])
            done = subprocess.run(
                [TOOL, "labels", path, "--json"], capture_output=True, text=True, timeout=60,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (600 << 20, 600 << 20)))
            self.assertEqual(done.returncode, 0, done.stderr)

        def without_contour(folder, random):
            drawn = Drawn(random)
            liver = drawn.outlines(24, (0, 0))
            path = dicom.write_structures(
                folder / "rt.dcm", [(1, "Liver", drawn.contours(liver)), (2, "Vein", [])])
            self.check(path, {1: drawn.held(liver)}, NEAR, said=["Vein has no closed contour"])

        def outlined_twice(folder, random):  # nothing is left of them
            drawn = Drawn(random)
            liver, other = drawn.outlines(24, (0, 0)), drawn.outlines(20, (60, 0))
            contours = drawn.contours(other)
            some = random.choice(len(contours), 3, replace=False)
            for i in some[:2]:
                contours[i] = numpy.concatenate([contours[i], contours[i]])
            beside = contours[some[2]] + 0.012 * drawn.frame[2]
            path = dicom.write_structures(folder / "rt.dcm", [
                (1, "Liver", drawn.contours(liver)), (2, "Vein", [*contours, beside])])
            facts = json.loads(ran(path).stdout)
            count = len(contours)
            self.assertEqual([n for n in facts["notes"] if "Vein" in n], [
                f"{path}: Vein: in 3 of its {count} planes no pixel is inside of its contours: "
                "taken as empty there"])
            whole = drawn.held(other)[1]
            self.assertLess(facts["labels"][1]["volume_ml"], whole * (1 - 1.5 / count))

        def far_apart(folder, random):  # nothing was drawn in between
            drawn = Drawn(random, planes=2)
            drawn.step = float(random.uniform(20.5, 1000))
            square = numpy.array([[-20, -20], [20, -20], [20, 20], [-20, 20]], float)
            path = dicom.write_structures(folder / "rt.dcm", [
                (1, "Liver", drawn.contours([square] * 2))])
            self.check(path, {1: drawn.held([square] * 2)}, NEAR,
                       said=[f"one contour stands for {drawn.step:.4g} mm"])

        self.cases(2, outlined_twice, far_apart)
        self.cases(1, to_and_fro)
        self.cases(1, drawn_here_and_there, numbered_from_0, numbered_too_high, without_contour)

    def test_contours_that_lie_in_no_plane_are_refused(self):
        def written(folder, random, contours, *said, **options):
            drawn = Drawn(random)
            good = drawn.contours(drawn.outlines(24, (0, 0)))
            path = dicom.write_structures(
                folder / "rt.dcm", [(1, "Liver", good), (2, "Bad", contours(good))], **options)
            self.refused(path, *said)

        def bent(folder, random):
            def contours(good):
                points = good[0].copy()
                points[5] += 3
                return [points]
            written(folder, random, contours, "Bad: contour 0 reaches", "parallel planes")

        def two_points(folder, random):
            written(folder, random, lambda good: [good[0][:2]], "6 numbers in ContourData")

        def unknown(folder, random):
            def change(file):
                file.ROIContourSequence[1].ReferencedROINumber = 9
            written(folder, random, lambda good: good, "ReferencedROINumber 9", change=change)

        def points(folder, random):
            written(folder, random, lambda good: good, "no contour with an area", kind="POINT")

        def no_numbers(folder, random):
            def change(file):
                del file.ROIContourSequence[1].ContourSequence[0].ContourData
            written(folder, random, lambda good: good, "0 numbers in ContourData", change=change)

        def other_count(folder, random):
            def change(file):
                file.ROIContourSequence[1].ContourSequence[0].NumberOfContourPoints = 79
            written(folder, random, lambda good: good,
                    "NumberOfContourPoints 79, but ContourData holds 80: expected as many",
                    change=change)

        def odd_numbers(folder, random):
            def change(file):
                file.ROIContourSequence[1].ContourSequence[0].ContourData.append("1")
            written(folder, random, lambda good: good, "241 numbers in ContourData", change=change)

        def no_number(folder, random):
            def change(file):
                points = file.ROIContourSequence[1].ContourSequence[0]
                points.add_new(0x30060050, "DS", None)
                points["ContourData"]._value = "one\\two\\three\\four\\five\\six\\1\\2\\3"
            written(folder, random, lambda good: good, "contour 0: point 0: ContourData one: ",
                    "expected a number", change=change)

        def too_many(folder, random):
            path = dicom.write_structures(folder / "rt.dcm",
                                          [(i + 1, f"s{i}", []) for i in range(501)])
            self.refused(path, "501 structures: expected 1 to 500")

        def a_long_name(folder, random):
            def change(file):
                file.StructureSetROISequence[1].add_new(0x30060026, "UT", "x" * 1025)
            written(folder, random, lambda good: good, "has 1025 bytes: expected at most 1024",
                    change=change)

        def far_away(folder, random):
            one = int(random.integers(10, 80))

            def contours(good):
                points = good[0].copy()
                points[one] += 1e6
                return [good[1], points]
            written(folder, random, contours, f"Bad: contour 1: point {one}:")

        def twice(folder, random):
            def change(file):
                file.StructureSetROISequence[1].ROINumber = 1
            written(folder, random, lambda good: good, "ROINumber 1 is there several times",
                    change=change)

        def none(folder, random):
            def change(file):
                del file.StructureSetROISequence
            written(folder, random, lambda good: good, "0 structures: expected 1 to",
                    change=change)

        self.cases(1, bent, two_points, unknown, points, no_numbers, other_count, odd_numbers,
                   no_number, too_many, a_long_name, far_away, twice, none)


if __name__ == "__main__":
    unittest.main(verbosity=2)
