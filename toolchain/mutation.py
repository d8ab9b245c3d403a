#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Do the tests notice a wrong line? Changes what hands depend on, one place at a time.

usage: mutation.py [SUBJECT]... [--build FOLDER] [--sample N]    (guard, grip, station, organ ...)

Each mutant is one change a programmer might make by mistake: a comparison flipped, an `and` made an
`or`, a sign, a limit by one, a clamp or a statement left out. It is compiled and the tests of its
file run, the quick ones first, until one fails; a mutant that no test fails on has survived. The
known survivors and why each is harmless are in mutation_survivors.txt; any other is an error.
With --sample only so many of each file, evenly spread.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[1]
SURVIVORS = SOURCE / "toolchain" / "mutation_survivors.txt"
# What is changed, and the programs that must notice, with their arguments: the quickest first.
SUBJECTS = {
    "guard": ("hal/src/guard.cpp", [["hal_guard"],
                                        ["device_faults", "--gtest_filter=DeviceFaults.*"],
                                        ["hal_loop"]]),
    "grip": ("hal/src/grip.cpp", [["hal_grip"], ["hal_loop"]]),
    "spring": ("hal/src/coupling.cpp", [["hal_coupling"]]),
    "packet": ("hal/src/packet.cpp", [["hal_packet"], ["hal_loop", "--gtest_filter=TwoS*"]]),
    "station": ("hal/src/station.cpp", [["hal_packet", "--gtest_filter=Station*"],
                                        ["hal_loop", "--gtest_filter=TwoS*"]]),
    "peer": ("hal/devices/peer_device.cpp", [["hal_loop", "--gtest_filter=TwoS*"],
                                             ["hal_device", "--gtest_filter=Peer*:*udp:*shm"]]),
    "link": ("hal/src/link.cpp", [["hal_packet", "--gtest_filter=SharedMemory*"],
                                  ["hal_device", "--gtest_filter=Peer*:*udp:*shm"]]),
    "organ": ("kernel/src/organ.cpp",
              [["unit_organ_open", "--gtest_filter=-*Fuzz*"], ["unit_odd_organ"],
               ["unit_sheets", "--gtest_filter=*Refused*"], ["unit_surface"],
               ["fuzz_organ", SOURCE / "tests/fuzz/seeds/organ"],
               ["unit_organ_open", "--gtest_filter=*Fuzz*"]]),
    "coupling": ("kernel/src/coupling.cpp",
                 [["fuzz_tick", SOURCE / "tests/fuzz/seeds/tick"]] +
                 [[f"coupling_{each}"] for each in ("friction", "pools", "relaxation", "continuity",
                                                    "strain", "energy", "phase_curve",
                                                    "momentum")] +
                 [[f"insertion_{each}"] for each in ("layers", "steering", "several", "bone",
                                                     "breathing")] +
                 [["unit_determinism", "--gtest_filter=*Flush*"], ["obstacle_contact"],
                  ["stylet-simulator", "--seed", "2", "--sessions", "4"], ["coupling_abuse"]]),
}
TIMEOUT_S = 300
FLIPS = {" < ": [" <= ", " >= "], " <= ": [" < "], " > ": [" >= ", " <= "], " >= ": [" > "],
         " == ": [" != "], " != ": [" == "], " && ": [" || "], " || ": [" && "],
         " + ": [" - "], " - ": [" + "], " += ": [" -= "], "++": ["--"],
         "return true": ["return false"], "return false": ["return true"]}
CALLS = re.compile(r"\b(clamp|max_of|min_of|settle)\(")
NUMBER = re.compile(r"(?<![\w.\"])(\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)(F|U|UL|ULL)?(?![\w.])")
STATEMENT = re.compile(r"^ {2,}(?!return|const|constexpr|break|continue|using|case|default)"
                       r"[\w*(+].*[;]$", re.M)


def blanked(text):
    """The text with comments, literals and preprocessor lines blanked."""
    token = re.compile(r'//[^\n]*|^#[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|static_assert[^;]*;',
                       re.S | re.M)
    return token.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def arguments_end(code, start):
    """Where the first argument and the whole call end that open before `start`."""
    depth, first = 1, None
    for at in range(start, len(code)):
        depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(code[at], 0)
        if code[at] == "," and depth == 1 and first is None:
            first = at
        if depth == 0:
            return first if first is not None else at, at + 1
    return start, start


def numbers(code):
    for match in NUMBER.finditer(code):
        digits, suffix = match[1], match[2] or ""
        if suffix == "F" or "." in digits or "e" in digits.lower():
            changed = [f"{float(digits) * 1.5 + (float(digits) == 0):g}"]
            changed = [each if "." in each or "e" in each else each + ".0" for each in changed]
        else:
            changed = [str(int(digits) + 1)] + ([str(int(digits) - 1)] if int(digits) > 0 else [])
        for each in changed:
            yield match.start(), match.end(), each + suffix


