#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The Debian packages: their contents; lintian accepts them; what they say they are made of; the
same sources make the same bytes; and a clean Debian installs, uses and purges them.

usage: packages_test.py CASE...    with STYLET_BUILD and STYLET_SOURCE in the environment
"""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import clean_root

sys.path.insert(0, os.environ["STYLET_SOURCE"] + "/toolchain")
import book

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
WITH_PROGRAMS = {"libstylet0", "stylet", "stylet-organ", "python3-stylet", "python3-stylet-organ"}
LONG_AGO = "1700000000"  # 2023-11-14: any time but now
OF_AN_ARRAY = """
import numpy, stylet_organ
labels = numpy.ones((9, 9, 9), numpy.uint8)
built = stylet_organ.from_labels(labels, {1: "gel"}, spacing_m=3 * [0.005])
print(built.organ.info.voxels >= 9 ** 3)
"""


def call(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-4000:]}"
                             f"{done.stderr[-4000:]}")
    return done.stdout


def built():
    """Components whose programs were built; others are not packed."""
    parts = {"libraries": "lib/libstylet.so", "development": "hal/libstylet_hal.a",
             "program": "bin/stylet", "organ": "bin/stylet-organ",
             "python": "python/stylet/__init__.py",
             "organ_python": "python/stylet_organ/__init__.py"}
    return ["doc", *(part for part, file in parts.items() if (BUILD / file).exists())]


def pack(build, folder, components):
    call("cpack", "-G", "DEB", "-B", folder, "-D",
         f"CPACK_COMPONENTS_ALL={';'.join(components)}", cwd=build,
         env={**os.environ, "SOURCE_DATE_EPOCH": LONG_AGO})
    return {path.name.split("_")[0]: path for path in sorted(folder.glob("*.deb"))}


def sums(packages):
    return {name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in packages.items()}


class Packed(unittest.TestCase):
    with_book = not book.lacking() and (BUILD / "bin/stylet-organ").exists()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
        if cls.with_book:
            call("cmake", "--build", BUILD, "--target", "book_of_packages")
        cls.packages = pack(BUILD, cls.top / "packages", built())


class Contents(Packed):
    def field(self, package, name):
        return call("dpkg-deb", "-f", self.packages[package], name).strip()

    def files(self, package):
        rows = call("dpkg-deb", "-c", self.packages[package]).splitlines()
        return {re.sub(r" -> .*", "", row.split(None, 5)[5]): row.split() for row in rows}

    def test_each_file_is_in_one_package(self):
        seen = {}
        for package in self.packages:
            for name in self.files(package):
                if not name.endswith("/"):
                    self.assertNotIn(name, seen, (package, seen.get(name)))
                    seen[name] = package
        for wanted, package in (
                (r"/libstylet\.so\.0$", "libstylet0"), (r"/libstylet\.so$", "libstylet-dev"),
                (r"/stylet/stylet\.h$", "libstylet-dev"), (r"/stylet\.pc$", "libstylet-dev"),
                (r"^\./usr/bin/stylet$", "stylet"), (r"70-stylet-haptic\.rules$", "stylet"),
                (r"/scenes/lumbar-puncture\.toml$", "stylet"),
                (r"/organs/liver-phantom\.organ$", "stylet"), (r"man1/stylet\.1\.gz$", "stylet"),
                (r"/completions/stylet$", "stylet"), (r"/_stylet$", "stylet"),
                (r"/stylet\.fish$", "stylet"), (r"^\./usr/bin/stylet-organ$", "stylet-organ"),
                (r"/recipes/totalsegmentator\.toml$", "stylet-organ"),
                (r"/dist-packages/stylet/recording\.py$", "python3-stylet"),
                (r"/dist-packages/stylet/_stylet.*\.so$", "python3-stylet"),
                (r"/dist-packages/stylet_organ/_stylet_organ.*\.so$", "python3-stylet-organ"),
                (r"/share/stylet/README\.md$", "stylet-doc"),
                *[(r"/share/doc/stylet/book/index\.html$", "stylet-doc"),
                  (r"/share/doc-base/stylet-doc\.stylet$", "stylet-doc")] * self.with_book,
                (r"/hosts/unity/package\.json$", "stylet-doc"),
                (r"/hosts/unity/Runtime/Native\.cs$", "stylet-doc"),
                (r"/hosts/matlab/stylet_mex\.c$", "stylet-doc"),
                (r"/hosts/godot/project/project\.godot$", "stylet-doc"),
                (r"/hosts/python/examples/campaign\.py$", "stylet-doc"),
                (r"/offline/python/examples/calibrate\.py$", "stylet-doc")):
            if package in self.packages:
                found = [name for name in seen if re.search(wanted, name)]
                self.assertEqual([seen[name] for name in found], [package], wanted)

    def test_rights_and_times_are_plain(self):
        for package in self.packages:
            for name, row in self.files(package).items():
                self.assertEqual(row[1], "root/root")
                self.assertIn(row[0], ("drwxr-xr-x", "-rw-r--r--", "-rwxr-xr-x", "lrwxrwxrwx"))
                self.assertEqual(row[3], "2023-11-14", name)  # LONG_AGO

    def test_needs(self):
        version = self.field("libstylet-dev", "Version")
        self.assertIn(f"libstylet0 (= {version})", self.field("libstylet-dev", "Depends"))
        self.assertRegex(self.field("libstylet0", "Depends"), r"libc6 .*libccd2.*libmd0")
        self.assertNotIn("libstdc++", self.field("libstylet0", "Depends"))
        self.assertEqual(self.field("stylet-doc", "Architecture"), "all")
        if "stylet" in self.packages:
            self.assertIn("libhdf5", self.field("stylet", "Depends"))
            self.assertEqual(self.field("stylet", "Recommends"), "stylet-organ")
        if "python3-stylet" in self.packages:
            self.assertNotIn("libstylet", self.field("python3-stylet", "Depends"))
            self.assertEqual(self.field("python3-stylet", "Breaks"),
                             f"libstylet0 (<< {version}), libstylet0 (>> {version})")

    def test_module_for_python_keeps_the_library_inside(self):
        """Otherwise it could be confused with a libstylet.so in the same process."""
        if "python3-stylet" not in self.packages:
            self.skipTest("the Python package is not built")
        folder = self.top / "module"
        call("dpkg-deb", "-x", self.packages["python3-stylet"], folder)
        module, = folder.rglob("_stylet*.so")
        exported = call("nm", "-D", "--defined-only", module).split()[2::3]
        self.assertEqual(exported, ["PyInit__stylet"])

    def test_programs_contain_no_path_of_the_build(self):
        for package in self.packages:
            call("dpkg-deb", "-x", self.packages[package], self.top / package)
            for path in (self.top / package).rglob("*"):
                if path.is_file() and not path.is_symlink():
                    self.assertNotIn(str(BUILD).encode(), path.read_bytes(), path)

    def test_lintian_accepts_them(self):
        if shutil.which("lintian") is None:
            self.skipTest("lintian is not installed")
        done = subprocess.run(["lintian", "--allow-root", "--no-cfg", *self.packages.values()],
                              capture_output=True, text=True)
        told = {tuple(match) for match in
                re.findall(r"^[EW]: (\S+): (\S+)", done.stdout, re.M)}
        lines = (SOURCE / "toolchain/debian/lintian.txt").read_text().splitlines()
        known = {tuple(line.split()[:2]) for line in lines if line and not line.startswith("#")}
        self.assertEqual(told - known, set(), done.stdout)
        here = {pair for pair in known if pair[0] in self.packages}
        self.assertEqual(here - told, set(), "listed and no longer so")


class Parts(Packed):
    """sbom.py is compared with what the loader and the packages themselves say, and gives the same
    bytes again."""

    def document(self, package):
        folder = self.top / package
        call("dpkg-deb", "-x", self.packages[package], folder)
        return folder, json.loads((folder / "usr/share/doc" / package /
                                   "sbom.spdx.json").read_text())

    def test_contain_every_dependency(self):
        for package in sorted(WITH_PROGRAMS & set(self.packages)):
            _, made_of = self.document(package)
            names = {part["SPDXID"]: part["name"] for part in made_of["packages"]}
            linked = {names[each["relatedSpdxElement"]] for each in made_of["relationships"]
                      if each["relationshipType"] == "DYNAMIC_LINK"}
            needs = call("dpkg-deb", "-f", self.packages[package], "Depends").strip()
            depends = {each.split()[0] for each in needs.split(", ")}
            # Compared with what dpkg-shlibdeps found by symbols; packages that only scripts need
            # are not linked.
            scripts = {"passwd", "python3:any", "python3", "python3-numpy", "python3-stylet"}
            self.assertEqual(linked - {"libc6"}, depends - scripts - {"libc6"}, package)

    def test_contain_libraries_without_a_file(self):
        wanted = {"libstylet0": {"libflatbuffers-dev", "libfmt-dev", "libstdc++-12-dev"},
                  "stylet": {"libboost1.74-dev", "libcli11-dev", "libeigen3-dev",
                             "libtomlplusplus-dev", "nlohmann-json3-dev"},
                  "stylet-organ": {"libcgal-dev", "libeigen3-dev", "libinsighttoolkit5-dev"},
                  "python3-stylet": {"libflatbuffers-dev", "libfmt-dev", "pybind11-dev"},
                  "python3-stylet-organ": {"libcgal-dev", "pybind11-dev"}}
        for package in sorted(set(wanted) & set(self.packages)):
            _, made_of = self.document(package)
            self.assertLessEqual(wanted[package], {part["name"] for part in made_of["packages"]})

    def test_the_same_build_makes_the_same_packages(self):
        self.assertEqual(sums(pack(BUILD, self.top / "again", built())), sums(self.packages))

    def test_are_spdx(self):
        for package in sorted(WITH_PROGRAMS & set(self.packages)):
            _, made_of = self.document(package)
            self.assertEqual((made_of["spdxVersion"], made_of["dataLicense"], made_of["SPDXID"]),
                             ("SPDX-2.3", "CC0-1.0", "SPDXRef-DOCUMENT"))
            ids = {part["SPDXID"] for part in made_of["packages"]}
            self.assertEqual(len(ids), len(made_of["packages"]))
            for part in made_of["packages"]:
                self.assertRegex(part["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
                self.assertTrue(part["versionInfo"] and part["downloadLocation"])
            for each in made_of["relationships"]:
                self.assertIn(each["relatedSpdxElement"], ids)
                self.assertIn(each["spdxElementId"], ids | {"SPDXRef-DOCUMENT"})


class Reproducible(unittest.TestCase):
    """The packages with the library inside, from two builds from nothing in folders with different
    names."""
    PARTS = {"libraries", "development", "doc", "python"}

    def build(self, folder):
        source = folder / "stylet"
        shutil.copytree(SOURCE, source, ignore=shutil.ignore_patterns(
            "build", ".git", "node_modules", "__pycache__"))
        env = {**os.environ, "CCACHE_DISABLE": "1"}
        call("cmake", "--preset", "package", "-DSTYLET_WITH_PROGRAM=OFF",
             "-DSTYLET_WITH_OFFLINE=OFF", "-DSTYLET_WITH_TESTS=OFF", cwd=source, env=env)
        build = source / "build/package"
        parts = sorted(self.PARTS & set(built()))
        targets = ["stylet_shared", "stylet_hal", *["stylet_python"] * ("python" in parts)]
        call("cmake", "--build", build, "-j2", "--target", *targets, env=env)
        return pack(build, folder / "packages", parts)

    def test_same_bytes(self):
        with tempfile.TemporaryDirectory() as top:
            made = []
            for name in ("one", "another-and-longer"):
                folder = pathlib.Path(top) / name
                folder.mkdir()
                made.append(sums(self.build(folder)))
            self.assertLessEqual({"libstylet0", "libstylet-dev", "stylet-doc"}, set(made[0]))
            self.assertEqual(*made)


class CleanRoot(Packed):
    """A minimal Debian with nothing but what the packages ask for."""

    def setUp(self):
        if not {"stylet", "stylet-organ", "python3-stylet"} <= set(self.packages):
            self.skipTest("not all programs are built")
        try:
            self.root = clean_root.CleanRoot(self.top / self._testMethodName)
        except clean_root.Missing as missing:
            self.skipTest(str(missing))
        self.inside, self.install = self.root.inside, self.root.install

    def test_two_files_and_ten_lines(self):
        """What the page of the Python package promises, by the command and lines on that page."""
        page = (SOURCE / "hal/hosts/python/README.md").read_text()
        command, = re.findall(r"`apt install\n?((?: ?\./\S+\.deb)+)`", page)
        lines, = re.findall(r"```python\n(.*?)```", page, re.S)
        for name in command.split():
            self.root.copy(self.packages[pathlib.Path(name).name.split("_")[0]])
        self.install(*command.split(), recommended=True)
        there = self.inside("dpkg-query", "-W", "-f=${Package}\\n").split()
        self.assertEqual([name for name in there if "stylet" in name], ["python3-stylet", "stylet"])
        more = "print(len(outputs), outputs['force_n'][:, 2].max())\n"
        (self.root.path / "tmp/lines.py").write_text(lines + more)
        ticks, most_n = self.inside("python3", "/tmp/lines.py").split()
        self.assertEqual(int(ticks), 3500)
        self.assertGreater(float(most_n), 0.7)  # the largest force of the liver's capsule
        picture = (self.root.path / "tmp/force.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        run = ("stylet", "run", "fig09-force-curve", "--fast", "--duration-s", "0.5", "--json")
        here = call(BUILD / "bin" / run[0], *run[1:])
        self.assertEqual(*(json.loads(said)["state_hash"] for said in (self.inside(*run), here)))
        self.assertFalse((self.root.path / "tmp/.cache/stylet").exists())

    def test_installed_used_and_purged(self):
        for file in self.packages.values():
            self.root.copy(file)
        before = self.root.listing()
        self.install(*(f"/tmp/{file.name}" for file in self.packages.values()))
        self.use_program()
        self.use_python()
        self.read_pages()
        state = self.use_library()
        self.assertEqual(self.state(self.inside("python3", "/tmp/insert.py", "/tmp/liver.organ")),
                         state)
        self.use_pip(state)
        self.inside("apt-get", "purge", "-y", *self.packages)
        left = {path for path in self.root.listing() - before if "stylet" in path}
        self.assertEqual(left, set())

    def state(self, text):
        return re.search(r"^state ([0-9a-f]{16})$", text, re.M)[1]

    def use_program(self):
        self.assertRegex(self.inside("getent", "group", "realtime"), r"^realtime:")
        self.assertIn("lumbar-puncture", self.inside("stylet", "scenes"))
        run = ("stylet", "run", "lumbar-puncture", "--fast", "--duration-s", "0.5", "--json")
        there = json.loads(self.inside(*run))
        organ, = (self.root.path / "tmp/.cache/stylet/organs").iterdir()
        here = json.loads(call(BUILD / "bin" / run[0], *run[1:], "--organ", organ))
        self.assertEqual(there["state_hash"], here["state_hash"])
        self.assertIn("benchmark", self.inside("stylet", "bench", "--help"))

    def use_python(self):
        """The package's example, what it reports as missing, and an organ made from an array."""
        self.root.copy(SOURCE / "hal/hosts/python/examples/insert.py")
        self.inside("stylet-organ", "phantom", "liver", "-o", "/tmp/liver.organ")
        self.assertEqual((self.root.path / "tmp/liver.organ").read_bytes(), (
            self.root.path / "usr/share/stylet/organs/liver-phantom.organ").read_bytes())
        said = self.inside("python3", "/tmp/insert.py", "/tmp/liver.organ")
        forces_n = [float(force) for force in re.findall(r"mm +(\S+) N", said)]
        self.assertGreater(max(forces_n), 0.1)
        without = ("import stylet\ntry: stylet.Recording('any.h5')\n"
                   "except ImportError as error: print(error)")
        self.assertIn("package python3-h5py", self.inside("python3", "-c", without))
        self.assertEqual(self.inside("python3", "-c", OF_AN_ARRAY), "True\n")

    def read_pages(self):
        """Manual pages without a warning of groff; completions that bash can use."""
        self.install("man-db")
        for program in ("stylet", "stylet-organ"):
            self.assertEqual(self.inside("sh", "-c", f"man --warnings -l /usr/share/man/man1/"
                                         f"{program}.1.gz 2>&1 >/dev/null"), "")
            self.assertIn("EXAMPLES", self.inside("man", program))
        words = ". /usr/share/bash-completion/completions/stylet; complete -p stylet; " \
            "COMP_WORDS=(stylet sc) COMP_CWORD=1; _stylet stylet sc stylet; echo ${COMPREPLY[@]}"
        self.assertEqual(self.inside("bash", "-c", words).splitlines()[-1], "scenes score")

    def use_library(self):
        """Programs built by pkg-config and by CMake, in C and C++, shared and static, have the
        state of insert.c."""
        self.install("g++", "libc6-dev", "cmake", "make", "pkg-config")
        self.root.copy(SOURCE / "hal/hosts/c/examples", "/tmp/checkout/hal/hosts/c")
        self.root.copy(SOURCE / "hal/examples", "/tmp/checkout/hal")
        self.root.copy(SOURCE / "tests/hosts/consumers", "/tmp/checkout")
        self.inside("sh", "-c", "cc /tmp/checkout/hal/hosts/c/examples/insert.c "
                                "$(pkg-config --cflags --libs stylet) -o /tmp/insert")
        state = self.state(self.inside("/tmp/insert", "/tmp/liver.organ"))
        for language, standard, program in (("C", 99, "insert_c"), ("CXX", 20, "insert_kernel")):
            self.inside("cmake", "-S", "/tmp/checkout/consumers/installed", "-B", f"/tmp/{program}",
                        f"-DCONSUMER_LANGUAGES={language}", f"-DCONSUMER_STANDARD={standard}",
                        f"-DCONSUMER_STATIC={'ON' if language == 'CXX' else 'OFF'}",
                        "-DCONSUMER_SOURCE=/tmp/checkout")
            self.inside("cmake", "--build", f"/tmp/{program}")
        self.assertEqual(self.state(self.inside("/tmp/insert_c/insert_c", "/tmp/liver.organ")),
                         state)
        self.assertIn("state ", self.inside("/tmp/insert_kernel/insert_kernel",
                                            "/tmp/liver.organ"))
        return state

    def use_pip(self, state):
        """pip over the installed library, as the page says, in an environment without network."""
        self.install("python3-dev", "python3-pip", "python3-setuptools", "python3-venv",
                     "python3-wheel", "pybind11-dev")
        self.root.copy(SOURCE / "hal/hosts/python", "/tmp/checkout/hal/hosts")
        self.inside("python3", "-m", "venv", "--system-site-packages", "/tmp/own", network=False)
        self.inside("/tmp/own/bin/pip", "install", "--no-build-isolation", "--no-index", ".",
                    network=False, cwd="/tmp/checkout/hal/hosts/python")
        self.assertIn("/tmp/own/lib", self.inside("/tmp/own/bin/python", "-c",
                                                  "import stylet; print(stylet.__file__)"))
        said = self.inside("/tmp/own/bin/python", "/tmp/insert.py", "/tmp/liver.organ")
        self.assertEqual(self.state(said), state)


if __name__ == "__main__":
    unittest.main()
