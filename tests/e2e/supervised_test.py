#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`stylet run --console` as a service of systemd: this test is systemd's side of sd_notify(3), and
systemd itself judges the unit. STYLET_BIN and STYLET_SOURCE name folders of programs and source.
"""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

BIN = pathlib.Path(os.environ["STYLET_BIN"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
UNIT = SOURCE / "toolchain/rt-host/tree/etc/systemd/system/stylet@.service"
WATCHDOG_S = 0.4


class Notified(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="stylet-")
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)

    def told(self, address, own_pid=None, watched_s=1.5):
        """What the program reports within a time after its page is there, and when."""
        hears = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(hears.close)
        hears.bind(address.replace("@", "\0", 1) if address.startswith("@") else address)
        hears.settimeout(0.1)
        env = {**os.environ, "NOTIFY_SOCKET": address, "XDG_CACHE_HOME": str(self.top),
               "WATCHDOG_USEC": str(int(WATCHDOG_S * 1e6))}
        if own_pid is not None:
            env["WATCHDOG_PID"] = str(own_pid)
        program = subprocess.Popen(
            [BIN / "stylet", "run", "fig03-puncture", "--fast", "--console=0"], env=env, text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.addCleanup(program.kill)
        words, ends, page_s = [], time.monotonic() + 60, None
        while time.monotonic() < ends:
            try:
                words.append((hears.recv(100).decode(), time.monotonic()))
            except TimeoutError:
                continue
            if page_s is None and words[-1][0] == "READY=1":
                page_s, ends = time.monotonic(), time.monotonic() + watched_s
        program.send_signal(signal.SIGINT)
        said = program.communicate(timeout=30)[0]
        self.assertIn("console at http://", said)
        self.assertEqual(program.returncode, 0, said)
        return words

    def test_ready_once_and_alive_in_time(self):
        for address in (str(self.top / "notify"), f"@stylet-test-{os.getpid()}"):
            with self.subTest(address):
                words = self.told(address)
                self.assertEqual([word for word, _ in words].count("READY=1"), 1)
                alive = [at_s for word, at_s in words if word == "WATCHDOG=1"]
                self.assertGreaterEqual(len(alive), 2)
                # At most one message in each quarter of the watchdog's time; a busy machine may be
                # later than that.
                self.assertLessEqual(len(alive), 1.5 / (WATCHDOG_S / 4) + 2)
                self.assertEqual({word for word, _ in words}, {"READY=1", "WATCHDOG=1"})

    def test_a_watchdog_of_another_process_is_not_fed(self):
        words = self.told(str(self.top / "notify"), own_pid=1, watched_s=0.5)
        self.assertEqual([word for word, _ in words], ["READY=1"])

    def test_an_address_that_does_not_exist_does_no_harm(self):
        for address in ("", "x", "/" + 200 * "y"):
            env = {**os.environ, "NOTIFY_SOCKET": address, "XDG_CACHE_HOME": str(self.top)}
            program = subprocess.Popen(
                [BIN / "stylet", "run", "fig03-puncture", "--fast", "--console=0"], env=env,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
            self.addCleanup(program.kill)
            while "console at" not in (line := program.stdout.readline()):
                self.assertNotEqual(line, "", f"{address}: ended without a page")
            program.send_signal(signal.SIGINT)
            program.communicate(timeout=30)
            self.assertEqual(program.returncode, 0, address)


class Unit(unittest.TestCase):
    def test_systemd_has_no_objection(self):
        if shutil.which("systemd-analyze") is None:
            self.skipTest("no systemd-analyze here (Debian: systemd)")
        with tempfile.TemporaryDirectory() as name:
            def judged(text):
                unit = pathlib.Path(name) / "stylet@trial.service"
                unit.write_text(text)
                done = subprocess.run(["systemd-analyze", "verify", "--man=no", unit],
                                      capture_output=True, text=True)
                return done.returncode, [line for line in done.stderr.splitlines()
                                         if "stylet@trial" in line]
            text = re.sub(r"^ExecStart=\S+", f"ExecStart={BIN / 'stylet'}", UNIT.read_text(),
                          flags=re.M)
            self.assertEqual(judged(text), (0, []))
            self.assertNotEqual(judged(text.replace("WatchdogSec", "WatchdogSeconds"))[1], [])
            self.assertNotEqual(judged(text.replace("/stylet run", "/no-such run"))[1], [])

    def test_the_unit_asks_systemd_to_watch(self):
        text = UNIT.read_text()
        self.assertIn("Type=notify\n", text)
        self.assertRegex(text, r"WatchdogSec=\d+\n")


if __name__ == "__main__":
    unittest.main()
