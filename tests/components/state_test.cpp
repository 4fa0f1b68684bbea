#include "components/state.hpp"
#include "components/workbench.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "engine/random.hpp"

namespace cullet {
namespace {

Limits small_limits() {
    Limits limits;
    limits.bodies = 32, limits.shells = 16, limits.vertices = 4096, limits.elements = 8192, limits.tasks = 2;
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
    Column<Range>* column;
};
std::vector<Part> parts(State& state) {
    Shells& s = state.shells;
    return {
        {&state.vertices, &s.vertices},     {&state.elements, &s.elements},       {&state.hinges, &s.hinges},
        {&state.stiffness_packs, &s.packs}, {&state.stiffness_blocks, &s.blocks}, {&state.stiffness_links, &s.links},
        {&state.cells, &s.cells},           {&state.hull_points, &s.points}};
}

void expect_disjoint(State& state, const std::vector<Row<Shells>>& shells) {
    for (const Part& part : parts(state)) {
        std::vector<bool> is_taken(part.table->limit());
        for (const Row<Shells> shell : shells) {
            const Range range = (*part.column)[shell];
            ASSERT_LE(range.first + range.capacity, part.table->size());
            for (uint32_t r = 0; r < range.capacity; ++r) {
                ASSERT_FALSE(is_taken[range.first + r]) << part.table->name();
                is_taken[range.first + r] = true;
            }
        }
    }
}

TEST(State, AShellHasTheRangesThatWereAskedForAndNoRowsYet) {
    State state(small_limits());
    const Row<Shells> shell = make_shell(state, kRoom);
    ASSERT_TRUE(shell.exists());
    const uint32_t wanted[] = {70, 120, 150, 9, 60, 40, 5, 90};
    const auto list = parts(state);
    for (size_t p = 0; p < list.size(); ++p) {
        EXPECT_EQ((*list[p].column)[shell].capacity, wanted[p]) << list[p].table->name();
        EXPECT_EQ((*list[p].column)[shell].count, 0u);
    }
    EXPECT_EQ(state.shells.users[shell], 1u);
    EXPECT_GE(state.triangle_springs.size(), state.shells.elements[shell].first + 120);
}

TEST(State, VertexRowsStartDeadToTheEndOfTheirLastPackAlsoWhereOthersLived) {
    State state(small_limits());
    const Row<Shells> before = make_shell(state, kRoom);
    for (uint32_t v = 0; v < 128; ++v) {
        state.vertices.element[v] = 3;
        state.vertices.inverse_mass[v] = 1;
        state.vertices.velocity.set(v, {1, 2, 3});
    }
    release_shell(state, before);
    const Row<Shells> shell = make_shell(state, kRoom);
    ASSERT_EQ(state.shells.vertices[shell].first, 0u);
    for (uint32_t v = 0; v < 128; ++v) {
        ASSERT_EQ(state.vertices.element[v], kNone) << v;
        ASSERT_EQ(state.vertices.inverse_mass[v], 0.0f) << v;
        ASSERT_EQ(state.vertices.velocity[v], (Vec3{})) << v;
    }
}

TEST(State, RangesOfShellsAreApartAndVerticesStartAtACell) {
    State state(small_limits());
    std::vector<Row<Shells>> shells;
    for (uint32_t n = 0; n < 10; ++n) {
        shells.push_back(make_shell(state, {10 + 37 * n, 50 + 11 * n, 3 * n, n % 2 * 40, n % 2 * 7, n, 5 * n}));
        ASSERT_TRUE(shells.back().exists());
        EXPECT_EQ(state.shells.vertices[shells.back()].first % 64, 0u);
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
    EXPECT_STREQ(full, "limits.shells");
}

TEST(State, TheLastUserGivesTheRowsBack) {
    State state(small_limits());
    const uint64_t empty = hash_of_pools(state);
    const Row<Shells> shell = make_shell(state, kRoom);
    const uint64_t taken = hash_of_pools(state);
    ++state.shells.users[shell];
    release_shell(state, shell);
    EXPECT_EQ(hash_of_pools(state), taken);
    release_shell(state, shell);
    EXPECT_EQ(hash_of_pools(state), empty);
    EXPECT_EQ(state.shells.users[shell], 0u);
}

// Marks rows so that a copy can be told: number n of the table is n + 1 in some column.
void fill(State& state, Row<Shells> shell) {
    Shells& s = state.shells;
    const uint32_t counts[] = {65, 100, 140, 9, 55, 33, 4, 80};
    const auto list = parts(state);
    for (size_t p = 0; p < list.size(); ++p) (*list[p].column)[shell].count = counts[p];
    for (uint32_t v = 0; v < 65; ++v) {
        const uint32_t row = s.vertices[shell].first + v;
        state.vertices.rest.set(row, {static_cast<float>(v), 1, 2});
        state.vertices.probe.set(row, {1, 2, 3, static_cast<float>(v)}, 1);
        state.vertices.element[row] = v;
    }
    for (uint32_t e = 0; e < 100; ++e) {
        state.elements.corner[s.elements[shell].first + e] = {e, e + 1, e + 2};
        state.triangle_springs.area[s.elements[shell].first + e] = static_cast<float>(e);
    }
    for (uint32_t b = 0; b < 55; ++b) state.stiffness_blocks.block[s.blocks[shell].first + b].k[8][7] = 5;
    s.mass[shell] = 12;
}

TEST(State, ACopyHasTheRowsAndItsOwnRanges) {
    State state(small_limits());
    make_shell(state, {100, 10, 10, 0, 0, 0, 0});  // so that nothing starts at zero
    const Row<Shells> source = make_shell(state, kRoom);
    fill(state, source);
    state.shells.users[source] = 5;
    const ShellRoom room{100, 180, 200, 80, 60, 6, 100};
    const Row<Shells> copy = copy_shell(state, source, room);
    ASSERT_TRUE(copy.exists());
    const Shells& s = state.shells;
    EXPECT_EQ(s.users[copy], 1u);
    EXPECT_EQ(s.users[source], 5u);
    EXPECT_EQ(s.mass[copy], 12.0);
    expect_disjoint(state, {Row<Shells>(0), source, copy});
    for (const Part& part : parts(state)) {
        const Range a = (*part.column)[source], b = (*part.column)[copy];
        EXPECT_EQ(a.count, b.count) << part.table->name();
        EXPECT_GE(b.capacity, a.capacity);
        for (uint32_t r = 0; r < a.count; ++r) {
            const std::string x = part.table->describe_row(a.first + r), y = part.table->describe_row(b.first + r);
            ASSERT_EQ(x.substr(x.find(']')), y.substr(y.find(']')));
        }
    }
    EXPECT_EQ(state.triangle_springs.area[s.elements[copy].first + 99], 99.0f);
    EXPECT_EQ(state.vertices.probe.get(s.vertices[copy].first + 64, 1).w, 64.0f);
    EXPECT_EQ(state.vertices.element[s.vertices[copy].first + 65], kNone);
    EXPECT_EQ(state.stiffness_blocks.block[s.blocks[copy].first + 54].k[8][7], 5.0f);
}

TEST(State, ACopyWithoutRoomForStiffnessHasNone) {
    State state(small_limits());
    const Row<Shells> source = make_shell(state, kRoom);
    fill(state, source);
    ShellRoom room = kRoom;
    room.blocks = room.links = 0;
    const Row<Shells> copy = copy_shell(state, source, room);
    ASSERT_TRUE(copy.exists());
    EXPECT_EQ(state.shells.packs[copy].capacity, 0u);
    EXPECT_EQ(state.shells.packs[copy].count, 0u);
    EXPECT_EQ(state.shells.blocks[copy].count, 0u);
    EXPECT_EQ(state.shells.vertices[copy].count, 65u);
}

TEST(State, ACopyThatDoesNotFitChangesNothing) {
    State state(small_limits());
    const Row<Shells> source = make_shell(state, kRoom);
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
    std::vector<Row<Shells>> shells;
    uint32_t refused = 0;
    for (uint32_t n = 0; n < 3000; ++n) {
        if (shells.empty() || random.uniform(n) < 0.6) {
            const auto size = 1 + static_cast<uint32_t>(random.bits(n, 1) % 900);
            const ShellRoom room{size, 2 * size, 3 * size, size / 2, size / 3, size / 50, size / 4};
            const bool copies = !shells.empty() && random.uniform(n, 2) < 0.3;
            const Row<Shells> made =
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
    for (const Row<Shells> shell : shells) release_shell(state, shell);
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

TEST(State, ASetGivesWhatItStandsOnAndNeverMore) {
    static_assert(kGives<State, SoftRows> && kGives<SoftRows, BodyRows> && kGives<BodyRows, RunRows>);
    static_assert(kGives<RunRows, ShellRows> && kGives<ShellRows, const MaterialRows>);
    static_assert(!kGives<ShellRows, RunRows> && !kGives<RunRows, BodyRows> && !kGives<BodyRows, SoftRows>);
    static_assert(!kGives<SoftRows, State>, "no helper finds its way back to everything");
    static_assert(!kGives<const RunRows, ShellRows>, "who reads does not write");
    static_assert(!std::is_assignable_v<decltype((std::declval<RunRows&>().materials.density[0])), float>,
                  "only the game changes materials");
    static_assert(kGives<Workbench, RunRows> && !kGives<Workbench, BodyRows>, "cooking has no bodies");
}

TEST(State, EveryTableIsListedOnce) {
    // The struct holds nothing but the listed tables, the limits, scratch memory, what finds the materials, and the
    // sums of vertices, which are made anew from the listed ones: their sizes add up.
    size_t bytes = 0;
    constexpr size_t limits = (sizeof(Limits) + alignof(State) - 1) / alignof(State) * alignof(State);
    std::apply([&](auto... table) { ((bytes += sizeof(std::declval<State&>().*table)), ...); }, State::tables());
    EXPECT_EQ(bytes + sizeof(MaterialRows) + sizeof(VertexBlocks) + sizeof(ScratchMemory) + limits, sizeof(State));
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
    a.shells.pool.take(1);
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
