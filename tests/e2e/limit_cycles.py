#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whether a scene of hal/scenes buzzes or makes energy with a real device's dynamics.

    tests/e2e/limit_cycles.py [--write] [--model MODEL]... [SCENE...]

runs each scene on a virtual clock with `device.model` set and prints the line that
hal/guard/GUARD.md has of it; --write puts the lines there:

    ripple   largest amplitude of the force sent above 20 Hz, of what it may be: 20 mN, or 5 % of
             the force, less than anybody feels; in any 0.2 s without a step in it or in the 0.1 s
             before. Steps are events of the needle and corners of the hand's script: they are felt
             as such, a limit cycle stays. In paper mode, where the force also steps with each
             particle that is associated anew, in three such stretches on end
    seen     share of the time with force on the hand that such stretches cover
    energy   least of the guard's observer, and of what the simulated hand's side gave (exact):
             0, or below it where the hand was given some
    faults   of the guard

Programs, data and packages as in hal/scenes/play.py.
"""
import argparse
import pathlib
import re
import sys
import tempfile
import tomllib

import h5py
import numpy as np

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "hal/scenes"))

import play  # noqa: E402

PAGE = HERE.parents[1] / "hal/guard/GUARD.md"
MODELS = ("touch", "omega.7")
ABOVE_HZ = 20
BAR_N, BAR_SHARE = 0.02, 0.05
WINDOW_S, QUIET_S = 0.2, 0.1
TOUCHED_N = 0.01


def with_model(text, model):
    """The scene with this device instead of its own numbers, for all its needles."""
    own = "needles.device" if "[[needles]]" in text else "device"
    text = re.sub(r"(?m)^max_(force_n|slew_n_per_s|stiffness_n_per_m) *=.*\n", "", text)
    line = f'[{own}]\nmodel = "{model}"\n'
    if f"[{own}]\n" in text:
        return text.replace(f"[{own}]\n", line)
    if own == "device":
        return text + "\n" + line
    return text.replace("[needles.approach]\n", line + "\n[needles.approach]\n")


def ripple(force_n, period_s):
    """Amplitude above ABOVE_HZ in a stretch of force, and the mean magnitude of the force in it."""
    count = len(force_n)
    x = np.linspace(-1, 1, count)
    trend = np.polynomial.polynomial.polyfit(x, force_n, 3)
    rest = force_n - np.polynomial.polynomial.polyval(x, trend).T
    window = np.hanning(count)
    lines = np.fft.rfft(rest * window[:, None], axis=0)
    quick = np.fft.rfftfreq(count, period_s) >= ABOVE_HZ
    mean_square = 2 * np.sum(np.abs(lines[quick]) ** 2) / count / np.sum(window**2)
    return np.sqrt(2 * mean_square), np.linalg.norm(force_n.mean(axis=0))


def worst_ripple(force_n, steps, period_s, lasting):
    """(ripple, bar, tick, fraction seen) of the stretch that is worst by its own bar."""
    ticks, wide = len(force_n), round(WINDOW_S / period_s)
    disturbed = np.zeros(ticks, bool)
    for tick in steps:
        disturbed[tick - 1:tick - 1 + round(QUIET_S / period_s)] = True
    touched = np.linalg.norm(force_n, axis=1) > TOUCHED_N
    seen = np.zeros(ticks, bool)
    found = {}
    for start in range(0, ticks - wide + 1, wide // 4):
        if disturbed[start:start + wide].any():
            continue
        seen[start:start + wide] = True
        amplitude, mean = ripple(force_n[start:start + wide], period_s)
        found[start] = (amplitude, max(BAR_N, BAR_SHARE * mean), start + 1)
    def by_bar(row):
        return row[0] / row[1]

    if lasting:
        on_end = {start: [found.get(start + k * wide) for k in range(3)] for start in found}
        found = {start: min(rows, key=by_bar) for start, rows in on_end.items() if all(rows)}
    worst = max(found.values(), key=by_bar, default=(0.0, BAR_N, 0))
    return (*worst, np.mean(seen[touched]) if touched.any() else 1.0)


def corners_of(scene, number, columns, period_s):
    """Ticks in which the speed of the hand changes."""
    whole = tomllib.loads(scene)
    hand = whole["needles"][number] if "needles" in whole else whole
    if hand.get("device", {}).get("kind") == "steered":
        step = np.diff(np.asarray(columns["device/position_m"], float)[:, 2])
        return [int(tick) for tick in np.flatnonzero(np.abs(np.diff(step)) > 1e-6) + 2]
    at = np.array([-hand.get("approach", {}).get("start_mm", 10), 0.0, 0.0])
    time_s, ticks = 0.0, [1]
    for point in hand["hand"]["waypoint"]:
        to = np.array([point.get("travel_mm", at[0]), *point.get("lateral_mm", at[1:])])
        if "time_s" in point:
            time_s += point["time_s"]
        elif "speed_mm_s" in point:
            time_s += float(np.linalg.norm(to - at)) / point["speed_mm_s"]
        for pause in (0, point.get("hold_s", 0)):
            time_s += pause
            ticks.append(round(time_s / period_s) + 1)
        at = to
    return ticks


def steps_of(scene, file, number, columns, period_s):
    """Ticks in which the force may step."""
    return [int(tick) for tick, needle in zip(file["events/tick"], file["events/needle"])
            if needle == number] + corners_of(scene, number, columns, period_s)


def rows_of(scene, recording, report):
    """One dict a needle."""
    rows = []
    with h5py.File(recording) as file:
        for number, needle in enumerate(report["needles"]):
            own = file[f"needle{number}"] if number else file
            force = np.asarray(own["device/force_n"], float)
            steps = steps_of(scene, file, number, own, report["period_s"])
            amplitude, bar, tick, share = worst_ripple(force, steps, report["period_s"],
                                                       'mode = "paper"' in scene)
            rows.append({"needle": number, "ripple_n": amplitude, "bar_n": bar, "tick": tick,
                         "seen": share, "largest_n": float(np.linalg.norm(force, axis=1).max()),
                         "guard_j": needle["least_energy_j"],
                         "hand_j": needle["least_received_j"], "fault": needle["fault"],
                         "damped": report["counters"]["force_damped"]})
    return rows


def measure(name, model, folder):
    """The rows of one scene with one device."""
    organ = pathlib.Path(folder) / f"{name}.organ"
    if not organ.exists():
        play.build_organ(name, folder)
    text = with_model((play.HERE / f"{name}.toml").read_text(), model)
    scene = pathlib.Path(folder) / f"{name}-{model}.toml"
    scene.write_text(text)
    recording, report = play.run(scene, organ, pathlib.Path(folder) / f"{name}-{model}.h5")
    return rows_of(text, recording, report)


def line_of(name, measured):
    """A scene's line, for the needle that comes nearest to its bar."""
    cells = []
    for rows in measured:
        worst = max(rows, key=lambda row: row["ripple_n"] / row["bar_n"])
        cells.append(f"{1e3 * worst['ripple_n']:.1f} of {1e3 * worst['bar_n']:.0f}")
    every = [row for rows in measured for row in rows]
    seen = min(row["seen"] for row in every)
    energy_j = min(value for row in every for value in (row["guard_j"], row["hand_j"])
                   if value is not None)
    faults = ", ".join(sorted({row["fault"] for row in every}))
    return f"| {name} | {' | '.join(cells)} | {seen:.0%} | {1e6 * energy_j:.2g} | {faults} |"


def write(name, line):
    """Replaces a scene's line in the page."""
    text, count = re.subn(rf"^\| {re.escape(name)} \|.*$", lambda _: line, PAGE.read_text(),
                          flags=re.MULTILINE)
    if count != 1:
        raise RuntimeError(f"{PAGE}: {count} lines of {name}: expected one")
    PAGE.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", action="append")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("scene", nargs="*", metavar="SCENE", choices=[[], *play.scene_names()])
    options = parser.parse_args()
    models = options.model or MODELS
    if options.write and models != MODELS:
        parser.error(f"--write: expected no --model: the page has {' and '.join(MODELS)}")
    print(f"| scene | {' | '.join(f'{model}: ripple, mN' for model in models)} | seen "
          f"| least energy, uJ | faults |\n{'| --- ' * (len(models) + 4)}|")
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scene or play.scene_names():
            try:
                measured = [measure(name, model, folder) for model in models]
            except play.DataMissing as missing:
                print(f"| {name} | skipped: {missing} |")
                continue
            print(line_of(name, measured), flush=True)
            if options.write:
                write(name, line_of(name, measured))


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"limit_cycles.py: {error}")
