// SPDX-License-Identifier: Apache-2.0
// stylet-organ as users call it: exit codes, one line for what it refuses, no file left behind,
// bounded memory.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/outputs.h"
#include "base/refusal.h"
#include "offline_support.h"

namespace stylet::test {
namespace {

using Json = nlohmann::json;

struct Result {
  int exit_code = -1;  // 128 + signal if killed
  std::string out, err;
  long peak_kib = 0;
};

#ifdef STYLET_SANITIZED
constexpr bool kSanitized = true;  // shadow memory alone takes 20 TB of addresses
#else
constexpr bool kSanitized = false;
#endif

// Runs the program as a child process with a limited address space.
Result run(const std::vector<std::string>& arguments, rlim_t memory_bytes = 1ULL << 30U) {
  const Scratch scratch;
  const std::string out = (scratch.folder / "out").string();
  const std::string err = (scratch.folder / "err").string();
  std::vector<std::string> words{STYLET_ORGAN};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlim_t most = kSanitized ? RLIM_INFINITY : memory_bytes;
    const rlimit limit{most, most};
    const rlimit seconds{120, 120};
    if (::setrlimit(RLIMIT_AS, &limit) != 0 || ::setrlimit(RLIMIT_CPU, &seconds) != 0 ||
        std::freopen(out.c_str(), "w", stdout) == nullptr ||
        std::freopen(err.c_str(), "w", stderr) == nullptr) {
      ::_exit(126);
    }
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(out), slurp(err),
          usage.ru_maxrss};
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

void expect_one_line(const std::string& text, const std::string& word) {
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_NE(text.find(word), std::string::npos) << text;
}

// ---- ill-formed input ---------------------------------------------------------------------------

// Files whose surface is closed or nearly closed must become organs. The files named here have no
// such surface, or are damaged, and must be refused. Any other file may end either way.
const std::vector<std::string> kMustBuild{"cgal_elephant-with-holes.off",
                                          "cgal_pig.stl",
                                          "cgal_head.off",
                                          "cgal_blobby-shuffled.off",
                                          "cgal_tet-shuffled.off",
                                          "cgal_cube-ouvert.off",
                                          "assimp_box_longline.obj",
                                          "assimp_testmixed.obj",
                                          "assimp_Spider_binary.stl",
                                          "assimp_sphereWithHole.stl",
                                          "assimp_Wuson.ply",
                                          "trimesh_joined_tetrahedra.obj",
                                          "trimesh_multibody.stl",
                                          "trimesh_wallhole.obj",
                                          "trimesh_whitespace.off",
                                          "sofa_canapVM.obj",
                                          "sofa_c_open.obj"};
const std::vector<std::string> kMustRefuse{"assimp_OutOfMemory.off",
                                           "assimp_empty.obj",
                                           "assimp_empty.off",
                                           "assimp_malformed.obj",
                                           "assimp_testline.obj",
                                           "cgal_triangle.off",
                                           "trimesh_empty.stl",
                                           "tinyobj_test-nan.obj",
                                           "nibabel_example4d.nii.gz",
                                           "trimesh_ply_empty_header.ply",
                                           "tinyobj_issue-140-zero-face-idx.obj"};

TEST(Broken, EveryFileEndsAsAnOrganOrAsOneLine) {
  const auto folder = data_folder() / "broken";
  SKIP_WITHOUT(folder);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    ++files;
    SCOPED_TRACE(name);
    const Scratch scratch;
    const std::string organ = (scratch.folder / "a.organ").string();
    const Result r = run(
        {"build", entry.path().string(), "--units", "cm", "--voxels-across", "20", "-o", organ});
    const auto listed = [&](const auto& list) {
      return std::find(list.begin(), list.end(), name) != list.end();
    };
    if (listed(kMustBuild)) {
      EXPECT_EQ(r.exit_code, 0) << r.err;
    }
    if (listed(kMustRefuse)) {
      EXPECT_EQ(r.exit_code, 1);
    }
    if (r.exit_code == 0) {
      EXPECT_EQ(run({"check", organ}).exit_code, 0);
      EXPECT_EQ(files_in(scratch.folder), 1U);
    } else {
      EXPECT_EQ(r.exit_code, 1);
      expect_one_line(r.err, "expected");
      EXPECT_EQ(files_in(scratch.folder), 0U);
    }
  }
  EXPECT_EQ(files, 42U);
}

TEST(Broken, AHeaderCannotClaimMemory) {
  const auto path = data_folder() / "broken" / "assimp_OutOfMemory.off";
  SKIP_WITHOUT(path);
  const Scratch scratch;
  const Result r =
      run({"build", path.string(), "-o", (scratch.folder / "a.organ").string()}, 100ULL << 20U);
  EXPECT_EQ(r.exit_code, 1);
  expect_one_line(r.err, "353535235358");
  if (!kSanitized) {
    EXPECT_LT(r.peak_kib, 64 * 1024);
  }
}

TEST(Broken, CutRealFilesAreRefused) {
  const auto path = data_folder() / "organs" / "openhelp_Kidney_left.stl";
  SKIP_WITHOUT(path);
  const std::string whole = slurp(path);
  const Scratch scratch;
  for (const std::size_t size :
       {std::size_t{10}, std::size_t{84}, whole.size() / 2, whole.size() - 1}) {
    const auto cut = scratch.write("cut.stl", whole.substr(0, size));
    const Result r = run({"build", cut.string(), "-o", (scratch.folder / "a.organ").string()});
    EXPECT_EQ(r.exit_code, 1);
    expect_one_line(r.err, "cut.stl");
    EXPECT_EQ(files_in(scratch.folder), 1U);
  }
}

// ---- a real liver -------------------------------------------------------------------------------

Result build_liver(const std::filesystem::path& mesh, const std::string& organ) {
  return run({"build", mesh.string(), "--units", "mm", "--voxel-mm", "5", "-o", organ});
}

TEST(LiverTimed, BuildsInTwentySecondsAndOneGibibyte) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes its own time and memory";
  const auto path = data_folder() / "organs" / "openhelp_Liver.stl";
  SKIP_WITHOUT(path);
  const Scratch scratch;
  const auto start = std::chrono::steady_clock::now();
  const Result r = build_liver(path, (scratch.folder / "liver.organ").string());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_LT(r.peak_kib, 1024 * 1024);
}

