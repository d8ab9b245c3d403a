# SPDX-License-Identifier: Apache-2.0
"""Pictures of the scenes: what a recording shows, as panels drawn by gnuplot.

A panel is a dict: title, x, y (names of the axes), lines [(x, y, name)], and optionally marks
[(x, text)], points [(x, y, name)], equal (both axes to one scale). Lengths in mm, forces in N.
"""
import json
import os
import pathlib
import subprocess

import h5py
import numpy as np

import play

PALETTE = dict(line.split(",")[:2] for line in (
    pathlib.Path(__file__).resolve().parents[1] / "palette.csv").read_text().splitlines()
    if not line.startswith("#"))
# Of what has no name there; none of the palette's own. Tol's muted scheme, 2021.
OTHERS = ["#882255", "#44aa99", "#88ccee", "#ddcc77", "#777777"]
LABEL_GAP = 0.022  # of a panel's width: what a line of upright text needs
LABEL_ROOM = 0.35  # of its height, above the curves: for the longest label
MOST_POINTS = 1500  # of a line: more than a page can show
EVENTS = ["contact", "release", "puncture", "re-entry", "exit", "layer", "obstacle",
          "flashback", "loss of resistance"]
SAME = {"axial force": "total", "": "total"}  # other words for what the palette has


class Run:
    """The columns of a recording, of one of its needles, as pictures and tests want them, in SI."""

    def __init__(self, recording, number=0):
        self.path = recording
        with h5py.File(recording) as whole:
            file = whole[f"needle{number}"] if number else whole
            w, x, y, z = np.asarray(file["input/rotation_wxyz"], float).T
            along = -np.stack([2 * (x * z + w * y), 2 * (y * z - w * x),
                               1 - 2 * (x * x + y * y)], 1)[0]
            self.along = along
            self.bevel = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z),
                                   2 * (x * z - w * y)], 1)
            self.time_s = np.asarray(file["output/tick"]).astype(float) * 1e-3
            self.handle_m = np.asarray(file["input/position_m"], float)
            self.tip_m = np.asarray(file["output/tip_m"], float)
            self.force_n = np.asarray(file["output/force_n"], float)
            self.parts_n = {name: -np.asarray(file[f"output/{name}_n"], float) @ along
                            for name in ("stiffness", "cutting", "friction")}
            self.depth_m = np.asarray(file["output/depth_m"], float)
            self.plunger_n = np.asarray(file["flow/plunger_n"], float)
            self.hub_pa, self.opening_pa, self.flow_m3_per_s, self.injected_m3, self.filled = (
                np.asarray(file[f"flow/{name}"], float)
                for name in ("hub_pa", "opening_pa", "flow_m3_per_s", "injected_m3", "filled"))
            self.particles = np.asarray(file["output/constraint_particles"]).astype(int)
            self.events = [(int(tick), EVENTS[kind], int(layer), float(force)) for
                           tick, kind, layer, force, needle in
                           zip(whole["events/tick"], whole["events/kind"], whole["events/layer"],
                               whole["events/force_n"], whole["events/needle"])
                           if needle == number]
        self.known_shapes, self.checks = {}, {"ticks": 0}
        self.axial_n = -self.force_n @ along  # positive where the hand is pushed back
        contact = self.index("contact")
        self.travel_m = (self.tip_m - self.tip_m[contact]) @ along
        self.hand_m = (self.handle_m - self.handle_m[contact]) @ along

    def ticks(self, kind):
        return [tick for tick, name, _, _ in self.events if name == kind]

    def index(self, kind, which=0):
        """Row of the which-th event of a kind."""
        return self.ticks(kind)[which] - 1

    def shapes(self, *ticks):
        """Needles, constraint particles and surface at these ticks, replayed if not yet known.

        self.checks is then what was checked in the ticks on the way."""
        if not set(ticks) <= set(self.known_shapes):
            done = subprocess.run([play.BIN / "stylet-snapshot", self.path, *map(str, ticks)],
                                  capture_output=True, text=True, check=True)
            new = json.loads(done.stdout)
            self.known_shapes |= {shape["tick"]: shape for shape in new["shapes"]}
            self.checks = max(self.checks, new["checks"], key=lambda checks: checks["ticks"])
        return [self.known_shapes[tick] for tick in ticks]


