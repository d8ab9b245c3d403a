#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What toolchain/book.py makes of a page, its filter of headers and its check of links; each with
samples that it must refuse.

usage: builder_test.py    with STYLET_SOURCE in the environment
"""
import os
import pathlib
import re
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
sys.path[:0] = [str(SOURCE / "toolchain"), str(SOURCE / "toolchain/checks")]
import book
import book_headers
import book_site


class Pages(unittest.TestCase):
    """Links and figures, in a repository of a few files."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.old, book.ROOT = book.ROOT, self.top
        self.addCleanup(setattr, book, "ROOT", self.old)
        self.book = book.Book.__new__(book.Book)
        self.book.docs, self.book.programs = self.top / "docs", self.top
        self.book.commit, self.book.commands = (lambda name: "commit abc"), [("*.svg", "draw.py")]
        self.book.todo, self.book.known = [], set()

    def page(self, name, text, **others):
        for path, content in {name: text, **others}.items():
            (self.top / path).parent.mkdir(parents=True, exist_ok=True)
            (self.top / path).write_text(content)
        return self.book.page(name).split("---\n", 2)[2]  # behind the head

    def test_links_to_pages_sources_and_folders(self):
        text = "[g](../../hal/g.md#x) [c](../../hal/c.cpp) [d](../../hal) [w](https://w/)\n"
        made = self.page("toolchain/book/a.md", text, **{"hal/g.md": "", "hal/c.cpp": ""})
        self.assertEqual(made, "[g](hal/g.md#x) [c](source/hal/c.cpp.md) d [w](https://w/)\n")
        self.assertEqual(self.book.known, {"hal/g.md", "hal/c.cpp"})

    def test_links_in_code_stay(self):
        text = "`[a](b)` and ``[[x]](`y`)``\n\n```\n[a](b.md)\n![p](q.svg)\n```\n"
        self.assertEqual(self.page("hal/a.md", text), text)

    def test_dead_links_and_figures_without_a_command_are_refused(self):
        with self.assertRaisesRegex(book.Wrong, "hal/a.md: links to gone.md"):
            self.page("hal/a.md", "[g](gone.md)\n")
        with self.assertRaisesRegex(book.Wrong, "no command in figures.sh"):
            self.page("hal/a.md", "![p](p.png)\n", **{"hal/p.png": ""})

    def test_a_figure_tells_its_command_and_commit(self):
        made = self.page("hal/a.md", "![A curve](p.svg)\n", **{"hal/p.svg": ""})
        for words in ('src="p.svg"', "A curve", "<code>draw.py</code>, commit abc"):
            self.assertIn(words, made)

    def test_formulas_and_comments(self):
        made = self.page("hal/a.md", "```math\nx_1\n```\n<!-- note -->\n| a |\n| --- |\n")
        self.assertIn("$$\nx_1\n$$\n", made)
        self.assertIn("<!-- note -->\n\n| a |", made)


class Headers(unittest.TestCase):
    def test_a_comment_belongs_to_the_line_it_stands_at(self):
        made = book_headers.filtered(
            "/* SPDX-License-Identifier: Apache-2.0 */\n/* The file. */\n/* ==== Part ==== */\n"
            "// Above,\n// two lines.\nint f(void);\nint a; /* of a < b */\n"
            "const char* s = \"// no comment\";\n", "x.h")
        self.assertIn("/** \\file x.h\n * The file. */", made)
        self.assertNotIn("Part", made)
        self.assertIn("/** Above, \n * two lines. */\nint f(void);", made)
        self.assertIn("int a; /**< of a \\< b */", made)
        self.assertIn("\"// no comment\"", made)


