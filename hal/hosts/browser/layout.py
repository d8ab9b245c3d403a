#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the header of the interface in C and writes its structs as JavaScript reads them.

layout.mjs       where each field lies in memory of WebAssembly; the enumerators and limits
structs.d.ts     the same as types of TypeScript, with the header's comments
layout_check.c   compiled with the library: it does not compile where a field lies elsewhere

usage: layout.py HEADER FOLDER
"""
import pathlib
import re
import sys

# Name in C -> (kind in layout.mjs, bytes and alignment on wasm32, type in TypeScript).
SCALARS = {
    "float": ("f32", 4, "number"), "double": ("f64", 8, "number"), "uint8_t": ("u8", 1, "number"),
    "uint16_t": ("u16", 2, "number"), "stylet_status": ("u16", 2, "number"),
    "uint32_t": ("u32", 4, "number"), "uint64_t": ("u64", 8, "number"),
    "size_t": ("u32", 4, "number"), "const char*": ("text", 4, "string"),
}
# The caller never sees these: index.mjs sets the size, and reserved is zero.
HIDDEN = ("struct_bytes", "reserved")
PACKED = {"stylet_vec3": "Vec3", "stylet_quat": "Quat"}

STRUCT = re.compile(r"typedef struct \{\n(.*?)\n\} (\w+);", re.S)
FIELD = re.compile(r"^((?:const )?\w+\*?)\s+([^;]+);\s*(?:/\*\s*(.*?)\s*\*/)?$", re.S)
ENUM = re.compile(r"^enum \{(.*?)\};", re.S | re.M)
COMMENT = re.compile(r"/\*.*?\*/", re.S)


def constants_of(header):
    """{name without STYLET_: number} of #defines and enumerators."""
    found = dict(re.findall(r"^#define STYLET_(\w+) (0x[0-9A-F]+|\d+)", header, re.M))
    for body in ENUM.findall(header):
        for item in COMMENT.sub("", body).split(","):
            if item.strip():
                name, _, value = item.partition("=")
                found[name.strip().removeprefix("STYLET_")] = value.strip()
    numbers = {}
    for name, text in found.items():
        number = re.fullmatch(r"(0x[0-9A-F]+|\d+)(U?)(?: << (\d+))?", text.strip())
        if not number:
            sys.exit(f"layout.py: {name} = {text}: expected a number")
        numbers[name] = int(number[1], 0) << int(number[3] or 0)
    return numbers


def statements(body):
    """[(line, before)] of the fields: the line with what stands behind the field in it, and the
    comment on the lines before, or "" if there is none."""
    lines, before = [], ""
    for line in re.findall(r"^ *(/\*.*?\*/$|[^;]*;[^\n]*(?:\n +\*[^\n]*)*)", body, re.S | re.M):
        if line.startswith("/*"):
            before = line.strip("/* \n")
            continue
        lines.append((line.strip(), before))
        before = ""
    return lines


def plain(comment):
    return re.sub(r"\s*\n\s*\*\s*", " ", comment or "").strip()


def kind_of(name, of, known):
    """(kind in layout.mjs, bytes, alignment) of the type `of` of a field of the struct `name`."""
    if of in SCALARS:
        kind, size, _ = SCALARS[of]
        return kind, size, size
    if of in known:
        _, size, align = known[of]
        return of, size, align
    if of == "char":
        return "char", 1, 1
    sys.exit(f"layout.py: {name}: type {of}")


def fields_of(name, body, constants, known):
    """[(field, type, kind, offset, count, doc)], bytes, alignment."""
    fields, at, widest = [], 0, 1
    for line, before in statements(body):
        parts = FIELD.match(line)
        if not parts:
            sys.exit(f"layout.py: {name}: {line!r}: expected a field")
        of, names, behind = parts.groups()
        kind, size, align = kind_of(name, of, known)
        for each in names.split(","):
            field, _, count = each.strip().partition("[")
            count = count.rstrip("]")
            number = int(count) if count.isdigit() else constants.get(
                count.removeprefix("STYLET_"), 0 if count else 1)
            at = -(-at // align) * align
            fields.append((field, of, kind, at, number, bool(count), plain(behind or before)))
            at += size * number
        widest = max(widest, align)
    return fields, -(-at // widest) * widest, widest


def script(structs, constants):
    rows = []
    for name, (fields, size, _) in structs.items():
        table = ", ".join(f'["{f}", "{kind}", {at}, {count if array else 0}]'
                          for f, _, kind, at, count, array, _ in fields)
        rows.append(f"  {name}: {{ bytes: {size}, fields: [{table}] }},\n")
    names = "".join(f"  {name}: {value},\n" for name, value in constants.items())
    return ("// Made by layout.py of stylet.h. A field: name, kind, offset, count (0: no array).\n"
            f"export const structs = {{\n{''.join(rows)}}};\n"
            f"export const constants = Object.freeze({{\n{names}}});\n")


def type_of(of, name, array):
    if of == "char":
        return "string"
    one = ("string" if name == "hash" else SCALARS[of][2]) if of in SCALARS \
        else PACKED.get(of, title(of))
    return f"{one}[]" if array else one


def title(name):
    return "".join(word.capitalize() for word in name.removeprefix("stylet_").split("_"))


def types(structs, constants):
    out = ["// Made by layout.py of stylet.h. Numbers are SI; places are in the organ's frame.\n",
           "export type Vec3 = [x: number, y: number, z: number];\n",
           "export interface Quat {\n  w: number;\n  x: number;\n  y: number;\n  z: number;\n}\n"]
    for name, (fields, _, _) in structs.items():
        if name in PACKED:
            continue
        out.append(f"export interface {title(name)} {{\n")
        for field, of, _, _, _, array, doc in fields:
            if field in HIDDEN:
                continue
            out.append(f"  /** {doc} */\n" if doc else "")
            out.append(f"  {field}: {type_of(of, field, array)};\n")
        out.append("}\n")
    out.append("export declare const constants: {\n")
    out += [f"  readonly {name}: {value};\n" for name, value in constants.items()]
    out.append("};\n")
    return "".join(out)


def check(structs):
    lines = ["/* Made by layout.py. */\n#include <stylet/stylet.h>\n"]
    for name, (fields, size, _) in structs.items():
        lines.append(f'_Static_assert(sizeof({name}) == {size}, "{name}");\n')
        lines += [f'_Static_assert(offsetof({name}, {f}) == {at}, "{name}.{f}");\n'
                  for f, _, _, at, _, _, _ in fields]
    return "".join(lines)


def main(header, folder):
    text = pathlib.Path(header).read_text()
    constants, structs = constants_of(text), {}
    for body, name in STRUCT.findall(text):
        structs[name] = fields_of(name, body, constants, structs)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "layout.mjs").write_text(script(structs, constants))
    (folder / "structs.d.ts").write_text(types(structs, constants))
    (folder / "layout_check.c").write_text(check(structs))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
