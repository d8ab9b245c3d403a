#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The Debian packages: what is in them, that lintian accepts them, what they say they are made of,
that the same sources make the same bytes, and that a clean Debian installs, uses and purges them.

usage: packages_test.py CASE...    with STYLET_BUILD and STYLET_SOURCE in the environment
"""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["STYLET_BUILD"])
SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
MIRROR = [os.environ["STYLET_DEBIAN"]] if "STYLET_DEBIAN" in os.environ else []
LONG_AGO = "1700000000"  # 2023-11-14: any time that is not now
SAID_OFFLINE = re.compile("Temporary failure|Could not resolve|Failed getting release|"
                          "Couldn't download|Connection (failed|timed out|refused)")


# A user's first lines of Python: a needle 20 mm into the liver phantom; the largest force, in N.
IN_TEN_LINES = """
import numpy, stylet
organ = stylet.Organ.read("/tmp/liver.organ")
needle = stylet.Needle(bending_nm2=0.02)
simulation = stylet.Simulation(organ, needle)
top_m = numpy.array([0, 0, organ.info.high_m[2]])
tips_m = top_m + numpy.outer(numpy.linspace(0.005, -0.02, 2500), [0, 0, 1])
outputs = simulation.run(stylet.poses_of_tips(tips_m, (0, 0, -1), needle.length_m))
print(outputs["force_n"][:, 2].max())
"""
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
    """Components whose programs are there; what was not built is not packed."""
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
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)
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
                (r"/scenes/lumbar-puncture\.toml$", "stylet"), (r"man1/stylet\.1\.gz$", "stylet"),
                (r"/completions/stylet$", "stylet"), (r"/_stylet$", "stylet"),
                (r"/stylet\.fish$", "stylet"), (r"^\./usr/bin/stylet-organ$", "stylet-organ"),
                (r"/recipes/totalsegmentator\.toml$", "stylet-organ"),
                (r"/dist-packages/stylet/recording\.py$", "python3-stylet"),
                (r"/dist-packages/stylet/_stylet.*\.so$", "python3-stylet"),
                (r"/dist-packages/stylet_organ/_stylet_organ.*\.so$", "python3-stylet-organ"),
                (r"/share/stylet/README\.md$", "stylet-doc")):
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

    def test_programs_tell_no_path_of_the_build(self):
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
    """sbom.py against what the loader and the packages themselves say; the same bytes again."""

    def document(self, package):
        folder = self.top / package
        call("dpkg-deb", "-x", self.packages[package], folder)
        return folder, json.loads((folder / "usr/share/doc" / package /
                                   "sbom.spdx.json").read_text())

    def test_hold_what_is_depended_on(self):
        for package in sorted({"libstylet0", "stylet", "stylet-organ", "python3-stylet-organ"} &
                              set(self.packages)):
            _, made_of = self.document(package)
            names = {part["SPDXID"]: part["name"] for part in made_of["packages"]}
            linked = {names[each["relatedSpdxElement"]] for each in made_of["relationships"]
                      if each["relationshipType"] == "DYNAMIC_LINK"}
            needs = call("dpkg-deb", "-f", self.packages[package], "Depends").strip()
            depends = {each.split()[0] for each in needs.split(", ")}
            # What dpkg-shlibdeps found by symbols; what only scripts need is not linked.
            scripts = {"passwd", "python3:any", "python3", "python3-numpy", "python3-stylet"}
            self.assertEqual(linked - {"libc6"}, depends - scripts - {"libc6"}, package)

    def test_hold_libraries_without_a_file(self):
        wanted = {"libstylet0": {"libflatbuffers-dev", "libfmt-dev", "libstdc++-12-dev"},
                  "stylet": {"libboost1.74-dev", "libcli11-dev", "libeigen3-dev",
                             "libtomlplusplus-dev", "nlohmann-json3-dev"},
                  "stylet-organ": {"libcgal-dev", "libeigen3-dev", "libinsighttoolkit5-dev"},
                  "python3-stylet-organ": {"libcgal-dev", "pybind11-dev"}}
        for package in sorted(set(wanted) & set(self.packages)):
            _, made_of = self.document(package)
            self.assertLessEqual(wanted[package], {part["name"] for part in made_of["packages"]})

    def test_the_same_build_makes_the_same_packages(self):
        self.assertEqual(sums(pack(BUILD, self.top / "again", built())), sums(self.packages))

    def test_are_spdx(self):
        for package in sorted({"libstylet0", "stylet", "stylet-organ", "python3-stylet-organ"} &
                              set(self.packages)):
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
    """The libraries' packages of two builds from nothing, in folders of other names."""

    def build(self, folder):
        source = folder / "stylet"
        shutil.copytree(SOURCE, source, ignore=shutil.ignore_patterns(
            "build", ".git", "node_modules", "__pycache__"))
        env = {**os.environ, "CCACHE_DISABLE": "1"}
        call("cmake", "--preset", "package", "-DSTYLET_WITH_PROGRAM=OFF",
             "-DSTYLET_WITH_OFFLINE=OFF", "-DSTYLET_WITH_TESTS=OFF", cwd=source, env=env)
        build = source / "build/package"
        call("cmake", "--build", build, "-j2", "--target", "stylet_shared", "stylet_hal", env=env)
        return pack(build, folder / "packages", ["libraries", "development", "doc"])

    def test_same_bytes(self):
        with tempfile.TemporaryDirectory() as top:
            made = []
            for name in ("one", "another-and-longer"):
                folder = pathlib.Path(top) / name
                folder.mkdir()
                made.append(sums(self.build(folder)))
            self.assertEqual(set(made[0]), {"libstylet0", "libstylet-dev", "stylet-doc"})
            self.assertEqual(*made)