def thinned(*columns):
    step = max(1, len(columns[0]) // MOST_POINTS)
    return [np.asarray(column)[::step] for column in columns]


def data_block(name, x, y):
    rows = "\n".join(f"{a:.6g} {b:.6g}" for a, b in zip(*thinned(x, y)))
    return f"${name} << EOD\n{rows}\nEOD\n"


def placed(marks, low, high):
    """(place of the label, text) of marks (place, text): none over another, all in the panel."""
    gap = LABEL_GAP * (high - low)
    rows = []  # what a mark says more than once within a line's width is said once
    for x, words in sorted(marks):
        if rows and rows[-1][1] == words and x - rows[-1][3] < gap:
            rows[-1][2:] = [rows[-1][2] + 1, x]
        else:
            rows.append([x, words, 1, x])
    places, before = [], low
    for x, *_ in rows:
        before = max(before + gap, x)
        places.append(before)
    after = high + gap
    for i in reversed(range(len(places))):
        after = places[i] = min(places[i], after - gap)
    return [(place, words if count == 1 else f"{words}, {count} times")
            for place, (_, words, count, _) in zip(places, rows)]


def mark_script(panel):
    """Lines where something happened, named beside them."""
    low = min(float(np.min(x)) for x, _, _ in panel["lines"])
    high = max(float(np.max(x)) for x, _, _ in panel["lines"])
    text = f"set xrange [{low:.6g}:{high:.6g}]\nset offsets 0, 0, graph {LABEL_ROOM}, 0\n"
    for x, _ in panel["marks"]:
        text += (f"set arrow from first {x:.6g}, graph 0 to first {x:.6g}, graph 1 nohead "
                 "lc rgb '#BBBBBB' dt 2\n")
    for place, words in placed(panel["marks"], low, high):
        text += (f"set label '{words}' at first {place:.6g}, graph 0.98 right rotate by 90 "
                 "offset -0.6,0 font ',10' textcolor rgb '#555555'\n")
    return text


def colours_of(panels):
    """Of every name in a picture, the same in all its panels."""
    names = [name for panel in panels for kind in ("lines", "points")
             for _, _, name in panel.get(kind, [])]
    others, colours = iter(OTHERS), {}
    for name in dict.fromkeys(names):
        colours[name] = PALETTE.get(SAME.get(name, name)) or next(others)
    return colours


def panel_script(index, panel, colours):
    blocks, curves = "", []
    for kind, style in (("lines", "lines lw 1.8"), ("points", "points pt 7 ps 0.45")):
        for x, y, name in panel.get(kind, []):
            block = f"p{index}_{len(curves)}"
            blocks += data_block(block, x, y)
            title = f"title '{name}'" if name else "notitle"
            curves.append(f"${block} using 1:2 with {style} lc rgb '{colours[name]}' {title}")
    text = blocks + f"set title '{panel['title']}'\nset xlabel '{panel['x']}'\n"
    text += f"set ylabel '{panel['y']}'\nunset label\nunset arrow\nset autoscale\n"
    text += "set offsets\n"
    text += "set size ratio -1\n" if panel.get("equal") else "set size noratio\n"
    if panel.get("marks"):
        text += mark_script(panel)
    text += f"set key {panel.get('key', 'top left')}\n"
    return text + "plot " + ", \\\n  ".join(curves) + "\n"


def draw_panels(panels, picture):
    script = (f"set terminal svg size 900,{40 + 390 * len(panels)} font 'DejaVu Sans,13' "
              "background rgb 'white'\nset encoding utf8\nset border 3\nset tics nomirror out\n"
              "set grid lw 0.5 lc rgb '#DDDDDD'\n"
              f"set multiplot layout {len(panels)},1\n")
    colours = colours_of(panels)
    script += "".join(panel_script(i, panel, colours) for i, panel in enumerate(panels))
    done = subprocess.run(["gnuplot", "--default-settings"], input=script, capture_output=True,
                          text=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    if done.returncode != 0 or not done.stdout:
        raise RuntimeError(f"gnuplot: {done.stderr[-500:]}")
    pathlib.Path(picture).write_text(done.stdout)


# ---- panels that several scenes share ------------------------------------------------------------

def force_over_time(run, title):
    lines = [(run.time_s, run.axial_n, "axial force")]
    lines += [(run.time_s, part, name) for name, part in run.parts_n.items()]
    marks = [(tick * 1e-3, name) for tick, name, _, _ in run.events]
    return {"title": title, "x": "time / s", "y": "force / N", "lines": lines,
            "marks": marks, "key": "outside right top"}


def force_over_travel(run, title, layers):
    marks = [(run.travel_m[tick - 1] * 1e3, layers[layer])
             for tick, name, layer, _ in run.events
             if name in ("puncture", "layer") and layer < len(layers)
             and run.hand_m[tick - 1] < run.hand_m.max() * 0.999
             and tick <= int(np.argmax(run.hand_m)) + 1]
    return {"title": title, "x": "tip travel beyond the first contact / mm", "y": "force / N",
            "lines": [(run.travel_m * 1e3, run.axial_n, "axial force")], "marks": marks,
            "key": "outside right top"}


def cut_through(run, ticks, title, across=(1, 0, 0), up=(0, 0, 1)):
    """Side view: the surface's points within 4 mm of the needle's plane, needles and particles."""
    shapes = run.shapes(*ticks)
    normal = np.cross(across, up)
    panels = []
    for shape in shapes:
        surface = np.array(shape["surface_m"])
        line = np.array(shape["needles"][0])
        near = np.abs((surface - line[-1]) @ normal) < 4e-3
        at = np.array([p["goal_m"] for p in shape["particles"]]).reshape(-1, 3)
        points = [(surface[near] @ across * 1e3, surface[near] @ up * 1e3, "surface close by")]
        if len(at):
            points.append((at @ across * 1e3, at @ up * 1e3, "constraint particles"))
        panels.append({"title": f"{title}, {shape['tick'] * 1e-3:.2f} s", "x": "x / mm",
                       "y": "yz"[up[2]] + " / mm", "equal": True, "key": "outside right top",
                       "lines": [(line @ across * 1e3, line @ up * 1e3, "needle")],
                       "points": points})
    return panels


# ---- one function a scene ------------------------------------------------------------------------

def sideways(run):
    """Way of the handle along y, and the force that resists it."""
    return run.handle_m[:, 1] - run.handle_m[0, 1], -run.force_n[:, 1]


def fig03_puncture(run):
    return [force_over_time(run, "Pressed by less than a unit, then by more"),
            {"title": "Constraint particles", "x": "time / s", "y": "particles",
             "lines": [(run.time_s, run.particles, "")]}]


def fig04_insert_retract(run):
    return [{"title": "Constraint particles", "x": "depth in the tissue / mm", "y": "particles",
             "lines": [(run.depth_m * 1e3, run.particles, "")]},
            {"title": "Insertion and retraction", "x": "time / s", "y": "depth / mm",
             "lines": [(run.time_s, run.depth_m * 1e3, "")]}]


def fig05_stick_slip(run):
    start = int(np.argmax(run.hand_m))
    return [{"title": "Sticks, then slips: force over the way of the hand", "x": "handle / mm",
             "y": "force / N",
             "lines": [(run.hand_m[start:] * 1e3, run.axial_n[start:], "axial force"),
                       (run.hand_m[start:] * 1e3, run.parts_n["friction"][start:],
                        "friction")]},
            force_over_time(run, "The same over time")]


def fig02_constraint_particles(run):
    return cut_through(run, [run.index("puncture") + 400, len(run.time_s)],
                       "Constraint particles hold the tissue", up=(0, 1, 0))


def fig06_clamping(run):
    side, force = sideways(run)
    start = int(np.argmax(run.hand_m)) + 1000
    panels = cut_through(run, [start, len(run.time_s)], "Clamped needle", up=(0, 1, 0))
    return panels + [{"title": "Sideways", "x": "handle to the side / mm", "y": "force / N",
                      "lines": [(side[start:] * 1e3, force[start:], "")]}]


def fig07_liver_flexible(run):
    return cut_through(run, [run.index("puncture"), int(np.argmax(run.depth_m)),
                             len(run.time_s)], "22G in a liver", up=(0, 1, 0))


def fig08_liver_rigid(run):
    out = run.index("exit")
    deepest = int(np.argmax(run.hand_m))
    ticks = [run.index("puncture"), deepest, (deepest + out) // 2]
    panels = cut_through(run, ticks, "Rigid needle in a liver")
    return panels + [force_over_time(run, "Force")]


def fig10_steering(run):
    """Seen from the side, in the plane of the bevel; the cubes as the scene places them."""
    line = np.array(run.shapes(len(run.time_s))[0]["needles"][0]) * 1e3
    cubes = []
    for number, (x, z) in enumerate(((55, 6.5), (100, -8)), 1):
        corner = np.array([-8, 8, 8, -8, -8])
        cubes.append((x + corner, z + np.array([-8, -8, 8, 8, -8]), f"cube {number}"))
    return [{"title": "Steered past two cubes to a target", "x": "x / mm", "y": "z / mm",
             "equal": True, "key": "outside right top",
             "lines": [(line[:, 0], line[:, 2], "needle"), *cubes],
             "points": [(np.array([130.0]), np.array([8.0]), "target")]},
            {"title": "Roll of the base", "x": "time / s", "y": "bevel faces z: cosine",
             "lines": [(run.time_s, run.bevel @ (0, 0, 1), "")]}]


BIOPSY = ["liver", "tumour", "skin", "fat", "muscle", "liver capsule"]


def liver_biopsy(run):
    return [force_over_travel(run, "Liver biopsy: the tip enters", BIOPSY),
            force_over_time(run, "The same over time")]


def small_tumour(run):
    return [force_over_travel(run, "A tumour of 8 mm: the tip enters",
                              ["liver", "tumour", "liver_capsule"]),
            force_over_time(run, "The same over time")]


def prostate_template(run):
    shape = run.shapes(len(run.time_s))[0]
    first, second = (np.array(needle) * 1e3 for needle in shape["needles"])
    return [force_over_time(run, "The first needle"),
            {"title": "Both at the end", "x": "x / mm", "y": "y / mm", "equal": True,
             "lines": [(first[:, 0], first[:, 1], "first"),
                       (second[:, 0], second[:, 1], "second")]}]


def prostate_spinning(run):
    """Needles at the end, seen from the side, drawn higher than they are; a stretch of the roll."""
    needles = run.shapes(len(run.time_s))[0]["needles"]
    lines = [np.array(needle) * 1e3 for needle in needles]
    names = ["not spun", "spun half of the time", "spun all the time"]
    rolls = [(spun.time_s[3000:4500], spun.bevel[3000:4500] @ (0, 0, 1), name)
             for spun, name in zip((Run(run.path, 1), Run(run.path, 2)), names[1:])]
    return [{"title": "Spun needles bend less", "x": "x / mm", "y": "z / mm",
             "lines": [(line[:, 0], line[:, 2], name) for line, name in zip(lines, names)]},
            {"title": "Roll of the base", "x": "time / s", "y": "bevel faces z: cosine",
             "lines": rolls, "key": "outside right top"}]


LUMBAR = ["skin", "fat", "ligament", "flavum", "epidural space"]


def lumbar_puncture(run):
    return [force_over_travel(run, "Lumbar puncture: the tip enters", LUMBAR),
            force_over_time(run, "The same over time")]


SPINE = [*LUMBAR, "cerebrospinal fluid", "dura"]
FLUID = ("flashback", "loss of resistance")


def pressure_over_time(run, title):
    """Of the fluid; and what it did."""
    return {"title": title, "x": "time / s", "y": "pressure / kPa",
            "lines": [(run.time_s, run.hub_pa * 1e-3, "hub"),
                      (run.time_s, run.opening_pa * 1e-3, "opening")],
            "marks": [(tick * 1e-3, name) for tick, name, _, _ in run.events if name in FLUID],
            "key": "outside right top"}


def given_over_time(run, title):
    return {"title": title, "x": "time / s", "y": "volume / ml",
            "lines": [(run.time_s, run.injected_m3 * 1e6, "given")], "key": "outside right top"}


def epidural_syringe(run):
    return [force_over_travel(run, "Epidural with a syringe: the tip enters", SPINE),
            pressure_over_time(run, "Pressure of the fluid"),
            given_over_time(run, "Saline given")]


def spinal_tap(run):
    return [force_over_travel(run, "Lumbar puncture: the tip enters", SPINE),
            pressure_over_time(run, "Pressure of the fluid"),
            given_over_time(run, "Cerebrospinal fluid: what came out is below zero")]


def central_vein(run):
    return [force_over_travel(run, "Access to a vein: the tip enters",
                              ["skin", "fat", "muscle", "vein"]),
            pressure_over_time(run, "Pressure of the fluid"),
            given_over_time(run, "Blood drawn is below zero")]


def liver_under_wall(run):
    ticks = [1, 5000, 9000]
    panels = cut_through(run, ticks, "Liver under the wall")
    return panels + [
        {"title": "Force on the hand", "x": "time / s", "y": "force / N",
         "lines": [(run.time_s, run.axial_n, "axial force"),
                   (run.time_s, run.force_n[:, 2], "towards the head")],
         "key": "outside right top"}]


def draw(name, run, picture):
    if name == "fig09-force-curve":  # the program draws this one itself
        subprocess.run([play.BIN / "stylet", "plot", run.path, "-o", picture], check=True,
                       capture_output=True)
        return
    panels = globals()[name.replace("-", "_")](run)
    draw_panels(panels, picture)
