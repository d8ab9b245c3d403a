#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the book and follows every link of it; or reads its pages in Chromium, from a folder and
without a network. Skips (77) if what it needs is not installed.

usage: site_test.py build|again|read SITE [PAGE...]

again: builds it once more, elsewhere; it has the same bytes.

STYLET_BUILD and STYLET_SOURCE name the folders of the build and of the source.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE, BUILD = (pathlib.Path(os.environ[name]) for name in ("STYLET_SOURCE", "STYLET_BUILD"))
sys.path[:0] = [str(SOURCE / "toolchain"), str(SOURCE / "toolchain/checks")]
import book
import book_site

PLAYWRIGHT = SOURCE / "hal/console/page/node_modules/playwright-core/index.mjs"
SEARCHED = "guard/GUARD.html"  # is found by its word "watchdog"


def skip(why):
    print(f"skipped: {why}; toolchain/setup.sh test installs it")
    sys.exit(77)


def build(site):
    if book.lacking():
        skip(f"{', '.join(book.lacking())} not here")
    done = subprocess.run([SOURCE / "toolchain/book.py", "--out", site, "--bin", BUILD / "bin"])
    if done.returncode != 0:
        return [f"book.py: exit code {done.returncode}"]
    return list(book_site.faults(site.resolve()))


def files(top):
    return {str(path.relative_to(top)): path.read_bytes()
            for path in top.rglob("*") if path.is_file()}


def again(site):
    if not (site / "index.html").exists():
        skip(f"no book in {site}")
    with tempfile.TemporaryDirectory(prefix="another-and-longer-") as name:
        other = pathlib.Path(name) / "book"
        subprocess.run([SOURCE / "toolchain/book.py", "--out", other, "--bin", BUILD / "bin"],
                       check=True, env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})
        one, two = files(site), files(other)
    return [f"{each}: differs from build to build" for each in sorted(one.keys() | two.keys())
            if one.get(each) != two.get(each)]


def read(site, pages):
    if not (site / "index.html").exists():
        skip(f"no book in {site}")
    chromium = shutil.which("chromium")
    if chromium is None or shutil.which("node") is None:
        skip("no chromium, or no node")
    if not PLAYWRIGHT.exists():
        skip("npm packages of hal/console/page are not here")
    done = subprocess.run(["node", SOURCE / "tests/book/look.mjs", site.resolve(), PLAYWRIGHT,
                           chromium, "", *pages], capture_output=True, text=True)
    if done.returncode != 0:
        return [done.stdout + done.stderr]
    seen = json.loads(done.stdout)
    print(f"{seen['pages']} pages read, {len(seen['found'])} places found")
    faults = seen["faults"]
    if not any(place.startswith(SEARCHED) for place in seen["found"]):
        faults.append(f"the search does not find {SEARCHED}, but {seen['found']}")
    if pages and seen["pages"] != len(pages):
        faults.append(f"not all of {pages} are pages")
    return faults


if __name__ == "__main__":
    what, site = sys.argv[1], pathlib.Path(sys.argv[2])
    found = {"build": build, "again": again}[what](site) if what != "read" else read(
        site, sys.argv[3:])
    print("\n".join(found))
    sys.exit(bool(found))
