#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a hand gets from the example client, whatever Stylet, network and the client's own program
do: random sessions in virtual time, judged by rules that know nothing of its code.

usage: example_client_test.py CLIENT [SESSIONS]
"""
import importlib.util
import math
import random
import struct
import sys
import unittest
import zlib

MS = 1_000_000
FORCE = struct.Struct("<4sHHQQqq3f3f3f9fffI")  # the table of packets.md, written again
client = None
sessions = 150


def load(path):
    spec = importlib.util.spec_from_file_location("example_client", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def force_packet(seq, echo_ns, life_ns, force, at, stiffness, arming, most=30.0):
    body = FORCE.pack(b"STYF", 3, 128, seq, 1, echo_ns, life_ns, *force, 0, 0, 0, *at,
                      stiffness, 0, 0, 0, stiffness, 0, 0, 0, stiffness, 0.02, most, arming)
    return body + struct.pack("<I", zlib.crc32(body))


class Stalls:
    """Stalls of 0.5 to 300 ms, now and then or periodically."""

    def __init__(self, draw):
        self.longest = 0 if draw.random() < 0.3 else 0.5 * MS * 600 ** draw.random()
        self.every = self.longest + draw.uniform(0.5, 40) * MS if draw.random() < 0.3 else 0
        self.share = 0 if self.every else draw.uniform(0.0005, 0.02)
        self.until = self.next = 0

    def busy(self, draw, now):
        if now < self.until:
            return True
        due = self.every and now >= self.next
        if not self.longest or not (due or draw.random() < self.share):
            return False
        self.next, self.until = now + self.every, now + self.longest * (1 if due else draw.random())
        return self.until > now


class Session:
    """Stylet asks for any force, over a network that loses, delays and reorders packets."""

    def __init__(self, seed):
        self.draw = draw = random.Random(seed)
        self.stylet, self.wire, self.own = Stalls(draw), Stalls(draw), Stalls(draw)
        self.motor, self.coming = client.Motor(), []
        self.now, self.written = draw.randrange(1, 2**40), 0  # 0: never yet
        self.force, self.x, self.seq, self.arming = (0, 0, 0), [0.0, 0.0, 0.0], 0, 2**32 - 3
        self.ended, self.felt, self.seen = None, 0, []
        self.loss, self.jitter = draw.choice((0, 0.1)), draw.choice((0, 3, 12)) * MS
        self.trouble = draw.choice((0, 0.01))

    def speak(self):
        draw = self.draw
        if self.stylet.busy(draw, self.now):
            return
        self.seq += 1
        if draw.random() < 0.005:  # somebody acknowledged
            self.arming = (self.arming + 1) % 2**32
        force = [draw.choice((-9.0, 0.1, 2.9)), draw.uniform(-1, 1), 2.0]
        life, most, echo = 20 * MS, 30.0, self.now - draw.randrange(0, 2 * MS)
        if draw.random() < self.trouble:
            force[draw.randrange(3)] = draw.choice((math.nan, math.inf, -1e38))
            life = draw.choice((20 * MS, 10**17, -1, 0, 2**63 - 1))
            most = draw.choice((30.0, math.nan, -1.0, math.inf))
            echo = draw.choice((echo, self.now + 10**12, -(2**63)))
        at = [c + draw.uniform(-1e-3, 1e-3) for c in self.x]
        packet = force_packet(self.seq, echo, life, force, at, draw.choice((0, 1400.0)),
                              self.arming, most)
        if draw.random() < self.loss:
            return
        due = self.now + draw.randrange(0, self.jitter + 1)
        if self.wire.busy(draw, self.now):
            due = max(due, self.wire.until)
        self.coming.append((due, packet))

    def hear(self):
        """Which forces are valid, by packets.md alone."""
        due, self.coming = ([p for t, p in self.coming if t <= self.now],
                            [(t, p) for t, p in self.coming if t > self.now])
        for packet in due:
            fields = FORCE.unpack(packet[:-4])
            self.motor.take(client.read_force(packet), self.now)
            self.seen.append((fields[5], fields[6], fields[27]))

    def judge(self, force):
        passed_ms = (self.now - self.written) / MS if self.written else 0
        size = math.dist(force, (0, 0, 0))
        assert math.isfinite(size), "not finite"
        assert size <= client.LIMITS[0] * (1 + 1e-9), f"{size} N"
        cut = size == 0 and passed_ms > 10
        change = math.dist(force, self.force)
        assert cut or change <= client.SLEW * passed_ms * 1e-3 * (1 + 1e-9), f"a step of {change} N"
        # Whether any force may be felt: one has come that answers a sample of the last 20 ms.
        alive = {arming for echo, life, arming in self.seen
                 if 0 < life <= 20 * MS and echo <= self.now < echo + life}
        assert size == 0 or alive, "force without one that lives"
        self.felt = max(self.felt, size)
        self.seen = [s for s in self.seen if 0 <= self.now - s[0] < 20 * MS]
        if passed_ms > 10 or not alive:
            # Forces are over for the arming that was obeyed and all before it.
            self.ended = self.motor.arming if self.motor.model else None
        if self.ended is not None and size > 0:
            newer = {a for a in alive if 0 < (a - self.ended) % 2**32 < 2**31}
            assert newer, "force came back before somebody acknowledged"
        self.force, self.written = list(force), self.now

    def run(self, milliseconds):
        for _ in range(milliseconds):
            self.now += MS
            self.x[0] += self.draw.uniform(-2e-3, 2e-3)  # 2 m/s
            self.speak()
            if self.own.busy(self.draw, self.now):
                continue
            self.hear()
            self.judge(self.motor.step(self.now, self.x))


class ExampleClient(unittest.TestCase):
    def test_hand_gets_no_force_that_the_rules_forbid(self):
        felt = came_back = 0
        for seed in range(sessions):
            session = Session(seed)
            try:
                session.run(1000)
            except AssertionError as error:
                raise AssertionError(f"seed {seed}: {error}") from None
            felt += session.felt > 1
            came_back += session.ended is not None and any(session.force)
        self.assertGreater(felt, sessions // 2, "there was a force to judge")
        self.assertGreater(came_back, sessions // 20, "and one that was acknowledged")

    def test_force_of_a_model_that_ends_falls_and_does_not_return_by_itself(self):
        motor, forces = client.Motor(), []
        for ms in range(1, 101):
            now = 10**9 + ms * MS
            if ms <= 30 or ms >= 60:
                arming = 5 if ms < 80 else 6
                motor.take(client.read_force(
                    force_packet(ms, now, 20 * MS, (0, 0, 2.0), (0, 0, 0), 0, arming)), now)
            forces.append(motor.step(now, (0, 0, 0))[2])
        self.assertEqual(forces[29:40], [2.0] * 11)  # alive and young
        for ms in range(41, 50):
            self.assertAlmostEqual(forces[ms - 1], 2.0 * (50 - ms) / 10)
        self.assertEqual(forces[49:79], [0.0] * 30)
        for force, expected in zip(forces[79:82], (1, 2, 2)):
            self.assertAlmostEqual(force, expected)

    def test_sample_tells_what_the_hand_has(self):
        motor = client.Motor()
        now = 10**9
        motor.take(client.read_force(
            force_packet(9, now, 20 * MS, (0, 0.5, 0), (0, 0, 0), 0, 77)), now)
        for ms in range(3):
            motor.step(now + ms * MS, (0, 0, 0))
        body = client.sample_packet(1, now, (0, 0, 0), motor=motor)
        self.assertEqual(struct.unpack_from("<Q", body, 32)[0], 9)
        self.assertEqual(struct.unpack_from("<II3f", body, 84), (77, 0, 0.0, 0.5, 0.0))
        motor.step(now + 200 * MS, (0, 0, 0))
        body = client.sample_packet(2, now, (0, 0, 0), motor=motor)
        self.assertEqual(struct.unpack_from("<II3f", body, 84), (77, 1, 0.0, 0.0, 0.0))


if __name__ == "__main__":
    client = load(sys.argv[1])
    sessions = int(sys.argv[2]) if len(sys.argv) > 2 else sessions
    unittest.main(argv=sys.argv[:1])
