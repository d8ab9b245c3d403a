#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every command in a block of a README runs as it is written: in a checkout and in an installed
tree, where another Python, which has no packages, comes first in the PATH.

usage: readme_test.py checkout|installed README...    with STYLET_BUILD and STYLET_SOURCE in the
environment; --slow: those that take minutes, and only those; --rest: of the READMEs not named

What cannot run in a test is in NOT_RUN with the reason; of these the program must be there.
"""
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
DATA = pathlib.Path(os.environ.get("STYLET_DATA", SOURCE / "../shared/data")).resolve()

# Pattern of the whole command: why it is not run.
NOT_RUN = {
    r"hd:|192\.168\.0\.5": "needs a device or a second machine",
    r"\./toolchain/(demo|test)\.sh": "installs packages and builds",
    r"cmake --preset .*": "builds for half an hour",
    r"cmake -S hal/hosts/browser .*|cmake --build build/browser": "hosts.browser does it",
    r"node hal/hosts/browser/.*|hal/hosts/browser/demo\.py": "needs that build; hosts.browser",
    r"cmake --install build/windows .*": "needs that build; hosts.windows makes it",
    r".*phantom liver .* hal/hosts/godot/project/.*": "for Godot; hosts.godot makes it",
    r"rt-host\.sh --|rt-host/boot\.sh": "changes the machine, as root, or boots one",
    r"apt-get .*|npm .*": "network",
    r".* NAME:10\.0\.0\.5:7790.*": "needs a device; hal_opened has a stand-in",
    r"stylet doctor --scene my\.toml": "needs a scene with a device; hal_opened",
    r"stylet bench --results.*": "measures for minutes, where nothing else runs",
    r"tests/bench/growth\.py .*": "counts instructions for minutes; bench.growth does it shortly",
    r"hal/console/pictures\.py|hal/scenes/play\.py --pictures": "draws for minutes; check.pictures",
    r"tests/golden/golden\.py$": "runs all scenes; so do e2e.scene.*",
    r"tests/fuzz/fuzz\.py .*": "builds and runs for minutes; fuzz.short does it",
    r".*tests/e2e/limit_cycles\.py": "runs all scenes twice; e2e.limit_cycles.all does it",
    r"tests/fidelity/calculix/(solve|stiffening)\.py": "needs CalculiX and twenty minutes",
    r".*stylet-simulator --ticks \d+ *": "takes hours; tier night",
    r".*--scheduler-file scheduler\.json.*": "needs a cluster; hosts.python.campaign.UnderSlurm",
    r".*examples/calibrate\.py .*": "takes a minute; hosts.python.calibrate.Example does it",
    r"cc -shared .*/stylet_godot\.c .*|godot3 .*": "needs the engine; hosts.godot runs it",
    r"snakemake .*slurm.*": "needs a cluster; offline.cohort.UnderSlurm makes one",
}
# They take minutes, so they run in the tier full.
SLOW = r"hal/scenes/play\.py --out scenes|stylet doctor --measure 60.*"
# 3 and 4: this machine is late, or has no real-time rights.
MACHINE = r"stylet (run|doctor)\b(?!.*--fast).*"
OF_THE_CHECKOUT = ("tests/", "toolchain/", "./toolchain/", "build/", "hal/console/pictures.py",
                   "STYLET_BIN=build", "hal/hosts/browser/", "cmake --build build/release",
                   "ctest --test-dir build")
PROGRAMS = {"stylet", "stylet-organ", "snakemake", "npm", "cmake", "apt-get", "ctest", "sbatch",
            "dask-scheduler"}
# Programs of other languages; if one is missing, its commands are skipped.
PROGRAMS_OF_HOSTS = {"cc", "godot3", "mcs", "mkoctfile", "mono", "octave"}


def logical_lines(block):
    lines, whole = [], ""
    for line in block:
        whole += line.rstrip().removesuffix("\\")
        if not line.rstrip().endswith("\\"):
            lines.append(" ".join(shlex.split(whole, comments=True, posix=False)))
            whole = ""
    return [line for line in lines if line]


def is_command(line, top):
    words = [word for word in line.split() if not re.match(r"[A-Z_]+=", word)]
    return bool(words) and (words[0] in PROGRAMS | PROGRAMS_OF_HOSTS or words[0] == "import" or
                            re.match(r"[\w./-]+/([\w.-]+\.(py|sh)|stylet[\w-]*)$|\./\w+$",
                                     words[0]) is not None)


def blocks(text):
    """Lines of each block that is set off by four blanks or by a fence; not Python's, which
    hosts.python.readme and hosts.python.organ_arrays run, nor JavaScript's (hosts.browser)."""
    block, fenced, elsewhere = [], False, False
    for line in text.splitlines() + [""]:
        if line.startswith("```"):
            fenced, elsewhere = not fenced, line in ("```python", "```js")
        elif fenced and elsewhere:
            continue
        elif fenced or line.startswith("    "):
            block.append(line.removeprefix("    "))
            continue
        if block:
            yield block
        block = []


