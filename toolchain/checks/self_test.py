#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the checks: each refuses bad samples and names the right place, and accepts good ones."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import built  # noqa: E402
import compile_times  # noqa: E402
import coverage  # noqa: E402
import drivers  # noqa: E402
import fields  # noqa: E402
import headers  # noqa: E402
import links  # noqa: E402
import loops  # noqa: E402
import mutation  # noqa: E402
import promises  # noqa: E402
import repeated  # noqa: E402
import rooms  # noqa: E402
import sensitivity  # noqa: E402
import stack  # noqa: E402
import symbols  # noqa: E402
import test_names  # noqa: E402
import tidy  # noqa: E402

APACHE = "// SPDX-License-Identifier: Apache-2.0\n"
GPL = "// SPDX-License-Identifier: GPL-3.0-or-later\n"


class Sample(unittest.TestCase):
    """Gives each test case its own folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def expect_one(self, faults, *parts):
        found = list(faults)
        self.assertEqual(len(found), 1, found)
        for part in parts:
            self.assertIn(part, found[0])


class CompileTimes(Sample):
    def log(self, *rows, launcher=""):
        self.write("slow.py", "import time\nwhile time.process_time() < 0.5: pass\n")
        self.write("build.ninja", f"rule run\n  command = {launcher}python3 slow.py -o $out\n"
                                  "build a.cpp.o: run\n")
        self.write(".ninja_log", "# ninja log v5\n" + "".join(
            f"0\t{ms}\t0\t{output}\t0\n" for output, ms in rows))

    def test_refuses_what_takes_long_once_more(self):
        self.log(("a.cpp.o", 1000))
        self.expect_one(compile_times.faults(self.top, 0.3), "a.cpp.o", "allowed are 0.3")

    def test_accepts_what_took_long_only_in_the_log(self):
        self.log(("a.cpp.o", 9000))
        self.assertEqual(list(compile_times.faults(self.top, 8)), [])

    def test_compiles_large_objects_that_came_out_of_the_cache(self):
        self.log(("a.cpp.o", 20), launcher="ccache ")
        self.write("a.cpp.o", "a" * 100)
        self.assertEqual(list(compile_times.faults(self.top, 0.3)), [])
        self.write("a.cpp.o", "a" * (compile_times.LARGE_BYTES + 1))
        self.expect_one(compile_times.faults(self.top, 0.3), "a.cpp.o", "allowed are 0.3")

    def test_looks_only_at_what_the_log_says_and_the_build_has(self):
        self.log(("a.cpp.o", 1000), ("a.cpp.o", 200), ("gone.cpp.o", 1000))
        self.assertEqual(list(compile_times.faults(self.top, 0.3)), [])


class Coverage(Sample):
    def test_names_exceptions_of_lines_that_are_gone(self):
        self.write("a.cpp", "  if (a) b();\n")
        rows = {("a.cpp", "if (a) b();"): "by chance", ("a.cpp", "NO CODE"): "only includes",
                ("a.cpp", "if (a) c();"): "by chance", ("gone.cpp", "b();"): "why not"}
        self.assertEqual(list(coverage.stale(self.top, rows)),
                         [("a.cpp", "if (a) c();"), ("gone.cpp", "b();")])

    def test_lists_of_exceptions_name_lines_as_they_read_now(self):
        for room, suffix in (("kernel", ""), ("offline", "_offline")):
            rows = coverage.read_exceptions(
                mutation.SOURCE / f"toolchain/coverage_exceptions{suffix}.txt")
            self.assertEqual(list(coverage.stale(mutation.SOURCE / room / "src", rows)), [])


class Mutation(unittest.TestCase):
    def test_knows_every_file_of_offline(self):
        self.assertEqual(mutation.forgotten(), [], "expected in OFFLINE or REPORTS of mutation.py")

    def test_knows_the_lines_of_the_survivors(self):
        known = mutation.known_survivors()
        self.assertEqual(mutation.stale(known), [])
        row = "hal/guard/guard.cpp", "a line that is gone;", "another line;"
        self.assertEqual(mutation.stale(known | {row: "why not"}), [f"{row[0]}: {row[1]}"])

    def test_finds_mistakes_and_leaves_words_alone(self):
        code = "  if (a < b) c += 2;  // 3 < 4\n"
        lines = [mutation.Mutant(code, change).after for change in mutation.mutations(code)]
        self.assertIn("if (a >= b) c += 2; // 3 < 4", lines)
        self.assertIn("if (a < b) c -= 2; // 3 < 4", lines)
        self.assertFalse([line for line in lines if not line.endswith("3 < 4")], lines)


class Fields(Sample):
    def test_accepts_comments_behind_and_above(self):
        self.write("a.h", "struct A {\n  int a;  // of one\n  // Of two.\n  int b, c;\n"
                          "  float d[2];\n  struct B {\n    int e;  // of three\n  };\n"
                          "  int f(int g) const { return g; }\n};\nint g;\n")
        self.assertEqual(list(fields.faults([self.top])), [])

    def test_refuses_a_field_without_any(self):
        for above in ("", "  int a;  // of one\n", "  // Of one.\n  int a;\n\n"):
            for field in ("std::uint32_t b, c;", "Vec3 b;", "const Side b[2];",
                          "Field<int> b = {};"):
                header = self.write("a.h", f"struct A {{\n{above}  {field}\n}};\n")
                self.expect_one(fields.faults([header]), f"a.h:{2 + above.count(chr(10))}", field)

    def test_refuses_nothing_found(self):
        self.expect_one(fields.faults([self.top]), "no header")


class Headers(Sample):
    def test_accepts_allowed(self):
        self.write("a.h", '#include <cstdint>\n#include "stylet/b.h"\n')
        self.assertEqual(list(headers.faults(self.top)), [])

    def test_refuses_others(self):
        self.write("a.h", "#include <cstdint>\n#  include <vector>\n")
        self.expect_one(headers.faults(self.top), "a.h:2", "<vector>")

    def test_refuses_nothing_found(self):
        self.expect_one(headers.faults(self.top), "no header")


class Built(Sample):
    def test_says_what_to_build_first(self):
        here = self.write("stylet", "")
        built.require(here)
        for missing, said in ((["bin/stylet_texts"], "--target stylet_texts first"),
                              (["lib/liba.a", "bin/b"], "--target a b first"),
                              (["1", "2", "3", "4"], "4 programs are not built yet")):
            with self.assertRaises(SystemExit) as ended:
                built.require(here, *[self.top / each for each in missing])
            self.assertIn(said, ended.exception.code)
            self.assertNotIn("\n", ended.exception.code)

    def test_checks_of_programs_say_it(self):
        folder = pathlib.Path(built.__file__).parent
        none = self.top / "stylet_nothing"
        for words in (["test_names.py", none], ["drivers.py", none, self.top],
                      ["symbols.py", self.write("list.txt", ""), none]):
            done = subprocess.run([sys.executable, folder / words[0], *words[1:]],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn("stylet_nothing: not built yet", done.stderr)


class TestNames(Sample):
    """With stand-ins for programs of googletest."""

    def faults(self, says):
        program = self.write("program", "#!/bin/sh\n" + says)
        program.chmod(0o755)
        return test_names.faults(program)

    def test_accepts_names(self):
        self.assertEqual(list(self.faults("printf 'Suite.\\n  Case/0  # GetParam() = liver\\n'")),
                         [])

    def test_refuses_bytes(self):
        self.expect_one(self.faults("echo '  Case/0  # GetParam() = 4-byte object <01-00>'"),
                        "program: Case/0", "PrintTo")

    def test_refuses_names_that_change_and_none(self):
        self.expect_one(self.faults("echo Suite.$$"), "asked again")
        self.expect_one(self.faults(""), "no test")


class Symbols(Sample):
    def library(self, code):
        source = self.write("a.cpp", code)
        subprocess.run(["c++", "-O1", "-c", source, "-o", self.top / "a.o"], check=True)
        subprocess.run(["ar", "rc", self.top / "a.a", self.top / "a.o"], check=True)
        return [self.top / "a.a"]

    def test_accepts_listed_and_own(self):
        code = 'extern "C" int given(); int own() { return 1; } int f() { return given() + own(); }'
        allowed = self.write("list.txt", "# why\ngiven  # here\n")
        self.assertEqual(list(symbols.faults(allowed, self.library(code))), [])

    def test_refuses_heap(self):
        allowed = self.write("list.txt", "given\n")
        self.expect_one(symbols.faults(allowed, self.library("int* f() { return new int; }")),
                        "a.o", "operator new(unsigned long)")


class Loops(Sample):
    def faults(self, code, allowed=""):
        self.write("include/stylet/limits.h", "constexpr int kMaxTurns = 3;\n")
        self.write("src/a.cpp", code)
        return loops.faults(self.top, self.write("list.txt", allowed))

    def test_accepts_ranges_and_counting(self):
        code = ("for (int i = 0; i < n; ++i) {}\nfor (const int& x : list) {}\n"
                "for (std::uint32_t j = n; j-- > 0;) {}\nfor (; p != end; p += 4) {}\n"
                "for (; p + 8 <= end; p += 8) {}\nfor (i = 0; n > i; i++) { own.i = 0; }\n"
                "// while (true) in words\n")
        self.assertEqual(list(self.faults(code)), [])

    def test_refuses_others(self):
        for code in ("while (true) {}", "for (;;) {}", "do { } while (f());", "goto again;",
                     "for (int i = 0; more(i); ++i) {}", "for (int i = 0; i < 3;) {}",
                     "for (int i = 0; i < 3; --i) {}", "for (int i = 0; i > -3; ++i) {}",
                     "for (int i = 0; i < 3; ++j) {}", "for (int i = 0; left < 3; ++i) {}",
                     "for (int i = 0; i < 3; ++i) { i = f(i); }", "for (; i < 3; ++i) --i;",
                     "for (int i = 0; i < 3; ++i) f(&i);"):
            with self.subTest(code):
                self.assertTrue(list(self.faults(f"int a;\n{code}\n"))[0].startswith("a.cpp:2"))

    def test_accepts_listed_with_a_limit_that_is_there(self):
        self.assertEqual(list(self.faults("while (f(1)) {}", "a.cpp | while (f(1)) | kMaxTurns\n")),
                         [])
        self.expect_one(self.faults("while (f(1)) {}", "a.cpp | while (f(1)) | kMaxElse\n"),
                        "kMaxElse")

    def test_refuses_rows_without_a_loop(self):
        self.expect_one(self.faults("", "a.cpp | while (f(1)) | kMaxTurns\n"), "not in the code")


class Rooms(Sample):
    """With two folders and a file beside them: cellar, hall above it, roof.cpp on top."""
    LIST = "house by/\n  cellar:\n  hall: cellar\n  roof: hall\n"

    def setUp(self):
        super().setUp()
        self.write("house/cellar/wine.h", "")
        self.write("house/hall/table.h", '#include "by/cellar/wine.h"\n')
        self.write("house/roof.cpp", '#include "by/hall/table.h"\n#include <cstdint>\n')

    def faults(self, rows=LIST):
        return rooms.faults(self.top, self.write("rooms.txt", rows))

    def test_accepts_arrows_that_run_down(self):
        self.write("house/hall/chair.h", '#include "by/hall/table.h"\n#include "elsewhere.h"\n')
        self.assertEqual(list(self.faults()), [])

    def test_refuses_arrows_up_and_past_a_room(self):
        self.write("house/cellar/coal.h", '// why\n#include "by/hall/table.h"\n')
        self.expect_one(self.faults(), "house/cellar/coal.h:2", "cellar does not use hall")
        self.write("house/cellar/coal.h", "")
        self.write("house/roof.cpp", '#include "by/hall/table.h"\n#  include "by/cellar/wine.h"\n')
        self.expect_one(self.faults(), "house/roof.cpp:2", "roof does not use cellar")

    def test_a_file_that_stands_alone_is_its_header_and_its_source(self):
        self.write("house/roof.h", "")
        self.write("house/roof.cpp", '#include "by/roof.h"\n#include "by/hall/table.h"\n')
        self.assertEqual(list(self.faults()), [])
        self.write("house/roof.inc.h", "")
        self.expect_one(self.faults(), "house/roof.inc.h: its room is not listed")

    def test_does_not_judge_what_is_in_brackets(self):
        self.assertEqual(list(self.faults(self.LIST.replace("cellar:", "cellar: (hall)"))), [])
        self.write("house/cellar/coal.h", '#include "by/hall/table.h"\n')
        self.expect_one(self.faults(self.LIST.replace("cellar:", "cellar: (hall)")),
                        "cellar does not use hall")

    def test_refuses_names_without_a_room(self):
        self.write("house/hall/chair.h", '#include "table.h"\n')
        self.expect_one(self.faults(), "chair.h:1", "by/hall")

    def test_refuses_rooms_that_are_not_listed(self):
        self.write("house/shed/saw.h", "")
        self.expect_one(self.faults(), "house/shed/saw.h")

    def test_refuses_a_list_that_runs_up_or_says_too_much(self):
        self.write("house/cellar/coal.h", '#include "by/hall/table.h"\n')
        self.expect_one(self.faults(self.LIST.replace("cellar:", "cellar: hall", 1)),
                        "cellar is to use hall")
        self.write("house/cellar/coal.h", "")
        self.write("house/roof.cpp", "")
        self.expect_one(self.faults(), "roof is listed to use hall")


class Links(Sample):
    """With a house that is built as CMake does: cellar, hall above it, roof.cpp on top."""
    LIST = "house\n  cellar:\n  hall: cellar\n  roof: hall\n"

    def build(self, **sources):
        """Each of `sources`: its code, by name with _ for a slash."""
        for name, code in sources.items():
            source = self.write(f"house/{name.replace('_', '/')}.cpp", code)
            made = self.write("build/house/CMakeFiles/a.dir/" +
                              source.relative_to(self.top / "house").as_posix() + ".o", "")
            subprocess.run(["c++", "-O0", "-c", source, "-o", made], check=True)

    def faults(self, rows=LIST):
        return links.faults(self.top, self.write("rooms.txt", rows), self.top / "build")

    def test_accepts_calls_that_run_down_and_inline_functions(self):
        self.build(cellar_wine="int wine() { return 1; } inline int own() { return 2; }\n"
                               "int old() { return own(); }",
                   hall_table="int wine(); inline int own() { return 2; }\n"
                              "int table() { return wine() + own(); }",
                   roof="int table(); int roof() { return table(); }")
        self.assertEqual(list(self.faults()), [])

    def test_refuses_what_the_own_header_declares_and_a_room_above_defines(self):
        self.build(cellar_wine="int fetch(int n); int wine() { return fetch(1); }",
                   hall_table="int fetch(int n) { return n; }")
        self.expect_one(self.faults(), "house: cellar does not use hall", "fetch(int)")

    def test_refuses_a_call_past_a_room_and_of_data(self):
        self.build(cellar_wine="int bottles = 3;", roof="extern int bottles; int a = bottles;")
        self.expect_one(self.faults(), "roof does not use cellar", "bottles")

    def test_brackets_allow_a_call_and_must_be_needed(self):
        rows = self.LIST.replace("cellar:", "cellar: (hall)")
        self.build(cellar_wine="int fetch(int n); int wine() { return fetch(1); }",
                   hall_table="int fetch(int n) { return n; }")
        self.assertEqual(list(self.faults(rows)), [])
        self.build(cellar_wine="int wine() { return 1; }")
        self.expect_one(self.faults(rows), "cellar is listed to call hall")

    def test_reads_no_object_whose_source_is_gone(self):
        self.build(cellar_wine="int wine() { return 1; }",
                   cellar_coal="int fetch(int n); int coal() { return fetch(1); }",
                   hall_table="int fetch(int n) { return n; }")
        (self.top / "house/cellar/coal.cpp").unlink()
        self.assertEqual(list(self.faults()), [])

    def test_refuses_a_house_that_is_not_built(self):
        self.build()
        self.expect_one(self.faults(), "house", "build it first")


class Drivers(Sample):
    README = f"before\n{drivers.BEGIN}| a |\n{drivers.END}behind\n"

    BY_NAME = "".join(f"before\n{drivers.BEGIN}| {each} |\n{drivers.END}"
                      for each in ("needles", "materials", "tips", "devices")) + "behind\n"

    def faults(self, readme=README, by_name=BY_NAME, **other):
        """With the tables of a program that says what the files say, except for `other`."""
        says = {"udev": "rules\n", "table": "| a |\n", "windows": "| a |\n", **other}
        self.write(drivers.RULES, "rules\n")
        self.write(drivers.README, readme)
        self.write(drivers.WINDOWS, self.README)
        self.write(drivers.BY_NAME, by_name)
        return drivers.faults(self.top, lambda word: says.get(word, f"| {word} |\n"))

    def test_accepts_what_the_drivers_say(self):
        self.assertEqual(list(self.faults()), [])

    def test_refuses_other_rules_and_another_table(self):
        self.expect_one(self.faults(udev="rules of another device\n"), drivers.RULES)
        self.expect_one(self.faults(table="| a |\n| b |\n"), drivers.README)
        self.expect_one(self.faults(readme=self.README.replace("| a |", "| by hand |")),
                        drivers.README)
        self.expect_one(self.faults(windows="| b |\n"), drivers.WINDOWS)

    def test_refuses_a_name_that_the_page_lacks_and_another_number(self):
        for table in "needles", "materials", "tips", "devices":
            self.expect_one(self.faults(**{table: f"| {table} |\n| one more |\n"}), drivers.BY_NAME)
            self.expect_one(self.faults(by_name=self.BY_NAME.replace(f"| {table} |", "| 8 |")),
                            drivers.BY_NAME)

    def test_refuses_a_page_without_the_table(self):
        with self.assertRaises(ValueError):
            list(self.faults(readme="| a |\n"))
        with self.assertRaises(ValueError):
            list(self.faults(by_name=self.BY_NAME + self.README))


class Repeated(Sample):
    DEARER = (r"dearest (\d+), bound ([\d.]+) G", [1204, 1.5449])

    def faults(self, text):
        self.write("a.md", text)
        return repeated.compared(self.top, "a.md", *self.DEARER)

    def test_reads_tables_whose_rows_begin_with_a_name(self):
        path = self.write("costs.txt", "# scene worst\nfig-02 1204 -3\nworst 7 8\n")
        self.assertEqual(repeated.table(path), {"fig-02": [1204, -3], "worst": [7, 8]})

    def test_reads_columns_of_a_documents_table(self):
        path = self.write("b.md", "# b\n\n| other |\n| --- |\n| 9 |\n\n| scene | n | change |\n"
                          "| --- | --- | --- |\n| fig-02 | 1.5 | +0.7 % |\n| fig-04 | | -2 % |\n\n"
                          "| scene |\n| 8 |\n")
        self.assertEqual(repeated.columns(path, "scene", (1, 2)), [[1.5], [0.7, -2]])

    def test_names_line_text_and_number_of_what_is_stale_and_mends_it(self):
        text, faults = self.faults("a\nb: dearest 1191, bound 1.40 G.\n")
        self.assertEqual(text, "a\nb: dearest 1204, bound 1.54 G.\n")
        self.assertEqual(len(faults), 2, faults)
        self.assertIn("a.md:2: says 1.40, measured is 1.54", faults[0])
        self.assertIn("a.md:2: says 1191, measured is 1204", faults[1])

    def test_accepts_a_percent_and_the_last_digit_and_leaves_them(self):
        near = "dearest 1193, bound 1.5 G"
        self.assertEqual(self.faults(near), (near, []))

    def test_refuses_a_document_that_says_no_more_such_thing(self):
        self.expect_one(self.faults("dearest of all")[1], "a.md", "says no more")


class Promises(Sample):
    EMPTY = f"before\n{promises.BEGIN}\n\n{promises.HEADER}\n\n{promises.END}\nbehind\n"
    TESTS = ["rt.stack", "rt.rtsan.tick", "rt.rtsan.other", "check.loops", "check.symbols"]
    STACK = ("5448 bytes at most; of a painted stack:\nphysical, avx2: 4616 bytes\n"
             "physical, avx512: 4608 bytes\ndeepest: 4616 bytes\n")

    def results(self, day, **tests):
        """Writes results as ctest does; `tests`: {name with _ for each dot: (status, output)}."""
        cases = "".join(f'<testcase name="{name.replace("_", ".")}" status="{status}">'
                        f"<system-out>{output}</system-out></testcase>"
                        for name, (status, output) in tests.items())
        self.write(f"results/{day}.xml",
                   f'<testsuite timestamp="{day}T10:00:00">{cases}</testsuite>')

    def table(self, readme=EMPTY):
        results = promises.read_results(self.top / "results")
        return promises.updated(readme, results, self.TESTS)

    def test_writes_what_was_run_and_keeps_the_rest(self):
        self.results("2026-01-02", rt_stack=("run", self.STACK), rt_rtsan_tick=("run", ""),
                     check_loops=("fail", ""), check_symbols=("notrun", "no nm here"))
        once = self.table()
        self.assertIn("| `rt.stack` | 2026-01-02: 5448 bytes at most, 4616 used |", once)
        self.assertIn("| `rt.rtsan.*` | 2026-01-02: 1 passed, 1 not run |", once)
        self.assertIn("| `check.loops` | 2026-01-02: check.loops failed |", once)
        self.assertIn(f"| `check.symbols` | {promises.NEVER} |", once)
        self.assertEqual(promises.updated(once, {}, self.TESTS), once)
        self.assertTrue(once.startswith("before\n") and once.endswith("behind\n"))

    def test_adds_up_runs_and_takes_the_last_of_each_test(self):
        self.results("2026-01-02", rt_rtsan_tick=("run", ""), check_loops=("fail", ""))
        self.results("2026-01-03", rt_rtsan_other=("run", ""), check_loops=("run", ""))
        made = self.table()
        self.assertIn("| `rt.rtsan.*` | 2026-01-02: 2 passed |", made)
        self.assertIn("| `check.loops` | 2026-01-03: 1 passed |", made)
        self.results("2026-01-04", rt_rtsan_other=("notrun", "skipped"))
        self.assertIn("| `rt.rtsan.*` | 2026-01-02: 1 passed, 1 not run |", self.table())

    def test_a_part_replaces_more_only_of_another_day(self):
        self.results("2026-01-03", rt_rtsan_tick=("run", ""))
        for had, kept in (("2026-01-03: 2 passed", True), ("2026-01-03: 5 and 6", True),
                          ("2026-01-02: 2 passed", False), ("2026-01-03: x failed", False)):
            with self.subTest(had):
                before = self.EMPTY.replace("| --- | --- | --- |", "| --- | --- | --- |\n| no call "
                                            f"that may block | `rt.rtsan.*` | {had} |")
                row = had if kept else "2026-01-03: 1 passed, 1 not run"
                self.assertIn(f"| `rt.rtsan.*` | {row} |", self.table(before))

    def test_refuses_another_table_and_rows_without_a_test(self):
        made = promises.updated(self.EMPTY, {}, [])
        tests = [row[1].replace(".*", "x").replace("\\", "") for row in promises.ROWS]
        tests[tests.index("cross.(i686|aarch64|cortex_m7|wasm)")] = "cross.i686"
        self.assertEqual(list(promises.faults(made, tests)), [])
        self.expect_one(promises.faults(made, tests[1:]), promises.ROWS[0][0])
        self.expect_one(promises.faults(made.replace("bounded", "small"), tests), "table")

    def test_a_program_that_is_not_built_may_have_any_case(self):
        for pattern, test, there in ((r"a_b\.Case\..*|c\..*", "a_b_NOT_BUILT", True),
                                     (r"a_b\.Case\..*|c\..*", "c_NOT_BUILT", True),
                                     (r"a_b\.Case\..*", "a_NOT_BUILT", False),
                                     (r"a\.Case\..*", "a.Other.case", False)):
            with self.subTest(test):
                self.assertEqual(promises.tests_of_row(pattern, [test]) == [test], there)


class Constants(Sample):
    CODE = ("constexpr float kA = 0.5F, kB = 2;  // kB = 3\n"
            "constexpr double kC[2] = {1, 0.2};\nconstexpr float kD = 1 / kA;\n"
            "struct Config {\n  float rate_per_s =\n      8;\n};\n")
    FILE = "kernel/src/a.h"
    LIST = ["kernel/src/a.h | " + row
            for row in ("kA | m | chosen | so", "kB | 1 | exact | two", "kC | 1 | measured | there",
                        "kD | 1/m | derived | kA", "Config::rate_per_s | 1/s | chosen | so")]

    def faults(self, rows, results=None, code=CODE):
        self.write(self.FILE, code)
        constants = sensitivity.listed("# words\n\n" + "\n".join(rows))
        values = sensitivity.read_values(constants, self.top)
        known = [each for each in constants if each[:2] in values]
        felt = {part: ("1, 2 (rigid)", "0", "") for each in known
                for part in sensitivity.parts_of(each, values)} if results is None else results
        table = sensitivity.made_table(known, values, felt, {})
        return sensitivity.faults(constants, values, table)

    def test_accepts_listed_and_played(self):
        self.assertEqual(list(self.faults(self.LIST)), [])

    def test_refuses_what_is_not_listed_and_what_is_gone(self):
        self.expect_one(self.faults(self.LIST[:1] + self.LIST[2:]), self.FILE, "kB")
        gone = f"{self.FILE} | kE | 1 | exact | none"
        self.expect_one(self.faults([*self.LIST, gone]), "kE")
        self.expect_one(self.faults(self.LIST + self.LIST[1:2]), "2 times")
        self.expect_one(self.faults([row.replace("exact", "guess") for row in self.LIST]), "guess")

    def test_plays_what_was_measured_or_chosen_and_nothing_for_others(self):
        self.write(self.FILE, self.CODE)
        constants = sensitivity.listed("\n".join(self.LIST))
        values = sensitivity.read_values(constants, self.top)
        for wanted, played in ([], ["kA", "kC[0]", "kC[1]", "Config::rate_per_s"]), \
                (["kC"], ["kC[0]", "kC[1]"]), (["kC[1]", "kB"], ["kC[1]"]), (["kB"], []):
            self.assertEqual(sensitivity.to_play(constants, values, wanted), played)
        with self.assertRaisesRegex(SystemExit, "kZ: not in .*constants.txt"):
            sensitivity.to_play(constants, values, ["kA", "kZ"])

    def test_refuses_another_value_and_rows_not_played(self):
        constants = sensitivity.listed("\n".join(self.LIST))
        self.write(self.FILE, self.CODE)
        values = sensitivity.read_values(constants, self.top)
        table = sensitivity.made_table(constants, values, {}, {})
        self.assertEqual(len(list(sensitivity.faults(constants, values, table))), 4)
        played = table.replace("|  |  |  |", "| 0 | 0 |  |").replace("| 8 |", "| 9 |")
        self.expect_one(sensitivity.faults(constants, values, played), "rate_per_s", "9")
        stale = table.replace("|  |  |  |", "| 0 | 0 |  |") + "more\n"
        self.expect_one(sensitivity.faults(constants, values, stale), "texts are not those of")
        listed_only = table.replace("|  |  |  |", "| 0 | 0 |  |").replace("`kB`, ", "`kF`, ")
        found = list(sensitivity.faults(constants, values, listed_only))
        self.assertEqual([("kB" in each, "kF" in each) for each in found],
                         [(True, False), (False, True)])

    def test_makes_variables_of_what_is_played_and_what_comes_of_it(self):
        code = sensitivity.patched(self.CODE, {"kA", "kC", "Config::rate_per_s"}, {"kA", "kC"})
        for line in ('const float kA = tuned<float>("kA", 0.5F), kB = 2;',
                     'const double kC[2] = {tuned<double>("kC[0]", 1), tuned<double>("kC[1]"',
                     "const float kD = 1 / kA;", 'tuned<float>("Config::rate_per_s", 8);'):
            self.assertIn(line, code)
        self.assertNotIn("constexpr", code)


class Stack(Sample):
    TICK = "namespace stylet { struct Kernel; void tick(Kernel&) { %s } }\n"

    def bound(self, before, body):
        source = self.write("a.cpp", before + self.TICK % body)
        subprocess.run(["g++", "-O1", "-fno-inline", "-fcallgraph-info=su", "-c", source,
                        "-o", self.top / "a.o"], check=True)
        graph = stack.Graph()
        graph.add((self.top / "a.ci").read_text())
        return stack.bound(graph)[0], graph.faults

    def test_adds_up_the_longest_path(self):
        size, faults = self.bound("void use(int* a) { asm(\"\" : : \"r\"(a) : \"memory\"); }\n"
                                  "void deep() { int a[1000]; use(a); }\n"
                                  "void flat() { int a[10]; use(a); }\n", "int a[500]; use(a);"
                                  "flat(); deep();")
        self.assertEqual(faults, [])
        self.assertTrue(6000 + stack.RED_ZONE <= size < 6200 + stack.RED_ZONE, size)

    def test_refuses_recursion(self):
        self.expect_one(self.bound("int f(int n); int g(int n) { asm(\"\"); return n * f(n); }\n"
                                   "int f(int n) { return n > 1 ? 1 + g(n - 1) : 1; }\n",
                                   "f(3);")[1], "calls itself", "g(int)")

    def test_refuses_frames_of_variable_size(self):
        self.expect_one(self.bound("void use(void* a) { asm(\"\" : : \"r\"(a) : \"memory\"); }\n"
                                   "void f(int n) { use(__builtin_alloca(n)); }\n", "f(3);")[1],
                        "f(int)", "variable")

    def test_refuses_unknown_pointers_and_functions(self):
        self.expect_one(self.bound("void (*volatile p)();\n", "p();")[1], "pointer")
        self.expect_one(self.bound("void other();\n", "other();")[1], "other()", "nobody knows")

    def test_refuses_no_tick(self):
        graph = stack.Graph()
        stack.bound(graph)
        self.expect_one(graph.faults, "no function")


class Tidy(Sample):
    def faults(self):
        return tidy.faults(self.top)

    def test_accepts_good(self):
        self.write("kernel/src/a.cpp", APACHE + 'const char* kA = "new malloc(";  // no new here\n'
                   "#include <new>\nauto* kernel = new (memory) Kernel;\n")
        self.write("offline/src/a.cpp", GPL + "std::vector<int> v;\n")
        self.assertEqual(list(self.faults()), [])

    def test_refuses_long_line(self):
        self.write("hal/a.cpp", APACHE + "// " + "a" * 98 + "\n")
        self.expect_one(self.faults(), "hal/a.cpp:2", "101 columns")

    def test_refuses_a_cited_test_that_does_not_exist(self):
        self.write("tests/a_test.cpp", APACHE + "TEST_P(Needle, BendsAsABeam) {\n}\n")
        self.write("kernel/a.md",
                   "`needle_beam.Needle.Bends`, `needle_beam.Needle.*Beam`, `a.B.c`\n")
        self.assertEqual(list(self.faults()), [])
        self.write("kernel/b.md", "see\n`needle_beam.Needle.Breaks`\n")
        self.expect_one(self.faults(), "kernel/b.md:2", "no test Needle.Breaks")

    def test_refuses_long_function(self):
        body = "  f();\n" * 59
        self.write("hal/a.cpp", APACHE + "void f(int a,\n       int b) {\n" + body + "}\n")
        self.expect_one(self.faults(), "hal/a.cpp:2", "62 lines")

    def test_refuses_long_file(self):
        self.write("hal/a.cpp", APACHE + "int a;\n" * 500)
        self.write("tests/a.cpp", APACHE + "int a;\n" * 500)
        self.expect_one(self.faults(), "hal/a.cpp", "501 lines")

    def test_other_languages_have_the_same_bounds(self):
        for ending in ("ts", "mjs", "css", "py", "c"):
            with self.subTest(ending):
                self.write(f"hal/a.{ending}", APACHE + "a;\n" * 500)
                self.expect_one(self.faults(), f"hal/a.{ending}", "501 lines")
                self.write(f"hal/a.{ending}", APACHE + "a" * 101 + "\n")
                self.expect_one(self.faults(), f"hal/a.{ending}:2", "101 columns")
                (self.top / f"hal/a.{ending}").unlink()

    def test_refuses_letters_that_nothing_explains(self):
        self.write("hal/guard/GUARD.md", "| R1 | A force shall be small. | |\n")
        self.write("hal/a.md", "**K**: decisions\n\n| 3 (K) | GUARD.md, R1 |\n")
        self.assertEqual(list(self.faults()), [])
        self.write("hal/a.md", "**K**: decisions\n\n| 3 (" "L) | 2 |\n")
        self.expect_one(self.faults(), "hal/a.md:3", "the letter L")
        self.write("hal/a.md", "see GUARD.md, R2\n")
        self.expect_one(self.faults(), "hal/a.md:1", "no requirement R2")

    def test_refuses_two_types_of_one_name(self):
        self.write("kernel/src/a/a.h", APACHE + "struct Energy {\n};\nclass Later;\n")
        self.write("hal/a.h", APACHE + "struct Energy {\n};\nclass Later final {\n};\n")
        self.assertEqual(list(self.faults()), [])
        self.write("kernel/include/b.h", APACHE + "enum class Energy : int {\n};\n")
        found = list(self.faults())
        self.assertEqual(len(found), 2, found)

    def test_refuses_files_and_constants_that_are_gone(self):
        self.write("hal/room/a.h", APACHE + "constexpr int kHere = 1;\n")
        self.write("hal/a.md", "`room/a.h`, `a.h`, `kHere`, `NAME_bench.cpp`\n")
        self.assertEqual(list(self.faults()), [])
        self.write("hal/a.md", "`kGone`\n\n`room/b.h`\n")
        found = list(self.faults())
        self.assertEqual(len(found), 2, found)

    def test_refuses_dead_links(self):
        self.write("hal/b.md", "# b\n")
        self.write("hal/a.md", "[b](b.md#b) [c](https://c.org/x)\n[gone](../gone.md)\n")
        self.expect_one(self.faults(), "hal/a.md:2", "../gone.md")

    def test_refuses_sections_that_are_not_there(self):
        self.write("kernel/PHYSICS.md", "# Physics\n## 2. Lattice\n### 2.1 Voxels\n")
        self.write("hal/a.cpp", APACHE + "// PHYSICS 2, 2.1.\n")
        self.assertEqual(list(self.faults()), [])
        self.write("hal/a.cpp", APACHE + "// PHYSICS 2.1 and 2.4.\n")
        self.expect_one(self.faults(), "hal/a.cpp:2", "no section 2.4")

    def test_looks_into_every_room_of_the_real_time_path(self):
        self.write("kernel/src/room/a.cpp", APACHE + "auto* a = malloc(1);\n")
        self.expect_one(self.faults(), "kernel/src/room/a.cpp:2", "real-time path")

    def test_long_namespace_and_table_are_no_function(self):
        body = "  {1, 2},\n" * 80
        self.write("hal/a.cpp", APACHE + "namespace a {\nint k[][2] = {\n" + body + "};\n}\n")
        self.assertEqual(list(self.faults()), [])

    def test_refuses_missing_or_wrong_licence(self):
        self.write("offline/a.h", APACHE)
        self.expect_one(self.faults(), "offline/a.h:1", "GPL-3.0-or-later")

    def test_refuses_a_python_that_may_lack_packages(self):
        licence = "# SPDX-License-Identifier: Apache-2.0\n"
        self.write("hal/good.py", "#!/usr/bin/python3\n" + licence)
        self.write("hal/module.py", licence)
        self.write("hal/bad.py", "#!/usr/bin/env python3\n" + licence)
        self.expect_one(self.faults(), "hal/bad.py:1", "/usr/bin/python3")

    def test_refuses_marks_and_paths_also_in_texts(self):
        self.write("hal/README.md", "a TO" "DO\n" + "see /ho" "me/me/x\n")
        found = list(self.faults())
        self.assertEqual(len(found), 2, found)

    def test_refuses_banned_words_only_on_the_real_time_path(self):
        for statement in ["auto* p = new int;", "auto* p = new (std::nothrow) int;", "free(p);",
                          "std::vector<int> v;", "throw 1;",
                          "std::function<void()> f;", "virtual ~A();", 'printf("x");']:
            with self.subTest(statement):
                self.write("hal/record/other.cpp", APACHE + statement + "\n")
                self.write("kernel/src/a.cpp", APACHE + statement + "\n")
                self.expect_one(self.faults(), "kernel/src/a.cpp:2", "real-time path")


if __name__ == "__main__":
    unittest.main()
