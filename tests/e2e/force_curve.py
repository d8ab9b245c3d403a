# SPDX-License-Identifier: Apache-2.0
"""The force curve of an insertion, hold and retraction, held against what is known of real ones.

Six phases: rise, puncture, insertion, hold, retraction, exit. Bands: forces of 18G needles in liver
from the literature (Okamura, Simone and O'Leary 2004 and others), for 60 mm at 10 mm/s and 3 s of
hold. `force_n` is along the needle, positive where the hand is pushed back.
"""
import dataclasses

import numpy as np

CONTACT, RELEASE, PUNCTURE, REENTRY, EXIT, LAYER = range(6)  # kinds of events
SETTLE_S = 0.3  # left out after a change of motion, where a line is fitted


@dataclasses.dataclass
class Curve:
    time_s: np.ndarray
    force_n: np.ndarray
    travel_m: np.ndarray  # of the tip along the needle, 0 at the first contact
    depth_m: np.ndarray   # in the tissue
    friction_n: np.ndarray
    contact: int          # indices
    puncture: int
    hold: int
    retraction: int
    exit: int


def read_curve(recording):
    """From the open HDF5 file of a recording."""
    w, x, y, z = np.asarray(recording["input/rotation_wxyz"], float).T
    direction = -np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)

    def along(name):
        return -np.sum(np.asarray(recording[name], float) * direction, 1)

    tick = np.asarray(recording["output/tick"]).astype(np.int64)
    kinds, at = np.asarray(recording["events/kind"]), np.asarray(recording["events/tick"])

    def first(kind, after=0):
        hits = [int(np.searchsorted(tick, t)) for k, t in zip(kinds, at)
                if k == kind and t >= after]
        if not hits:
            raise AssertionError(f"no event of kind {kind}; events: {list(zip(kinds, at))}")
        return hits[0]

    puncture = first(PUNCTURE)
    contact = max(int(np.searchsorted(tick, t)) for k, t in zip(kinds, at)
                  if k == CONTACT and t <= tick[puncture])
    end = first(EXIT, tick[puncture])
    travel = -along("output/tip_m")
    travel -= travel[contact]
    hold, retraction = resting_part(travel, puncture, end)
    return Curve(time_s=tick * 1e-3, force_n=along("output/force_n"), travel_m=travel,
                 depth_m=np.asarray(recording["output/depth_m"], float),
                 friction_n=along("output/friction_n"), contact=contact, puncture=puncture,
                 hold=hold, retraction=retraction, exit=end)


