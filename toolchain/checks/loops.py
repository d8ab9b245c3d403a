#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every loop of the kernel ends: it walks a range or counts towards a bound. All other
loops must be listed with what ends them: a constant of limits.h, or a size that organ_open checks.

A loop counts towards a bound if one variable of its head is compared with it and stepped towards it
(up for <, <= or !=, down for >, >= or !=), and its body does not write that variable. `while`,
`do`, `goto` and other heads are allowed only on the list.

usage: loops.py KERNEL_FOLDER ALLOW_LIST
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
import tidy  # noqa: E402

LOOP = re.compile(r"\b(for|while|do|goto)\b\s*(\()?")
STEPS = {  # direction: how a variable is stepped in it
    1: r"\+\+ ?{0}\b|{0} ?\+\+|{0} ?\+=",
    -1: r"-- ?{0}\b|{0} ?--|{0} ?-=",
}
# The comparison that a variable so stepped needs: left of it, or right of it.
BOUNDS = {1: (r">=?", r"<=?"), -1: (r"<=?", r">=?")}
WRITTEN = (r"\+\+ ?{0}\b|-- ?{0}\b|{0} ?(\+\+|--|[-+*/%&|^]?=(?!=)|<<=|>>=)|"
           r"(?<![&\w] )&{0}\b")


def head_of(code, begin):
    """The text from `begin` to the bracket that closes the one before `begin`, and its end."""
    depth, end = 1, begin
    while depth > 0 and end < len(code):
        depth += {"(": 1, ")": -1}.get(code[end], 0)
        end += 1
    return " ".join(code[begin:end - 1].split()), end


def body_of(code, begin):
    """The statement or block after `begin`, where the loop's head ends."""
    depth = 0
    for end in range(begin, len(code)):
        depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(code[end], 0)
        if depth == 0 and code[end] in ";}":
            return code[begin:end + 1]
    return code[begin:]


def counts_with(name, condition, step, body):
    name = rf"(?<![\w.>]){name}\b"  # but not a member of that name
    for direction, how in STEPS.items():
        how, (before, behind) = how.format(name), BOUNDS[direction]
        compared = (rf"(?<![<>=-])({before}|!=) ?{name}",
                    rf"{name}( ?\+\+| ?--| \+ \w+)? ?({behind}|!=)(?![<>=])")
        if re.search(how, step) or re.search(how, condition):
            return (any(re.search(each, condition) for each in compared) and
                    not re.search(WRITTEN.format(name), body))
    return False


def counts(head, body):
    """Whether a `for` walks a range or counts towards a bound."""
    parts = head.split(";")
    if len(parts) == 1:
        return ":" in head
    if len(parts) != 3:
        return False
    _, condition, step = parts
    names = set(re.findall(r"[A-Za-z_]\w*", condition))
    return any(counts_with(name, condition, step, body) for name in names)


def uncounted(name, text):
    """(file, line, word and head) of each loop that does not walk a range or count."""
    code = tidy.code_only(text)
    for match in LOOP.finditer(code):
        head, end = head_of(code, match.end()) if match[2] else ("", match.end())
        if match[1] == "for" and counts(head, body_of(code, end)):
            continue
        yield name, code.count("\n", 0, match.start()) + 1, f"{match[1]} ({head})"


def read_list(path):
    """{(file, loop): what ends it}"""
    rows = [line.split(" | ") for line in pathlib.Path(path).read_text().splitlines()
            if line and not line.startswith("#")]
    return {(file, loop): end for file, loop, end in rows}


def faults(kernel, allow_list):
    kernel = pathlib.Path(kernel)
    limits = (kernel / "include/stylet/limits.h").read_text()
    allowed, used = read_list(allow_list), set()
    for path in sorted((kernel / "src").rglob("*.*")):
        file = path.relative_to(kernel / "src").as_posix()
        for name, line, loop in uncounted(file, path.read_text()):
            if (name, loop) not in allowed:
                yield f"{name}:{line}: {loop}: nothing in its head bounds it"
            used.add((name, loop))
    for (name, loop), end in allowed.items():
        constant = re.match(r"k\w+", end)
        if (name, loop) not in used:
            yield f"{name}: {loop}: on the list, but not in the code"
        elif constant and not re.search(rf"\b{constant[0]}\b", limits):
            yield f"{name}: {loop}: ends by {constant[0]}, which limits.h does not have"


if __name__ == "__main__":
    found = list(faults(*sys.argv[1:]))
    print("\n".join(found))
    sys.exit(bool(found))
