// The mesh file (.cmesh): what the importer writes and the only geometry that the library reads. Its reader believes
// nothing.
//
// Little-endian. 64 bytes of header, then the payload: chunks in the order NAME POSI TRIA [NORM] [TEXC] [MATE].
//
//     0  8 bytes  magic "cmesh\r\n\x1a"             32  u64  bytes of the name
//     8  u32      version, 1                        40  u64  bytes of the payload
//    12  u32      optional chunks: 1 2 4            48  u64  XXH3-64 of the payload
//    16  u64      vertices                          56  u64  XXH3-64 of the 56 bytes before
//    24  u64      triangles
//
// A chunk is four letters, u32 0, u64 bytes of data, and the data. These are f32 x 3 a vertex, u32 x 3 a triangle, f32
// x 9 (normals) and f32 x 6 (texture coordinates) a triangle, u16 a triangle.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

constexpr float kLargestCoordinate = 1e8f;  // m; above it cubes of lengths leave the range of float with room to spare
constexpr float kSmallestMeshExtent = 1e-6f;  // m; below it areas and volumes underflow
constexpr uint64_t kMostMeshRows = 1u << 28;  // vertices or triangles; three corners a triangle still count in 32 bits
constexpr uint64_t kLongestMeshName = 255;    // bytes

/// Control characters become blanks, and so many bytes are kept: sentences quote strangers' files and their names.
std::string one_line(std::string text, size_t most_bytes = 400);

/// What every mesh that enters the library fulfils. It has at least one triangle, indices below the vertex count,
/// corner arrays of the right length, and a printable name. Its coordinates are finite and of a size that can be
/// squared. Its normals are of length 1 or 0. Says nothing of shape: repeated corners, holes and crossings are the
/// business of cooking.
Result<void> validate_mesh(const Mesh& mesh, const std::string& name);

/// The name stands in sentences only. Refuses any byte string that encode_mesh_file of a valid mesh does not give;
/// allocates nothing before the counts are covered by the bytes that are there.
Result<Mesh> parse_mesh_file(std::span<const uint8_t> bytes, const std::string& name);
Result<Mesh> read_mesh_file(const std::string& path);

/// The bytes of any mesh, valid or not, with corner arrays of the right length.
std::vector<uint8_t> encode_mesh_file(const Mesh& mesh);
/// Validates and writes as write_whole_file does.
Result<void> write_mesh_file(const Mesh& mesh, const std::string& path);

/// True for bytes that begin like a mesh file.
bool is_mesh_file(std::span<const uint8_t> bytes);
/// The whole of an ordinary file of at most most_bytes.
Result<std::vector<uint8_t>> read_whole_file(const std::string& path, uint64_t most_bytes);
/// The file that write_whole_file puts in place: the path, or the ordinary file that a link there leads to. Refuses
/// whatever else stands there: renaming over a device, a pipe or a socket would remove it.
Result<std::string> target_of(const std::string& path);
/// Writes path.<thread>.part beside the target and renames it: there is never half a file under the name, whoever else
/// writes it at the same time.
Result<void> write_whole_file(std::span<const uint8_t> bytes, const std::string& path);

}  // namespace cullet
