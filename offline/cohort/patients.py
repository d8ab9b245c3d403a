# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of patients: one row each, as CSV, as spreadsheets write it: UTF-8 or UTF-16 with or
without byte-order mark (else Windows' Western letters), commas, semicolons or tabs, quoted or not.

Columns: patient (letters, digits, _ . -), input (a label map, or meshes as PATH[:TISSUE[:PRIORITY]]
apart by spaces), and optional: recipe, options (more of `stylet-organ build`), memory_mb. Paths are
relative to the table. A row that says something else is a patient that is refused.
"""
import codecs
import csv
import dataclasses
import io
import pathlib
import re
import shlex
import sys

COLUMNS = ["patient", "input", "recipe", "options", "memory_mb"]
USUAL_MEMORY_MB = 1500
SEPARATORS = ",;\t"


class BadRow(Exception):
    """Why the patient of a row cannot be built."""


@dataclasses.dataclass
class Patient:
    shown: str  # as the table has it
    inputs: list = dataclasses.field(default_factory=list)  # words for the command line
    files: list = dataclasses.field(default_factory=list)  # what they read
    recipe: str = ""
    options: list = dataclasses.field(default_factory=list)
    memory_mb: int = USUAL_MEMORY_MB
    refused: str = ""


def words(text, what):
    try:
        return shlex.split(text)
    except ValueError as error:
        raise BadRow(f"{what} '{text}': {error}") from error


def read_row(table, row):
    folder = pathlib.Path(table).parent
    if row[None]:
        raise BadRow(f"'{row[None][0]}' has no column: expected {', '.join(COLUMNS)}")
    memory = row["memory_mb"] or str(USUAL_MEMORY_MB)
    if not re.fullmatch("[0-9]{1,9}", memory) or int(memory) < 1:
        raise BadRow(f"memory_mb '{memory}': expected a whole number")
    inputs, files = [], []
    for word in words(row["input"], "input"):
        path, _, tissue = word.partition(":")
        files.append(str(folder / path))
        inputs.append(files[-1] + (":" + tissue if tissue else ""))
    if not inputs:
        raise BadRow("input: expected a label map or meshes")
    recipe = str(folder / row["recipe"]) if row["recipe"] else ""
    # stylet-organ refuses missing files later, so that a bad patient does not stop the others.
    present = [file for file in files + [recipe] if file and pathlib.Path(file).exists()]
    return Patient(row["patient"], inputs, present, recipe, words(row["options"], "options"),
                   int(memory))


def text_of(data):
    for mark, encoding in ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"),
                           (codecs.BOM_UTF16_BE, "utf-16")):
        if data.startswith(mark):
            return data.decode(encoding)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252")


def cells_of(text):
    """Rows of (line, cells), with the separator that divides the first row into columns."""
    told = re.match(r"sep=(.)\r?\n", text)  # a first line that some spreadsheets write and hide
    skipped = 1 if told else 0
    text = text[told.end():] if told else text
    head = text.splitlines()[0] if text else ""
    separator = told.group(1) if told else max(
        SEPARATORS, key=lambda each: len(next(csv.reader([head], delimiter=each), [])))
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    rows = [(reader.line_num + skipped, [cell.strip() for cell in row]) for row in reader]
    return [(line, row) for line, row in rows if any(row)]


def rows_of(table):
    """Rows by column, with the line that each ends in; cells without a column are under None."""
    try:
        rows = cells_of(text_of(pathlib.Path(table).read_bytes()))
    except OSError as error:
        sys.exit(f"{table}: {error.strerror}")
    except (UnicodeDecodeError, csv.Error) as error:
        sys.exit(f"{table}: {error}: expected a table as CSV")
    names = [name.lower() for name in rows[0][1]] if rows else []
    while names and not names[-1]:
        names.pop()
    wrong = [name for name in names if name not in COLUMNS or names.count(name) > 1]
    if wrong or not {"patient", "input"} <= set(names):
        sys.exit(f"{table}:1: {', '.join(wrong) or 'patient, input'}: expected the columns "
                 f"{', '.join(COLUMNS)}, each once; the first two at least")
    for line, cells in rows[1:]:
        row = dict.fromkeys(COLUMNS, "") | dict(zip(names, cells))
        yield line, row | {None: [cell for cell in cells[len(names):] if cell]}


def read_patients(table):
    """Patients by name, in the table's order; those of bad rows by `row_LINE` if need be."""
    read = []
    taken = set()
    for line, row in rows_of(table):
        name = row["patient"]
        try:
            if not re.fullmatch(r"[A-Za-z0-9_.-]+", name) or not name.strip("."):
                name = ""
                raise BadRow(f"patient '{row['patient']}': expected letters, digits, _ . -")
            if name in taken:
                name = ""
                raise BadRow(f"patient '{row['patient']}' is there already")
            patient = read_row(table, row)
        except BadRow as bad:
            patient = Patient(row["patient"],
                              refused=f"{pathlib.Path(table).name}:{line}: {bad}")
        taken.add(name)
        read.append((line, name, patient))
    patients = {}
    for line, name, patient in read:
        while not name or name in patients:
            name = f"row_{line}"
            if name in taken:
                line = f"{line}_"
                name = ""
        patients[name] = patient
    return patients


def build_command(tool, patient):
    """Without the output files, which build_one.py adds."""
    if patient.refused:
        return ["--refused", patient.shown, patient.refused]
    recipe = ["--recipe", patient.recipe] if patient.recipe else []
    return [tool, "build", *patient.inputs, *recipe, *patient.options]
