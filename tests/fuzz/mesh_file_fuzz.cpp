// Reads anything as a mesh file.
#include "engine/mesh_file.hpp"

#include <cstring>

#include "cullet/model.hpp"
#include "engine/hash.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/small_seeds.hpp"

namespace cullet::fuzz {
namespace {

std::vector<Bytes> make_seeds() {
    Mesh pair;  // two triangles and a point that belongs to none
    pair.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 3, 3}};
    pair.triangles = {{0, 1, 2}, {2, 1, 3}};
    return {encode_mesh_file(pair), encode_mesh_file(globe(false)), encode_mesh_file(globe(true))};
}

void put(Bytes& file, size_t place, uint64_t value) {
    std::memcpy(file.data() + place, &value, sizeof value);
}

void seal(Bytes& file, bool is_resized) {
    if (file.size() < 64) return;
    if (is_resized) put(file, 40, file.size() - 64);
    put(file, 48, hash_bytes(file.data() + 64, file.size() - 64, 0));
    put(file, 56, hash_bytes(file.data(), 56, 0));
}

bool read(std::span<const uint8_t> file) {
    const Result<Mesh> mesh = parse_mesh_file(file, "fuzz.cmesh");
    if (!mesh) return false;
    // What the reader lets through can be written again, and looked at by the cook's first stage.
    const Bytes again = encode_mesh_file(*mesh);
    if (again.size() != file.size() || std::memcmp(again.data(), file.data(), file.size()) != 0)
        give_up("a mesh file was read that no mesh gives");
    if (mesh->triangles.size() > 1000) return true;
    (void)examine_mesh(
        {mesh->positions.data(), mesh->positions.size(), mesh->triangles[0].data(), mesh->triangles.size()});
    return true;
}

}  // namespace

const Format mesh_file{"mesh_file", make_seeds, seal, read};

}  // namespace cullet::fuzz
