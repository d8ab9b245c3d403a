#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks which room includes which: only rooms that rooms.txt lists below it and names for it.

A room is a folder of sources, or one that stands alone beside the folders: NAME.cpp with its
NAME.h. The list has, from the bottom up, each room with the rooms that it uses; so it cannot
contain a circle. In brackets it has what a room calls without an include (links.py), which is not
judged here. Refused are: an include of a room that is not named for the including room, a room that
is not listed, an include that does not name its room, and a listed use that no file needs any more.

usage: rooms.py REPOSITORY LIST
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.M)
SOURCES = {".h", ".cpp", ".c"}


def read_list(path):
    """[(root, prefix of its includes, {room: rooms it uses}, {room: rooms in brackets})]; rooms
    from the bottom up."""
    houses = []
    for line in pathlib.Path(path).read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if not line.startswith(" "):
            root, *prefix = line.split()
            houses.append((root, prefix[0] if prefix else "", {}, {}))
        else:
            room, _, uses = line.strip().partition(":")
            houses[-1][2][room] = [each for each in uses.split() if each[0] != "("]
            houses[-1][3][room] = [each[1:-1] for each in uses.split() if each[0] == "("]
    return houses


def room_of(rooms, file):
    """The listed room with the longest name that contains `file`, a path below the root."""
    found = [room for room in rooms
             if file.startswith(room + "/") or file in (room + ".h", room + ".cpp")]
    return max(found, key=len, default=None)


def list_faults(root, rooms):
    """Faults of the list itself: uses of a room that is not listed below."""
    below = set()
    for room, uses in rooms.items():
        for used in uses:
            if used not in below:
                yield f"{root}: {room} is to use {used}, which is not listed below it"
        below.add(room)


def house_faults(repository, root, prefix, rooms):
    yield from list_faults(root, rooms)
    top, used = repository / root, set()
    for path in sorted(top.rglob("*")):
        if path.suffix not in SOURCES:
            continue
        file = path.relative_to(top).as_posix()
        room, text = room_of(rooms, file), path.read_text()
        if room is None:
            yield f"{root}/{file}: its room is not listed"
            continue
        for match in INCLUDE.finditer(text):
            place = f"{root}/{file}:{text.count(chr(10), 0, match.start()) + 1}"
            named = match[1].removeprefix(prefix)
            if match[1].startswith(prefix) and (top / named).is_file():
                other = room_of(rooms, named)
                used.add((room, other))
                if other not in (None, room, *rooms[room]):
                    yield f"{place}: {room} does not use {other} ({match[1]})"
            elif (path.parent / match[1]).is_file():
                folder = prefix + file.rpartition("/")[0]
                yield f"{place}: {match[1]} does not say its room, {folder}"
    for room, uses in rooms.items():
        for other in uses:
            if (room, other) not in used:
                yield f"{root}: {room} is listed to use {other}, but no file does"


def faults(repository, list_path):
    for root, prefix, rooms, _ in read_list(list_path):
        yield from house_faults(pathlib.Path(repository), root, prefix, rooms)


if __name__ == "__main__":
    found = list(faults(*sys.argv[1:]))
    print("\n".join(found))
    sys.exit(bool(found))
