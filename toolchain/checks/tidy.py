#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests house style: the rules of CONTRIBUTING.md that a machine can check.

usage: tidy.py REPOSITORY
"""
import fnmatch
import pathlib
import re
import sys

FOLDERS = ["kernel", "hal", "offline", "tests", "toolchain", ".ci"]
SOURCE = {".h", ".cpp", ".c", ".cs", ".py", ".sh", ".cmake", ".ts", ".mjs", ".css", ".m", ".gd"}
NOT_WRITTEN_HERE = {"__pycache__", "node_modules", "generated", "dist"}
COLUMNS = 100
FUNCTION_LINES = 60
TEST_LINES = 70  # for a test's function, which may contain its table of cases
FILE_LINES = 500  # for what is built; tests may have long tables of cases
# Files that may be longer: the first for the reason above it; the others were longer when the check
# came to them, so they may have their lengths of then, and shrink.
LONG_FILES = {
    # The interface in C, which layout.py and programs read as one file: it grows by a field with
    # each parameter of a material (kernel/own_law.md), and has room for some.
    "hal/hosts/c/include/stylet/stylet.h": 540,
    "hal/console/page/src/app.css": 581,
    "hal/hosts/browser/package/index.mjs": 569,
    "toolchain/checks/self_test.py": 700,
}
PYTHON = "#!/usr/bin/python3"  # Debian's, whichever comes first in PATH
LEFT_OVER = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
MACHINE_PATH = re.compile(r"(^|[^A-Za-z0-9_.}])/(work|root|home|farm)/")

# The real-time path: the kernel, and the part of hal that runs between first and last tick.
REAL_TIME = ["kernel/src/*", "kernel/src/*/*", "hal/loop/loop.cpp", "hal/guard/*.cpp"]
BANNED = {
    r"\bnew\b(?!\s*\((?!std::nothrow))": "new (the caller owns all memory; placement is fine)",
    r"\b(malloc|calloc|realloc|free)\s*\(": "the heap (the caller owns all memory)",
    r"\bstd::(vector|string|map|unordered_map|deque|list|any)\b": "a container that allocates",
    r"\bstd::(shared_ptr|unique_ptr|make_\w+)\b": "an owning pointer (the caller owns all memory)",
    r"\bstd::function\b": "std::function (allocates; use a function pointer)",
    r"\b(throw|try|catch)\b": "exceptions (return a Status, or clamp, flag and count)",
    r"\b(dynamic_cast|typeid)\b": "run-time type information",
    r"\bvirtual\s+~": "a virtual destructor (it brings operator delete)",
    r"\bstd::(cout|cerr|ofstream|ifstream)\b|\bf?printf\s*\(": "output (use counters and events)",
    r"\bstd::(mutex|lock_guard|condition_variable)\b": "a lock",
}


def code_only(text):
    """The text with comments, literals and includes blanked out, as their words do not count."""
    token = re.compile(r'//[^\n]*|#include[^\n]*|/\*.*?\*/|'
                       r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
    return token.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def functions(code):
    """(first line, last line) of each function at namespace level, as clang-format formats it.

    A line with only the template's parameters is not counted.
    """
    start, body = None, False
    for number, line in enumerate(code.splitlines(), 1):
        if body:
            if line.startswith("}"):
                yield start, number
                start, body = None, False
            continue
        if start is None and re.match(r"(?!template\b)[A-Za-z_\[]", line):
            start, head = number, ""
        if start is not None:
            head += line.strip() + " "
            if line.rstrip().endswith("{"):
                body = "(" in head and not re.match(r"(namespace|extern|struct|class|enum)\b", head)
                start = start if body else None
            elif line.rstrip().endswith((";", "}", ":")) or not line.strip():
                start = None


def check_text(name, lines):
    for number, line in enumerate(lines, 1):
        if len(line) > COLUMNS:
            yield f"{name}:{number}: {len(line)} columns, allowed are {COLUMNS}"
        if LEFT_OVER.search(line):
            yield f"{name}:{number}: a left-over mark; finish it, or write an issue"
        if MACHINE_PATH.search(line):
            yield f"{name}:{number}: a path of one machine"
        if line != line.rstrip():
            yield f"{name}:{number}: blanks at the end of the line"


def check_length(name, lines):
    allowed = LONG_FILES.get(name, FILE_LINES)
    if len(lines) > allowed and not name.startswith("tests/"):
        yield (f"{name}: {len(lines)} lines, allowed are {allowed}: move one idea of it into a "
               "file of its own")


LINK = re.compile(r"\]\(([^)#:\s]+)(#[^)\s]*)?\)")


def check_links(path, name, text):
    """Faults of a page's links to other files of the repository."""
    for number, line in enumerate(text.splitlines(), 1):
        for link in LINK.finditer(line):
            if not (path.parent / link[1]).exists():
                yield f"{name}:{number}: no {link[1]} where the link goes"


