// Hidden runs of large bodies work on a cut-out whose border a rigid rest holds: rows are sound, mass, momentum and
// energy are kept, nothing depends on threads or snapshots, and it breaks as the whole body would.
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/meshes.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/large_hits.hpp"

namespace cullet::test {
namespace {

/// 14,000 vertices; cracks of fine fracture stay near the hit.
const Model& large_vase() {
    static const Model model = porcelain_vase(0.75f, 0.009f, FractureKind::Fine);
    return model;
}

Breakage vase_and_balls(const Settings& settings, float speed = 40) {
    Breakage b{make_world(settings), {}, {}};
    const ModelId id = b.world.add_model(large_vase()).value();
    b.body = b.world.spawn(id, {}).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.32f, 0.25f}, 0.3f, speed)).value();
    // A second one hits the cracked body 20 frames later.
    (void)b.world.add_sphere(ball_at({-0.05f, 0.41f, 10}, 0.3f, speed)).value();
    return b;
}

TEST(HiddenRegion, RowsAreSoundWhenItIsFilledWhenItIsPutBackAndWhenPiecesAreOut) {
    Breakage b = vase_and_balls(large_settings(1));
    World* w = &b.world;
    uint32_t regions = 0, whole = 0;
    bool was_open = false;
    after_each_system(b.world, [&](const std::string& system) {
        State& state = state_of(*w);
        if (system != "start_tasks" && system != "close_regions" && system != "make_births") return;
        if (system == "start_tasks") {
            was_open = false;
            for (uint32_t t = 0; t < state.tasks.size(); ++t) {
                if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free) continue;
                was_open = true;
                if (state.tasks.body[t] == b.body.index) ++(is_hidden_region(state, t) ? regions : whole);
                if (!is_hidden_region(state, t)) continue;
                EXPECT_EQ(trouble_of_hidden_region(state, t), "");
                EXPECT_LT(2 * state.shells.elements[state.shell_of(state.tasks.working[t])].count,
                          state.shells.elements[state.shell_of(state.tasks.source[t])].count);
            }
        }
        if (was_open) {
            EXPECT_EQ(trouble_of_shells(state), "") << "after " << system;
        }
    });
    for (int frame = 0; frame < 40; ++frame) b.world.step();
    std::printf("%u regions, %u whole copies, %zu bodies\n", regions, whole, shells_of(b.world).size());
    EXPECT_GE(regions, 2u);
    EXPECT_EQ(whole, 0u);
    EXPECT_GT(shells_of(b.world).size(), 1u) << "nothing came off";
}

TEST(HiddenRegion, HashesAreEqualOnOneTwoThreeAndEightThreads) {
    expect_same_hashes([](const Settings& settings) { return vase_and_balls(settings); }, 30);
}

TEST(HiddenRegion, MassAndMomentumAreKeptWhereItBreaks) {
    Breakage b = vase_and_balls(large_settings(1));
    expect_matter_is_kept(b, 40);
}

TEST(HiddenRegion, ASnapshotBetweenTwoFramesOfAHitGoesOnAsItWas) {
    const Settings settings = large_settings(1, 8'000'000);
    Breakage b = vase_and_balls(settings);
    for (int frame = 0; frame < 60 && open_tasks(b.world) == 0; ++frame) b.world.step();
    for (int frame = 0; frame < 2; ++frame) b.world.step();
    ASSERT_GT(open_tasks(b.world), 0u);
    ASSERT_TRUE(is_hidden_region(state_of(b.world), 0));
    expect_goes_on(b.world, settings, 30);
}

TEST(HiddenRegion, FramesDoNotAllocate) {
    Breakage b = vase_and_balls(large_settings(1));
    expect_no_allocation(b, 40);
}

