#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Golden replays: what each scene of hal/scenes gave when it was last looked at, bit for bit.

    tests/golden/golden.py [SCENE...]

makes scenes.json anew for these scenes (none named: all); README.md says when one may. The tests of
the scenes compare their runs with it. A scene is a dict:

    organ    hash of the organ file
    ticks    of the run
    contact, puncture    tick of the first one, for each needle; null: none
    points   every 1000 ticks, and at the end: [tick, hash of the state, checksum of the inputs
             since the last point, checksum of the outputs, and for each needle tip_m, force_n,
             depth_m, constraint particles]. The numbers are for people, to see what changed.

Programs, data and packages as in hal/scenes/play.py.
"""
import argparse
import json
import pathlib
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "hal/scenes"))

import play  # noqa: E402

draw = play.drawing()  # which says what to do if the packages below are not there
import h5py  # noqa: E402
import numpy as np  # noqa: E402

TABLE = HERE / "scenes.json"
EACH_NEEDLE = ("tip_m", "force_n", "depth_m", "constraint_particles")
POINT = ("tick", "state hash", "inputs", "outputs")


def checksum(file, groups, rows):
    """Of all columns of these groups, in their rows."""
    value = 0
    for group in groups:
        for name in sorted(file[group]):
            value = zlib.crc32(np.ascontiguousarray(file[group][name][rows]).tobytes(), value)
    return f"{value:08x}"


def first_ticks(file, kind, needles):
    """Of each needle, the tick of its first event of this kind."""
    rows = list(zip(file["events/needle"], file["events/kind"], file["events/tick"]))
    return [next((int(tick) for n, k, tick in rows if n == needle and draw.EVENTS[k] == kind), None)
            for needle in range(needles)]


def readable(value):
    """Six digits: the checksums hold the rest."""
    if np.ndim(value):
        return [readable(part) for part in value]
    return int(value) if isinstance(value, np.integer) else float(f"{value:.6g}")


def columns_of(needle):
    return f"needle{needle}/" if needle else ""


def digest(recording):
    """The table's entry for a recording."""
    with h5py.File(recording) as file:
        ticks, needles = int(file.attrs["ticks"]), len(file["needles/length_m"])
        hashes = np.asarray(file["loop/state_hash"])
        last_hash = int(file.attrs["final_state_hash"])
        ends = [int(row) + 1 for row in np.flatnonzero(hashes) if row + 1 < ticks] + [ticks]
        points = []
        for start, end in zip([0, *ends], ends):
            rows = slice(start, end)
            state = last_hash if end == ticks else int(hashes[end - 1])
            each = [readable(file[f"{columns_of(n)}output/{name}"][end - 1])
                    for n in range(needles) for name in EACH_NEEDLE]
            points.append([end, f"{state:016x}",
                           checksum(file, [columns_of(n) + "input" for n in range(needles)], rows),
                           checksum(file, [columns_of(n) + "output" for n in range(needles)], rows),
                           *each])
        return {"organ": f"{int(file.attrs['organ_hash']):016x}", "ticks": ticks,
                "contact": first_ticks(file, "contact", needles),
                "puncture": first_ticks(file, "puncture", needles), "points": points}


def field_name(index):
    if index < len(POINT):
        return POINT[index]
    needle, which = divmod(index - len(POINT), len(EACH_NEEDLE))
    return f"{columns_of(needle)}output/{EACH_NEEDLE[which]}"


def point_difference(start, golden, now):
    """One line about a stretch that differs; empty if it does not."""
    if len(golden) != len(now):
        return f"tick {golden[0]}: {len(now)} values, golden {len(golden)}"
    differ = [i for i, (a, b) in enumerate(zip(golden, now)) if a != b]
    if not differ:
        return ""
    text = f"ticks {start + 1} to {golden[0]}: {', '.join(map(field_name, differ[:4]))} differ"
    numbers = [i for i in differ if i >= len(POINT)]
    if numbers:
        which = numbers[0]
        text += (f"; first at tick {golden[0]}: {field_name(which)} {now[which]}, "
                 f"golden {golden[which]}")
    return text


def difference(golden, now):
    """The first difference, in words; empty if there is none."""
    if golden["organ"] != now["organ"]:
        return f"organ file: hash {now['organ']}, golden {golden['organ']}"
    start = 0
    for a, b in zip(golden["points"], now["points"]):
        found = point_difference(start, a, b)
        if found:
            return found
        start = a[0]
    for key in ("ticks", "contact", "puncture"):
        if golden[key] != now[key]:
            return f"{key}: {now[key]}, golden {golden[key]}"
    if len(golden["points"]) != len(now["points"]):
        return f"points: {len(now['points'])}, golden {len(golden['points'])}"
    return ""


def read_table():
    return json.loads(TABLE.read_text())


def write_table(table):
    """One line for each point, so that a change can be read."""
    scenes = []
    for name, scene in sorted(table.items()):
        head = ",\n".join(f'  "{key}": {json.dumps(scene[key])}'
                          for key in ("organ", "ticks", "contact", "puncture"))
        points = ",\n".join(f"    {json.dumps(point)}" for point in scene["points"])
        scenes.append(f'"{name}": {{\n{head},\n  "points": [\n{points}\n  ]\n}}')
    TABLE.write_text("{\n" + ",\n".join(scenes) + "\n}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", metavar="SCENE", choices=[[], *play.scene_names()])
    table = read_table() if TABLE.exists() else {}
    for name in parser.parse_args().scene or play.scene_names():
        try:
            with tempfile.TemporaryDirectory() as folder:
                recording, _ = play.play(name, folder)
                now = digest(recording)
        except play.DataMissing as missing:
            print(f"{name}: kept as it was: {missing}")
            continue
        change = difference(table[name], now) if name in table else "new"
        print(f"{name}: {change or 'the same'}", flush=True)
        table[name] = now
    write_table(table)


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"golden.py: {error}")
