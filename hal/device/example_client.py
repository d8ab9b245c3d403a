#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A device of your own: pushes the needle in, feels it, pulls it out. packets.md has the layout.

stylet run SCENE.toml --device udp:7755 &  example_client.py 127.0.0.1 7755 [SECONDS]
"""
import math
import os
import socket
import struct
import sys
import time
import zlib

SAMPLE = struct.Struct("<4sHHIIQqQ3f4f4fII3f")  # and a CRC-32
FORCE = struct.Struct("<4sHHQQqq3f3f3f9fffI")   # and a CRC-32
VERSION = 3
LIMITS = (3.0, 0.0, 0.0, 0.0)  # most N, N/m (0: not known), continuous N, N m: of your device
SLEW = 1000.0                  # N/s, most change of the force; from LIMITS[0] to nothing in 10 ms
LIFE_NS = 20_000_000           # no force lives longer
HELD_UP_NS = 10_000_000        # whoever was away for so long has cut the force, or should have
STEP_NS = 2_000_000            # and does not make up for it in one step
SESSION = int.from_bytes(os.urandom(4), "little")


def sample_packet(seq, now_ns, position, rotation=(1, 0, 0, 0), buttons=0, motor=None):
    motor = motor or Motor()
    body = SAMPLE.pack(b"STYS", VERSION, SAMPLE.size + 4, SESSION, buttons, seq, now_ns, motor.seq,
                       *position, *rotation, *LIMITS, motor.arming, motor.stopped, *motor.force)
    return body + struct.pack("<I", zlib.crc32(body))


def read_force(packet):
    """The fields of a force packet, or None."""
    head = struct.pack("<4sHH", b"STYF", VERSION, len(packet))
    if len(packet) != FORCE.size + 4 or packet[:8] != head:
        return None
    good = zlib.crc32(packet[:-4]) == struct.unpack("<I", packet[-4:])[0]
    return FORCE.unpack(packet[:-4]) if good else None


def size(vector):
    return math.sqrt(sum(c * c for c in vector))


def shortened(vector, most):
    return vector if size(vector) <= most else [c * most / size(vector) for c in vector]


class Motor:
    """What the hand gets, whatever comes and whenever: within LIMITS, changed by SLEW, and gone
    with the life of the newest force. Then it waits for a newer arming: somebody acknowledged."""

    def __init__(self):
        self.seq = self.arming = self.since_ns = self.life_ns = self.time_ns = 0
        self.model, self.force, self.stopped = None, [0.0, 0.0, 0.0], False

    def take(self, packet, now_ns):
        seq, since_ns, life_ns, arming = packet[3], packet[5], packet[6], packet[27]
        older = self.model and (seq <= self.seq or (arming - self.arming) % 2**32 >= 2**31)
        if older or not 0 <= now_ns - since_ns < life_ns <= LIFE_NS:
            return
        self.look(now_ns)
        self.stopped = self.stopped and arming == self.arming
        self.seq, self.arming, self.since_ns, self.life_ns = seq, arming, since_ns, life_ns
        self.model = packet[7:27]

    def look(self, now_ns):
        self.stopped |= bool(self.model) and now_ns - self.since_ns >= self.life_ns

    def goal(self, now_ns, x):
        """The newest force where the hand is now; it falls in the second half of its life."""
        if not self.model or self.stopped:
            return [0.0, 0.0, 0.0]
        force, at, k, (radius, most) = (self.model[0:3], self.model[6:9], self.model[9:18],
                                        self.model[18:20])
        away = [x[i] - at[i] for i in range(3)]
        f = [force[i] - sum(k[3 * i + j] * away[j] for j in range(3)) for i in range(3)]
        if not math.isfinite(size(f)) or not most > 0 or (radius and not size(away) <= radius):
            return [0.0, 0.0, 0.0]
        left = 2 * (self.since_ns + self.life_ns - now_ns) / self.life_ns
        return [c * min(1.0, left) for c in shortened(f, min(most, LIMITS[0]))]

    def step(self, now_ns, x):
        """The force for the motors of your device, N: about once a millisecond."""
        self.look(now_ns)
        passed_ns = max(0, now_ns - self.time_ns) if self.time_ns else 0
        self.time_ns = now_ns
        if passed_ns > HELD_UP_NS:
            self.stopped, self.force = self.model is not None, [0.0, 0.0, 0.0]
        goal = self.goal(now_ns, x)
        change = [goal[i] - self.force[i] for i in range(3)]
        rises = size(goal) > size(self.force)
        change = shortened(change, SLEW * 1e-9 * (min(passed_ns, STEP_NS) if rises else passed_ns))
        self.force = [self.force[i] + change[i] for i in range(3)]
        return self.force


def main(address, port, seconds=8.0):
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.setblocking(False)
    motor = Motor()
    start = time.monotonic_ns()
    for seq in range(1, int(seconds * 1000) + 1):
        t = seq * 1e-3
        hand = (0.0, 0.0, -0.04 * max(0.0, min(t - 1, seconds / 2 - 1, seconds - 1 - t)))  # m
        link.sendto(sample_packet(seq, time.monotonic_ns(), hand, motor=motor), (address, port))
        try:
            while heard := link.recv(256):
                if packet := read_force(heard):
                    motor.take(packet, time.monotonic_ns())
        except (BlockingIOError, ConnectionRefusedError):
            pass
        force = motor.step(time.monotonic_ns(), hand)  # N, for the motors of your device
        if seq % 200 == 0:
            print(f"{t:5.2f} s {-1e3 * hand[2]:6.1f} mm {force[2]:+6.2f} N on the hand", flush=True)
        time.sleep(max(0.0, (start + seq * 1_000_000 - time.monotonic_ns()) * 1e-9))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), *map(float, sys.argv[3:]))
