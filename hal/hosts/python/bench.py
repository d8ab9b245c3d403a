#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What Python costs: the overhead of a call, and voxel-substeps a second of many simulations.

usage: bench.py ORGAN [SMALL_ORGAN] [--simulations N] [--threads N]

    stylet-organ phantom liver --voxel-mm 5 -o liver.organ                   # 10702 voxels
    stylet-organ phantom block --size-mm 10,10,10 --voxel-mm 5 -o small.organ
    hal/hosts/python/bench.py liver.organ small.organ

The overhead is that of `tick` over the same ticks in one `run`, in the small organ, where it shows.
"""
import argparse
import os
import pathlib
import platform
import time

import numpy as np
import stylet

REPEATS = 9  # of each measurement; other programs only add to a time, so the least counts
CALLS = 2000
TICKS = 50  # of a call of the batch
# A substep of true mass is several passes over the voxels (kernel/PHYSICS.md).
CONFIGS = {"true mass": stylet.Config(),
           "added mass": stylet.Config(inertia="added_mass", substeps=2)}


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def least_s(act, clock):
    times = []
    for _ in range(REPEATS):
        start = clock()
        act()
        times.append(clock() - start)
    return min(times)


def insertion(organ, ticks):
    """Poses of a needle that goes 30 mm in from above the middle."""
    info = organ.info
    top_m = [*np.add(info.low_m, info.high_m)[:2] / 2, info.high_m[2]]
    tips_m = np.subtract(top_m, np.outer(np.linspace(0, 0.03, ticks), [0, 0, 1]))
    return stylet.poses_of_tips(tips_m, (0, 0, -1), stylet.Needle().length_m)


def calls_us(organ):
    """Time of a tick that is one call, and of the same in a run of many."""
    simulation = stylet.Simulation(organ)
    poses = insertion(organ, CALLS)
    out = np.empty(CALLS, stylet.output_dtype)

    def each():
        for pose in poses:
            simulation.tick(pose)

    def bare():
        for pose in poses:
            pass

    def together():
        simulation.run(poses, out=out)
    # A thread's own time is not that in which others had the processor.
    each_s, bare_s, together_s = (least_s(act, time.thread_time) for act in (each, bare, together))
    return 1e6 * (each_s - bare_s) / CALLS, 1e6 * together_s / CALLS


def voxel_substeps_per_s(organ, config, count, threads):
    """By the clock, and in a second of one processor's time."""
    simulations = [stylet.Simulation(organ, config=config) for _ in range(count)]
    vector = stylet.VectorSimulation(simulations, threads)
    poses = np.tile(insertion(organ, TICKS), (count, 1, 1))
    out = np.empty((count, TICKS), stylet.output_dtype)
    work = organ.info.voxels * count * TICKS * config.substeps
    return [work / least_s(lambda: vector.run(poses, out=out), clock)
            for clock in (time.perf_counter, time.process_time)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("organ")
    parser.add_argument("small_organ", nargs="?")
    parser.add_argument("--simulations", type=int, default=16)
    parser.add_argument("--threads", type=int, default=0, help="0: one for each processor")
    arguments = parser.parse_args()
    print(f"{processor()}, {os.cpu_count()} processors; stylet {stylet.version()}, "
          f"{stylet.build()}; Python {platform.python_version()}, numpy {np.__version__}")
    if arguments.small_organ:
        one_us, many_us = calls_us(stylet.Organ.read(arguments.small_organ))
        print(f"tick {one_us:.2f} us, in a run {many_us:.2f} us: overhead of a call "
              f"{one_us - many_us:.2f} us")
    organ = stylet.Organ.read(arguments.organ)
    print(f"{arguments.simulations} simulations of {organ.info.voxels} voxels, M voxel-substeps/s:")
    for words, config in CONFIGS.items():
        rates = voxel_substeps_per_s(organ, config, arguments.simulations, arguments.threads)
        print(f"  {words}: {rates[0] / 1e6:.0f}; of one processor's time {rates[1] / 1e6:.0f}")


if __name__ == "__main__":
    main()
