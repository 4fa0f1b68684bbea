#include "systems/structures/tetrahedra/draw_solid.hpp"

#include <numeric>

#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

struct Runs {
    std::array<uint16_t, kMostDrawnMaterials> id{};
    uint32_t count = 0;

    // The smallest ids, rising; a larger one counts as the last of them.
    void add(uint16_t material) {
        uint32_t at = 0;
        while (at < count && id[at] < material) ++at;
        if (at == kMostDrawnMaterials || (at < count && id[at] == material)) return;
        if (count < kMostDrawnMaterials) ++count;
        for (uint32_t i = count - 1; i > at; --i) id[i] = id[i - 1];
        id[at] = material;
    }
    uint32_t run_of(uint16_t material, bool is_inside) const {
        uint32_t at = 0;
        while (at + 1 < count && id[at] < material) ++at;
        const auto kind = static_cast<uint32_t>(is_inside ? SurfaceKind::Crack : SurfaceKind::Outer);
        return kind * kMostDrawnMaterials + at;
    }
};

void write_triangle(Read<SolidRows> rows, const SkinRange& skin, uint32_t t, ViewVertex* to) {
    const SkinTriangles& all = rows.skin_triangles;
    for (uint32_t k = 0; k < 3; ++k) {
        const Vec3d place = rows.skin_points.place[skin.points.first + all.corners[t][k]];
        const auto& n = all.normals[t];
        to[k].position = place.to_float();
        to[k].normal = {n[3 * k], n[3 * k + 1], n[3 * k + 2]};
        to[k].uv = {all.uv[t][2 * k], all.uv[t][2 * k + 1]};
    }
}

}  // namespace

uint32_t view_rows_of_solid(Read<SolidRows> rows, Row<Structures> structure) {
    return 3 * skin_of(rows, structure).triangles.count;
}

void draw_solid_body(DrawnSolids rows, Row<Bodies> body) {
    Bodies& bodies = rows.bodies;
    const SkinRange skin = skin_of(rows, bodies.structure[body]);
    const SkinTriangles& all = rows.skin_triangles;
    const uint32_t first = skin.triangles.first, end = first + skin.triangles.count;
    Range &vertices = bodies.view_vertices[body], &indices = bodies.view_indices[body];
    CULLET_ASSERT(3 * skin.triangles.count <= vertices.capacity && 3 * skin.triangles.count <= indices.capacity,
                  "%u triangles do not fit the ranges of what is drawn", skin.triangles.count);
    Runs runs;
    for (uint32_t t = first; t < end; ++t) runs.add(all.drawn_material[t]);
    std::array<uint32_t, kMostRuns> counts{}, next{};
    for (uint32_t t = first; t < end; ++t) ++counts[runs.run_of(all.drawn_material[t], all.is_inside[t])];
    std::exclusive_scan(counts.begin(), counts.end(), next.begin(), 0u);
    for (uint32_t t = first; t < end; ++t) {
        const uint32_t place = next[runs.run_of(all.drawn_material[t], all.is_inside[t])]++;
        write_triangle(rows, skin, t, rows.view_vertices.vertex.data() + vertices.first + 3 * place);
        for (uint32_t k = 0; k < 3; ++k) {
            rows.view_indices.index[indices.first + 3 * place + k] = 3 * place + k;
            rows.view_indices.source[indices.first + 3 * place + k] = t - first;
        }
    }
    for (uint32_t& count : counts) count *= 3;
    vertices.count = indices.count = 3 * skin.triangles.count;
    bodies.run_indices[body] = counts;
    bodies.drawn_materials[body] = runs.id;
    bodies.redrawn[body] = {0, skin.triangles.count};
    ++bodies.view_stamp[body];
}

}  // namespace cullet
