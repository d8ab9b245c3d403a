#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes of what cmake installed what Debian's policy wants in a package: compressed manual pages,
copyright and changelog, zsh's completions in their place there, plain rights, one time for all.
Adds what each package is made of (sbom.py).

usage: prepare.py STAGE SOURCE BUILD VERSION    with SOURCE_DATE_EPOCH in the environment; STAGE
has a folder for each component
"""
import email.utils
import gzip
import json
import os
import pathlib
import shutil
import sys

import sbom

# Component: package, licence, and the folders of the build with the objects it was linked from.
KERNEL = [f"kernel/CMakeFiles/stylet_{name}.dir/" for name in ("kernel", "organ", "content_sum")]
LIBRARY = [*KERNEL, "hal/CMakeFiles/stylet_hal.dir/", "hal/hosts/c/"]
PACKAGES = {
    "libraries": ("libstylet0", "Apache-2.0", LIBRARY),
    "development": ("libstylet-dev", "Apache-2.0", []),
    "program": ("stylet", "Apache-2.0", ["kernel/", "hal/", "toolchain/", "tests/bench/"]),
    "python": ("python3-stylet", "Apache-2.0", [*LIBRARY, "hal/hosts/python/"]),
    "organ": ("stylet-organ", "GPL-3.0-or-later", ["kernel/", "offline/", "toolchain/"]),
    "organ_python": ("python3-stylet-organ", "GPL-3.0-or-later",
                     ["kernel/", "offline/", "toolchain/toml/"]),
    "doc": ("stylet-doc", "Apache-2.0", None),
}
CHANGES = """stylet ({version}) unstable; urgency=medium

  * Version {version}. What changed is in the package stylet-doc:
    /usr/share/stylet/CHANGELOG.md

 -- Stylet maintainers <maintainers@stylet.invalid>  {day}
"""


BOOK = pathlib.Path("usr/share/doc/stylet/book")
OF_BOOK = f"""Document: stylet
Title: Stylet: a needle in soft tissue, felt by the hand
Author: Stylet contributors
Abstract: From a first organ to a machine of one's own: scenes, devices, programs
 around it, safety, the physics and what it was compared with, formats.
Section: Science/Medicine

Format: HTML
Index: /{BOOK}/index.html
Files: /{BOOK}/*.html
"""


def compress(path, data):
    """Without name and time, so that the same text gives the same bytes."""
    with open(path, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
        packed.write(data)


def add_pages(top, package, licence, source, version, epoch):
    folder = top / "usr/share/doc" / package
    folder.mkdir(parents=True, exist_ok=True)
    kind = "copyright.organ" if licence.startswith("GPL") else "copyright"
    shutil.copyfile(source / "toolchain/debian" / kind, folder / "copyright")
    day = email.utils.formatdate(epoch)
    compress(folder / "changelog.gz", CHANGES.format(version=version, day=day).encode())
    return folder


def put_in_place(top):
    for page in top.glob("usr/share/man/man*/*.[0-9]"):
        compress(page.with_name(page.name + ".gz"), page.read_bytes())
        page.unlink()
    site = top / "usr/share/zsh/site-functions"
    if site.exists():
        site.rename(site.with_name("vendor-completions"))
    for name in ("LICENSE", "LICENSE.meta"):  # the file `copyright` says where Debian has them
        for licence in top.rglob(name):
            licence.unlink()


def register_book(top, copyright_file, source):
    """With doc-base, by which desktops list what there is to read; and whose its scripts are."""
    if (top / BOOK / "index.html").exists():
        entry = top / "usr/share/doc-base/stylet-doc.stylet"
        entry.parent.mkdir(parents=True)
        entry.write_text(OF_BOOK)
        with copyright_file.open("a") as file:
            file.write((source / "toolchain/debian/copyright.book").read_text())


def make_plain(top, epoch):
    for path in [top, *top.rglob("*")]:
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or os.access(path, os.X_OK) and
                       not path.suffix.startswith(".so") else 0o644)
    for path in [top, *top.rglob("*")]:
        os.utime(path, (epoch, epoch), follow_symlinks=False)


def prepare(stage, source, build, version):
    epoch = int(os.environ["SOURCE_DATE_EPOCH"])
    for component, (package, licence, objects) in PACKAGES.items():
        top = stage / component
        if not top.is_dir():
            continue
        put_in_place(top)
        folder = add_pages(top, package, licence, source, version, epoch)
        register_book(top, folder / "copyright", source)
        if objects is not None:
            parts = sbom.document(build, package, version, licence, top, objects)
            (folder / "sbom.spdx.json").write_text(json.dumps(parts, indent=1) + "\n")
        make_plain(top, epoch)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    prepare(*(pathlib.Path(word) for word in sys.argv[1:4]), sys.argv[4])
