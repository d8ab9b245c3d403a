#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every line and branch of kernel/src is reached, but for the exceptions listed with a reason.

usage: coverage.py LCOV_FILE SOURCE_FOLDER EXCEPTIONS_FILE

Reads what `llvm-cov export -format=lcov` wrote. An exception is a line
    FILE | CODE | REASON
of EXCEPTIONS_FILE: CODE is the source line as it is, without its indentation; it excuses that line
and its branches, wherever the file has it. An exception that excuses nothing is an error too.
"""
import collections
import pathlib
import sys


def read_lcov(path):
    """{file: ({line: count}, {line: {branch: count}})}"""
    files = {}
    for row in path.read_text().splitlines():
        kind, _, rest = row.partition(":")
        if kind == "SF":
            lines, branches = files.setdefault(rest, ({}, collections.defaultdict(dict)))
        elif kind == "DA":
            line, count = (int(each) for each in rest.split(",")[:2])
            lines[line] = lines.get(line, 0) + count
        elif kind == "BRDA":
            line, block, branch, count = rest.split(",")
            taken = 0 if count == "-" else int(count)
            key = (block, branch)
            branches[int(line)][key] = branches[int(line)].get(key, 0) + taken
    return files


def read_exceptions(path):
    """{(file, code): reason}"""
    exceptions = {}
    for number, row in enumerate(path.read_text().splitlines(), 1):
        if not row or row.startswith("#"):
            continue
        parts = [each.strip() for each in row.split(" | ")]
        if len(parts) != 3 or not all(parts):
            sys.exit(f"{path}:{number}: expected FILE | CODE | REASON")
        exceptions[parts[0], parts[1]] = parts[2]
    return exceptions


def report(files, folder, exceptions):
    """Lines of what is not covered and not excused; prints the totals."""
    total, missed, unused = [0, 0], [], dict(exceptions)
    excused = [0, 0]
    for name in sorted(files):
        path = pathlib.Path(name)
        if not path.is_relative_to(folder):
            continue
        text = path.read_text().splitlines()
        lines, branches = files[name]
        total[0] += len(lines)
        total[1] += sum(len(each) for each in branches.values())
        for line in sorted(set(lines) | set(branches)):
            without = sum(count == 0 for count in branches.get(line, {}).values())
            if lines.get(line, 1) > 0 and without == 0:
                continue
            short = path.relative_to(folder).as_posix()
            code = text[line - 1].strip()
            which = 1 if lines.get(line, 1) > 0 else 0
            if (short, code) in exceptions:
                unused.pop((short, code), None)
                excused[0] += which == 0
                excused[1] += without
                continue
            what = "not reached" if which == 0 else f"{without} branches not taken"
            missed.append(f"{name}:{line}: {what}: {code}")
    print(f"{total[0]} lines, {excused[0]} excused; {total[1]} branches, {excused[1]} excused")
    return missed + [f"{file}: excused for nothing: {code}" for file, code in unused]


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: coverage.py LCOV_FILE SOURCE_FOLDER EXCEPTIONS_FILE")
    lcov, folder, exceptions = (pathlib.Path(each).resolve() for each in sys.argv[1:])
    missed = report(read_lcov(lcov), folder, read_exceptions(exceptions))
    print("\n".join(missed))
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
