# SPDX-License-Identifier: Apache-2.0
"""Runs programs that were built for Windows, by wine, in a Windows of the tests' own."""
import os
import shutil

COMPILER = "x86_64-w64-mingw32-g++-posix"
# Neither .NET nor a browser is installed into it, no menu is made, and wine speaks of nothing.
QUIET = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml,winemenubuilder.exe="}


def missing():
    """The first program that is needed and not here, or None."""
    return next((each for each in (COMPILER, "wine") if shutil.which(each) is None), None)


def environment(folder, **more):
    """Its drives and registry lie in `folder`, which the first program fills (12 s)."""
    return {**os.environ, **QUIET, "WINEPREFIX": str(folder), **more}
