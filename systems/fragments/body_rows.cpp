#include "systems/fragments/body_rows.hpp"

#include "systems/view/draw_shell.hpp"

namespace cullet {

Row<Bodies> take_body(State& state) {
    const uint32_t row = state.pools.bodies.take(1);
    if (row == kNone) return {};
    Bodies& bodies = state.bodies;
    if (row >= bodies.size()) bodies.append(row + 1 - bodies.size());
    const uint32_t generation = bodies.generation[row] + 1;
    bodies.clear_rows(row, 1);
    bodies.generation[row] = generation ? generation : 1;  // 0 is the null handle
    bodies.model[row] = {};
    bodies.shell[row] = {};
    bodies.parent[row] = {};
    bodies.task[row] = kNone;
    bodies.orientation[row] = {};
    bodies.previous_orientation[row] = {};
    bodies.strength_scale[row] = 1;
    bodies.colour[row] = row;
    return Row<Bodies>(row);
}

void free_body(State& state, Row<Bodies> b) {
    Bodies& bodies = state.bodies;
    if (bodies.shell[b].exists()) release_shell(state, bodies.shell[b]);
    state.pools.view_vertices.give_back(bodies.view_vertices[b].first, bodies.view_vertices[b].capacity);
    state.pools.view_indices.give_back(bodies.view_indices[b].first, bodies.view_indices[b].capacity);
    const uint32_t generation = bodies.generation[b];
    bodies.clear_rows(b, 1);
    bodies.generation[b] = generation;
    bodies.task[b] = kNone;
    state.pools.bodies.give_back(b, 1);
}

bool take_view(State& state, Row<Bodies> b) {
    Bodies& bodies = state.bodies;
    const DrawnCount drawn = count_drawn(ShellView(state, bodies.shell[b]));
    const uint32_t vertex = state.pools.view_vertices.take(drawn.vertices);
    const uint32_t index = vertex == kNone ? kNone : state.pools.view_indices.take(drawn.index_count());
    if (index == kNone) {
        if (vertex != kNone) state.pools.view_vertices.give_back(vertex, drawn.vertices);
        return false;
    }
    const auto grow = [](AnyTable& table, const RangePool& pool) {
        if (pool.end() > table.size()) table.append(pool.end() - table.size());
    };
    grow(state.view_vertices, state.pools.view_vertices);
    grow(state.view_indices, state.pools.view_indices);
    state.pools.view_vertices.give_back(bodies.view_vertices[b].first, bodies.view_vertices[b].capacity);
    state.pools.view_indices.give_back(bodies.view_indices[b].first, bodies.view_indices[b].capacity);
    bodies.view_vertices[b] = {vertex, 0, drawn.vertices};
    bodies.view_indices[b] = {index, 0, drawn.index_count()};
    return true;
}

}  // namespace cullet
