#include "components/state.hpp"
#include "components/workbench.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "engine/random.hpp"

namespace cullet {
namespace {

Limits small_limits() {
    Limits limits;
    limits.bodies = 32, limits.structures = 16, limits.vertices = 4096, limits.elements = 8192, limits.tasks = 2;
    limits.models = 4, limits.view_vertices = 1024, limits.debris = 16;
    return limits;
}

const ShellRoom kRoom{70, 120, 150, 60, 40, 5, 90};  // 70 vertices: 9 packs, a range of 128 rows

uint64_t hash_of_pools(const State& state) {
    uint64_t hash = 0;
    for (const RangePool* pool : {&state.shells.pool, &state.vertices.pool, &state.elements.pool, &state.hinges.pool,
                                  &state.stiffness_packs.pool, &state.stiffness_blocks.pool,
                                  &state.stiffness_links.pool, &state.cells.pool, &state.hull_points.pool})
        hash = pool->hash(hash);
    return hash;
}

// All ranges of a shell with the tables that they are in.
struct Part {
    AnyTable* table;
    Range* range;
};
std::vector<Part> parts(State& state, Row<Structures> shell) {
    std::vector<Part> list;
    ShellRows::for_each_range(state, shell, [&](Range& range, AnyTable& table, auto, const char*) {
        list.push_back({&table, &range});
    });
    return list;
}

void expect_disjoint(State& state, const std::vector<Row<Structures>>& shells) {
    std::map<AnyTable*, std::vector<bool>> is_taken;
    for (const Row<Structures> shell : shells)
        for (const auto& [table, range] : parts(state, shell)) {
            std::vector<bool>& rows = is_taken.try_emplace(table, table->limit()).first->second;
            ASSERT_LE(range->first + range->capacity, table->size());
            for (uint32_t r = range->first; r < range->first + range->capacity; ++r) {
                ASSERT_FALSE(rows[r]) << table->name();
                rows[r] = true;
            }
        }
}

TEST(State, TablesWithoutRowsLeaveTheHashAlone) {
    State state(small_limits());
    uint64_t hash = 0;
    uint32_t empty = 0, ranged = 0;
    state.for_each_table([&](const AnyTable& t) {
        if (t.size() > 0)
            hash = t.hash(hash);
        else
            ++empty;
    });
    uint32_t pools = 0;
    state.for_each_pool([&](const RangePool& pool) { ++pools, ranged += pool.end() == 0; });
    EXPECT_EQ(state.hash(), hash);
    EXPECT_GT(empty, 30u);
    EXPECT_EQ(ranged, pools);
    make_shell(state, kRoom);
    const uint64_t with_a_shell = state.hash();
    EXPECT_NE(with_a_shell, hash);
    state.springs.append(1);
    EXPECT_NE(state.hash(), with_a_shell);
}

TEST(State, AStructureNamesItsShellWhereverThatStands) {
    State state(small_limits());
    Range none;
    ASSERT_TRUE(state.shells.take(3, none));  // another kind of structure would leave such a difference
    const Row<Structures> first = make_shell(state, kRoom), second = copy_shell(state, first, kRoom);
    for (const Row<Structures> structure : {first, second}) {
        const ShellView view(state, structure);
        EXPECT_EQ(view.row, structure + 3u);
        EXPECT_EQ(view.vertices().capacity, kRoom.vertices);
        EXPECT_FALSE(springs_of(state, structure).exists());
    }
    release_shell(state, first);
    release_shell(state, second);
    EXPECT_EQ(state.structures.pool.end(), 0u);
    EXPECT_EQ(state.shells.pool.end(), 3u);
}

TEST(State, AShellHasTheRangesThatWereAskedForAndNoRowsYet) {
    State state(small_limits());
    const Row<Structures> shell = make_shell(state, kRoom);
    ASSERT_TRUE(shell.exists());
    const uint32_t wanted[] = {70, 120, 150, 9, 60, 40, 5, 90};
    const auto list = parts(state, shell);
    for (size_t p = 0; p < list.size(); ++p) {
        EXPECT_EQ(list[p].range->capacity, wanted[p]) << list[p].table->name();
        EXPECT_EQ(list[p].range->count, 0u);
    }
    EXPECT_EQ(state.structures.users[shell], 1u);
    EXPECT_GE(state.triangle_springs.size(), state.shells.elements[state.shell_of(shell)].first + 120);
}

TEST(State, VertexRowsStartDeadToTheEndOfTheirLastPackAlsoWhereOthersLived) {
    State state(small_limits());
    const Row<Structures> before = make_shell(state, kRoom);
    for (uint32_t v = 0; v < 128; ++v) {
        state.vertices.element[v] = 3;
        state.vertices.inverse_mass[v] = 1;
        state.vertices.velocity.set(v, {1, 2, 3});
    }
    release_shell(state, before);
    const Row<Structures> shell = make_shell(state, kRoom);
    ASSERT_EQ(state.shells.vertices[state.shell_of(shell)].first, 0u);
    for (uint32_t v = 0; v < 128; ++v) {
        ASSERT_EQ(state.vertices.element[v], kNone) << v;
        ASSERT_EQ(state.vertices.inverse_mass[v], 0.0f) << v;
        ASSERT_EQ(state.vertices.velocity[v], (Vec3{})) << v;
    }
}

TEST(State, RangesOfShellsAreApartAndVerticesStartAtACell) {
    State state(small_limits());
    std::vector<Row<Structures>> shells;
    for (uint32_t n = 0; n < 10; ++n) {
        shells.push_back(make_shell(state, {10 + 37 * n, 50 + 11 * n, 3 * n, n % 2 * 40, n % 2 * 7, n, 5 * n}));
        ASSERT_TRUE(shells.back().exists());
        EXPECT_EQ(state.shells.vertices[state.shell_of(shells.back())].first % 64, 0u);
    }
    expect_disjoint(state, shells);
}

TEST(State, AFullTableNamesItsLimitAndEverythingGoesBack) {
    State state(small_limits());
    const uint64_t empty = hash_of_pools(state);
    const struct {
        ShellRoom room;
        const char* limit;
    } cases[] = {
        {{5000, 10, 10, 10, 10, 1, 1}, "limits.vertices"},    {{10, 9000, 10, 10, 10, 1, 1}, "limits.elements"},
        {{10, 10, 20000, 10, 10, 1, 1}, "limits.elements"},   {{10, 10, 10, 100000, 10, 1, 1}, "limits.vertices"},
        {{10, 10, 10, 10, 100000, 1, 1}, "limits.vertices"},  {{10, 10, 10, 10, 10, 10000, 1}, "limits.vertices"},
        {{10, 10, 10, 10, 10, 1, 100000}, "limits.vertices"}, {{10, 0xffffffffu, 10, 10, 10, 1, 1}, "limits.elements"},
        {{5000, 9000, 10, 10, 10, 1, 1}, "limits.vertices"},  // the first that is full
    };
    for (const auto& c : cases) {
        const char* full = nullptr;
        EXPECT_FALSE(make_shell(state, c.room, &full).exists());
        EXPECT_STREQ(full, c.limit);
        EXPECT_EQ(hash_of_pools(state), empty);
        EXPECT_FALSE(make_shell(state, c.room).exists()) << "nobody has to ask why";
    }
    const ShellRoom little{1, 1, 1, 0, 0, 0, 0};
    for (uint32_t n = 0; n < 16; ++n) ASSERT_TRUE(make_shell(state, little).exists());
    const char* full = nullptr;
    EXPECT_FALSE(make_shell(state, little, &full).exists());
    EXPECT_STREQ(full, "limits.structures");
}

TEST(State, TheLastUserGivesTheRowsBack) {
    State state(small_limits());
    const uint64_t empty = hash_of_pools(state);
    const Row<Structures> shell = make_shell(state, kRoom);
    const uint64_t taken = hash_of_pools(state);
    ++state.structures.users[shell];
    release_shell(state, shell);
    EXPECT_EQ(hash_of_pools(state), taken);
    release_shell(state, shell);
    EXPECT_EQ(hash_of_pools(state), empty);
    EXPECT_EQ(state.structures.users[shell], 0u);
}

// Marks rows so that a copy can be told: number n of the table is n + 1 in some column.
void fill(State& state, Row<Structures> shell) {
    const ShellView view(state, shell);
    const uint32_t counts[] = {65, 100, 140, 9, 55, 33, 4, 80};
    const auto list = parts(state, shell);
    for (size_t p = 0; p < list.size(); ++p) list[p].range->count = counts[p];
    for (uint32_t v = 0; v < 65; ++v) {
        const uint32_t row = view.vertex(v);
        state.vertices.rest.set(row, {static_cast<float>(v), 1, 2});
        state.vertices.probe.set(row, {1, 2, 3, static_cast<float>(v)}, 1);
        state.vertices.element[row] = v;
    }
    for (uint32_t e = 0; e < 100; ++e) {
        state.elements.corner[view.element(e)] = {e, e + 1, e + 2};
        state.triangle_springs.area[view.element(e)] = static_cast<float>(e);
    }
    for (uint32_t b = 0; b < 55; ++b) state.stiffness_blocks.block[state.shells.blocks[view.row].first + b].k[8][7] = 5;
    state.structures.mass[shell] = 12;
}

TEST(State, ACopyHasTheRowsAndItsOwnRanges) {
    State state(small_limits());
    make_shell(state, {100, 10, 10, 0, 0, 0, 0});  // so that nothing starts at zero
    const Row<Structures> source = make_shell(state, kRoom);
    fill(state, source);
    state.structures.users[source] = 5;
    const ShellRoom room{100, 180, 200, 80, 60, 6, 100};
    const Row<Structures> copy = copy_shell(state, source, room);
    ASSERT_TRUE(copy.exists());
    const Structures& s = state.structures;
    EXPECT_EQ(s.users[copy], 1u);
    EXPECT_EQ(s.users[source], 5u);
    EXPECT_EQ(s.mass[copy], 12.0);
    expect_disjoint(state, {Row<Structures>(0), source, copy});
    const auto had = parts(state, source), has = parts(state, copy);
    for (size_t p = 0; p < had.size(); ++p) {
        const AnyTable& table = *had[p].table;
        const Range a = *had[p].range, b = *has[p].range;
        EXPECT_EQ(a.count, b.count) << table.name();
        EXPECT_GE(b.capacity, a.capacity);
        for (uint32_t r = 0; r < a.count; ++r) {
            const std::string x = table.describe_row(a.first + r), y = table.describe_row(b.first + r);
            ASSERT_EQ(x.substr(x.find(']')), y.substr(y.find(']')));
        }
    }
    const ShellView view(state, copy);
    EXPECT_EQ(state.triangle_springs.area[view.element(99)], 99.0f);
    EXPECT_EQ(state.vertices.probe.get(view.vertex(64), 1).w, 64.0f);
    EXPECT_EQ(state.vertices.element[view.vertex(65)], kNone);
    EXPECT_EQ(state.stiffness_blocks.block[state.shells.blocks[view.row].first + 54].k[8][7], 5.0f);
}

TEST(State, ACopyWithoutRoomForStiffnessHasNone) {
    State state(small_limits());
    const Row<Structures> source = make_shell(state, kRoom);
    fill(state, source);
    ShellRoom room = kRoom;
    room.blocks = room.links = 0;
    const Row<Structures> copy = copy_shell(state, source, room);
    ASSERT_TRUE(copy.exists());
    EXPECT_EQ(state.shells.packs[state.shell_of(copy)].capacity, 0u);
    EXPECT_EQ(state.shells.packs[state.shell_of(copy)].count, 0u);
    EXPECT_EQ(state.shells.blocks[state.shell_of(copy)].count, 0u);
    EXPECT_EQ(state.shells.vertices[state.shell_of(copy)].count, 65u);
}

TEST(State, ACopyThatDoesNotFitChangesNothing) {
    State state(small_limits());
    const Row<Structures> source = make_shell(state, kRoom);
    fill(state, source);
    const uint64_t pools = hash_of_pools(state);
    const std::string row = state.shells.describe_row(source);
    ShellRoom room = kRoom;
    room.elements = 9000;
    const char* full = nullptr;
    EXPECT_FALSE(copy_shell(state, source, room, &full).exists());
    EXPECT_STREQ(full, "limits.elements");
    EXPECT_EQ(hash_of_pools(state), pools);
    EXPECT_EQ(state.shells.describe_row(source), row);
}

TEST(State, AfterManyShellsCameAndWentEverythingIsBack) {
    State state(small_limits());
    const uint64_t empty = hash_of_pools(state);
    const Random random{9};
    std::vector<Row<Structures>> shells;
    uint32_t refused = 0;
    for (uint32_t n = 0; n < 3000; ++n) {
        if (shells.empty() || random.uniform(n) < 0.6) {
            const auto size = 1 + static_cast<uint32_t>(random.bits(n, 1) % 900);
            const ShellRoom room{size, 2 * size, 3 * size, size / 2, size / 3, size / 50, size / 4};
            const bool copies = !shells.empty() && random.uniform(n, 2) < 0.3;
            const Row<Structures> made =
                copies ? copy_shell(state, shells[random.bits(n, 3) % shells.size()], room) : make_shell(state, room);
            if (made.exists())
                shells.push_back(made);
            else
                ++refused;
        } else {
            const size_t which = random.bits(n, 4) % shells.size();
            release_shell(state, shells[which]);
            shells.erase(shells.begin() + static_cast<std::ptrdiff_t>(which));
        }
        if (n % 100 == 0) expect_disjoint(state, shells);
    }
    EXPECT_GT(refused, 20u);
    for (const Row<Structures> shell : shells) release_shell(state, shell);
    EXPECT_EQ(hash_of_pools(state), empty);
}

TEST(State, WhoEditsWholeShellsClaimsTheirSpringsAndReadsTheirMaterials) {
    std::vector<Access> claimed;
    Parameter<ShellRows&>::describe(claimed);
    std::map<std::string, bool> is_written;
    for (const Access& access : claimed) EXPECT_TRUE(is_written.emplace(access.name, access.writes).second);
    for (const char* table :
         {Shells::kName, Vertices::kName, Elements::kName, ShellSprings::kName, Springs::kName, LayerSprings::kName,
          ElementSprings::kName, SpringPacks::kName, SpringSlots::kName, LayerSlots::kName, Twins::kName}) {
        ASSERT_TRUE(is_written.contains(table)) << table;
        EXPECT_TRUE(is_written[table]) << table;
    }
    for (const char* table : {Materials::kName, MaterialTraits::kName}) {
        ASSERT_TRUE(is_written.contains(table)) << table;
        EXPECT_FALSE(is_written[table]) << table;
    }
}

template <class From, class To>
constexpr bool kGives = std::is_convertible_v<From&, To&>;
template <class From, class List>
constexpr bool kMakes = std::is_convertible_v<From&, List>;

TEST(State, ASetGivesWhatItStandsOnAndNeverMore) {
    static_assert(kGives<State, WorldRows> && kGives<WorldRows, SoftRows> && kGives<SoftRows, BodyRows> &&
                  kGives<BodyRows, RunRows>);
    static_assert(kGives<RunRows, ShellRows> && kGives<ShellRows, const MaterialRows>);
    static_assert(!kGives<ShellRows, RunRows> && !kGives<RunRows, BodyRows> && !kGives<BodyRows, SoftRows>);
    static_assert(!kGives<WorldRows, State>, "no helper finds its way back to everything");
    static_assert(!kGives<const RunRows, ShellRows>, "who reads does not write");
    static_assert(!std::is_assignable_v<decltype((std::declval<RunRows&>().materials.density[0])), float>,
                  "only the game changes materials");
    static_assert(!kGives<SoftRows, WorldRows> && !kMakes<SoftRows, MetalTables> && !kMakes<SoftRows, SolidRows>,
                  "what the thick shell has reaches no metal and no solid");
    static_assert(kMakes<WorldRows, MetalRows> && !kMakes<MetalRows, SolidRows> && !kGives<MetalRows, RunRows>,
                  "metal reaches no solid, and no run of the thick shell");
    static_assert(kMakes<WorldRows, LatticeRows> && !kMakes<LatticeRows, MetalTables> &&
                      !kGives<LatticeRows, ShellRows> && !kGives<LatticeRows, const ShellRows>,
                  "what breaks solids reaches no shell");
    static_assert(kMakes<const WorldRows, Read<MetalRows>> && !kMakes<const WorldRows, MetalRows>,
                  "who reads does not write");
    static_assert(kGives<Workbench, RunRows> && kMakes<Workbench, StructuresOfAllKinds> && !kGives<Workbench, BodyRows>,
                  "cooking has no bodies");
}

TEST(State, EveryTableIsListedOnce) {
    // The struct holds the listed tables, the limits of each set, scratch memory and what finds the materials. It also
    // holds the sums of vertices and the rooms in which solids break, which are made anew from the listed ones. It
    // holds nothing else: their sizes add up.
    State state(small_limits());
    size_t bytes = 0;
    std::set<std::string> names;
    state.for_each_table([&](const auto& table) {
        bytes += sizeof(table);
        EXPECT_TRUE(names.insert(table.name()).second) << table.name();
    });
    constexpr size_t limits = (sizeof(Limits) + alignof(State) - 1) / alignof(State) * alignof(State);
    const size_t sets = []<class... Set>(TypeList<Set...>) { return sizeof...(Set); }(State::Sets{});
    EXPECT_EQ(bytes + sizeof(MaterialRows) + sizeof(VertexBlocks) + sizeof(ScratchMemory) + sizeof(state.solid_work) +
                  sets * limits,
              sizeof(State));
}

TEST(State, HashValidationAndDifferenceReachTheLastTable) {
    State a(small_limits()), b(small_limits());
    EXPECT_EQ(a.hash(), b.hash());
    a.view_indices.append(3), b.view_indices.append(3);
    a.view_vertices.append(1), b.view_vertices.append(1);
    a.view_indices.index[2] = 7;
    EXPECT_NE(a.hash(), b.hash());
    EXPECT_EQ(a.first_difference(b), "view_indices.index[2]: 7 here, 0 there");
    EXPECT_EQ(a.validate(), "");
    a.view_vertices.vertex[0].uv.y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(a.validate(), "view_vertices.vertex[0] is 0 0 0 0 0 0 0 inf, not a finite number");
    a.view_indices.index[2] = 0;
    a.view_vertices.vertex[0].uv.y = 0;
    EXPECT_EQ(a.hash(), b.hash());
    Range first, second;
    for (State* state : {&a, &b}) ASSERT_TRUE(state->shells.take(1, first) && state->shells.take(1, second));
    EXPECT_EQ(a.hash(), b.hash());
    a.shells.give_back(first);
    EXPECT_NE(a.hash(), b.hash()) << "what is taken decides what comes next";
}

TEST(State, EachTableIsFoundByItsType) {
    State state(small_limits());
    EXPECT_EQ(&state.table<Hinges>(), &state.hinges);
    EXPECT_EQ(&state.table<Materials>(), &state.materials);
    EXPECT_EQ(&state.table<ViewIndices>(), &state.view_indices);
}

}  // namespace
}  // namespace cullet
