#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The MEX function under Octave: the same bits as from C; wrong arguments and freed handles are
errors that say what was expected.

usage: octave_test.py LIBRARY_FOLDER EXAMPLE_IN_C STYLET_ORGAN
"""
import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

LIBRARY, EXAMPLE_IN_C, STYLET_ORGAN = sys.argv[1:4]
ROOT = pathlib.Path(__file__).resolve().parents[3]
HERE = ROOT / "hal/hosts/matlab"


def defaults(name):
    """Default values of a struct whose fields are numbers of four bytes, from the library
    itself."""
    library = ctypes.CDLL(str(pathlib.Path(LIBRARY) / "libstylet.so"))
    header = (ROOT / "hal/hosts/c/include/stylet/stylet.h").read_text()
    body, = re.findall(r"typedef struct \{([^{}]*)\} stylet_" + name + ";", header)
    rows = re.findall(r"(float|uint32_t|stylet_vec3) ([\w, ]+);",
                      re.sub(r"/\*.*?\*/", "", body, flags=re.S))
    kinds = {"float": ctypes.c_float, "uint32_t": ctypes.c_uint32,
             "stylet_vec3": 3 * ctypes.c_float}
    fields = [(field, kinds[kind]) for kind, words in rows for field in words.split(", ")]
    struct = type(name, (ctypes.Structure,), {"_fields_": fields})
    made = struct()
    status = getattr(library, f"stylet_{name}_init")(
        ctypes.byref(made), ctypes.c_size_t(ctypes.sizeof(made)))
    assert status == 0, status
    return {field: list(value) if kind is kinds["stylet_vec3"] else value
            for field, kind in fields[1:] for value in [getattr(made, field)]}


@unittest.skipUnless(shutil.which("octave-cli") and shutil.which("mkoctfile"),
                     "Octave is missing (Debian: octave octave-dev)")
class Octave(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        cls.organ = cls.folder / "liver.organ"
        subprocess.run([STYLET_ORGAN, "phantom", "liver", "--voxel-mm", "7", "-o", cls.organ],
                       check=True, capture_output=True)
        for file in HERE.rglob("*.[mc]"):
            target = cls.folder / file.relative_to(HERE)
            target.parent.mkdir(exist_ok=True)
            shutil.copy(file, target)
        subprocess.run(["mkoctfile", "--mex", "-Wall", "-Wextra", "-Werror", "stylet_mex.c",
                        f"-I{ROOT / 'hal/hosts/c/include'}", f"-L{LIBRARY}", "-lstylet"],
                       check=True, cwd=cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def octave(self, text):
        done = subprocess.run(["octave-cli", "--no-init-file", "--quiet", "--eval", text],
                              cwd=self.folder, text=True, capture_output=True, timeout=300,
                              env={**os.environ, "LD_LIBRARY_PATH": LIBRARY})
        return done.returncode, done.stdout, done.stderr

    def refused(self, text):
        code, _, error = self.octave(text)
        self.assertEqual(code, 1, error)
        return error

    def test_inserts_as_the_example_in_c(self):
        in_c = subprocess.run([EXAMPLE_IN_C, self.organ], check=True, capture_output=True,
                              text=True).stdout.split("\n")
        code, said, error = self.octave(f"cd examples; insert ('{self.organ}', 'no')")
        self.assertEqual(code, 0, error)
        self.assertEqual(said.split("\n")[:22], in_c[:22])
        self.assertIn("puncture", said)

    def test_state_is_that_of_the_example_in_c(self):
        # Positions as floats, as the example in C has them, because products of doubles are rounded
        # differently.
        in_c = subprocess.run([EXAMPLE_IN_C, self.organ], check=True, capture_output=True,
                              text=True).stdout
        code, said, error = self.octave(f"""
          s = stylet_open ('{self.organ}', struct ('bending_nm2', 0.02));
          low = single (s.organ.low_m); high = single (s.organ.high_m);
          at = [(low(1) + high(1)) / 2; (low(2) + high(2)) / 2; high(3) + single(0.01)];
          far = single (stylet_mex ('raycast', s.organ_handle, double (at), [0; 0; -1]));
          z = at(3) - (far - single (1e-3));
          step = single (10e-3) * single (1e-3);
          tips = zeros (3, 2101);
          for tick = 0:2100
            tips(:, tick + 1) = [at(1); at(2); z - step * single(tick)];
          end
          out = stylet_run (s, double (tips), [0; 0; -1]);
          printf ('state %016x\\n', stylet_hash (s));
          [surface, needle, events] = stylet_look (s);
          printf ('%d %d %d %d\\n', columns (surface) == columns (s.organ.vertices), ...
                  columns (needle), numel (events) > 1, max (s.organ.triangles(:)));
          stylet_close (s);""")
        self.assertEqual(code, 0, error)
        state, looked = said.split("\n")[:2]
        self.assertIn(state, in_c)
        same, nodes, happened, last = map(int, looked.split())
        self.assertEqual((same, nodes, happened), (1, 33, 1))  # 32 rods
        self.assertGreater(last, 100)

    def test_every_field_of_the_header_can_be_given(self):
        """Every field of needle and configuration is given with its default: the state is that
        without any field."""
        texts = [", ".join(f"'{field}', {value!r}" for field, value in defaults(name).items())
                 for name in ("needle", "config")]
        code, said, error = self.octave(f"""
          a = stylet_open ('{self.organ}');
          b = stylet_open ('{self.organ}', struct ({texts[0]}), struct ({texts[1]}));
          c = stylet_open ('{self.organ}', struct (), struct ('breathing_amplitude_m', [0 0 0.01]));
          still = [0; 0; 1; 1; 0; 0; 0] * ones (1, 500);
          for s = [a, b, c]  stylet_run (s, still); end
          printf ('%d %d', stylet_hash (a) == stylet_hash (b), stylet_hash (a) == stylet_hash (c));
          """)
        self.assertEqual((code, said), (0, "1 0"), error)

    def test_what_is_wrong_is_said(self):
        organ = f"'{self.organ}'"
        for text, said in (
                ("stylet_open ('/nowhere.organ')", "/nowhere.organ: No such file"),
                (f"stylet_open ({organ}, struct ('lenght_m', 1))", "no field is called lenght_m"),
                (f"stylet_open ({organ}, struct ('length_m', 0.7))",
                 "needle.length_m [0]: 0.7: expected 0.001 to 0.5"),
                (f"stylet_open ({organ}, struct (), struct ('breathing_amplitude_m', 0.01))",
                 "breathing_amplitude_m: expected three numbers"),
                (f"stylet_open ({organ}, struct ('rods', 1.5))",
                 "needle.rods: 1.5: expected a whole"),
                (f"s = stylet_open ({organ}); stylet_run (s, zeros (6, 2))", "with 7 rows"),
                (f"s = stylet_open ({organ}); stylet_close (s); stylet_hash (s)",
                 "expected a simulation that is open"),
                (f"s = stylet_open ({organ}); stylet_mex ('hash', s.organ_handle)",
                 "expected a simulation that is open"),
                ("stylet_mex ('hash', 1e9)", "expected a simulation that is open"),
                ("stylet_mex ('hash', -3)", "expected a simulation that is open"),
                ("stylet_mex ('hash', NaN)", "expected a simulation that is open"),
                (f"s = stylet_open ({organ}); stylet_run (s, sparse (7, 3000000))",
                 "expected a full matrix"),
                (f"s = stylet_open ({organ}); stylet_run (s, zeros (3), sparse ([0; 0; -1]))",
                 "direction: expected a full matrix"),
                (f"s = stylet_open ({organ}); stylet_run (s, zeros (3), [NaN; 0; -1])",
                 "direction: expected finite"),
                (f"stylet_open ({organ}, struct ('rods', {{8, 9}}))", "expected one struct"),
                ("stylet_mex ('hash', sparse (0))", "expected one number"),
                ("stylet_mex ('dance')", "expected the name of a command"),
                ("stylet_mex ('hash')", "expected 1 arguments")):
            self.assertIn(said, self.refused(text), text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
