// Solids break: load, gate, cracks and pieces (solid cooking note, section 6; T9, T12, T13).
#include "systems/models/lattice/crack/break_run.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/random.hpp"
#include "sample_game/allocations.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "tests/support/lattice_solids.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

constexpr BrittleSolid kBrick{{12e9, 0.18}, 1900, 2.5e6, 25e6};
constexpr ElasticSolid kGround{30e9, 0.2};
const Vec3d kHalf{0.12, 0.035, 0.0575};

BreakableSolid brick(double cells, int elements) {
    const double volume = 8 * kHalf.x * kHalf.y * kHalf.z;
    return make_breakable(
        fill_convex(box_planes(kHalf), kHalf, {.edge = edge_for(volume, cells), .elements = elements}));
}

SolidBlow blow_on(Vec3d point, Vec3d push, double speed, double mass) {
    return {point, normalised(push), speed, mass, 0.01, kGround, {}, 1.0 / 60, {}};
}
SolidBlow on_a_corner(double speed) {
    return blow_on(kHalf, {-1, -1, -1}, speed, 1.5);
}

struct Broken {
    Arena arena;
    BreakRun run;
    Broken(const BreakableSolid& body, const BrittleSolid& brittle, const SolidBlow& blow, const CrackRules& rules = {},
           std::span<const uint8_t> held = {}, uint64_t work = 1'000'000)
        : arena(break_bytes(body)), run(take_break(arena, body)) {
        begin_break(body, brittle, blow, rules, held, run);
        while (!advance_break(body, run, work)) continue;
    }
};

// Pieces hang together, have what they are said to have, and are not smaller than allowed.
void expect_whole_pieces(const BreakableSolid& body, const BreakRun& run) {
    const Solid& solid = body.solid;
    std::vector<double> volume(run.piece_count, 0.0);
    for (size_t c = 0; c < run.piece.size(); ++c) {
        ASSERT_LT(run.piece[c], run.piece_count);
        volume[run.piece[c]] += solid.cells[c].volume;
    }
    std::vector<uint32_t> root(run.piece.size());
    for (uint32_t c = 0; c < root.size(); ++c) root[c] = c;
    const auto find = [&](uint32_t c) {
        while (root[c] != c) c = root[c] = root[root[c]];
        return c;
    };
    for (const SolidBond& bond : solid.bonds)
        if (run.piece[bond.a] == run.piece[bond.b]) root[find(bond.a)] = find(bond.b);
    uint32_t parts = 0;
    for (uint32_t c = 0; c < root.size(); ++c) parts += find(c) == c;
    EXPECT_EQ(parts, run.piece_count);
    double sum = 0;
    for (uint32_t p = 0; p < run.piece_count; ++p) {
        EXPECT_NEAR(volume[p], run.volume[p], 1e-12);
        EXPECT_GE(volume[p], 5.999 * solid.volume / static_cast<double>(solid.cells.size()));
        sum += volume[p];
    }
    EXPECT_NEAR(sum, solid.volume, 1e-10 * solid.volume);
}

TEST(BreakRun, BelowTheThresholdNothingBreaks) {
    const BreakableSolid body = brick(800, 4);
    const Broken weak(body, kBrick, on_a_corner(0.05));
    EXPECT_LT(weak.run.gate, 1);
    EXPECT_GT(weak.run.gate, 0);
    EXPECT_EQ(weak.run.solve_count, 1u);
    EXPECT_EQ(weak.run.piece_count, 1u);
    const Broken strong(body, kBrick, on_a_corner(5));
    EXPECT_GT(strong.run.gate, 1);
    EXPECT_GT(strong.run.piece_count, 1u);
}

TEST(BreakRun, PiecesHangTogetherAndAddUp) {
    for (const int elements : {2, 4}) {
        const BreakableSolid body = brick(800, elements);
        for (const double speed : {1.0, 5.0, 20.0, 80.0}) {
            const Broken broken(body, kBrick, on_a_corner(speed));
            expect_whole_pieces(body, broken.run);
            const Broken along_planes(body, kBrick, on_a_corner(speed), {.is_curved = false});
            expect_whole_pieces(body, along_planes.run);
        }
    }
}

TEST(BreakRun, StressIsLinearInTheForce) {
    const BreakableSolid body = brick(500, 4);
    const Broken slow(body, kBrick, on_a_corner(0.03)), fast(body, kBrick, on_a_corner(0.06));
    ASSERT_EQ(slow.run.patch, fast.run.patch);
    const double force = fast.run.contact.force * fast.run.share / (slow.run.contact.force * slow.run.share);
    EXPECT_NEAR(fast.run.gate / slow.run.gate, force, 1e-9 * force);
}

