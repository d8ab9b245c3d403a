# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A recording of Stylet
#
# `stylet run SCENE --record out.h5` writes HDF5: one row a tick, SI units, the frame of the organ
# at rest. This file is a script and a notebook at once (cells begin with `# %%`; VS Code, Spyder
# and Jupytext know them):
#
#     recording.py out.h5                     # prints, and shows the curves
#     recording.py out.h5 -o curves.png       # or writes them
#     recording.py out.h5 --needle 1          # of several, the second
#
# It needs h5py, numpy and matplotlib (Debian: python3-h5py python3-matplotlib).

# %%
import argparse
import sys

import h5py
import matplotlib.pyplot as plt
import numpy as np

CAUSES = ["stiffness", "cutting", "friction", "clamping", "obstacle"]
# Of each cause, as in every other figure (hal/palette.csv).
COLOURS = ["#0072b2", "#c24e00", "#009e73", "#a8478a", "#5c3d00"]
TOTAL, WAY_IN, WAY_OUT = "#1d2733", "#332288", "#cc6677"
PHASES = ["free", "contact", "inserted", "retracting"]
EVENTS = ["contact", "release", "puncture", "reentry", "exit", "layer", "obstacle",
          "flashback", "loss of resistance"]


# %% [markdown]
# ## Reading
# Forces are vectors on the needle. Along the direction of insertion, and with the sign turned so
# that what resists the way in is positive, they are what papers plot.

# %%
def opened(path):
    """Opens the file; also that of a running or killed run (`NAME.PROCESS.tmp`)."""
    try:
        return h5py.File(path, "r")
    except OSError:
        return h5py.File(path, "r", swmr=True)


def load(path, needle=0):
    """One needle's curves as numpy arrays, in s, mm and N."""
    with opened(path) as file:
        period_s = float(file.attrs["config_period_s"])
        needles = len(file["needles/length_m"])
        if not 0 <= needle < needles:
            raise SystemExit(f"{path}: needle {needle}: expected 0 to {needles - 1}")
        group = file if needle == 0 else file[f"needle{needle}"]
        direction = file["needles/direction"][needle].astype(float)
        entry_m = file["needles/entry_m"][needle].astype(float)

        # Columns of a file that grows differ by some rows.
        columns = [*group["output"].values(), group["loop/tick_ns"]]
        rows = min(len(column) for column in columns)

        def output(name):
            return group[f"output/{name}"][:rows]

        def axial(name):
            return -(output(f"{name}_n").astype(float) @ direction)

        force = output("force_n").astype(float)
        along = force @ direction
        events = [dict(tick=int(tick), kind=EVENTS[kind], layer=int(layer),
                       depth_mm=1e3 * float(depth), force_n=float(size))
                  for tick, kind, layer, depth, size, of in
                  zip(file["events/tick"], file["events/kind"], file["events/layer"],
                      file["events/depth_m"], file["events/force_n"], file["events/needle"])
                  if of == needle]
        return {
            "time_s": output("tick") * period_s,
            "depth_mm": 1e3 * output("depth_m").astype(float),
            "travel_mm": 1e3 * ((output("tip_m").astype(float) - entry_m) @ direction),
            "force_n": axial("force"),
            "lateral_n": np.linalg.norm(force - np.outer(along, direction), axis=1),
            "causes_n": {cause: axial(cause) for cause in CAUSES},
            "phase": output("phase"),
            "tick_us": 1e-3 * group["loop/tick_ns"][:rows],
            "events": events,
        }


# %% [markdown]
# ## Phases
# As the kernel sees them; `stylet run` reads finer ones off the curve.

# %%
def phases(curves):
    """Rows (name, from s, to s, deepest mm, peak N, mean N)."""
    phase = curves["phase"]
    edges = np.flatnonzero(np.diff(phase)) + 1
    rows = []
    for part in np.split(np.arange(len(phase)), edges):
        force = curves["force_n"][part]
        rows.append((PHASES[phase[part[0]]], curves["time_s"][part[0]], curves["time_s"][part[-1]],
                     curves["depth_mm"][part].max(), force[np.abs(force).argmax()], force.mean()))
    return rows


def print_phases(curves):
    print(f"{'phase':<11}{'from s':>9}{'to s':>9}{'depth mm':>10}{'peak N':>9}{'mean N':>9}")
    for name, start, end, depth, peak, mean in phases(curves):
        print(f"{name:<11}{start:>9.3f}{end:>9.3f}{depth:>10.2f}{peak:>9.3f}{mean:>9.3f}")
    for event in curves["events"]:
        print(f"tick {event['tick']:>7}  {event['kind']:<9} layer {event['layer']:>2}  "
              f"{event['depth_mm']:6.2f} mm  {event['force_n']:6.3f} N")


# %% [markdown]
# ## Curves
# Above, force against time by cause, with punctures marked; below, the whole force against the
# needle's depth: way in and way out.

# %%
def draw(curves):
    figure, (above, below) = plt.subplots(2, 1, figsize=(9, 8), constrained_layout=True)
    above.plot(curves["time_s"], curves["force_n"], color=TOTAL, linewidth=1.6, label="total")
    for (cause, force), colour in zip(curves["causes_n"].items(), COLOURS):
        if np.abs(force).max(initial=0) > 1e-3:
            above.plot(curves["time_s"], force, color=colour, linewidth=1, label=cause)
    punctures = [event["tick"] for event in curves["events"] if event["kind"] == "puncture"]
    period_s = curves["time_s"][1] - curves["time_s"][0]
    for tick in punctures:
        above.axvline(tick * period_s, color="0.6", linewidth=0.8, linestyle=":")
    above.set(xlabel="Time / s", ylabel="Axial force on the needle / N")
    above.legend()
    deepest = int(curves["depth_mm"].argmax())
    for part, colour, label in [(slice(0, deepest + 1), WAY_IN, "way in"),
                                (slice(deepest, None), WAY_OUT, "way out")]:
        below.plot(curves["depth_mm"][part], curves["force_n"][part], color=colour,
                   linewidth=1.2, label=label)
    below.set(xlabel="Depth in tissue / mm", ylabel="Axial force on the needle / N")
    below.legend()
    return figure


# %%
def main():
    parser = argparse.ArgumentParser(description="Curves and phases of a recording.")
    parser.add_argument("recording", help="HDF5, of stylet run --record")
    parser.add_argument("-o", "--output", help="picture to write: .png, .svg or .pdf")
    parser.add_argument("--needle", type=int, default=0, help="of several: 0 is the first")
    options = parser.parse_args()
    try:
        curves = load(options.recording, options.needle)
    except (OSError, KeyError) as error:
        sys.exit(f"{options.recording}: expected a recording of stylet run --record: {error}")
    if len(curves["time_s"]) < 2:
        sys.exit(f"{options.recording}: {len(curves['time_s'])} ticks: nothing to draw")
    print_phases(curves)
    figure = draw(curves)
    if options.output:
        figure.savefig(options.output, dpi=150)
    else:
        plt.show()


if __name__ == "__main__":
    main()