TEST(Liver, KeepsItsVolumeItsSourceAndFewBytes) {
  const auto path = data_folder() / "organs" / "openhelp_Liver.stl";
  SKIP_WITHOUT(path);
  const Scratch scratch;
  const std::string organ = (scratch.folder / "liver.organ").string();
  const Result r = build_liver(path, organ);
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json info = Json::parse(run({"info", organ, "--json"}).out);
  EXPECT_LE(info["bytes"]["lattice_per_voxel"].get<double>(), 12);
  EXPECT_LE(info["bytes"]["per_vertex"].get<int>(), 16);
  EXPECT_NEAR(info["volume_ml"].get<double>(), 1817.7, 0.02 * 1817.7);
  EXPECT_EQ(info["provenance"]["sources"][0]["path"], "openhelp_Liver.stl");
  EXPECT_EQ(info["provenance"]["sources"][0]["sha256"],
            "491391f279e0acaabee46f1d094b4595101e80cf8b1d8f138305a28c4a5449f5");
  EXPECT_EQ(info["kernel_memory"]["status"], "ok");
  EXPECT_GT(info["kernel_memory"]["state_bytes"].get<std::size_t>(), 0U);
}

// ---- commands -----------------------------------------------------------------------------------

TEST(Program, PhantomsOfAllKinds) {
  const Scratch scratch;
  for (const std::string kind : {"block", "layered", "ball", "liver"}) {
    const std::string organ = (scratch.folder / (kind + ".organ")).string();
    const std::string mesh = (scratch.folder / (kind + ".off")).string();
    const Result r = run({"phantom", kind, "--voxel-mm", "8", "-o", organ, "--mesh-out", mesh});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(run({"check", organ}).exit_code, 0);
    const std::string again = (scratch.folder / "again.organ").string();
    EXPECT_EQ(run({"build", mesh, "--units", "m", "--voxel-mm", "8", "-o", again}).exit_code, 0);
  }
}

TEST(Program, APhantomsFileSaysWhereItIsFiner) {
  const Scratch scratch;
  const std::string organ = (scratch.folder / "a.organ").string();
  ASSERT_EQ(run({"phantom", "ball", "--refine", "surface:1", "-o", organ}).exit_code, 0);
  EXPECT_NE(run({"info", organ}).out.find("--refine surface:1"), std::string::npos);
}