class CleanRoot(Packed):
    """A Debian of its own with nothing but what the packages ask for."""

    def setUp(self):
        if os.geteuid() != 0 or shutil.which("debootstrap") is None:
            self.skipTest("needs root and debootstrap")
        self.root = self.top / "root"
        done = subprocess.run(["debootstrap", "--variant=minbase", "bookworm", self.root, *MIRROR],
                              capture_output=True, text=True)
        if done.returncode != 0:
            self.assertRegex(done.stdout + done.stderr, SAID_OFFLINE)
            self.skipTest("no network: debootstrap's mirror cannot be reached")

    def inside(self, *command, **more):
        env = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp", "LC_ALL": "C.UTF-8",
               "DEBIAN_FRONTEND": "noninteractive"}
        return call("chroot", self.root, *command, env=env, **more)

    def listing(self):
        kept = ("/proc/", "/sys/", "/dev/", "/tmp/", "/var/log/", "/var/cache/",
                "/var/lib/", "/etc/")
        found = {"/" + str(path.relative_to(self.root)) for path in self.root.rglob("*")}
        return {path for path in found if not path.startswith(kept)}

    def test_installed_used_and_purged(self):
        for file in self.packages.values():
            shutil.copy(file, self.root / "tmp")
        for name in ("Release", "resolv.conf", "hosts"):
            if pathlib.Path("/etc", name).exists():
                shutil.copy(f"/etc/{name}", self.root / "etc")
        before = self.listing()
        self.inside("apt-get", "install", "-y", "--no-install-recommends",
                    *(f"/tmp/{file.name}" for file in self.packages.values()))
        self.use()
        self.inside("apt-get", "purge", "-y", *self.packages)
        left = {path for path in self.listing() - before if "stylet" in path}
        self.assertEqual(left, set())

    def use(self):
        self.assertRegex(self.inside("getent", "group", "realtime"), r"^realtime:")
        if {"stylet", "stylet-organ"} <= set(self.packages):
            self.assertIn("lumbar-puncture", self.inside("stylet", "scenes"))
            report = json.loads(self.inside("stylet", "run", "lumbar-puncture", "--fast",
                                            "--duration-s", "0.5", "--json"))
            self.assertRegex(report["state_hash"], r"^[0-9a-f]{16}$")
        if {"stylet-organ", "python3-stylet"} <= set(self.packages):
            self.inside("stylet-organ", "phantom", "liver", "-o", "/tmp/liver.organ")
            said = self.inside("python3", "-c", IN_TEN_LINES)
            self.assertGreater(float(said), 0.1)
        if {"python3-stylet", "python3-stylet-organ"} <= set(self.packages):
            self.assertEqual(self.inside("python3", "-c", OF_AN_ARRAY), "True\n")
        self.inside("apt-get", "install", "-y", "--no-install-recommends", "gcc", "libc6-dev",
                    "pkg-config")
        shutil.copy(SOURCE / "hal/hosts/c/examples/insert.c", self.root / "tmp")
        shutil.copy(SOURCE / "tests/fuzz/seeds/organ/two-materials.organ", self.root / "tmp")
        self.inside("sh", "-c", "cc /tmp/insert.c $(pkg-config --cflags --libs stylet) "
                                "-o /tmp/insert")
        self.assertIn("state ", self.inside("/tmp/insert", "/tmp/two-materials.organ"))


if __name__ == "__main__":
    unittest.main()
