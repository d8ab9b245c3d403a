#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Signals from outside to a run with a page, with devices, with a recording and OpenIGTLink, in any
combination, in real time.

usage: signals_test.py   with STYLET_BIN, STYLET_SOURCE, STYLET_STANDIN_HD and STYLET_STANDIN_DHD in
the environment; STYLET_SEED draws others, as many as STYLET_DRAWS
"""
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest

import h5py

from cli_test import BIN, SCENE, SOURCE, wait_until
from process_test import Disturbed, of_session

sys.path.insert(0, str(SOURCE / "hal/device"))
from example_client import sample_packet  # noqa: E402


class Peer:
    """A program that samples a hand at rest, for `udp:` and `shm:`, until it is told to stop."""

    def __init__(self, uri):
        scheme, self.name = uri.split(":")
        self.send = self.to_port if scheme == "udp" else self.to_memory
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        seq = 0
        while not self.stop.wait(1e-3):
            seq += 1
            self.send(sample_packet(seq, time.monotonic_ns(), (0, 0, 0)))

    def to_port(self, packet):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            link.sendto(packet, ("127.0.0.1", int(self.name)))

    def to_memory(self, packet):
        try:
            with open(f"/dev/shm/stylet.{self.name}", "r+b") as memory:
                memory.write(packet)
        except FileNotFoundError:  # not yet, or no more
            pass

    def end(self):
        self.stop.set()
        self.thread.join()


def start_attempt(port):
    """Presses Start as the console's page does; the server may be gone at any time."""
    # FlatBuffers: the root, the file's name, a Message with its vtable, and an empty Start (7).
    message = struct.pack("<I4s4HiBxxxI2Hi", 16, b"STLC", 8, 12, 4, 8, 8, 7, 8, 4, 4, 4)
    mask = b"mask"
    frame = bytes([0x82, 0x80 | len(message)]) + mask + bytes(
        byte ^ mask[i % 4] for i, byte in enumerate(message))
    try:
        page = socket.create_connection(("127.0.0.1", port), timeout=20)
        page.sendall((f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
                      "Connection: Upgrade\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                      "Sec-WebSocket-Version: 13\r\n\r\n").encode())
        page.recv(1)
        page.sendall(frame)
        return page
    except OSError:
        return None


class SignalsBeside(Disturbed):
    """All processes end, a recording is whole or does not exist, no shared memory is left.

    The signal may come at any time, and a second one after it; SIGPIPE ends nothing.
    """

    ENDING = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT]
    MOST_S = 60  # a machine that is very busy

    def test_at_any_time(self):
        seed = int(os.environ.get("STYLET_SEED", 1))
        shared = set(os.listdir("/dev/shm"))
        for number in range(seed, seed + int(os.environ.get("STYLET_DRAWS", 8))):
            self.random = random.Random(number)
            with self.subTest(number=number):
                self.signal_once(number)
                left = [name for name in os.listdir("/dev/shm")
                        if name.startswith(f"stylet.signal{os.getpid()}") and name not in shared]
                self.assertEqual(left, [])

    def device(self):
        """A device's URI, and the program at its other end."""
        kind = self.random.choice(["hd:", "dhd:0", "udp:", "shm:", "none"])
        if kind == "udp:":
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
                free.bind(("127.0.0.1", 0))
                kind += str(free.getsockname()[1])
        elif kind == "shm:":
            kind += f"signal{os.getpid()}"
        if kind.startswith(("udp:", "shm:")):
            peer = Peer(kind)
            self.addCleanup(peer.end)
        return [] if kind == "none" else ["--device", kind]

    def signal_once(self, number):
        recording = self.top / f"beside{number}.h5"
        arguments = self.device()
        for chance, more in ((0.7, ["--record", recording]), (0.4, ["--igtl=0"])):
            arguments += more if self.random.random() < chance else []
        console = self.random.random() < 0.5
        process = subprocess.Popen(
            [str(part) for part in (BIN / "stylet", "run", SCENE, "--organ", self.organ,
                                    "--allow-non-rt", "--flight", self.top / "beside-fault.h5",
                                    *arguments, *["--console=0"] * console)],
            cwd=self.top, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            start_new_session=True,
            env=dict(os.environ, STYLET_LIBHD=os.environ["STYLET_STANDIN_HD"],
                     STYLET_LIBDHD=os.environ["STYLET_STANDIN_DHD"]))
        self.addCleanup(process.kill)
        page = None
        if self.random.random() < 0.6:  # after it has begun
            said = re.search(r"console at http://127.0.0.1:(\d+)", process.stdout.readline())
            page = start_attempt(int(said[1])) if console and said else None
        time.sleep(self.random.uniform(0, 1.5))
        self.send(process)
        _, error = process.communicate(timeout=self.MOST_S)
        if page:
            page.close()
        what = f"{arguments} console {console}, sent {self.sent}: {error}"
        # Ended by the signal itself, before the program could handle it, or because it came three
        # times.
        self.assertIn(process.returncode, {0, 1, 3, *(-each for each in self.sent)}, what)
        wait_until(lambda: not list(of_session(process.pid)), 10)
        self.assertEqual(list(self.top.glob(f"{recording.stem}*.tmp")), [], what)
        for each in self.top.glob(f"{recording.stem}*.h5"):
            with h5py.File(each, "r") as file:
                self.assertEqual(int(file.attrs["ticks"]), len(file["output/tick"]), what)
                self.assertEqual(int(file.attrs["lost_records"]), 0, what)

    def send(self, process):
        """A signal that ends the program: at once, after one that does not, or twice."""
        before = self.random.choice([signal.SIGPIPE, *self.ENDING])
        self.sent = [before] * self.random.choice([0, 1])
        self.sent.append(self.random.choice(self.ENDING))
        for each in self.sent:
            process.send_signal(each)
            time.sleep(self.random.uniform(0, 0.1))


if __name__ == "__main__":
    unittest.main()
