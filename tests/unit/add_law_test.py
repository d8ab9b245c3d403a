#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A parameter of a material and the law of friction that uses it are three lines and the law: they
are added to a copy of the source in this way. Kernel and offline compile, old files and tables of
tissues have 0 for it, the key is known, and the shaft's friction follows it. So is a second law
that a tissue chooses instead of the first: tissues that do not choose it keep their bits, and a
shaft in both has each law on its part of the length.

usage: add_law_test.py SOURCE COMPILER FLATC ORGAN_SOURCE...

The last are the sources of stylet_organ as the build has them, from SOURCE/kernel.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from command import run

SOURCE = pathlib.Path(sys.argv[1])
COMPILER, FLATC, *ORGAN = sys.argv[2:]

# Where a number is added: file, the line with which its list begins, how a line of the list ends
# if another follows.
MATERIAL = ("kernel/include/stylet/material.h", "#define STYLET_MATERIAL_NUMBERS(F)", " \\")
SCHEMA = ("kernel/schema/organ.fbs", "table Material {", "")
FRICTION = ("kernel/src/laws/friction.h", "#define STYLET_FRICTION_NUMBERS(F)", " \\")
LAW = "friction_n_per_m(const Friction& f, float speed_m_per_s)"
LEAST = "least_friction_n_per_m(const Friction& f)"

NEW_NUMBERS = [
    (MATERIAL, 'F(wet_friction_n_per_m, 0, 10, "0 to 10", "wet_friction_n_per_mm", 1e3, false)'),
    (SCHEMA, "wet_friction_n_per_m:float32;"),
    (FRICTION, "F(wet_n_per_m, true, m.wet_friction_n_per_m)"),
]
# What is written before or in place of a text of laws/friction.h. The law that is there is called
# by the new one, whatever it is.
NEW_LAW = [
    (f"inline float {LAW} {{",
     f"inline float dry_{LAW};\ninline float {LAW} {{\n"
     "  return f.wet_n_per_m * speed_m_per_s / (speed_m_per_s + 1) +\n"
     f"         dry_friction_n_per_m(f, speed_m_per_s);\n}}\ninline float dry_{LAW} {{"),
]

# As in kernel/own_law.md: a number of the tissue says which part of its friction follows the second
# law, and each law has its own amplitudes.
STAYS = "(1 - m.rising_friction) * "
SECOND_NUMBERS = [
    (MATERIAL, 'F(rising_friction, 0, 1, "0 to 1", "rising_friction", 1, false)'),
    (SCHEMA, "rising_friction:float32;"),
    (FRICTION, "F(rising_n_per_m, true, m.rising_friction * m.coulomb_friction_n_per_m)"),
]
SECOND_LAW = [
    ("F(coulomb_n_per_m, true, ", "F(coulomb_n_per_m, true, " + STAYS),
    ("F(static_n_per_m, true, ", "F(static_n_per_m, true, " + STAYS),
    ("F(viscous_n_s_per_m2, true, ", "F(viscous_n_s_per_m2, true, " + STAYS),
    (f"inline float {LAW} {{",
     f"inline float first_{LAW};\ninline float {LAW} {{\n"
     "  const float s = speed_m_per_s * f.inverse_stribeck_s_per_m;\n"
     "  return first_friction_n_per_m(f, speed_m_per_s) + f.rising_n_per_m * (1 + s / (1 + s));\n"
     f"}}\ninline float first_{LAW} {{"),
    (f"inline float {LEAST} {{",
     f"inline float first_{LEAST};\ninline float {LEAST} {{\n"
     f"  return first_least_friction_n_per_m(f) + f.rising_n_per_m;\n}}\n"
     f"inline float first_{LEAST} {{"),
]

KERNEL = ["kernel.cpp", "state/snapshot.cpp", "state/layout.cpp", "coupling/friction.cpp"]

PROGRAM = """#include <cstdio>
#include "asset/materials.h"
#include "laws/friction.h"
#include "stylet/organ.h"
#include "tiny_organ.h"

int main(int, char** arguments) {
  using namespace stylet;
  const std::vector<std::byte> bytes = test::tiny_organ({});
  Organ organ;
  if (organ_open(bytes, organ) != Status::kOk) return 1;
  Material material = organ_material(organ, 0);
  std::printf("%g", double(material.wet_friction_n_per_m));
  material.wet_friction_n_per_m = 4;
  const Friction dry = friction_of(organ_material(organ, 0)), wet = friction_of(material);
  std::printf(" %g %g", double(friction_n_per_m(wet, 1)) - double(friction_n_per_m(dry, 1)),
              double(mixed({}, wet, 0.5F).wet_n_per_m));
  material.coulomb_friction_n_per_m = 5;
  std::printf(" %g", double(friction_with_coulomb(material, 15).wet_n_per_m));
  for (const offline::Tissue& tissue : offline::read_tissues(arguments[1])) {
    std::printf(" %g", tissue.wet_friction_n_per_m);
  }
}
"""