CITED = re.compile(r"\bPHYSICS ((?:\d+(?:\.\d+)?(?:, | to | and )?)+)")


def check_cited(name, text, sections):
    """Faults: cited sections that kernel/PHYSICS.md does not have."""
    for number, line in enumerate(text.splitlines(), 1):
        for cited in CITED.finditer(line):
            for section in re.findall(r"\d+(?:\.\d+)?", cited[1]):
                if section not in sections:
                    yield f"{name}:{number}: PHYSICS has no section {section}"


RESULT = re.compile(r"\(([A-Z])\)(?= \|)")  # at the end of a cell: where a result is recorded
EXPLAINED = re.compile(r"\*\*([A-Z])\*\*")
REQUIREMENT = re.compile(r"\bGUARD(?:\.md)?, ([RS]\d+)\b")


def check_cited_letters(name, text, requirements):
    """Faults: a letter in a table that the page does not explain; a requirement that the guard
    does not have."""
    explained = set(EXPLAINED.findall(text))
    for number, line in enumerate(text.splitlines(), 1):
        for letter in set(RESULT.findall(line)) - explained if explained else ():
            yield f"{name}:{number}: the page does not explain the letter {letter}"
        for cited in REQUIREMENT.findall(line):
            if cited not in requirements:
                yield f"{name}:{number}: hal/guard/GUARD.md has no requirement {cited}"


TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P)\(\s*(\w+),\s*(\w+)", re.M)
CITED_TEST = re.compile(r"`[a-z]\w*_\w+\.([A-Z]\w*\.[\w*]+)`")  # `program.Suite.BeginningOfName`


def check_cited_tests(name, text, tests):
    """Faults: cited tests that no file below tests/ has."""
    for number, line in enumerate(text.splitlines(), 1):
        for cited in CITED_TEST.findall(line):
            if not fnmatch.filter(tests, cited + "*"):
                yield f"{name}:{number}: no test {cited}"


CITED_FILE = re.compile(r"`[^`]*?([\w./-]+\.(?:h|cpp|py|sh|fbs|inc|cmake|mjs))\b[^`]*`")
CITED_CONSTANT = re.compile(r"`(k[A-Z]\w+)`")
UNCHECKED = {"CHANGELOG.md"}  # it tells of what was
PLACEHOLDER = re.compile(r"NAME|X_|xyz|UpperCamel")


def check_cited_names(name, text, files, constants):
    """Faults: files and constants in code style that the repository does not have."""
    for number, line in enumerate(text.splitlines(), 1):
        for cited in CITED_FILE.findall(line):
            wanted = "/" + cited.lstrip("./")
            if not PLACEHOLDER.search(cited) and not any(path.endswith(wanted) for path in files):
                yield f"{name}:{number}: no file {cited}"
        for cited in CITED_CONSTANT.findall(line):
            if cited not in constants and not PLACEHOLDER.search(cited):
                yield f"{name}:{number}: no constant {cited}"


def check_licence(name, lines):
    wanted = "GPL-3.0-or-later" if name.startswith("offline/") else "Apache-2.0"
    if not any(f"SPDX-License-Identifier: {wanted}" in line for line in lines[:2]):
        yield f"{name}:1: expected the line SPDX-License-Identifier: {wanted}"


def check_interpreter(name, lines):
    if lines and lines[0].startswith("#!") and lines[0] != PYTHON:
        yield f"{name}:1: expected {PYTHON}: any other may lack the packages that setup.sh installs"


def check_code(name, text):
    code = code_only(text)
    allowed = TEST_LINES if name.startswith("tests/") else FUNCTION_LINES
    for first, last in functions(code):
        if last - first + 1 > allowed:
            yield f"{name}:{first}: a function of {last - first + 1} lines, allowed are {allowed}"
    if any(pathlib.PurePath(name).match(pattern) for pattern in REAL_TIME):
        for number, line in enumerate(code.splitlines(), 1):
            for pattern, reason in BANNED.items():
                if re.search(pattern, line):
                    yield f"{name}:{number}: on the real-time path: {reason}"


TYPE = re.compile(r"^(?:struct|class|enum class|union) (?:alignas\([^)]*\) )?(\w+)(?![\w:]*::)"
                  r"[^;{]*\{", re.M)
# Headers that one reader has open together, each list by itself.
TOGETHER = [["kernel/include", "kernel/src"], ["kernel/include", "hal"]]
APART = "hal/hosts/"  # each host names things as its language does


def check_type_names(top):
    """Faults: types of two headers with the same name, at namespace level."""
    for rooms in TOGETHER:
        first = {}
        for path in sorted(path for room in rooms for path in (top / room).rglob("*.h")):
            name = path.relative_to(top).as_posix()
            for kind in () if name.startswith(APART) else TYPE.findall(path.read_text()):
                if first.setdefault(kind, name) != name:
                    yield f"{name}: {kind} is a type of {first[kind]}, too; give it another name"


def is_source(path):
    return path.suffix in SOURCE or path.name == "CMakeLists.txt"


def faults(repository):
    top = pathlib.Path(repository)
    physics = top / "kernel/PHYSICS.md"
    sections = set(re.findall(r"^#+ (\d+(?:\.\d+)?)", physics.read_text(), re.M)
                   if physics.is_file() else ())
    guard = top / "hal/guard/GUARD.md"
    requirements = set(re.findall(r"^\| ([RS]\d+) \|", guard.read_text(), re.M)
                       if guard.is_file() else ())
    tests = [".".join(test) for path in (top / "tests").rglob("*.cpp")
             for test in TEST.findall(path.read_text())]
    yield from check_type_names(top)
    files = [path for folder in FOLDERS for path in sorted((top / folder).rglob("*"))]
    paths = ["/" + path.relative_to(top).as_posix() for path in files]
    constants = {found for path in files if path.suffix in {".h", ".cpp"}
                 for found in re.findall(r"\bk[A-Z]\w+", path.read_text())}
    for path in files + sorted(top.glob("*.md")) + [top / "CMakeLists.txt"]:
        name = path.relative_to(top)
        if not path.is_file() or NOT_WRITTEN_HERE & set(name.parts):
            continue
        name = name.as_posix()
        if is_source(path):
            text = path.read_text()
            yield from check_text(name, text.splitlines())
            yield from check_licence(name, text.splitlines())
            yield from check_cited(name, text, sections)
            yield from check_cited_letters(name, text, requirements)
            yield from check_length(name, text.splitlines())
            if path.suffix == ".py":
                yield from check_interpreter(name, text.splitlines())
            if path.suffix in {".h", ".cpp", ".c"}:
                yield from check_code(name, text)
        elif path.suffix in {".md", ".toml", ".fbs", ".txt", ""}:
            lines = path.read_text().splitlines()
            yield from (fault for fault in check_text(name, lines) if "columns" not in fault)
            if path.suffix == ".md":
                yield from check_links(path, name, "\n".join(lines))
                yield from check_cited(name, "\n".join(lines), sections)
                yield from check_cited_letters(name, "\n".join(lines), requirements)
                if name not in UNCHECKED:
                    yield from check_cited_names(name, "\n".join(lines), paths, constants)
                yield from check_cited_tests(name, "\n".join(lines), tests)


if __name__ == "__main__":
    found = list(faults(sys.argv[1]))
    print("\n".join(found))
    sys.exit(bool(found))
