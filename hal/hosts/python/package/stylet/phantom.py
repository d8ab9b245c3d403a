# SPDX-License-Identifier: Apache-2.0
"""The phantoms that stylet-organ has made, and that are installed with Stylet's programs."""
import pathlib

from stylet._stylet import Organ
from stylet.place import prefixes

ENDING = "-phantom.organ"


def folders() -> list[pathlib.Path]:
    return [top / "share/stylet/organs" for top in prefixes()]


def phantom(name: str) -> Organ:
    """The organ of a phantom by its name: "liver", of 5 mm voxels, the organ of the scene
    fig09-force-curve. Those of other sizes and kinds: `stylet-organ phantom`."""
    if not isinstance(name, str):
        raise TypeError(f"name of {type(name).__name__}: expected a text, such as \"liver\"")
    known: set[str] = set()
    for folder in folders():
        path = folder / (name + ENDING)
        if path.is_file():
            return Organ.read(path)
        known |= {each.name.removesuffix(ENDING) for each in folder.glob("*" + ENDING)}
    if known:
        raise ValueError(f"phantom {name!r}: expected one of {sorted(known)}")
    raise FileNotFoundError(f"phantom {name!r}: not in {', '.join(map(str, folders()))}; they come "
                            "with the programs (Debian: package stylet); or make it: stylet-organ "
                            f"phantom {name} -o {name}.organ, which Organ.read reads")
