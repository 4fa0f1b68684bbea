#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/import/import_mesh.hpp"
#include "engine/import/sanitized.hpp"
#include "engine/math.hpp"
#include "engine/mesh_file.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

const std::string kProgram = build_folder() + "/cullet_import";

fs::path test_data() {
    if (const char* folder = std::getenv("CULLET_TEST_DATA")) return folder;
    return fs::path(source_folder()) / "../shared/data";
}

/// A folder of its own for each test, empty at the beginning, gone at the end.
class Import : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("import_test." + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string file(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    std::string cache() const { return folder_ / "cache"; }
    size_t cached_files() const {
        if (!fs::exists(cache())) return 0;
        return static_cast<size_t>(std::distance(fs::directory_iterator(cache()), fs::directory_iterator()));
    }

    /// The import program behind a script that counts its imports and gives another version.
    std::string counting_program(const std::string& version) {
        const std::string path =
            file("counting", "#!/bin/sh\nif [ \"$1\" = --version ]; then echo " + version + "; exit 0; fi\necho >> '" +
                                 (folder_ / "imports").string() + "'\nexec '" + kProgram + "' \"$@\"\n");
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
    size_t imports() const {
        std::error_code none;
        const auto size = fs::file_size(folder_ / "imports", none);
        return none ? 0 : size;
    }

    fs::path folder_;
};

struct ProgramRun {
    int exit_code = -1;
    double seconds = 0;
    std::string said;  // standard output and standard error
};

std::string quoted(const std::string& text) {
    return "'" + text + "'";
}

ProgramRun run(const std::string& in, const std::string& out, const std::string& options = "") {
    const auto begin = std::chrono::steady_clock::now();
    ProgramRun result;
    FILE* pipe =
        popen((quoted(kProgram) + " " + quoted(in) + " " + quoted(out) + " " + options + " 2>&1").c_str(), "r");
    char buffer[512];
    for (size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.said.append(buffer, n);
    const int status = pclose(pipe);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

double volume_of(const Mesh& mesh) {
    double six_volumes = 0;
    for (const auto& t : mesh.triangles)
        six_volumes +=
            dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]])));
    return six_volumes / 6;
}

const char* const kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";

