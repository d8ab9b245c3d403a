#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What do the hands feel of each number in the kernel that was measured or chosen?

usage: sensitivity.py [--check | --again] [--build FOLDER] [NAME]...   (names: play only these)

toolchain/constants.txt lists every number with a name, and where it comes from. For those measured
or chosen this builds the kernel once more from a copy in which each is a variable (the copy must
give the bits of the original), and plays drawn scenes with moving hands (tests/sensitivity) with
one of them halved, then doubled. kernel/constants.md gets what came of it. The hands follow the
same ways whatever they feel. --check plays nothing: it refuses a number in the sources that is not
listed, one that is listed twice or gone, and a table with another value or without a row. --again
plays everything, changes nothing, and refuses rows that came out otherwise. With only NAMEs of
another kind (a bound, say) nothing is built or played: the table gets their rows at once.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[1]
LIST, TABLE = "toolchain/constants.txt", "kernel/constants.md"
KERNEL = ("kernel/src/**/*.h", "kernel/src/**/*.cpp", "kernel/include/stylet/*.h")
KINDS = ("exact", "bound", "published", "derived", "speed", "measured", "chosen")
PLAYED = ("measured", "chosen")
SCENES = 12  # two of each kind
FACTORS = {"half": 0.5, "double": 2.0}
# Limits beyond which a promise that was kept before counts as broken: energy given to the hands; a
# force that changes at rest by this fraction of the largest in a millisecond, and three times as
# fast as before; tissue that still stores this fraction of the most once the needles are out.
ENERGY_J, TREMBLE, LEFT = -1e-6, 0.01, 0.01
# Rows that differ by more than this, in per cent of the force and as a fraction of themselves, have
# changed. Smaller differences may come from the C library, whose sines are in a hand's path.
ALIKE_PERCENT, ALIKE_SHARE = 1, 0.2
# For comparison with the constants: a change that no hand notices, and one that should not matter.
NOISE, TICK = "hands 1 nm deeper", "ticks of 0.5 ms, substeps as before"
CONTROLS = {NOISE: ["--deeper", "1e-9"], TICK: ["--parts", "2"]}
TUNED = """\
#pragma once

#include <cstdlib>
#include <cstring>

template <typename T>
inline T tuned(const char* name, T value) {
  const char* wanted = std::getenv("STYLET_CONSTANT");
  if (wanted == nullptr || std::strcmp(wanted, name) != 0) return value;
  return static_cast<T>(static_cast<double>(value) *
                        std::strtod(std::getenv("STYLET_FACTOR"), nullptr));
}
"""
HEAD = """\
# The kernel's numbers, and how much hands feel of them

Written by `toolchain/sensitivity.py` from `toolchain/constants.txt`, which also says what the kinds
below mean. The test `check.constants` fails if a value here differs from that in the sources, or a
text from that in the list.

| kind | how many numbers |
| --- | --- |
{counts}

## Measured or chosen numbers: effect of half and double

For each number, {scenes} random scenes with moving hands (`tests/sensitivity`) are run three times:
with the number as it is, with half of it and with twice as much. Every needle goes in, rests, steps
aside, swings by 1 mm at 4 Hz across and along, goes deeper, back and in again, and comes out. There
are six kinds of scene: rigid needle, elastic needle, on bone, two needles at once, on a surface
that is not punctured (`surface`), through layers and gaps (`layers`). The hands move the same
whatever they feel.

The columns *half* and *double* say how much the forces on the hands change. Forces are averaged
over 50 ms, and the largest change in a scene is given in per cent of the scene's largest force. The
first figure is the median of the scenes, the second is the largest of all scenes, and the kind of
the scene in which it occurs stands in brackets. (If a puncture comes 5 ms later, the average
changes by a tenth of the fall of the force.) 0 means that no force changed: these scenes do not
reach bounds against violent hands, rounding and rare shapes.

*Broken* says in how many scenes a promise is broken that holds with the present number. The
promises are: hands gain no energy (more than 1 uJ), no force trembles at rest, no needle is held
and no tissue is strained after the needle is out, and all numbers are finite.

For comparison, the first row changes nothing but the hands' path, by 1 nm: a change as small as
that means nothing. The second row has half of the tick, and shows what depends on its length.

| number | value | unit | half | double | broken | kind, and what it is or where it comes from |
| --- | --- | --- | --- | --- | --- | --- |
"""
REST_HEAD = """
## All others

| number | value | unit | kind | what it is or where it comes from |
| --- | --- | --- | --- | --- |
"""

