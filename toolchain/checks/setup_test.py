#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests setup.sh as on other machines: apt-get, dpkg-query, id and sudo are stand-ins that come
first in PATH and behave as the real programs do on a fresh, an offline or a locked machine."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SETUP = pathlib.Path(__file__).resolve().parent.parent / "setup.sh"

DPKG_QUERY = """#!/bin/sh
[ -e "$STAND_IN/installed" ] || exit 1
for name in "$@"; do
  case $name in -*) ;; *) echo "$name installed" ;; esac
done
"""

# Like the real program: scripts of the packages do not get the descriptor for the progress.
APT_GET = """#!/usr/bin/env python3
import os, pathlib, subprocess, sys
top = pathlib.Path(os.environ["STAND_IN"])
with open(top / "calls", "a") as calls:
    calls.write(" ".join(sys.argv[1:]) + "\\n")
status = next(int(a.split("=")[1]) for a in sys.argv if a.startswith("APT::Status-Fd="))
os.write(status, b"dlstatus:1:9.9:a\\ndlstatus:1:31.5:a\\ndlstatus:1:100.0000:a\\n")
if (top / "offline").exists():
    sys.exit("W: Failed to fetch http://debian.example/x  Temporary failure resolving 'x'")
if "install" in sys.argv:
    os.set_inheritable(status, False)
    if subprocess.run(["sh", "-c", "echo Regenerating cache"], close_fds=False).returncode:
        print("dpkg: error processing package a (--configure):\\n script failed", flush=True)
        sys.exit("E: Sub-process /usr/bin/dpkg returned an error code (1)")
    if (top / "broken").exists():
        sys.exit("E: Unable to locate package libcli11-dev")
    (top / "installed").touch()
"""

SUDO = """#!/bin/sh
[ "$1" != -n ] || { [ -e "$STAND_IN/password" ] && exit 1; shift; }
exec "$@"
"""


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.program("dpkg-query", DPKG_QUERY)
        self.program("apt-get", APT_GET)
        self.program("id", "#!/bin/sh\necho 0\n")
        self.program("npm", "#!/bin/sh\nexit 1\n")  # no network; all else must still be installed

    def program(self, name, text):
        path = self.top / name
        path.write_text(text)
        path.chmod(0o755)

    def run_setup(self, *words, expect=0):
        done = subprocess.run([SETUP, *words], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True,
                              env={"PATH": f"{self.top}:{os.environ['PATH']}",
                                   "STAND_IN": str(self.top)})
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done

    def test_packages_whose_scripts_print_are_installed(self):
        done = self.run_setup()
        self.assertIn("packages are there", done.stdout)
        self.assertIn("downloaded 30 %\n    downloaded 100 %\n", done.stdout)

    def listed(self, purpose):
        return set(self.run_setup("--list", purpose).stdout.split())

    def test_each_purpose_has_all_of_the_one_before_and_no_more_is_installed(self):
        run, develop, test, full = (self.listed(purpose)
                                    for purpose in ("run", "develop", "test", "full"))
        self.assertLess(run, develop)
        self.assertLess(develop, test)
        self.assertLess(test, full)
        self.assertFalse((self.top / "calls").exists())
        for purpose, packages in ("run", run), ("develop", develop), ("test", test), ("full", full):
            with self.subTest(purpose):
                (self.top / "installed").unlink(missing_ok=True)
                self.run_setup(purpose)
                install = (self.top / "calls").read_text().splitlines()[-1]
                self.assertLessEqual(packages, set(install.split()))
                self.assertFalse((full - packages) & set(install.split()))

    def test_one_curve_needs_neither_browser_nor_cluster_nor_other_processors(self):
        for package in self.listed("develop"):
            self.assertNotRegex(package, "chromium|nodejs|slurm|munge|qemu|aarch64|i686|arm-none")

    def test_what_ci_installs_has_neither_windows_nor_a_game_engine(self):
        for package in self.listed("test"):
            self.assertNotRegex(package, "wine|mingw|godot")

    def test_other_purposes_are_refused(self):
        for words in ("deploy",), ("run", "test"), ("--list", "all"):
            self.assertIn("run, develop, test, full", self.run_setup(*words, expect=1).stderr)

    def test_nothing_missing_asks_for_nothing(self):
        (self.top / "installed").touch()
        self.program("id", "#!/bin/sh\necho 1000\n")
        self.run_setup()
        self.assertFalse((self.top / "calls").exists())

    def test_a_user_with_sudo(self):
        self.program("id", "#!/bin/sh\necho 1000\n")
        self.program("sudo", SUDO)
        self.run_setup()

    def test_sudo_that_wants_a_password_without_a_terminal(self):
        self.program("id", "#!/bin/sh\necho 1000\n")
        self.program("sudo", SUDO)
        (self.top / "password").touch()
        self.assertIn("no terminal", self.run_setup(expect=1).stderr)
        self.assertFalse((self.top / "calls").exists())

    def test_no_network_is_said_in_two_lines(self):
        (self.top / "offline").touch()
        lines = self.run_setup(expect=1).stderr.split("\n")
        self.assertEqual([line for line in lines if line], [
            "error: the packages could not be downloaded: no network, or the package source is "
            "down", "       http://debian.example/x  Temporary failure resolving 'x'"])

    def test_other_failures_show_the_words_of_apt(self):
        (self.top / "broken").touch()
        error = self.run_setup(expect=1).stderr
        self.assertIn("E: Unable to locate package libcli11-dev", error)
        self.assertIn("for the reason above", error)


if __name__ == "__main__":
    sys.exit(unittest.main())