TEST(BreakRun, TheGateAloneTellsTheForceOfTheFirstCrack) {
    const BreakableSolid body = brick(800, 4);
    CrackRules gate;
    gate.most_cracks = 0;
    const Broken slow(body, kBrick, on_a_corner(1), gate), fast(body, kBrick, on_a_corner(5), gate);
    EXPECT_EQ(fast.run.piece_count, 1u);
    EXPECT_EQ(fast.run.solve_count, 1u);
    EXPECT_LT(slow.run.gate, 1);
    EXPECT_GT(fast.run.gate, 1);
    EXPECT_NEAR(threshold_force(slow.run) / threshold_force(fast.run), 1, 1e-9);
}

TEST(BreakRun, AFinerLatticeBreaksAtTheSameLoad) {
    const BreakableSolid coarse = brick(1500, 2), fine = brick(8000, 2);
    const SolidBlow blow = blow_on({0, kHalf.y, 0}, {0, -1, 0}, 5, 3);
    CrackRules rules;
    rules.most_cracks = 1;
    const Broken a(coarse, kBrick, blow, rules), b(fine, kBrick, blow, rules);
    EXPECT_NEAR(a.run.patch / b.run.patch, 1, 0.01);
    EXPECT_NEAR(b.run.first_crack / a.run.first_crack, 1, 0.25);
}

TEST(BreakRun, ATouchOffTheSurfaceIsWhereItIsNearest) {
    const BreakableSolid body = brick(500, 4);
    const Broken beside(body, kBrick, blow_on({0, 3 * kHalf.y, 0}, {0, -1, 0}, 5, 3));
    EXPECT_NEAR(beside.run.blow.point.y, kHalf.y, 1e-6);
    EXPECT_GT(beside.run.gate, 0);
}

// x to y, y to z, z to x: a turn that rounds nothing.
Vec3d turned(Vec3d p) {
    return {p.z, p.x, p.y};
}

TEST(BreakRun, ATurnedBlowOnATurnedBodyGivesTheSamePieces) {
    const BreakableSolid body = brick(800, 4);
    Solid other = body.solid;
    for (Vec3d& p : other.lattice.points) p = turned(p);
    for (SolidCell& cell : other.cells) cell.centroid = turned(cell.centroid);
    for (SurfacePatch& patch : other.patches) patch.centroid = turned(patch.centroid);
    for (SolidBond& bond : other.bonds) bond.centroid = turned(bond.centroid), bond.normal = turned(bond.normal);
    const BreakableSolid turned_body = make_breakable(other);
    for (const double speed : {3.0, 6.0, 12.0}) {
        const Broken straight(body, kBrick, on_a_corner(speed));
        SolidBlow blow = on_a_corner(speed);
        blow.point = turned(blow.point), blow.push = turned(blow.push);
        const Broken across(turned_body, kBrick, blow);
        EXPECT_NEAR(across.run.gate, straight.run.gate, 1e-6 * straight.run.gate);
        ASSERT_EQ(across.run.piece_count, straight.run.piece_count);
        EXPECT_EQ(std::memcmp(across.run.piece.data(), straight.run.piece.data(), straight.run.piece.size_bytes()), 0);
    }
}

TEST(BreakRun, PiecesRiseWithSpeed) {
    BreakableSolid body = brick(800, 4);
    double before = 0;
    for (const double speed : {1.0, 3.0, 6.0, 10.0, 20.0}) {
        double sum = 0;
        for (uint64_t seed = 0; seed < 20; ++seed) {
            scatter_strength(body, 8, seed);
            sum += Broken(body, kBrick, on_a_corner(speed)).run.piece_count / 20.0;
        }
        EXPECT_GT(sum, before) << speed;
        before = sum;
    }
}

TEST(BreakRun, AColumnPushedAtItsTopCracksAtItsFoot) {
    const double radius = 0.15, half = 1.2;
    const Vec3d box{radius, radius, half};
    for (const int elements : {2, 4}) {
        const BreakableSolid body =
            make_breakable(fill_convex(column_planes(radius, half, 24), box, {.edge = 0.06, .elements = elements}));
        std::vector<uint8_t> held(body.solid.patches.size(), 0);
        for (size_t i = 0; i < held.size(); ++i) held[i] = body.solid.patches[i].centroid.z < -half + 1e-6;
        const BrittleSolid stone{{50e9, 0.25}, 2500, 8e6, 100e6};
        const SolidBlow blow = blow_on({-radius, 0, half - 0.1}, {1, 0, 0}, 2, 50);
        CrackRules rules;
        rules.most_cracks = 1;
        const Broken broken(body, stone, blow, rules, held);
        ASSERT_EQ(broken.run.piece_count, 2u);
        expect_whole_pieces(body, broken.run);
        for (const SolidBond& bond : body.solid.bonds)
            if (broken.run.piece[bond.a] != broken.run.piece[bond.b]) {
                EXPECT_LT(bond.centroid.z, -half + 4 * radius);
            }
    }
}