TEST(Program, SameCommandSameBytes) {
  const Scratch scratch;
  const auto one = scratch.folder / "one.organ", two = scratch.folder / "two.organ";
  ASSERT_EQ(run({"phantom", "liver", "-o", one.string()}).exit_code, 0);
  ASSERT_EQ(run({"phantom", "liver", "-o", two.string()}).exit_code, 0);
  EXPECT_EQ(slurp(one), slurp(two));
}

TEST(Program, WrongUsageExitsWithTwoARefusalWithOne) {
  const Scratch scratch;
  const std::string organ = (scratch.folder / "a.organ").string();
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"offline"}).exit_code, 2);
  EXPECT_EQ(run({"phantom", "cone", "-o", organ}).exit_code, 2);
  EXPECT_EQ(run({"phantom", "ball"}).exit_code, 2);
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_NE(run({"build", "--help"}).out.find("Examples"), std::string::npos);
  const std::vector<std::vector<std::string>> refused{
      {"phantom", "ball", "--tissue", "cheese", "-o", organ},
      {"phantom", "ball", "--refine", "labels:bone", "-o", organ},
      {"phantom", "ball", "--slide", "bone:gel", "-o", organ},
      {"phantom", "ball", "--fix", "x>", "-o", organ},
      {"phantom", "ball", "--fix", "x>1e999", "-o", organ},
      {"phantom", "ball", "--fix", "x=10", "-o", organ},
      {"phantom", "ball", "--fix", "{>10", "-o", organ},
      {"phantom", "ball", "--fix", "none", "--fix", "x>10", "-o", organ},
      {"phantom", "ball", "--size-mm", "9,9,9", "-o", organ},
      {"phantom", "liver", "--diameter-mm", "50", "-o", organ},
      {"phantom", "ball", "--fix", "box:900,900,900,901,901,901", "-o", organ},
      {"phantom", "ball", "--voxel-mm", "0.01", "-o", organ},
      {"phantom", "ball", "--voxel-mm", "-1", "-o", organ},
      {"phantom", "ball", "--voxel-mm", "nan", "-o", organ},
      {"phantom", "ball", "--diameter-mm", "nan", "-o", organ},
      {"phantom", "ball", "-o", (scratch.folder / "no" / "such" / "folder.organ").string()},
      {"build", (scratch.folder / "none.stl").string(), "-o", organ},
      {"build", scratch.folder.string(), "-o", organ}};
  for (const auto& arguments : refused) {
    const Result r = run(arguments);
    EXPECT_EQ(r.exit_code, 1) << arguments[3];
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_EQ(files_in(scratch.folder), 0U);
  }
}

// A cube of 50 mm.
void write_cube(const std::string& path) {
  std::ofstream(path) << "OFF\n8 12 0\n0 0 0\n50 0 0\n50 50 0\n0 50 0\n0 0 50\n50 0 50\n"
                         "50 50 50\n0 50 50\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n"
                         "3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
}

