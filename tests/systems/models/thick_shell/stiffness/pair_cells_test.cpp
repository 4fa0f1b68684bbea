// Shells that store each pair of a pair cell once, against those that store all pairs twice, and against plain loops.
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "engine/hash.hpp"
#include "engine/jobs.hpp"
#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/models/thick_shell/hidden/integrate_packs.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "tests/support/crack_meshes.hpp"
#include "tests/support/shell_meshes.hpp"

namespace cullet::test {
namespace {

/// Assembles the shell anew, its pairs once or twice.
void assemble(ShellView shell, bool once) {
    shell.cells().count = once ? kPairedCells : 0;
    ASSERT_EQ(stores_pairs_once(shell.structures(), shell.structure), once);
    ASSERT_TRUE(assemble_stiffness(shell));
}

struct Fixture {
    State state;
    Row<Structures> shell;
    Row<Tasks> task;
    explicit Fixture(const ShellMesh& mesh, bool once = true, bool is_wood = false) {
        if (is_wood) fill_materials(state.materials);
        const auto material = is_wood ? material_row({state.materials, state.material_traits, state.structures},
                                                     compiled_materials()[9], {0.6f, 0.8f, 0})
                                      : add_material(state, 70e9, 0.22, 2400);
        shell = make_test_shell(state, mesh, 0.005, material, {}, 64);
        task = make_test_task(state, shell);
        assemble(view(), once);
    }
    ShellView view() { return {state, shell}; }
    /// Displacements up to half a micrometre each way.
    void shake() {
        const Random random{7};
        const ShellView s = view();
        for (uint32_t v = 0; v < s.vertex_count(); ++v) {
            const auto r = [&](uint64_t k) { return static_cast<float>(1e-6 * (random.uniform(v, k) - 0.5)); };
            const Vec3 u{r(0), r(1), r(2)};
            state.vertices.displacement.set(s.vertex(v), u);
            state.vertices.velocity.set(s.vertex(v), {});
            for (int side = 0; side < 2; ++side) state.vertices.probe.set(s.vertex(v), {u.x, u.y, u.z, 0}, side);
        }
    }
    void step(uint32_t count) {
        for (uint32_t i = 0; i < count; ++i) {
            const HiddenStep hidden(view(), state.hidden_runs.time_step[task], state.hidden_runs.damping_time[task],
                                    i & 1);
            integrate_packs(hidden, 0, hidden.pack_count);
        }
    }
    uint64_t motion_hash() {
        const ShellView s = view();
        uint64_t hash = 0;
        for (int k = 0; k < 3; ++k) {
            hash = hash_bytes(state.vertices.displacement.lane(k) + s.vertices().first, 4 * s.vertex_count(), hash);
            hash = hash_bytes(state.vertices.velocity.lane(k) + s.vertices().first, 4 * s.vertex_count(), hash);
        }
        return hash;
    }
};

/// Every pair that the lanes hold, from both of its ends, and how often each was found.
struct Pairs {
    using Key = std::array<uint32_t, 2>;
    std::map<Key, std::array<float, 9>> block;
    std::multimap<Key, std::array<float, 6>> link;
    uint32_t repeated = 0;
};
Pairs pairs_of(ShellView shell) {
    Pairs pairs;
    const StiffnessPacks& packs = shell.state.stiffness_packs;
    const bool once = stores_pairs_once(shell.structures(), shell.structure);
    const auto& blocks = shell.state.stiffness_blocks.block;
    const auto& links = shell.state.stiffness_links.link;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t p = shell.shells().packs[shell.row].first + v / kLanes, l = v % kLanes;
        for (uint32_t i = 0; i < packs.block_count[p]; ++i) {
            const StiffnessBlock& b = blocks[shell.shells().blocks[shell.row].first + packs.first_block[p] + i];
            const uint32_t n = b.neighbour[l];
            if (n == v) continue;
            std::array<float, 9> k, turned;
            for (size_t j = 0; j < 9; ++j) k[j] = b.k[j][l], turned[j] = b.k[j % 3 * 3 + j / 3][l];
            pairs.repeated += !pairs.block.insert({{v, n}, k}).second;
            if (once && are_in_one_pair_cell(v, n)) pairs.repeated += !pairs.block.insert({{n, v}, turned}).second;
        }
        for (uint32_t i = 0; i < packs.link_count[p]; ++i) {
            const StiffnessLink& k = links[shell.shells().links[shell.row].first + packs.first_link[p] + i];
            const uint32_t n = k.neighbour[l];
            if (n == v) continue;
            const std::array<float, 6> there{k.row[0][l],    k.row[1][l],    k.row[2][l],
                                             k.column[0][l], k.column[1][l], k.column[2][l]};
            pairs.link.insert({{v, n}, there});
            if (once && are_in_one_pair_cell(v, n))
                pairs.link.insert({{n, v}, {there[3], there[4], there[5], there[0], there[1], there[2]}});
        }
    }
    return pairs;
}

/// K of a link, whose two columns share one factor in different ways.
std::array<double, 9> product(const std::array<float, 6>& link) {
    std::array<double, 9> k;
    for (size_t i = 0; i < 9; ++i) k[i] = double{link[i / 3]} * link[3 + i % 3];
    return k;
}

/// The same pairs, each as stiff to rounding.
void expect_equal(const Pairs& a, const Pairs& b) {
    EXPECT_EQ(a.repeated, 0u);
    EXPECT_EQ(b.repeated, 0u);
    ASSERT_EQ(a.block.size(), b.block.size());
    ASSERT_EQ(a.link.size(), b.link.size());
    double largest = 0, apart = 0;
    auto other = b.block.begin();
    for (const auto& [key, k] : a.block) {
        ASSERT_EQ(key, other->first);
        for (size_t i = 0; i < 9; ++i) {
            largest = std::max<double>(largest, std::fabs(k[i]));
            apart = std::max<double>(apart, std::fabs(double{k[i]} - other->second[i]));
        }
        ++other;
    }
    EXPECT_LE(apart, 2e-7 * largest);
    largest = apart = 0;
    auto link = b.link.begin();
    for (const auto& [key, numbers] : a.link) {
        ASSERT_EQ(key, link->first);
        const auto k = product(numbers), there = product(link->second);
        for (size_t i = 0; i < 9; ++i) {
            largest = std::max(largest, std::fabs(k[i]));
            apart = std::max(apart, std::fabs(k[i] - there[i]));
        }
        ++link;
    }
    EXPECT_LE(apart, 5e-7 * largest);
}

uint32_t slots_of(ShellView shell) {
    const Range packs = shell.shells().packs[shell.row];
    uint32_t slots = 0;
    for (uint32_t p = packs.first; p < packs.first + packs.count; ++p)
        slots += shell.state.stiffness_packs.block_count[p] + shell.state.stiffness_packs.link_count[p];
    return slots;
}

TEST(PairCells, HoldThePairsThatRowsHoldInTwoThirdsOfTheSlots) {
    Fixture once(sphere_mesh(16, 0.1)), twice(sphere_mesh(16, 0.1), false);
    expect_equal(pairs_of(once.view()), pairs_of(twice.view()));
    EXPECT_LT(slots_of(once.view()), 2 * slots_of(twice.view()) / 3);
}

TEST(PairCells, GiveTheForcesOfRowsToFloatRounding) {
    Fixture once(sphere_mesh(16, 0.1)), twice(sphere_mesh(16, 0.1), false);
    for (Fixture* f : {&once, &twice}) f->shake(), f->step(50);
    double most = 0, apart = 0;
    for (uint32_t v = 0; v < once.view().vertex_count(); ++v) {
        const uint32_t row = once.view().vertex(v);
        const Vec3d u(once.state.vertices.displacement[row]), w(twice.state.vertices.displacement[row]);
        most = std::max(most, length(w)), apart = std::max(apart, length(u - w));
    }
    EXPECT_LT(apart, 1e-5 * most);
}

TEST(PairCells, RigidTranslationIsFreeOfForceToTheLastBit) {
    Fixture f(sphere_mesh(7, 0.1));
    const ShellView shell = f.view();
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        for (int side = 0; side < 2; ++side)
            f.state.vertices.probe.set(shell.vertex(v), {2.5e-3f, -1.37e-3f, 7.7e-4f, 0}, side);
    f.step(1);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        ASSERT_EQ(f.state.vertices.velocity[shell.vertex(v)], (Vec3{0, 0, 0})) << v;
}

/// K of each pair, blocks and links together.
std::map<Pairs::Key, std::array<double, 9>> stiffness_of(const Pairs& pairs) {
    std::map<Pairs::Key, std::array<double, 9>> sum;
    for (const auto& [key, k] : pairs.block)
        for (size_t i = 0; i < 9; ++i) sum[key][i] += k[i];
    for (const auto& [key, numbers] : pairs.link) {
        const auto k = product(numbers);
        for (size_t i = 0; i < 9; ++i) sum[key][i] += k[i];
    }
    return sum;
}

// A grain has up to four links a triangle of the ring. Packs laid too narrow for them move while they are filled, which
// several threads do to one shell at once.
TEST(PairCells, OfWoodAreLaidAsWideAsTheirLinksNeed) {
    Fixture once(sphere_mesh(12, 0.1), true, true), twice(sphere_mesh(12, 0.1), false, true);
    const ShellView shell = once.view();
    ASSERT_TRUE(lay_packs(shell));
    const uint32_t blocks = shell.shells().blocks[shell.row].count, links = shell.shells().links[shell.row].count;
    ASSERT_TRUE(assemble_packs(shell, 0, shell.shells().packs[shell.row].count));
    EXPECT_EQ(shell.shells().blocks[shell.row].count, blocks);
    EXPECT_EQ(shell.shells().links[shell.row].count, links);
    const auto a = stiffness_of(pairs_of(shell)), b = stiffness_of(pairs_of(twice.view()));
    ASSERT_EQ(a.size(), b.size());
    double largest = 0, apart = 0;
    for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) {
        ASSERT_EQ(i->first, j->first);
        for (size_t k = 0; k < 9; ++k) {
            largest = std::max(largest, std::fabs(j->second[k]));
            apart = std::max(apart, std::fabs(i->second[k] - j->second[k]));
        }
    }
    EXPECT_LE(apart, 1e-6 * largest);
    EXPECT_LT(slots_of(shell), slots_of(twice.view()));
}

