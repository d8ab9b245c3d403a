#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The insertion of the paper's Fig. 9 by the paper's own rules and by the kernel's, on one pair of
axes, and in numbers.

usage: paper.py BUILD_FOLDER [--check]

Draws toolchain/book/figures/paper.svg and writes the table of toolchain/book/paper.md; --check says
whether that table is still right.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv[1]).resolve()
sys.path[:0] = [str(SOURCE / "tests/e2e"), str(SOURCE / "hal/scenes")]
PAGE = SOURCE / "toolchain/book/paper.md"
TABLE = re.compile(r"(?<=<!-- made by tests/fidelity/paper.py -->\n\n).*?(?=\n<!-- end -->)", re.S)
MODES = {"paper": "the paper's rules", "physical": "the kernel's own"}

import h5py
import numpy as np

import force_curve


def curves(folder):
    """Mode -> the force curve of one insertion into one liver."""
    organ, found = folder / "liver.organ", {}
    subprocess.run([BUILD / "bin/stylet-organ", "phantom", "liver", "--voxel-mm", "5", "-o", organ],
                   check=True, stdout=subprocess.DEVNULL)
    for mode in MODES:
        recording = folder / f"{mode}.h5"
        subprocess.run([BUILD / "bin/stylet", "run", SOURCE / "hal/scenes/fig09-force-curve.toml",
                        "--organ", organ, "--fast", "--mode", mode, "--record", recording],
                       check=True, capture_output=True)
        with h5py.File(recording) as file:
            found[mode] = force_curve.read_curve(file)
    return found


def numbers(curve):
    """What each sentence of the paper about its Fig. 9 comes to: [(sentence, number)]."""
    peak = curve.force_n[curve.contact:curve.puncture].max()
    after = curve.force_n[curve.puncture:curve.puncture + 50].min()
    slope, _, _ = force_curve.insertion(curve)
    hold = curve.force_n[curve.hold:curve.retraction]
    pull = -curve.force_n[curve.retraction:curve.exit].min()
    rest = np.abs(curve.force_n[curve.exit + 50:]).max()
    return [("\"force reduces sharply after a force peak\"",
             f"{peak:.2f} N, then {after:.2f} N within 50 ms"),
            ("\"slipping friction force increases with the penetration\"",
             f"by {slope / 1e3:.4f} N/mm"),
            ("\"a relaxation stage\"", f"in 3 s by {100 * (1 - hold[-1] / hold[0]):.0f} %"),
            ("\"for retraction, the force also increases because of friction force\"",
             f"the largest pull is {pull:.2f} N"),
            ("\"when needle is totally outside, the force returns to zero\"",
             f"at most {rest:.4f} N from 50 ms on")]


def table(found):
    columns = [numbers(found[mode]) for mode in MODES]
    rows = [" | ".join([said, *(column[i][1] for column in columns)])
            for i, (said, _) in enumerate(columns[0])]
    head = f"the paper says | {' | '.join(MODES.values())}"
    return "\n".join(f"| {row} |" for row in [head, "--- | --- | ---", *rows]) + "\n"


def draw(found, picture):
    import matplotlib
    matplotlib.use("svg")
    from draw import OTHERS, PALETTE
    from matplotlib import pyplot
    pyplot.rcParams.update({"svg.hashsalt": "stylet", "svg.fonttype": "path", "font.size": 10,
                            "axes.spines.top": False, "axes.spines.right": False})
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.8), layout="constrained",
                                            sharey=True)
    for mode, colour in zip(MODES, (OTHERS[1], PALETTE["total"])):
        curve = found[mode]
        shown = slice(curve.contact - 500, curve.exit + 700)
        left.plot(curve.time_s[shown], curve.force_n[shown], color=colour, lw=1.3,
                  label=MODES[mode])
        right.plot(1e3 * curve.travel_m[shown], curve.force_n[shown], color=colour, lw=1.3)
    left.set(xlabel="time / s", ylabel="force along x / N", title="as in the paper: one direction")
    right.set(xlabel="way of the tip beyond the first contact / mm", title="the same over the way")
    for axes in (left, right):
        axes.axhline(0, color="#bbbbbb", lw=0.8, zorder=0)
    left.legend(frameon=False)
    figure.savefig(picture, metadata={"Date": None, "Creator": None})


def main(check):
    with tempfile.TemporaryDirectory(prefix="stylet-paper-") as name:
        found = curves(pathlib.Path(name))
        made, page = table(found), PAGE.read_text()
        if check:
            if TABLE.search(page)[0] != made:
                sys.exit(f"{PAGE}: its table should be\n{made}\ntests/fidelity/paper.py writes it")
            return
        draw(found, SOURCE / "toolchain/book/figures/paper.svg")
        PAGE.write_text(TABLE.sub(lambda _: made, page))


if __name__ == "__main__":
    main(sys.argv[2:] == ["--check"])
