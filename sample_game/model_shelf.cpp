#include "sample_game/model_shelf.hpp"

#include <fmt/format.h>

#include "engine/hash.hpp"
#include "sample_game/props.hpp"

namespace cullet {
namespace {

template <class T>
uint64_t fold(const std::vector<T>& values, uint64_t hash) {
    return hash_bytes(values.data(), values.size() * sizeof(T), hash + values.size());
}

/// Everything that decides how the model comes out.
std::string label(const Mesh& mesh, const CookSettings& s) {
    uint64_t hash = fold(mesh.positions, 1);
    hash = fold(mesh.triangles, hash);
    hash = fold(mesh.corner_normals, hash);
    hash = fold(mesh.corner_uvs, hash);
    hash = fold(mesh.materials, hash);
    return fmt::format("{} {:016x} {} {} {} {} {} {}", mesh.positions.size(), hash, model_label(s), material_label(s),
                       s.thickness, s.longest_edge, s.seed, mesh.name);
}

}  // namespace

Result<CachedModel> ModelShelf::cook(const Mesh& mesh, const CookSettings& settings, const std::string& folder) {
    const std::string key = label(mesh, settings);
    if (const auto found = models_.find(key); found != models_.end()) return found->second;
    Result<CachedModel> model = cook_cached(mesh, settings, folder);
    if (model.ok()) models_.emplace(key, model.value());
    return model;
}

}  // namespace cullet
