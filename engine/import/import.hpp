// The parts of cullet_import, the program that meets strangers' files: assimp runs in a child process with limits, and
// what the child hands back is read as strictly as any other mesh file.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

constexpr unsigned kImporterVersion =
    4;  // raise it when the same file gives another mesh: cached ones are then made anew

struct ImportLimits {
    uint64_t memory_mib = 1024;  // address space; also the largest mesh file
    unsigned seconds = 10;       // processor time
};

/// By the clock, so that a machine with other work to do does not refuse a good file, and a file that makes the reader
/// wait for nothing does not stay: 14 s for 10 s of processor time.
inline double longest_wait(const ImportLimits& limits) {
    return std::max(limits.seconds + 1.0, 1.4 * limits.seconds);
}

/// Any model that can be read as one mesh, in metres: by the unit of the file or its format. Without one, numbers are
/// metres. Node transforms are applied (a mirroring one turns the winding), and skins are taken as their joints rest.
/// Polygons are cut into triangles. Points are joined where all three coordinates are equal. Triangles with a repeated
/// corner, lines and points are left out. May crash, hang or throw: call it inside run_limited only.
struct ConvertedModel {
    Mesh mesh;
    uint64_t collapsed = 0;  // triangles left out
    uint64_t joined = 0;     // points of the file that were equal to another
    uint64_t left_out = 0;   // lines and points, among them faces of an OBJ with one or two corners
    uint64_t unusable_normals = 0, unusable_uvs = 0;  // of corners; taken from the triangle, set to 0
    std::vector<std::string> notes;  // sentences, each with its full stop: what the file holds and the mesh does not
};
Result<ConvertedModel> convert_model(const std::string& path);

/// What a child left behind: bytes, and a line for the person; or a sentence why not.
struct Delivery {
    std::vector<uint8_t> bytes;
    std::string line;
};

/// Called ten times a second while one waits, with the seconds gone.
using Waiting = std::function<void(double seconds)>;

/// Runs work in a child with limits on memory, time, file size and system calls (it opens files to read and nothing
/// else), and without the files and sockets that are open here. However the child ends, and at the latest when the
/// clock has run out, this returns. `subject` begins the sentences.
Result<Delivery> run_limited(const std::string& subject, const ImportLimits& limits,
                             const std::function<Result<Delivery>()>& work, const Waiting& waiting = {});

}  // namespace cullet
