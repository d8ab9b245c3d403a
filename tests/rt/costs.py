#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The most expensive tick of a scene takes as many instructions as committed, within one percent,
and no tick takes more than its bound: the sum of prices in tick_work.h. README.md here says what
became of the bar of 1.15 for the most expensive tick over the median of ticks with a needle in the
tissue.

Runs the scene, then counts instructions under callgrind (which has no AVX-512, so: AVX2): ticks
all along, ticks around every event, and those around the committed dearest one. --update counts
the same, then around the dearest found, and writes the scene's row of costs.txt and the table of
README.md. The scene `worst` is that of worst_case.h.

usage: costs.py REPOSITORY BUILD_FOLDER SCENE [--update]
"""
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

TOLERANCE = 0.01
BAR = 1.15
SAMPLES = 80
AROUND = 2
WORST = "worst"
SKIPPED = 77
HEADER = """\
# Instructions of the dearest tick of each scene, with AVX2: which tick, how many, the median of
# ticks with a needle in the tissue, and what that tick may take at most. Written by
# tests/rt/costs.py REPOSITORY BUILD_FOLDER SCENE --update
# scene tick worst median bound
"""
BEGIN, END = "<!-- costs: tests/rt/costs.py -->", "<!-- end of costs -->"
DUMP = re.compile(r"^desc: Trigger: Client Request: (\d+) (\w+) (\d+)$.*?^totals: (\d+)$",
                  re.M | re.S)


def call(words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words[:6]))}: exit code {done.returncode}\n"
                 f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def windows_of(ticks, last):
    """Arguments FIRST:LAST that cover the ticks, each only once."""
    words, wanted = [], sorted({tick for tick in ticks if 0 <= tick < last})
    for tick in wanted:
        if words and words[-1][1] == tick:
            words[-1][1] = tick + 1
        else:
            words.append([tick, tick + 1])
    return [f"{a}:{b}" for a, b in words]


def count(program, recording, folder, words):
    """Tick -> (instructions, whether a needle was in the tissue, bound)."""
    call([program, recording, folder, *words])
    out = folder / "callgrind.out"
    call(["valgrind", "--tool=callgrind", "--collect-atstart=no", "--combine-dumps=yes",
          f"--callgrind-out-file={out}", program, recording, folder, *words])
    found = {int(tick): (int(cost), phase == "inserted", int(bound))
             for tick, phase, bound, cost in DUMP.findall(out.read_text())}
    out.unlink()
    return found


def read_rows(path):
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return {row[0]: tuple(map(int, row[1:])) for row in rows}


def write_row(path, scene, row):
    rows = read_rows(path) if path.exists() else {}
    rows[scene] = row
    path.write_text(HEADER + "".join(f"{name} {' '.join(map(str, values))}\n"
                                     for name, values in sorted(rows.items())))


def spread(row):
    """What became of the bar: '1.084, held'."""
    over = row[1] / row[2]
    return f"{over:.3f}, {'held' if over <= BAR else 'missed'}"


def table(rows):
    lines = ["| scene | dearest tick | its bound | median, inserted | spread, bar 1.15 |",
             "| --- | --- | --- | --- | --- |"]
    for scene, row in sorted(rows.items()):
        over = "all pools are full in all ticks" if scene == WORST else spread(row)
        lines.append(f"| {scene} | {row[1]} | {row[3]} | {row[2]} | {over} |")
    return "\n".join(lines)


def with_table(readme, rows):
    before, rest = readme.split(BEGIN, 1)
    return f"{before}{BEGIN}\n\n{table(rows)}\n\n{END}{rest.split(END, 1)[1]}"


def sampled(costs, ticks):
    """Median of the inserted phase over these ticks."""
    inserted = [costs[tick][0] for tick in ticks if tick in costs and costs[tick][1]]
    return round(statistics.median(inserted)) if inserted else 0


def summary(costs, even):
    """(dearest tick, its cost, median of the inserted phase, its bound)."""
    worst = max(costs, key=lambda tick: costs[tick][0])
    return worst, costs[worst][0], sampled(costs, even), costs[worst][2]


def faults(row, costs, even):
    tick, worst, median, _ = row
    for at, (cost, _, bound) in sorted(costs.items()):
        if cost > bound:
            yield f"tick {at} takes {cost} instructions, more than its bound {bound}"
            break
    dearest = max(costs, key=lambda t: costs[t][0])
    if costs[tick][0] < (1 - TOLERANCE) * worst:
        yield f"tick {tick} takes {costs[tick][0]} instructions, less than the committed {worst}"
    if costs[dearest][0] > (1 + TOLERANCE) * worst:
        yield (f"tick {dearest} takes {costs[dearest][0]} instructions, more than the committed "
               f"{worst}")
    now = sampled(costs, even)
    if abs(now - median) > TOLERANCE * median:
        yield f"the median of the inserted phase is {now} instructions, not the committed {median}"


def around(ticks):
    return {tick + i for tick in ticks for i in range(-AROUND, AROUND + 1)}


def chosen(scene, last, report):
    """(ticks to count, those of them that make the median)"""
    if scene == WORST:  # a tick takes seconds; the last three that still add particles
        return {17, 18, 19}, [18]
    even = sorted({i * (last - 1) // (SAMPLES - 1) for i in range(SAMPLES)})
    return around({event["tick"] for event in report["events"]}) | set(even), even


def main(repository, build, scene, update):
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind here; toolchain/setup.sh installs it")
        return SKIPPED
    os.environ["STYLET_BIN"] = str(build / "bin")
    sys.path.insert(0, str(repository / "hal/scenes"))
    sys.dont_write_bytecode = True
    import play
    path, program = repository / "tests/rt/costs.txt", build / "bin/stylet_tick_costs"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        try:
            recording, report = (WORST, None) if scene == WORST else play.play(scene, folder)
        except play.DataMissing as missing:
            print(f"skipped: {missing}")
            return SKIPPED
        last = int(call([program, recording, folder, "0:1"]))
        ticks, even = chosen(scene, last, report)
        if not update:
            row = read_rows(path)[scene]
            ticks |= set() if scene == WORST else around({row[0]})
        costs = count(program, recording, folder, windows_of(ticks, last))
        if update and scene != WORST:
            dear = sorted(costs, key=lambda tick: -costs[tick][0])[:6]
            costs |= count(program, recording, folder, windows_of(around(dear), last))
    if update:
        row = summary(costs, even)
        write_row(path, scene, row)
        readme = repository / "tests/rt/README.md"
        readme.write_text(with_table(readme.read_text(), read_rows(path)))
    print(f"{scene}: {len(costs)} ticks counted; tick {row[0]} takes {row[1]} instructions of at "
          f"most {row[3]}; spread {spread(row)}")
    wrong = list(faults(row, costs, even))
    if wrong:
        wrong.append("if that is meant: tests/rt/costs.py REPOSITORY BUILD_FOLDER SCENE --update")
    print("\n".join(wrong))
    return bool(wrong)


if __name__ == "__main__":
    place, build_folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    sys.exit(main(place, build_folder, sys.argv[3], sys.argv[4:] == ["--update"]))
