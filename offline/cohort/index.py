#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A page and a table of all patients of a cohort, from what build_one.py wrote.

usage: index.py OUT OUTCOME.json...
"""
import csv
import html
import json
import pathlib
import sys

STYLE = ("body{font:16px/1.5 sans-serif;max-width:1080px;margin:2em auto;padding:0 1em}"
         "table{border-collapse:collapse}td,th{padding:.3em .9em;text-align:right;"
         "border-bottom:1px solid #e4e4e4;vertical-align:top}"
         "td:first-child,th:first-child,td:last-child,th:last-child{text-align:left}"
         "td:last-child{overflow-wrap:anywhere}"
         ".refused{background:#fbe9e7}.note{background:#fff6dc}")
FIGURES = [("voxels", "voxels", "{}"), ("edge_mm", "edge, mm", "{:g}"),
           ("volume_ml", "volume, ml", "{:.1f}"), ("pieces", "pieces", "{}"),
           ("hausdorff_mm", "surface off by, mm", "{:.2f}"), ("hash", "hash", "{}")]


def shown(outcome, key, form):
    return form.format(outcome[key]) if outcome.get(key) is not None else ""


def row(outcome):
    name = html.escape(outcome["patient"])
    if "refused" in outcome:
        return (f"<tr class='refused'><td>{name}</td><td colspan='{len(FIGURES)}'></td>"
                f"<td>refused: {html.escape(outcome['refused'])}</td></tr>")
    cells = "".join(f"<td>{shown(outcome, key, form)}</td>" for key, _, form in FIGURES)
    notes = "<br>".join(html.escape(each) for each in outcome["findings"])
    return (f"<tr{' class=note' if notes else ''}><td><a href='report/{name}/report.html'>{name}"
            f"</a></td>{cells}<td>{notes}</td></tr>")


def write_whole(path, text):
    temporary = path.with_suffix(".part")
    temporary.write_text(text, encoding="utf-8")
    temporary.rename(path)


def page(outcomes):
    refused = sum("refused" in each for each in outcomes)
    noted = sum(bool(each.get("findings")) for each in outcomes)
    head = "".join(f"<th>{title}</th>" for _, title, _ in FIGURES)
    return ("<!doctype html><html lang='en'><head><meta charset='utf-8'><title>Cohort</title>"
            f"<style>{STYLE}</style></head><body><h1>Cohort</h1><p>{len(outcomes)} patients: "
            f"{len(outcomes) - refused} organs, {noted} of them with something to look at, "
            f"{refused} refused.</p><table><tr><th>patient</th>{head}<th>to look at</th></tr>" +
            "\n".join(map(row, outcomes)) + "</table></body></html>\n")


def write_table(path, outcomes):
    temporary = path.with_suffix(".part")
    with open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["patient", *(key for key, _, _ in FIGURES), "findings", "refused"])
        for each in outcomes:
            table.writerow([each["patient"], *(each.get(key, "") for key, _, _ in FIGURES),
                            len(each.get("findings", [])), each.get("refused", "")])
    temporary.rename(path)


def main():
    out = pathlib.Path(sys.argv[1])
    outcomes = [json.loads(pathlib.Path(name).read_text(encoding="utf-8"))
                for name in sys.argv[2:]]
    write_table(out / "index.csv", outcomes)
    write_whole(out / "index.html", page(outcomes))


if __name__ == "__main__":
    main()
