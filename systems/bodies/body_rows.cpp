#include "systems/bodies/body_rows.hpp"

#include "systems/bodies/model_mesh.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

Row<Bodies> take_body(BodyRows& state) {
    const uint32_t row = state.bodies.pool.take(1);
    if (row == kNone) return {};
    Bodies& bodies = state.bodies;
    if (row >= bodies.size()) bodies.append(row + 1 - bodies.size());
    const uint32_t generation = bodies.generation[row] + 1;
    bodies.clear_rows(row, 1);
    bodies.generation[row] = generation ? generation : 1;  // 0 is the null handle
    bodies.model[row] = {};
    bodies.structure[row] = {};
    bodies.parent[row] = {};
    bodies.task[row] = kNone;
    bodies.soft[row] = {};
    bodies.model_mesh[row] = {};
    bodies.orientation[row] = {};
    bodies.previous_orientation[row] = {};
    bodies.strength_scale[row] = 1;
    bodies.colour[row] = row;
    return Row<Bodies>(row);
}

void free_body(WorldRows& state, Row<Bodies> b) {
    Bodies& bodies = state.bodies;
    if (const Row<Structures> own = bodies.structure[b]; own.exists())
        calls_of(state.structures, own).release(state, own);
    leave_model_mesh(state, b);
    state.view_vertices.pool.give_back(bodies.view_vertices[b].first, bodies.view_vertices[b].capacity);
    state.view_indices.pool.give_back(bodies.view_indices[b].first, bodies.view_indices[b].capacity);
    const uint32_t generation = bodies.generation[b];
    bodies.clear_rows(b, 1);
    if (b < state.quick_bodies.size()) state.quick_bodies.clear_rows(b, 1);
    if (b < state.fragment_ages.size()) state.fragment_ages.clear_rows(b, 1);
    bodies.generation[b] = generation;
    bodies.task[b] = kNone;
    bodies.soft[b] = {};
    bodies.model_mesh[b] = {};
    state.bodies.pool.give_back(b, 1);
}

namespace {

/// One row in so many is spare where cracks may add to a mesh: without, each hit would draw all of it into other rows.
constexpr uint32_t kViewSpare = 8;

void shrink(RangePool& pool, Range& range, uint32_t rows) {
    const uint32_t kept = pool.rounded(rows), had = pool.rounded(range.capacity);
    pool.give_back(range.first + kept, had - kept);
    range.capacity = rows;
}

}  // namespace

bool take_view_rows(BodyRows& state, Row<Bodies> b, uint32_t rows) {
    Range &vertices = state.bodies.view_vertices[b], &indices = state.bodies.view_indices[b];
    if (rows <= vertices.capacity && rows <= indices.capacity) {
        shrink(state.view_vertices.pool, vertices, rows);
        shrink(state.view_indices.pool, indices, rows);
        return true;
    }
    const uint32_t vertex = state.view_vertices.pool.take(rows);
    const uint32_t index = vertex == kNone ? kNone : state.view_indices.pool.take(rows);
    if (index == kNone) {
        if (vertex != kNone) state.view_vertices.pool.give_back(vertex, rows);
        return false;
    }
    const auto grow = [](AnyTable& table, const RangePool& pool) {
        if (pool.end() > table.size()) table.append(pool.end() - table.size());
    };
    grow(state.view_vertices, state.view_vertices.pool);
    grow(state.view_indices, state.view_indices.pool);
    leave_model_mesh(state, b);
    state.view_vertices.pool.give_back(vertices.first, vertices.capacity);
    state.view_indices.pool.give_back(indices.first, indices.capacity);
    vertices = {vertex, 0, rows};
    indices = {index, 0, rows};
    return true;
}

bool take_spare_view_rows(BodyRows& state, Row<Bodies> b, uint32_t rows) {
    return take_view_rows(state, b, rows + rows / kViewSpare) || take_view_rows(state, b, rows);
}

bool take_view(WorldRows& state, Row<Bodies> b, bool may_crack) {
    const Row<Structures> structure = state.bodies.structure[b];
    const uint32_t rows = calls_of(state.structures, structure).view_rows(state, structure);
    return may_crack ? take_spare_view_rows(state, b, rows) : take_view_rows(state, b, rows);
}

}  // namespace cullet
