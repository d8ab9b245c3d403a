#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the organ of one patient and writes down what came of it.

usage: build_one.py OUT PATIENT COMMAND...

COMMAND is `stylet-organ build ...` without its output. Writes OUT/organ/PATIENT.organ,
OUT/report/PATIENT/, and last OUT/outcome/PATIENT.json: the key figures, or why the data was
refused. Ends with an error only where stylet-organ neither built nor refused.
"""
import json
import os
import pathlib
import subprocess
import sys

REFUSED = 1  # exit code of stylet-organ


def figures(report):
    facts = json.loads(report.read_text(encoding="utf-8"))
    organ, quality = facts["organ"], facts["quality"]
    surface = quality["surface"] or {}
    return {"hash": organ["hash"], "voxels": organ["voxels"], "edge_mm": organ["voxel_edge_mm"],
            "volume_ml": organ["volume_ml"], "pieces": quality["piece_count"],
            "hausdorff_mm": surface.get("hausdorff_mm"), "findings": quality["findings"]}


def main():
    out, patient, command = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    organ, report = out / "organ" / f"{patient}.organ", out / "report" / patient
    outcome = out / "outcome" / f"{patient}.json"
    for folder in (organ.parent, report, outcome.parent):
        folder.mkdir(parents=True, exist_ok=True)
    organ.unlink(missing_ok=True)
    # What a build that was killed left half written.
    parts = [*organ.parent.glob(f"{patient}.*part-*"), *report.glob("*.part-*"),
             *outcome.parent.glob(f"{patient}.part-*")]
    for part in parts:
        part.unlink(missing_ok=True)
    done = subprocess.run([*command, "--name", patient, "-o", str(organ), "--sum",
                           "--report", str(report)],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    result = {"patient": patient}
    if done.returncode == 0:
        result.update(figures(report / "report.json"))
    elif done.returncode == REFUSED:
        result["refused"] = done.stderr.strip().removeprefix("stylet-organ: ")
    else:
        sys.exit(f"{patient}: stylet-organ ended with {done.returncode}: {done.stderr.strip()}")
    temporary = outcome.with_suffix(f".part-{os.getpid()}")
    temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    temporary.rename(outcome)


if __name__ == "__main__":
    main()
