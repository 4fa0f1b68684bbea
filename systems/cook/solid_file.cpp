#include "systems/cook/solid_file.hpp"

#include <algorithm>
#include <memory>

#include "systems/structure_calls.hpp"

namespace cullet {
namespace {

std::unique_ptr<Workbench> make_workbench_of_one() {
    return std::make_unique<Workbench>(
        Limits{.bodies = 1, .structures = 1, .vertices = 64, .elements = 64, .tasks = 1, .models = 1});
}

struct OneSolid {
    Row<Structures> structure;
    Row<Solids> solid;
    Row<CookedSolids> cooked;
};
/// Without rows.
OneSolid make_one(Workbench& rows) {
    OneSolid one;
    one.cooked = make_cooked(rows, {});
    one.structure = make_solid(rows, one.cooked, {});
    one.solid = solid_of(rows.structures, one.structure);
    return one;
}

template <class F>
void for_each_part(Workbench& rows, const OneSolid& one, F&& f) {
    const auto each = [&](Range& range, auto& table, uint32_t, const char*) { f(range, table); };
    for_each_cooked_range(rows, one.cooked, {}, each);
    for_each_solid_range(rows, one.structure, {}, each);
}

bool is_plain(const Range& range, uint32_t rows) {
    return range.first == 0 && range.count == rows && range.capacity == rows;
}

}  // namespace

void put_solid(ByteWriter& writer, Workbench& state, Row<Structures> structure) {
    const Row<Solids> solid = solid_of(state.structures, structure);
    const OneSolid from{structure, solid, state.solids.cooked[solid]};
    const auto alone = make_workbench_of_one();
    Workbench& row = *alone;
    const OneSolid one = make_one(row);
    std::vector<uint32_t> counts;
    for_each_part(state, from, [&](const Range& range, const auto&) { counts.push_back(range.count); });
    row.structures.copy_rows(state.structures, structure, one.structure, 1);
    row.solids.copy_rows(state.solids, solid, one.solid, 1);
    row.cooked_solids.copy_rows(state.cooked_solids, from.cooked, one.cooked, 1);
    row.structures.rows[one.structure] = 0, row.structures.users[one.structure] = 1;
    row.structures.material[one.structure] = Row<Materials>(0);  // its values stand before the tables
    row.solids.cooked[one.solid] = Row<CookedSolids>(0);
    row.cooked_solids.users[one.cooked] = 1;
    size_t part = 0;
    for_each_part(row, one, [&](Range& range, const auto&) {
        range = {0, counts[part], counts[part]};
        ++part;
    });
    put_table(writer, row.structures, one.structure, 1);
    put_table(writer, row.solids, one.solid, 1);
    put_table(writer, row.cooked_solids, one.cooked, 1);
    for_each_part(state, from, [&](const Range& range, const AnyTable& table) {
        put_table(writer, table, range.first, range.count);
    });
}

FoundSolid find_solid(ByteReader& reader) {
    FoundSolid found;
    const auto none = make_workbench_of_one();
    Workbench& like = *none;
    const OneSolid one = make_one(like);
    const auto find = [&](const AnyTable& table) {
        return reader.is_sound() ? find_table(reader, table) : FoundTable{};
    };
    found.solid = find(like.solids);
    found.cooked = find(like.cooked_solids);
    for_each_cooked_range(like, one.cooked, {}, [&](const auto&, const auto& table, uint32_t, const char*) {
        found.cooked_parts.push_back(find(table));
    });
    for_each_solid_range(like, one.structure, {}, [&](const auto&, const auto& table, uint32_t, const char*) {
        found.parts.push_back(find(table));
    });
    reader.expect(found.solid.rows == 1 && found.cooked.rows == 1,
                  "there are " + std::to_string(found.solid.rows) + " solids of " + std::to_string(found.cooked.rows) +
                      ", not 1 of 1,");
    return found;
}

// Limits of small tables follow from both numbers (components/solid_rows.hpp): coarse tetrahedra are an eighth of the
// elements, cells of solids a quarter, hulls an eighth of the vertices.
Limits limits_for(const FoundSolid& found) {
    uint32_t most = 0;
    for (const auto* parts : {&found.cooked_parts, &found.parts})
        for (const FoundTable& part : *parts) most = std::max(most, part.rows);
    Limits limits = cooking_limits(0, 0);
    limits.structures = 2;
    most = std::min(most, 1u << 24);  // more is refused for want of room
    limits.vertices = 8 * most + 1024;
    limits.elements = 8 * most + 1024;
    return limits;
}

Result<Row<Structures>> copy_solid(Workbench& state, const FoundTable& structure, const FoundSolid& found) {
    std::vector<const FoundTable*> parts;
    for (const FoundTable& part : found.cooked_parts) parts.push_back(&part);
    for (const FoundTable& part : found.parts) parts.push_back(&part);
    OneSolid one = make_one(state);
    structure.copy_to(state.structures, one.structure);
    found.solid.copy_to(state.solids, one.solid);
    found.cooked.copy_to(state.cooked_solids, one.cooked);
    const bool stands_alone = state.structures.rows[one.structure] == 0 && state.solids.cooked[one.solid].index == 0 &&
                              state.structures.users[one.structure] == 1 &&
                              state.cooked_solids.users[one.cooked] == 1 &&
                              state.structures.kind[one.structure] == static_cast<uint8_t>(StructureKind::Tetrahedra);
    if (!stands_alone) return Error{"its structure is no solid that can stand alone"};
    size_t part = 0;
    std::string trouble;
    for_each_part(state, one, [&](Range& range, auto& table) {
        const uint32_t count = parts[part]->rows;
        if (!is_plain(range, count) && trouble.empty())
            trouble = std::string("the solid's range of ") + table.name() + " is not all of its " +
                      std::to_string(count) + " rows";
        Range own;
        if (!table.take(count, own) && trouble.empty())
            trouble = std::string("it has ") + std::to_string(count) + " rows of " + table.name() + ", too many";
        if (!trouble.empty()) {
            range = {};
            return;
        }
        own.count = count;
        range = own;
        parts[part]->copy_to(table, own.first);
        ++part;
    });
    if (!trouble.empty()) return Error{trouble};
    std::string not_finite = state.structures.validate();
    if (not_finite.empty()) not_finite = state.cooked_solids.validate();
    if (not_finite.empty()) not_finite = state.solids.validate();
    for_each_part(state, one, [&](const auto&, const AnyTable& table) {
        if (not_finite.empty()) not_finite = table.validate();
    });
    if (!not_finite.empty()) return Error{not_finite};
    const std::string wrong = calls_of(state.structures, one.structure).trouble(state, one.structure);
    if (!wrong.empty()) return Error{"its solid " + wrong};
    return one.structure;
}

}  // namespace cullet
