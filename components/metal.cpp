// Rows of metal come and go with their shells.
#include "components/metal_rows.hpp"

namespace cullet {
Row<MetalShells> make_metal(MetalTables rows, Row<Structures> structure, const MetalRoom& room, const char** full) {
    const Row<Shells> shell = shell_of(rows.structures, structure);
    CULLET_ASSERT(!metal_of(rows, structure).exists(), "structure %u is of metal already", structure.index);
    Range taken;
    if (!rows.metal_shells.take(1, taken)) {
        if (full) *full = "limits.structures";
        return {};
    }
    const Row<MetalShells> row(taken.first);
    rows.metal_shells.clear_rows(row, 1);
    rows.metal_shells.structure[row] = structure;
    rows.metal_owners.reach(shell + 1);
    rows.metal_owners.metal[shell] = row + 1;
    const char* missing = nullptr;
    for_each_metal_range(rows, row, room, [&](Range& range, auto& table, uint32_t wanted, const char* limit) {
        if (!table.take(wanted, range) && !missing) missing = limit;
    });
    if (!missing) return row;
    release_metal(rows, structure);
    if (full) *full = missing;
    return {};
}

MetalRoom metal_room_of(Read<MetalTables> rows, Row<Structures> structure) {
    const Row<MetalShells> row = metal_of(rows, structure);
    if (!row.exists()) return {};
    const MetalShells& own = rows.metal_shells;
    return {own.vertices[row].count, own.elements[row].count, own.springs[row].count, own.cells[row].count,
            own.borders[row].count};
}

void release_metal(MetalTables rows, Row<Structures> structure) {
    const Row<MetalShells> row = metal_of(rows, structure);
    if (!row.exists()) return;
    for_each_metal_range(rows, row, {},
                         [](Range& range, auto& table, uint32_t, const char*) { table.give_back(range); });
    rows.metal_shells.clear_rows(row, 1);
    rows.metal_shells.pool.give_back(row, 1);
    rows.metal_owners.metal[shell_of(rows.structures, structure)] = 0;
}

void copy_metal_rows(MetalTables to, Read<MetalTables> from, Row<Structures> source, Row<Structures> copy) {
    const Row<MetalShells> given = metal_of(from, source), own = metal_of(to, copy);
    std::array<Range, 5> ranges;
    size_t k = 0;
    for_each_metal_range(from, given, {},
                         [&](const Range& range, const auto&, uint32_t, const char*) { ranges[k++] = range; });
    MetalShells& s = to.metal_shells;
    s.mean_edge[own] = from.metal_shells.mean_edge[given];
    s.crush_pressure[own] = from.metal_shells.crush_pressure[given];
    s.half_diagonal[own] = from.metal_shells.half_diagonal[given];
    s.published[own] = from.metal_shells.published[given];
    s.impulse_time[own] = from.metal_shells.impulse_time[given];
    s.tear_strain[own] = from.metal_shells.tear_strain[given];
    k = 0;
    for_each_metal_range(to, own, {}, [&](Range& range, auto& table, uint32_t, const char*) {
        using Rows = std::remove_reference_t<decltype(table)>;
        const Range found = ranges[k++];
        CULLET_ASSERT(found.count <= range.capacity, "copy of %s: %u rows do not fit %u", table.name(), found.count,
                      range.capacity);
        range.count = found.count;
        if (found.count) table.copy_rows(table_in<Rows>(from), found.first, range.first, found.count);
    });
}

void release_metal_shell(MetalShellRows rows, Row<Structures> structure) {
    if (rows.structures.users[structure] == 1) release_metal(rows, structure);
    release_shell(rows, structure);
}

}  // namespace cullet