TEST(BreakRun, SlicesChangeNoBitAndNothingIsAllocated) {
    const BreakableSolid body = brick(500, 2);
    const Broken whole(body, kBrick, on_a_corner(10), {}, {}, ~uint64_t{0} / 2);
    Arena arena(break_bytes(body));
    const std::span<uint8_t> left_over = arena.take<uint8_t>(break_bytes(body));
    std::fill(left_over.begin(), left_over.end(), uint8_t{0xab});  // what others left says nothing
    arena.reset();
    BreakRun run = take_break(arena, body);
    start_counting_allocations();
    begin_break(body, kBrick, on_a_corner(10), {}, {}, run);
    uint32_t steps = 0;
    while (!advance_break(body, run, 1)) ++steps;
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(steps, 100u);
    EXPECT_GT(run.piece_count, 1u);
    ASSERT_EQ(run.piece_count, whole.run.piece_count);
    EXPECT_EQ(std::memcmp(run.piece.data(), whole.run.piece.data(), run.piece.size_bytes()), 0);
    EXPECT_EQ(std::memcmp(run.stress.data(), whole.run.stress.data(), run.stress.size_bytes()), 0);
}

BreakableSolid cooked(const Mesh& mesh, double cells, uint32_t elements) {
    SolidSettings settings;
    settings.cells = cells, settings.element_edges = elements;
    Result<CookedSolid> made = cook_solid(mesh, settings);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return make_breakable(std::move(made->solid));
}

TEST(BreakRun, LoosePartsArePiecesFromTheStartAndOnlyTheStruckOneBreaks) {
    Mesh mesh = test::box_mesh({0.1, 0.1, 0.1}, 1);
    test::append(mesh, test::box_mesh({0.1, 0.1, 0.1}, 1), {0.5, 0, 0});
    const BreakableSolid body = cooked(mesh, 800, 4);
    EXPECT_EQ(body.part_count, 2u);
    const Broken broken(body, kBrick, blow_on({0.6, 0.05, 0.05}, {-1, 0, 0}, 10, 1));
    EXPECT_GT(broken.run.piece_count, 2u);
    expect_whole_pieces(body, broken.run);
    const uint32_t whole = body.part[0];
    for (size_t c = 0; c < body.part.size(); ++c)
        ASSERT_EQ(broken.run.piece[c] == whole, body.solid.cells[c].centroid.x < 0.3);
}

TEST(BreakRun, CookedShapesBreakAndEnd) {
    Mesh hollow = test::sphere_mesh(0.1f, 3);
    test::append(hollow, test::turned_inside_out(test::sphere_mesh(0.06f, 3)), {0.01f, 0.005f, 0});
    const Mesh shapes[] = {test::box_mesh({0.3, 0.01, 0.2}, 1), test::torus_mesh(0.1f, 0.03f, 24, 12), hollow,
                           test::sphere_mesh(0.001f, 2)};
    const Random random{9};
    for (const Mesh& mesh : shapes)
        for (const uint32_t elements : {2u, 4u}) {
            const BreakableSolid body = cooked(mesh, 400, elements);
            uint32_t most = 0;
            for (uint64_t n = 0; n < 4; ++n) {
                const Vec3d at(mesh.positions[static_cast<size_t>(random.uniform(n) *
                                                                  static_cast<double>(mesh.positions.size()))]);
                const Broken broken(body, kBrick, blow_on(at, Vec3d{0.01, 0.02, 0.03} - at, 8, 0.5));
                expect_whole_pieces(body, broken.run);
                most = std::max(most, broken.run.piece_count);
            }
            const bool is_crushed = &mesh == &shapes[3];  // the contact is wider than the whole ball
            EXPECT_EQ(most > 1, !is_crushed) << mesh.name;
        }
}

TEST(BreakRun, AnyBlowEnds) {
    BreakableSolid body = brick(300, 4);
    const Random random{5};
    for (uint64_t n = 0; n < 40; ++n) {
        scatter_strength(body, 3, n);
        const auto chance = [&](uint64_t k) { return random.uniform(n, k) * 2 - 1; };
        SolidBlow blow =
            blow_on({kHalf.x * chance(0), kHalf.y * chance(1), kHalf.z * chance(2)}, {chance(3), chance(4), chance(5)},
                    exponential(8 * chance(6)), exponential(8 * chance(7)));
        blow.spin = {100 * chance(8), 100 * chance(9), 0};
        const Broken broken(body, kBrick, blow);
        expect_whole_pieces(body, broken.run);
    }
    for (const SolidBlow& none :
         {blow_on({}, {1, 0, 0}, 0, 1), blow_on({}, {1, 0, 0}, 1, 0), blow_on({}, {0, 0, 0}, 1, 1)}) {
        const Broken whole(body, kBrick, none);
        EXPECT_EQ(whole.run.piece_count, 1u);
    }
}

}  // namespace
}  // namespace cullet
