#include "systems/structures/shell/cook/shell_of_surface.hpp"

#include "systems/cook/materials.hpp"
#include "systems/structures/shell/cook/build_shell.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {
namespace {

// Of a material with a grain a triangle has four links of stiffness in place of one. Without room for a run on it no
// threshold was measured: any touch was a hit, and no load too much.
constexpr uint32_t kRoomOfGrain = 4;

// The surface's corners and triangles with the mesh's attributes found again.
struct SourceArrays {
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
    std::vector<uint16_t> materials;
};
// Normals that cooking made itself follow a sheet that was turned since.
SourceArrays attributes_of(const Surface& surface, const Mesh& mesh, bool has_made_normals) {
    SourceArrays arrays;
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const uint32_t source = surface.source_triangles[t];
        const Triangle& c = surface.triangles[t];
        const Vec3d flat =
            cross(surface.positions[c[1]] - surface.positions[c[0]], surface.positions[c[2]] - surface.positions[c[0]]);
        for (int k = 0; k < 3; ++k) {
            const size_t corner = 3 * size_t{source} + surface.source_corners[t][static_cast<size_t>(k)];
            if (!mesh.corner_normals.empty()) arrays.normals.push_back(mesh.corner_normals[corner]);
            if (has_made_normals && dot(Vec3d(arrays.normals.back()), flat) < 0)
                arrays.normals.back() = -arrays.normals.back();
            if (!mesh.corner_uvs.empty()) arrays.uvs.push_back(mesh.corner_uvs[corner]);
        }
        if (!mesh.materials.empty()) arrays.materials.push_back(mesh.materials[source]);
    }
    return arrays;
}

}  // namespace

Result<std::shared_ptr<Model::Contents>> shell_of_surface(const Cooking& from, const Surface& surface,
                                                          const Extrusion& extrusion) {
    const auto vertices = static_cast<uint32_t>(surface.positions.size());
    const auto elements = static_cast<uint32_t>(surface.triangles.size());
    const uint32_t room = from.material.settings.across_young_modulus > 0 ? kRoomOfGrain : 1;
    const auto contents = std::make_shared<Model::Contents>(cooking_limits(room * vertices, elements));
    Workbench& state = contents->state;
    fill_materials(state.materials);
    const SourceArrays arrays = attributes_of(surface, from.fine, from.has_made_normals);
    ShellSource source;
    source.position = surface.positions;
    source.inward = extrusion.direction;
    source.depth = extrusion.depth;
    source.corner = surface.triangles;
    source.neighbour = surface.neighbours;
    source.corner_normal = arrays.normals;
    source.corner_uv = arrays.uvs;
    source.drawn_material = arrays.materials;
    source.is_degenerate = extrusion.is_degenerate_element;
    source.wanted_depth = from.settings.thickness;
    const Result<Row<Structures>> shell =
        build_shell(state, source,
                    material_row({state.materials, state.material_traits, state.structures}, from.material.settings,
                                 from.material.grain));
    if (!shell) return Error{shell.error()};
    contents->shell = shell.value();
    group_fragments(ShellView(state, contents->shell), {});  // numbers the parts, for find_parts
    return contents;
}

}  // namespace cullet
