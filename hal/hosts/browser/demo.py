#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the demo: one page, index.html, that computes the tissue itself. It opens from a folder or
from any web server. Makes its organs with stylet-organ, and the state that the page must come to
with the example in C.

usage: demo.py [--bin FOLDER] [--package FOLDER] [--out FOLDER]

Needs node, the npm packages of hal/console/page (npm install --no-save there), and the package
stylet-wasm, built as README.md says.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[3]
PAGE = SOURCE / "hal/console/page"
ORGANS = {
    "liver": ["liver", "--voxel-mm", "5"],
    "wall": ["layered", "--size-mm", "80,60,60", "--voxel-mm", "4", "--layer", "skin:4",
             "--layer", "fat:12", "--layer", "muscle:12", "--layer", "liver:52"],
    # The tissue and the holding of hal/scenes/fig10-steering.toml.
    "gel": ["block", "--size-mm", "150,60,80", "--voxel-mm", "5", "--tissue", "stiff_gel",
            "--materials", SOURCE / "hal/scenes/steering-gel.tissues", "--fix", "x>95%",
            "--fix", "y<5%", "--fix", "y>95%", "--fix", "z<5%", "--fix", "z>95%"],
}


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{words[0]}: exit code {done.returncode}\n{done.stdout}{done.stderr}".strip())
    return done.stdout


def make_organs(programs, folder):
    for name, words in ORGANS.items():
        run(programs / "stylet-organ", "phantom", *words, "-o", folder / f"{name}.organ")
    said = run(programs / "stylet_example_insert_c", folder / "liver.organ")
    (folder / "desktop.txt").write_text(re.search(r"^state (\w+)$", said, re.M)[1] + "\n")


def main(options):
    if not (options.package / "stylet.wasm").exists():
        sys.exit(f"{options.package}: has no stylet.wasm: expected the package, built as "
                 "hal/hosts/browser/README.md says")
    if not (PAGE / "node_modules").exists():
        sys.exit(f"{PAGE}: has no node_modules: expected `npm install --no-save` there first")
    with tempfile.TemporaryDirectory() as name:
        make_organs(options.bin, pathlib.Path(name))
        run("node", PAGE / "build.mjs", "demo", "--package", options.package.resolve(),
            "--organs", name, "--out", options.out.resolve())
    page = options.out / "index.html"
    print(f"wrote {page}, {page.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n\nusage")[0])
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/release/bin",
                        help="folder of stylet-organ and stylet_example_insert_c")
    parser.add_argument("--package", type=pathlib.Path, default=SOURCE / "build/browser/package",
                        help="folder of stylet-wasm")
    parser.add_argument("--out", type=pathlib.Path, default=SOURCE / "build/demo",
                        help="folder for index.html")
    main(parser.parse_args())
