#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the headers of Godot 3's GDNative from the source of Debian's package godot3: those of the
engine that Debian has, to the last entry of its table. Elsewhere they are the engine's own project
godot-headers, branch 3.x.

usage: headers.py FOLDER      which is made
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

FETCH = pathlib.Path(__file__).resolve().parents[3] / "toolchain/debian_source.sh"


def main(folder):
    with tempfile.TemporaryDirectory() as top:
        source = pathlib.Path(top) / "godot3"
        done = subprocess.run([FETCH, "godot3", source], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr.strip())
        module = source / "modules/gdnative"
        sys.dont_write_bytecode = True
        sys.path[:0] = [str(module), str(source)]
        import gdnative_builders  # the engine's own
        table = json.loads((module / "gdnative_api.json").read_text())
        shutil.copytree(module / "include", folder)
        (folder / "gdnative_api_struct.gen.h").write_text(
            gdnative_builders._build_gdnative_api_struct_header(table))


if __name__ == "__main__":
    if len(sys.argv) != 2 or pathlib.Path(sys.argv[1]).exists():
        sys.exit(__doc__.strip())
    main(pathlib.Path(sys.argv[1]))
