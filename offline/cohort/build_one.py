#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the organ of one patient and writes down the result.

usage: build_one.py OUT PATIENT ATTEMPTS_LEFT COMMAND...
       build_one.py OUT PATIENT ATTEMPTS_LEFT --refused NAME REASON

COMMAND is `stylet-organ build ...` without its output. Writes OUT/organ/PATIENT.organ,
OUT/report/PATIENT/, and last OUT/outcome/PATIENT.json: the key figures, or why the data was
refused. Ends with an error where stylet-organ neither built nor refused, as long as it will be
tried again.
"""
import json
import os
import pathlib
import subprocess
import sys

REFUSED, USAGE = 1, 2  # exit codes of stylet-organ


def figures(report):
    facts = json.loads(report.read_text(encoding="utf-8"))
    organ, quality = facts["organ"], facts["quality"]
    surface = quality["surface"] or {}
    return {"hash": organ["hash"], "voxels": organ["voxels"], "edge_mm": organ["voxel_edge_mm"],
            "volume_ml": organ["volume_ml"], "pieces": quality["piece_count"],
            "hausdorff_mm": surface.get("hausdorff_mm"), "findings": quality["findings"]}


def write_outcome(outcome, result):
    temporary = outcome.with_suffix(f".part-{os.getpid()}")
    temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    temporary.rename(outcome)


def build(command, organ, report, attempts_left):
    done = subprocess.run([*command, "--name", organ.stem, "-o", str(organ), "--sum",
                           "--report", str(report)],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          errors="replace")
    if done.returncode == 0:
        return figures(report / "report.json")
    said = done.stderr.strip()
    if done.returncode == REFUSED:
        return {"refused": said.removeprefix("stylet-organ: ")}
    if done.returncode == USAGE:
        return {"refused": "options: " + (said.splitlines() or [""])[0]}
    if attempts_left == 0:
        return {"refused": f"stylet-organ ended with {done.returncode} each time: {said[-200:]}; "
                           f"remove outcome/{organ.stem}.json to try again"}
    sys.exit(f"{organ.stem}: stylet-organ ended with {done.returncode}: {said}")


def main():
    out, patient, attempts_left = pathlib.Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    command = sys.argv[4:]
    organ, report = out / "organ" / f"{patient}.organ", out / "report" / patient
    outcome = out / "outcome" / f"{patient}.json"
    for folder in (organ.parent, report, outcome.parent):
        folder.mkdir(parents=True, exist_ok=True)
    organ.unlink(missing_ok=True)
    # Partly written files of a build that was killed.
    parts = [*organ.parent.glob(f"{patient}.*part-*"), *report.glob("*.part-*"),
             *outcome.parent.glob(f"{patient}.part-*")]
    for part in parts:
        part.unlink(missing_ok=True)
    if command[0] == "--refused":
        return write_outcome(outcome, {"patient": command[1], "refused": command[2]})
    result = build(command, organ, report, attempts_left)
    return write_outcome(outcome, {"patient": patient} | result)


if __name__ == "__main__":
    main()
