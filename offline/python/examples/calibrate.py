#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Young's modulus, puncture force and friction of a tissue from a published force curve; then once
more for tissue that stiffens with its strain. How it stiffens and its modulus at rest make up for
each other: the intervals of these two are too narrow, which those of a profile would not be.

usage: calibrate.py [PICTURE]

The curve: Okamura, Simone and O'Leary 2004 (doi 10.1109/TBME.2004.831542): an 18G bevelled needle
at 3 mm/s in bovine tissue ex vivo. Means over each millimetre, to 0.01 N, of somebody's trace of
the paper's figure, from the first contact, as we see it at 9 mm, through the first puncture."""
import sys

import numpy as np
import stylet
import stylet_organ

PUBLISHED_N = np.array([0.03, 0.07, 0.11, 0.17, 0.25, 0.36, 0.46, 0.63, 0.92, 1.21, 0.50, 0.29,
                        0.33, 0.35, 0.39, 0.47, 0.52])
RANGES = {"youngs_modulus_pa": (3e4, 3e5), "puncture_force_n": (.3, 3), "friction_n_per_m": (5, 50)}
STIFFENING = {**RANGES, "youngs_modulus_pa": (5e3, 3e5), "strain_stiffening": (0.5, 100)}
NEEDLE, SPEED_M_PER_S = stylet.Needle(outer_radius_m=0.635e-3), 3e-3  # 18G
BLOCK, EDGE_M = np.ones((8, 8, 8), np.uint8), 7.5e-3                  # 60 mm


def organ_of(youngs_modulus_pa, puncture_force_n, friction_n_per_m, strain_stiffening=0):
    """The block: liver, except for these numbers; it sticks with a fifth more than it slides."""
    tissue = {**stylet_organ.TISSUES["liver"], "youngs_modulus_kpa": 1e-3 * youngs_modulus_pa,
              "puncture_force_n": puncture_force_n, "strain_stiffening": strain_stiffening,
              "coulomb_friction_n_per_mm": 1e-3 * friction_n_per_m,
              "static_friction_n_per_mm": 1.2e-3 * friction_n_per_m}
    return stylet_organ.from_labels(BLOCK, {1: "tissue"}, spacing_m=3 * [EDGE_M], fix="z<10%",
                                    voxel_edge_m=EDGE_M, materials={"tissue": tissue}).organ


def curves(points, speed_m_per_s=SPEED_M_PER_S, millimetres=len(PUBLISHED_N)):
    """Mean force over each millimetre of the way from the surface on, for each of the points."""
    runs = [stylet.Simulation(organ_of(**point), NEEDLE) for point in points]
    middle_m = np.add(runs[0].organ.info.low_m, runs[0].organ.info.high_m) / 2
    poses = stylet.insertion_poses(runs[0].organ, NEEDLE, middle_m, (0, 0, -1), 1e-3 * millimetres,
                                   speed_m_per_s, before_m=1e-3)
    forces_n = stylet.VectorSimulation(runs).run(np.tile(poses, (len(runs), 1, 1)))["force_n"]
    millimetre = np.floor((poses[0, 2] - poses[:, 2]) / 1e-3).astype(int) - 1
    return [[each[millimetre == i, 2].mean() for i in range(millimetres)] for each in forces_n]


if __name__ == "__main__":
    fits = [stylet.fit(curves, ranges, PUBLISHED_N) for ranges in (RANGES, STIFFENING)]
    for found in fits:
        print(f"{found}\nthe model is {found.sigma:.2f} N off the curve")
    if len(sys.argv) > 1:
        from matplotlib import pyplot
        way_mm = np.arange(len(PUBLISHED_N)) + 0.5
        pyplot.plot(way_mm, PUBLISHED_N, "ko", mfc="none")
        pyplot.plot(way_mm, PUBLISHED_N - fits[0].residuals, "#999999", ls="--")
        pyplot.plot(way_mm, PUBLISHED_N - fits[1].residuals, "#882255")
        pyplot.gca().set(xlabel="way from the first contact (mm)", ylabel="force on the needle (N)")
        pyplot.legend(["published (Okamura et al. 2004)", "fitted, linear tissue",
                       "fitted, tissue that stiffens"], frameon=False)
        pyplot.savefig(sys.argv[1])
