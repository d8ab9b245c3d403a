#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Are the committed pictures those of what the scenes do now, drawn as they are drawn now?

    hal/scenes/shown.py        # names each picture that is not, and the command that draws it

shown.json beside the pictures holds three hashes of each: of what it shows (the scene and its
golden replay), of what draws it, and of the picture itself. Pixels are not compared: another
version of gnuplot or Chromium may set a letter otherwise. The scripts that draw pictures keep the
hashes.
"""
import hashlib
import json
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
GOLDEN = ROOT / "tests/golden/scenes.json"

# Folder of pictures, their ending, the script that draws them and all that decides how.
KINDS = {
    "scenes": (HERE / "pictures", ".svg", "hal/scenes/play.py --pictures",
               ["hal/scenes/draw.py", "hal/palette.csv", "hal/app/plot.cpp",
                "hal/app/plot_look.h"]),
    "page": (ROOT / "hal/console/pictures", ".png", "hal/console/pictures.py",
             ["hal/console/pictures.py", "hal/console/page/picture.mjs",
              *(f"hal/console/page/dist/{name}" for name in ("index.html", "app.css", "app.js"))]),
}


def short_hash(*parts):
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]


def golden(name):
    return json.loads(GOLDEN.read_text())[name]


def outcome(name):
    """The golden replay less the hashes of the state: those also tell how memory is laid out."""
    scene = golden(name)
    return scene | {"points": [[tick, *rest] for tick, _, *rest in scene["points"]]}


def hashes(kind, name):
    """Of what a picture shows, what draws it, and itself; as it is now."""
    folder, ending, _, drawing = KINDS[kind]
    picture = folder / (name + ending)
    return {"shows": short_hash((HERE / f"{name}.toml").read_bytes(),
                                json.dumps(outcome(name), sort_keys=True).encode()),
            "drawn_by": short_hash(*((ROOT / path).read_bytes() for path in drawing)),
            "picture": short_hash(picture.read_bytes()) if picture.exists() else ""}


def table_of(kind):
    path = KINDS[kind][0] / "shown.json"
    return json.loads(path.read_text()) if path.exists() else {}


def keep(kind, name, recording):
    """After a picture was drawn of a recording, which must be the golden one."""
    import h5py
    with h5py.File(recording) as file:
        state = f"{int(file.attrs['final_state_hash']):016x}"
    if state != golden(name)["points"][-1][1]:
        raise RuntimeError(f"{name}: the recording is not the golden replay; "
                           "tests/golden/golden.py makes that anew")
    table = table_of(kind) | {name: hashes(kind, name)}
    text = ",\n".join(f" {json.dumps(key)}: {json.dumps(table[key])}" for key in sorted(table))
    (KINDS[kind][0] / "shown.json").write_text("{\n" + text + "\n}\n")


def faults(kind):
    folder, ending, command, _ = KINDS[kind]
    table = table_of(kind)
    names = set(json.loads(GOLDEN.read_text()))
    for name in sorted(names | set(table) | {path.stem for path in folder.glob("*" + ending)}):
        place = (folder / (name + ending)).relative_to(ROOT)
        if name not in names:
            yield f"{place}: of no scene"
            continue
        kept, now = table.get(name, {}), hashes(kind, name)
        for key, words in (("picture", "the picture itself"), ("drawn_by", "what draws it"),
                           ("shows", "the scene or what it gives")):
            if kept.get(key) != now[key]:
                yield f"{place}: {words} has changed since it was drawn: {command} {name}"


if __name__ == "__main__":
    found = [fault for kind in KINDS for fault in faults(kind)]
    print("\n".join(found))
    sys.exit(bool(found))
