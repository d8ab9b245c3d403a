#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every figure takes the colours of hal/palette.csv: a name has one colour in all of them, no other
line has that colour, and people with any colour vision can tell the colours apart.

Sources: simulated colour vision, Machado, Oliveira and Fernandes 2009, severity 1; difference of
colours, CIE 1976; contrast ratio, WCAG 2.2.
"""
import itertools
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "hal/scenes"))
sys.dont_write_bytecode = True

import draw  # noqa: E402
import shown  # noqa: E402

PALETTE = {name: colour for name, colour in draw.PALETTE.items() if name != "name"}
CAUSES = ["stiffness", "cutting", "friction", "clamping", "obstacle"]
VISION = {
    "usual": np.eye(3),
    "protan": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                        [-0.003882, -0.048116, 1.051998]]),
    "deutan": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                        [-0.011820, 0.042940, 0.968881]]),
    "tritan": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
                        [0.004733, 0.691367, 0.303900]]),
}
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
AT_A_GLANCE = 10  # CIE 1976, as in the page's test
ON_WHITE = 3  # contrast of signs that must be seen


def text(path):
    return (ROOT / path).read_text()


def linear(colour):
    share = np.array([int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    white = TO_XYZ @ np.ones(3)
    x, y, z = np.cbrt(np.clip(TO_XYZ @ np.clip(rgb, 0, 1) / white, 1e-6, None))
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


class Palette(unittest.TestCase):
    def test_program_and_page_have_none_of_their_own(self):
        """They take them from what is made of the palette when they are built."""
        for path in ("hal/app/plot.cpp", "hal/app/plot_look.h"):
            self.assertEqual([c for c in PALETTE.values() if c in text(path)], [], path)
        script = text("hal/console/page/dist/app.js")
        for name in ("total", *CAUSES):
            self.assertRegex(script, rf'\b{name}:\{{colour:"{PALETTE[name]}"', name)

    def test_scripts_of_python_and_matlab(self):
        colours = f"COLOURS = {[PALETTE[c] for c in CAUSES]}".replace("'", '"')
        code = text("hal/hosts/python/package/stylet/recording.py")
        self.assertIn(colours, code)
        self.assertIn('TOTAL = "' + PALETTE["total"], code)
        code = text("offline/analysis/recording.py")
        self.assertIn(colours, code)
        ends = [PALETTE[name] for name in ("total", "way in", "way out")]
        self.assertIn("TOTAL, WAY_IN, WAY_OUT = " + ", ".join(f'"{c}"' for c in ends), code)
        code = text("offline/analysis/recording.m")

        def triple(name):
            return " ".join(str(int(PALETTE[name][i:i + 2], 16)) for i in (1, 3, 5))
        self.assertIn(f"colours = [{'; '.join(map(triple, CAUSES))}] / 255;", code)
        for name in ("total", "way in", "way out"):
            self.assertIn(f"{name.replace(' ', '_')} = [{triple(name)}] / 255;", code)

    def test_pictures_of_scenes(self):
        """In the committed picture each curve's colour stands before its name."""
        seen, drawn_as = set(), {}
        names = {**{cause: cause for cause in CAUSES}, "axial force": "total", "total": "total",
                 "way in": "way in", "way out": "way out", "hold": "hold"}
        for path in sorted((ROOT / "hal/scenes/pictures").glob("*.svg")):
            for name, rest in re.findall(r"(?s)<title>([^<]*)</title>(.{0,900})", path.read_text()):
                colours = re.findall(r"rgb\( *(\d+), *(\d+), *(\d+)\)", rest.split("<title>")[0])
                if name and colours:
                    first = drawn_as.setdefault((path.name, name), colours[0])
                    self.assertEqual(colours[0], first, f"{path.name}: {name} in two panels")
                if name in names and colours:
                    drawn = {"#%02x%02x%02x" % tuple(map(int, c)) for c in colours}
                    self.assertIn(PALETTE[names[name]], drawn, f"{path.name}: {name}")
                    seen.add(name)
        self.assertLessEqual({"stiffness", "cutting", "friction", "axial force", "way in"}, seen)

    def test_no_other_line_has_a_colour_of_the_palette(self):
        self.assertEqual(set(draw.OTHERS) & set(PALETTE.values()), set())
        self.assertEqual(len(set(PALETTE.values())), len(PALETTE))

    def test_colours_in_one_figure_differ_for_every_vision_and_stand_on_white(self):
        for figure in (["total", *CAUSES], ["way in", "hold", "way out"]):
            for vision, sees in VISION.items():
                for a, b in itertools.combinations(figure, 2):
                    apart = np.linalg.norm(lab(sees @ linear(PALETTE[a])) -
                                           lab(sees @ linear(PALETTE[b])))
                    self.assertGreater(apart, AT_A_GLANCE, f"{a}, {b}: {vision}")
        for name, colour in PALETTE.items():
            luminance = float(TO_XYZ[1] @ linear(colour))
            self.assertGreaterEqual(1.05 / (luminance + 0.05), ON_WHITE, name)


