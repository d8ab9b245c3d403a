#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Checks which room calls which, as the linker sees it: only rooms that rooms.txt names for it.

rooms.py reads includes. Those do not show a call of what the caller's own header declares and
another room defines, nor one whose header came in by way of a third. Here a function or variable
belongs to the room whose object file defines it; inline ones, which each user defines for itself,
to nobody.
Refused are a call of a room that is not named for the calling one, and a room in brackets that is
not called (if the calling one is built). Objects of sources that are gone are not read, nor what
another house defines.

usage: links.py REPOSITORY LIST BUILD_FOLDER
"""
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import rooms  # noqa: E402


def objects(repository, build, root, listed):
    """Object file -> its room, for the sources below `root`. CMake puts the object of a/b/c.cpp, a
    file of a target in a, at a/CMakeFiles/TARGET.dir/b/c.cpp.o."""
    found = {}
    for path in sorted((build / root.partition("/")[0]).rglob("*.o")):
        folder, _, inside = path.relative_to(build).as_posix().partition("/CMakeFiles/")
        source = repository / folder / inside.partition("/")[2].removesuffix(".o")
        if inside and source.is_file() and source.is_relative_to(repository / root):
            found[path] = rooms.room_of(listed, source.relative_to(repository / root).as_posix())
    return found


def symbols_of(paths):
    """Object file -> (what it defines for everybody, what it needs), by the linker's names."""
    listing = subprocess.run(["nm", "--format=posix", "--print-file-name", *paths], check=True,
                             capture_output=True, text=True).stdout
    seen = {path: (set(), set()) for path in paths}
    for line in listing.splitlines():
        place, _, rest = line.rpartition(": ")
        symbol, kind = rest.split()[:2]
        if kind in "TDBRU":
            seen[pathlib.Path(place)][kind == "U"].add(symbol)
    return seen


def demangled(symbols):
    return subprocess.run(["c++filt"], input="\n".join(symbols), capture_output=True, text=True,
                          check=True).stdout.splitlines()


def house_faults(root, room_of, uses, called):
    """`uses` and `called` as in rooms.read_list, of the house `root`."""
    seen, homes, needs = symbols_of(list(room_of)), {}, set()
    for path, (defined, _) in seen.items():
        for symbol in defined:
            homes.setdefault(symbol, set()).add(room_of[path])
    for path, (_, needed) in seen.items():
        needs |= {(room_of[path], symbol) for symbol in needed & homes.keys()}
    bad = sorted((room, symbol) for room, symbol in needs
                 if room and not homes[symbol] & {room, *uses[room], *called[room]})
    for (room, symbol), name in zip(bad, demangled([symbol for _, symbol in bad])):
        others = " or ".join(sorted(map(str, homes[symbol])))
        yield f"{root}: {room} does not use {others}, but needs {name}"
    for room, others in called.items():
        for other in others:
            if room in room_of.values() and not any(
                    caller == room and other in homes[symbol] for caller, symbol in needs):
                yield f"{root}: {room} is listed to call {other}, but does not"


def faults(repository, list_path, build):
    repository, build = pathlib.Path(repository).resolve(), pathlib.Path(build).resolve()
    for root, _, uses, called in rooms.read_list(list_path):
        room_of = objects(repository, build, root, uses)
        if room_of:
            yield from house_faults(root, room_of, uses, called)
        else:
            yield f"{root}: no object file in {build}, build it first"


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: links.py REPOSITORY LIST BUILD_FOLDER")
    found = list(faults(*sys.argv[1:]))
    print("\n".join(found))
    sys.exit(bool(found))
