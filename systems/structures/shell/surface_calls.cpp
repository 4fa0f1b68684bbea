#include "systems/structures/shell/surface_calls.hpp"

#include "systems/structures/shell/cut_surface.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/explosion.hpp"
#include "systems/structures/shell/patch_radius.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/prism.hpp"
#include "systems/structures/shell/struck_normal.hpp"

namespace cullet {
namespace {

float radius_of_patch(const RunRows& rows, Row<Structures> structure, float radius) {
    return patch_radius(rows.shells, rows.shell_of(structure), radius);
}

Vec3 normal_struck(RunRows& rows, Row<Structures> structure, Vec3 place, Vec3 normal, float radius) {
    return struck_normal(ShellView(rows, structure), place, normal, radius_of_patch(rows, structure, radius));
}

/// The nearest live vertex at rest.
Vec3 nearest_point(RunRows& rows, Row<Structures> structure, Vec3 place) {
    const ShellView shell(rows, structure);
    Vec3 nearest = place;
    float least = 1e30f;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t at = shell.vertex(v);
        if (rows.vertices.element[at] == kNone) continue;
        const Vec3 away = rows.vertices.rest[at] - place;
        if (dot(away, away) >= least) continue;
        least = dot(away, away);
        nearest = rows.vertices.rest[at];
    }
    return nearest;
}

ExplosionSums explosion_on(RunRows& rows, Row<Structures> structure, const Explosion& explosion, Vec3d about) {
    return measure_explosion(ShellView(rows, structure), explosion, about);
}

bool is_cut_by(RunRows& rows, Row<Structures> structure, const Blows& blows, uint32_t row) {
    return passes_through(ShellView(rows, structure), CutSurface(blows, row));
}

void remember(BodyRows& rows, Row<Structures> structure, Row<Bodies> body) {
    remember_drawn(ShellView(rows, structure), rows.view_indices, rows.bodies.view_indices[body]);
}

uint32_t drawn_parts(const RunRows& rows, Row<Structures> structure) {
    return rows.shells.elements[rows.shell_of(structure)].count;
}

void show_cracks(const ShellRows& rows, Row<Structures> structure, CrackLine line, void* user) {
    const Row<Shells> shell = rows.shell_of(structure);
    const Range elements = rows.shells.elements[shell], vertices = rows.shells.vertices[shell];
    for (uint32_t e = elements.first; e < elements.first + elements.count; ++e) {
        if (rows.elements.flags[e] & kDead) continue;
        const auto corner = rows.elements.corner[e];
        for (size_t k = 0; k < 3; ++k) {
            if (static_cast<EdgeKind>(rows.elements.edge_kind[e][k]) != EdgeKind::Crack) continue;
            line(user, smoothed_place(rows, vertices.first + corner[k]),
                 smoothed_place(rows, vertices.first + corner[(k + 1) % 3]));
        }
    }
}

// Its rows of structures and shells stay, with mass and area.
void empty(RunRows& rows, Row<Structures> structure) {
    release_springs(rows, structure);
    ShellRows::for_each_range(rows, structure, [](Range& range, auto& table, auto, const char*) {
        table.give_back(range);
        range = {};
    });
    rows.shells.dead_elements[rows.shell_of(structure)] = rows.structures.live_elements[structure] = 0;
    clear_shape(ShellView(rows, structure));
}

// What a shell's rows hold is its damage model's affair: DamageModels::check_shell.
std::string no_trouble([[maybe_unused]] Read<StructuresOfAllKinds> rows, [[maybe_unused]] Row<Structures> structure) {
    return "";
}

}  // namespace

void add_surface_calls(StructureCalls& calls) {
    calls.patch_radius = call<radius_of_patch>;
    calls.struck_normal = call<normal_struck>;
    calls.nearest_point = call<nearest_point>;
    calls.measure_explosion = call<explosion_on>;
    calls.is_cut_by = call<is_cut_by>;
    calls.draw = call<draw_body>;
    calls.remember_drawn = call<remember>;
    calls.drawn_parts = call<drawn_parts>;
    calls.show_cracks = call<show_cracks>;
    calls.empty = call<empty>;
    calls.trouble = call<no_trouble>;
}

}  // namespace cullet