// An output never destroys an input, a device or a directory, and has the rights that the user's
// umask gives.
TEST(Program, OutputsDestroyNothing) {
  const Scratch scratch;
  const auto at = [&](const char* name) { return (scratch.folder / name).string(); };
  write_cube(at("cube.off"));
  const auto before = std::filesystem::file_size(at("cube.off"));
  std::filesystem::create_symlink(at("cube.off"), at("soft.organ"));
  const auto build_to = [&](const std::string& output) {
    return run({"build", at("cube.off"), "--units", "mm", "--voxel-mm", "10", "-o", output});
  };
  for (const char* name : {"cube.off", "soft.organ"}) {
    const Result r = build_to(at(name));
    EXPECT_EQ(r.exit_code, 1) << name;
    EXPECT_NE(r.err.find("this command reads this file"), std::string::npos) << r.err;
    EXPECT_EQ(std::filesystem::file_size(at("cube.off")), before);
  }
  EXPECT_NE(build_to("/dev/full").err.find("is a device"), std::string::npos);
  EXPECT_NE(build_to(scratch.folder.string()).err.find("is a directory"), std::string::npos);
  const mode_t mask = ::umask(077);
  EXPECT_EQ(build_to(at("mine.organ")).exit_code, 0);
  ::umask(mask);
  EXPECT_EQ(std::filesystem::status(at("mine.organ")).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::ofstream(at("mine.organ.sha256")) << std::string(64, '0') << "  mine.organ\n";
  EXPECT_EQ(build_to(at("mine.organ")).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(at("mine.organ.sha256")));
}

// Whatever prevents one of a command's outputs, either all outputs appear or every file is as it
// was.
TEST(Program, OutputsAppearTogetherOrNotAtAll) {
  const Scratch scratch;
  const auto at = [&](const char* name) { return (scratch.folder / name).string(); };
  write_cube(at("cube.off"));
  const auto build = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"build", at("cube.off"), "--voxel-mm",
                                   "10",    "-o",           at("a.organ")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  std::filesystem::create_directories(at("page/report.html"));  // where the report should be
  std::ofstream(at("file")) << "no folder";
  std::filesystem::create_directory(at("a.organ.sha256"));
  const std::vector<std::vector<std::string>> fails = {{"--report", at("page")},
                                                       {"--report", at("file")},
                                                       {"--report", at("file/below")},
                                                       {"--sum"}};
  for (const bool older : {false, true}) {
    if (older) std::ofstream(at("a.organ")) << "an older organ";
    const auto before = all_files(scratch.folder);
    for (const auto& more : fails) {
      const Result r = build(more);
      EXPECT_EQ(r.exit_code, 1) << more.back() << r.err;
      expect_one_line(r.err, scratch.folder.string());
      EXPECT_EQ(all_files(scratch.folder), before) << more.back();
    }
  }
  std::filesystem::remove(at("a.organ.sha256"));
  EXPECT_EQ(build({"--report", at("new/below"), "--sum"}).exit_code, 0);
  for (const char* name : {"a.organ.sha256", "new/below/report.html", "new/below/report.json"}) {
    EXPECT_TRUE(std::filesystem::exists(at(name))) << name;
  }
  const Result twice = run({"phantom", "ball", "-o", at("b.organ"), "--mesh-out", at("b.organ")});
  expect_one_line(twice.err, "would be written twice");
  EXPECT_FALSE(std::filesystem::exists(at("b.organ")));
}

// A signal between the first folder or temporary file and the last name ends the command, and every
// file is as it was; a signal that is ignored does not end it.
TEST(Outputs, SignalsWaitUntilFilesAreAsTheyWereOrComplete) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    for (const int after : {1, 2, 3}) {
      const Scratch scratch;
      scratch.write("a", "old");
      const auto before = all_files(scratch.folder);
      const auto write = [&](void (*handler)(int)) {
        (void)std::signal(signal, handler);  // as nohup does before it starts the program
        offline::Outputs outputs;
        outputs.add_folder(scratch.folder / "page");
        if (after == 1) (void)::raise(signal);
        outputs.add(scratch.folder / "a", std::string_view("new"));
        if (after == 2) (void)::raise(signal);
        outputs.add(scratch.folder / "page/b", std::string_view("new"));
        if (after == 3) (void)::raise(signal);
        outputs.commit();
      };
      EXPECT_EXIT(write(SIG_DFL), testing::KilledBySignal(signal), "");
      EXPECT_EQ(all_files(scratch.folder), before) << signal;
      const auto ignoring = [&] {
        write(SIG_IGN);
        std::exit(0);
      };
      EXPECT_EXIT(ignoring(), testing::ExitedWithCode(0), "");
      EXPECT_EQ(slurp(scratch.folder / "page/b"), "new");
      EXPECT_EQ(all_files(scratch.folder).size(), 3U);
    }
  }
}