class Shown(unittest.TestCase):
    """The check of the committed pictures notices what has changed."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for path in (shown.GOLDEN, *(ROOT / path for path in self.drawing()),
                     *(ROOT / "hal/scenes").glob("*.toml"), *shown.KINDS["scenes"][0].glob("*")):
            copy = self.root / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, copy)
        pictures = (self.root / "hal/scenes/pictures", *shown.KINDS["scenes"][1:])
        for name, value in {"ROOT": self.root, "HERE": self.root / "hal/scenes",
                            "GOLDEN": self.root / shown.GOLDEN.relative_to(ROOT),
                            "KINDS": {"scenes": pictures}}.items():
            patch = unittest.mock.patch.object(shown, name, value)
            patch.start()
            self.addCleanup(patch.stop)

    @staticmethod
    def drawing():
        return shown.KINDS["scenes"][3]

    def faults_after(self, path, old, new):
        file = self.root / path
        text = file.read_text()
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1))
        return list(shown.faults("scenes"))

    def test_each_change_is_reported(self):
        before = list(shown.faults("scenes"))
        number = len(list((self.root / "hal/scenes/pictures").glob("*.svg")))
        for path, old, new, words, count in [
                ("hal/scenes/pictures/fig06-clamping.svg", "<svg", "<svg ", "picture itself", 1),
                ("tests/golden/scenes.json", '"ticks": ', '"ticks": 1', "what it gives", 1),
                ("hal/scenes/fig10-steering.toml", "\n", "\n# \n", "the scene", 1),
                ("hal/palette.csv", "#1d2733", "#1d2734", "what draws it", number)]:
            after = self.faults_after(path, old, new)
            new_ones = [fault for fault in after if fault not in before]
            self.assertEqual(len(new_ones), count, (path, new_ones))
            self.assertIn(words, new_ones[0])
            self.assertIn("hal/scenes/play.py --pictures ", new_ones[0])
            before = after


class Labels(unittest.TestCase):
    def test_no_name_lies_over_another_or_outside(self):
        random = np.random.default_rng(28)
        for _ in range(300):
            low, wide = random.uniform(-50, 50), random.uniform(0.1, 100)
            kinds = random.choice(["layer", "puncture", "exit", "re-entry"], random.integers(1, 25))
            at = low + wide * np.sort(random.random(len(kinds)) ** random.uniform(0.3, 4))
            marks = list(zip(at, map(str, kinds)))
            random.shuffle(marks)
            marks = [(float(x), words) for x, words in marks]
            labels = draw.placed(marks, low, low + wide)
            places = [place for place, _ in labels]
            gap = draw.LABEL_GAP * wide
            self.assertTrue(np.all(np.diff(places) > 0.999 * gap), labels)
            self.assertTrue(low <= min(places) and max(places) <= low + wide * 1.000001)
            said = sum(int(re.search(r", (\d+) times", words)[1]) if "times" in words else 1
                       for _, words in labels)
            self.assertEqual(said, len(marks))


if __name__ == "__main__":
    unittest.main()