def resting_part(travel_m, begin, end):
    """The longest stretch in which the tip moves less than 2 mm/s, for a period of 1 ms."""
    slow = np.abs(travel_m[begin + 20:end] - travel_m[begin:end - 20]) < 2e-3 * 20e-3
    edges = np.flatnonzero(np.diff(np.concatenate([[0], slow.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2]
    if len(starts) == 0:
        raise AssertionError("the needle never held still")
    longest = int(np.argmax(ends - starts))
    return begin + 20 + int(starts[longest]), begin + int(ends[longest])


def line(x, y):
    """Slope, offset and standard deviation about the line."""
    slope, offset = np.polyfit(x, y, 1)
    return slope, offset, float(np.std(y - (slope * x + offset)))


class Faults(list):
    def expect(self, good, text):
        if not good:
            self.append(text)

    def within(self, name, value, low, high, unit):
        self.expect(low <= value <= high, f"{name} {value:.4g} {unit}, expected {low} to {high}")


def insertion(curve):
    """Slope (N/m), mean force and ripple (N) of the straight part between puncture and hold."""
    settle = int(SETTLE_S / (curve.time_s[1] - curve.time_s[0]))
    part = slice(curve.puncture + settle, curve.hold - settle)
    slope, _, ripple = line(curve.depth_m[part], curve.force_n[part])
    return slope, float(np.mean(curve.force_n[part])), ripple


def check_rise(curve, faults):
    rise = curve.force_n[curve.contact:curve.puncture]
    peak = rise[-1]
    indentation = curve.travel_m[curve.puncture]
    faults.within("force of contact", curve.force_n[curve.contact - 2], -0.001, 0.001, "N")
    faults.expect(np.all(rise >= np.maximum.accumulate(rise) - 0.01 * peak),
                  "the rise is not monotone")
    half = int(np.searchsorted(curve.travel_m[curve.contact:curve.puncture], indentation / 2))
    faults.expect(rise[half] <= 0.55 * peak, f"the rise is concave: {rise[half]:.3f} N half-way to "
                  f"{peak:.3f} N")
    faults.within("puncture force", peak, 0.5, 3, "N")
    faults.within("indentation at puncture", indentation * 1e3, 4, 12, "mm")
    faults.within("slope of the rise", peak / indentation, 50, 200, "N/m")


def check_drop(curve, faults):
    peak = curve.force_n[curve.puncture - 1]
    after = curve.force_n[curve.puncture:curve.puncture + 50]
    faults.expect(after.min() <= 0.7 * peak, f"puncture: falls from {peak:.3f} N only to "
                  f"{after.min():.3f} N in 50 ms")
    faults.expect(after.min() > 0, f"puncture: the force reverses to {after.min():.3f} N")


def check_insertion(curve, faults, ripple_fraction):
    slope, mean, ripple = insertion(curve)
    faults.within("insertion slope", slope, 5, 50, "N/m")
    faults.within("insertion ripple", 100 * ripple / mean, 0, 100 * ripple_fraction,
                  "% of the mean")


def check_hold(curve, faults):
    part = curve.force_n[curve.hold:curve.retraction]
    faults.within("hold", len(part) * 1e-3, 2, 4, "s")
    decay = part[0] - part[-1]
    faults.within("decay in the hold", 100 * decay / part[0], 20, 60, "%")
    faults.expect(part[-1] > 0.01, f"the hold ends at {part[-1]:.4f} N, no plateau")
    at_63 = int(np.argmax(part <= part[0] - 0.632 * decay))
    faults.within("time constant of the hold", at_63 * 1e-3, 0.3, 3, "s")
    swing = np.max(part - np.minimum.accumulate(part))
    faults.within("swing in the hold", swing, 0, 0.02, "N")


def check_retraction_sign(curve, faults, presliding_m):
    force = curve.force_n[curve.retraction:curve.exit]
    reversed_at = int(np.argmax(force < 0))
    faults.expect(force[reversed_at] < 0, "retraction: the force never changes its sign")
    back = curve.travel_m[curve.retraction] - curve.travel_m[curve.retraction + reversed_at]
    faults.within("way back until the sign changes", back * 1e3, 0, presliding_m * 1e3, "mm")


def check_retraction(curve, faults, presliding_m):
    check_retraction_sign(curve, faults, presliding_m)
    part = slice(curve.retraction, curve.exit)
    force, depth = curve.force_n[part], curve.depth_m[part]
    friction = np.max(curve.friction_n[curve.puncture:curve.hold])
    faults.within("largest pull in retraction", -force.min(), 0.2 * friction, 1.05 * friction, "N")
    straight = (depth < 0.85 * depth[0]) & (depth > 0.15 * depth[0])
    slope, _, scatter = line(depth[straight], -force[straight])
    faults.expect(slope > 0, f"retraction: the pull does not fall with depth ({slope:.3g} N/m)")
    faults.within("scatter of the retraction", 100 * scatter / np.mean(-force[straight]), 0, 10,
                  "% of the mean")


def check_exit(curve, faults):
    after = np.abs(curve.force_n[curve.exit + 50:])
    faults.expect(len(after) > 0, "the recording ends before the needle is out")
    faults.within("force 50 ms after the exit", float(after.max(initial=0)), 0, 0.01, "N")


def check_physical(curve):
    """Faults of all six phases, in words; empty if everything is within its band."""
    faults = Faults()
    check_rise(curve, faults)
    check_drop(curve, faults)
    check_insertion(curve, faults, ripple_fraction=0.02)
    check_hold(curve, faults)
    # Liver's 0.9 N of friction and cutting (60 mm of 18G), six tenths of it after the hold, divided
    # by the axial stiffness at the shaft (2 pi G l / ln(50 mm / a), 690 N/m) plus that at the tip
    # (a sphere's 24 pi G a (1 - nu) / (5 - 6 nu), 92 N/m): 0.7 mm, and half more because the organ
    # gives way as a whole.
    check_retraction(curve, faults, presliding_m=1.05e-3)
    check_exit(curve, faults)
    return faults


def check_paper(curve):
    """What the paper's own rules give: forces change in whole units, so their levels are not
    compared."""
    faults = Faults()
    peak = curve.force_n[curve.puncture - 1]
    after = curve.force_n[curve.puncture:curve.puncture + 50]
    faults.expect(peak > 0.01, f"puncture force {peak:.3f} N, expected a rise before it")
    faults.expect(after.min() <= 0.7 * peak, f"puncture: falls from {peak:.3f} N only to "
                  f"{after.min():.3f} N in 50 ms")
    slope, _, _ = insertion(curve)
    faults.expect(slope > 0, f"insertion slope {slope:.3g} N/m, expected growth with depth")
    part = curve.force_n[curve.hold:curve.retraction]
    faults.expect(part[-1] > 0.01, f"the hold ends at {part[-1]:.4f} N, no plateau")
    # A slip is of a whole unit, up to half a newton, and its waves die out: nothing goes on
    # swinging.
    late = part[500:]
    swing = np.max(late - np.minimum.accumulate(late))
    faults.within("swing in the hold, from 0.5 s on", swing, 0, 0.002, "N")
    # A particle lets go when it is more than a unit from its goal: two units of 5 mm lie between
    # letting go on the way in and on the way out.
    check_retraction_sign(curve, faults, presliding_m=10e-3)
    check_exit(curve, faults)
    return faults
