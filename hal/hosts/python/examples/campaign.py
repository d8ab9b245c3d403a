#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Thousands of insertions with drawn needles and ways, in one table; a kill costs a second of them.

usage: campaign.py ORGAN TABLE.h5 [--insertions N] [--seed N] [--workers N | --scheduler-file FILE]
"""
import argparse
import sys

import numpy as np
import stylet

DRAWN = {
    "aside_m": stylet.Normal(0, 0.003, -0.01, 0.01),   # how far the line passes the organ's middle
    "tilt_rad": stylet.Uniform(-0.3, 0.3),             # of the line, against straight down
    "depth_m": stylet.Uniform(0.01, 0.03),
    "speed_m_per_s": stylet.LogUniform(0.01, 0.05),
    "outer_radius_m": stylet.Choice(0.000635, 0.00036),  # 18G, 22G
    "bending_nm2": stylet.LogNormal(0.02, 1.5),
}


def insertion(organ, aside_m, tilt_rad, depth_m, speed_m_per_s, outer_radius_m, bending_nm2):
    """One row: what the hand feels, and where the tip ends up."""
    organ = stylet.kept_organ(organ)
    needle = stylet.Needle(outer_radius_m=outer_radius_m, bending_nm2=bending_nm2)
    way = np.array([np.sin(tilt_rad), 0, -np.cos(tilt_rad)])
    middle_m = np.add(organ.info.low_m, organ.info.high_m) / 2 + [0, aside_m, 0]
    poses = stylet.insertion_poses(organ, needle, middle_m, way, depth_m, speed_m_per_s)
    simulation = stylet.Simulation(organ, needle)
    outputs = simulation.run(poses)
    events = simulation.events()
    broken = events[events["kind"] == stylet.Event.PUNCTURE]
    straight_m = poses[-1, :3] + needle.length_m * way  # where the tip of a rigid needle would be
    return {"peak_force_n": np.linalg.norm(outputs["force_n"], axis=1).max(),
            "puncture_force_n": broken["force_n"][0] if len(broken) else np.nan,
            "end_depth_m": outputs["depth_m"][-1],
            "deflection_m": np.linalg.norm(outputs["tip_m"][-1] - straight_m),
            "flags": np.bitwise_or.reduce(outputs["flags"]), "state": simulation.hash()}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for name in ("organ", "table", "--scheduler-file"):
        parser.add_argument(name)
    for name, default in (("--insertions", 2000), ("--seed", 1), ("--workers", None)):
        parser.add_argument(name, type=int, default=default)
    args = parser.parse_args()
    client = None
    if args.scheduler_file:
        from dask.distributed import Client
        client = Client(scheduler_file=args.scheduler_file)
    rows = {"organ": args.insertions * [args.organ],
            **stylet.draw(DRAWN, args.insertions, args.seed)}
    table = stylet.sweep(insertion, rows, args.workers, client, args.table, {"seed": args.seed},
                         lambda done, of: print(f"\r{done} of {of}", end=" ", file=sys.stderr))
    print(file=sys.stderr)
    peak = table["peak_force_n"]
    print(f"{len(peak)} insertions, {np.count_nonzero(table['error'] != '')} failed; largest force "
          f"{np.nanmean(peak):.2f} N on average, {np.nanmin(peak):.2f} to {np.nanmax(peak):.2f} N")