class Names(unittest.TestCase):
    """Names that the book's own pages mention exist."""

    def spans(self, pattern):
        for path in sorted((SOURCE / "toolchain/book").glob("*.md")):
            for span in re.findall(r"`([^`\n]+)`", path.read_text()):
                for name in re.findall(pattern, span):
                    yield path.name, name

    def missing(self, pattern, text):
        found = list(self.spans(pattern))
        self.assertGreater(len(found), 5)
        return [each for each in found if not re.search(rf"\b{re.escape(each[1])}\b", text)]

    def test_functions_and_structs_of_c(self):
        headers = SOURCE / "hal/hosts/c/include/stylet"
        text = "".join(path.read_text() for path in headers.glob("*.h"))
        self.assertEqual([each for each in self.missing(r"\bstylet_[a-z_]+[a-z]\b", text)
                          if each[1] != "stylet_organ"], [])  # also a package of Python

    def test_keys_of_a_scene(self):
        sections = "organ|loop|tissue|needle|approach|device|mapping|guard|hand|coupling"
        text = (SOURCE / "hal/scene/README.md").read_text()
        names = rf"(?<![\w./])(?:{sections})\.(?!toml|organ)[a-z_]+(?![\w(.])"
        self.assertEqual(self.missing(names, text), [])

    def test_files(self):
        pattern = r"(?:toolchain|hal|offline|kernel|tests)/[\w./@-]+\.\w+"
        found = set(self.spans(pattern))
        self.assertGreater(len(found), 1)
        self.assertEqual([each for each in found if not (SOURCE / each[1]).exists()], [])


class Citation(unittest.TestCase):
    KINDS = ["Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"]

    def setUp(self):
        lists = (SOURCE / "CMakeLists.txt").read_text()
        self.version = re.search(r"project\(stylet VERSION ([\d.]+)", lists)[1]

    def test_version_is_that_of_the_project(self):
        self.assertIn(f"\nversion: {self.version}\n", (SOURCE / "CITATION.cff").read_text())
        self.assertIn(f"Version {self.version}.", (SOURCE / "toolchain/book/cite.md").read_text())

    def test_changelog_has_a_section_of_the_version_with_its_day(self):
        headings = re.findall(r"^##+ (?!#).*", (SOURCE / "CHANGELOG.md").read_text(), re.MULTILINE)
        versions = [line for line in headings if line.startswith("## ")]
        self.assertEqual(versions[0], "## [Unreleased]")
        self.assertRegex(versions[1], rf"^## \[{re.escape(self.version)}\] - \d{{4}}-\d\d-\d\d$")
        for first, end in zip(versions, [*versions[1:], None]):
            part = headings[headings.index(first) + 1:headings.index(end) if end else None]
            kinds = [line[4:] for line in part if line.startswith("### ")]
            self.assertEqual(kinds, [kind for kind in self.KINDS if kind in kinds])


class Links(unittest.TestCase):
    def faults(self, **pages):
        with tempfile.TemporaryDirectory() as name:
            site = pathlib.Path(name).resolve()
            for page, text in pages.items():
                (site / page.replace("_", ".")).write_text(text)
            return list(book_site.faults(site))

    def test_links_that_lead_somewhere_are_accepted(self):
        good = "<h1 id=x></h1><a href='b.html#y'></a><a href='#x'></a><a href='https://w.org/'></a>"
        other = "<h2 id=y></h2><img src='data:image/png;base64,x'>"
        self.assertEqual(self.faults(a_html=good, b_html=other), [])

    def test_links_that_lead_nowhere_or_to_the_network_are_refused(self):
        for bad, words in (("<a href='c.html'></a>", "c.html is not there"),
                           ("<a href='#z'></a>", "no such heading"),
                           ("<img src='p.png'>", "p.png is not there"),
                           ("<a href='/b.html'></a>", "for a server"),
                           ("<script src='https://w.org/x.js'></script>", "loads https"),
                           ("<link href='//w.org/x.css'>", "loads //w.org")):
            with self.subTest(bad):
                found = self.faults(a_html=bad)
                self.assertEqual(len(found), 1, found)
                self.assertIn(words, found[0])
        self.assertEqual(len(self.faults(a_css="a { b: url(https://w.org/f) }", a_html="")), 1)
        self.assertEqual(len(self.faults()), 1)


if __name__ == "__main__":
    unittest.main()
