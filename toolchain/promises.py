#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the README's table of promises: each promise, its tests, and what they last measured.

Reads the results that ctest left in a build folder for the scripts here (common.sh: run_tests), the
last one of every test, and writes the rows whose tests have results; other rows stay as they are. A
row's day is that of its oldest result. If some of a row's tests were not run, the row says so,
unless the table has more tests of the same day. Skipped tests do not count as results. --check
changes nothing: it refuses a table that does not consist of these rows, and a row without a test in
the build folder.

usage: promises.py REPOSITORY BUILD_FOLDER [--check]
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

BEGIN, END = "<!-- promises: toolchain/promises.py -->", "<!-- end of promises -->"
HEADER = "| promised | held by | last measured |\n| --- | --- | --- |"
NEVER = "not yet"
# (promise, regular expression for the names of its tests, what to take from their output: an
# expression whose groups fill in the text; None: only how many passed).
ROWS = [
    ("no heap, page fault or system call in a million ticks", r"rt_million_ticks\..*", None),
    ("no call that may block", r"rt\.rtsan\..*", None),
    ("the kernel calls only listed functions from outside", r"check\.symbols", None),
    ("a tick's stack is bounded, 32 KiB", r"rt\.stack",
     (r"(\d+) bytes at most.*deepest: (\d+) bytes", "{} bytes at most, {} used")),
    ("every loop ends", r"check\.loops", None),
    ("memory use is as predicted, to the byte, and as committed for 14 bodies", r"rt_memory\..*",
     None),
    ("same bits for gcc and clang, -O0 to -O3, SSE2, AVX2, AVX-512", r"rt\.determinism",
     (r"()\d+ series, last hash (\w+)\s*$", "{}last hash {}")),
    ("same bits with LTO, sanitizers, and for newer processors", r"rt\.determinism_all", None),
    ("same bits on 32-bit x86, 64-bit ARM, bare Cortex-M7, WebAssembly",
     r"cross\.(i686|aarch64|cortex_m7|wasm)", None),
    ("same bits with helper threads or without", r"rt_team\..*|hal_loop\.Helpers\..*", None),
    ("each scene gives the same recording; the wrench on the hand is the sum over the needle, "
     "within 1e-6",
     r"golden\..*|e2e\.scene\..*", None),
    ("instructions of a tick on the Cortex-M7", r"cross\.virtual_time",
     (r"elastic: worst (\d+), median (\d+)", "worst {}, median {}")),
    ("no tick takes more instructions than [its bound](tests/rt/README.md#costs); dearest "
     "ticks, AVX2",
     r"rt\.costs\..*", (r"(\S+): \d+ ticks counted; tick \d+ takes (\d+) instructions", "{} {}")),
    ("the same in random sessions, and no bound is above that of the worst case",
     r"simulator\.costs", (r"(\d+) ticks of (\d+) sessions: at most ([\d.]+) of their bounds",
                           "{} ticks of {} sessions, at most {} of the bound")),
    ("any file and any input is refused or harmless",
     r"fuzz\..*|unit_snapshot\..*|unit_sparse_organ\..*|offline\.every\..*", None),
    ("a needle in tissue is always felt", r"insertion_felt\..*", None),
    ("what must hold after every tick holds in [random sessions](tests/simulator/README.md)",
     r"simulator\.(?!costs).*", None),
    ("whatever stalls, fails or sends wrong numbers, the force at the motors of every backend "
     "is within its limits, changes no faster than allowed, is zero within 25 ms, and comes "
     "back only after an acknowledgement",
     r"hal_motor\..*|hal_motor_backends\..*", None),
    ("when recorder, OpenIGTLink or page crash, hang or starve, and whenever a signal comes, "
     "hand and recording are not harmed",
     r"e2e\.process\..*|e2e\.signals.*|console\.(Program|Wishes)\..*", None),
    ("a device that fails at any tick is handled", r"device_faults\..*", None),
    ("the guard's states are those of hal/guard/GUARD.md", r"hal_guard\.GuardStates\..*", None),
    ("with a Touch and an omega.7 there is no limit cycle, and the hand gets no energy",
     r"e2e\.limit_cycles\..*|hal_coupling\.SafetyScenes\..*", None),
    ("the second before a fault is kept", r"hal_flight\..*", None),
    ("volumes and positions in label maps are those that numpy computes",
     r"offline\.dicom\..*|offline\.frame\..*|offline_label_format_test\..*", None),
    ("a warning tells when a tissue, layer or obstacle lost or gained 5 %",
     r"offline_losses_test\..*", None),
    ("an output never overwrites an input; all outputs of a command appear, or none",
     r"hal_output_file\..*|offline\.outputs|offline_program_test\.Program\.Outputs.*", None),
    ("programs of earlier versions run with the library, with structs of any size; it exports what "
     "its headers declare, and nothing else", r"hosts_structs\..*|hosts\.exports", None),
    ("any call of the interface in C is done or refused", r"hosts_c_drawn\..*", None),
    ("Python, C#, MATLAB and Octave, Godot, browsers and Windows get the bits of C",
     r"hosts\.python\..*|hosts\.(csharp|octave|godot|browser|windows)", None),
    ("other people's projects find Stylet, installed, moved or inside theirs, and get its bits",
     r"hosts\.consumers\..*|hosts\.installed", None),
    ("packages install, run and go without a rest; built again they are the same, byte for byte",
     r"hosts\.packages\..*", None),
    ("every example has at most 60 lines", r"hosts\.examples", None),
    ("every command of the READMEs runs as written", r"e2e\.readme\..*", None),
    ("a Debian machine is made fit for real time, undone, and booted", r"rt_host\..*", None),
    ("tests reach every line and branch of kernel/src and offline/src, except listed ones",
     r"coverage\..*", None),
    ("a wrong line in guard, organ reader or coupling is noticed", r"mutation\.sample", None),
]
RESULTS = "Testing/results"
NOT_BUILT = "_NOT_BUILT"  # ctest's name for a program whose cases are not known before it is built


