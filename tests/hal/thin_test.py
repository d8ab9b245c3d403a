#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""stylet_hal is thin: a program with a loop, a guard and a device links only the kernel and
libraries that every Debian has, and nothing of HDF5, Boost, JSON, TOML, OpenSSL, fmt, OpenIGTLink
or zlib.

usage: thin_test.py EXAMPLE LINK_MAP STYLET_HAL ARCHIVE_THAT_NEEDS_MORE ORGAN
"""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import output

EXAMPLE, LINK_MAP, THIN, THICK, ORGAN = sys.argv[1:6]

# The C and C++ libraries, those for threads and loading (separate in older glibc), and the kernel's
# ccd.
SYSTEM = {"libc", "libm", "libstdc++", "libgcc_s", "libpthread", "libdl", "ld-linux-x86-64",
          "ld-linux-aarch64", "libccd"}
ARCHIVES = {"libstylet_hal", "libstylet_kernel", "libstylet_organ", "libc", "libgcc",
            "libc_nonshared", "libpthread_nonshared"}
# It searches names of functions, which also finds header-only libraries.
FOREIGN = re.compile(r"\b(boost|nlohmann|toml|igtl)::|\bH5[A-Z]\w+|\b(EVP|SHA256)_\w+"
                     r"|\b(crc32|inflate|deflate)$", re.M)


def foreign(archive):
    return {match[0] for match in FOREIGN.finditer(output("nm", "-C", archive))}


class Thin(unittest.TestCase):
    def test_needs_what_every_system_has(self):
        needed = re.findall(r"\(NEEDED\).*\[(\S+?)\.so", output("readelf", "-d", EXAMPLE))
        self.assertIn("libc", needed)
        self.assertLessEqual(set(needed), SYSTEM)

    def test_links_the_kernel_and_itself(self):
        archives = set(re.findall(r"(\w+)\.a\(", pathlib.Path(LINK_MAP).read_text()))
        self.assertIn("libstylet_hal", archives)
        self.assertLessEqual(archives, ARCHIVES)

    def test_calls_no_others(self):
        self.assertEqual(foreign(THIN), set())
        self.assertTrue(foreign(THICK))  # the search does find such functions

    def test_pushes_a_needle(self):
        seen = re.fullmatch(r"a hand: 45[01] ticks, at most (\d\.\d{3}) N on the hand, none\n",
                            output(EXAMPLE, ORGAN))
        self.assertIsNotNone(seen)  # 9 mm at 20 mm/s
        self.assertGreater(float(seen[1]), 0)
        self.assertLessEqual(float(seen[1]), 3.3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