# Prints friction of random tissues; with 0 of the second law it must be the same from both sources.
SAME = """#include <cstdio>
#include <random>
#include "laws/friction.h"

int main() {
  using namespace stylet;
  std::mt19937 engine(3);
  const auto upto = [&](float most) { return most * float(engine()) * 0x1p-32F; };
  Friction mean{};
  for (int i = 0; i < 1000; ++i) {
    Material m{};
    m.coulomb_friction_n_per_m = upto(50);
    m.static_friction_n_per_m = m.coulomb_friction_n_per_m + upto(50);
    m.stribeck_velocity_m_per_s = 1e-6F + upto(0.1F);
    m.viscous_friction_n_s_per_m2 = upto(100);
    mean = mixed(mean, friction_of(m), i == 0 ? 1 : upto(1));
    const float speed = upto(0.2F);
    std::printf("%a %a %a\\n", double(friction_n_per_m(friction_of(m), speed)),
                double(friction_n_per_m(mean, speed)), double(least_friction_n_per_m(mean)));
  }
}
"""

# Friction at 0.3 times the Stribeck speed: of a tissue with each law, of a shaft with a quarter of
# its length in the tissue with the second law, and of that tissue with three times the friction.
BOTH = """#include <cstdio>
#include "laws/friction.h"

int main() {
  using namespace stylet;
  Material m{};
  m.coulomb_friction_n_per_m = 10;
  m.static_friction_n_per_m = 15;
  m.stribeck_velocity_m_per_s = 0.01F;
  m.viscous_friction_n_s_per_m2 = 100;
  const Friction first = friction_of(m);
  m.rising_friction = 1;
  const Friction second = friction_of(m), thrice = friction_with_coulomb(m, 30);
  const Friction each[] = {first, second, mixed(first, second, 0.25F), thrice};
  for (const Friction& f : each) {
    std::printf("%.9g %.9g ", double(friction_n_per_m(f, 0.003F)),
                double(least_friction_n_per_m(f)));
  }
}
"""

# The table of a tissue: its formerly last number (former, FORMER) and the new one, at 0 and at 4.
WRITER = """#include <cstdio>
#include "asset/write_organ.cpp"

namespace stylet::offline {
namespace {

void tell(double wet_n_per_m) {
  Tissue tissue;
  tissue.former = 1;
  tissue.wet_friction_n_per_m = wet_n_per_m;
  FlatBufferBuilder builder;
  builder.ForceDefaults(true);
  builder.Finish(write_material(builder, tissue));
  const auto& table = *flatbuffers::GetRoot<format::Material>(builder.GetBufferPointer());
  const auto* fields = reinterpret_cast<const flatbuffers::Table*>(&table);
  std::printf("%d %d %g;", fields->CheckField(format::Material::VT_FORMER),
              fields->CheckField(format::Material::VT_WET_FRICTION_N_PER_M),
              double(table.wet_friction_n_per_m()));
}

}  // namespace
}  // namespace stylet::offline

int main() {
  stylet::offline::tell(0);
  stylet::offline::tell(4);
}
"""


def end_of_list(lines, begins, carries_on):
    """Index of the last line of the macro, or of the line that closes the table, that begins so."""
    first = next(i for i, line in enumerate(lines) if line.startswith(begins))
    return next(i for i in range(first, len(lines))
                if (not lines[i].endswith(carries_on) if carries_on else lines[i] == "}"))


def add_at_end(path, begins, carries_on, line):
    lines = path.read_text().splitlines()
    end = end_of_list(lines, begins, carries_on)
    if carries_on:
        lines[end] += carries_on
        end += 1
    lines.insert(end, "  " + line)
    path.write_text("\n".join(lines) + "\n")


def last_field():
    """Of a material in the schema."""
    lines = (SOURCE / SCHEMA[0]).read_text().splitlines()
    return lines[end_of_list(lines, *SCHEMA[1:]) - 1].split(":")[0].strip()


