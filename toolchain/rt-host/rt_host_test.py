#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tests rt-host.sh on the files of another machine: without --apply it changes nothing, a second
--apply changes nothing more, --undo restores every byte."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SYSCTL = "etc/sysctl.d/70-stylet-rt.conf"
IRQBALANCE = "etc/systemd/system/irqbalance.service"
BOOT_LINE = "etc/default/grub.d/70-stylet-rt.cfg"


def picture(top):
    """Kind, mode and content of every file, folder and link below `top`."""
    all_of_it = {}
    for path in sorted(top.rglob("*")):
        name, mode = path.relative_to(top).as_posix(), path.lstat().st_mode
        if path.is_symlink():
            all_of_it[name] = ("link", os.readlink(path))
        elif path.is_dir():
            all_of_it[name] = ("folder", mode)
        else:
            all_of_it[name] = ("file", mode, path.read_bytes())
    return all_of_it


class RtHost(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.write("sys/devices/system/cpu/online", "0-3\n")
        self.write("sys/devices/system/cpu/cpu3/topology/thread_siblings_list", "3\n")
        self.write("etc/fstab", "none\n")

    def write(self, name, text, mode=0o644):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(mode)

    def run_script(self, *arguments, expect=0):
        done = subprocess.run([HERE / "rt-host.sh", "--root", self.top, *arguments],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done

    def test_without_apply_nothing_changes(self):
        before = picture(self.top)
        said = self.run_script().stdout
        self.assertEqual(picture(self.top), before)
        self.assertIn("add    /" + BOOT_LINE, said)
        self.assertIn("Nothing was changed", said)

    def test_twice_is_once(self):
        self.run_script("--apply")
        once = picture(self.top)
        said = self.run_script("--apply").stdout
        self.assertEqual(picture(self.top), once)
        self.assertNotIn("add ", said)
        self.assertNotIn("change ", said)

    def test_undo_restores_every_byte(self):
        self.write(SYSCTL, "vm.swappiness = 1\n", 0o600)
        self.write(IRQBALANCE, "[Unit]\n")
        before = picture(self.top)
        self.assertIn("change /" + SYSCTL, self.run_script("--apply").stdout)
        self.assertNotEqual(picture(self.top), before)
        self.assertEqual(os.readlink(self.top / IRQBALANCE), "/dev/null")
        self.run_script("--apply")
        self.run_script("--apply", "--cpu", "1-2")
        self.run_script("--undo")
        self.assertEqual(picture(self.top), before)

    def test_what_was_changed_since_stays(self):
        self.write(SYSCTL, "vm.swappiness = 1\n")
        self.run_script("--apply")
        self.write(SYSCTL, "mine\n")
        self.assertIn("changed since: /" + SYSCTL, self.run_script("--undo").stdout)
        self.assertEqual((self.top / SYSCTL).read_text(), "mine\n")
        self.assertEqual((self.top / (SYSCTL + ".before-stylet")).read_text(),
                         "vm.swappiness = 1\n")

    def boot_line(self):
        shell = f"GRUB_CMDLINE_LINUX_DEFAULT=quiet; . {self.top / BOOT_LINE}; " \
                "echo $GRUB_CMDLINE_LINUX_DEFAULT"
        return subprocess.run(["sh", "-c", shell], capture_output=True, text=True).stdout.split()

    def test_boot_line_keeps_what_was_there(self):
        self.run_script("--apply")
        for word in "quiet", "isolcpus=managed_irq,domain,3", "rcu_nocbs=3", "irqaffinity=0,1,2":
            self.assertIn(word, self.boot_line())

    def test_a_core_is_taken_with_both_halves(self):
        self.write("sys/devices/system/cpu/cpu3/topology/thread_siblings_list", "1,3\n")
        self.run_script("--apply")
        self.assertIn("rcu_nocbs=1,3", self.boot_line())
        self.assertIn("irqaffinity=0,2", self.boot_line())

    def test_the_processors_can_be_named(self):
        self.run_script("--apply", "--cpu", "0-1,3")
        self.assertIn("rcu_nocbs=0,1,3", self.boot_line())
        unit = (self.top / "etc/systemd/system/stylet-rt.service").read_text()
        self.assertIn("ExecStart=/usr/local/lib/stylet/rt-tune 2\n", unit)
        self.assertTrue(os.access(self.top / "usr/local/lib/stylet/rt-tune", os.X_OK))

    def test_nothing_is_left_to_fill_in(self):
        self.run_script("--apply")
        for name, seen in picture(self.top).items():
            if seen[0] == "file":
                self.assertNotRegex(seen[2].decode(), "@[A-Z]+@", name)
            self.assertNotIn(".stylet-new", name)

    def test_refusals_change_nothing(self):
        before = picture(self.top)
        for arguments, reason in (
                (["--cpu", "4"], "processor 4 is not there"),
                (["--cpu", "x"], "expected a list of processors"),
                (["--cpu", "0-3"], "no processor is left"),
                (["--aply"], "--aply: expected"),
                (["--undo"], "nothing to undo")):
            with self.subTest(arguments):
                self.assertIn(reason, self.run_script("--apply", *arguments, expect=1).stderr)
                self.assertEqual(picture(self.top), before)

    def test_the_only_processor_is_not_taken(self):
        self.write("sys/devices/system/cpu/online", "0\n")
        self.assertIn("no processor is left", self.run_script("--apply", expect=1).stderr)


# A chroot with this machine's files, under a layer that receives every change. The programs that
# would change a running machine are stand-ins that record how they were called.
LAYER = """
set -e
mount -t tmpfs none "$1"
mkdir "$1/upper" "$1/work" "$1/top"
mount -t overlay none -o "lowerdir=/,upperdir=$1/upper,workdir=$1/work" "$1/top"
"""
CHROOT = LAYER + """
mkdir -p "$1/top/dev" "$1/top/sys/devices/system/cpu" "$1/top/programs"
cp -r "$2" "$1/top/toolchain"
[ -e "$1/top/dev/null" ] || mknod -m 666 "$1/top/dev/null" c 1 3
echo 0-1 > "$1/top/sys/devices/system/cpu/online"
for name in apt-get update-grub systemd-sysusers udevadm systemctl sysctl; do
  printf '#!/bin/sh\\necho "$(basename "$0") $*" >> /calls\\n' > "$1/top/programs/$name"
  chmod +x "$1/top/programs/$name"
done
inside() {
  PATH="/programs:$PATH" chroot "$1/top" /toolchain/rt-host/rt-host.sh "$2" > /dev/null
}
picture() {
  (cd "$1/top" && find usr/local/lib var/lib -maxdepth 2 -printf '%p %y %m\\n' | LC_ALL=C sort
    find etc -printf '%p %y %m %l\\n' | LC_ALL=C sort
    find etc -type f -exec sha256sum {} + | LC_ALL=C sort)
}
picture "$1" > "$1/before"
inside "$1" --apply
cat "$1/top/calls"
picture "$1" > "$1/after"
if cmp -s "$1/before" "$1/after"; then echo "apply did nothing"; fi
: > "$1/top/calls"
inside "$1" --undo
sed 's/^/undo: /' "$1/top/calls"
picture "$1" > "$1/undone"
diff "$1/before" "$1/undone" && echo "as before"
"""


class Chroot(unittest.TestCase):
    def test_programs_are_run_and_undo_restores(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, for a chroot")
        def unshared(script, folder):
            return subprocess.run(["unshare", "-m", "bash", "-c", script, "bash", folder,
                                   HERE.parent], capture_output=True, text=True)

        with tempfile.TemporaryDirectory() as folder:
            if unshared(LAYER, folder).returncode != 0:
                self.skipTest("needs the right to mount an overlay in a namespace of its own")
            done = unshared(CHROOT, folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        refresh = ["systemd-sysusers ", "udevadm control --reload", "udevadm trigger",
                   "systemctl daemon-reload", "update-grub ", "sysctl --system"]
        install = "apt-get install -y --no-install-recommends linux-image-rt-amd64"
        self.assertEqual(done.stdout.splitlines(),
                         [install] + refresh + [f"undo: {call}" for call in refresh] +
                         ["as before"])


class Tree(unittest.TestCase):
    def test_mask_of_processors(self):
        text = (HERE / "tree/usr/local/lib/stylet/rt-tune").read_text()
        mask = re.search(r"^mask\(\) \{\n.*?^\}\n", text, re.S | re.M)[0]
        for cpus, expected in ("0", "1"), ("0-1,4", "13"), ("0-31", "ffffffff"), \
                ("0,32", "1,00000001"):
            done = subprocess.run(["sh", "-c", f"{mask} mask {cpus}"], capture_output=True,
                                  text=True)
            self.assertEqual(done.stdout, expected + "\n", cpus)


if __name__ == "__main__":
    sys.exit(unittest.main())