Constant = collections.namedtuple("Constant", "file name unit kind origin")
Declaration = collections.namedtuple("Declaration", "begin end type names")
Scene = collections.namedtuple("Scene", "kind says force")


def listed(text):
    """The rows of constants.txt."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [Constant(*(cell.strip() for cell in line.split(" | ", 4))) for line in lines]


def blanked(text):
    return re.sub(r"//[^\n]*", lambda match: " " * len(match[0]), text)


def split_outside(text):
    """(begin, end) of the parts between commas that are outside brackets."""
    depth, begin, parts = 0, 0, []
    for at, letter in enumerate(text):
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append((begin, at))
            begin = at + 1
    return parts + [(begin, len(text))]


def declarations(text):
    """The declared constants: name -> (begin, end) of its value."""
    code = blanked(text)
    name = r"k[A-Z]\w*\s*(?:\[\w*\])?\s*[={]"
    for match in re.finditer(rf"\bconstexpr ((?:const )?[\w:]+\*?) (?={name})([^;]*);", code):
        names = {}
        for begin, end in split_outside(match[2]):
            part = re.match(r"\s*(k\w+)\s*(?:\[\w*\])?\s*=?\s*", match[2][begin:end])
            names[part[1]] = (match.start(2) + begin + part.end(), match.start(2) + end)
        yield Declaration(match.start(), match.end(), match[1], names)


def defaults(text):
    """Config::NAME -> (type, begin, end) of the default value, for numbers."""
    code = blanked(text)
    struct = re.search(r"^struct Config \{(.*?)^\};", code, re.S | re.M)
    if struct is None:
        return {}
    return {f"Config::{match[2]}": (match[1], struct.start(1) + match.start(3),
                                    struct.start(1) + match.end(3))
            for match in re.finditer(r"^  (float|std::uint32_t)\s+(\w+)\s*=\s*([^;]+);", struct[1],
                                     re.M)}


def values_in(text):
    """NAME -> its value as written; if there are several, all of them."""
    found = {}
    for each in declarations(text):
        for name, (begin, end) in each.names.items():
            value = " ".join(blanked(text)[begin:end].split())
            found[name] = f"{found[name]} or {value}" if name in found else value
    for name, (_, begin, end) in defaults(text).items():
        found[name] = " ".join(text[begin:end].split())
    return found


def read_values(constants, root=SOURCE):
    """(file, name) -> value, for the whole kernel and the other listed files."""
    files = {path.relative_to(root).as_posix() for each in KERNEL for path in root.glob(each)}
    files |= {each.file for each in constants if (root / each.file).exists()}
    return {(file, name): value for file in sorted(files)
            for name, value in values_in((root / file).read_text()).items()}


def is_played(constant):
    return constant.kind in PLAYED and constant.file.startswith("kernel/")


def parts_of(constant, values):
    """What is changed separately: the constant, or each of its elements. Name -> value."""
    value = values[constant[:2]]
    if not value.startswith("{"):
        return {constant.name: value}
    inside = value[1:-1]
    return {f"{constant.name}[{i}]": inside[begin:end].strip()
            for i, (begin, end) in enumerate(split_outside(inside))}


# ---- the kernel with variables


def tuned_value(type_name, name, value):
    scalar = type_name if type_name in ("float", "double", "std::uint32_t") else "double"
    if value.startswith("{"):
        inside = value[1:-1]
        parts = [f'tuned<{scalar}>("{name}[{i}]", {inside[begin:end].strip()})'
                 for i, (begin, end) in enumerate(split_outside(inside))]
        return "{" + ", ".join(parts) + "}"
    return f'tuned<{scalar}>("{name}", {value})'


def patched(text, names, all_names):
    """The text in which `names`, and constants computed from any of `all_names`, are variables."""
    changes = []
    for each in declarations(text):
        whole = text[each.begin:each.end]
        if any(name in names for name in each.names):
            for name, (begin, end) in each.names.items():
                if name in names:
                    changes.append((begin, end, tuned_value(each.type, name, text[begin:end])))
        elif not re.search(r"\b(" + "|".join(all_names) + r")\b", whole):
            continue
        changes.append((each.begin, each.begin + len("constexpr"), "const"))
    for name, (type_name, begin, end) in defaults(text).items():
        if name in names:
            changes.append((begin, end, tuned_value(type_name, name, text[begin:end])))
    for begin, end, new in sorted(changes, reverse=True):
        text = text[:begin] + new + text[end:]
    include = '#include "stylet/tuned.h"\n'
    return text.replace("#pragma once\n", "#pragma once\n" + include, 1) \
        if "#pragma once\n" in text else include + text


def make_tunable(root, constants):
    (root / "kernel/include/stylet/tuned.h").write_text(TUNED)
    names = {each.name for each in constants}
    for path in [path for each in KERNEL for path in root.glob(each)]:
        own = {each.name for each in constants if root / each.file == path}
        text = path.read_text()
        new = patched(text, own, names) if path.name != "tuned.h" else text
        if new.count("tuned<") or new.count("constexpr") != text.count("constexpr"):
            path.write_text(new)


def run(command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)
    if done.returncode != 0:
        sys.exit(f"{done.stdout[-3000:]}\nsensitivity.py: {command[0]} failed")
    return done.stdout


def build(folder, constants):
    """The program that plays the scenes, from a copy in which `constants` are variables."""
    shutil.rmtree(folder, ignore_errors=True)
    skip = shutil.ignore_patterns(".git", "build", "node_modules", "__pycache__")
    shutil.copytree(SOURCE, folder / "source", ignore=skip)
    if constants:
        make_tunable(folder / "source", constants)
    made = folder / "source/build"
    run(["cmake", "-G", "Ninja", "-S", folder / "source", "-B", made, "-DCMAKE_BUILD_TYPE=Release",
         "-DSTYLET_WITH_OFFLINE=OFF",
         # The compiler warns of an int to float conversion of a variable, but not of a constant.
         "-DCMAKE_CXX_FLAGS=-Wno-error=conversion"])
    run(["ninja", "-C", made, "stylet-sensitivity"],
        env=os.environ | {"CCACHE_BASEDIR": str(folder / "source")})
    return made / "bin/stylet-sensitivity"


# ---- scenes and what changes in them


def play(program, options=(), constant=None, factor=None):
    """Plays the scenes with one constant changed."""
    env = dict(os.environ)
    if constant is not None:
        env |= {"STYLET_CONSTANT": constant, "STYLET_FACTOR": str(factor)}
    lines = run([program, "--scenes", str(SCENES), *options], env=env).splitlines()
    scenes = []
    for head, forces in zip(lines[::2], lines[1::2]):
        words = head.split()
        says = dict(zip(words[::2], words[1::2]))
        force = np.array(forces.split(), float).reshape(-1, int(says["hands"]), 3)
        scenes.append(Scene(says["kind"], says, force))
    return scenes


def change_of(base, other):
    """Largest change of a force, divided by the largest force of the scene."""
    size = np.linalg.norm(base.force, axis=2).max()
    change = np.linalg.norm(other.force - base.force, axis=2).max()
    return float(change / size) if np.isfinite(change) else float("inf")


def broken_in(base, other):
    """Names of the promises that hold in `base` only."""
    size = float(np.linalg.norm(base.force, axis=2).max())
    old, new = base.says, other.says
    tremble = float(new["tremble_n"])
    if new["finite"] == "0":
        return ["finite"]
    found = {"energy": float(new["least_j"]) < ENERGY_J <= float(old["least_j"]),
             "trembles": tremble > max(TREMBLE * size, 3 * float(old["tremble_n"])),
             "held": new["held"] > old["held"],
             "strained": float(new["left_fraction"]) > LEFT >= float(old["left_fraction"])}
    return [name for name, is_broken in found.items() if is_broken]


def percent(share):
    value = 100 * share
    return "<0.01" if value < 0.01 else f"{value:.2g}" if value < 100 else f"{value:.0f}"


def judged(base, scenes):
    """(text of the changes, Counter of broken promises)"""
    changes = [change_of(a, b) for a, b in zip(base, scenes)]
    worst = max(range(len(changes)), key=changes.__getitem__)
    broken = collections.Counter(name for a, b in zip(base, scenes) for name in broken_in(a, b))
    if changes[worst] == 0:
        return "0", broken
    return (f"{percent(statistics.median(changes))}, {percent(changes[worst])} "
            f"({base[worst].kind})"), broken


def broken_text(found):
    """The text of the broken promises, from the counters of both factors."""
    texts = [f"{which}: " + ", ".join(f"{name} {count}" for name, count in sorted(broken.items()))
             for which, broken in found.items() if broken]
    return "; ".join(texts)


def measure(program, base, names):
    """Name -> (half, double, broken), also for the controls; prints its progress."""
    jobs = {(name, "half"): (options, None, None) for name, options in CONTROLS.items()}
    jobs |= {(name, which): ((), name, factor) for name in names
             for which, factor in FACTORS.items()}
    found = collections.defaultdict(dict)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        running = {pool.submit(play, program, *job): key for key, job in jobs.items()}
        for number, each in enumerate(concurrent.futures.as_completed(running), 1):
            name, which = running[each]
            found[name][which] = judged(base, each.result())
            text, broken = found[name][which]
            print(f"{number} of {len(jobs)}: {name}, {which}: {text}; {dict(broken)}", flush=True)
    return {name: (sides["half"][0], sides.get("double", ("",))[0],
                   broken_text({which: side[1] for which, side in sides.items()}))
            for name, sides in found.items()}


# ---- the table


def rows_of(table):
    """First cell of each row -> the other cells."""
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")]
            for line in table.splitlines() if line.startswith("| `") or line.startswith("| hands")
            or line.startswith("| ticks")]
    return {row[0]: row[1:] for row in rows}


def row(*cells):
    return "| " + " | ".join(cells) + " |\n"


def made_table(constants, values, results, old):
    """The whole table; rows without a result are taken from the old table."""
    counts = collections.Counter(each.kind for each in constants)
    text = HEAD.format(scenes=SCENES, counts="\n".join(
        f"| {kind} | {counts[kind]} |" for kind in KINDS))
    for name in CONTROLS:
        text += row(name, "", "", *results.get(name, old.get(name, [""] * 6)[2:5]), "")
    for each in filter(is_played, constants):
        for part, value in parts_of(each, values).items():
            felt = results.get(part, old.get(f"`{part}`", [""] * 5)[2:5])
            text += row(f"`{part}`", value, each.unit, *felt, f"{each.kind}: {each.origin}")
    text += REST_HEAD
    for each in constants:
        if not is_played(each):
            text += row(f"`{each.name}`, {each.file}", values[each[:2]].replace("|", "\\|"),
                        each.unit, each.kind, each.origin)
    return text


def faults(constants, values, table):
    """What is wrong with list and table; with the table's texts only if nothing else is."""
    found = list(faults_of_values(constants, values, table))
    if not found and made_table(constants, values, {}, rows_of(table)) != table:
        found = [f"{TABLE}: its texts are not those of {LIST}; run sensitivity.py kPi"]
    return found