// If an obstacle appears only when outputs are moved into place, every file is as it was.
TEST(Outputs, ALateFailureIsTakenBack) {
  const Scratch scratch;
  const auto at = [&](const char* name) { return scratch.folder / name; };
  scratch.write("old", "as it was");
  const auto before = all_files(scratch.folder);
  const auto refusal = [&](const std::function<void(offline::Outputs&)>& fill) {
    std::string said;
    try {
      offline::Outputs outputs;
      fill(outputs);
      outputs.commit();
    } catch (const offline::Refusal& refused) {
      said = refused.what();
    }
    return said;
  };
  // Somebody removes the folder of the last output in between.
  const std::string late = refusal([&](offline::Outputs& outputs) {
    outputs.add(at("old"), std::string_view("new"));
    outputs.add(at("fresh"), std::string_view("new"));
    outputs.add_folder(at("deep/page/"));
    outputs.add(at("deep/page/last"), std::string_view("new"));
    std::filesystem::remove_all(at("deep/page"));
  });
  EXPECT_NE(late.find("last: cannot be written: No such file"), std::string::npos) << late;
  EXPECT_EQ(all_files(scratch.folder), before);
  // A limit on the size of files, as on a full disk.
  rlimit most{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &most), 0);
  const rlimit small{1000, most.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = refusal([&](offline::Outputs& outputs) {
    outputs.add(at("old"), std::string_view("new"));
    outputs.add(at("large"), std::string_view(std::string(5000, 'x')));
  });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &most), 0);
  (void)std::signal(SIGXFSZ, handler);
  EXPECT_NE(said.find("large: cannot be written: File too large"), std::string::npos) << said;
  EXPECT_EQ(all_files(scratch.folder), before);
  // A signal that is blocked at first, as in a build that takes long.
  (void)std::signal(SIGHUP, [](int) {});
  EXPECT_EQ(refusal([&](offline::Outputs& outputs) {
              outputs.add(at("old"), std::string_view("new"));
              (void)::raise(SIGHUP);
            }),
            "stopped by Hangup: nothing was written");
  (void)std::signal(SIGHUP, SIG_DFL);
  EXPECT_EQ(all_files(scratch.folder), before);
}

// 64 voxels of 0.0001 mm, with a wall of centimetres around them: the product of the sizes once
// overflowed.
TEST(Program, WallsAroundTinyVoxelsAreRefusedBeforeMemoryIsTaken) {
  const Scratch scratch;
  const std::string map = (scratch.folder / "map.nrrd").string();
  const std::string recipe = (scratch.folder / "r.toml").string();
  std::ofstream(recipe)
      << "[tissues]\nliver = [5]\n[[wall]]\ntissue = \"fat\"\nthickness_mm = 20\n";
  for (const char* mm : {"1e-2", "1e-4", "1e-5", "1e-6", "3e-7"}) {
    std::string voxels(64, '\0');
    voxels[21] = voxels[22] = 5;
    std::ofstream(map, std::ios::binary)
        << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
        << "space directions: (" << mm << ",0,0) (0," << mm << ",0) (0,0," << mm
        << ")\nencoding: raw\nspace origin: (0,0,0)\n\n"
        << voxels;
    const Result r =
        run({"build", map, "--recipe", recipe, "-o", (scratch.folder / "a.organ").string()});
    EXPECT_EQ(r.exit_code, 1) << mm << ": " << r.out << r.err;
    EXPECT_NE(r.err.find("is the spacing right?"), std::string::npos) << r.err;
  }
}

TEST(Program, WidthsOfGapsAreBounded) {
  const Scratch scratch;
  const std::string mesh = (scratch.folder / "cube.off").string();
  write_cube(mesh);
  for (const char* width : {"fat:10485745", "fat:1500", "fat:inf", "fat:nan", "fat:0", "fat:-3"}) {
    const Result r = run({"build", mesh, "--units", "mm", "--fill-gaps", width, "-o",
                          (scratch.folder / "a.organ").string()});
    EXPECT_EQ(r.exit_code, 1) << width;
    EXPECT_NE(r.err.find("--fill-gaps"), std::string::npos) << width << ": " << r.err;
  }
}

TEST(Program, WarnsOfImplausibleSize) {
  const Scratch scratch;
  const std::string mesh = (scratch.folder / "a.off").string();
  const std::string organ = (scratch.folder / "a.organ").string();
  ASSERT_EQ(run({"phantom", "ball", "-o", organ, "--mesh-out", mesh}).exit_code, 0);
  const Result wrong = run({"build", mesh, "--units", "mm", "--voxel-mm", "0.1", "-o", organ});
  EXPECT_EQ(wrong.exit_code, 0) << wrong.err;
  EXPECT_TRUE(wrong.err.starts_with("stylet-organ: warning: the longest side is 0.0")) << wrong.err;
  EXPECT_EQ(run({"build", mesh, "--units", "m", "-o", organ}).err, "");
}

