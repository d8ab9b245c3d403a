#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Do the tests notice a wrong line? Changes what hands depend on, one place at a time.

usage: mutation.py [SUBJECT]... [--build FOLDER] [--sample N | --explained]    (guard, organ ...)

Each mutant is one change that a programmer might make by mistake: a comparison flipped, `or` for
`and`, a sign, a limit changed by one, a clamp or a statement left out. It is compiled, and tests of
its file run until one fails: first the test that killed the previous mutant, then the quick ones.
If no test fails, the mutant has survived. Known survivors are in mutation_survivors.txt with the
reason why each is harmless; they are not run. Any other survivor is an error, and so is a row of
that list that is no change of any subject.
--explained: runs the known survivors instead; one that is killed is an error: it is listed wrongly.
--sample N: only N mutants of each file, evenly spread. SUBJECT kernel, hal or offline: all of that
folder; mesh_readers: all formats of meshes. Of offline, all that decides anatomy or bytes; not
reports, pictures, timings, nor the rows of numbers that tissues have from their sources.
"""
import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[1]
SURVIVORS = SOURCE / "toolchain" / "mutation_survivors.txt"
# The file that is changed, and the tests that must notice, with their arguments: quickest first.
SUBJECTS = {
    "guard": ("hal/guard/guard.cpp", [["hal_guard"],
                                      ["device_faults", "--gtest_filter=DeviceFaults.*"],
                                      ["hal_loop"]]),
    "guard_sample": ("hal/guard/sample.cpp", [["hal_guard"], ["hal_loop"]]),
    "guard_arithmetic": ("hal/guard/arithmetic.h", [["hal_guard"], ["hal_loop"]]),
    "vector": ("hal/base/vector.h", [["hal_guard"], ["hal_grip"], ["hal_coupling"], ["hal_loop"]]),
    "wide": ("hal/base/wide.h", [["hal_guard"], ["hal_loop"]]),
    "energy": ("hal/guard/energy.cpp", [["hal_guard"], ["hal_loop"]]),
    "grip": ("hal/loop/grip.cpp", [["hal_grip"], ["hal_loop"]]),
    "spring": ("hal/loop/coupling.cpp", [["hal_coupling"]]),
    "toml_text": ("toolchain/toml/toml_text.cpp", [["hal_scene", "--gtest_filter=TomlText.*"]]),
    "packet": ("hal/device/packet.cpp", [["hal_packet"], ["hal_loop", "--gtest_filter=TwoS*"]]),
    "station": ("hal/loop/station.cpp", [["hal_packet", "--gtest_filter=Station*"],
                                         ["hal_loop", "--gtest_filter=TwoS*"]]),
    "peer": ("hal/device/drivers/peer.cpp", [["hal_loop", "--gtest_filter=TwoS*"],
                                             ["hal_device", "--gtest_filter=Peer*:*udp:*shm"]]),
    "link": ("hal/device/link.cpp", [["hal_packet", "--gtest_filter=SharedMemory*"],
                                     ["hal_device", "--gtest_filter=Peer*:*udp:*shm"]]),
    "membranes": ("kernel/src/organ/membranes.cpp",
                  [["unit_membranes"], ["insertion_membranes"]]),
    "raycast": ("kernel/src/organ/raycast.cpp", [["unit_surface"], ["unit_sheets"]]),
    "check_levels": ("kernel/src/organ/check_levels.cpp",
                     [["unit_graded", "--gtest_filter=*Refused*"]]),
    "check_slides": ("kernel/src/organ/check_slides.cpp",
                     [["unit_organ_open", "--gtest_filter=*Slides*"]]),
    "organ": ("kernel/src/organ/organ.cpp",
              [["unit_organ_open", "--gtest_filter=-*Fuzz*"], ["unit_odd_organ"],
               ["unit_sheets", "--gtest_filter=*Refused*"], ["unit_surface"],
               ["fuzz_organ", SOURCE / "tests/fuzz/seeds/organ"],
               ["unit_organ_open", "--gtest_filter=*Fuzz*"]]),
}
# All parts of the coupling of needle and tissue move the needle, so any of these tests may notice.
COUPLING = (
    [["fuzz_tick", SOURCE / "tests/fuzz/seeds/tick"]] +
    [[f"coupling_{each}"] for each in ("aside", "friction", "pools", "relaxation",
                                       "continuity", "strain", "energy",
                                       "phase_curve", "momentum")] +
    [[f"insertion_{each}"] for each in ("layers", "steering", "several", "bone",
                                        "breathing")] +
    [["unit_determinism", "--gtest_filter=*Flush*"], ["obstacle_contact"],
     ["stylet-simulator", "--seed", "2", "--sessions", "4"], ["coupling_abuse"]])
SUBJECTS |= {name: (f"kernel/src/coupling/{name}.cpp", COUPLING)
             for name in ("contact", "contact_spring", "cut", "deformation", "friction",
                          "insertion", "layers", "relaxation", "return_map", "shaft",
                          "stiffness", "support", "track")}
SUBJECTS["sideways"] = ("kernel/src/coupling/sideways.cpp", [["coupling_sideways"]])
SUBJECTS["held"] = ("kernel/src/coupling/membranes.cpp", [["insertion_membranes"]])
# Tests of offline, programs and scripts; those that read every available file come last.
RANDOM_MESHES = ["fuzz_mesh", SOURCE / "tests/fuzz/seeds/mesh"]
RANDOM_LABELS = ["fuzz_label", SOURCE / "tests/fuzz/seeds/label"]
REAL_MESHES = [["every_file_test.py", "Meshes"],
               ["offline_program_test", "--gtest_filter=Broken.*"]]
REAL_MAPS = [["offline_label_test", "--gtest_filter=RealMaps.*"],
             ["every_file_test.py", "LabelMaps"]]
MESHES = [["offline_reader_test"], RANDOM_MESHES, *REAL_MESHES]
HEADERS = [["offline_label_format_test"], ["offline_label_test", "--gtest_filter=LabelMap.*"],
           RANDOM_LABELS]
FRAMES = {case: [*HEADERS, ["label_frame_test.py", case], *REAL_MAPS]
          for case in ("Nrrd", "MetaImage", "Inrimage")}
EVERY_FRAME = [*HEADERS, ["label_frame_test.py"], *REAL_MAPS]
DICOM = {each: [f"dicom_{each[0]}_test.py", each[1]] for each in (
    ("conformance", "RegularSeries"), ("conformance", "IrregularSeries"),
    ("objects", "Segmentations"), ("objects", "StructureSets"),
    ("numbers", "Numbers"), ("numbers", "NumbersOfObjects"))}
DICOM = {each[1]: test for each, test in DICOM.items()} | {"All": ["dicom_test.py"]}
ORGANS = ["offline_organ_test", "--gtest_filter=-*Real*"]
MAPS = ["offline_label_test", "--gtest_filter=LabelOrgan.*:Wall.*-*WholeBody*"]
LOSSES = ["offline_losses_test", "--gtest_filter=Losses.*"]
SHEETS = ["offline_quality_test", "--gtest_filter=Sheets.*:Gaps.*"]
QUALITY = ["offline_quality_test", "--gtest_filter=Distance.*:Quality.*"]
REAL_ORGANS = ["offline_organ_test", "--gtest_filter=*Real*"]
REAL_BODY = ["offline_label_test", "--gtest_filter=Recipe.OfTotal*"]
VOXELS = [["offline_solid_test"], ORGANS, SHEETS, MAPS, LOSSES, QUALITY,
          ["offline_nesting_test"], REAL_ORGANS]
LABELS = [MAPS, ["offline_solid_test", "--gtest_filter=Mixed.*"],
          ["offline_label_test", "--gtest_filter=Recipe.*"], LOSSES,
          ["offline_losses_test", "--gtest_filter=Obstacles.*"], SHEETS]
MESH_READERS = [f"meshes/{reader}" for reader in re.findall(
    r"^STYLET_MESH_READER\(\w+, (\w+)\)", (SOURCE / "offline/src/meshes/readers.inc").read_text(),
    re.M)]
OFFLINE = {
    **dict.fromkeys(("meshes/read_mesh", "meshes/bytes", "meshes/lines", "meshes/reader",
                     *MESH_READERS), MESHES),
    **dict.fromkeys(("maps/header", "maps/itk", "maps/bzip2", "maps/whole"), EVERY_FRAME),
    "maps/label_map": [*EVERY_FRAME, DICOM["Segmentations"], DICOM["RegularSeries"]],
    **dict.fromkeys(("maps/nrrd_header", "maps/nrrd_frame"), FRAMES["Nrrd"]),
    **dict.fromkeys(("maps/meta_header", "maps/meta_frame"), FRAMES["MetaImage"]),
    "maps/inr": FRAMES["Inrimage"],
    "maps/nifti": [*HEADERS, *REAL_MAPS],
    "maps/names": [*HEADERS, ["dicom_test.py"], *REAL_MAPS],
    **dict.fromkeys(("maps/dicom_bounds", "maps/dicom_file"), [RANDOM_LABELS, *DICOM.values()]),
    "maps/dicom_number": [DICOM["NumbersOfObjects"], DICOM["Numbers"], DICOM["All"]],
    "maps/dicom_series": [DICOM["RegularSeries"], DICOM["All"], DICOM["IrregularSeries"],
                           DICOM["StructureSets"]],
    "maps/stack": [DICOM["All"], DICOM["RegularSeries"], DICOM["StructureSets"],
                    DICOM["IrregularSeries"], DICOM["Segmentations"]],
    "maps/dicom_seg": [DICOM["All"], DICOM["Segmentations"]],
    "maps/dicom_contours": [DICOM["StructureSets"], RANDOM_LABELS],
    "maps/contours": [["offline_label_test", "--gtest_filter=Contours.*"], DICOM["StructureSets"]],
    "maps/slabs": [["offline_label_test", "--gtest_filter=Slabs.*"], DICOM["StructureSets"],
                    RANDOM_LABELS],
    "maps/recipe": [["fuzz_recipe", SOURCE / "tests/fuzz/seeds/recipe"],
                     ["offline_label_test", "--gtest_filter=Recipe.*"], *LABELS],
    **dict.fromkeys(("asset/membranes", "pipeline/membranes", "base/polygon"),
                    [["offline_organ_test", "--gtest_filter=Membranes.*"],
                     ["offline_slides_test"]]),
    **dict.fromkeys(("voxels/slides", "voxels/apart", "pipeline/slides", "meshes/near_surface",
                     "meshes/refine_near", "voxels/sample_owners", "voxels/surface_bits"),
                    [["offline_slides_test"],
                     ["offline_refine_test", "--gtest_filter=RefineSlides.*"], SHEETS, LOSSES]),
    "asset/materials": [["fuzz_tissues", SOURCE / "tests/fuzz/seeds/tissues"], ORGANS,
                  ["offline_program_test", "--gtest_filter=Program.Own*"], MAPS, REAL_BODY],
    **dict.fromkeys(("pipeline/label_organ", "maps/groups", "pipeline/bodies", "maps/skin",
                     "maps/wall", "maps/wall_thickness"),
                    LABELS),
    **dict.fromkeys(("meshes/hull", "meshes/hull_text", "meshes/quickhull"),
                    [["offline_hull_test", "--gtest_filter=Hull.*"], *LABELS]),
    **dict.fromkeys(("meshes/repair", "meshes/orient", "meshes/nesting"),
                    [["offline_solid_test"], ["offline_nesting_test", "--gtest_filter=Nesting.*"],
                     ORGANS, REAL_ORGANS, QUALITY]),
    **dict.fromkeys(("voxels/voxelize", "voxels/sample_cell", "voxels/sample_parts",
                     "meshes/triangle_tree", "voxels/lattice", "voxels/layers", "voxels/mixed",
                     "voxels/sheets", "voxels/cell_parts", "voxels/gaps", "asset/sphere_tree",
                     "pipeline/voxel_materials", "asset/organ_shape", "voxels/attach",
                     "voxels/crop", "asset/write_organ", "pipeline/build"), VOXELS),
    **dict.fromkeys(("voxels/cell_walk", "voxels/losses", "pipeline/given"),
                    [LOSSES, ["offline_losses_test", "--gtest_filter=Obstacles.*"]]),
    "pipeline/skins": [["offline_skins_test"]],
    "pipeline/settings": [["offline_organ_test", "--gtest_filter=Settings.*"]],
    **dict.fromkeys(("meshes/phantom", "meshes/implicit_mesh"),
                    [ORGANS, ["offline_solid_test"],
                     ["offline_program_test", "--gtest_filter=Program.Phantoms*"]]),
    **dict.fromkeys(("meshes/exact_geometry", "meshes/soup_surface"),
                    [["offline_exact_test"], ORGANS, ["offline_solid_test"], ["offline_wrap_test"],
                     ["offline_program_test", "--gtest_filter=Program.Phantoms*"]]),
    "base/outputs": [["offline_program_test", "--gtest_filter=Outputs.*:Program.Outputs*"],
                ["outputs_test.py"]],
    "base/file": [["offline_program_test", "--gtest_filter=Program.*"], *HEADERS,
                  ["outputs_test.py"]],
    "base/toml_file": [["fuzz_tissues", SOURCE / "tests/fuzz/seeds/tissues"],
                       ["offline_label_test", "--gtest_filter=Recipe.*"]],
    **dict.fromkeys(("meshes/wrap", "meshes/soup_oracle", "meshes/holes",
                     "pipeline/wrapping"),
                    [["offline_wrap_test", "--gtest_filter=Holes.*"], ["offline_wrap_test"],
                     ["offline_solid_test", "--gtest_filter=Volume.*"], ORGANS]),
    "meshes/simplify": [MAPS, REAL_BODY],
    **dict.fromkeys(("base/refinement", "pipeline/refine", "voxels/hanging", "voxels/levels",
                     "voxels/node_groups", "voxels/part_hanging", "voxels/piece_sheets"),
                    [["offline_refine_test", "--gtest_filter=RefineTexts.*"],
                     ["offline_refine_test"]]),
    "voxels/sweep": [["offline_quality_test", "--gtest_filter=Fit.*"]],
}
# Reports, which nothing is built from.
REPORTS = ("meshes/distance", "pipeline/pieces", "report/info", "report/page", "report/picture",
           "report/quality", "report/speed")
SUBJECTS |= {name: (f"offline/src/{name}.cpp", tests) for name, tests in OFFLINE.items()}
BUILD = "build/release"
MOST_BYTES = 8 << 30  # a mutant might use all memory
FLIPS = {" < ": [" <= ", " >= "], " <= ": [" < "], " > ": [" >= ", " <= "], " >= ": [" > "],
         " == ": [" != "], " != ": [" == "], " && ": [" || "], " || ": [" && "],
         " + ": [" - "], " - ": [" + "], " += ": [" -= "], "++": ["--"],
         "return true": ["return false"], "return false": ["return true"]}
CALLS = re.compile(r"(?:\bstd::)?\b(clamp|max_of|min_of|settle)\(")
NUMBER = re.compile(r"(?<![\w.\"])(\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)(F|U|UL|ULL)?(?![\w.])")
DATA = re.compile(r"^[ \d.,eE+-]+\},$", re.M)  # a row of a table, which names its source
STATEMENT = re.compile(r"^ {2,}(?!return|const|constexpr|break|continue|using|case|default)"
                       r"[\w*(+].*[;]$", re.M)


def blanked(text):
    """The text with comments, literals and preprocessor lines blanked out."""
    token = re.compile(r'//[^\n]*|^#[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|static_assert[^;]*;',
                       re.S | re.M)
    return token.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def arguments_end(code, start):
    """The ends of the first argument and of the whole call whose bracket opens before `start`."""
    depth, first = 1, None
    for at in range(start, len(code)):
        depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(code[at], 0)
        if code[at] == "," and depth == 1 and first is None:
            first = at
        if depth == 0:
            return first if first is not None else at, at + 1
    return start, start


def numbers(code):
    code = DATA.sub(lambda row: " " * len(row[0]), code)
    for match in NUMBER.finditer(code):
        digits, suffix = match[1], match[2] or ""
        if suffix == "F" or "." in digits or "e" in digits.lower():
            changed = [f"{float(digits) * 1.5 + (float(digits) == 0):g}"]
            changed = [each if "." in each or "e" in each else each + ".0" for each in changed]
        else:
            changed = [str(int(digits) + 1)] + ([str(int(digits) - 1)] if int(digits) > 0 else [])
        for each in changed:
            yield match.start(), match.end(), each + suffix


def mutations(text):
    """(begin, end, replacement) of every change, in the order of the file."""
    code = blanked(text)
    found = list(numbers(code))
    for word, replacements in FLIPS.items():
        for match in re.finditer(re.escape(word), code):
            found += [(match.start(), match.end(), each) for each in replacements]
    for match in re.finditer(r"(?<=[( ])!(?=[\w(])", code):
        found.append((match.start(), match.end(), ""))
    for match in CALLS.finditer(code):
        first, behind = arguments_end(code, match.end())
        found.append((match.start(), behind, "(" + text[match.end():first] + ")"))
    for match in STATEMENT.finditer(code):
        line = match[0]
        if line.count("(") == line.count(")") and not re.match(r" +[\w:<>]+[*&]? \w+( = |;|\{)",
                                                               line):
            found.append((match.start(), match.end(), " " * 2 + ";"))
    return sorted(set(found))


class Mutant:
    def __init__(self, text, change):
        first, behind, replacement = change
        self.text = text[:first] + replacement + text[behind:]
        self.line = text.count("\n", 0, first) + 1
        begin = text.rfind("\n", 0, first) + 1
        end = text.find("\n", behind)
        self.before = " ".join(text[begin:end].split())
        self.after = " ".join((text[begin:first] + replacement + text[behind:end]).split())


def known_survivors():
    """{(file, before, after): reason}, from blocks of three lines separated by a blank line."""
    blocks = [block.splitlines() for block in SURVIVORS.read_text().split("\n\n")]
    known = {}
    for block in blocks:
        lines = [line for line in block if line and not line.startswith("#")]
        if not lines:
            continue
        file, reason = lines[0].split(": ", 1)
        known[(file, lines[1][2:], lines[2][2:])] = reason
    return known


def stale(known):
    """Rows of known survivors that are no change of any subject as it reads now."""
    possible = set()
    for file in {file for file, _ in SUBJECTS.values()} & {row[0] for row in known}:
        text = (SOURCE / file).read_text()
        mutants = [Mutant(text, change) for change in mutations(text)]
        possible |= {(file, mutant.before, mutant.after) for mutant in mutants}
    return [f"{file}: {before}" for file, before, after in known
            if (file, before, after) not in possible]


def run(command, timeout=None, **options):
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", timeout=timeout, **options)
    except subprocess.TimeoutExpired:
        return None


def forgotten():
    """Files of offline that are neither changed here nor reports."""
    folder = SOURCE / "offline/src"
    names = [path.relative_to(folder).with_suffix("").as_posix()
             for path in sorted(folder.rglob("*.cpp"))]
    return [name for name in names if name not in OFFLINE and name not in REPORTS]


def program(test):
    """The program that must be built for a test."""
    return "stylet-organ" if test[0].endswith(".py") else test[0]


def prepare(folder, subjects):
    """Makes a copy of the sources that can be changed, configured like any release build, so that
    ccache has its objects."""
    copy = folder / "source"
    for each in copy.glob("*"):
        if each.name != "build":
            shutil.rmtree(each) if each.is_dir() else each.unlink()
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns(".git", "build"),
                    dirs_exist_ok=True)
    for each, _ in SUBJECTS.values():
        (copy / each).touch()  # newer than the object of the last mutant of a subject
    offline = any(SUBJECTS[each][0].startswith("offline/") for each in subjects)
    linker = "-fuse-ld=lld" if shutil.which("ld.lld") else ""
    done = run(["cmake", "-G", "Ninja", "-S", copy, "-B", copy / BUILD,
                f"-DSTYLET_WITH_OFFLINE={'ON' if offline else 'OFF'}",
                "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_EXE_LINKER_FLAGS={linker}"])
    if done.returncode != 0:
        sys.exit(done.stdout[-3000:] + "\nmutation.py: the unchanged sources do not configure")
    os.environ["CCACHE_BASEDIR"] = str(copy)
    # There is no shared data beside the copy.
    os.environ.setdefault("STYLET_DATA", str(SOURCE.parent / "shared/data"))
    os.environ |= {"STYLET_BIN": str(copy / BUILD / "bin"), "STYLET_SOURCE": str(copy),
                   "GTEST_FAIL_FAST": "1"}


def passes(folder, test, timeout=None):
    """Whether a test passes."""
    command = [folder / "source" / BUILD / "bin" / test[0], *test[1:]]
    if test[0].endswith(".py"):
        command = ["/usr/bin/python3", SOURCE / "tests/offline" / test[0], "--failfast", *test[1:]]
    done = run(command, timeout, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES)))
    return done is not None and done.returncode == 0


def limit_s(folder, test):
    """Time limit of a test: ten times what it takes on the unchanged sources, plus 10 s."""
    done = run(["ninja", "-C", folder / "source" / BUILD, program(test)])
    if done.returncode != 0:
        sys.exit(done.stdout[-3000:] + "\nmutation.py: the unchanged sources do not build")
    start = time.monotonic()
    if not passes(folder, test):
        sys.exit(f"mutation.py: {test} fails without a change")
    return 10 + 10 * (time.monotonic() - start)


def put(target, text):
    """Writes a source only if the text differs, so that otherwise its object stays up to date."""
    if target.read_text() != text:
        target.write_text(text)


def killer(folder, target, unchanged, mutant, tests, measured):
    """The first test that fails, or `compiler`, or None if all pass. That test is tried first on
    the next mutant. `measured`: time limits of the tests that any mutant has needed so far."""
    for test in tests:
        if tuple(test) not in measured:
            put(target, unchanged)
            measured[tuple(test)] = limit_s(folder, test)
        put(target, mutant.text)
        if run(["ninja", "-C", folder / "source" / BUILD, program(test)]).returncode != 0:
            return "compiler"
        if not passes(folder, test, measured[tuple(test)]):
            tests.remove(test)
            tests.insert(0, test)
            return " ".join(each for each in test if isinstance(each, str))
    return None


def check(folder, subject, sample, known, measured):
    """The survivors that are not explained in the list."""
    file, tests = SUBJECTS[subject][0], list(SUBJECTS[subject][1])
    target = folder / "source" / file
    text = target.read_text()
    changes = mutations(text)
    if sample and sample < len(changes):
        changes = [changes[i * len(changes) // sample] for i in range(sample)]
    count, explained, unexplained, start = {}, 0, [], time.monotonic()
    for number, change in enumerate(changes, 1):
        mutant = Mutant(text, change)
        is_known = (file, mutant.before, mutant.after) in known
        by = None if is_known else killer(folder, target, text, mutant, tests, measured)
        count[by or "nobody"] = count.get(by or "nobody", 0) + 1
        if is_known:
            explained += 1
        elif by is None:
            unexplained.append(mutant)
            print(f"{file}:{mutant.line}: survived\n- {mutant.before}\n+ {mutant.after}\n",
                  flush=True)
        if number % 20 == 0:
            print(f"    {subject}: {number} of {len(changes)}", flush=True)
    put(target, text)
    by_whom = ", ".join(f"{name} {times}" for name, times in sorted(count.items()))
    print(f"{file}: {len(changes)} mutants, killed by: {by_whom}; {explained} survivors explained, "
          f"{len(unexplained)} not; {time.monotonic() - start:.0f} s", flush=True)
    return unexplained


def check_explained(folder, subject, known, measured):
    """The known survivors that do not survive."""
    file, tests = SUBJECTS[subject][0], list(SUBJECTS[subject][1])
    target = folder / "source" / file
    text = target.read_text()
    mutants = [mutant for mutant in (Mutant(text, change) for change in mutations(text))
               if (file, mutant.before, mutant.after) in known]
    killed = []
    for mutant in mutants:
        by = killer(folder, target, text, mutant, tests, measured)
        fate = f"killed by {by}" if by else "survives"
        print(f"{file}:{mutant.line}: {fate}\n- {mutant.before}\n"
              f"+ {mutant.after}\n", flush=True)
        if by is not None:
            killed.append(mutant)
    put(target, text)
    print(f"{file}: {len(mutants)} survivors explained, {len(killed)} of them killed", flush=True)
    return killed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("subjects", nargs="*",
                        help=f"kernel, hal, offline, or of {', '.join(SUBJECTS)}; none: all")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build" / "mutation")
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--explained", action="store_true")
    options = parser.parse_args()
    if forgotten():
        sys.exit(f"mutation.py: {', '.join(forgotten())}: expected in OFFLINE or REPORTS")
    subjects = []
    for each in options.subjects or ("kernel", "hal", "offline"):
        of_folder = [name for name, (file, _) in SUBJECTS.items() if file.startswith(each + "/")]
        of_folder = MESH_READERS if each == "mesh_readers" else of_folder
        subjects += of_folder or [each]
        if not of_folder and each not in SUBJECTS:
            parser.error(f"{each}: expected kernel, hal, offline, or one of {', '.join(SUBJECTS)}")
    folder = options.build.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    known, measured = known_survivors(), {}
    if stale(known):
        sys.exit("\n".join(stale(known)) +
                 f"\nmutation.py: {SURVIVORS.name}: expected rows that are changes of a subject")
    prepare(folder, subjects)
    wrong = [mutant for each in subjects
             for mutant in (check_explained(folder, each, known, measured) if options.explained
                            else check(folder, each, options.sample, known, measured))]
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
