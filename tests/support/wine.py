# SPDX-License-Identifier: Apache-2.0
"""Runs programs that were built for Windows, by wine, in a Windows folder of the tests' own."""
import os
import shutil

COMPILER = "x86_64-w64-mingw32-g++-posix"
# Neither .NET nor a browser is installed into it, no menu is made, and wine prints nothing.
QUIET = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml,winemenubuilder.exe="}


def missing():
    """The first program that is needed and missing, or None."""
    return next((each for each in (COMPILER, "wine") if shutil.which(each) is None), None)


def environment(folder, **more):
    """Its drives and registry are in `folder`, which is filled when the first program runs (12
    s)."""
    return {**os.environ, **QUIET, "WINEPREFIX": str(folder), **more}
