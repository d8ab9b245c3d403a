#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the bound of a tick's stack: the largest sum of frames along a path of the call graph.

Compiles the kernel's sources as the build does, with -fcallgraph-info (GCC), adds up frames from
the roots down and refuses recursion, frames of variable size, and calls through pointers that are
not listed here. The bound must not exceed kTickStackBytes of limits.h, and must not be less than
what PROGRAM used of a painted stack.

usage: stack.py REPOSITORY BUILD_FOLDER PROGRAM
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = "stylet::tick("
# Functions that a call through a pointer may reach, by the caller's name: all are taken as callees.
POINTERS = {
    "stylet::tick(": r"stylet::lattice_step_\w+\(const Kernel&",
    "sweep_one(": r"\{anonymous\}::sweep_part\(",  # inlined or not
    "sweep_together(": r"\{anonymous\}::sweep_part\(",
    "ccdMPRPenetration": r"\{anonymous\}::(hull|segment)_(support|centre)\(",
}
# Bytes of functions outside the kernel, including what they call. libccd: at most 1528 bytes on the
# longest path of Debian's library (disassembled), rounded up; the others need a few words.
OUTSIDE = {"ccdMPRPenetration": 2048, "memcpy": 256, "memmove": 256, "memset": 256, "memcmp": 256,
           "sqrt": 64, "sqrtf": 64, "__assert_fail": 0}
ALIGNMENT = 64  # bytes that a realigned frame may lose
RED_ZONE = 128  # what a function that calls nothing may use below its frame (x86-64 ABI, 3.2.2)
NODE = re.compile(r'node: \{ title: "([^"]*)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"')
FRAME = re.compile(r"\\n(\d+) bytes \(([a-z,]+)\)")


class Graph:
    """Functions by their linker names; `label` has their readable names."""

    def __init__(self):
        self.label, self.frame, self.calls, self.faults = {}, {}, {}, []

    def add(self, text):
        for title, label in NODE.findall(text):
            self.label.setdefault(title, label.split("\\n")[0])
            frame = FRAME.search(label)
            if frame:
                size = int(frame[1]) + (ALIGNMENT if frame[2] == "dynamic,bounded" else 0)
                self.frame[title] = max(size, self.frame.get(title, 0))
                if frame[2] == "dynamic":
                    self.faults.append(f"{self.label[title]}: a frame of variable size")
        for caller, callee in EDGE.findall(text):
            self.calls.setdefault(caller, set()).add(callee)

    def named(self, part):
        return [title for title in self.frame if part in self.label[title]]

    def through_pointers(self, caller):
        label = self.label.get(caller, caller)
        return [target for part, targets in POINTERS.items() if part in label
                for target in self.frame if re.search(targets, self.label[target])]

    def callees(self, caller):
        for callee in sorted(self.calls.get(caller, ())):
            if callee != "__indirect_call":
                yield callee
        targets = self.through_pointers(caller)
        if "__indirect_call" in self.calls.get(caller, ()) and not targets:
            self.faults.append(f"{self.label[caller]}: a call through a pointer that is not listed")
        yield from targets

    def deepest(self, function, path=(), known=None):
        """(bytes, functions) of the path from `function` down that needs most bytes."""
        known = {} if known is None else known
        if function in path:
            self.faults.append(f"{self.label.get(function, function)}: calls itself, through "
                               + " -> ".join(self.label.get(f, f) for f in path))
            return 0, ()
        if function not in known:
            frame = self.frame.get(function, OUTSIDE.get(function))
            if frame is None:
                self.faults.append(f"{self.label.get(function, function)}: a frame nobody knows")
                frame = 0
            below = max((self.deepest(callee, (*path, function), known)
                         for callee in self.callees(function)), default=(RED_ZONE, ()))
            known[function] = (frame + below[0], (function, *below[1]))
        return known[function]


def compile_graph(build, folder):
    """The call graph of the kernel, compiled as in the build folder; objects are not kept."""
    graph = Graph()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        words = entry["command"].split()
        if "/kernel/src/" not in entry["file"] or "-o" not in words:
            continue
        if pathlib.PurePath(words[0]).name == "ccache":  # would keep the object but not its graph
            words = words[1:]
        out = folder / pathlib.PurePath(entry["file"]).with_suffix(".o").name
        words[words.index("-o") + 1] = str(out)
        subprocess.run([*words, "-fcallgraph-info=su"], cwd=entry["directory"], check=True)
        graph.add(out.with_suffix(".ci").read_text())
    return graph


def limit(repository):
    text = (repository / "kernel/include/stylet/limits.h").read_text()
    return int(re.search(r"kTickStackBytes = ([\d']+);", text)[1].replace("'", ""))


def bound(graph, root=ROOT):
    roots = graph.named(root)
    if not roots:
        graph.faults.append(f"no function {root}")
    return max((graph.deepest(function) for function in roots), default=(0, ()))


def main(repository, build, program):
    with tempfile.TemporaryDirectory() as folder:
        graph = compile_graph(pathlib.Path(build), pathlib.Path(folder))
    size, path = bound(graph)
    for function in path:
        frame = graph.frame.get(function, OUTSIDE.get(function))
        print(f"{frame:6} {graph.label.get(function, function)}")
    done = subprocess.run([program], capture_output=True, text=True)
    print(f"{size} bytes at most; of a painted stack:\n{done.stdout}{done.stderr}", end="")
    faults, most = list(dict.fromkeys(graph.faults)), limit(pathlib.Path(repository))
    if size > most:
        faults.append(f"{size} bytes, kTickStackBytes is {most}")
    used = [int(line.split()[-2]) for line in done.stdout.splitlines()]
    print(f"deepest: {max(used, default=0)} bytes")
    if done.returncode != 0 or not used:
        faults.append("the painted stack was not measured")
    elif max(used) > size:
        faults.append(f"{max(used)} bytes were used, more than the bound: a call is missing")
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
