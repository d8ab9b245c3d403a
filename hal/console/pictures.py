#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Pictures of the scenes as the console shows them, for the README.

    hal/console/pictures.py [--out FOLDER] [--recordings FOLDER] [SCENE...]

Runs each scene on a virtual clock, plays the recording through `stylet console` and takes a
picture in Chromium without a screen. --recordings takes those that are there already (NAME.h5 with
NAME.organ beside it, as hal/scenes/play.py --out leaves them). Pictures go to
hal/console/pictures, or --out. Programs come from STYLET_BIN or build/release/bin. The npm packages
of hal/console/page must be there (toolchain/setup.sh).
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "scenes"))
sys.dont_write_bytecode = True
import play
import shown

# Where in the recording, from where, and who looks; the others: half way, the teacher, the side.
MOMENTS = {
    "fig03-puncture": (0.3, "teacher", "Tip"),
    "fig07-liver-flexible": (0.98, "engineer", "Oblique"),
    "fig08-liver-rigid": (0.5, "trainee", "Oblique"),
    "fig09-force-curve": (0.62, "teacher", "Side"),
    "fig10-steering": (0.95, "teacher", "Above"),
    "liver-biopsy": (0.55, "teacher", "Oblique"),
}
USUAL = (0.5, "teacher", "Side")
LARGEST_BYTES = 220_000


def take(name, recording, organ, picture):
    """Serves the recording on a free port for as long as the picture takes."""
    words = [play.BIN / "stylet", "console", recording, "--organ", organ, "--port", "0"]
    server = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
    try:
        line = server.stdout.readline()
        if "http://" not in line:
            raise RuntimeError(f"{name}: stylet console said: {line.strip()}")
        url = line[line.index("http://"):].split()[0]
        share, view, preset = MOMENTS.get(name, USUAL)
        play.call([find_node(), HERE / "page/picture.mjs", url, picture, share, view, preset])
    finally:
        server.terminate()
        server.communicate()
    size = picture.stat().st_size
    if size > LARGEST_BYTES:
        raise RuntimeError(f"{picture}: {size} bytes, allowed are {LARGEST_BYTES}")
    print(f"{name}: {picture}, {size} bytes")


def find_node():
    found = subprocess.run(["sh", "-c", "command -v node"], capture_output=True, text=True)
    if found.returncode != 0:
        raise RuntimeError("node is not there; toolchain/setup.sh installs it")
    return found.stdout.strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=HERE / "pictures")
    parser.add_argument("--recordings", type=pathlib.Path)
    parser.add_argument("scene", nargs="*", metavar="SCENE")
    options = parser.parse_args()
    unknown = set(options.scene) - set(play.scene_names())
    if unknown:
        sys.exit(f"pictures.py: {sorted(unknown)[0]}: expected one of "
                 f"{', '.join(play.scene_names())}")
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="stylet-") as scratch:
        folder = options.recordings or pathlib.Path(scratch)
        for name in options.scene or play.scene_names():
            if options.recordings is None:
                try:
                    play.play(name, folder)
                except play.DataMissing as missing:
                    print(f"{name}: skipped: {missing}")
                    continue
            take(name, folder / f"{name}.h5", folder / f"{name}.organ", options.out / f"{name}.png")
            if options.out == HERE / "pictures":
                shown.keep("page", name, folder / f"{name}.h5")


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"pictures.py: {error}")