def faults_of_values(constants, values, table):
    seen = collections.Counter(each[:2] for each in constants)
    for file, name in sorted(set(values) - set(seen)):
        if file.startswith("kernel/") or any(file == each.file for each in constants):
            yield f"{file}: {name} is not in {LIST}"
    for (file, name), times in seen.items():
        if (file, name) not in values:
            yield f"{LIST}: {file} has no {name}"
        if times > 1:
            yield f"{LIST}: {file}: {name} is there {times} times"
    for each in constants:
        if each.kind not in KINDS:
            yield f"{LIST}: {each.name}: no kind: {each.kind}"
    rows = rows_of(table)
    for each in constants:
        for part, value in (parts_of(each, values) if is_played(each) and each[:2] in values
                            else {}).items():
            cells = rows.get(f"`{part}`")
            if cells is None or not cells[2]:
                yield f"{TABLE}: {part} is not there, or was not played; run sensitivity.py {part}"
            elif cells[0] != value:
                yield f"{TABLE}: {part} is {value} now, not {cells[0]}; run sensitivity.py {part}"
    rest = {f"`{each.name}`, {each.file}": values[each[:2]].replace("|", "\\|")
            for each in constants if not is_played(each) and each[:2] in values}
    table_rest = {key: cells[0] for key, cells in rows.items() if "`, " in key}
    for key in sorted(set(rest) | set(table_rest)):
        if rest.get(key) != table_rest.get(key):
            yield (f"{TABLE}: {key} is {rest.get(key, 'gone')}, not "
                   f"{table_rest.get(key, 'there')}; run sensitivity.py with the name of any row")


