#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A device of your own: pushes the needle in, feels it, pulls it out. README.md has the packets.

stylet run SCENE.toml --device udp:7755 &  example_client.py 127.0.0.1 7755 [SECONDS]
"""
import os
import socket
import struct
import sys
import time
import zlib

SAMPLE = struct.Struct("<4sHHIIQqQ3f4f4f")    # and a CRC-32
FORCE = struct.Struct("<4sHHQQqq3f3f3f9fff")  # and a CRC-32
LIMITS = (3.0, 0.0, 0.0, 0.0)  # most N, N/m (0: not known), continuous N, N m: of your device
SESSION = int.from_bytes(os.urandom(4), "little")


def sample_packet(seq, now_ns, position, rotation=(1, 0, 0, 0), buttons=0, echo=0):
    body = SAMPLE.pack(b"STYS", 2, SAMPLE.size + 4, SESSION, buttons, seq, now_ns, echo,
                       *position, *rotation, *LIMITS)
    return body + struct.pack("<I", zlib.crc32(body))


def read_force(packet):
    """The fields of a force packet, or None."""
    if len(packet) != FORCE.size + 4 or packet[:8] != struct.pack("<4sHH", b"STYF", 2, len(packet)):
        return None
    good = zlib.crc32(packet[:-4]) == struct.unpack("<I", packet[-4:])[0]
    return FORCE.unpack(packet[:-4]) if good else None


def force_now(model, now_ns, x):
    """The newest model where the hand is now; nothing once its life is over."""
    since_ns, life_ns, force, at, k = model[5], model[6], model[7:10], model[13:16], model[16:25]
    radius, most = model[25:]
    away = [x[i] - at[i] for i in range(3)]
    if not 0 <= now_ns - since_ns < life_ns or (radius and sum(a * a for a in away) > radius ** 2):
        return [0.0, 0.0, 0.0]
    f = [force[i] - sum(k[3 * i + j] * away[j] for j in range(3)) for i in range(3)]
    size = sum(c * c for c in f) ** 0.5
    return f if size <= most else [c * most / size for c in f]


def main(address, port, seconds=8.0):
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.setblocking(False)
    model = (0,) * 27
    start = time.monotonic_ns()
    for seq in range(1, int(seconds * 1000) + 1):
        t = seq * 1e-3
        hand = (0.0, 0.0, -0.04 * max(0.0, min(t - 1, seconds / 2 - 1, seconds - 1 - t)))  # m
        link.sendto(sample_packet(seq, time.monotonic_ns(), hand, echo=model[3]), (address, port))
        try:
            while heard := link.recv(256):
                heard = read_force(heard)
                model = heard if heard and heard[3] > model[3] else model
        except (BlockingIOError, ConnectionRefusedError):
            pass
        force = force_now(model, time.monotonic_ns(), hand)  # N, for the motors of your device
        if seq % 200 == 0:
            print(f"{t:5.2f} s {-1e3 * hand[2]:6.1f} mm {force[2]:+6.2f} N on the hand", flush=True)
        time.sleep(max(0.0, (start + seq * 1_000_000 - time.monotonic_ns()) * 1e-9))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), *map(float, sys.argv[3:]))