TEST(PairCells, AllSimdLevelsGiveTheSameBits) {
    uint64_t expected = 0;
    int levels = 0;
    for (const SimdLevel level :
         {SimdLevel::Scalar, SimdLevel::Sse4, SimdLevel::Avx2, SimdLevel::Avx512, SimdLevel::Best}) {
        if (!set_simd_level(level)) continue;
        ++levels;
        Fixture f(sphere_mesh(9, 0.1));
        f.shake();
        f.step(100);
        if (expected == 0) expected = f.motion_hash();
        EXPECT_EQ(f.motion_hash(), expected) << "level " << static_cast<int>(level);
    }
    set_simd_level(SimdLevel::Best);
    EXPECT_GE(levels, 2);
}

TEST(PairCells, MayRunInAnyOrderAndOnAnyNumberOfThreads) {
    Fixture forward(sphere_mesh(16, 0.1)), backward(sphere_mesh(16, 0.1));
    forward.shake(), backward.shake();
    forward.step(20);
    for (uint32_t i = 0; i < 20; ++i) {
        const HiddenStep step(backward.view(), backward.state.hidden_runs.time_step[0],
                              backward.state.hidden_runs.damping_time[0], i & 1);
        for (uint32_t cell = (step.pack_count - 1) / kPairCellPacks + 1; cell-- > 0;)
            integrate_packs(step, cell * kPairCellPacks,
                            std::min(kPairCellPacks, step.pack_count - cell * kPairCellPacks));
    }
    EXPECT_EQ(backward.motion_hash(), forward.motion_hash());
    BrittleLoop loop;
    loop.then<integrate_hidden>().finish();
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        Fixture f(sphere_mesh(16, 0.1));
        f.shake();
        LoopWorld world{f.state, f.state.blows};
        const auto jobs = make_jobs(JobBackend::Threads, threads);
        BrittleLoop::Team team(loop, world, {f.task, 0, 20, nullptr}, threads);
        parallel_for(*jobs, threads, [&](uint32_t worker) { team.work(worker); });
        EXPECT_EQ(f.motion_hash(), forward.motion_hash()) << threads << " threads";
    }
}