def differences(results, rows):
    """Rows of the table whose results are now different."""
    for name, felt in results.items():
        cells = rows.get(name if name in CONTROLS else f"`{name}`", [""] * 5)[2:5]
        for now, then in zip(felt, cells):
            a, b = ([float(each) for each in re.findall(r"\d+(?:\.\d+)?|inf", text)]
                    for text in ("0, 0" if each == "0" else each for each in (now, then)))
            if len(a) != len(b) or any(
                    not abs(x - y) <= max(ALIKE_PERCENT, ALIKE_SHARE * max(x, y))
                    for x, y in zip(a, b) if x != y):
                yield f"{TABLE}: {name}: '{now}' now, not '{then}'; run sensitivity.py"


def to_play(constants, values, wanted):
    """The constants, or their elements, that are played for these names; all for none."""
    listed_names = {name for each in constants if each[:2] in values
                    for name in (each.name, *parts_of(each, values))}
    for name in wanted:
        if name not in listed_names:
            sys.exit(f"sensitivity.py: {name}: not in {LIST}")
    return [part for each in filter(is_played, constants) for part in parts_of(each, values)
            if not wanted or {part, each.name} & set(wanted)]


def played_results(folder, constants, names):
    """Name -> (half, double, broken), of these and the controls."""
    base = play(build(folder / "plain", []))
    program = build(folder / "tuned", list(filter(is_played, constants)))
    same = play(program)
    if [each.says for each in base] != [each.says for each in same]:
        sys.exit("sensitivity.py: the kernel with variables is not the kernel")
    return measure(program, base, names)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/sensitivity")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    options.build = options.build.resolve()  # ccache needs an absolute path
    constants = listed((SOURCE / LIST).read_text())
    values = read_values(constants)
    path = SOURCE / TABLE
    table = path.read_text() if path.exists() else ""
    if options.check:
        found = list(faults(constants, values, table))
        print("\n".join(found))
        return bool(found)
    names = to_play(constants, values, options.names)
    results = played_results(options.build, constants, names) if names else {}
    if options.again:
        found = list(differences(results, rows_of(table)))
        print("\n".join(found))
        return bool(found)
    table = made_table(constants, values, results, rows_of(table))
    path.write_text(table)
    begins = tuple(f"| `{name}{end}" for name in options.names for end in ("`", "["))
    print("".join(line for line in table.splitlines(True) if line.startswith(begins)), end="")
    return False


if __name__ == "__main__":
    sys.exit(main())
