#include "components/state.hpp"

#include <algorithm>

namespace cullet {
State::State(const Limits& l)
    : SoftRows(l, MaterialRows{materials, material_traits}),
      materials(kMostMaterials),
      material_traits(kMostMaterials),
      models(l.models),
      debris(l.debris),
      queued_hits(l.queued_hits),
      fragments((l.tasks + 1) * kMostParts),
      blows(2 * (l.bodies + l.queued_hits)),
      debris_ages(l.debris),
      limits_(l) {
    queued_hits.append(l.queued_hits);
    fragments.append((l.tasks + 1) * kMostParts);
}

namespace {

template <class Pool, class Self>
std::array<Pool*, 20> pools_of(Self& s) {
    return {&s.bodies.pool,        &s.shells.pool,          &s.vertices.pool,         &s.elements.pool,
            &s.hinges.pool,        &s.stiffness_packs.pool, &s.stiffness_blocks.pool, &s.stiffness_links.pool,
            &s.cells.pool,         &s.hull_points.pool,     &s.view_vertices.pool,    &s.view_indices.pool,
            &s.shell_springs.pool, &s.springs.pool,         &s.layer_springs.pool,    &s.element_springs.pool,
            &s.spring_packs.pool,  &s.spring_slots.pool,    &s.layer_slots.pool,      &s.twins.pool};
}

}  // namespace

std::array<RangePool*, 20> State::pools() {
    return pools_of<RangePool>(*this);
}
std::array<const RangePool*, 20> State::pools() const {
    return pools_of<const RangePool>(*this);
}

constexpr uint32_t kMostShellsAhead = 8;  // that commit_ahead has room for

// `shell` is what a hit takes, a copy of all rows and what cracks add (working_room); what moves of the broken shell is
// less than it: two a hit. A drawn mesh has 6 corners an element and 6 a free edge, and the pieces' more than the
// body's. Where many bodies stand an explosion breaks some of them in one frame.
void State::commit_ahead(const ShellRoom& shell, uint64_t bytes) {
    const auto commit = [&](AnyTable& table, const RangePool& pool, uint64_t rows) {
        const auto end = static_cast<uint32_t>(std::min<uint64_t>(pool.end() + rows, table.limit()));
        if (rows > 0) bytes -= table.commit_rows(end, bytes);
    };
    const uint64_t shells_ahead = std::clamp(bodies.size(), 2u, kMostShellsAhead);
    const auto times = [&](uint64_t factor, uint32_t rows) { return factor * rows * shells_ahead / 2; };
    commit(vertices, vertices.pool, times(2, shell.vertices) + 512);
    commit(elements, elements.pool, times(2, shell.elements) + 1024);
    commit(triangle_springs, elements.pool, times(2, shell.elements) + 1024);
    commit(hinges, hinges.pool, times(2, shell.hinges) + 1536);
    commit(stiffness_packs, stiffness_packs.pool, times(2, shell.vertices / kLanes));
    commit(stiffness_blocks, stiffness_blocks.pool, times(2, shell.blocks));
    commit(stiffness_links, stiffness_links.pool, times(2, shell.links));
    commit(cells, cells.pool, times(3, shell.cells));
    commit(hull_points, hull_points.pool, times(2 * kMostCellPoints, shell.cells));
    commit(view_vertices, view_vertices.pool, times(12, shell.elements));
    commit(view_indices, view_indices.pool, times(12, shell.elements));
    // The springs of a region (quick mode): of all the body, when it is small. What cracks add is a few per cent, and a
    // third of the vertices at least are rows to spare.
    if (quick_bodies.size() == 0) return;
    const bool has_layers = std::count(quick_bodies.layers.data(), quick_bodies.layers.data() + quick_bodies.size(), 2);
    const uint64_t edges = times(3, shell.vertices) / 2, slots = times(5, shell.vertices) / kLanes;
    commit(springs, springs.pool, edges);
    commit(element_springs, element_springs.pool, times(1, shell.elements));
    commit(spring_packs, spring_packs.pool, times(1, shell.vertices / kLanes));
    commit(spring_slots, spring_slots.pool, slots);
    if (!has_layers) return;
    commit(layer_springs, layer_springs.pool, edges);
    commit(layer_slots, layer_slots.pool, slots);
    commit(twins, twins.pool, times(1, shell.vertices));
}

namespace {

// A table that says kIsOptional counts only while it has rows: what came later leaves older scenes their hash.
template <class T>
uint64_t hash_of(const T& table, uint64_t hash) {
    if constexpr (requires { T::kIsOptional; })
        if (table.size() == 0) return hash;
    return table.hash(hash);
}

}  // namespace

uint64_t State::hash() const {
    uint64_t hash = 0;
    std::apply([&](auto... table) { ((hash = hash_of(this->*table, hash)), ...); }, tables());
    return hash_pools(hash);
}

// A table grows to what its pool hands out: where no row was ever taken the pool is as new.
uint64_t State::hash_pools(uint64_t hash) const {
    const auto all = pools();
    for (size_t k = 0; k < all.size(); ++k)
        if (k < kFirstSpringPool || shell_springs.size() > 0) hash = all[k]->hash(hash);
    return hash;
}

namespace {

template <class F>
void for_each_kept_column(const State& state, F&& f) {
    const auto columns_of = [&](const AnyTable& table) {
        for (const ColumnInfo& c : table.columns())
            if (c.keep == Keep::State) f(table, c);
    };
    std::apply([&](auto... table) { (columns_of(state.*table), ...); }, State::tables());
}

}  // namespace

void State::digest_columns(std::vector<uint32_t>& out) const {
    out.clear();
    for_each_kept_column(*this, [&](const AnyTable& table, const ColumnInfo& c) {
        uint64_t hash = table.size();
        for (int a = 0; a < c.lanes * c.sides; ++a)
            hash = hash_bytes(table.column_memory(c, a), size_t{table.size()} * c.row_bytes, hash);
        out.push_back(static_cast<uint32_t>(hash));
    });
    out.push_back(static_cast<uint32_t>(hash_pools(0)));
}

std::string State::digested_column(size_t place) const {
    std::string name = "the rows that are taken";
    for_each_kept_column(*this, [&](const AnyTable& table, const ColumnInfo& c) {
        if (place-- == 0) name = std::string(table.name()) + "." + c.name;
    });
    return name;
}

std::string State::validate() const {
    std::string found;
    std::apply([&](auto... table) { ((found.empty() ? (void)(found = (this->*table).validate()) : void()), ...); },
               tables());
    return found;
}

std::string State::first_difference(const State& other) const {
    std::string found;
    std::apply(
        [&](auto... table) {
            ((found.empty() ? (void)(found = (this->*table).first_difference(other.*table)) : void()), ...);
        },
        tables());
    return found;
}

}  // namespace cullet
