#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds stylet._stylet over an installed libstylet, which pkg-config finds, or over that of a
build tree, which STYLET_BUILD names."""
import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup

HERE = pathlib.Path(__file__).resolve().parent


def installed():
    """Include and library folders of pkg-config; None: it knows no stylet."""
    try:
        flags = subprocess.run(
            ["pkg-config", "--cflags", "--libs", "stylet"], check=True, capture_output=True,
            text=True, env={**os.environ, "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS": "1",
                            "PKG_CONFIG_ALLOW_SYSTEM_LIBS": "1"}).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    words = shlex.split(flags)
    return ([word[2:] for word in words if word.startswith("-I")],
            [word[2:] for word in words if word.startswith("-L")])


def folders():
    build = os.environ.get("STYLET_BUILD")
    if build:
        return [str(HERE.parent / "c/include")], [str(pathlib.Path(build).resolve() / "lib")]
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


includes, libraries = folders()
setup(
    version=version(includes),
    ext_modules=[Extension(
        "stylet._stylet", sorted(str(path.relative_to(HERE))
                                 for path in (HERE / "src").glob("*.cpp")),
        include_dirs=[str(HERE.parents[2]), *includes, *pybind11_include()], library_dirs=libraries,
        libraries=["stylet"], runtime_library_dirs=libraries, language="c++",
        extra_compile_args=["-std=c++20", "-fvisibility=hidden", "-ffp-contract=off"])])
