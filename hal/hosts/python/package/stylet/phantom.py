# SPDX-License-Identifier: Apache-2.0
"""The phantoms that are installed with Stylet's programs, ready made by stylet-organ."""
import pathlib
import sys

from stylet import _stylet

ENDING = "-phantom.organ"


def folders():
    """Where they may lie: below the prefix that this package is installed in, or the folder of a
    build, from which `build/python/stylet` and `PREFIX/lib/python3/dist-packages/stylet` are so far
    away; else, as in an environment of its own, where Debian has them."""
    here = pathlib.Path(_stylet.__file__).parent
    tops = [*(here.parents[up] for up in (1, 3) if up < len(here.parents)), sys.base_prefix]
    return [pathlib.Path(top, "share/stylet/organs") for top in tops]


def phantom(name):
    """The organ of a phantom by its name: "liver", of 5 mm voxels, the organ of the scene
    fig09-force-curve. Those of other sizes and kinds: `stylet-organ phantom`."""
    if not isinstance(name, str):
        raise TypeError(f"name of {type(name).__name__}: expected a text, such as \"liver\"")
    known = set()
    for folder in folders():
        path = folder / (name + ENDING)
        if path.is_file():
            return _stylet.Organ.read(path)
        known |= {each.name.removesuffix(ENDING) for each in folder.glob("*" + ENDING)}
    if known:
        raise ValueError(f"phantom {name!r}: expected one of {sorted(known)}")
    raise FileNotFoundError(f"phantom {name!r}: not in {', '.join(map(str, folders()))}; they come "
                            "with the programs (Debian: package stylet); or make it: stylet-organ "
                            f"phantom {name} -o {name}.organ, which Organ.read reads")
