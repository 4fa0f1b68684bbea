#include "systems/systems.hpp"

namespace cullet {

// Tables only grow, so this does something in few frames: the first, and those after a hit took new rows.
void commit_pages(Serial, const RoomAhead& ahead, const Events<TaskOpened>& opened, const Events<TaskEnded>& ended,
                  ShellTables shells, ViewVertices& view_vertices, ViewIndices& view_indices) {
    if (!opened.all().empty() || !ended.all().empty()) return;
    State& state = shells.state;
    const ShellRoom& hit = ahead.hit;
    const auto commit = [](AnyTable& table, uint32_t rows) { table.commit_rows(table.size() + rows); };
    commit(state.vertices, 2 * hit.vertices);
    commit(state.elements, 2 * hit.elements);
    commit(state.triangle_springs, 2 * hit.elements);
    commit(state.hinges, 2 * hit.hinges);
    commit(state.stiffness_packs, 2 * hit.vertices / kLanes);
    commit(state.stiffness_blocks, 2 * hit.blocks);
    commit(state.stiffness_links, 2 * hit.links);
    commit(state.cells, 2 * hit.cells);
    commit(state.hull_points, 2 * hit.points);
    // A prism is drawn with both faces and its crack faces.
    commit(view_vertices, 8 * hit.elements);
    commit(view_indices, 8 * hit.elements);
}

}  // namespace cullet
