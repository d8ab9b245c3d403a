#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The package for npm: built by emscripten, run by node and by Chromium. It has the bits of the
interface in C, refusals name fields, objects end in any order, memory may grow, and its types are
complete.

usage: browser_test.py SOURCE BUILD_FOLDER EXAMPLE_IN_C STYLET_ORGAN LIBSTYLET
"""
import contextlib
import ctypes
import functools
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
from command import run, source_is_missing

SOURCE, BUILD, EXAMPLE_IN_C, ORGAN_MAKER, LIBRARY = (
    pathlib.Path(word).resolve() for word in sys.argv[1:6])
BROWSER = SOURCE / "hal/hosts/browser"
PACKAGE = BUILD / "browser/package"
SKIPPED = 77
# What is reached. (The bar is 200 kB for what every page loads.)
MOST_BYTES = {"stylet.wasm": 216_000, "stylet-threads.wasm": 230_000}
README = re.search(r"^```js\n(.*?)^```", (BROWSER / "package/README.md").read_text(),
                   re.S | re.M)[1]
PAGE = """<!doctype html><meta charset="utf-8"><script type="importmap">
{"imports": {"stylet-wasm": "./package/index.mjs"}}</script>
<pre id="out1"></pre><pre id="out2"></pre>
<script type="module">
import { insertion } from "./session.mjs";
const bytes = await (await fetch("./liver.organ")).arrayBuffer();
for (const wanted of [1, 2]) {
  const { text, threads } = await insertion(bytes, wanted);
  document.getElementById(`out${wanted}`).textContent = `${threads} threads\n${text}`;
}
</script><pre id="said"></pre><script type="module">
console.log = (...words) => (document.getElementById("said").textContent += words.join(" "));
README</script>""".replace("README", README)


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        run("cmake", "--build", BUILD / "browser", "-j", "1", timeout=900)
        (cls.top / "node_modules").mkdir()
        (cls.top / "node_modules/stylet-wasm").symlink_to(PACKAGE)
        (cls.top / "package").symlink_to(PACKAGE)
        for file in (BROWSER / "examples/insert.mjs", *SOURCE.glob("tests/hosts/browser/*.mjs")):
            shutil.copy(file, cls.top)
        cls.organ = cls.top / "liver.organ"
        run(ORGAN_MAKER, "phantom", "liver", "--voxel-mm", 7, "-o", cls.organ)

    def node(self, *words, **options):
        return run("node", *words, cwd=self.top, timeout=600, **options)

    @functools.cached_property
    def in_c(self):
        return run(EXAMPLE_IN_C, self.organ)

    def test_inserts_as_the_example_in_c(self):
        self.assertEqual(self.node("insert.mjs", self.organ), self.in_c)
        self.assertIn("state ", self.in_c)

    def test_size(self):
        for name, most in MOST_BYTES.items():
            size = (PACKAGE / name).stat().st_size
            print(f"{name} has {size} bytes", file=sys.stderr)
            self.assertLessEqual(size, most)

    def test_what_a_program_relies_on(self):
        self.node("--test", "package.test.mjs")

    def test_version_is_that_of_the_library(self):
        library = ctypes.CDLL(str(LIBRARY))
        library.stylet_version_text.restype = ctypes.c_char_p
        version = library.stylet_version_text().decode()
        self.assertEqual(json.loads((PACKAGE / "package.json").read_text())["version"], version)
        asked = self.node("-e", "import('stylet-wasm').then(async (m) => "
                          "console.log((await m.load()).version))")
        self.assertEqual(asked.strip(), version)

    def test_types_are_complete_and_true(self):
        """They have every method and property of the classes, and no other."""
        types = (PACKAGE / "index.d.ts").read_text()
        for name in ("Stylet", "Organ", "Simulation"):
            body = re.search(rf"^export class {name} \{{\n(.*?)\n\}}", types, re.S | re.M)[1]
            said = set(re.findall(r"^  (?:readonly )?(\w+)[(:]", body, re.M))
            found = self.node(
                "-e", f"import('stylet-wasm').then((m) => console.log(Object.getOwnPropertyNames("
                f"m.{name}.prototype).join(' ')))").split()
            inner = {"constructor", "with_struct", "with_array", "create", "asked", "check",
                     "filled", "numbers", "list", "together"}
            own = {"organ", "needles"} if name == "Simulation" else set()
            self.assertEqual(said - own, set(found) - inner, name)

    def test_is_packed_whole(self):
        done = json.loads(run("npm", "pack", "--json", "--dry-run", cwd=PACKAGE))
        packed = {each["path"] for each in done[0]["files"]}
        self.assertEqual(packed, {path.name for path in PACKAGE.iterdir()})

    def test_threads_in_node(self):
        for wanted in (2, 3):
            said = self.node("-e", f"import('./session.mjs').then(async ({{ insertion }}) => {{"
                             f"const found = await insertion(require('fs').readFileSync("
                             f"'liver.organ'), {wanted});"
                             "console.log(`${found.threads} threads\\n${found.text}`); })")
            self.assertEqual(said, f"{wanted} threads\n{self.in_c}")

    def in_chromium(self, check, address):
        """What a visitor of the page saw."""
        modules = SOURCE / "hal/console/page/node_modules"
        if shutil.which("chromium") is None or not (modules / "playwright-core").exists():
            self.skipTest("no chromium, or no npm packages of hal/console/page")
        return json.loads(self.node(check, address, modules / "playwright-core/index.mjs",
                                    shutil.which("chromium")))

    def test_in_chromium(self):
        """A page of its own may share memory; another computes the same with one thread."""
        (self.top / "index.html").write_text(PAGE)
        for handler, threads in ((Quiet, 1), (Isolated, 2)):
            with served(self.top, handler) as address:
                alone, shared, said = self.in_chromium("page.check.mjs", address)
            lines = self.in_c.rstrip("\n")
            self.assertEqual(alone, f"1 threads\n{lines}")
            self.assertEqual(shared, f"{threads} threads\n{lines}")
            self.assertRegex(said, r"^[-\d.e]+,[-\d.e]+,[-\d.e]+ [0-3] [0-9a-f]{16}$")

    def test_the_demo_in_chromium(self):
        """Opened from a folder, by a visitor who pushes the needle in and wants the proof, and by
        one with a telephone, who finds all of it with a thumb."""
        run("/usr/bin/python3", BROWSER / "demo.py", "--bin", ORGAN_MAKER.parent, "--package",
            PACKAGE, "--out", self.top / "demo", timeout=300)
        seen = self.in_chromium("demo.check.mjs", self.top / "demo/index.html")
        self.assertEqual(seen["errors"], [])
        self.assertEqual(seen["phases"], [2, 2, 2, 2, 2])
        self.assertEqual(seen["hidden"], [])
        self.assertEqual(seen["wide"], [390, 390])
        self.assertIn("finger", seen["hint"])
        self.assertGreater(seen["rolled"], 0.1)
        self.assertGreater(seen["force"], 0.01)
        self.assertEqual(seen["same"], 1)
        for handler, threads in ((Quiet, "1 thread"), (Isolated, "3 threads")):
            with served(self.top / "demo", handler) as address:
                said = self.in_chromium("demo.check.mjs", address)["said"]
            self.assertRegex(said, rf"ticks a second by {threads}\b")


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map,
                      ".mjs": "text/javascript", ".wasm": "application/wasm"}

    def log_message(self, *_):
        pass


class Isolated(Quiet):
    """What a page needs that shares memory between threads."""
    def end_headers(self):
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        super().end_headers()


@contextlib.contextmanager
def served(folder, handler):
    """Address of a page that a server gives."""
    handler = functools.partial(handler, directory=folder)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/index.html"
        server.shutdown()


def missing():
    for program in ("em++", "node", "npm"):
        if shutil.which(program) is None:
            return program
    return None


def configure():
    """The build that all of these tests use. Without the sources of libraries there is none."""
    try:
        run("cmake", "-S", BROWSER, "-B", BUILD / "browser", "-G", "Ninja", timeout=600)
    except AssertionError as error:
        if not source_is_missing(str(error)):
            raise
        print(f"skipped: {source_is_missing(str(error))}")
        sys.exit(SKIPPED)


if __name__ == "__main__":
    if missing():
        print(f"skipped: no {missing()} here; toolchain/setup.sh installs it")
        sys.exit(SKIPPED)
    configure()
    unittest.main(argv=sys.argv[:1])
