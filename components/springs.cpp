// Rows of springs come and go with their shells.
#include "components/springs.hpp"

#include <algorithm>

#include "components/shell_rows.hpp"

namespace cullet {
namespace {

struct Part {
    AnyTable& table;
    RangePool& pool;
    Column<Range>& range;
    uint32_t rows;  // wanted
    const char* limit;
    bool is_cleared = true;
};

/// Every range of a row with its table and pool.
std::array<Part, 7> parts_of(ShellRows& s, const SpringRoom& room = {}) {
    ShellSprings& own = s.shell_springs;
    const uint32_t packs = (room.vertices + kLanes - 1) / kLanes;
    const auto layered = [&](uint32_t rows) { return room.has_layers ? rows : 0; };
    const bool clears = room.clears_lists;
    return {{{s.springs, s.springs.pool, own.springs, room.springs, "limits.elements", clears},
             {s.layer_springs, s.layer_springs.pool, own.layers, layered(room.springs), "limits.elements", clears},
             {s.element_springs, s.element_springs.pool, own.edges, room.elements, "limits.elements"},
             {s.spring_packs, s.spring_packs.pool, own.packs, packs, "limits.vertices"},
             {s.spring_slots, s.spring_slots.pool, own.slots, room.slots, "limits.vertices", clears},
             {s.layer_slots, s.layer_slots.pool, own.layer_slots, layered(room.slots), "limits.vertices", clears},
             {s.twins, s.twins.pool, own.twins, layered(packs * kLanes), "limits.vertices"}}};
}

bool take(const Part& part, uint32_t row) {
    part.range[row] = {};
    if (part.rows == 0) return true;
    const uint32_t first = part.pool.take(part.rows);
    if (first == kNone) return false;
    const uint32_t old_end = part.table.size();  // what is appended is clear
    if (part.pool.end() > old_end) part.table.append(part.pool.end() - old_end);
    if (part.is_cleared && first < old_end)
        part.table.clear_rows(first, std::min(part.pool.rounded(part.rows), old_end - first));
    part.range[row] = {first, 0, part.rows};
    return true;
}

void give_back(ShellRows& state, Row<ShellSprings> row) {
    state.shells.springs[state.shell_of(state.shell_springs.structure[row])] = {};
    for (const Part& part : parts_of(state)) part.pool.give_back(part.range[row].first, part.range[row].capacity);
    state.shell_springs.clear_rows(row, 1);
    state.shell_springs.pool.give_back(row, 1);
}

}  // namespace

Row<ShellSprings> springs_of(const ShellRows& state, Row<Structures> structure) {
    return state.shells.springs[state.shell_of(structure)];
}

Row<ShellSprings> make_springs(ShellRows& state, Row<Structures> structure, const SpringRoom& room, const char** full) {
    ShellSprings& own = state.shell_springs;
    CULLET_ASSERT(!springs_of(state, structure).exists(), "structure %u has springs", structure.index);
    const Row<ShellSprings> row(state.shell_springs.pool.take(1));
    if (!row.exists()) {
        if (full) *full = "limits.structures";
        return {};
    }
    if (row >= own.size()) own.append(row + 1 - own.size());
    own.clear_rows(row, 1);
    own.is_used[row] = 1;
    own.structure[row] = structure;
    state.shells.springs[state.shell_of(structure)] = row;
    const char* missing = nullptr;
    for (const Part& part : parts_of(state, room))
        if (!take(part, row) && !missing) missing = part.limit;
    if (!missing) return row;
    give_back(state, row);
    if (full) *full = missing;
    return {};
}

void release_springs(ShellRows& state, Row<Structures> structure) {
    if (const Row<ShellSprings> row = springs_of(state, structure); row.exists()) give_back(state, row);
}

bool copy_springs(ShellRows& state, Row<Structures> source, Row<Structures> copy, const char** full) {
    const Row<ShellSprings> from = springs_of(state, source);
    if (!from.exists()) return true;
    const ShellView of(state, source), into(state, copy);
    ShellSprings& own = state.shell_springs;
    SpringRoom room;
    // As much spare as new springs have: packs that are full move to the end of the slots.
    room.springs = std::max(own.springs[from].capacity, own.springs[from].count * 9 / 8 + 16);
    const bool has_edges = own.edges[from].capacity > 0;  // springs given by hand belong to no element
    room.elements = has_edges ? into.elements().capacity : 0;
    room.vertices = into.vertices().capacity;
    room.slots = std::max(own.slots[from].capacity, own.slots[from].count * 9 / 8 + 16);
    room.has_layers = own.layers[from].capacity > 0;
    CULLET_ASSERT(room.vertices >= of.vertex_count() && (!has_edges || room.elements >= of.element_count()),
                  "springs of %u vertices do not fit %u", of.vertex_count(), room.vertices);
    const Row<ShellSprings> to = make_springs(state, copy, room, full);
    if (!to.exists()) return false;
    std::array<Range, 7> ranges;
    const auto parts = parts_of(state);
    for (size_t k = 0; k < parts.size(); ++k) ranges[k] = parts[k].range[to];
    own.copy_rows(own, from, to, 1);
    own.structure[to] = copy;
    for (size_t k = 0; k < parts.size(); ++k) {
        const Range found = parts[k].range[from];
        Range& range = parts[k].range[to];
        range = ranges[k];
        range.count = std::min(found.count, range.capacity);
        if (range.count) parts[k].table.copy_rows(parts[k].table, found.first, range.first, range.count);
    }
    own.packs[to].count = own.packs[to].capacity;  // these follow the room for vertices; rows behind the copy are empty
    own.twins[to].count = own.twins[to].capacity;
    return true;
}

}  // namespace cullet
