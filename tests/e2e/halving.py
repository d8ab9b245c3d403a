#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How the forces of a scene change when the voxel, the needle unit or the step is halved.

    tests/e2e/halving.py [--table FILE] [--small] [--swings] [SCENE...]

Runs each scene (none named: all in physical mode) as it is and with one of the three halved.
Forces are averaged over 50 ms; their change is the mean length of the difference over the mean
length of the force, punctures included, which move by some milliseconds. Unit and step may change
forces by 2 %, the voxel by 10 %. --table writes what was found as a table; --small leaves out the
halved voxels, which take eight times as long.

Then, in some scenes, the hand goes in as deep as in the scene, rests, and swings to and fro across
the needle by 1 mm, slowly and faster, once with added mass and once with true mass. The force along
the swing at its frequency, divided by the way, is compared as a complex number, in the second half
of each swing and without slow drift. --swings runs only this part. It has no bars: PHYSICS 3.3 says
what a longer step with added mass does to a moving hand. Programs from STYLET_BIN or
build/release/bin. Needs python3-h5py.
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
PAPER_MODE = {"fig03-puncture"}  # its rules depend on voxel and unit
# Scenes whose hand swings, and how: Hz -> for how long, at least two periods and a second.
SWUNG = ("fig06-clamping", "fig07-liver-flexible", "fig08-liver-rigid", "liver-biopsy",
         "lumbar-puncture")
INERTIAS = ("added_mass", "true_mass")
SWINGS_S = {0.5: 4, 2: 1, 4: 1, 8: 1}
SWING_MM, PIECES, IN_S, REST_S = 1, 16, 4, 0.5
HEAD = """\
# What halving does to the forces of the scenes

Written by `tests/e2e/halving.py --table tests/e2e/halving.md`. The table has the mean change of
the force, averaged over 50 ms, in per cent of its mean, when the voxel, the needle's unit or the
step is halved, and the largest force for scale. For the unit and the step the change is at most 2.
For the voxel it is below 10; it is above 2 where a dimple some voxels deep presses tissue to a
fraction of its length (finer voxels are softer there), or where layers are as thin as a voxel
(liver-biopsy).

| scene | largest force, N | voxel | unit | step |
| --- | --- | --- | --- | --- |
"""
SWING_HEAD = """
## The same where the hand swings

Here the hand swings by 1 mm across the needle where the scene is deepest. The table has the change,
in per cent, of the force along the swing divided by the hand's displacement, when the voxel, the
unit or the step is halved. This ratio is a complex number, so a change of phase counts as well.
With `added_mass` half the step or half the voxel adds another mass, which a fast hand feels. The
first resonance of fig08's liver, as its run reports it, is between 4 and 8 Hz with true mass; there
a small change of stiffness changes the phase much.

| scene | inertia | """ + " | ".join(f"{hz} Hz: voxel, unit, step" for hz in SWINGS_S) + """ |
| --- | --- | """ + " | ".join("---" for _ in SWINGS_S) + """ |
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
        half = "substeps = 4" if 'inertia = "added_mass"' in text else "substeps = 2"  # of 2, of 1
        if re.search(r"^\[loop\]$", text, re.M):
            return re.sub(r"^\[loop\]$", f"[loop]\n{half}", text, flags=re.M)
        return text + f"\n[loop]\n{half}\n"
    return text


def swung(text, inertia):
    """The scene with this inertia of the tissue, and with a hand that goes in, rests and swings."""
    deep = max(float(each) for each in re.findall(r"^travel_mm = (-?[\d.]+)$", text, re.M))
    text = re.sub(r"^\[\[hand\.waypoint\]\]\n(?:\w.*\n?)*", "", text, flags=re.M)
    text = re.sub(r"^(mass_g|(?:stiffness|damping)_n\w+) = .*\n", "", text, flags=re.M)
    firm = "mass_g = 100\nstiffness_n_per_m = 1e6\ndamping_n_s_per_m = 400\n"
    text = text.replace("[hand]\n", "[hand]\n" + firm)
    loop = f'[loop]\ninertia = "{inertia}"\n'
    text = text.replace("[loop]\n", loop) if "[loop]\n" in text else text + "\n" + loop
    points = [f"travel_mm = {deep}\ntime_s = {IN_S}\nhold_s = {REST_S}"]
    for hz, long_s in SWINGS_S.items():
        for i in range(1, round(long_s * hz * PIECES) + 1):
            aside = SWING_MM * np.sin(2 * np.pi * i / PIECES)
            points.append(f"lateral_mm = [0, {aside:.6f}]\ntime_s = {1 / (hz * PIECES):.9f}")
        points.append(f"hold_s = {REST_S}")
    return text + "".join(f"\n[[hand.waypoint]]\n{each}\n" for each in points)


def swinging(recording):
    """Hz -> force along the swing divided by the way, N/m, complex, from the second half of that
    swing."""
    with h5py.File(recording) as file:
        force = np.asarray(file["output/force_n"], float)
        place = np.asarray(file["input/position_m"], float)
    found, begin_s = {}, IN_S + REST_S
    for hz, long_s in SWINGS_S.items():
        part = slice(round(1000 * (begin_s + long_s / 2)), round(1000 * (begin_s + long_s)))
        t = np.arange(part.stop - part.start) * 1e-3
        turns = 2 * np.pi * hz * t
        waves = np.stack([np.ones_like(t), t, np.cos(turns), np.sin(turns)], axis=1)
        of_force, of_place = (
            np.array([1, -1j]) @ np.linalg.lstsq(waves, each[part], rcond=None)[0][2:]
            for each in (force, place))
        found[hz] = (of_force @ of_place.conj()) / (of_place @ of_place.conj())
        begin_s += long_s + REST_S
    return found


def organ_of(name, variant, folder):
    words = play.organ_words(name)
    if variant == "voxel":
        at = words.index("--voxel-mm") + 1
        words[at] = f"{float(words[at]) / 2:g}"
    organ = folder / f"{name}{'-fine' if variant == 'voxel' else ''}.organ"
    if not organ.exists():
        play.call([*words, "-o", organ])
    return organ


def played(name, text, variant, folder):
    """The recording of a scene with this text."""
    organ = organ_of(name, variant, folder)
    scene = folder / f"{name}-{variant}.toml"
    scene.write_text(halved(text, variant))
    recording = folder / "run.h5"
    recording.unlink(missing_ok=True)
    play.run(scene, organ, recording)
    return recording


def forces(name, variant, folder):
    """Mean force of every 50 ms, of the first needle."""
    text = (play.HERE / f"{name}.toml").read_text()
    with h5py.File(played(name, text, variant, folder)) as file:
        force = np.asarray(file["output/force_n"], float)
    count = len(force) // WINDOW_TICKS
    return force[:count * WINDOW_TICKS].reshape(count, WINDOW_TICKS, 3).mean(axis=1)


def measure(name, variants, folder):
    """Largest force, and variant -> fraction by which the forces change."""
    base = forces(name, "base", folder)
    size = np.linalg.norm(base, axis=1)
    found = {}
    for variant in variants:
        other = forces(name, variant, folder)
        count = min(len(base), len(other))
        change = np.linalg.norm(base[:count] - other[:count], axis=1)
        found[variant] = float(change.mean() / size.mean())
    return float(size.max()), found


def measure_swings(name, inertia, variants, folder):
    """Hz -> variant -> fraction by which the force along the swing changes."""
    text = swung((play.HERE / f"{name}.toml").read_text(), inertia)
    base = swinging(played(name, text, "base", folder))
    found = {hz: {} for hz in SWINGS_S}
    for variant in variants:
        for hz, other in swinging(played(name, text, variant, folder)).items():
            found[hz][variant] = float(abs(other - base[hz]) / abs(base[hz]))
    return found


def swing_rows(names, variants, folder):
    """The second table's."""
    rows = []
    for name in (each for each in SWUNG if each in names):
        for inertia in INERTIAS:
            try:
                found = measure_swings(name, inertia, variants, folder)
            except play.DataMissing as missing:
                print(f"{name}: skipped: {missing}")
                continue
            cells = [", ".join(f"{100 * found[hz][v]:.1f}" if v in found[hz] else "-" for v in BARS)
                     for hz in SWINGS_S]
            rows.append(f"| {name} | {inertia} | {' | '.join(cells)} |\n")
            print(rows[-1], end="", flush=True)
    return rows


