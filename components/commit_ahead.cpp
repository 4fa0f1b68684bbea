#include "components/commit_ahead.hpp"

#include <algorithm>

namespace cullet {

constexpr uint32_t kSpringsAVertex = 14;  // of metal: both ends of six edges and a tie

constexpr uint32_t kMostShellsAhead = 8;  // that commit_ahead has room for

// `shell` is what a hit takes: a copy of all rows, and what cracks add (working_room). What moves of the broken shell
// is less than it. So it is two a hit. A drawn mesh has 6 corners an element and 6 a free edge, and the pieces' more
// than the body's. Where many bodies stand an explosion breaks some of them in one frame.
void commit_ahead(WorldRows& rows, const ShellRoom& shell, uint64_t bytes) {
    const auto commit = [&](AnyTable& table, const RangePool& pool, uint64_t count) {
        const auto end = static_cast<uint32_t>(std::min<uint64_t>(pool.end() + count, table.limit()));
        if (count > 0) bytes -= table.commit_rows(end, bytes);
    };
    const uint64_t shells_ahead = std::clamp(rows.bodies.size(), 2u, kMostShellsAhead);
    const auto times = [&](uint64_t factor, uint32_t count) { return factor * count * shells_ahead / 2; };
    commit(rows.vertices, rows.vertices.pool, times(2, shell.vertices) + 512);
    commit(rows.elements, rows.elements.pool, times(2, shell.elements) + 1024);
    commit(rows.triangle_springs, rows.elements.pool, times(2, shell.elements) + 1024);
    commit(rows.hinges, rows.hinges.pool, times(2, shell.hinges) + 1536);
    commit(rows.stiffness_packs, rows.stiffness_packs.pool, times(2, shell.vertices / kLanes));
    commit(rows.stiffness_blocks, rows.stiffness_blocks.pool, times(2, shell.blocks));
    commit(rows.stiffness_links, rows.stiffness_links.pool, times(2, shell.links));
    commit(rows.cells, rows.cells.pool, times(3, shell.cells));
    commit(rows.hull_points, rows.hull_points.pool, times(2 * kMostCellPoints, shell.cells));
    commit(rows.view_vertices, rows.view_vertices.pool, times(12, shell.elements));
    commit(rows.view_indices, rows.view_indices.pool, times(12, shell.elements));
    if (rows.metal_shells.size() > 0) {
        commit(rows.metal_vertices, rows.metal_vertices.pool, times(2, shell.vertices));
        commit(rows.metal_elements, rows.metal_elements.pool, times(2, shell.elements));
        commit(rows.metal_springs, rows.metal_springs.pool, times(2 * kSpringsAVertex, shell.vertices));
        const uint32_t cells = std::min(kMostSubShells, shell.elements);
        commit(rows.sub_shells, rows.sub_shells.pool, times(2, cells));
        commit(rows.sub_shell_borders, rows.sub_shell_borders.pool, times(16, cells));
    }
    // The springs of a region (quick mode): of all the body, when it is small. What cracks add is a few per cent, and a
    // third of the vertices at least are rows to spare.
    if (rows.quick_bodies.size() == 0) return;
    const uint8_t* layers = rows.quick_bodies.layers.data();
    const bool has_layers = std::count(layers, layers + rows.quick_bodies.size(), 2);
    const uint64_t edges = times(3, shell.vertices) / 2, slots = times(5, shell.vertices) / kLanes;
    commit(rows.springs, rows.springs.pool, edges);
    commit(rows.element_springs, rows.element_springs.pool, times(1, shell.elements));
    commit(rows.spring_packs, rows.spring_packs.pool, times(1, shell.vertices / kLanes));
    commit(rows.spring_slots, rows.spring_slots.pool, slots);
    if (!has_layers) return;
    commit(rows.layer_springs, rows.layer_springs.pool, edges);
    commit(rows.layer_slots, rows.layer_slots.pool, slots);
    commit(rows.twins, rows.twins.pool, times(1, shell.vertices));
}

}  // namespace cullet
