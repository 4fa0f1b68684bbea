#include "components/state.hpp"

#include <algorithm>

namespace cullet {
namespace {

// Hinges: three for two elements, and cuts only remove them. Blocks and links: 8 lanes a slot, 6 to 8 slots of each a
// pack.
uint32_t hinge_limit(const Limits& l) {
    return l.elements / 2 * 3;
}
uint32_t pack_limit(const Limits& l) {
    return l.vertices / kLanes;
}
uint32_t slot_limit(const Limits& l) {
    return pack_limit(l) * 12;
}
uint32_t cell_limit(const Limits& l) {
    return l.vertices / 8;
}
// Edges: three for two elements and half of one a border edge; a crack doubles those that it cuts. A vertex has about 6
// springs, each in a slot of both ends.
uint32_t spring_limit(const Limits& l) {
    return l.elements * 2;
}
// Holes of a pool that gives an owner one range, or two while it is moved.
uint32_t ranges_of(const AnyTable& owners) {
    return 2 * owners.limit() + 1;
}

}  // namespace

State::State(const Limits& l)
    : materials(kMostMaterials),
      material_traits(kMostMaterials),
      models(l.models),
      bodies(l.bodies),
      debris(l.debris),
      shells(l.shells),
      vertices(l.vertices),
      elements(l.elements),
      triangle_springs(l.elements),
      hinges(hinge_limit(l)),
      stiffness_packs(pack_limit(l)),
      stiffness_blocks(slot_limit(l)),
      stiffness_links(slot_limit(l)),
      cells(cell_limit(l)),
      hull_points(cell_limit(l) * 32),
      tasks(l.tasks),
      task_contacts(l.tasks * kMostContacts),
      patch_vertices(l.tasks * kMostPatchVertices),
      queued_hits(l.queued_hits),
      fragments((l.tasks + 1) * kMostParts),
      view_vertices(l.view_vertices),
      view_indices(l.view_vertices * 2),
      blows(2 * (l.bodies + l.queued_hits)),
      shell_springs(l.shells),
      springs(spring_limit(l)),
      layer_springs(spring_limit(l)),
      element_springs(l.elements),
      spring_packs(pack_limit(l)),
      spring_slots(slot_limit(l)),
      layer_slots(slot_limit(l)),
      twins(l.vertices),
      soft_bodies(l.bodies),
      soft_strikers(l.bodies * kMostStrikers),
      soft_contacts(first_contact_row(l.vertices + kLanes)),
      pools(*this),
      limits_(l),
      quick_bodies(l.bodies),
      quick_runs(l.tasks),
      awake_packs(l.tasks * kMostAwakePacks),
      region_rests(l.tasks),
      fragment_ages(l.bodies),
      debris_ages(l.debris),
      pin_boxes(4 * l.bodies + 64),
      vertex_blocks(l.vertices / kVerticesPerBlock + 1) {
    tasks.append(l.tasks);
    task_contacts.append(l.tasks * kMostContacts);
    patch_vertices.append(l.tasks * kMostPatchVertices);
    queued_hits.append(l.queued_hits);
    fragments.append((l.tasks + 1) * kMostParts);
}

State::Pools::Pools(const State& s)
    : bodies(s.bodies.limit(), 1, ranges_of(s.bodies)),
      shells(s.shells.limit(), 1, ranges_of(s.shells)),
      vertices(s.vertices.limit(), kVerticesPerCell, ranges_of(s.shells)),
      elements(s.elements.limit(), 16, ranges_of(s.shells)),
      hinges(s.hinges.limit(), 16, ranges_of(s.shells)),
      packs(s.stiffness_packs.limit(), 8, ranges_of(s.shells)),
      blocks(s.stiffness_blocks.limit(), 1, ranges_of(s.shells)),
      links(s.stiffness_links.limit(), 1, ranges_of(s.shells)),
      cells(s.cells.limit(), 1, ranges_of(s.shells)),
      points(s.hull_points.limit(), 1, ranges_of(s.shells)),
      view_vertices(s.view_vertices.limit(), 16, ranges_of(s.bodies)),
      view_indices(s.view_indices.limit(), 16, ranges_of(s.bodies)),
      shell_springs(s.shell_springs.limit(), 1, ranges_of(s.shells)),
      springs(s.springs.limit(), 16, ranges_of(s.shells)),
      layer_springs(s.layer_springs.limit(), 16, ranges_of(s.shells)),
      element_springs(s.element_springs.limit(), 16, ranges_of(s.shells)),
      spring_packs(s.spring_packs.limit(), 8, ranges_of(s.shells)),
      spring_slots(s.spring_slots.limit(), 1, ranges_of(s.shells)),
      layer_slots(s.layer_slots.limit(), 1, ranges_of(s.shells)),
      twins(s.twins.limit(), kVerticesPerCell, ranges_of(s.shells)) {}

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
    commit(vertices, pools.vertices, times(2, shell.vertices) + 512);
    commit(elements, pools.elements, times(2, shell.elements) + 1024);
    commit(triangle_springs, pools.elements, times(2, shell.elements) + 1024);
    commit(hinges, pools.hinges, times(2, shell.hinges) + 1536);
    commit(stiffness_packs, pools.packs, times(2, shell.vertices / kLanes));
    commit(stiffness_blocks, pools.blocks, times(2, shell.blocks));
    commit(stiffness_links, pools.links, times(2, shell.links));
    commit(cells, pools.cells, times(3, shell.cells));
    commit(hull_points, pools.points, times(2 * kMostCellPoints, shell.cells));
    commit(view_vertices, pools.view_vertices, times(12, shell.elements));
    commit(view_indices, pools.view_indices, times(12, shell.elements));
    // The springs of a region (quick mode): of all the body, when it is small. What cracks add is a few per cent, and a
    // third of the vertices at least are rows to spare.
    if (quick_bodies.size() == 0) return;
    const bool has_layers = std::count(quick_bodies.layers.data(), quick_bodies.layers.data() + quick_bodies.size(), 2);
    const uint64_t edges = times(3, shell.vertices) / 2, slots = times(5, shell.vertices) / kLanes;
    commit(springs, pools.springs, edges);
    commit(element_springs, pools.element_springs, times(1, shell.elements));
    commit(spring_packs, pools.spring_packs, times(1, shell.vertices / kLanes));
    commit(spring_slots, pools.spring_slots, slots);
    if (!has_layers) return;
    commit(layer_springs, pools.layer_springs, edges);
    commit(layer_slots, pools.layer_slots, slots);
    commit(twins, pools.twins, times(1, shell.vertices));
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
    const auto all = pools.all();
    for (size_t k = 0; k < all.size(); ++k)
        if (k < Pools::kFirstOptional || shell_springs.size() > 0) hash = all[k]->hash(hash);
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

namespace {

// Rows that nobody has reached before get their memory at once: those to spare are written late, and what is resident
// would grow for as long as a game runs.
void grow(AnyTable& table, uint32_t rows) {
    if (rows <= table.size()) return;
    table.commit_rows(rows);
    table.append(rows - table.size());
}

// Rows of `table` for a range, growing the table to reach them. False when there is no room.
bool take(AnyTable& table, RangePool& pool, uint32_t count, Range& range) {
    range = {0, 0, 0};
    if (count == 0) return true;
    const uint32_t first = pool.take(count);
    if (first == kNone) return false;
    grow(table, pool.end());
    range = {first, 0, count};
    return true;
}

}  // namespace

namespace {

// Whoever had these rows before kept sums of others.
void forget_blocks(State& state, const Range& vertices) {
    const uint32_t first = vertices.first / kVerticesPerBlock;
    const uint32_t end = (vertices.first + vertices.capacity + kVerticesPerBlock - 1) / kVerticesPerBlock;
    for (uint8_t* flags : {state.vertex_blocks.sums.data(), state.vertex_blocks.moves.data()})
        std::fill(flags + first, flags + end, uint8_t{0});
}

}  // namespace

ShellRoom room_of(const State& state, Row<Shells> shell) {
    const Shells& s = state.shells;
    ShellRoom room;
    room.vertices = s.vertices[shell].capacity;
    room.elements = s.elements[shell].count;
    room.hinges = s.hinges[shell].count;
    room.blocks = s.blocks[shell].count;
    room.links = s.links[shell].count;
    room.cells = s.cells[shell].count;
    room.points = s.points[shell].count;
    return room;
}

Row<Shells> make_shell_unclear(State& state, const ShellRoom& room, const char** full) {
    Range row_range;
    const char* missing = nullptr;  // the first
    const auto refuse = [&](const char* limit) { missing = missing ? missing : limit; };
    if (!take(state.shells, state.pools.shells, 1, row_range)) {
        if (full) *full = "limits.shells";
        return {};
    }
    const Row<Shells> shell(row_range.first);
    Shells& s = state.shells;
    s.clear_rows(shell, 1);
    if (!take(state.vertices, state.pools.vertices, room.vertices, s.vertices[shell])) refuse("limits.vertices");
    if (!take(state.elements, state.pools.elements, room.elements, s.elements[shell])) refuse("limits.elements");
    grow(state.triangle_springs, state.elements.size());
    if (!take(state.hinges, state.pools.hinges, room.hinges, s.hinges[shell])) refuse("limits.elements");
    const uint32_t packs = room.blocks ? (room.vertices + kLanes - 1) / kLanes : 0;
    if (!take(state.stiffness_packs, state.pools.packs, packs, s.packs[shell])) refuse("limits.vertices");
    if (!take(state.stiffness_blocks, state.pools.blocks, room.blocks, s.blocks[shell])) refuse("limits.vertices");
    if (!take(state.stiffness_links, state.pools.links, room.links, s.links[shell])) refuse("limits.vertices");
    if (!take(state.cells, state.pools.cells, room.cells, s.cells[shell])) refuse("limits.vertices");
    if (!take(state.hull_points, state.pools.points, room.points, s.points[shell])) refuse("limits.vertices");
    s.users[shell] = 1;
    forget_blocks(state, s.vertices[shell]);
    if (missing) {
        release_shell(state, shell);
        if (full) *full = missing;
        return {};
    }
    return shell;
}

namespace {

void clear_behind(AnyTable& table, const RangePool& pool, const Range& range) {
    const uint32_t end = pool.rounded(range.capacity);
    if (range.count < end) table.clear_rows(range.first + range.count, end - range.count);
}

}  // namespace

void clear_pack_ends(State& state, Row<Shells> shell) {
    const Shells& s = state.shells;
    // The rows between the capacity and the end of what the pool gave are cleared too.
    const Range vertices = s.vertices[shell], elements = s.elements[shell];
    clear_behind(state.vertices, state.pools.vertices, vertices);
    for (uint32_t v = vertices.count; v < state.pools.vertices.rounded(vertices.capacity); ++v)
        state.vertices.element[vertices.first + v] = kNone;
    clear_behind(state.stiffness_packs, state.pools.packs, s.packs[shell]);
    if (elements.count % kLanes == 0) return;
    const uint32_t behind = elements.first + elements.count, lanes = kLanes - elements.count % kLanes;
    state.elements.clear_rows(behind, lanes);
    state.triangle_springs.clear_rows(behind, lanes);
}

Row<Shells> make_shell(State& state, const ShellRoom& room, const char** full) {
    const Row<Shells> shell = make_shell_unclear(state, room, full);
    if (!shell.exists()) return shell;
    clear_pack_ends(state, shell);
    clear_behind(state.elements, state.pools.elements, state.shells.elements[shell]);
    clear_behind(state.triangle_springs, state.pools.elements, state.shells.elements[shell]);
    clear_behind(state.hinges, state.pools.hinges, state.shells.hinges[shell]);
    return shell;
}

void drop_stiffness(State& state, Row<Shells> shell) {
    Shells& s = state.shells;
    state.pools.packs.give_back(s.packs[shell].first, s.packs[shell].capacity);
    state.pools.blocks.give_back(s.blocks[shell].first, s.blocks[shell].capacity);
    state.pools.links.give_back(s.links[shell].first, s.links[shell].capacity);
    s.packs[shell] = s.blocks[shell] = s.links[shell] = {};
}

bool take_points(State& state, uint32_t count, Range& range) {
    return take(state.hull_points, state.pools.points, count, range);
}

void release_shell(State& state, Row<Shells> shell) {
    Shells& s = state.shells;
    CULLET_ASSERT(s.users[shell] > 0, "shell %u released more often than taken", shell.index);
    if (--s.users[shell] > 0) return;
    const auto back = [](RangePool& pool, Range range) { pool.give_back(range.first, range.capacity); };
    back(state.pools.vertices, s.vertices[shell]);
    back(state.pools.elements, s.elements[shell]);
    back(state.pools.hinges, s.hinges[shell]);
    back(state.pools.packs, s.packs[shell]);
    back(state.pools.blocks, s.blocks[shell]);
    back(state.pools.links, s.links[shell]);
    back(state.pools.cells, s.cells[shell]);
    back(state.pools.points, s.points[shell]);
    release_springs(state, shell);
    s.clear_rows(shell, 1);
    state.pools.shells.give_back(shell, 1);
}

void copy_shell_rows(State& to, const State& from, Row<Shells> source, Row<Shells> copy, bool with_stiffness) {
    Shells& s = to.shells;
    const Range own[] = {s.vertices[copy], s.elements[copy], s.hinges[copy], s.packs[copy],
                         s.blocks[copy],   s.links[copy],    s.cells[copy],  s.points[copy]};
    const uint32_t users = s.users[copy];
    s.copy_rows(from.shells, source, copy, 1);
    s.users[copy] = users;
    const auto copy_range = [&](AnyTable& table, const AnyTable& old, Column<Range>& column, const Range& range,
                                bool is_wanted) {
        const Range found = column[copy];  // the source's, copied above
        const uint32_t count = is_wanted ? found.count : 0;
        CULLET_ASSERT(count <= range.capacity, "copy of %s: %u rows do not fit %u", table.name(), count,
                      range.capacity);
        column[copy] = {range.first, count, range.capacity};
        if (count) table.copy_rows(old, found.first, range.first, count);
    };
    const uint32_t first_element = s.elements[copy].first;
    copy_range(to.vertices, from.vertices, s.vertices, own[0], true);
    copy_range(to.elements, from.elements, s.elements, own[1], true);
    to.triangle_springs.copy_rows(from.triangle_springs, first_element, own[1].first, s.elements[copy].count);
    copy_range(to.hinges, from.hinges, s.hinges, own[2], true);
    copy_range(to.stiffness_packs, from.stiffness_packs, s.packs, own[3], with_stiffness);
    copy_range(to.stiffness_blocks, from.stiffness_blocks, s.blocks, own[4], with_stiffness);
    copy_range(to.stiffness_links, from.stiffness_links, s.links, own[5], with_stiffness);
    copy_range(to.cells, from.cells, s.cells, own[6], own[6].capacity > 0);
    copy_range(to.hull_points, from.hull_points, s.points, own[7], own[7].capacity > 0);
    // The number of cells says how stiffness is stored (pair_cells.hpp).
    CULLET_ASSERT(s.packs[copy].count == 0 || s.cells[copy].count == from.shells.cells[source].count,
                  "copy of shell %u has its stiffness but %u of its %u cells", source.index, s.cells[copy].count,
                  from.shells.cells[source].count);
}

Row<Shells> copy_shell(State& state, Row<Shells> source, const ShellRoom& room, const char** full) {
    const Row<Shells> copy = make_shell(state, room, full);
    if (!copy.exists()) return copy;
    copy_shell_rows(state, state, source, copy, room.blocks > 0);
    if (room.with_springs && !copy_springs(state, source, copy, full)) {
        release_shell(state, copy);
        return {};
    }
    return copy;
}

}  // namespace cullet
