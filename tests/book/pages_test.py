#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every block of code in the book's own pages is used as a reader uses it, in a folder of its own
for each page, with an installed Stylet. (Commands of the READMEs in the book: e2e.readme.)

usage: pages_test.py [PAGE...]    with STYLET_BUILD and STYLET_SOURCE in the environment

    sh              runs; all of its commands must succeed
    python          runs
    text            the output of the block before it has these lines, whatever their numbers are
    title="NAME"    is written to that file, for blocks further down
    diagram         a drawing

Before a block, `<!-- shown: REASON -->` says why it cannot run here, `<!-- exit N: REASON -->` the
exit code of its last command if it is not 0."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/e2e"))
from readme_test import DATA, Tree  # the installed tree, with PATH and libraries set

BLOCK = re.compile(r"^(?:<!-- (shown|exit (\d+)): ([^\n]+) -->\n)?"
                   r"```(\w+)?(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.M | re.S)
NEEDS = re.compile(r"^\s*(cc|c\+\+|cmake|mcs|mono|mkoctfile|octave|node)\b", re.M)
PAGES = sorted(path.stem for path in (SOURCE / "toolchain/book").glob("*.md"))


def masked(line):
    """A line without its numbers and the width of its columns."""
    return re.sub(r"\s+", " ", re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", line)).strip()


def unclaimed(text):
    """Lines that are code, but in no block that BLOCK finds."""
    rest = BLOCK.sub("", text)
    return [line for line in rest.splitlines() if line.startswith(("    ", "```"))]


class Reader:
    """A reader who goes through a page from its first block to its last."""

    def __init__(self, tree, folder):
        self.tree, self.folder, self.said = tree, folder, ""

    def run(self, words, code, limit_s=600):
        done = subprocess.run(words, cwd=self.folder, env=self.tree.env, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=limit_s)
        self.said = done.stdout
        if done.returncode != code:
            raise AssertionError(f"exit code {done.returncode}, expected {code}\n{done.stdout}")

    def use(self, how, code, reason, kind, title, text):
        """What was done with the block, in a word."""
        if how == "shown":
            return "shown"
        if title:
            (self.folder / title).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / title).write_text(text)
            return "written"
        if kind == "diagram":
            return "drawn"
        if kind == "text":
            said = {masked(line) for line in self.said.splitlines()}
            for line in filter(None, map(masked, text.splitlines())):
                if not any(line in other for other in said):
                    raise AssertionError(f"no line like {line!r} in\n{self.said}")
            return "compared"
        if kind == "sh":
            lacking = [name for name in NEEDS.findall(text) if shutil.which(name) is None]
            if lacking:
                return f"skipped: no {lacking[0]} here"
            if "$STYLET_DATA" in text and not DATA.exists():
                return "skipped: no shared data (STYLET_DATA)"
            self.run(["bash", "-eo", "pipefail", "-c", text], int(code or 0))
            return "ran"
        if kind == "python":
            no_screen = "import matplotlib\nmatplotlib.use('Agg')\n"
            self.run(["/usr/bin/python3", "-c", no_screen + text], 0)
            return "ran"
        raise AssertionError(f"a block of {kind}: expected sh, python, text, a title or `shown`")


class Blocks(unittest.TestCase):
    """The reading of pages: what is in no block, and blocks that are wrong, are refused."""

    def test_every_block_is_found(self):
        text = "a\n```sh\nx\n```\n<!-- exit 3: late -->\n```python title=\"b.py\"\ny\n```\n"
        self.assertEqual([match.groups() for match in BLOCK.finditer(text)],
                         [(None, None, None, "sh", None, "x\n"),
                          ("exit 3", "3", "late", "python", "b.py", "y\n")])
        self.assertEqual(unclaimed(text), [])
        self.assertEqual(unclaimed("a\n\n    code\n"), ["    code"])

    def test_wrong_blocks_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            tree = type("Tree", (), {"env": dict(os.environ)})
            reader = Reader(tree, pathlib.Path(name))
            reader.use(None, None, None, "sh", None, "echo force 1.5 N\n")
            reader.use(None, None, None, "text", None, "force  2 N\n")
            for kind, text in (("text", "force 2 mN\n"), ("sh", "false; true\n"), ("c", "int x;\n"),
                               ("python", "1 / 0\n")):
                with self.assertRaises(AssertionError, msg=text):
                    reader.use(None, None, None, kind, None, text)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.top = tempfile.TemporaryDirectory(prefix="stylet-book-")
        cls.addClassCleanup(cls.top.cleanup)
        cls.tree = Tree("installed", pathlib.Path(cls.top.name))
        cls.tree.env["STYLET_DATA"] = str(DATA)
        cls.tree.env["SHARE"] = str(cls.tree.top)

    def page(self, name):
        text = (SOURCE / f"toolchain/book/{name}.md").read_text()
        self.assertEqual(unclaimed(text), [], "code that is in no block of the right form")
        folder = pathlib.Path(self.top.name) / "pages" / name
        folder.mkdir(parents=True)
        reader = Reader(self.tree, folder)
        for match in BLOCK.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            try:
                print(f"toolchain/book/{name}.md:{line}: {reader.use(*match.groups())}", flush=True)
            except AssertionError as fault:
                raise AssertionError(f"toolchain/book/{name}.md:{line}: {fault}") from None


for page in PAGES:
    setattr(Pages, f"test_{page.replace('-', '_')}", lambda self, name=page: self.page(name))

if __name__ == "__main__":
    asked = [f"Pages.test_{name.replace('-', '_')}" for name in sys.argv[1:]]
    unittest.main(argv=sys.argv[:1] + (["Blocks"] + asked if asked else []))
