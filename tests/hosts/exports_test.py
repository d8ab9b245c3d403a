#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""libstylet.so exports the functions of its header and nothing else, needs only what every Debian
has, and runs the programs of earlier versions; its headers compile as C89, C++98 and every later
standard.

usage: exports_test.py LIBRARY SOURCE ORGAN
"""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import output

LIBRARY, SOURCE, ORGAN = (pathlib.Path(word) for word in sys.argv[1:4])
INCLUDE = SOURCE / "hal/hosts/c/include"
ABI = SOURCE / "tests/hosts/abi"
# libccd finds where convex bodies touch, libmd computes checksums of files.
NEEDED = {"libc", "libm", "ld-linux-x86-64", "ld-linux-aarch64", "libccd", "libmd"}


def listed(name="symbols.txt"):
    lines = (SOURCE / "hal/hosts/c" / name).read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def declared(header):
    text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
    return set(re.findall(r"STYLET_API\s[^;(]*?\b(stylet_\w+)\s*\(", text))


def layout(include):
    """What a compiler makes of the headers in a folder: names of numbers with their values, fields
    with their places and sizes."""
    text = "".join(re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
                   for header in sorted((include / "stylet").glob("*.h")))
    numbers = re.findall(r"\b(STYLET_[A-Z0-9_]+) =", text)
    numbers += re.findall(r"#define (STYLET_(?:MAX|NO|FLAG)_\w+)", text)
    fields = [(name, re.sub(r"\[.*", "", field).split()[-1])
              for body, name in re.findall(r"typedef struct \{([^}]*)\} (\w+);", text)
              for declaration in body.split(";") if declaration.strip() and "(" not in declaration
              for field in declaration.replace("*", "").split(",")]
    lines = [f'printf("{name} %llu\\n", (unsigned long long){name});' for name in numbers]
    lines += [f'printf("{kind}.{field} %zu %zu\\n", offsetof({kind}, {field}), '
              f"sizeof((({kind}*)0)->{field}));" for kind, field in fields]
    with tempfile.TemporaryDirectory() as top:
        source = pathlib.Path(top) / "layout.c"
        source.write_text("#include <stdio.h>\n#include <stylet/stylet_loop.h>\nint main(void) {\n"
                          + "\n".join(lines) + "\nreturn 0;\n}\n")
        output("cc", "-std=c99", source, f"-I{include}", "-o", source.with_suffix(""))
        said = output(source.with_suffix(""))
    return dict(line.split(" ", 1) for line in said.splitlines())


class Exports(unittest.TestCase):
    def test_are_those_of_the_list(self):
        """By version node, so that an old function that moves into another node is noticed."""
        rows = output("nm", "-D", "--defined-only", LIBRARY).splitlines()
        symbols = [row.split()[2] for row in rows]
        versions = [name for name in symbols if re.fullmatch(r"STYLET_[\d.]+", name)]
        functions = sorted(name.replace("@@", " ") for name in symbols if name not in versions)
        self.assertEqual(functions, listed())
        self.assertTrue({row.split()[1] for row in rows} <= {"T", "A"}, rows)  # no data

    def test_are_those_of_the_header(self):
        names = {line.split()[0] for line in listed()}
        headers = sorted((INCLUDE / "stylet").glob("*.h"))
        self.assertEqual(set().union(*map(declared, headers)), names)

    def test_needs_what_every_system_has(self):
        needed = re.findall(r"\(NEEDED\).*\[(\S+?)\.so", output("readelf", "-d", LIBRARY))
        self.assertIn("libc", needed)
        self.assertLessEqual(set(needed), NEEDED)

    def test_has_the_version_of_its_header(self):
        header = (INCLUDE / "stylet/stylet.h").read_text()
        numbers = re.findall(r"#define STYLET_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header)
        self.assertEqual(".".join(numbers), LIBRARY.resolve().name.removeprefix("libstylet.so."))

    def test_is_found_by_its_soname(self):
        self.assertRegex(output("readelf", "-d", LIBRARY), r"\(SONAME\).*\[libstylet\.so\.0\]")


class Headers(unittest.TestCase):
    STRICT = ["-pedantic-errors", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Wundef",
              "-Werror", "-fsyntax-only", f"-I{INCLUDE}"]
    LANGUAGES = {"c": (["c89", "c99", "c11", "c17"], ["-Wstrict-prototypes", "-Wc++-compat"]),
                 "c++": (["c++98", "c++11", "c++17", "c++20"],
                         ["-Wold-style-cast", "-fno-exceptions", "-fno-rtti"])}

    def test_each_alone_in_each_standard(self):
        compilers = [name for name in ("gcc", "clang") if shutil.which(name)]
        self.assertTrue(compilers)
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "alone"
            for header in sorted((INCLUDE / "stylet").glob("*.h")):
                source.write_text(f"#include <stylet/{header.name}>\n")
                for language, (standards, more) in self.LANGUAGES.items():
                    for compiler in compilers:
                        for standard in standards:
                            output(compiler, "-x", language, f"-std={standard}", *self.STRICT,
                                   *more, source)


class Programs(unittest.TestCase):
    def test_of_earlier_versions_run(self):
        programs = sorted(ABI.glob("*/*.c"))
        self.assertTrue(programs)
        for source in programs:
            with self.subTest(source.parent.name), tempfile.TemporaryDirectory() as top:
                program = f"{top}/program"
                folder = LIBRARY.parent
                output("cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source,
                       f"-I{source.parent}", f"-L{folder}", "-lstylet", f"-Wl,-rpath,{folder}",
                       "-o", program)
                self.assertEqual(output(program, ORGAN), "needle.length_m\nok\n")

    def test_of_earlier_versions_mean_what_they_meant(self):
        """Numbers keep their values, and fields their places and sizes: structs grow at their end,
        or where they had room."""
        now = layout(INCLUDE)
        self.assertGreater(len(now), 250)
        self.assertEqual(now["STYLET_FILE_UNREADABLE"], "403")
        self.assertEqual(now["stylet_needle.outer_radius_m"], "8 4")
        for version in sorted(path.parent for path in ABI.glob("*/stylet")):
            then = {name: where for name, where in layout(version).items()
                    if not name.endswith(".reserved")}
            self.assertGreater(len(then), 200)
            self.assertEqual({name: now.get(name) for name in then}, then, version.name)

    def test_earlier_programs_find_what_their_header_declared(self):
        names = {line.split()[0] for line in listed()}
        headers = sorted(ABI.glob("*/stylet/*.h"))
        self.assertTrue(headers)
        for header in headers:
            self.assertLessEqual(declared(header), names, header)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