def measure_all(names, variants, folder):
    """The first table's rows, and the changes that are larger than allowed."""
    rows, failed = [], []
    for name in names:
        try:
            largest, found = measure(name, variants, folder)
        except play.DataMissing as missing:
            print(f"{name}: skipped: {missing}")
            continue
        cells = [f"{100 * found[v]:.1f}" if v in found else "" for v in BARS]
        rows.append(f"| {name} | {largest:.2f} | {' | '.join(cells)} |\n")
        print(f"{name}: " + ", ".join(f"{v} {100 * s:.1f} %" for v, s in found.items()),
              flush=True)
        failed += [f"{name}: {v} halved: forces change by {100 * s:.1f} %, at most "
                   f"{100 * BARS[v]:.0f} %" for v, s in found.items() if s > BARS[v]]
    return rows, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--swings", action="store_true")
    parser.add_argument("scenes", nargs="*")
    wanted = parser.parse_args()
    names = wanted.scenes or [n for n in play.scene_names() if n not in PAPER_MODE]
    variants = [v for v in BARS if not (wanted.small and v == "voxel")]
    with tempfile.TemporaryDirectory() as top:
        folder = pathlib.Path(top)
        rows, failed = ([], []) if wanted.swings else measure_all(names, variants, folder)
        swings = swing_rows(names, variants, folder)
    if wanted.table:
        wanted.table.write_text(HEAD + "".join(rows) + SWING_HEAD + "".join(swings))
    print("\n".join(failed) if failed else "all within their bars")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
