#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests that check.sh runs the tests of its tier and no others: cmake, ctest and python3 are
stand-ins that record how they were called."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOLCHAIN = pathlib.Path(__file__).resolve().parent.parent
ALL_INSTALLED = """#!/bin/sh
for name in "$@"; do
  case $name in -*) ;; *) echo "$name installed" ;; esac
done
"""
# Records under which name and with which arguments it was called; fails if a file "NAME fails"
# exists, which ctest then also copies as its list of failed tests.
RECORDER = """#!/bin/sh
echo "$(basename "$0") $*" >> "$STAND_IN/calls"
fails="$STAND_IN/$(basename "$0") fails"
[ -e "$fails" ] || exit 0
if [ "$1" = --test-dir ]; then
  mkdir -p "$2/Testing/Temporary" && cp "$fails" "$2/Testing/Temporary/LastTestsFailed.log"
fi
exit 1
"""
COMMON = re.compile(r"^--output-on-failure -j 2 --output-junit \S+/Testing/results/\d+\.xml "
                    r"--test-output-size-passed \d+ ")
SHORT = "-LE ^(full|night)$"


class Tiers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        # Without __pycache__, to which other checks may be writing now.
        shutil.copytree(TOOLCHAIN, self.top / "toolchain",
                        ignore=shutil.ignore_patterns("__pycache__"))
        for name, text in (("dpkg-query", ALL_INSTALLED), ("cmake", RECORDER),
                           ("ctest", RECORDER), ("python3", RECORDER)):
            path = self.top / name
            path.write_text(text)
            path.chmod(0o755)

    def check(self, *arguments):
        """Exit code, and for each call of ctest its preset and which tests it was to run."""
        done = subprocess.run([self.top / "toolchain/check.sh", *arguments], capture_output=True,
                              env={"PATH": f"{self.top}:{os.environ['PATH']}",
                                   "STAND_IN": str(self.top)})
        calls = self.top / "calls"
        lines = calls.read_text().splitlines() if calls.exists() else []
        tests = [line.split(" ", 3)[2:] for line in lines if line.startswith("ctest")]
        self.said = done.stdout.decode()
        return done.returncode, [(pathlib.Path(folder).name, COMMON.sub("", rest))
                                 for folder, rest in tests]

    FAST = [("release", SHORT)]
    FULL = FAST + [("release", "-L ^full$ --no-tests=ignore"),
                   ("invariants", SHORT + " -R ^(coupling|insertion)_"),
                   ("sanitize", SHORT + r" -E ^(check|rt_host|cross|rt\.determinism|fuzz\.short|"
                    r"bench|offline\.cohort|coupling_energy)|ripple|calculix"),
                   ("sanitize-threads", SHORT + " -R ^(hal|rt_team|console)|InTwoThreads"
                    " -E ^hal_(coupling|steered)|NoHelperComes")]
    NIGHT = FULL + [("release", "-L ^night$ --no-tests=ignore")]

    def test_each_tier_has_all_of_the_one_before(self):
        for tier, expected in ("fast", self.FAST), ("full", self.FULL), ("night", self.NIGHT):
            with self.subTest(tier):
                (self.top / "calls").unlink(missing_ok=True)
                self.assertEqual(self.check(tier), (0, expected))

    def test_after_a_failure_the_rest_is_run_and_a_summary_names_what_failed(self):
        (self.top / "ctest fails").write_text("12:rt.stack\n20:simulator.costs\n")
        self.assertEqual(self.check("full"), (1, self.FULL))
        summary = self.said.split("==> Tier full\n")[1]
        self.assertEqual(summary.count("FAILED"), len(self.FULL), summary)
        self.assertEqual(summary.count("\n                  simulator.costs"), len(self.FULL))

    def test_a_build_that_fails_fails_its_part(self):
        (self.top / "cmake fails").touch()
        self.assertEqual(self.check("full"), (1, [self.FULL[1]]))
        self.assertRegex(self.said.split("==> Tier full")[1], r"passed +[01] min  full tests")

    def test_fast_tests_that_fail_fail_the_fast_tier(self):
        (self.top / "ctest fails").touch()
        self.assertEqual(self.check("fast"), (1, self.FAST))

    def test_other_words_are_refused(self):
        for arguments in (), ("faster",), ("fast", "full"):
            self.assertEqual(self.check(*arguments), (1, []))


if __name__ == "__main__":
    sys.exit(unittest.main())