// A refusal that is caused by a wrong unit must let the user see that.
TEST(Program, RefusalsOfWrongUnitsNameTheSize) {
  const Scratch scratch;
  const std::string flat =
      scratch.write("flat.off", "OFF\n3 1 0\n0 0 0\n0.3 0 0\n0 0.2 0\n3 0 1 2\n").string();
  const std::string organ = (scratch.folder / "a.organ").string();
  const Result small = run({"build", flat, "--units", "mm", "--voxel-mm", "5", "-o", organ});
  EXPECT_EQ(small.exit_code, 1);
  expect_one_line(small.err, "flat.off: longest side 0.3 mm");
  expect_one_line(small.err, "other --units");
  const Result large =
      run({"build", flat, "--units", "m", "--scale", "100", "--voxels-across", "10", "-o", organ});
  EXPECT_EQ(large.exit_code, 1);
  const std::string far =
      scratch.write("far.off", "OFF\n3 1 0\n0 0 0\n1e300 0 0\n0 2 0\n3 0 1 2\n").string();
  expect_one_line(run({"build", far, "-o", organ}).err, "far.off: point 2 of 3: (1e+300, 0, 0)");
  expect_one_line(run({"build", flat, "--units", "inch", "-o", organ}).err, "side 7.62 mm");
  expect_one_line(large.err, "--voxels-across 10: voxel edge 3000 mm");
  expect_one_line(large.err, "check --units");
}

TEST(Program, LabelMapsNeedARecipe) {
  const Scratch scratch;
  const std::string map =
      scratch
          .write("seg.v1.nrrd",
                 "NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\n"
                 "space directions: (10,0,0) (0,10,0) (0,0,10)\nspace origin: (0,0,0)\n"
                 "encoding: raw\n\n" +
                     std::string(32, '\5') + std::string(32, '\7'))
          .string();
  const std::string recipe = scratch.write("r.toml", "[tissues]\nliver = [5]\n").string();
  const std::string organ = (scratch.folder / "a.organ").string();
  const Json listed = Json::parse(run({"labels", map, "--json"}).out);
  EXPECT_EQ(listed["labels"][1]["label"], 7);
  EXPECT_EQ(listed["labels"][1]["voxels"], 32);
  EXPECT_NEAR(listed["labels"][1]["volume_ml"].get<double>(), 32, 1e-9);
  EXPECT_NE(run({"labels", map}).out.find("       5          32            32\n"),
            std::string::npos);
  const Result built = run({"build", map, "--recipe", recipe, "-o", organ, "--json"});
  ASSERT_EQ(built.exit_code, 0) << built.err;
  const Json facts = Json::parse(built.out);
  EXPECT_EQ(facts["organ"]["name"], "seg");
  EXPECT_NEAR(facts["labels"][0]["filled_volume_ml"].get<double>(), 32, 0.32);
  std::filesystem::remove(organ);
  const std::string mesh_folder = (scratch.folder / "d.STL").string();
  std::filesystem::create_directory(mesh_folder);
  const std::pair<std::vector<std::string>, const char*> refused[] = {
      {{map}, "expected --recipe"},
      {{scratch.folder.string()}, "expected --recipe"},
      {{mesh_folder}, "d.STL: is a directory: expected a readable file"},
      {{map, map, "--recipe", recipe}, "2 inputs: expected one label map"},
      {{map, "--recipe", (scratch.folder / "none.toml").string()}, "no such file"}};
  for (const auto& [arguments, reason] : refused) {
    std::vector<std::string> all = {"build", "-o", organ};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result r = run(all);
    EXPECT_EQ(r.exit_code, 1);
    expect_one_line(r.err, reason);
    EXPECT_FALSE(std::filesystem::exists(organ));
  }
}