def commands(readme):
    """Either every line of a block is a command or none is: in a mixed block a mistyped command
    would not be noticed."""
    found = []
    for block in blocks(readme.read_text()):
        try:
            lines = logical_lines(block)
        except ValueError:  # quotation marks of a drawing
            continue
        kinds = {is_command(line, SOURCE) for line in lines}
        if kinds == {True, False}:
            raise SystemExit(f"{readme}: half of this block are commands: {lines}")
        found += lines if kinds == {True} else []
    return found


class Tree:
    """The folder in which the commands run, with what a user would have there."""

    def __init__(self, kind, top):
        self.kind, self.bin = kind, BUILD / "bin"
        other = top / "another-python"
        other.mkdir()
        for name in ("python", "python3"):
            (other / name).write_text("#!/bin/sh\necho 'another python, without packages' >&2\n"
                                      "exit 1\n")
            (other / name).chmod(0o755)
        if kind == "installed":
            done = subprocess.run(["cmake", "--install", BUILD, "--prefix", top / "prefix"],
                                  capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(done.stderr)
            self.bin, self.top = top / "prefix/bin", top / "prefix/share/stylet"
            package = top / "prefix/lib/python3/dist-packages"
            outside = [line for line in done.stdout.splitlines() if line.startswith(
                ("-- Installing: ", "-- Up-to-date: ")) and str(top / "prefix/") not in line]
            if outside:
                raise SystemExit(f"outside of the prefix: {outside[:3]}")
        else:
            self.top, package = top / "checkout", BUILD / "python"
            for part in ("libraries", "development"):
                subprocess.run(["cmake", "--install", BUILD, "--prefix", top / "prefix",
                                "--component", part], check=True, capture_output=True)
            for name in ("hal", "offline", "tests", "toolchain", "README.md"):
                path = SOURCE / name
                if path.is_dir():
                    shutil.copytree(path, self.top / name, ignore=shutil.ignore_patterns(
                        "node_modules", "__pycache__", "generated"))
                else:
                    shutil.copy(path, self.top / name)
            (self.top / "CMakeLists.txt").touch()
            (self.top / "build").mkdir()
            (self.top / "build/release").symlink_to(BUILD)
        (self.top.parent / "shared").mkdir(exist_ok=True)
        if DATA.exists():
            (self.top.parent / "shared/data").symlink_to(DATA)
        self.env = {key: value for key, value in os.environ.items()
                    if key not in ("STYLET_BIN", "STYLET_SOURCE", "STYLET_BUILD", "PYTHONPATH")}
        self.env["XDG_CACHE_HOME"] = str(top / "caches")  # organs of scenes run by name
        # What the system finds by itself if Stylet is installed in /usr.
        self.env["PYTHONPATH"] = str(package)
        self.env["LD_LIBRARY_PATH"] = str(top / "prefix/lib")
        self.env["PKG_CONFIG_PATH"] = str(top / "prefix/lib/pkgconfig")
        self.env["PATH"] = f"{other}:{self.bin}:{os.environ['PATH']}"
        self.bring_inputs()

    def bring_inputs(self):
        organs = {"Liver.stl": "organs/openhelp_Liver.stl",
                  "wall.stl": "organs/openhelp_Abdominal_wall.stl",
                  "rib.stl": "organs/openhelp_Spleen.stl",
                  "seg.nii.gz": "labelmaps/ts_example_seg_fast_force_split.nii.gz"}
        for name, source in organs.items():
            if (DATA / source).exists():
                shutil.copy(DATA / source, self.top / name)
        for line in ("stylet-organ phantom liver --voxel-mm 10 -o liver.organ --mesh-out liver.off",
                     "stylet run hal/scenes/fig09-force-curve.toml --organ liver.organ --fast "
                     "--duration-s 2 --record out.h5"):
            done = self.run(line)
            if done.returncode != 0:
                raise SystemExit(f"{line}: exit code {done.returncode}\n{done.stderr}")
        (self.top / "out.h5").rename(self.top / "kept.h5")
        (self.top / "patients.csv").write_text(
            "patient,input,recipe,options,memory_mb\none,liver.off,,--units m --voxel-mm 10,\n")
        for name in ("proc", "sys"):
            (self.top / "captured" / name).mkdir(parents=True)

    def run(self, line):
        return subprocess.run(["bash", "-c", line], cwd=self.top, env=self.env, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=1500)

    def lacks(self, line):
        """Which shared data, or which program, a command needs that is missing here."""
        if line.split()[0] in PROGRAMS_OF_HOSTS and shutil.which(line.split()[0]) is None:
            return line.split()[0]
        names = [word for word in re.findall(r"[\w./-]+\.(?:stl|nii\.gz)", line)
                 if not (self.top / word).exists()]
        return names[0] if names else ""


def serve(tree, line):
    """Runs a command that does not end by itself: waits for its page's address, then sends
    Ctrl-C."""
    server = subprocess.Popen(["bash", "-c", "exec " + line], cwd=tree.top, env=tree.env, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
    stop = threading.Timer(120, server.kill)
    stop.start()
    said = ""
    for text in server.stdout:
        said += text
        if "http://" in text:
            time.sleep(1)
            server.send_signal(signal.SIGINT)
            break
    said += server.communicate()[0]
    stop.cancel()
    return server.returncode, said


def serves(line):
    return "--console" in line or line.startswith("stylet console")


def try_command(tree, line):
    """An empty text, or what is wrong."""
    if serves(line):
        for _ in range(30):  # another test may have the port
            code, said = serve(tree, line)
            if "in use" not in said:
                break
            time.sleep(2)
        if "http://" not in said and code == 0:
            return f"no page:\n{said}"
    else:
        if line.startswith("import "):
            line = f"/usr/bin/python3 -c {shlex.quote(line)}"
        done = tree.run(line)
        code, said = done.returncode, done.stdout + done.stderr
    if code in (3, 4) and re.fullmatch(MACHINE, line):
        print(f"      this machine: exit code {code}; once more in virtual time")
        if "run" in line.split()[:2] and not serves(line):
            return try_command(tree, line + " --fast --force")
        return ""
    return "" if code == 0 else f"exit code {code}\n{said[-3000:]}"


def program_is_there(tree, line):
    word = next(word for word in line.split() if not re.match(r"[A-Z_]+=", word))
    if "/" not in word:
        return ""
    path = tree.top / word
    return "" if os.access(path, os.X_OK) else f"{word}: is not there, or no program"


def try_readme(tree, name, slow):
    faults, ran = [], 0
    for line in commands(tree.top / name):
        if tree.kind == "installed" and line.startswith(OF_THE_CHECKOUT):
            continue
        if not (tree.top / "out.h5").exists() and "out.h5" in line and "--record" not in line:
            shutil.copy(tree.top / "kept.h5", tree.top / "out.h5")
        reason = next((why for pattern, why in NOT_RUN.items() if re.search(pattern, line)), "")
        missing = tree.lacks(line)
        if reason:
            fault, how = program_is_there(tree, line), f"not run: {reason}"
        elif (re.fullmatch(SLOW, line) is not None) != slow:
            continue
        elif missing:
            fault, how = "", f"skipped: {missing} is not there (shared data: set STYLET_DATA)"
        else:
            begin = time.monotonic()
            fault, ran = try_command(tree, line), ran + 1
            how = f"{time.monotonic() - begin:.1f} s"
        print(f"  {line}\n    {how}", flush=True)
        if fault:
            faults.append(f"{name}: {line}: {fault}")
    print(f"{name}: {ran} commands ran in the {tree.kind} tree")
    return faults


def all_readmes(top):
    """Not the book's pages, whose blocks follow from each other: book.pages runs those."""
    return sorted(path.relative_to(top).as_posix() for path in top.rglob("*.md")
                  if not {"build", "node_modules"} & set(path.relative_to(top).parts)
                  and path.parent != top / "toolchain/book" and path.name != "CHANGELOG.md")


def main(kind, *words):
    slow, rest = "--slow" in words, "--rest" in words
    named = [word for word in words if not word.startswith("--")]
    with tempfile.TemporaryDirectory(prefix="stylet-") as folder:
        tree = Tree(kind, pathlib.Path(folder))
        names = [name for name in all_readmes(tree.top) if name not in named] if rest else named
        faults = [fault for name in names for fault in try_readme(tree, name, slow)]
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
