#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Halves the voxel, the needle unit or the step of a scene: what does that do to its forces?

    tests/e2e/halving.py [--table FILE] [--small] [SCENE...]

Runs each scene (none named: all in physical mode) as it is and with one of the three halved.
Forces are averaged over 50 ms; their change is the mean length of the difference over the mean
length of the force, punctures included, which move by some milliseconds. Unit and step may change
forces by 2 %, the voxel by 10 %. --table writes what was found as a table; --small leaves out the
halved voxels, which take eight times as long. Programs from STYLET_BIN or build/release/bin. Needs
python3-h5py.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "hal/scenes"))
import play  # noqa: E402

WINDOW_TICKS = 50
BARS = {"voxel": 0.10, "unit": 0.02, "step": 0.02}
PAPER_MODE = {"fig03-puncture"}  # its rules go by voxel and unit
HEAD = """\
# What halving does to the forces of the scenes

Written by `tests/e2e/halving.py --table tests/e2e/halving.md`: mean change of the force, averaged
over 50 ms, in per cent of its mean, when the voxel, the needle's unit or the step is halved; the
largest force for scale. Unit and step: at most 2. The voxel: below 10, and above 2 where a dimple
some voxels deep presses tissue to a fraction of its length (finer voxels are softer there), or
where layers are a voxel thick (liver-biopsy).

| scene | largest force, N | voxel | unit | step |
| --- | --- | --- | --- | --- |
"""


def halved(text, variant):
    """The scene with its needle unit or its step halved."""
    if variant == "unit":
        units = re.findall(r"^unit_mm = ([\d.]+)$", text, re.M)
        if units:
            return re.sub(r"^unit_mm = ([\d.]+)$", lambda m: f"unit_mm = {float(m[1]) / 2:g}", text,
                          flags=re.M)
        return re.sub(r"^(gauge = .*)$", r"\1\nunit_mm = 2.5", text, flags=re.M)
    if variant == "step":
        if re.search(r"^substeps = \d+$", text, re.M):
            return re.sub(r"^substeps = (\d+)$", lambda m: f"substeps = {2 * int(m[1])}", text,
                          flags=re.M)
        if re.search(r"^\[loop\]$", text, re.M):
            return re.sub(r"^\[loop\]$", "[loop]\nsubsteps = 4", text, flags=re.M)
        return text + "\n[loop]\nsubsteps = 4\n"
    return text


def organ_of(name, variant, folder):
    words = play.organ_words(name)
    if variant == "voxel":
        at = words.index("--voxel-mm") + 1
        words[at] = f"{float(words[at]) / 2:g}"
    organ = folder / f"{name}{'-fine' if variant == 'voxel' else ''}.organ"
    if not organ.exists():
        play.call([*words, "-o", organ])
    return organ


def forces(name, variant, folder):
    """Mean force of every 50 ms, of the first needle."""
    organ = organ_of(name, variant, folder)
    scene = folder / f"{name}-{variant}.toml"
    scene.write_text(halved((play.HERE / f"{name}.toml").read_text(), variant))
    recording = folder / "run.h5"
    recording.unlink(missing_ok=True)
    play.run(scene, organ, recording)
    with h5py.File(recording) as file:
        force = np.asarray(file["output/force_n"], float)
    count = len(force) // WINDOW_TICKS
    return force[:count * WINDOW_TICKS].reshape(count, WINDOW_TICKS, 3).mean(axis=1)


def measure(name, variants, folder):
    """Largest force, and variant -> share by which the forces change."""
    base = forces(name, "base", folder)
    size = np.linalg.norm(base, axis=1)
    found = {}
    for variant in variants:
        other = forces(name, variant, folder)
        count = min(len(base), len(other))
        change = np.linalg.norm(base[:count] - other[:count], axis=1)
        found[variant] = float(change.mean() / size.mean())
    return float(size.max()), found


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--small", action="store_true")
    parser.add_argument("scenes", nargs="*")
    wanted = parser.parse_args()
    names = wanted.scenes or [n for n in play.scene_names() if n not in PAPER_MODE]
    variants = [v for v in BARS if not (wanted.small and v == "voxel")]
    rows, failed = [], []
    with tempfile.TemporaryDirectory() as top:
        for name in names:
            try:
                largest, found = measure(name, variants, pathlib.Path(top))
            except play.DataMissing as missing:
                print(f"{name}: skipped: {missing}")
                continue
            cells = [f"{100 * found[v]:.1f}" if v in found else "" for v in BARS]
            rows.append(f"| {name} | {largest:.2f} | {' | '.join(cells)} |\n")
            print(f"{name}: " + ", ".join(f"{v} {100 * s:.1f} %" for v, s in found.items()),
                  flush=True)
            failed += [f"{name}: {v} halved: forces change by {100 * s:.1f} %, at most "
                       f"{100 * BARS[v]:.0f} %" for v, s in found.items() if s > BARS[v]]
    if wanted.table:
        wanted.table.write_text(HEAD + "".join(rows))
    print("\n".join(failed) if failed else "all within their bars")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