TEST_F(Import, ACubeOfSixQuadsHasEightVerticesTwelveTrianglesAndVolumeOne) {
    auto mesh = import_mesh(file("cube.obj", kCube), kProgram, cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    EXPECT_EQ(mesh->name, "cube");
    EXPECT_EQ(mesh->positions.size(), 8u);
    EXPECT_EQ(mesh->triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(volume_of(*mesh), 1.0);
}

TEST_F(Import, CoordinatesOfAnObjMayBeginWithTheirPoint) {
    auto mesh = import_mesh(file("points.obj", "v .5 -.5 0\nv 1.5\t.25 +.75\nv 0 .5e1 .0\nusemtl .x\nf 1 2 3\n"),
                            kProgram, cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    ASSERT_EQ(mesh->positions.size(), 3u);
    EXPECT_EQ(mesh->positions[0], (Vec3{0.5f, -0.5f, 0}));
    EXPECT_EQ(mesh->positions[1], (Vec3{1.5f, 0.25f, 0.75f}));
    EXPECT_EQ(mesh->positions[2], (Vec3{0, 5, 0}));
}

TEST_F(Import, CoordinatesBeginWithTheirPointWhateverEndsTheLine) {
    const std::string lines[] = {"# by hand", "v .5 \\", ".25 0",     "v 1.5 .25 .75",
                                 "v\t\\",     ".0 2 0",  "usemtl .x", "f 1 2 3"};
    for (const std::string end : {"\n", "\r\n"}) {
        std::string text;
        for (const std::string& line : lines) text += line + end;
        const auto mesh = import_mesh(file("m.obj", text), kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        ASSERT_EQ(mesh->positions.size(), 3u);
        EXPECT_EQ(mesh->positions[0], (Vec3{0.5f, 0.25f, 0}));
        EXPECT_EQ(mesh->positions[1], (Vec3{1.5f, 0.25f, 0.75f}));
        EXPECT_EQ(mesh->positions[2], (Vec3{0, 2, 0}));
    }
    const auto old =
        import_mesh(file("m.obj", "# by hand\rv .5 .25 0\rv 1.5 .25 .75\rv .0 2 0\rf 1 2 3\r"), kProgram, cache());
    ASSERT_TRUE(old.ok()) << old.error();
    ASSERT_EQ(old->positions.size(), 3u);
    EXPECT_EQ(old->positions[0], (Vec3{0.5f, 0.25f, 0}));
    EXPECT_EQ(old->positions[2], (Vec3{0, 2, 0}));
}

TEST_F(Import, EqualBytesAreImportedOnceAndOtherBytesAnew) {
    const std::string program = counting_program("version 1");
    const auto first = import_mesh(file("cube.obj", kCube), program, cache());
    ASSERT_TRUE(first.ok()) << first.error();
    const auto second = import_mesh(file("box.obj", kCube), program, cache());
    ASSERT_TRUE(second.ok()) << second.error();
    EXPECT_EQ(second.value().name, "box");
    EXPECT_EQ(second.value().triangles, first.value().triangles);
    EXPECT_EQ(imports(), 1u);
    EXPECT_TRUE(import_mesh(file("cube.obj", std::string(kCube) + "\n"), program, cache()).ok());
    EXPECT_EQ(imports(), 2u);
}

TEST_F(Import, AnotherVersionOfTheProgramImportsAnew) {
    const std::string path = file("cube.obj", kCube);
    for (const char* version : {"1", "2", "2"}) ASSERT_TRUE(import_mesh(path, counting_program(version), cache()).ok());
    EXPECT_EQ(imports(), 2u);
    FILE* pipe = popen((quoted(kProgram) + " --version").c_str(), "r");
    char said[64] = "";
    EXPECT_NE(std::fgets(said, sizeof said, pipe), nullptr);
    EXPECT_EQ(pclose(pipe), 0);
    unsigned importer = 0, major = 0;
    EXPECT_EQ(std::sscanf(said, "cullet_import %u, assimp %u.", &importer, &major), 2) << said;
    EXPECT_GE(importer, 2u);
}

TEST_F(Import, ADamagedCacheEntryIsMadeAnew) {
    const std::string path = file("cube.obj", kCube);
    ASSERT_TRUE(import_mesh(path, kProgram, cache()).ok());
    const fs::path cached = fs::directory_iterator(cache())->path();
    fs::resize_file(cached, 100);
    EXPECT_TRUE(import_mesh(path, kProgram, cache()).ok());
    EXPECT_TRUE(read_mesh_file(cached).ok());
}

TEST_F(Import, AMeshFileNeedsNoProgram) {
    const std::string path = folder_ / "cube.cmesh";
    ASSERT_EQ(run(file("cube.obj", kCube), path).exit_code, 0);
    const auto mesh = import_mesh(path, "/no/such/program", cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    EXPECT_EQ(mesh.value().positions.size(), 8u);
    EXPECT_EQ(cached_files(), 0u);
}

TEST_F(Import, AMissingFileOrProgramIsOneSentence) {
    const auto no_file = import_mesh(folder_ / "none.obj", kProgram, cache());
    ASSERT_FALSE(no_file.ok());
    EXPECT_NE(no_file.error().find("none.obj: cannot open the file"), std::string::npos) << no_file.error();
    const auto no_program = import_mesh(file("cube.obj", kCube), "/no/such/program", cache());
    ASSERT_FALSE(no_program.ok());
    EXPECT_NE(no_program.error().find("cannot be started"), std::string::npos) << no_program.error();
}

TEST_F(Import, TheProgramDoesNotGetTheOpenFilesOfTheGame) {
    // In place of the import program, one that tells what is open in it.
    const std::string teller = file("teller", "#!/bin/sh\nls -l /proc/$$/fd >&2\nexit 2\n");
    fs::permissions(teller, fs::perms::owner_all);
    const std::string secret = file("secret", "text");
    const int open = ::open(secret.c_str(), O_RDWR);
    const auto mesh = import_mesh(file("cube.obj", kCube), teller, cache());
    ::close(open);
    ASSERT_FALSE(mesh.ok());
    EXPECT_NE(mesh.error().find("/dev/null"), std::string::npos) << mesh.error();
    EXPECT_EQ(mesh.error().find("secret"), std::string::npos) << mesh.error();
}

TEST_F(Import, NormalsTextureCoordinatesAndMaterialsBelongToCorners) {
    const std::string path = file("quad.obj",
                                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\n"
                                  "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    const auto mesh = import_mesh(path, kProgram, cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    ASSERT_EQ(mesh.value().corner_normals.size(), 6u);
    ASSERT_EQ(mesh.value().corner_uvs.size(), 6u);
    ASSERT_EQ(mesh.value().materials.size(), 2u);
    for (const Vec3 n : mesh.value().corner_normals) EXPECT_EQ(n.z, 1);
    for (size_t c = 0; c < 6; ++c) {
        const Vec3 p = mesh.value().positions[mesh.value().triangles[c / 3][c % 3]];
        EXPECT_EQ(p.x, mesh.value().corner_uvs[c].x);
    }
}

TEST_F(Import, WhatIsLeftOutOrReplacedIsCounted) {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn nan 0 0\nvn 0 0 1\nvn 0 0 0\nvt 1e30 0\nvt 0 1\n"
        "f 1/1/1 2/2/2 3/2/3\nf 2 4 3\nf 1 2\nf 3\nf 4\n";
    const ProgramRun result = run(file("faces.obj", text), folder_ / "out.cmesh");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.said.find("left out 3 lines and points"), std::string::npos) << result.said;
    EXPECT_NE(result.said.find("unusable normals from the triangle"), std::string::npos) << result.said;
    EXPECT_NE(result.said.find("set 1 unusable texture coordinate to 0"), std::string::npos) << result.said;
}

TEST_F(Import, WhoWaitsIsToldTheSecondsThatTheProgramHas) {
    const std::string slow =
        file("slow", "#!/bin/sh\n[ \"$1\" = --version ] || sleep 0.5\nexec '" + kProgram + "' \"$@\"\n");
    fs::permissions(slow, fs::perms::owner_all);
    size_t told = 0;
    const auto waiting = [&told](double seconds, double most) {
        EXPECT_LE(seconds, most);
        EXPECT_EQ(most, 14);
        ++told;
    };
    EXPECT_TRUE(import_mesh(file("cube.obj", kCube), slow, cache(), waiting).ok());
    EXPECT_GE(told, 1u);
}

TEST_F(Import, ANameOfTwoLinesIsOneSentence) {
    const std::string path = folder_ / "two\nlines.obj";
    const auto expect_one_line = [](const std::string& error) {
        EXPECT_NE(error.find("two lines.obj: "), std::string::npos) << error;
        EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
    };
    expect_one_line(import_mesh(path, kProgram, cache()).error());
    std::ofstream(path) << kCube;
    std::string notes = "none yet";
    const auto cube = import_mesh(path, kProgram, cache(), {}, &notes);
    EXPECT_TRUE(cube.ok()) << cube.error();
    EXPECT_EQ(notes, "");
    const ProgramRun by_hand = run(path, folder_ / "out.cmesh");
    EXPECT_EQ(std::count(by_hand.said.begin(), by_hand.said.end(), '\n'), 1) << by_hand.said;
    std::ofstream(path) << "v 0 0 0\n";
    expect_one_line(import_mesh(path, kProgram, cache()).error());
    expect_one_line(read_mesh_file(path).error());
    expect_one_line(read_whole_file(path, 2).error());
    expect_one_line(write_mesh_file(Mesh{}, path).error());
    fs::remove(path);
    fs::create_directory(path);
    expect_one_line(write_whole_file(std::vector<uint8_t>{1}, path).error());
}

TEST_F(Import, TooLittleTimeIsOneSentenceAndNoFile) {
    std::string face = "f";
    std::string text;
    for (int i = 0; i < 60000; ++i) {  // one polygon, which takes assimp far more than a second to cut
        text.append("v ").append(std::to_string(i)).append(" ");
        text.append(std::to_string(0.001 * i * i)).append(" 0\n");
        face.append(" ").append(std::to_string(i + 1));
    }
    const ProgramRun late = run(file("slow.obj", text + face + "\n"), folder_ / "out.cmesh", "--seconds 1");
    EXPECT_EQ(late.exit_code, 2);
    EXPECT_LT(late.seconds, 5);
    EXPECT_NE(late.said.find("was not read within 1 s"), std::string::npos) << late.said;
    EXPECT_FALSE(fs::exists(folder_ / "out.cmesh"));
}

TEST_F(Import, TooLittleMemoryIsOneSentenceAndMoreIsAnOption) {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers do not work under limits";
    std::string text;
    constexpr int kSide = 300;
    for (int i = 0; i < kSide * kSide; ++i)
        text.append("v ")
            .append(std::to_string(i % kSide))
            .append(" ")
            .append(std::to_string(i / kSide))
            .append(" 0\n");
    for (int i = 1; i < kSide * (kSide - 1); ++i) {
        if (i % kSide == 0) continue;
        for (const int corner : {i, i + 1, i + kSide + 1, i + kSide})
            text.append(corner == i ? "f " : " ").append(std::to_string(corner));
        text.append("\n");
    }
    const std::string path = file("large.obj", text);
    const ProgramRun little = run(path, folder_ / "out.cmesh", "--memory-mib 64");
    EXPECT_EQ(little.exit_code, 2);
    EXPECT_NE(little.said.find("needs more than 64 MiB to read"), std::string::npos) << little.said;
    EXPECT_EQ(std::count(little.said.begin(), little.said.end(), '\n'), 1) << little.said;
    EXPECT_FALSE(fs::exists(folder_ / "out.cmesh"));
    const ProgramRun enough = run(path, folder_ / "out.cmesh", "--memory-mib 1024 --seconds 20");
    EXPECT_EQ(enough.exit_code, 0) << enough.said;
}

TEST_F(Import, APipeOrAFolderInPlaceOfAModelIsRefusedAtOnce) {
    const std::string pipe = folder_ / "pipe.obj", folder = folder_ / "folder.obj";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_directory(folder);
    for (const std::string& path : {pipe, folder}) {
        const ProgramRun result = run(path, folder_ / "out.cmesh");
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_LT(result.seconds, 5);
        EXPECT_FALSE(import_mesh(path, kProgram, cache()).ok());
    }
}

TEST_F(Import, TheModelIsNotWrittenOverItself) {
    const std::string model = file("cube.obj", kCube), link = folder_ / "link.obj", twin = folder_ / "twin.obj";
    fs::create_symlink(model, link);
    fs::create_hard_link(model, twin);
    for (const std::string& out : {model, (folder_ / "." / "cube.obj").string(), link, twin}) {
        const ProgramRun result = run(model, out);
        EXPECT_EQ(result.exit_code, 2) << out;
        EXPECT_EQ(result.said, out + ": is the model itself. Give the mesh file another name.\n");
        EXPECT_EQ(fs::file_size(model), std::string(kCube).size());
    }
}

TEST_F(Import, OnlyOrdinaryFilesAreWrittenOver) {
    const std::string model = file("cube.obj", kCube), pipe = folder_ / "pipe", to_pipe = folder_ / "to_pipe",
                      nowhere = folder_ / "nowhere", inner = folder_ / "inner";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink(pipe, to_pipe);
    fs::create_symlink(folder_ / "none", nowhere);
    fs::create_directory(inner);
    const auto before = std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    for (const std::string& out : {pipe, to_pipe, nowhere, inner}) {
        const ProgramRun result = run(model, out);
        EXPECT_EQ(result.exit_code, 2) << out;
        EXPECT_EQ(result.said.rfind(out + ": is ", 0), 0u) << result.said;
        EXPECT_EQ(std::count(result.said.begin(), result.said.end(), '\n'), 1) << result.said;
        EXPECT_FALSE(write_whole_file(std::vector<uint8_t>{1}, out).ok()) << out;
    }
    EXPECT_TRUE(fs::is_fifo(fs::symlink_status(pipe)));
    EXPECT_TRUE(fs::is_symlink(to_pipe));
    EXPECT_TRUE(fs::is_symlink(nowhere));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), before);
}

TEST_F(Import, AFileBehindALinkIsWrittenAndTheLinkStays) {
    fs::create_directory(folder_ / "inner");
    const std::string there = file("inner/there.cmesh", "old"), link = folder_ / "link.cmesh";
    fs::create_symlink("inner/there.cmesh", link);
    EXPECT_EQ(run(file("cube.obj", kCube), link).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(read_mesh_file(there).ok());
}

TEST_F(Import, WrongArgumentsAreOneSentence) {
    const ProgramRun result = run(file("cube.obj", kCube), folder_ / "out.cmesh", "--seconds 0");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(std::count(result.said.begin(), result.said.end(), '\n'), 1) << result.said;
    EXPECT_EQ(run(file("cube.obj", kCube), folder_ / "none" / "out.cmesh").exit_code, 2);
}

TEST_F(Import, AFileThatIsNotThereOrEmptyIsToldApartFromOneThatCannotBeRead) {
    for (const std::string name : {"no.stl", "no.obj", "no.glb", "no.gltf", "no.dae", "no.3mf", "no.fbx", "no"}) {
        const std::string path = folder_ / name;
        const std::string missing = run(path, folder_ / "out.cmesh").said;
        EXPECT_EQ(missing, path + ": cannot open the file (No such file or directory). Check the path.\n");
        EXPECT_EQ(run(file(name, ""), folder_ / "out.cmesh").said, path + ": is empty. Copy or export it again.\n");
    }
}

TEST_F(Import, FilesOfVolumesAreRefusedAsThat) {
    for (const std::string name : {"a.vtk", "a.vtu", "a.node", "A.ELE"})
        EXPECT_NE(run(file(name, "4 3 0 0\n"), folder_ / "out.cmesh").said.find("tetrahedra and other volumes"),
                  std::string::npos)
            << name;
}

TEST_F(Import, AnOptionWithoutItsNumberSaysWhatItWants) {
    for (const std::string option : {"--seconds", "--memory-mib"})
        EXPECT_EQ(run(file("cube.obj", kCube), folder_ / "out.cmesh", option).said,
                  "cullet_import: " + option + ": wants a number. See cullet_import --help.\n");
}

/// One triangle, whose corners stand in the buffer of that name.
std::string triangle_gltf(const std::string& uri, const std::string& images = "") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":
        [{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"images":[)" +
           images + R"(],"buffers":[{"byteLength":36,"uri":")" + uri + "\"}]}";
}

std::string triangle_bytes(float size = 1) {
    const float triangle[9] = {0, 0, 0, size, 0, 0, 0, size, 0};
    return {reinterpret_cast<const char*>(triangle), sizeof triangle};
}

std::string images_named(const std::string& name, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += (i == 0 ? "{\"uri\":\"" : ",{\"uri\":\"") + name + "\"}";
    return text;
}

/// Bytes that this process has read, by whatever call.
uint64_t bytes_read_here() {
    std::ifstream file("/proc/self/io");
    std::string word;
    uint64_t bytes = 0;
    file >> word >> bytes;
    return bytes;
}

TEST_F(Import, AModelCannotReachOutOfItsFolder) {
    fs::create_directories(folder_ / "inner");
    file("outside.bin", triangle_bytes());
    file("inner/beside.bin", triangle_bytes());
    const ProgramRun beside = run(file("inner/beside.gltf", triangle_gltf("beside.bin")), folder_ / "beside.cmesh");
    EXPECT_EQ(beside.exit_code, 0) << beside.said;
    const ProgramRun outside =
        run(file("inner/outside.gltf", triangle_gltf("../outside.bin")), folder_ / "outside.cmesh");
    EXPECT_EQ(outside.exit_code, 2) << outside.said;
}

TEST_F(Import, APercentEncodedNameIsDecodedWhereItIsNotThereAsItStands) {
    const std::string path = file("m.gltf", triangle_gltf("my%20ch%C3%A4ir.bin"));
    for (const float size : {1.0f, 2.0f}) {
        file("my ch\xC3\xA4ir.bin", triangle_bytes(size));
        const auto mesh = import_mesh(path, kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        EXPECT_EQ(mesh->positions[1].x, size);  // the cache knows it by the same name
    }
    file("my%20ch%C3%A4ir.bin", triangle_bytes(3));
    const auto literal = import_mesh(path, kProgram, cache());
    ASSERT_TRUE(literal.ok()) << literal.error();
    EXPECT_EQ(literal->positions[1].x, 3);
}

TEST_F(Import, AnEncodedNameLeadsNoFartherThanAPlainOne) {
    fs::create_directories(folder_ / "in%20ner");
    file("outside.bin", triangle_bytes());
    file("in%20ner/side.bin", triangle_bytes());
    for (const char* name :
         {"..%2Foutside.bin", "%2e%2e/outside.bin", "side.bin%00", "side.bin%", "side.bin%2", "%zz"}) {
        const ProgramRun result = run(file("in%20ner/m.gltf", triangle_gltf(name)), folder_ / "out.cmesh");
        EXPECT_EQ(result.exit_code, 2) << name << ": " << result.said;
    }
    EXPECT_EQ(run(file("in%20ner/m.gltf", triangle_gltf("sid%65.bin")), folder_ / "out.cmesh").exit_code, 0);
}

TEST_F(Import, AModelAndItsBufferMayBeLinksIntoDifferentFoldersOfAStore) {
    for (const char* name : {"store/a", "store/b", "scene/sub"}) fs::create_directories(folder_ / name);
    file("store/a/m.gltf", triangle_gltf("side.bin"));
    file("store/b/side.bin", triangle_bytes());
    file("store/b/secret.bin", triangle_bytes());
    const std::string link = folder_ / "scene/m.gltf";
    fs::create_symlink("../store/a/m.gltf", link);
    fs::create_symlink("../store/b/side.bin", folder_ / "scene/side.bin");
    const ProgramRun linked = run(link, folder_ / "out.cmesh");
    EXPECT_EQ(linked.exit_code, 0) << linked.said;
    for (const float size : {1.0f, 2.0f}) {
        file("store/b/side.bin", triangle_bytes(size));
        const auto mesh = import_mesh(link, kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        EXPECT_EQ(mesh->positions[1].x, size);
    }
    // The model leads no farther: not by its name, not through a linked folder, not round and round.
    fs::create_symlink("../store/b", folder_ / "scene/folder");
    fs::create_symlink("loop.bin", folder_ / "scene/loop.bin");
    const std::string absolute = folder_ / "store/b/secret.bin";
    for (const std::string& name : {std::string("../store/b/secret.bin"), std::string("sub/../../store/b/secret.bin"),
                                    std::string("folder/secret.bin"), std::string("loop.bin"), absolute}) {
        file("store/a/m.gltf", triangle_gltf(name));
        const ProgramRun result = run(link, folder_ / "out.cmesh");
        EXPECT_EQ(result.exit_code, 2) << name << ": " << result.said;
    }
}

TEST_F(Import, BesideAModelThatIsNoLinkALinkIsFollowedInsideTheFolderOnly) {
    fs::create_directories(folder_ / "inner/sub");
    file("outside.bin", triangle_bytes());
    file("inner/sub/inside.bin", triangle_bytes());
    fs::create_symlink("../outside.bin", folder_ / "inner/out.bin");
    fs::create_symlink("sub/inside.bin", folder_ / "inner/in.bin");
    EXPECT_EQ(run(file("inner/m.gltf", triangle_gltf("in.bin")), folder_ / "out.cmesh").exit_code, 0);
    EXPECT_EQ(run(file("inner/m.gltf", triangle_gltf("out.bin")), folder_ / "out.cmesh").exit_code, 2);
}

TEST_F(Import, AFileIsReadOnceForTheCacheHoweverOftenAModelNamesIt) {
    if (bytes_read_here() == 0) GTEST_SKIP() << "no /proc/self/io";
    constexpr uint64_t kLarge = 16u << 20;
    file("side.bin", triangle_bytes());
    fs::resize_file(file("large.png", ""), kLarge);
    const std::string path = file("m.gltf", triangle_gltf("side.bin", images_named("large.png", 100)));
    const uint64_t before = bytes_read_here();
    const auto mesh = import_mesh(path, kProgram, cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    EXPECT_LT(bytes_read_here() - before, 2 * kLarge);
    EXPECT_EQ(cached_files(), 1u);
}

/// As a .glb; its own first buffer holds nothing that counts.
std::string binary_gltf(std::string json) {
    const auto replace = [&json](const std::string& what, const std::string& with) {
        json.replace(json.find(what), what.size(), with);
    };
    replace("\"buffer\":0", "\"buffer\":1");
    replace("\"buffers\":[", "\"buffers\":[{\"byteLength\":4},");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](uint64_t value) {
        return std::string{static_cast<char>(value), static_cast<char>(value >> 8), static_cast<char>(value >> 16), 0};
    };
    return "glTF" + word(2) + word(32 + json.size()) + word(json.size()) + "JSON" + json + word(4) +
           std::string("BIN\0", 4) + "none";
}

TEST_F(Import, ANewBufferBesideAModelIsANewModelForTextAndBinaryGltf) {
    const std::string json = triangle_gltf("side.bin");
    for (const std::string& path : {file("m.gltf", json), file("m.glb", binary_gltf(json))})
        for (const float size : {1.0f, 2.0f, 3.0f}) {
            file("side.bin", triangle_bytes(size));
            const auto mesh = import_mesh(path, kProgram, cache());
            ASSERT_TRUE(mesh.ok()) << mesh.error();
            EXPECT_EQ(mesh->positions[1].x, size) << path;
        }
}

TEST_F(Import, WhatTheMeshDoesNotHoldIsToldByTheProgramByTheImportAndByTheCache) {
    file("side.bin", triangle_bytes());
    std::string json = triangle_gltf("side.bin");
    json.insert(json.size() - 1, R"(,"cameras":[{},{}],"extensionsUsed":["X_NEW"])");
    const std::string path = file("m.gltf", json);
    const std::string wanted = "Read without the extension \"X_NEW\". Not kept: 2 cameras.";
    const ProgramRun alone = run(path, folder_ / "out.cmesh");
    EXPECT_NE(alone.said.find(". " + wanted + "\n"), std::string::npos) << alone.said;
    EXPECT_EQ(std::count(alone.said.begin(), alone.said.end(), '\n'), 1) << alone.said;
    for (int round = 0; round < 2; ++round) {
        std::string notes = "old";
        ASSERT_TRUE(import_mesh(path, kProgram, cache(), {}, &notes).ok());
        EXPECT_EQ(notes, wanted) << round;
    }
    std::string notes = "old";
    ASSERT_TRUE(import_mesh(file("cube.obj", kCube), kProgram, cache(), {}, &notes).ok());
    EXPECT_EQ(notes, "");
}

/// Whoever finds a mesh in the cache finds its notes: where these cannot be written, the mesh is not kept.
TEST_F(Import, AMeshIsNotKeptWithoutItsNotes) {
    file("side.bin", triangle_bytes());
    std::string json = triangle_gltf("side.bin");
    json.insert(json.size() - 1, R"(,"cameras":[{}])");
    const std::string path = file("m.gltf", json);
    const auto entries = [this] {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(cache()))
            if (entry.path().extension() == ".cmesh") found.push_back(entry.path());
        return found;
    };
    ASSERT_TRUE(import_mesh(path, kProgram, cache()).ok());
    ASSERT_EQ(entries().size(), 1u);
    const fs::path mesh = entries()[0], notes = mesh.string() + ".notes";
    ASSERT_TRUE(fs::exists(notes));
    fs::remove(mesh);
    fs::remove(notes);
    fs::create_directory(notes);
    std::string said;
    ASSERT_TRUE(import_mesh(path, kProgram, cache(), {}, &said).ok());
    EXPECT_EQ(said, "Not kept: 1 camera.");
    EXPECT_TRUE(entries().empty());
    fs::remove(notes);
    ASSERT_TRUE(import_mesh(path, kProgram, cache()).ok());
    EXPECT_EQ(entries().size(), 1u);
    EXPECT_TRUE(fs::is_regular_file(notes));
}

TEST_F(Import, ABinaryGltfOfAnyNameBelongsToItsBuffersAndOneOfWideLettersIsNotKept) {
    const std::string json = triangle_gltf("side.bin");
    for (const float size : {1.0f, 2.0f}) {
        file("side.bin", triangle_bytes(size));
        const auto mesh = import_mesh(file("m.model", binary_gltf(json)), kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        EXPECT_EQ(mesh->positions[1].x, size);
    }
    const size_t kept = cached_files();
    std::string wide = "\xFF\xFE";
    for (const char c : json) wide += std::string{c, '\0'};
    for (const float size : {1.0f, 2.0f}) {
        file("side.bin", triangle_bytes(size));
        const auto mesh = import_mesh(file("m.gltf", wide), kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        EXPECT_EQ(mesh->positions[1].x, size);
    }
    EXPECT_EQ(cached_files(), kept);
}

TEST_F(Import, TheCacheLooksAtNoFileThatTheModelMayNotOpen) {
    fs::create_directories(folder_ / "inner");
    file("inner/side.bin", triangle_bytes());
    fs::resize_file(file("outside.png", ""), 16u << 20);
    const std::string names = images_named("../outside.png", 1) + "," + images_named(folder_ / "outside.png", 1);
    const std::string path = file("inner/m.gltf", triangle_gltf("side.bin", names));
    const uint64_t before = bytes_read_here();
    ASSERT_TRUE(import_mesh(path, kProgram, cache()).ok());
    EXPECT_LT(bytes_read_here() - before, 1u << 20);
    file("outside.png", "other");
    ASSERT_TRUE(import_mesh(path, kProgram, cache()).ok());
    EXPECT_EQ(cached_files(), 1u);
}

TEST_F(Import, AModelThatNamesTooManyOrTooLargeFilesIsImportedAndNotKept) {
    file("side.bin", triangle_bytes());
    const auto many =
        import_mesh(file("many.gltf", triangle_gltf("side.bin", images_named("a", 5000))), kProgram, cache());
    EXPECT_TRUE(many.ok()) << many.error();
    EXPECT_EQ(cached_files(), 0u);
    fs::resize_file(file("a.png", ""), (1ull << 29) + 1);  // a hole: no disk is used
    const auto large =
        import_mesh(file("large.gltf", triangle_gltf("side.bin", images_named("a.png", 1))), kProgram, cache());
    EXPECT_TRUE(large.ok()) << large.error();
    EXPECT_EQ(cached_files(), 0u);
}

struct Wanted {
    const char* file;
    size_t vertices, triangles;
};

TEST_F(Import, EveryThickShellHasTheKnownCounts) {
    if (!fs::exists(test_data() / "thick_shell"))
        GTEST_SKIP() << "no test data at " << test_data() << "; set CULLET_TEST_DATA";
    const Wanted all[] = {{"bottle_tall.glb", 1180, 2352},
                          {"curtains_double.glb", 208, 320},
                          {"dogue.gltf", 2651, 4736},
                          {"espresso_cup.gltf", 14682, 29360},
                          {"husky.glb", 962, 1920},
                          {"plastic_monobloc_chair_01_1k.gltf", 1660, 3356},
                          {"plate.glb", 104, 204},
                          {"spot_control_mesh.obj", 188, 372},
                          {"spot_triangulated.obj", 2930, 5856},
                          {"vase.glb", 112, 220},
                          {"bowl.ply", 4754, 9504},
                          {"curtain.ply", 4745, 9216},
                          {"husky_loop1.ply", 3842, 7680},
                          {"vase_thick.ply", 5506, 11008}};
    for (const Wanted& wanted : all) {
        const auto mesh = import_mesh(test_data() / "thick_shell" / wanted.file, kProgram, cache());
        ASSERT_TRUE(mesh.ok()) << mesh.error();
        EXPECT_EQ(mesh.value().positions.size(), wanted.vertices) << wanted.file;
        EXPECT_EQ(mesh.value().triangles.size(), wanted.triangles) << wanted.file;
    }
}

TEST_F(Import, AMirroredNodeKeepsTheOutsideOutside) {
    if (!fs::exists(test_data() / "hostile"))
        GTEST_SKIP() << "no test data at " << test_data() << "; set CULLET_TEST_DATA";
    const auto mesh = import_mesh(test_data() / "hostile" / "mirrored_node.gltf", kProgram, cache());
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    EXPECT_GT(volume_of(mesh.value()), 3.8);  // a sphere of radius 1, 224 triangles
}

TEST_F(Import, HostileFilesAreRefusedInTimeWithOneSentenceAndNoFile) {
    if (!fs::exists(test_data() / "hostile"))
        GTEST_SKIP() << "no test data at " << test_data() << "; set CULLET_TEST_DATA";
    const char* const files[] = {"accessor_count_4_billion.gltf",
                                 "assimp_BoxWithInfinites.glb",
                                 "assimp_OutOfMemory.off",
                                 "assimp_RecursiveNodes.gltf",
                                 "assimp_crash-30d6d0.ply",
                                 "assimp_empty.ply",
                                 "assimp_invalid.off",
                                 "assimp_malformed.obj",
                                 "assimp_payload_JVN42386607.ply",
                                 "buffer_outside_folder.gltf",
                                 "bufferview_past_end.gltf",
                                 "count_4294967295.stl",
                                 "counts_huge.off",
                                 "face_count_2_billion.ply",
                                 "face_index_negative.ply",
                                 "face_index_past_end.ply",
                                 "index_overflow.obj",
                                 "lines_and_points_only.obj",
                                 "no_faces.obj",
                                 "node_cycle.gltf",
                                 "node_doubling_26.gltf",
                                 "sparse_index_past_end.gltf",
                                 "truncated.glb",
                                 "truncated.ply",
                                 "truncated.stl",
                                 "vertex_count_4_billion.ply"};
    const fs::path out = folder_ / "out";
    fs::create_directories(out);
    for (const char* name : files) {
        const std::string path = test_data() / "hostile" / name;
        const ProgramRun result = run(path, out / "mesh.cmesh");
        EXPECT_EQ(result.exit_code, 2) << name;
        EXPECT_LT(result.seconds, kIsSanitized ? 60 : 15) << name;
        EXPECT_EQ(result.said.rfind(path + ": ", 0), 0u) << result.said;
        EXPECT_EQ(std::count(result.said.begin(), result.said.end(), '\n'), 1) << result.said;
        EXPECT_TRUE(fs::is_empty(out)) << name;
    }
}

}  // namespace
}  // namespace cullet
