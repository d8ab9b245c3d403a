#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests debian_source.sh on a machine without a network: apt-get and dpkg-query are stand-ins, the
package is made here, and lies in the folder of kept sources, whole or damaged."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

FETCH = pathlib.Path(__file__).resolve().parent.parent / "debian_source.sh"
OFFLINE = "#!/bin/sh\necho 'E: Temporary failure resolving mirror.invalid' >&2\nexit 100\n"
VERSION = "#!/bin/sh\necho 1:1.0\n"  # with an epoch, which names of files do not have
CONTROL = """Source: gel
Maintainer: Nobody <nobody@stylet.invalid>
Standards-Version: 4.6.2

Package: gel
Architecture: all
Description: soft
"""
CHANGES = """gel (1:1.0) unstable; urgency=low

  * First.

 -- Nobody <nobody@stylet.invalid>  Tue, 14 Nov 2023 00:00:00 +0000
"""


@unittest.skipIf(shutil.which("dpkg-source") is None, "no dpkg-source here: no Debian")
class DebianSource(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.kept, self.out = self.top / "kept", self.top / "a/gel"
        (self.top / "bin").mkdir()
        for name, text in (("apt-get", OFFLINE), ("dpkg-query", VERSION)):
            (self.top / "bin" / name).write_text(text)
            (self.top / "bin" / name).chmod(0o755)
        self.kept.mkdir()
        source = self.kept / "gel-1.0"
        (source / "debian/source").mkdir(parents=True)
        for name, text in (("debian/control", CONTROL), ("debian/changelog", CHANGES),
                           ("debian/source/format", "3.0 (native)\n"), ("soft.c", "int soft;\n")):
            (source / name).write_text(text)
        subprocess.run(["dpkg-source", "--build", source], cwd=self.kept, check=True,
                       capture_output=True)
        shutil.rmtree(source)

    def fetch(self):
        done = subprocess.run([FETCH, "gel", self.out], capture_output=True, text=True,
                              env={**os.environ, "STYLET_DEBIAN_SOURCES": str(self.kept),
                                   "PATH": f"{self.top / 'bin'}:{os.environ['PATH']}"})
        return done.returncode, done.stderr

    def test_what_is_kept_needs_no_network(self):
        self.assertEqual(self.fetch(), (0, ""))
        self.assertEqual((self.out / "soft.c").read_text(), "int soft;\n")
        self.assertEqual(sorted(path.name for path in self.out.parent.iterdir()), ["gel"])
        self.assertIn("is there already", self.fetch()[1])

    def test_what_is_missing_or_damaged_is_told(self):
        archive, = self.kept.glob("*.tar.*")
        description, = self.kept.glob("*.dsc")
        for spoil in (lambda: archive.write_bytes(archive.read_bytes()[:-7]), description.unlink):
            spoil()
            code, said = self.fetch()
            self.assertEqual(code, 1)
            self.assertIn("Temporary failure resolving", said)
            self.assertIn("the source of gel could not be fetched", said)
            self.assertIn("apt-get source --download-only gel=1:1.0", said)
            self.assertFalse(self.out.exists())

    def test_another_version_is_not_taken(self):
        (self.top / "bin/dpkg-query").write_text(VERSION.replace("1:1.0", "1:1.0.1"))
        self.assertEqual(self.fetch()[0], 1)


if __name__ == "__main__":
    unittest.main()