class AddLaw(unittest.TestCase):
    def copied(self, folder, numbers, law):
        for name in "kernel/include", "kernel/schema", "kernel/src", "offline/src", "tests/support":
            shutil.copytree(SOURCE / name, folder / name)
        for place, line in numbers:
            add_at_end(folder / place[0], *place[1:], line)
        path = folder / "kernel/src/laws/friction.h"
        for old, new in law:
            text = path.read_text()
            self.assertEqual(text.count(old), 1, old)
            path.write_text(text.replace(old, new))
        run(FLATC, "--cpp", "--scoped-enums", "-o", folder, folder / "kernel/schema/organ.fbs")
        return [COMPILER, "-std=c++20", "-I", folder, "-I", folder / "kernel/include",
                "-iquote", folder / "kernel/src", "-iquote", folder / "offline/src",
                "-iquote", folder / "tests/support", "-I", SOURCE / "toolchain/toml"]

    def printed(self, folder, compiler, source):
        (folder / "numbers.cpp").write_text(source)
        run(*compiler, "-ffp-contract=off", "-o", folder / "numbers", folder / "numbers.cpp")
        return run(folder / "numbers")

    def test_three_lines_and_the_law(self):
        with tempfile.TemporaryDirectory(prefix="stylet-law-") as name:
            folder = pathlib.Path(name)
            compiler = self.copied(folder, NEW_NUMBERS, NEW_LAW)
            kernel, offline = folder / "kernel/src", folder / "offline/src"
            run(*compiler, "-fsyntax-only", *(kernel / each for each in KERNEL),
                offline / "asset/write_organ.cpp", "-I", SOURCE / "kernel/content")
            (folder / "main.cpp").write_text(PROGRAM)
            program = folder / "program"
            organ = [folder / "kernel" / each for each in ORGAN]
            run(*compiler, "-o", program, folder / "main.cpp", *organ,
                offline / "asset/materials.cpp", offline / "base/toml_file.cpp",
                SOURCE / "toolchain/toml/toml_text.cpp",
                offline / "base/file.cpp", "-lfmt", "-lcrypto")
            (folder / "writer.cpp").write_text(
                WRITER.replace("FORMER", last_field().upper()).replace("former", last_field()))
            writer = folder / "writer"
            run(*compiler, "-I", SOURCE / "kernel/content", "-o", writer, folder / "writer.cpp",
                *organ, SOURCE / "kernel/content/content_sum.cpp",
                SOURCE / "kernel/content/sha256.cpp", "-lfmt", "-lcrypto", "-lmd")
            # An organ without the new number has the same bytes as before.
            self.assertEqual(run(writer), "1 0 0;1 1 4;")
            tissues = folder / "tissues.toml"
            tissues.write_text("[gel]\n[liver]\nwet_friction_n_per_mm = 0.002\n")
            # 4 / 2 at 1 m/s; half of 4 in the mean; 4 for Coulomb friction of 5, so 12 for 15.
            self.assertEqual(run(program, tissues), "0 2 2 12 0 2")
            tissues.write_text("[liver]\nwet_friction_n_per_mm = 0.02\n")
            done = subprocess.run([program, tissues], capture_output=True, text=True)
            self.assertIn("wet_friction_n_per_mm = 0.02: expected 0 to 0.01", done.stderr)

    def test_a_second_law_that_a_tissue_chooses(self):
        with tempfile.TemporaryDirectory(prefix="stylet-law-") as name:
            before, after = pathlib.Path(name) / "before", pathlib.Path(name) / "after"
            old = self.copied(before, [], [])
            new = self.copied(after, SECOND_NUMBERS, SECOND_LAW)
            run(*new, "-fsyntax-only", *(after / "kernel/src" / each for each in KERNEL))
            lines = self.printed(before, old, SAME)
            self.assertEqual(len(set(lines.splitlines())), 1000)
            self.assertEqual(self.printed(after, new, SAME), lines)
            found = [float(each) for each in self.printed(after, new, BOTH).split()]
            first, least = found[:2]
            second = 10 * (1 + 0.3 / 1.3)
            wanted = [second, 10, 0.75 * first + 0.25 * second, 0.75 * least + 0.25 * 10,
                      3 * second, 30]
            for number, right in zip(found[2:], wanted, strict=True):
                self.assertAlmostEqual(number / right, 1, delta=1e-6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
