#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The package says of every function what it takes and gives, as py.typed promises; a checker of
types finds no fault in it, finds those of a program that uses it, and the stubs are the module.

Expected values: the package's own sources, and what pybind11 says of the module's functions.
"""
import ast
import inspect
import re
import shutil
import subprocess
import sys
import unittest

import stylet
from stylet import _stylet
from support import SOURCE, folder

PACKAGE = SOURCE / "hal/hosts/python/package/stylet"
PROGRAM = """
import numpy as np
import stylet
organ: stylet.Organ = stylet.phantom("liver")
needle = stylet.Needle(bending_nm2=0.02)
simulation = stylet.Simulation(organ, [needle], obstacles=stylet.Obstacle.sphere(0.01))
poses = stylet.poses_of_tips(np.zeros((5, 3)), (0, 0, -1), needle.length_m)
force = simulation.clone().run(poses)["force_n"]
env = stylet.NeedleEnv(organ, [stylet.Target("goal", (0, 0, 0), 0.01)])
observation, info = env.reset(seed=1)
columns = stylet.draw({"force_n": stylet.Uniform(0, 1)}, 10, seed=1)
"""
FAULTS = ('stylet.Simulation("liver.organ")', "stylet.phantom(5)",
          'stylet.Organ.read("a").raycast((0, 0, 0))', 'stylet.poses_of_tips(simulation, None, 1)',
          'stylet.draw({"force_n": 5}, 10, seed=1)', 'stylet.NeedleEnv(organ, organ)')


def functions(tree):
    return [node for node in ast.walk(tree)
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))]


def bare(function):
    """Arguments of a function of which nothing is said; "return" for what it gives."""
    of = function.args
    arguments = [*of.posonlyargs, *of.args, *of.kwonlyargs, *filter(None, (of.vararg, of.kwarg))]
    names = [each.arg for each in arguments
             if each.annotation is None and each.arg not in ("self", "cls")]
    return names + ["return"] * (function.returns is None)


class Annotations(unittest.TestCase):
    def test_of_every_function(self):
        files = sorted(PACKAGE.glob("*.py"))
        self.assertGreater(len(files), 20)
        left = [f"{file.name}:{function.lineno} {function.name}: {names}" for file in files
                for function in functions(ast.parse(file.read_text()))
                for names in [bare(function)] if names]
        self.assertEqual(left, [])

    def test_can_be_read_when_the_program_runs(self):
        for name in stylet.__all__:
            thing = getattr(stylet, name)
            for each in [thing, *vars(thing).values()] if inspect.isclass(thing) else [thing]:
                if inspect.isfunction(each) and each.__module__.startswith("stylet"):
                    inspect.signature(each, eval_str=True)


class Stubs(unittest.TestCase):
    """Those of the module that is in C++: names, and the arguments' names."""
    tree = ast.parse((PACKAGE / "_stylet.pyi").read_text())

    def test_classes_have_every_member(self):
        checked = set()
        for node in self.tree.body:
            kind = getattr(_stylet, getattr(node, "name", ""), None)
            if not isinstance(node, ast.ClassDef) or node.name == "StyletError" or kind is None:
                continue  # its fields are its constructor's; structs: names_test.py
            told = {getattr(item, "name", None) or item.target.id for item in node.body}
            self.assertEqual({name for name in told if not name.startswith("__")},
                             {name for name in vars(kind) if not name.startswith("__")}, node.name)
            checked.add(node.name)
        self.assertLessEqual({"Organ", "Simulation", "Batch", "Guard", "Device", "Loop"}, checked)

    def test_arguments_have_the_names_of_the_module(self):
        checked = 0
        for node in self.tree.body:
            inside = node.body if isinstance(node, ast.ClassDef) else [node]
            for item in inside:
                if not isinstance(item, ast.FunctionDef):
                    continue
                owner = getattr(_stylet, node.name) if item is not node else _stylet
                words = getattr(owner, item.name).__doc__ or ""
                said = re.match(rf"{item.name}\((.*?)\) ->", words)
                if not said or "Overloaded" in words:
                    continue
                # pybind11 calls those that have no name in a call arg0 and so on.
                real = [name for name in re.findall(r"(?:^|, )(\w+): ", said[1]) if name != "self"]
                first = len(item.args.posonlyargs) - (item is not node and self.is_bound(item))
                told = [f"arg{i}" for i in range(max(first, 0))]
                told += [each.arg for each in item.args.args if each.arg != "self"]
                self.assertEqual(told, real, item.name)
                checked += 1
        self.assertGreater(checked, 50)


    def is_bound(self, method):
        return not any(getattr(each, "id", "") == "staticmethod" for each in method.decorator_list)


class Checker(unittest.TestCase):
    """mypy, where it is installed."""

    def checked(self, *words):
        mypy = shutil.which("mypy")
        if mypy is None:
            raise unittest.SkipTest("mypy is not installed")
        done = subprocess.run([mypy, "--python-executable", sys.executable,
                               "--ignore-missing-imports", "--check-untyped-defs",
                               "--disallow-untyped-defs", "--cache-dir", folder() / "mypy", *words],
                              text=True, capture_output=True, cwd=folder(),
                              env={"PATH": "/usr/bin:/bin", "MYPYPATH": str(PACKAGE.parent)})
        return done.returncode, done.stdout + done.stderr

    def test_finds_no_fault_in_the_package(self):
        self.assertEqual(self.checked("-p", "stylet")[0], 0, self.checked("-p", "stylet")[1])

    def test_finds_the_faults_of_a_program(self):
        good, bad = folder() / "good.py", folder() / "bad.py"
        good.write_text(PROGRAM)
        bad.write_text(PROGRAM + "\n".join(FAULTS) + "\n")
        status, words = self.checked(good)
        self.assertEqual(status, 0, words)
        _, words = self.checked(bad)
        first = PROGRAM.count("\n") + 1
        found = {int(line) for line in re.findall(r"bad.py:(\d+): error", words)}
        self.assertEqual(found, set(range(first, first + len(FAULTS))), words)


if __name__ == "__main__":
    unittest.main()
