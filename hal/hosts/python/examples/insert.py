#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A needle in an organ, from Python: 20 mm into it at 10 mm/s from above, and the force on the way.

usage: insert.py ORGAN [PICTURE]
"""
import sys

import numpy as np
import stylet

DOWN = (0, 0, -1)

organ = stylet.Organ.read(sys.argv[1])
needle = stylet.Needle(bending_nm2=0.02)
simulation = stylet.Simulation(organ, needle)

# The tip begins 1 mm above the skin, over the middle of the organ. In 32 bits, as insert.c has it:
# so the state has the same bits.
low, high = np.float32(organ.info.low_m), np.float32(organ.info.high_m)
above = (low + high) / 2
above[2] = high[2] + np.float32(0.01)
above[2] -= np.float32(organ.raycast(above, DOWN)) - np.float32(0.001)

tips_m = np.tile(above, (2101, 1))  # a row a millisecond, at 10 mm/s
tips_m[:, 2] -= np.float32(10e-3) * np.float32(1e-3) * np.arange(2101, dtype=np.float32)
outputs = simulation.run(stylet.poses_of_tips(tips_m, DOWN, needle.length_m))

for output in outputs[::100]:
    print(f"{1e3 * output.depth_m:6.2f} mm  {output.force_n[2]:6.3f} N")
print(f"state {simulation.hash():016x}")

if len(sys.argv) > 2:
    import matplotlib
    matplotlib.use("Agg")  # needs no screen
    from matplotlib import pyplot
    pyplot.plot(1e3 * outputs["depth_m"], outputs["force_n"][:, 2])
    pyplot.xlabel("depth of the tip (mm)")
    pyplot.ylabel("force on the hand, upwards (N)")
    pyplot.savefig(sys.argv[2])
