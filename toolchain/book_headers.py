#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Doxygen's filter: the plain comments of a header as comments that Doxygen reads.

usage: book_headers.py HEADER

A comment above a declaration is about it, one behind it on the same line, too. Lines of "====" or
"----" are headings and left out. What Doxygen would take for its commands or for tags is text.
"""
import pathlib
import re
import sys

TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*(?:\n[ \t]*//[^\n]*)*|/\*.*?\*/', re.S)
HEADING = re.compile(r"={4}|-{4}")


def words(comment):
    """The text of a comment, its lines without marks."""
    if comment.startswith("/*"):
        comment = comment[2:-2]
        lines = [re.sub(r"^\s*\* ?", "", line) for line in comment.splitlines()]
    else:
        lines = [re.sub(r"^\s*// ?", "", line) for line in comment.splitlines()]
    return [re.sub(r"([\\@<>#%&])", r"\\\1", line.strip()) for line in lines]


def filtered(text, name):
    first = True  # after the licence: what is said of the file
    out, end = [], 0
    for match in TOKEN.finditer(text):
        out.append(text[end:match.start()])
        end = match.end()
        comment = match[0]
        lines = words(comment) if comment.startswith("/") else []
        lines = [line for line in lines if "SPDX-License-Identifier" not in line]
        if not comment.startswith("/"):
            out.append(comment)
            continue
        behind = text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        said = " \n * ".join(line for line in lines if not HEADING.search(line))
        breaks = "\n" * comment.count("\n")
        if not said.strip() or HEADING.search(comment):
            out.append(breaks)
        elif first and not behind:
            out.append(f"/** \\file {name}\n * {said} */")
        elif behind and behind[-1] in ",;{}" or behind and not behind.startswith("#"):
            out.append(f"/**< {said} */")
        elif behind:  # a macro's
            out.append(f"/**< {said} */")
        else:
            out.append(f"/** {said} */")
        first = first and (not said.strip() or bool(behind))
    return "".join(out) + text[end:]


if __name__ == "__main__":
    path = pathlib.Path(sys.argv[1])
    print(filtered(path.read_text(), path.name), end="")
