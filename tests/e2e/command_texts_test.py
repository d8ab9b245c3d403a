#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Manual pages and completions say all that --help says, and shells and groff accept them.

usage: command_texts_test.py   with STYLET_BIN in the environment
"""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["STYLET_BIN"])
PROGRAMS = ["stylet", "stylet-organ"]
SEPARATE = 2  # exit code of wrong usage


def call(program, *words, expect=0, **more):
    done = subprocess.run([BIN / program, *map(str, words)], capture_output=True, text=True,
                          timeout=60, **more)
    if done.returncode != expect:
        raise AssertionError(f"{program} {words}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def help_of(program, words=()):
    """Options with their possible values, and commands, as --help prints them."""
    text = call(program, *words, "--help")
    options = re.findall(r"(?m)^  ((?:-\w,)?--[\w-]+)(?: ?(?:\[=\w+\]|([A-Z][\w:,{}+-]*)))?", text)
    named = [(name.split(",")[-1], value) for name, value in options]
    commands = text.partition("Subcommands:\n")[2].partition("\n\n")[0]
    return named, re.findall(r"(?m)^  (\w+) ", commands)


def commands_of(program):
    """[(words, options, inner commands)] of the program and all its commands."""
    found, waiting = [], [[]]
    while waiting:
        words = waiting.pop()
        if words == ["bench"]:
            continue  # a program of its own
        options, inner = help_of(program, words)
        found.append((words, options, inner))
        waiting += [[*words, name] for name in inner]
    return found


class Manual(unittest.TestCase):
    def test_says_all_that_help_says(self):
        for program in PROGRAMS:
            page = call(program, "--man").replace("\\-", "-")
            for words, options, inner in commands_of(program):
                _, _, rest = page.partition(f".SS {' '.join([program, *words])}\n")
                section = rest.partition("\n.S")[0] if words else page.partition(".SH COMMANDS")[0]
                for name, _ in options:
                    self.assertIn(f"\\fB{name}\\fR", section, words)
                for name in inner:
                    self.assertIn(f".SS {' '.join([program, *words, name])}\n", page)
                for line in call(program, *words, "--help").partition("\nExample")[2].splitlines():
                    if line.startswith("  "):
                        self.assertIn(line.replace("'", "\\(aq"), page)

    def test_is_the_same_in_every_run_and_groff_has_no_warning(self):
        for program in PROGRAMS:
            page = call(program, "--man")
            self.assertEqual(call(program, "--man"), page)
            for command in (["groff", "-man", "-ww", "-Tutf8"], ["mandoc", "-Tlint", "-Wwarning"]):
                if shutil.which(command[0]) is None:
                    continue
                done = subprocess.run(command, input=page, capture_output=True, text=True)
                said = done.stderr if command[0] == "groff" else done.stdout
                self.assertEqual((done.returncode, said), (0, ""), command)
        if shutil.which("groff") is None:
            self.skipTest("no groff here; toolchain/setup.sh installs it")


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        for program in PROGRAMS:
            for shell in ("bash", "zsh", "fish"):
                path = cls.top / f"{program}.{shell}"
                path.write_text(call(program, "--completion", shell))
        cls.folder = cls.top / "with files"
        (cls.folder / "inner").mkdir(parents=True)
        for name in ("one scene.toml", "liver.organ"):
            (cls.folder / name).touch()

    def complete(self, program, lines):
        """What a fresh bash offers at the end of each line: a list of words."""
        script = f"source {self.top}/{program}.bash\n" + """
        while IFS= read -r line; do
          read -r -a COMP_WORDS <<<"$line"
          [[ $line != *" " ]] || COMP_WORDS+=("")
          COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
          $(complete -p "${COMP_WORDS[0]}" | sed 's/.*-F \\([^ ]*\\).*/\\1/') "${COMP_WORDS[0]}" \\
            "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
          printf '%s|' "${COMPREPLY[@]}"; echo
        done"""
        done = subprocess.run(["bash", "--norc", "-c", script], input="\n".join(lines) + "\n",
                              capture_output=True, text=True, cwd=self.folder, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        replies = [set(line.split("|")) - {""} for line in done.stdout.splitlines()]
        self.assertEqual(len(replies), len(lines))
        return replies

    def test_bash_offers_every_option_and_command_of_help(self):
        chosen = random.Random(28)
        for program in PROGRAMS:
            all_commands = commands_of(program)
            chosen.shuffle(all_commands)
            lines, expected = [], []
            for words, options, inner in all_commands:
                start = " ".join([program, *words])
                lines += [start + " -", start + " "]
                expected += [{name for name, _ in options}, set(inner)]
                for name, value in options:
                    if "{" in value:
                        lines.append(f"{start} {name} ")
                        expected.append(set(value[value.index("{") + 1:-1].split(",")))
                    elif value.startswith("FILE"):
                        lines.append(f"{start} {name} liv")
                        expected.append({"liver.organ"})
                    elif value.startswith("FOLDER"):
                        lines.append(f"{start} {name} ")
                        expected.append({"inner"})
            for line, offered, wanted in zip(lines, self.complete(program, lines), expected):
                self.assertLessEqual(wanted, offered, line)
                if line.endswith("-"):
                    self.assertEqual({name for name in offered if name.startswith("--")}, wanted)

    def test_bash_offers_nothing_that_does_not_fit(self):
        scenes, force, other, mode = self.complete("stylet", [
            "stylet run ", "stylet run --fo", "stylet run --duration-s ", "stylet run --mode pa"])
        self.assertEqual(scenes, {"one scene.toml", "liver.organ", "inner"})
        self.assertEqual(force, {"--force"})
        self.assertEqual(other, set())
        self.assertEqual(mode, {"paper"})

    def test_zsh_and_fish_name_every_option_and_take_the_text(self):
        for program in PROGRAMS:
            for shell in ("zsh", "fish"):
                path = self.top / f"{program}.{shell}"
                text = path.read_text()
                for words, options, inner in commands_of(program):
                    for name, _ in options:
                        self.assertIn(f"'{name}['" if shell == "zsh" else f" -l {name[2:]}", text)
                    for name in inner:
                        self.assertIn(name, text)
                if shutil.which(shell) is not None:
                    done = subprocess.run([shell, "-n", path], capture_output=True, text=True)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))


class OptionalValues(unittest.TestCase):
    """An optional value comes after '='; a user who writes a blank instead is told so."""

    def test_every_option_with_an_optional_value_gives_the_hint(self):
        chosen, seen = random.Random(7), 0
        for program in PROGRAMS:
            for words, options, _ in commands_of(program):
                text = call(program, *words, "--help")
                for name in set(re.findall(r"(?m)^  (--[\w-]+)\{", text)):
                    seen += 1
                    number = chosen.randrange(1, 65536)
                    for line in ([name, number, "a.toml"], ["a.toml", name, number],
                                 ["a.toml", "--fast", name, number]):
                        done = subprocess.run([BIN / program, *words, *map(str, line)],
                                              capture_output=True, text=True, timeout=60)
                        self.assertEqual(done.returncode, SEPARATE)
                        self.assertIn(f"{name} {number}: expected {name}={number}",
                                      done.stdout + done.stderr)
        self.assertGreaterEqual(seen, 2)

    def test_a_scene_may_follow_an_option_without_its_value(self):
        done = subprocess.run([BIN / "stylet", "run", "--console", "nowhere.toml"],
                              capture_output=True, text=True, timeout=60)
        self.assertIn("nowhere.toml: no such file", done.stderr)


class EmptyValues(unittest.TestCase):
    """An empty value, as an unset variable of a script leaves it, is refused for every option, and
    nothing is written."""

    def test_every_option_that_takes_a_value_refuses_an_empty_one(self):
        seen = set()
        with tempfile.TemporaryDirectory() as folder:
            for program in PROGRAMS:
                for words, options, _ in commands_of(program):
                    for name, value in options:
                        if not value:
                            continue
                        seen.add(name)
                        for line in ([name, ""], ["a", name, "", "b"], [f"{name}="]):
                            done = subprocess.run([BIN / program, *words, *line], text=True,
                                                  capture_output=True, timeout=60, cwd=folder)
                            self.assertEqual(done.returncode, SEPARATE, (words, line))
                            self.assertRegex(done.stderr, f"^{name}.*: expected ", (words, line))
                    done = subprocess.run([BIN / program, *words, ""], text=True,
                                          capture_output=True, timeout=60, cwd=folder)
                    self.assertEqual(done.returncode, SEPARATE, words)
                    self.assertIn("an empty text follows", done.stderr)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
        self.assertLessEqual({"--record", "--organ", "--flight", "--output", "--scene", "--recipe"},
                             seen)


class Json(unittest.TestCase):
    """A command that prints a result can print it as JSON, too."""

    def test_every_command_with_a_result_has_it(self):
        without = {"console", "plot", "station", "bench"}  # no result, or a format of its own
        for program in PROGRAMS:
            for words, options, inner in commands_of(program):
                if words and words[0] not in without:
                    self.assertIn("--json", [name for name, _ in options], words)

    def test_check_and_replay(self):
        with tempfile.TemporaryDirectory() as folder:
            top = pathlib.Path(folder)
            scene = top / "a.toml"
            scene.write_text('[organ]\npath = "a.organ"\n[[hand.waypoint]]\ntravel_mm = 3\n'
                             "speed_mm_s = 50\n")
            call("stylet-organ", "phantom", "ball", "--diameter-mm", 40, "-o", top / "a.organ",
                 "--sum")
            check = json.loads(call("stylet-organ", "check", top / "a.organ", "--json"))
            info = json.loads(call("stylet-organ", "info", top / "a.organ", "--json"))
            self.assertEqual((check["ok"], check["voxels"]), (True, info["voxels"]))
            self.assertTrue(check["sum_beside_it_agrees"] and check["bytes_are_those_built"])
            ran = json.loads(call("stylet", "run", scene, "--fast", "--json", "--record",
                                  top / "a.h5"))
            same = json.loads(call("stylet", "replay", top / "a.h5", "--json"))
            self.assertEqual((same["same"], same["unfinished"]), (True, False))
            self.assertEqual(same["state_hash"], ran["state_hash"])
            import h5py
            with h5py.File(top / "a.h5", "r+") as file:
                force = file["output/force_n"]
                row = force[len(force) - 1]
                row[1] += 1
                force[len(force) - 1] = row
                tick = int(file["output/tick"][-1])
            other = json.loads(call("stylet", "replay", top / "a.h5", "--json", expect=3))
            self.assertFalse(other["same"])
            self.assertEqual(other["differs"]["tick"], tick)
            self.assertIn("force_n", other["differs"]["field"])


if __name__ == "__main__":
    unittest.main()
