#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A target with 32-bit addresses predicts the same bytes as the host, or says that a block is too
large for it, in exactly those cases in which one is.

usage: sizes_test.py REPOSITORY BUILD_FOLDER
"""
import sys

sys.dont_write_bytecode = True
import target  # noqa: E402

TOO_LARGE = 108  # Status::kOrganTooLarge
MOST_BYTES = 2 ** 31 - 1


def expected(line):
    name, status, *blocks = line.split()
    if status != "hash" and max(map(int, blocks)) > MOST_BYTES:
        return f"{name} {TOO_LARGE} 0 0 0"
    return line


def main():
    repository, tests_build, _ = target.arguments()
    target.skip_without("i686")
    target.build(repository, tests_build, "i686")
    here = target.call([tests_build.parents[1] / "bin/stylet_sizes"]).splitlines()
    there = target.run("i686", tests_build / "i686/bin/sizes")
    wanted = [expected(line) for line in here]
    if wanted == here:
        sys.exit("no lattice was too large for 32 bits")
    if wanted != there:
        sys.exit("\n".join(["expected"] + wanted + ["found"] + there))


main()