def mutations(text):
    """(first, behind, replacement) of every change, in the order of the file."""
    code = blanked(text)
    found = list(numbers(code))
    for word, replacements in FLIPS.items():
        for match in re.finditer(re.escape(word), code):
            found += [(match.start(), match.end(), each) for each in replacements]
    for match in re.finditer(r"(?<=[( ])!(?=[\w(])", code):
        found.append((match.start(), match.end(), ""))
    for match in CALLS.finditer(code):
        first, behind = arguments_end(code, match.end())
        found.append((match.start(), behind, "(" + text[match.end():first] + ")"))
    for match in STATEMENT.finditer(code):
        line = match[0]
        if line.count("(") == line.count(")") and not re.match(r" +[\w:<>]+[*&]? \w+( = |;|\{)",
                                                               line):
            found.append((match.start(), match.end(), " " * 2 + ";"))
    return sorted(set(found))


class Mutant:
    def __init__(self, text, change):
        first, behind, replacement = change
        self.text = text[:first] + replacement + text[behind:]
        self.line = text.count("\n", 0, first) + 1
        begin = text.rfind("\n", 0, first) + 1
        end = text.find("\n", behind)
        self.before = " ".join(text[begin:end].split())
        self.after = " ".join((text[begin:first] + replacement + text[behind:end]).split())


def known_survivors():
    """{(file, before, after): reason}: blocks of three lines and a blank one."""
    blocks = [block.splitlines() for block in SURVIVORS.read_text().split("\n\n")]
    known = {}
    for block in blocks:
        lines = [line for line in block if line and not line.startswith("#")]
        if not lines:
            continue
        file, reason = lines[0].split(": ", 1)
        known[(file, lines[1][2:], lines[2][2:])] = reason
    return known


def run(command, timeout=None):
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", timeout=timeout)
    except subprocess.TimeoutExpired:
        return None


def prepare(folder, programs):
    """A copy of the sources that can be changed, configured and built."""
    copy = folder / "source"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns(".git", "build"))
    for each, _ in SUBJECTS.values():
        (copy / each).touch()  # newer than the object of the last mutant of a subject
    done = run(["cmake", "-G", "Ninja", "-S", copy, "-B", folder / "build",
                "-DSTYLET_WITH_OFFLINE=OFF", "-DCMAKE_BUILD_TYPE=Release",
                "-DCMAKE_CXX_FLAGS=-Wno-error"])
    if done.returncode == 0:
        done = run(["ninja", "-C", folder / "build", *programs])
    if done.returncode != 0:
        sys.exit(done.stdout[-3000:] + "\nmutation.py: the unchanged sources do not build")


def killer(folder, tests):
    """The first program that fails, `compiler`, or None where all pass."""
    build = folder / "build"
    if run(["ninja", "-C", build, *{test[0] for test in tests}]).returncode != 0:
        return "compiler"
    for test in tests:
        done = run([build / "bin" / test[0], *test[1:]], TIMEOUT_S)
        if done is None or done.returncode != 0:
            return test[0]
    return None


def check(folder, subject, sample, known):
    """Survivors that nobody explained."""
    file, tests = SUBJECTS[subject]
    programs = sorted({test[0] for test in tests})
    prepare(folder, programs)
    if killer(folder, tests) is not None:
        sys.exit(f"mutation.py: the tests of {file} fail without a change")
    target = folder / "source" / file
    text = target.read_text()
    changes = mutations(text)
    if sample and sample < len(changes):
        changes = [changes[i * len(changes) // sample] for i in range(sample)]
    count, explained, unexplained, start = {}, 0, [], time.monotonic()
    for number, change in enumerate(changes, 1):
        mutant = Mutant(text, change)
        target.write_text(mutant.text)
        by = killer(folder, tests)
        count[by or "nobody"] = count.get(by or "nobody", 0) + 1
        if by is None and (file, mutant.before, mutant.after) in known:
            explained += 1
        elif by is None:
            unexplained.append(mutant)
            print(f"{file}:{mutant.line}: survived\n- {mutant.before}\n+ {mutant.after}\n",
                  flush=True)
        if number % 20 == 0:
            print(f"    {subject}: {number} of {len(changes)}", flush=True)
    target.write_text(text)
    by_whom = ", ".join(f"{name} {times}" for name, times in sorted(count.items()))
    print(f"{file}: {len(changes)} mutants, killed by: {by_whom}; {explained} survivors explained, "
          f"{len(unexplained)} not; {time.monotonic() - start:.0f} s", flush=True)
    return unexplained


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("subjects", nargs="*", help=f"of {', '.join(SUBJECTS)}; none: all")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build" / "mutation")
    parser.add_argument("--sample", type=int, default=0)
    options = parser.parse_args()
    for each in options.subjects:
        if each not in SUBJECTS:
            parser.error(f"{each}: expected one of {', '.join(SUBJECTS)}")
    folder = options.build.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    known = known_survivors()
    survived = [mutant for each in options.subjects or SUBJECTS
                for mutant in check(folder, each, options.sample, known)]
    sys.exit(1 if survived else 0)


if __name__ == "__main__":
    main()
