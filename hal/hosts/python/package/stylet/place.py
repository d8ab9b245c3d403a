# SPDX-License-Identifier: Apache-2.0
"""Where the rest of Stylet lies: programs, scenes, phantoms."""
import importlib
import pathlib
import shutil
import sys

from stylet import _stylet


def prefixes() -> list[pathlib.Path]:
    """Folders below which it may lie: that which this package is installed in, or of a build, from
    which `build/python/stylet` and `PREFIX/lib/python3/dist-packages/stylet` are so far away; that
    which pip built the package over; else, as in an environment of its own, where Debian has it."""
    here = pathlib.Path(_stylet.__file__).parent
    tops = [here.parents[up] for up in (1, 3) if up < len(here.parents)]
    try:
        tops.append(pathlib.Path(importlib.import_module("stylet._prefix").PREFIX))
    except ModuleNotFoundError:  # only pip writes it
        pass
    return [*tops, pathlib.Path(sys.base_prefix)]


def program() -> str | None:
    """The program stylet; None: it is not installed."""
    beside = [top / "bin/stylet" for top in prefixes()]
    return next((str(path) for path in beside if path.is_file()), None) or shutil.which("stylet")
