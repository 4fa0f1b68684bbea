// Sheets of metal to dent, and how deep they are.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "components/body_id.hpp"
#include "components/state.hpp"
#include "components/workbench.hpp"
#include "cullet/model.hpp"
#include "engine/mesh.hpp"
#include "sample_game/metal/metal_bench.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/metal_shell/cook/metal_rows.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {

/// Of the body's vertices from where cooking put them, m: the farthest.
inline double deepest(const World& world, BodyId body) {
    auto& state = const_cast<State&>(world.contents().data.state);
    const MetalView metal(state, state.bodies.structure[body_row(state.bodies, body)]);
    double most = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        most = std::max(most, double{length(state.vertices.rest[metal.shell.vertex(v)] -
                                            metal.vertices().original[metal.vertex(v)])});
    return most;
}

inline Model cook_metal(Mesh mesh, float thickness = 1e-3f, const std::string& material = "steel") {
    CookSettings settings;
    settings.model = "metal_shell";
    settings.material = material;
    settings.thickness = thickness;
    settings.longest_edge = 100;
    const Result<Model> made = cook(view_of_mesh(mesh), settings);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return *made;
}

/// A cooked shell in rows of its own.
struct MetalSheet {
    explicit MetalSheet(const Model& model, uint32_t cells = 0) {
        const Model::Contents& from = *model.contents;
        rows = std::make_unique<Workbench>(cooking_limits(from.report.vertices, from.report.elements));
        rows->materials.append(from.state.materials.size());
        for (uint32_t m = 0; m < from.state.materials.size(); ++m)
            rows->materials.copy_rows(from.state.materials, m, m, 1);
        rows->material_traits.append(from.state.material_traits.size());
        for (uint32_t m = 0; m < from.state.material_traits.size(); ++m)
            rows->material_traits.copy_rows(from.state.material_traits, m, m, 1);
        const char* full = "";
        shell = import_shell(*rows, from.state, from.shell, &full);
        if (!shell.exists()) ADD_FAILURE() << full, std::abort();
        if (cells > 0) {
            release_metal(*rows, shell);
            MetalCookSettings settings;
            settings.cells.count = cells;
            const auto made = make_metal_rows(*rows, shell, settings);
            if (!made) ADD_FAILURE() << made.error(), std::abort();
        }
    }
    MetalView view() const { return {*rows, shell}; }
    /// Holds what lies on the border of the box of the original shape, in x and y.
    void clamp(double width, double height) {
        const ShellView of(*rows, shell);
        for (uint32_t v = 0; v < of.vertex_count(); ++v) {
            const Vec3 p = rows->vertices.rest[of.vertex(v)];
            if (std::fabs(p.x) > 0.4999 * width || std::fabs(p.y) > 0.4999 * height) {
                rows->vertices.is_pinned[of.vertex(v)] = 1;
                rows->vertices.inverse_mass[of.vertex(v)] = 0;
            }
        }
        measure_pins(*rows, shell);
    }
    std::unique_ptr<Workbench> rows;
    Row<Structures> shell;
};

}  // namespace cullet::test