/// A shell without a world, which hits of run_hit take.
struct Bare {
    State state;
    Row<Structures> shell;
    explicit Bare(const Model& model)
        : state(cooking_limits(3 * model.contents->report.vertices, 3 * model.contents->report.elements)) {
        const Workbench& cooked = model.contents->state;
        state.materials.append(cooked.materials.size());
        state.materials.copy_rows(cooked.materials, 0, 0, cooked.materials.size());
        state.material_traits.append(cooked.material_traits.size());
        state.material_traits.copy_rows(cooked.material_traits, 0, 0, cooked.material_traits.size());
        const char* full = nullptr;
        shell = import_shell(state, cooked, model.contents->shell, &full);
        EXPECT_TRUE(shell.exists()) << full;
    }
    /// A ball of 0.3 kg comes along -z, `turn` of the way round the vase.
    HitDescription blow(float turn, float height, float speed, uint32_t region) const {
        double sine = 0, cosine = 0;
        sine_cosine(turn, sine, cosine);
        const Vec3 way{static_cast<float>(-sine), 0, static_cast<float>(-cosine)};
        HitDescription hit;
        hit.normal = way;
        // The outer wall there: of the vertices at this height the one that comes first.
        float first = 1e30f;
        const Range vertices = state.shells.vertices[state.shell_of(shell)];
        for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
            const Vec3 p = state.vertices.rest[v];
            if (std::fabs(p.y - height) > 0.01f || dot(p, way) >= first) continue;
            first = dot(p, way);
            hit.point = p;
        }
        hit.striker_speed = speed, hit.striker_inverse_mass = 1 / 0.3f, hit.striker_radius = 0.03f;
        hit.region_vertices = region;
        return hit;
    }
    HitReport run(const HitDescription& hit) {
        const HitReport report = run_hit(state, shell, hit);
        close_hit(state);
        return report;
    }
};

// The free vertices' momentum and the rest's are what the striker gave, and its turn.
TEST(HiddenRegion, TheRestTakesWhatTheRegionLoses) {
    Bare bare(large_vase());
    HitDescription hit = bare.blow(0.3f, 0.32f, 5, 4000);
    hit.strength_scale = 1e9f;  // whole
    hit.velocity = {0.5f, -1, 0.25f}, hit.spin = {0.3f, 2, -1};
    ASSERT_TRUE(open_hit(bare.state, bare.shell, hit));
    ASSERT_TRUE(is_hidden_region(bare.state, 0));
    State& state = bare.state;
    const Row<Tasks> task(0);
    const ShellView cut(state, state.tasks.working[task]);
    const auto sum = [&](Vec3d& momentum, Vec3d& turning) {
        const RegionRests& rests = state.region_rests;
        momentum = (1 / rests.inverse_mass[0]) * rests.velocity[0];
        turning = rests.inertia[0] * rests.spin[0] + cross(rests.centre[0], momentum);
        for (uint32_t v = 0; v < cut.vertex_count(); ++v) {
            const uint32_t row = cut.vertex(v);
            const MarkedPacks& packs = state.marked_packs;
            bool is_held = false;
            for (uint32_t p = 0; p < state.hidden_runs.pack_count[0]; ++p)
                is_held = is_held || (packs.pack[p] == v / kLanes && (packs.held[p] >> (v % kLanes) & 1));
            if (is_held || state.vertices.element[row] == kNone) continue;
            const Vec3d p = state.vertices.mass[row] * Vec3d(state.vertices.velocity[row]);
            momentum += p;
            turning += cross(Vec3d(state.vertices.rest[row]), p);
        }
    };
    Vec3d momentum[2], turning[2];
    sum(momentum[0], turning[0]);
    // As the body itself: m v of all vertices, whose centre moves with the body.
    const Vec3d velocity(hit.velocity);
    double mass = 0;
    for (uint32_t v = 0; v < state.shells.vertices[state.shell_of(bare.shell)].count; ++v)
        mass += state.vertices.mass[state.shells.vertices[state.shell_of(bare.shell)].first + v];
    EXPECT_NEAR(length(momentum[0] - mass * velocity) / (mass * length(velocity)), 0, 1e-6);
    const BrittleLoop loop = make_brittle_loop();
    LoopWorld world{state, state.blows};
    state.tasks.steps_granted[task] = 600;
    loop.run_alone(world, {task, 0, 600, task_goes_on});
    sum(momentum[1], turning[1]);
    const TaskContacts& contacts = state.task_contacts;
    const Vec3d blow = contacts.impulse[0] * Vec3d(contacts.normal[0]);
    ASSERT_GT(length(blow), 0.1) << "it met nothing";
    EXPECT_LT(length(momentum[1] - momentum[0] - blow), 2e-4 * length(blow));
    const double lever = length(cross(Vec3d(contacts.point[0]), blow));
    EXPECT_LT(length(turning[1] - turning[0] - cross(Vec3d(contacts.point[0]), blow)), 0.02 * lever)
        << "the patch pushes round the contact's point, not at it";
    const TaskEnergy energy = task_energy(state, task);
    EXPECT_NEAR(energy.total() / state.hidden_runs.start_energy[task], 1, 0.05);
    std::printf("momentum off by %.1e, turn by %.1e of the blow, energy %.4f of the start\n",
                length(momentum[1] - momentum[0] - blow) / length(blow),
                length(turning[1] - turning[0] - cross(Vec3d(contacts.point[0]), blow)) / lever,
                energy.total() / state.hidden_runs.start_energy[task]);
    close_hit(state);
}

