#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Figures of the book's page on validation: what the kernel does beside what is published.

usage: figures.py BUILD_FOLDER FOLDER

contact.svg   a needle pressed into a half space beside Sneddon's law (Sneddon 1965), and skins
              beside finite elements (coupling/film.csv)
bands.svg     an insertion into liver beside the bands of published force curves (PHYSICS 17.7)
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD, OUT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path[:0] = [str(BUILD / "python"), str(SOURCE / "tests/e2e"), str(SOURCE / "hal/scenes")]

import h5py
import matplotlib
matplotlib.use("svg")
from matplotlib import pyplot
import numpy as np
import stylet

import force_curve
from draw import OTHERS, PALETTE  # no other line has the colour of a cause of force

BLOCK_MM, SPEED_M_PER_S = 120, 10e-3
NEEDLE = stylet.Needle(outer_radius_m=0.635e-3)  # 18G
# Without relaxation, which the laws do not have, and without puncture unless a figure asks for one.
TISSUE = """[tissue]
source = "figures.py"
density_kg_per_m3 = 1000
youngs_modulus_kpa = {e_kpa}
poisson_ratio = {nu}
relaxing_fraction = 0
relaxation_time_s = 1
puncture_force_n = {puncture_n}
cutting_force_n = 0.1
recut_fraction = 0.1
coulomb_friction_n_per_mm = 0.001
static_friction_n_per_mm = 0.001
stribeck_velocity_mm_per_s = 1
viscous_friction_n_s_per_m2 = 0
membrane_n_per_mm = {membrane_n_per_mm}
"""


def block(folder, voxel_mm, **tissue):
    """A half space: a block held at its bottom and sides."""
    values = {"puncture_n": 50, "membrane_n_per_mm": 0, **tissue}
    (folder / "tissue.toml").write_text(TISSUE.format(**values))
    size_mm = ",".join(3 * [str(BLOCK_MM)])
    subprocess.run([BUILD / "bin/stylet-organ", "phantom", "block", "--size-mm", size_mm,
                    "--voxel-mm", str(voxel_mm), "--tissue", "tissue", "--capsule", "none",
                    "--materials", folder / "tissue.toml", "--fix", "z<5%", "-o",
                    folder / "block.organ"], check=True, stdout=subprocess.DEVNULL)
    return stylet.Organ.read(folder / "block.organ")


def press(organ, depth_m):
    """Depth and force of a needle that is pressed into the middle of the top."""
    info = organ.info
    middle_m = np.add(info.low_m, info.high_m) / 2
    way_m = np.arange(0, depth_m, SPEED_M_PER_S * 1e-3)
    tips_m = np.array([middle_m[0], middle_m[1], info.high_m[2]]) - np.outer(way_m, [0, 0, 1])
    simulation = stylet.Simulation(organ, NEEDLE)
    force_n = simulation.run(stylet.poses_of_tips(tips_m, (0, 0, -1), NEEDLE.length_m))["force_n"]
    return way_m, force_n[:, 2], simulation.events()


def sneddon_n(depth_m, e_pa, nu):
    """PHYSICS 8.1."""
    k = 2 * NEEDLE.outer_radius_m * e_pa / (1 - nu ** 2)
    l = np.pi * NEEDLE.outer_radius_m / (2 * np.tan(NEEDLE.tip_half_angle_rad))
    return np.where(depth_m <= l, k * depth_m ** 2 / (2 * l), k * (depth_m - l / 2))


def draw_sneddon(axes, folder):
    for i, voxel_mm in zip((0, 1, 4), (3, 5, 10)):
        way_m, force_n, _ = press(block(folder, voxel_mm, e_kpa=20, nu=0.45), 12e-3)
        axes.plot(1e3 * way_m, force_n, color=OTHERS[i], lw=1.6,
                  label=f"kernel, voxels of {voxel_mm} mm")
    way_m = np.linspace(0, 12e-3, 13)
    axes.plot(1e3 * way_m, sneddon_n(way_m, 20e3, 0.45), "o", mfc="none", color=PALETTE["total"],
              label="Sneddon 1965")
    axes.set(xlabel="depth of the tip / mm", ylabel="force / N", xlim=(0, 12.5), ylim=0,
             title="18G needle on a half space of 20 kPa")
    axes.legend(frameon=False)


