#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table in docs/quality.md, measured: builds every mesh of the shared data at 5 mm, and a map.

usage: figures.py [--check] STYLET_ORGAN DATA

Writes the table between the marks of that page. --check writes nothing and fails,
naming each, where a figure that does not depend on the machine is another one: voxels, volumes,
deviation, bytes, triangles. Times and memory are those of the last run without --check.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PAGE = pathlib.Path(__file__).parent / "docs/quality.md"
RECIPES = pathlib.Path(__file__).parent / "recipes"
BEGIN, END = "<!-- measured: offline/figures.py -->\n", "<!-- end of measured -->\n"
# Units from the data's README; if it has none, those that give the organ its natural size.
MESHES = {"openhelp_Liver.stl": ("mm", 1), "openhelp_Abdominal_wall.stl": ("mm", 1),
          "openhelp_Kidney_left.stl": ("mm", 1), "openhelp_Pancreas.stl": ("mm", 1),
          "openhelp_Spleen.stl": ("mm", 1), "openhelp_Stomach.stl": ("mm", 1),
          "sofa_liver.obj": ("cm", 3), "sofa_liver-smooth.obj": ("cm", 3),
          "sofa_pelvis_f.obj": ("dm", 1), "sofa_aneurysm3D_1.off": ("mm", 1),
          "sofa_tongue.obj": ("cm", 3), "sofaenv_tissue_slab.obj": ("m", 1),
          "cgal_femur.off": ("dm", 4), "sofa_teeth_demo.obj": ("cm", 1),
          "sofaenv_organs_cut_open.stl": ("mm", 1)}
HEAD = ["file", "triangles", "voxels", "mesh volume", "deviation", "lattice bytes per voxel",
        "processor time", "peak memory"]
FIXED = len(HEAD) - 2  # columns that no machine changes
FINE = "openhelp_Liver.stl"  # at 1 mm, too
MAP = "ts_example_seg.nii.gz"


def built(tool, arguments):
    """The report of the build, its processor time in seconds, and its memory in MiB."""
    with tempfile.TemporaryDirectory() as folder:
        command = [tool, "build", *arguments, "-o", f"{folder}/a.organ", "--json"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as work:
            text = work.stdout.read()
            _, status, used = os.wait4(work.pid, 0)
            work.returncode = os.waitstatus_to_exitcode(status)
        if work.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: ended with {work.returncode}")
        return json.loads(text), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def mesh_rows(tool, data):
    for name, (unit, scale), voxel_mm in [
            *((name, units, 5) for name, units in MESHES.items()), (FINE, MESHES[FINE], 1)]:
        facts, seconds, mib = built(tool, [data / "organs" / name, "--units", unit, "--scale",
                                           str(scale), "--voxel-mm", str(voxel_mm)])
        mesh, organ = facts["inputs"][0], facts["organ"]
        off = organ["volume_ml"] / mesh["mesh_volume_ml"] - 1
        yield [name if voxel_mm == 5 else f"{name} at {voxel_mm} mm", str(mesh["triangles"]),
               str(organ["voxels"]),
               f"{mesh['mesh_volume_ml']:.4g} ml", f"{100 * off:+.3f} %",
               f"{organ['bytes']['lattice_per_voxel']:.2f}", f"{seconds:.2f} s", f"{mib:.0f} MiB"]


def map_rows(tool, data):
    with tempfile.TemporaryDirectory() as folder:
        for recipe, triangles in (("as it is", None), ("with `triangles = 30000`", 30000)):
            text = (RECIPES / "totalsegmentator.toml").read_text(encoding="utf-8")
            if triangles:
                surface = f"[surface]\ntriangles = {triangles}\n"
                text = re.sub(r"(?m)^\[surface\]\n", surface, text) if "[surface]" in text else \
                    text + "\n" + surface
            path = pathlib.Path(folder) / "totalsegmentator.toml"
            path.write_text(text, encoding="utf-8")
            facts, seconds, mib = built(tool, [data / "labelmaps" / MAP, "--recipe", path,
                                               "--voxel-mm", "5"])
            organ = facts["organ"]
            labels_ml = sum(each["map_volume_ml"] for each in facts["labels"])
            yield [f"{MAP} {recipe}", str(organ["surface_triangles"]), str(organ["voxels"]),
                   f"{labels_ml:.4g} ml", f"{100 * (organ['volume_ml'] / labels_ml - 1):+.3f} %",
                   f"{organ['bytes']['lattice_per_voxel']:.2f}", f"{seconds:.2f} s",
                   f"{mib:.0f} MiB"]


def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def rows_in(text):
    rows = [[cell.strip() for cell in each.strip("|\n").split("|")] for each in
            text.splitlines() if each.startswith("|")]
    return {row[0]: row for row in rows[2:]}


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    tool, data = (pathlib.Path(each) for each in arguments[check:])
    data = pathlib.Path(os.environ.get("STYLET_DATA", data))
    if not data.exists():
        print(f"{data} is not there (set STYLET_DATA)")
        sys.exit(77)  # a test that is skipped
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    written, after = rest.split(END)
    rows = [*mesh_rows(tool, data), *map_rows(tool, data)]
    if check:
        there = rows_in(written)
        stale = [f"{row[0]}: {there.get(row[0], ['nothing'])[1:FIXED]} are {row[1:FIXED]} now"
                 for row in rows if there.get(row[0], [])[:FIXED] != row[:FIXED]]
        stale += [f"{name}: is not measured" for name in there.keys() - {row[0] for row in rows}]
        sys.exit("\n".join([f"{PAGE}: stale; run offline/figures.py {tool} {data}", *stale])
                 if stale else 0)
    table = line(HEAD) + line(["---"] * len(HEAD)) + "".join(map(line, rows))
    PAGE.write_text(before + BEGIN + table + END + after, encoding="utf-8")


if __name__ == "__main__":
    main()
