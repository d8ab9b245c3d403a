# SPDX-License-Identifier: Apache-2.0
"""Builds the replay for another processor and runs it there, or in an emulator of it."""
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import wine  # noqa: E402

CASES = ("physical", "paper", "elastic", "added_mass", "stiffening", "sliding")
SKIPPED = 77
# Name -> (compiler, what runs the program; the board runs it as its kernel).
BOARD = ["qemu-system-arm", "-M", "mps2-an500", "-nographic", "-monitor", "none", "-serial", "none",
         "-chardev", "stdio,id=out"]
TARGETS = {
    "i686": ("i686-linux-gnu-g++", []),
    "aarch64": ("aarch64-linux-gnu-g++", ["qemu-aarch64"]),
    "cortex_m7": ("arm-none-eabi-g++", BOARD),
    "windows": (wine.COMPILER, ["wine"]),
    "wasm": ("em++", ["node", "--no-warnings", "--experimental-wasi-unstable-preview1",
                      pathlib.Path(__file__).with_name("run_wasm.mjs")]),
}


def call(command, environment=None):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          timeout=600, env=environment)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {done.returncode}\n"
                 f"{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


def runner_of(target, program):
    """What runs the program: for 32-bit x86 an emulator, if the system cannot run it."""
    runner = TARGETS[target][1]
    if target != "i686":
        return runner
    try:
        subprocess.run([program], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    except OSError:
        return ["qemu-i386"]
    return runner


def skip_without(target):
    compiler, runner = TARGETS[target]
    for program in (compiler, *runner[:1], *(["qemu-i386"] if target == "i686" else [])):
        if shutil.which(program) is None:
            purpose = " full" if target == "windows" else ""
            print(f"skipped: no {program} here; toolchain/setup.sh{purpose} installs it")
            sys.exit(SKIPPED)


def build(repository, tests_build, target):
    """The replay for that target, built from the host's recorded insertions."""
    folder = tests_build / target
    call(["cmake", "-G", "Ninja", "-S", repository / "tests/cross/target", "-B", folder,
          f"-DCMAKE_TOOLCHAIN_FILE={repository}/toolchain/cmake/target_{target}.cmake",
          "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2",
          f"-DSTYLET_CASES={tests_build}/cases"])
    call(["cmake", "--build", folder, "-j", "1"])
    return program_of(target, folder, "replay")


def program_of(target, folder, name):
    return folder / "bin" / (name + {"windows": ".exe", "wasm": ".wasm"}.get(target, ""))


def run(target, program, *words, options=()):
    """The lines `replay` prints there."""
    runner = runner_of(target, program)
    if target == "windows":
        drives = program.parents[1] / "wine"
        return call([*runner, program, *words], wine.environment(drives)).splitlines()
    if runner is not BOARD:
        return call([*runner, program, *words]).splitlines()
    semihosting = ",".join(["enable=on,target=native,chardev=out,arg=replay",
                            *(f"arg={word}" for word in words)])
    return call([*runner, *options, "-kernel", program, "-semihosting-config",
                 semihosting]).splitlines()


def arguments():
    """(repository, build folder of tests/cross, the rest of the command line)."""
    if len(sys.argv) < 3:
        sys.exit(sys.modules["__main__"].__doc__.strip())
    repository, build_folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    return repository, build_folder / "tests/cross", sys.argv[3:]
