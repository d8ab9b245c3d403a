#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Organ files with the same voxels have the same bytes, whichever compiler built stylet-organ.

usage: two_compilers.py STYLET_ORGAN SOURCE BUILD_FOLDER [OTHER_STYLET_ORGAN]

Builds a second stylet-organ with the preset clang in BUILD_FOLDER, unless one is given, makes
organs with both and compares: phantoms, meshes of the repository, and real and broken ones of the
shared data (those are left out, and that is said, where the data is missing).
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def build_other(source, folder):
    for command in (
            ["cmake", "--preset", "clang", "-S", source, "-B", folder],
            ["cmake", "--build", folder, "--target", "stylet-organ"]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}\ntwo_compilers.py: {' '.join(map(str, command))} failed")
    return folder / "bin" / "stylet-organ"


def cases(source):
    """(name, arguments of stylet-organ) of every organ made."""
    yield "liver phantom", ["phantom", "liver"]
    yield "ball", ["phantom", "ball", "--voxel-mm", "4"]
    yield "layers", ["phantom", "layered", "--layer", "skin:5", "--layer", "fat:10", "--layer",
                     "liver:85"]
    tumour = source / "hal" / "scenes" / "liver-biopsy-tumour.off"
    yield "tumour", ["build", tumour, "--units", "mm", "--voxel-mm", "1"]
    yield "tumour, wrapped", ["build", tumour, "--units", "mm", "--voxel-mm", "1", "--wrap"]
    data = pathlib.Path(os.environ.get("STYLET_DATA", source.parent / "shared" / "data"))
    if not data.is_dir():
        print(f"{data}: missing (set STYLET_DATA); its meshes are left out")
        return
    readers = (source / "offline" / "src" / "meshes" / "readers.inc").read_text()
    endings = ["." + each for each in re.findall(r"^STYLET_MESH_READER\((\w+),", readers, re.M)]
    for folder in ("organs", "broken"):
        for mesh in sorted((data / folder).iterdir()):
            if mesh.suffix in endings:
                yield mesh.name, ["build", mesh, "--voxels-across", "40"]
    liver = data / "organs" / "sofa_liver.obj"
    yield "two meshes", ["build", f"{liver}:liver", f"{tumour}:tumour:1", "--voxels-across", "50"]


def made(program, arguments, folder):
    """(exit code, bytes of the organ or the refusal)"""
    organ = pathlib.Path(folder) / "a.organ"
    organ.unlink(missing_ok=True)
    done = subprocess.run([program, *arguments, "-o", organ], capture_output=True, text=True,
                          check=False)
    return done.returncode, organ.read_bytes() if organ.exists() else done.stderr


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit("usage: two_compilers.py STYLET_ORGAN SOURCE BUILD_FOLDER [OTHER_STYLET_ORGAN]")
    first, source, folder = (pathlib.Path(each).resolve() for each in sys.argv[1:4])
    second = pathlib.Path(sys.argv[4]) if len(sys.argv) == 5 else build_other(source, folder)
    organs = refusals = 0
    different = []
    with tempfile.TemporaryDirectory() as scratch:
        for name, arguments in cases(source):
            one, other = (made(program, arguments, scratch) for program in (first, second))
            organs += one[0] == 0
            refusals += one[0] != 0
            if one != other:
                different.append(name)
    print(f"{organs} organs and {refusals} refusals compared")
    for name in different:
        print(f"{name}: the two programs differ")
    sys.exit(1 if different or organs == 0 else 0)


if __name__ == "__main__":
    main()