def draw_skins(axes, folder):
    rows = [{key: float(value) for key, value in row.items()}
            for row in csv.DictReader((SOURCE / "tests/fidelity/coupling/film.csv").open())]
    for i, membrane in zip((0, 1, 4, 2), (100.0, 500.0, 2000.0, 5000.0)):
        points = [row for row in rows if row["youngs_pa"] == 20e3 and row["poisson"] == 0.3 and
                  row["membrane_n_per_m"] == membrane and row["depth_m"] >= 1e-3]
        depths_mm = []
        for row in points:  # a skin that gives way at this force: how deep is the dimple then?
            organ = block(folder, 5, e_kpa=20, nu=0.3, puncture_n=row["force_n"],
                          membrane_n_per_mm=1e-3 * membrane)
            way_m, _, events = press(organ, 1.3 * row["depth_m"] + 1e-3)
            at = [event for event in events if event["kind"] == stylet.Event.PUNCTURE]
            depths_mm.append(1e3 * way_m[int(at[0]["tick"]) - 1] if at else np.nan)
        colour = OTHERS[i]
        axes.plot(depths_mm, [row["force_n"] for row in points], "x-", color=colour, lw=1.2,
                  label=f"{1e-3 * membrane:g} N/mm")
        axes.plot([1e3 * row["depth_m"] for row in points], [row["force_n"] for row in points], "o",
                  mfc="none", color=colour)
    axes.plot([], [], "kx-", label="kernel, at puncture")
    axes.plot([], [], "ko", mfc="none", label="finite elements")
    axes.set(xlabel="depth of the dimple / mm", ylabel="force / N", xlim=0, ylim=0,
             title="thin skins on 20 kPa")
    axes.legend(frameon=False)


def bands(folder):
    """(name, unit, low, high, what an insertion into liver gives): PHYSICS 17.7."""
    stylet_organ, program = BUILD / "bin/stylet-organ", BUILD / "bin/stylet"
    organ, recording = folder / "liver.organ", folder / "fig09.h5"
    subprocess.run([stylet_organ, "phantom", "block", "--size-mm", "100,60,60", "--voxel-mm", "5",
                    "--tissue", "liver", "--capsule", "liver_capsule", "-o", organ], check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run([program, "run", SOURCE / "hal/scenes/fig09-force-curve.toml", "--organ", organ,
                    "--fast", "--record", recording], check=True, stdout=subprocess.DEVNULL)
    with h5py.File(recording) as file:
        curve = force_curve.read_curve(file)
    peak_n = curve.force_n[curve.contact:curve.puncture].max()
    way_m = curve.travel_m[curve.puncture]
    after = curve.force_n[curve.puncture:curve.puncture + 50]
    slope, mean_n, ripple_n = force_curve.insertion(curve)
    hold = curve.force_n[curve.hold:curve.retraction]
    decay = hold[0] - hold[-1]
    return [("force of puncture", "N", 0.5, 3, peak_n),
            ("way to it", "mm", 4, 12, 1e3 * way_m),
            ("stiffness before it", "N/m", 50, 200, peak_n / way_m),
            ("fall within 50 ms", "%", 30, 100, 100 * (1 - after.min() / peak_n)),
            ("slope of the insertion", "N/m", 5, 50, slope),
            ("ripple", "% of the mean", 0, 2, 100 * ripple_n / mean_n),
            ("fall in the hold", "%", 20, 60, 100 * decay / hold[0]),
            ("its time constant", "s", 0.3, 3, 1e-3 * np.argmax(hold <= hold[0] - 0.632 * decay))]


def draw_bands(axes, folder):
    rows = bands(folder)
    for i, (name, unit, low, high, value) in enumerate(rows):
        axes.barh(-i, 1, left=0, height=0.45, color=OTHERS[2], alpha=0.4)
        axes.plot((value - low) / (high - low), -i, "o", color=PALETTE["total"])
        axes.text(0, -i + 0.3, f"{low:g}", fontsize=8, ha="center")
        axes.text(1, -i + 0.3, f"{high:g} {unit}", fontsize=8, ha="center")
        axes.text((value - low) / (high - low), -i - 0.42, f"{value:.3g}", fontsize=8, ha="center")
    axes.set(yticks=[-i for i in range(len(rows))], yticklabels=[row[0] for row in rows], xticks=[],
             xlim=(-0.15, 1.25), title="Bands of published force curves, and the kernel (dots)")
    for side in ("top", "right", "bottom", "left"):
        axes.spines[side].set_visible(False)


def main():
    pyplot.rcParams.update({"svg.hashsalt": "stylet", "svg.fonttype": "path", "font.size": 10,
                            "axes.spines.top": False, "axes.spines.right": False})
    metadata = {"Date": None, "Creator": None}
    with tempfile.TemporaryDirectory(prefix="stylet-figures-") as name:
        folder = pathlib.Path(name)
        figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
        draw_sneddon(left, folder)
        draw_skins(right, folder)
        figure.savefig(OUT / "contact.svg", metadata=metadata)
        figure, axes = pyplot.subplots(figsize=(7.5, 4.2), layout="constrained")
        draw_bands(axes, folder)
        figure.savefig(OUT / "bands.svg", metadata=metadata)


if __name__ == "__main__":
    main()
