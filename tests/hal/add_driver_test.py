#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A driver is one file and one line: this adds one to a copy of the source, touches nothing else,
and runs the example's loop with a device of the new driver. It also adds the driver for a network
that hal/device/own_driver.md has people copy, by the steps of that page.

usage: add_driver_test.py SOURCE ORGAN
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import run

SOURCE, ORGAN = (pathlib.Path(each) for each in sys.argv[1:3])

DRIVER = """// SPDX-License-Identifier: Apache-2.0
// A stylus that lies on the table: it is where it is, and feels no force.
#include "hal/device/driver.h"

namespace stylet::hal {
namespace {

std::uint64_t samples = 0;

bool read(void*, std::int64_t now_ns, Sample& sample_out) {
  sample_out.seq = ++samples;
  sample_out.t_ns = now_ns;
  sample_out.pose = {{}, {1, 0, 0, 0}};
  return true;
}
void write(void*, const Command&) {}
void close(void*) {}

Device open(const std::string&, double) {
  return {nullptr, {.name = "a stylus at rest", .max_force_n = 0, .max_slew_n_per_s = 0},
          read, write, close};
}
void search(const HostTree&, DeviceSighting& out) {
  out.presence = Presence::kReady;
  out.seen = "on the table";
}

}  // namespace

constinit const DriverDescriptor still_driver = {
    .scheme = "still", .uri = "still:", .name = "a stylus at rest", .open = open,
    .search = search, .renders = false,
    .row = {"`still:`", "a stylus at rest", "6 / 0", "a table"}};

}  // namespace stylet::hal
"""


class AddDriver(unittest.TestCase):
    def test_one_file_and_one_line(self):
        with tempfile.TemporaryDirectory(prefix="stylet-driver-") as folder:
            copy = pathlib.Path(folder) / "source"
            for name in "kernel", "hal", "toolchain":
                shutil.copytree(SOURCE / name, copy / name,
                                ignore=shutil.ignore_patterns("node_modules", "__pycache__"))
            shutil.copy(SOURCE / "CMakeLists.txt", copy)
            (copy / "hal/device/drivers/still.cpp").write_text(DRIVER)
            for suffix in "cpp", "h":
                text = (copy / f"hal/device/example_driver.{suffix}").read_text()
                (copy / f"hal/device/drivers/plumb.{suffix}").write_text(
                    text.replace("hal/device/example_driver.h", "hal/device/drivers/plumb.h"))
            with (copy / "hal/device/drivers.inc").open("a") as drivers:
                drivers.write("STYLET_DRIVER(still, still_driver)\n"
                              "STYLET_LINUX_DRIVER(plumb, plumb_driver)\n")
            build = copy / "build"
            run("cmake", "-S", copy, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                "-DSTYLET_WITH_OFFLINE=OFF", "-DSTYLET_WITH_TESTS=OFF",
                "-DSTYLET_WITH_INSTALL=OFF")
            run("cmake", "--build", build, "--target", "stylet_example_loop", "--parallel", 2)
            program = next(build.rglob("stylet_example_loop"))
            self.assertRegex(run(program, ORGAN, "still:"),
                             r"^a stylus at rest: 45[01] ticks, .* none$")
            self.assertEqual(subprocess.run([program, ORGAN, "moving:"]).returncode, 1)
            refused = subprocess.run([program, ORGAN, "plumb:here"], capture_output=True, text=True)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("plumb:here: expected ADDRESS:PORT", refused.stdout + refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