TEST(Program, OwnTissuesReplacePresetsOrSayWhatIsWrong) {
  const Scratch scratch;
  const std::string organ = (scratch.folder / "a.organ").string();
  const auto build_with = [&](const std::string& toml) {
    const auto file = scratch.write("own.toml", toml);
    return run({"phantom", "ball", "--tissue", "gel", "--materials", file.string(), "-o", organ});
  };
  ASSERT_EQ(build_with("[gel]\nyoungs_modulus_kpa = 12.5\nsource = \"lab\"\n").exit_code, 0);
  const Json info = Json::parse(run({"info", organ, "--json"}).out);
  EXPECT_DOUBLE_EQ(info["materials"][0]["youngs_modulus_kpa"].get<double>(), 12.5);
  EXPECT_EQ(info["materials"][0]["source"], "lab");
  expect_one_line(build_with("[gel]\n\nyoung = 3\n").err, "own.toml:3: young: unknown key");
  expect_one_line(build_with("[gel]\npoisson_ratio = 0.5\n").err,
                  "own.toml:2: poisson_ratio = 0.5: expected 0 to 0.49");
  expect_one_line(build_with("[gel]\npoisson_ratio = \"a\"\n").err, "own.toml:2");
  expect_one_line(build_with("[gel]\nstatic_friction_n_per_mm = 0.0\n").err, "at least coulomb");
  expect_one_line(build_with("gel = 3\n").err, "expected a table");
  expect_one_line(build_with("[gel]\nsource = 3\n").err, "own.toml:2: source: expected a string");
  expect_one_line(build_with("[gel\n").err, "own.toml:1");
  expect_one_line(build_with("[jelly]\ndensity_kg_per_m3 = 1000\n").err, "is missing");
}

TEST(Program, FilesThatCannotBeReadAreNamed) {
  const Scratch scratch;
  const std::string organ = (scratch.folder / "a.organ").string();
  const auto large = scratch.write("large.stl", "solid");
  std::filesystem::resize_file(large, (4ULL << 30U) + 1);  // a sparse file
  const std::string longest = (scratch.folder / (std::string(300, 'a') + ".stl")).string();
  for (const auto& [path, reason] :
       {std::pair{large.string(), "4294967297 bytes: expected at most"},
        {longest, "File name too long: expected a readable file"}}) {
    const Result r = run({"build", path, "-o", organ});
    EXPECT_EQ(r.exit_code, 1);
    expect_one_line(r.err, reason);
  }
}

// Everything that a report says of an open mesh with duplicate faces, under a name that HTML would
// interpret.
TEST(Program, ReportsSayWhatWasRepaired) {
  const Scratch scratch;
  const auto mesh = scratch.write(
      "a&b<c.off",
      "OFF\n9 12 0\n0 0 0\n50 0 0\n50 50 0\n0 50 0\n0 0 50\n50 0 50\n50 50 50\n0 50 50\n9 9 9\n"
      "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n"
      "3 2 7 6\n3 3 0 4\n3 0 2 1\n");
  const auto page = scratch.folder / "page";
  const Result r = run({"build", mesh.string(), "--units", "mm", "--voxel-mm", "10", "--report",
                        page.string(), "-o", (scratch.folder / "a.organ").string()});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::string html = slurp(page / "report.html");
  for (const char* part : {"a&amp;b&lt;c.off", "open", "1 duplicate triangles dropped",
                           "1 unused points dropped", "the mesh is open"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(html.find("a&b<c"), std::string::npos);
}

// Commands that show an organ say of a mesh what makes an organ of it, and still open an organ
// whose name ends as that of a mesh.
TEST(Program, TellsWhatMakesAnOrganOfAMesh) {
  const Scratch scratch;
  for (const std::string name : {"a.off", "a.STL"}) {
    const auto mesh = scratch.write(name, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    for (const std::string command : {"check", "info"}) {
      const Result r = run({command, mesh.string()});
      EXPECT_EQ(r.exit_code, 1);
      expect_one_line(r.err, name + ": a mesh: expected an organ file; `stylet-organ build` makes");
    }
  }
  const std::string organ = (scratch.folder / "ball.organ").string();
  ASSERT_EQ(run({"phantom", "ball", "-o", organ}).exit_code, 0);
  EXPECT_EQ(run({"info", scratch.write("b.off", slurp(organ)).string()}).exit_code, 0);
}

TEST(Program, ChecksExplainDamage) {
  const Scratch scratch;
  const std::string organ = (scratch.folder / "a.organ").string();
  ASSERT_EQ(run({"phantom", "ball", "-o", organ}).exit_code, 0);
  const std::string whole = slurp(organ);
  for (const std::string& bytes : {std::string(), std::string("hello"), whole.substr(0, 1000)}) {
    const auto bad = scratch.write("bad.organ", bytes);
    for (const std::string command : {"check", "info"}) {
      const Result r = run({command, bad.string()});
      EXPECT_EQ(r.exit_code, 1);
      expect_one_line(r.err, "expected");
    }
  }
}

}  // namespace
}  // namespace stylet::test
