#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How the work grows: instructions (AVX2) against voxels, constraint particles, rods, triangles.

Counts with callgrind, for AVX-512 by single-stepping; fits a line to each, and fails if the counts
do not lie on it, if a step takes more than its budget, or if the count depends on how violent the
hand is. Writes the counts and, with gnuplot, their picture. With --readme it also fails if the
counts of a step in that file differ from these by more than one percent.

usage: growth.py STYLET_WORK [--out FOLDER] [--quick] [--readme README]
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Instructions a voxel, physical mode, needle inserted, 5k voxels: of a step with true mass, whose
# filter takes three passes there, and of a sweep alone, a step with added mass. With AVX-512 the
# passes have 8 lanes as well: more instructions than with 16, but in less time
# (kernel/decisions/08).
BUDGET = {"step": {"avx2": 227, "avx512": 162}, "sweep": {"avx2": 125, "avx512": 62}}
STRAIGHT = 0.10  # largest distance of a point from the line, of the largest count
SAID = re.compile(r"takes ([\d.]+) instructions a voxel with AVX2 and ([\d.]+) with AVX-512\. "
                  r"The sweep takes ([\d.]+) and ([\d.]+) of these")
SAID_ARE = [("step", "avx2"), ("step", "avx512"), ("sweep", "avx2"), ("sweep", "avx512")]


def measure(program, voxels, unit_mm, rods, hand, what):
    """Instructions, and what stylet-work says it worked on."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "profile"
        command = ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--collect-atstart=no",
                   f"--callgrind-out-file={out}", program, voxels, unit_mm, rods, hand, what]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{done.stderr[-2000:]}")
        of = {key: int(value) for key, value in re.findall(r"(\w+)=(\d+)", done.stdout)}
        counts = re.findall(r"^(?:summary|totals): (\d+)", out.read_text(), re.M)
        return int(counts[-1]), of


def line(points):
    """Least squares: slope, and largest distance of a point, over the largest count."""
    count = len(points)
    mean_x = sum(x for x, _ in points) / count
    mean_y = sum(y for _, y in points) / count
    square = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / square
    start = mean_y - slope * mean_x
    worst = max(abs(y - start - slope * x) for x, y in points)
    return start, slope, worst / max(y for _, y in points)


def series(program, quick):
    """name -> points (amount, instructions)"""
    voxels = [1000, 2000, 5000] if quick else [1000, 2000, 5000, 10000, 20000, 50000]
    units = [5, 2.5, 1.25] if quick else [5, 3, 2, 1.5, 1.25, 1]
    rods = [16, 64, 128] if quick else [8, 16, 32, 64, 96, 128]
    found = {"voxels": [], "constraint particles": [], "rods": [], "triangles": []}
    for n in voxels:
        count, of = measure(program, n, 5, 0, "away", "step")
        found["voxels"].append((of["voxels"], count))
        whole, _ = measure(program, n, 5, 0, "away", "tick")
        found["triangles"].append((of["triangles"], whole - 2 * count))
    for unit in units:
        count, of = measure(program, 1000, unit, 0, "quiet", "tick")
        found["constraint particles"].append((of["cps"], count))
    for n in rods:
        found["rods"].append((n, measure(program, 1000, 5, n, "quiet", "tick")[0]))
    return found


def judge(found):
    for name, points in found.items():
        if name == "triangles":  # queries of a tree: limits.h has their bound
            if max(y for _, y in points) > 60000:
                yield f"a query of the surface takes {max(y for _, y in points)} instructions"
            continue
        _, slope, bend = line(points)
        print(f"{name}: {slope:.1f} instructions each, at most {100 * bend:.1f} % off the line")
        if len(points) > 2 and bend > STRAIGHT:
            yield f"{name}: {100 * bend:.1f} % off the line, allowed are {100 * STRAIGHT:.0f} %"


def judge_step(program, each_out):
    for what, budget in BUDGET.items():
        count, of = measure(program, 5000, 5, 0, "quiet", what)
        yield from judge_each(what, "avx2", count, of, budget, each_out)
        done = subprocess.run([program, "5000", "5", "0", "quiet", what, "avx512"],
                              capture_output=True, text=True)  # callgrind knows no AVX-512
        if done.returncode == 77:
            print(f"{what} with AVX-512: cannot be counted on this machine")
            continue
        of = {key: int(value) for key, value in re.findall(r"(\w+)=(\d+)", done.stdout)}
        yield from judge_each(what, "avx512", of["instructions"], of, budget, each_out)
    quiet, of_quiet = measure(program, 1000, 5, 0, "quiet", "step")
    violent, of_violent = measure(program, 1000, 5, 0, "violent", "step")
    print(f"step under a quiet hand {quiet}, under a violent one {violent}")
    if of_quiet == of_violent and quiet != violent:
        yield f"a violent hand takes {violent} instructions a step, a quiet one {quiet}"
    if of_quiet != of_violent:
        yield f"not the same work, so it proves nothing: {of_quiet}, {of_violent}"


def judge_each(what, instruction_set, count, of, budget, each_out):
    each = each_out[what, instruction_set] = count / of["voxels"]
    print(f"{what} of {of['voxels']} voxels, {of['passes']} passes, {of['cps']} constraint "
          f"particles, {instruction_set}: {each:.1f} a voxel")
    if each > budget[instruction_set]:
        yield (f"{what}, {instruction_set}: {each:.1f} instructions a voxel, "
               f"allowed are {budget[instruction_set]}")


def judge_readme(path, each):
    said = SAID.search(path.read_text())
    if said is None:
        yield f"{path}: says no more how many instructions a voxel takes"
        return
    for text, of in zip(said.groups(), SAID_ARE):
        if of in each and abs(float(text) - each[of]) > 0.01 * each[of]:
            yield f"{path}: says {text} a voxel for {' with '.join(of)}, counted are {each[of]:.1f}"


def write(found, folder):
    folder.mkdir(parents=True, exist_ok=True)
    rows = [f"{name},{x},{y}" for name, points in found.items() for x, y in points]
    (folder / "growth-avx2.csv").write_text("amount of,amount,instructions\n" +
                                            "\n".join(rows) + "\n")
    if shutil.which("gnuplot") is None:
        return
    script = ["set terminal svg size 900,640 font 'DejaVu Sans,11' background 'white'",
              f"set output '{folder / 'growth.svg'}'", "set multiplot layout 2,2",
              "set key top left", "set yrange [0:*]", "set xrange [0:*]",
              "set ylabel 'instructions, AVX2'", "set format y '%.1s%c'", "set format x '%.0s%c'"]
    for name, points in found.items():
        start, slope, _ = line(points)
        data = "\n".join(f"{x} {y}" for x, y in points)
        key = name.replace(" ", "_")
        script += [f"${key} << END", data, "END", f"set xlabel '{name}'",
                   f"plot ${key} with points pt 7 notitle, {start}+{slope}*x "
                   f"title '{slope:.1f} each'"]
    subprocess.run(["gnuplot"], input="\n".join(script) + "\nunset multiplot\n", text=True,
                   check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--readme", type=pathlib.Path)
    options = parser.parse_args()
    if shutil.which("valgrind") is None:
        print("skipped: valgrind, which counts the instructions, is not installed")
        return 77
    if "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
        print("skipped: this processor has no AVX2, for which the budget is")
        return 77
    found = series(options.program, options.quick)
    each = {}
    faults = [*judge(found), *judge_step(options.program, each)]
    if options.readme:
        faults += judge_readme(options.readme, each)
    if options.out:
        write(found, options.out)
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
