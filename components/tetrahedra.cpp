// Rows of solids come and go. What was cooked stays as long as anything has it.
#include "components/solid_rows.hpp"

namespace cullet {
namespace {

void release_cooked(SolidRows rows, Row<CookedSolids> cooked) {
    CookedSolids& all = rows.cooked_solids;
    CULLET_ASSERT(all.users[cooked] > 0, "cooked solid %u released more often than taken", cooked.index);
    if (--all.users[cooked] > 0) return;
    for_each_cooked_range(rows, cooked, {},
                          [](Range& range, auto& table, uint32_t, const char*) { table.give_back(range); });
    all.clear_rows(cooked, 1);
    all.pool.give_back(cooked, 1);
}

/// Fills ranges of `to` from those of `from`, which were listed in the same order.
struct RangeCopy {
    SolidRows to;
    Read<SolidRows> from;
    std::array<Range, 16> given = {};
    uint32_t at = 0;

    template <class Rows>
    void operator()(Range& range, Rows& table, uint32_t, const char*) {
        const Range found = given[at++];
        CULLET_ASSERT(found.count <= range.capacity, "copy of %s: %u rows do not fit %u", table.name(), found.count,
                      range.capacity);
        range.count = found.count;
        if (found.count) table.copy_rows(table_in<Rows>(from), found.first, range.first, found.count);
    }
};

Row<CookedSolids> import_cooked(SolidRows to, Read<SolidRows> from, Row<CookedSolids> source, const char** full) {
    const CookedRoom room = room_of(from, source);
    const Row<CookedSolids> copy = make_cooked(to, room, full);
    if (!copy.exists()) return copy;
    RangeCopy ranges{to, from};
    for_each_cooked_range(from, source, {}, [&](const Range& range, const auto&, uint32_t, const char*) {
        ranges.given[ranges.at++] = range;
    });
    ranges.at = 0;
    std::array<Range, 16> own;
    uint32_t k = 0;
    for_each_cooked_range(to, copy, {}, [&](Range& range, auto&, uint32_t, const char*) { own[k++] = range; });
    to.cooked_solids.copy_rows(from.cooked_solids, source, copy, 1);
    to.cooked_solids.users[copy] = 0;
    k = 0;
    for_each_cooked_range(to, copy, {}, [&](Range& range, auto&, uint32_t, const char*) { range = own[k++]; });
    for_each_cooked_range(to, copy, {}, ranges);
    return copy;
}

}  // namespace

Row<CookedSolids> make_cooked(SolidRows rows, const CookedRoom& room, const char** full) {
    Range taken;
    if (!rows.cooked_solids.take(1, taken)) {
        if (full) *full = "limits.models";
        return {};
    }
    const Row<CookedSolids> row(taken.first);
    rows.cooked_solids.clear_rows(row, 1);
    const char* missing = nullptr;
    for_each_cooked_range(rows, row, room, [&](Range& range, auto& table, uint32_t wanted, const char* limit) {
        if (!table.take(wanted, range) && !missing) missing = limit;
    });
    if (!missing) return row;
    rows.cooked_solids.users[row] = 1;
    release_cooked(rows, row);
    if (full) *full = missing;
    return {};
}

CookedRoom room_of(Read<SolidRows> rows, Row<CookedSolids> cooked) {
    const CookedSolids& own = rows.cooked_solids;
    CookedRoom room;
    room.lattice_points = own.lattice_points[cooked].count;
    room.tetrahedra = own.tetrahedra[cooked].count;
    room.coarse = own.coarse[cooked].count;
    room.windings = own.windings[cooked].count;
    room.cells = own.cells[cooked].count;
    room.raw = own.raw[cooked].count;
    room.moments = own.moments[cooked].count;
    room.bonds = own.bonds[cooked].count;
    room.patches = own.patches[cooked].count;
    room.points = own.points[cooked].count;
    room.triangles = own.triangles[cooked].count;
    return room;
}

Row<Structures> make_solid(SolidRows rows, Row<CookedSolids> cooked, const SolidRoom& room, const char** full) {
    Structures& structures = rows.structures;
    Range row, solid_row;
    if (!structures.take(1, row)) {
        if (full) *full = "limits.structures";
        return {};
    }
    if (!rows.solids.take(1, solid_row)) {
        structures.give_back(row);
        if (full) *full = "limits.structures";
        return {};
    }
    const Row<Structures> structure(row.first);
    const Row<Solids> solid(solid_row.first);
    structures.clear_rows(structure, 1);
    structures.kind[structure] = static_cast<uint8_t>(StructureKind::Tetrahedra);
    structures.rows[structure] = solid;
    structures.users[structure] = 1;
    rows.solids.clear_rows(solid, 1);
    rows.solids.cooked[solid] = cooked;
    ++rows.cooked_solids.users[cooked];
    const char* missing = nullptr;
    for_each_solid_range(rows, structure, room, [&](Range& range, auto& table, uint32_t wanted, const char* limit) {
        if (!table.take(wanted, range) && !missing) missing = limit;
    });
    if (!missing) return structure;
    release_solid(rows, structure);
    if (full) *full = missing;
    return {};
}

SolidRoom solid_room_of(Read<SolidRows> rows, Row<Structures> structure) {
    const Row<Solids> solid = solid_of(rows.structures, structure);
    const Solids& own = rows.solids;
    return {own.members[solid].count,
            own.moved[solid].count,
            own.points[solid].count,
            own.triangles[solid].count,
            rows.structures.cells[structure].count,
            rows.structures.points[structure].count};
}

void release_solid(SolidRows rows, Row<Structures> structure) {
    Structures& structures = rows.structures;
    CULLET_ASSERT(structures.users[structure] > 0, "structure %u released more often than taken", structure.index);
    if (--structures.users[structure] > 0) return;
    const Row<Solids> solid = solid_of(structures, structure);
    for_each_solid_range(rows, structure, {},
                         [](Range& range, auto& table, uint32_t, const char*) { table.give_back(range); });
    release_cooked(rows, rows.solids.cooked[solid]);
    rows.solids.clear_rows(solid, 1);
    rows.solids.pool.give_back(solid, 1);
    structures.clear_rows(structure, 1);
    structures.pool.give_back(structure, 1);
}

Row<Structures> import_solid(SolidRows to, Read<SolidRows> from, Row<Structures> source, const char** full) {
    const Row<Solids> given = solid_of(from.structures, source);
    Row<CookedSolids> cooked = from.solids.cooked[given];
    const bool is_foreign = &to.solids != &from.solids;
    if (is_foreign) cooked = import_cooked(to, from, cooked, full);
    if (!cooked.exists()) return {};
    if (is_foreign) to.cooked_solids.users[cooked] = 1;  // until it is handed on
    const Row<Structures> copy = make_solid(to, cooked, solid_room_of(from, source), full);
    if (is_foreign) release_cooked(to, cooked);
    if (!copy.exists()) return copy;
    RangeCopy ranges{to, from};
    for_each_solid_range(from, source, {}, [&](const Range& range, const auto&, uint32_t, const char*) {
        ranges.given[ranges.at++] = range;
    });
    std::array<Range, 16> own;
    uint32_t k = 0;
    for_each_solid_range(to, copy, {}, [&](Range& range, auto&, uint32_t, const char*) { own[k++] = range; });
    const Row<Solids> solid = solid_of(to.structures, copy);
    to.structures.copy_rows(from.structures, source, copy, 1);
    to.solids.copy_rows(from.solids, given, solid, 1);
    to.structures.users[copy] = 1;
    to.structures.rows[copy] = solid;
    to.solids.cooked[solid] = cooked;
    k = 0;
    for_each_solid_range(to, copy, {}, [&](Range& range, auto&, uint32_t, const char*) { range = own[k++]; });
    ranges.at = 0;
    for_each_solid_range(to, copy, {}, ranges);
    return copy;
}

}  // namespace cullet