TEST(HiddenRegion, GrowsWhereCracksComeToItsBorder) {
    Bare bare(large_vase());
    const HitReport small = bare.run(bare.blow(0.3f, 0.32f, 40, 150)), whole = bare.run(bare.blow(0.3f, 0.32f, 40, 0));
    EXPECT_FALSE(small.dropped);
    EXPECT_GT(small.moving, 600u) << "150 vertices are less than its cracks need";
    EXPECT_TRUE(small.broke);
    std::printf("on %u vertices %u cuts, %u parts; on %u vertices %u cuts, %u parts\n", small.moving, small.cuts,
                small.parts, whole.moving, whole.cuts, whole.parts);
    EXPECT_GT(small.cuts, whole.cuts / 2);
    EXPECT_LT(small.cuts, whole.cuts * 2);
}

/// Least speed, within 5 %, at which `has` holds of a hit.
template <class Has>
double threshold(Bare& bare, float turn, float height, uint32_t region, Has has) {
    double low = 1, high = 16;
    while (high > 1.05 * low) {
        const double middle = std::sqrt(low * high);
        (has(bare.run(bare.blow(turn, height, static_cast<float>(middle), region))) ? high : low) = middle;
    }
    return high;
}

// Section 8 of the note: programs agree on medians of first cracks within 25 %. The 35 % on loose pieces are our own.
TEST(HiddenRegion, CracksAndBreaksAtTheSpeedsOfTheWholeBody) {
    Bare bare(large_vase());
    std::vector<double> cracks, pieces;
    const std::pair<float, float> all[] = {{0.3f, 0.32f}, {2.0f, 0.5f}, {4.0f, 0.15f}};
    for (const auto& [turn, height] : std::span(all).first(few_or_all(1u, 3u))) {
        const auto cracked = [](const HitReport& r) { return r.cracked; };
        const auto broke = [](const HitReport& r) { return r.broke; };
        const double crack[2] = {threshold(bare, turn, height, 0, cracked),
                                 threshold(bare, turn, height, kWholeCopyVertices, cracked)};
        const double piece[2] = {threshold(bare, turn, height, 0, broke),
                                 threshold(bare, turn, height, kWholeCopyVertices, broke)};
        std::printf("first crack %.2f m/s whole, %.2f on a region; loose piece %.2f, %.2f\n", crack[0], crack[1],
                    piece[0], piece[1]);
        cracks.push_back(crack[1] / crack[0]), pieces.push_back(piece[1] / piece[0]);
    }
    for (const double ratio : cracks) EXPECT_NEAR(ratio, 1, 0.25);
    for (const double ratio : pieces) EXPECT_NEAR(ratio, 1, 0.35);
}

}  // namespace
}  // namespace cullet::test
