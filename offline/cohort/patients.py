# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of patients: one row each, as CSV.

Columns: patient (letters, digits, _ . -), input (a label map, or meshes as PATH[:TISSUE[:PRIORITY]]
apart by spaces), and optional: recipe, options (more of `stylet-organ build`), memory_mb. Paths are
relative to the table.
"""
import csv
import dataclasses
import pathlib
import re
import shlex
import sys

COLUMNS = ["patient", "input", "recipe", "options", "memory_mb"]
USUAL_MEMORY_MB = 1500


@dataclasses.dataclass
class Patient:
    inputs: list  # words for the command line
    files: list  # what they read
    recipe: str
    options: list
    memory_mb: int


def fail(table, number, what):
    sys.exit(f"{table}:{number}: {what}")


def read_row(table, number, row):
    folder = pathlib.Path(table).parent
    if not re.fullmatch(r"[A-Za-z0-9_.-]+", row["patient"] or ""):
        fail(table, number, f"patient '{row['patient']}': expected letters, digits, _ . -")
    memory = row.get("memory_mb") or str(USUAL_MEMORY_MB)
    if not memory.isdigit() or int(memory) < 1:
        fail(table, number, f"memory_mb '{memory}': expected a whole number")
    inputs, files = [], []
    for word in shlex.split(row["input"] or ""):
        path, _, tissue = word.partition(":")
        files.append(str(folder / path))
        inputs.append(files[-1] + (":" + tissue if tissue else ""))
    if not inputs:
        fail(table, number, "input: expected a label map or meshes")
    recipe = str(folder / row["recipe"]) if row.get("recipe") else ""
    # A file that is not there is for stylet-organ to refuse: one bad patient stops no other.
    present = [file for file in files + [recipe] if file and pathlib.Path(file).exists()]
    return Patient(inputs, present, recipe, shlex.split(row.get("options") or ""), int(memory))


def read_patients(table):
    """Patients by name, in the table's order."""
    try:
        with open(table, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            unknown = [name for name in rows.fieldnames or [] if name not in COLUMNS]
            if unknown or not {"patient", "input"} <= set(rows.fieldnames or []):
                fail(table, 1, f"expected the columns {', '.join(COLUMNS)}; the first two at least")
            patients = {}
            for number, row in enumerate(rows, 2):
                if row["patient"] in patients:
                    fail(table, number, f"patient '{row['patient']}' is there already")
                patients[row["patient"]] = read_row(table, number, row)
    except OSError as error:
        sys.exit(f"{table}: {error.strerror}")
    return patients


def build_command(tool, patient):
    """Without the output files, which build_one.py adds."""
    recipe = ["--recipe", patient.recipe] if patient.recipe else []
    return [tool, "build", *patient.inputs, *recipe, *patient.options]