def read_results(folder):
    """Test -> (its output, whether it passed, the day) of its last run; without skipped tests."""
    results = {}
    suites = [xml.etree.ElementTree.parse(path).getroot() for path in folder.glob("*.xml")]
    for suite in sorted(suites, key=lambda suite: suite.get("timestamp")):
        for case in suite.iter("testcase"):
            name, status = case.get("name").split()[0], case.get("status")
            results.pop(name, None)
            if status in ("run", "fail"):
                output = case.findtext("system-out") or ""
                results[name] = (output, status == "run", suite.get("timestamp")[:10])
    return results


def tests_of(build):
    """Names of the build folder's tests. ctest lists them in another folder, because it empties the
    log of the folder it lists in, which may be the log of the run that calls this."""
    with tempfile.TemporaryDirectory() as top:
        entry = pathlib.Path(top) / "CTestTestfile.cmake"
        entry.write_text(f'subdirs("{pathlib.Path(build).resolve()}")\n')
        listing = subprocess.run(["ctest", "--test-dir", top, "-N"], check=True,
                                 capture_output=True, text=True).stdout
    return re.findall(r"Test +#\d+: (\S+)", listing)


def tests_of_row(pattern, tests):
    """The tests of a row; a program that is not built yet counts as one test."""
    return [test for test in tests if re.fullmatch(pattern, test) or test.endswith(NOT_BUILT) and
            any(each.startswith(re.escape(test.removesuffix(NOT_BUILT) + "."))
                for each in pattern.split("|"))]


def measured(row, results, tests):
    """The text of the row from the results of its tests; None if there are no results."""
    _, pattern, figure = row
    found = {name: results[name] for name in sorted(results) if re.fullmatch(pattern, name)}
    if not found:
        return None
    for name, (_, passed, day) in found.items():
        if not passed:
            return f"{day}: {name} failed"
    texts = []
    for output, _, _ in found.values():
        match = re.search(figure[0], output, re.S) if figure else None
        texts += [figure[1].format(*match.groups())] if match else []
    there = len(tests_of_row(pattern, tests))
    if there > len(found) or not texts:
        missing = there - len(found)
        texts.append(f"{len(found)} passed{f', {missing} not run' if missing > 0 else ''}")
    return f"{min(day for _, _, day in found.values())}: {'; '.join(texts)}"


def better(old, new):
    """The new text; but the old one if it is of the same day and from more of the tests."""
    part = re.search(r"(\d+) passed, \d+ not run$", new or "")
    if part and old[:10] == new[:10] and not old.endswith("failed"):
        had = re.search(r"(\d+) passed(?:, \d+ not run)?$", old)
        return old if had is None or int(had[1]) > int(part[1]) else new
    return new or old


def table_of(readme):
    """(text before the table, rows, text after it)"""
    before, rest = readme.split(BEGIN, 1)
    table, behind = rest.split(END, 1)
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")]
            for line in table.strip().splitlines()[2:]]
    return before, rows, behind


def held_by(pattern):
    text = pattern.replace("\\", "").replace("(?!costs)", "").replace(".*", "*")
    return "`" + text.replace("|", ", ") + "`"


def updated(readme, results, tests):
    before, rows, behind = table_of(readme)
    last = {row[0]: row[2] for row in rows}
    lines = [f"| {row[0]} | {held_by(row[1])} | "
             f"{better(last.get(row[0], NEVER), measured(row, results, tests))} |" for row in ROWS]
    return before + "\n".join([BEGIN, "", HEADER, *lines, "", END]) + behind


def faults(readme, tests):
    _, rows, _ = table_of(readme)
    if [row[:2] for row in rows] != [[row[0], held_by(row[1])] for row in ROWS]:
        yield "README.md: the table of promises is not promises.py's; run it without --check"
    for promise, pattern, _ in ROWS:
        if not tests_of_row(pattern, tests):
            yield f"{promise}: no test is called {pattern}"


def main(repository, build, check):
    path = pathlib.Path(repository) / "README.md"
    if check:
        found = list(faults(path.read_text(), tests_of(build)))
        print("\n".join(found))
        return bool(found)
    results = read_results(pathlib.Path(build) / RESULTS)
    path.write_text(updated(path.read_text(), results, tests_of(build)))
    return False


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:] == ["--check"]))
