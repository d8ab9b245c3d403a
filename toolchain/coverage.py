#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every line and branch of a folder is reached, except those listed with a reason.

usage: coverage.py EXPORT_FILE SOURCE_FOLDER EXCEPTIONS_FILE

Reads the output of `llvm-cov export`. A branch is one side of a condition; the constant `true` has
no branch. Code that is compiled several times (templates, several instruction sets) is reached if
one copy is. A source without a line in any test program is an error. An exception is a line
    FILE | CODE | REASON
of EXCEPTIONS_FILE. CODE is the source line without its indentation; it excuses that line and its
branches at every place in the file. NO CODE excuses a source that only includes others. An
exception that excuses nothing is an error, too; one that holds by chance only where no line of its
file is its code any more.
"""
import collections
import json
import pathlib
import sys


CHANCE = "by chance"  # an exception whose reason begins with this may also be reached


def line_counts(segments):
    """{line: largest count}; a segment is (line, column, count, counted, entered, gap)."""
    counts = {}
    for this, following in zip(segments, segments[1:] + [None]):
        line, _, count, counted, entered, gap = this
        if not counted or gap:
            continue
        last = following[0] if following is not None else line
        last -= following is not None and following[1] == 1
        for each in range(line, last + 1):
            # A line counts as what begins in it; only other lines as the region that goes on.
            if each == line or each not in counts:
                counts[each] = max(counts.get(each, 0), count) if each == line else count
    return counts


def branch_sides(branches):
    """{line: {(column, end line, end column, side): count}}, summed over instantiations."""
    sides = collections.defaultdict(collections.Counter)
    for line, column, end_line, end_column, true, false, *_ in branches:
        for side, count in ((True, true), (False, false)):
            sides[line][column, end_line, end_column, side] += count
    return sides


def stale(folder, exceptions):
    """Exceptions whose code is no line of their file."""
    lines = {}
    for file, code in exceptions:
        if file not in lines:
            path = folder / file
            text = path.read_text() if path.is_file() else ""
            lines[file] = {"NO CODE"} | {each.strip() for each in text.splitlines()}
        if code not in lines[file]:
            yield file, code


def read_exceptions(path):
    """{(file, code): reason}"""
    exceptions = {}
    for number, row in enumerate(path.read_text().splitlines(), 1):
        if not row or row.startswith("#"):
            continue
        file, _, rest = row.partition(" | ")
        code, _, reason = rest.rpartition(" | ")  # code may have a bar of its own
        if not (file.strip() and code.strip() and reason.strip()):
            sys.exit(f"{path}:{number}: expected FILE | CODE | REASON")
        exceptions[file.strip(), code.strip()] = reason.strip()
    return exceptions


class Report:
    def __init__(self, folder, exceptions):
        self.folder, self.exceptions, self.unused = folder, exceptions, dict(exceptions)
        self.lines = self.branches = self.excused_lines = self.excused_branches = 0
        self.missed = []

    def add(self, path, lines, branches):
        text = path.read_text().splitlines()
        short = path.relative_to(self.folder).as_posix()
        self.lines += len(lines)
        self.branches += sum(len(each) for each in branches.values())
        for line in sorted(set(lines) | set(branches)):
            without = [f"never {str(side).lower()}: {text[line - 1][first - 1:end - 1]}"
                       if last == line else f"never {str(side).lower()}"
                       for (first, last, end, side), count in branches.get(line, {}).items()
                       if count == 0 and text[line - 1][first - 1:end - 1] != "true"]
            reached = lines.get(line, 1) > 0
            if reached and not without:
                continue
            key = short, text[line - 1].strip()
            if key in self.exceptions:
                self.unused.pop(key, None)
                self.excused_lines += not reached
                self.excused_branches += len(without)
            else:
                what = "; ".join(without) if reached else "not reached"
                self.missed.append(f"{short}:{line}: {what}: {key[1]}")


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: coverage.py EXPORT_FILE SOURCE_FOLDER EXCEPTIONS_FILE")
    export, folder, exceptions = (pathlib.Path(each).resolve() for each in sys.argv[1:])
    report = Report(folder, read_exceptions(exceptions))
    seen = set()
    for file in json.loads(export.read_text())["data"][0]["files"]:
        path = pathlib.Path(file["filename"])
        if path.is_relative_to(folder):
            seen.add(path)
            report.add(path, line_counts(file["segments"]), branch_sides(file["branches"]))
    absent = [path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.cpp"))
              if path not in seen]
    missed = report.missed + [f"{name}: in no test program" for name in absent
                              if report.unused.pop((name, "NO CODE"), None) is None]
    gone = set(stale(folder, report.unused))
    missed += [f"{file}: excused for nothing: {code}"
               for (file, code), reason in report.unused.items()
               if (file, code) in gone or not reason.startswith(CHANCE)]
    print(f"{report.lines} lines, {report.excused_lines} excused; "
          f"{report.branches} branches, {report.excused_branches} excused; {len(missed)} missing")
    print("\n".join(missed))
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
