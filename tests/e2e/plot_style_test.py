#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`stylet plot --style`: in each style and format a whole picture of the size it promises, in the
colours of hal/palette.csv, with no text on another and none beyond the edge. STYLET_BIN and
STYLET_SOURCE name the folders of programs and source.

Widths of texts are measured by matplotlib in the same font (DejaVu Sans).
"""
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

BIN, SOURCE = (pathlib.Path(os.environ[name]) for name in ("STYLET_BIN", "STYLET_SOURCE"))
SIZES = {"console": (900, 820), "paper": (321, 420), "slide": (1280, 720)}
# Short stages (puncture) and many of them (layers), two needles.
SCENES = ("fig09-force-curve", "lumbar-puncture", "fig03-puncture", "prostate-template")
ALONE = 0.3  # px of overlap that is rounding


def stylet(*words, code=0):
    done = subprocess.run([BIN / "stylet", *words], capture_output=True, text=True)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def texts(svg):
    """(text, corners of its box in the picture) of each."""
    space = "{http://www.w3.org/2000/svg}"
    for group in xml.etree.ElementTree.parse(svg).iter(f"{space}g"):
        text = group.find(f"{space}text")
        place = re.match(r"translate\(([-\d.]+),([-\d.]+)\)(?: rotate\(([-\d.]+)\))?",
                         group.get("transform", ""))
        words = "" if text is None else "".join(text.itertext()).strip()
        if not words or place is None:
            continue
        size = float(group.get("font-size"))
        box = TextPath((0, 0), words, size=size, prop=FontProperties(family="DejaVu Sans"),
                       usetex=False).get_extents()
        shift = {"start": 0, "middle": -0.5, "end": -1}[group.get("text-anchor")] * box.width
        corners = np.array([(shift + x, y) for x, y in
                            ((0, -box.y0), (box.width, -box.y0), (box.width, -box.y1),
                             (0, -box.y1))])
        turn = np.radians(float(place[3] or 0))
        matrix = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        yield words, corners @ matrix.T + [float(place[1]), float(place[2])]


def shared(a, b):
    """By how much two convex boxes overlap: the shortest displacement that separates them."""
    least = np.inf
    for box in (a, b):
        for edge in np.roll(box, -1, 0) - box:
            normal = np.array([-edge[1], edge[0]]) / max(np.hypot(*edge), 1e-9)
            left, right = a @ normal, b @ normal
            least = min(least, left.max() - right.min(), right.max() - left.min())
    return least


class Boxes(unittest.TestCase):
    def test_overlap_of_boxes(self):
        square = np.array([(0, 0), (2, 0), (2, 2), (0, 2)], float)
        diamond = np.array([(0, -1), (1, 0), (0, 1), (-1, 0)], float)
        self.assertAlmostEqual(shared(square, square + [1.5, 0]), 0.5)
        self.assertLess(shared(square, square + [2.5, 0]), 0)
        # Their axis-parallel bounding boxes overlap, but they do not.
        self.assertLess(shared(diamond, square * 0.4 + [0.7, 0.7]), 0)


class Styles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="stylet-")
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        os.environ["XDG_CACHE_HOME"] = str(cls.top)
        for scene in SCENES:
            stylet("run", scene, "--fast", "--record", str(cls.top / f"{scene}.h5"))

    def test_no_text_on_another(self):
        for scene, style in itertools.product(SCENES, SIZES):
            picture = self.top / "picture.svg"
            stylet("plot", str(self.top / f"{scene}.h5"), "--style", style, "-o", str(picture))
            found = list(texts(picture))
            self.assertGreater(len(found), 15)
            for (one, a), (other, b) in itertools.combinations(found, 2):
                self.assertLess(shared(a, b), ALONE, f"{scene}, {style}: {one!r} on {other!r}")
            for words, corners in found:
                inside = (corners > 0).all() and (corners < SIZES[style]).all()
                self.assertTrue(inside, f"{scene}, {style}: {words!r} goes beyond the edge")

    def test_sizes_and_formats(self):
        recording = str(self.top / "fig09-force-curve.h5")
        for style, (width, height) in SIZES.items():
            for ending in ("svg", "pdf", "png"):
                picture = self.top / f"{style}.{ending}"
                stylet("plot", recording, "--style", style, "-o", str(picture))
                data = picture.read_bytes()
                if ending == "png":
                    size = [int.from_bytes(data[at:at + 4], "big") for at in (16, 20)]
                    self.assertEqual(size, [2 * width, 2 * height])
                elif ending == "svg":
                    self.assertIn(f'width="{width}" height="{height}"'.encode(), data)
                else:
                    box = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+)", data)
                    for points, px in zip(box.groups(), (width, height)):
                        self.assertAlmostEqual(float(points), 0.75 * px, delta=1)

    def test_colours_are_the_palettes(self):
        sys.path.insert(0, str(SOURCE / "hal/scenes"))
        import draw
        for style in SIZES:
            picture = self.top / "picture.svg"
            stylet("plot", str(self.top / "fig09-force-curve.h5"), "--style", style, "-o",
                   str(picture))
            text = picture.read_text().lower()
            for cause in ("total", "stiffness", "cutting", "friction", "way in", "way out"):
                red, green, blue = (int(draw.PALETTE[cause][i:i + 2], 16) for i in (1, 3, 5))
                colour = rf"rgb\( *{red}, *{green}, *{blue}\)"
                self.assertTrue(re.search(colour, text), f"{style}: {cause} is not {colour}")

    def test_an_unknown_style_or_format_is_refused(self):
        recording = str(self.top / "fig09-force-curve.h5")
        said = stylet("plot", recording, "--style", "poster", "-o", str(self.top / "a.svg"), code=2)
        self.assertIn("console,paper,slide", said)
        said = stylet("plot", recording, "-o", str(self.top / "a.eps"), code=1)
        self.assertIn("expected a name that ends in .svg, .pdf or .png", said)
        self.assertFalse((self.top / "a.svg").exists() or (self.top / "a.eps").exists())


if __name__ == "__main__":
    unittest.main()