TEST(PairCells, TheStableStepIsThatOfRows) {
    Fixture once(sphere_mesh(12, 0.1)), twice(sphere_mesh(12, 0.1), false);
    EXPECT_NEAR(stable_time_step(once.view()) / stable_time_step(twice.view()), 1, 1e-5);
}

TEST(PairCells, ARebuiltRowKeepsWhoStoresAPair) {
    Fixture f(sphere_mesh(9, 0.1)), g(sphere_mesh(9, 0.1));
    std::vector<uint32_t> some;
    for (uint32_t v = 0; v < f.view().vertex_count(); v += 3) some.push_back(v);
    ASSERT_TRUE(rebuild_rows(f.view(), some));
    EXPECT_EQ(slots_of(f.view()), slots_of(g.view()));
    expect_equal(pairs_of(f.view()), pairs_of(g.view()));
}

// Cracks that open under a field of stress; then all is assembled anew, pairs stored twice.
TEST(PairCells, HoldAfterCutsWhatANewAssemblyHolds) {
    using namespace crack_test;
    Shell shell = make_shell_of(sheet(40, 30, 0.4, 0.3, 0.3), 0, 0);
    State& state = *shell.state;
    assemble_springs(shell.view);
    measure_limits(shell.view);
    limit_all_stiffness(shell.view);
    constexpr uint32_t kSpare = 600;
    ShellRoom room = stiffness_room(shell.view, kSpare);
    room.blocks *= 2, room.links *= 2;
    room.elements = shell.view.element_count() + 2 * kSpare;
    room.hinges = shell.view.hinge_count() + 6 * kSpare;
    const Row<Structures> copy = copy_shell(state, shell.view.structure, room);
    ASSERT_TRUE(copy.exists());
    new (&shell.view) ShellView(state, copy);
    const ShellView view = shell.view;
    assemble(view, true);
    const Row<Tasks> task = make_task(shell);
    uint32_t cuts = 0;
    for (uint32_t i = 0; i < 30; ++i) {
        set_time(shell, task, 20e-6 * i);
        set_stress(view, [&](Vec3 p, int) {
            double s, c;
            sine_cosine(double{50 * p.x + 30 * p.y}, s, c);
            return tension_along({1, 0.3f, 0}, 300e6 * s) + tension_along({1, 1, 0}, 100e6 * c);
        });
        CrackSink sink;
        cuts += grow_cracks(state, task, sink);
        ASSERT_FALSE(sink.is_out_of_slots);
    }
    ASSERT_GT(cuts, 20u);
    ASSERT_GT(view.vertex_count(), 1240u);
    const Pairs found = pairs_of(view);
    assemble(view, false);
    expect_equal(found, pairs_of(view));
}

}  // namespace
}  // namespace cullet::test
