# SPDX-License-Identifier: Apache-2.0
"""What a check needs of the build."""
import pathlib
import sys


def target_of(path):
    """What CMake calls a program or library: libNAME.a is NAME."""
    path = pathlib.Path(path)
    return path.stem.removeprefix("lib") if path.suffix == ".a" else path.name


def require(*paths):
    """Ends the check with one line if something of the build is not there yet."""
    missing = [target_of(path) for path in paths if not pathlib.Path(path).exists()]
    if len(missing) > 3:
        sys.exit(f"{len(missing)} programs are not built yet: cmake --build BUILD_FOLDER first")
    if missing:
        sys.exit(f"{', '.join(missing)}: not built yet: "
                 f"cmake --build BUILD_FOLDER --target {' '.join(missing)} first")
