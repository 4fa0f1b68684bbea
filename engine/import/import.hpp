// The parts of cullet_import, the program that meets strangers' files: assimp runs in a child process with limits, and
// what the child hands back is read as strictly as any other mesh file.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

constexpr unsigned kImporterVersion =
    2;  // raise it when the same file gives another mesh: cached ones are then made anew

struct ImportLimits {
    uint64_t memory_mib = 1024;  // address space; also the largest mesh file
    unsigned seconds = 10;       // processor time; it may take 1.4 times as long by the clock, and a second at least
};

/// Any model that assimp reads as one mesh in the scene's units: node transforms applied (a mirroring one turns the
/// winding), polygons cut into triangles, points joined where all three coordinates are equal, triangles with a
/// repeated corner, lines and points left out. May crash, hang or throw: call it inside run_limited only.
struct ConvertedModel {
    Mesh mesh;
    uint64_t collapsed = 0;  // triangles left out
    uint64_t joined = 0;     // points of the file that were equal to another
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

/// Control characters become blanks, and so many bytes are kept: messages quote strangers' files.
std::string one_line(std::string text, size_t most_bytes = 400);

}  // namespace cullet
