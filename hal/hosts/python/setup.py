#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds stylet._stylet over an installed libstylet, which pkg-config finds, or over that of a
build tree, which STYLET_BUILD names."""
import atexit
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent


def pkg_config(*words):
    return subprocess.run(
        ["pkg-config", *words, "stylet"], check=True, capture_output=True, text=True,
        env={**os.environ, "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS": "1",
             "PKG_CONFIG_ALLOW_SYSTEM_LIBS": "1"}).stdout.strip()


def installed():
    """Include and library folders of pkg-config, and the prefix; None: it knows no stylet."""
    try:
        words = shlex.split(pkg_config("--cflags", "--libs"))
        prefix, = shlex.split(pkg_config("--variable=prefix"))  # it may have blanks
    except (OSError, subprocess.CalledProcessError):
        return None
    return ([word[2:] for word in words if word.startswith("-I")],
            [word[2:] for word in words if word.startswith("-L")], os.path.normpath(prefix))


def folders():
    build = os.environ.get("STYLET_BUILD")
    if build:
        top = pathlib.Path(build).resolve()
        return [str(HERE.parent / "c/include")], [str(top / "lib")], str(top)
    found = installed()
    if found is None:
        sys.exit("stylet: libstylet was not found. Install it (cmake --install), and name its "
                 "folder in PKG_CONFIG_PATH; or name a build tree in STYLET_BUILD.")
    return found


def version(includes):
    """That of the header which the module is compiled with."""
    for folder in includes:
        header = pathlib.Path(folder) / "stylet/stylet.h"
        if header.exists():
            return ".".join(re.findall(r"#define STYLET_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)",
                                       header.read_text()))
    sys.exit(f"stylet: no stylet/stylet.h in {', '.join(includes)}")


def pybind11_include():
    """Of the package pybind11, where Python has it; Debian's headers need no folder."""
    try:
        import pybind11
    except ImportError:
        return []
    return [pybind11.get_include()]


class BuildWithPrefix(build_py):
    """With the module stylet._prefix: the package may lie far from what it was built over, which
    has programs, scenes and phantoms."""

    def run(self):
        super().run()
        module = pathlib.Path(self.build_lib, "stylet/_prefix.py")
        module.write_text(f"PREFIX = {prefix!r}\n")


includes, libraries, prefix = folders()
# Else setuptools leaves its work in this folder, which need not be writable.
work = tempfile.mkdtemp(prefix="stylet-pip-")
atexit.register(shutil.rmtree, work, ignore_errors=True)
# The sources name their headers by the whole path, wherever this folder lies.
top = pathlib.Path(work, "include")
(top / "hal/hosts").mkdir(parents=True)
(top / "hal/hosts/python").symlink_to(HERE)
setup(
    version=version(includes),
    cmdclass={"build_py": BuildWithPrefix},
    options={"build": {"build_base": work}, "egg_info": {"egg_base": work}},
    ext_modules=[Extension(
        "stylet._stylet", sorted(str(path.relative_to(HERE))
                                 for path in (HERE / "src").glob("*.cpp")),
        include_dirs=[str(top), *includes, *pybind11_include()], library_dirs=libraries,
        libraries=["stylet"], runtime_library_dirs=libraries, language="c++",
        extra_compile_args=["-std=c++20", "-fvisibility=hidden", "-ffp-contract=off"])])
