#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds a scene's organ, runs the scene on a virtual clock, and draws its picture.

    hal/scenes/play.py [--out FOLDER] [--pictures] [SCENE...]

A scene is named by its file, without folder or ending; none named: all. The organ's command is the
line `# organ: stylet-organ ...` of the scene, `{data}` in it the shared data, `{scenes}` this
folder. Programs come from STYLET_BIN, else from build/release/bin, in an installed tree from its
bin. Organ, recording and picture go to FOLDER (default: a new one); --pictures also puts the
picture into hal/scenes/pictures (shown.py). Needs python3-h5py and gnuplot.
"""
import argparse
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # a run leaves nothing in the repository
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DATA = pathlib.Path(os.environ.get("STYLET_DATA", ROOT / "../shared/data"))
BIN = pathlib.Path(os.environ.get("STYLET_BIN", ROOT / "build/release/bin" if
                                  (ROOT / "CMakeLists.txt").exists() else ROOT.parents[1] / "bin"))
MARK = "# organ: "


def drawing():
    """The module draw, whose packages only Debian's python3 may have."""
    try:
        import draw
    except ModuleNotFoundError as missing:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {missing}: run with /usr/bin/python3, for "
                 "which toolchain/setup.sh installs it")
    return draw


class DataMissing(Exception):
    """The shared data that an organ is made of is not there."""


def scene_names():
    return sorted(path.stem for path in HERE.glob("*.toml") if organ_command_of(path.stem))


def organ_command_of(name):
    """The arguments that make the scene's organ, without -o; empty if the file names none."""
    lines = (HERE / f"{name}.toml").read_text().splitlines()
    command = [line[len(MARK):] for line in lines if line.startswith(MARK)]
    return shlex.split(command[0]) if command else []


def call(words):
    if not pathlib.Path(words[0]).exists():
        raise RuntimeError(f"{words[0]}: is not there; build it, or set STYLET_BIN to its folder")
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{shlex.join(map(str, words))}: exit code {done.returncode}\n"
                           f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def organ_words(name):
    """The program and arguments that make the scene's organ, with the places filled in."""
    program, *arguments = organ_command_of(name)
    for place, path in (("{data}", DATA), ("{scenes}", HERE)):
        arguments = [word.replace(place, str(path)) for word in arguments]
    for word in arguments:
        mesh = word.split(":")[0]
        if mesh.startswith(str(DATA)) and not pathlib.Path(mesh).exists():
            raise DataMissing(f"{mesh} is not there; set STYLET_DATA")
    return [BIN / program, *arguments]


def build_organ(name, folder):
    organ = pathlib.Path(folder) / f"{name}.organ"
    call([*organ_words(name), "-o", organ])
    return organ


def play(name, folder, more=()):
    """Organ, then recording; returns the recording's path and the report of the run."""
    return run(HERE / f"{name}.toml", build_organ(name, folder),
               pathlib.Path(folder) / f"{name}.h5", more)


def run(scene, organ, recording, more=()):
    """Records a scene; returns the recording's path and the report of the run."""
    report = call([BIN / "stylet", "run", scene, "--organ", organ, "--fast", "--json", "--force",
                   "--record", recording, *more])
    return recording, json.loads(report)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("scene", nargs="*", metavar="SCENE")
    options = parser.parse_args()
    unknown = set(options.scene) - set(scene_names())
    if unknown:
        sys.exit(f"play.py: {sorted(unknown)[0]}: expected one of {', '.join(scene_names())}")
    draw = drawing()
    folder = options.out or pathlib.Path(tempfile.mkdtemp(prefix="stylet-"))
    folder.mkdir(parents=True, exist_ok=True)
    for name in options.scene or scene_names():
        try:
            recording, report = play(name, folder)
        except DataMissing as missing:
            print(f"{name}: skipped: {missing}")
            continue
        picture = folder / f"{name}.svg"
        draw.draw(name, draw.Run(recording), picture)
        if options.pictures:
            shutil.copy(picture, HERE / "pictures" / picture.name)
            import shown  # of the repository
            shown.keep("scenes", name, recording)
        print(f"{name}: {len(report['events'])} events, {picture}")


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"play.py: {error}")
