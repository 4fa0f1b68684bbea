// Large, coarse and fine fracture of the brick wall of the note's section 8, and of a brick castle.
#include <gtest/gtest.h>

#include <algorithm>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "sample_game/hit_bench.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"

namespace cullet {
namespace {

constexpr uint32_t kPlacements = 10;

/// Brick as it is in the table, but for these.
struct Kind {
    FractureKind fracture = FractureKind::Coarse;
    float branching = 0.3f, run_out = 2;
};

struct Found {
    double parts = 0, pieces = 0, dead_ends = 0, cuts = 0, largest = 0;  // pieces above 0.5 % of the mass
    uint32_t dropped = 0, redone = 0;
    float striker_speed = 0;  // at the end
};

Model brick_of(const Mesh& mesh, float thickness, Kind kind) {
    MaterialTable table;
    MaterialSettings brick = table.find("brick").value();
    brick.fracture = kind.fracture, brick.branching = kind.branching, brick.run_out = kind.run_out;
    EXPECT_TRUE(table.change(brick).ok());
    CookSettings settings{.material = "brick", .materials = &table, .thickness = thickness, .longest_edge = 100};
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of(mesh), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return std::move(model).value();
}

Found hit_once(HitBench& bench, const HitDescription& hit) {
    const FpMode mode;
    State& state = bench.state();
    std::vector<FragmentPart> parts(kMostParts);
    const HitReport report = run_hit(state, bench.shell(), hit, nullptr, parts);
    Found found;
    double total = 0;
    for (uint32_t k = 0; k < report.parts; ++k) total += parts[k].mass;
    for (uint32_t k = 0; k < report.parts; ++k) {
        found.pieces += parts[k].mass > 0.005 * total;
        found.largest = std::max(found.largest, parts[k].mass / total);
    }
    const ShellView shell(state, state.tasks.working[0]);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        found.dead_ends += state.vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(CrackState::Tip);
    found.parts = report.parts, found.cuts = report.cuts;
    found.dropped = report.dropped, found.redone = report.redos;
    found.striker_speed = report.striker_speed_after;
    close_hit(state);
    return found;
}

/// Means over the placements of the ball of 30 kg at 10 m/s.
Found hit_wall(Kind kind) {
    const Model model = brick_of(make_wall(2.4f, 1.8f, 0.078f, 1), 0.1f, kind);
    HitBench bench(Subject::Wall, model);
    Found mean;
    for (uint32_t p = 0; p < kPlacements; ++p) {
        const Found found = hit_once(bench, bench.blow(p, 10));
        mean.parts += found.parts / kPlacements, mean.pieces += found.pieces / kPlacements;
        mean.dead_ends += found.dead_ends / kPlacements, mean.cuts += found.cuts / kPlacements;
        mean.largest += found.largest / kPlacements;
        mean.dropped += found.dropped, mean.redone += found.redone;
    }
    std::printf("%-6s branching %.2f run_out %.1f: parts %.1f, pieces %.1f, largest %.2f, dead ends %.1f, redone %u\n",
                name_of(kind.fracture), static_cast<double>(kind.branching), static_cast<double>(kind.run_out),
                mean.parts, mean.pieces, mean.largest, mean.dead_ends, mean.redone);
    EXPECT_EQ(mean.dropped, 0u);
    return mean;
}

TEST(FractureKinds, AFinerKindBreaksAWallIntoMorePieces) {
    const Found large = hit_wall({FractureKind::Large}), coarse = hit_wall({FractureKind::Coarse}),
                fine = hit_wall({FractureKind::Fine}), finest = hit_wall({FractureKind::Fine, 0.15f});
    EXPECT_GT(coarse.parts, 1.5 * large.parts);
    EXPECT_GT(fine.parts, coarse.parts);
    EXPECT_GT(finest.parts, 1.5 * fine.parts);
}

TEST(FractureKinds, BranchingMakesMorePieces) {
    EXPECT_GT(hit_wall({}).parts, 1.5 * hit_wall({.branching = 0}).parts);
}

TEST(FractureKinds, LargeCracksDoNotFork) {
    const Found alone = hit_wall({FractureKind::Large, 0}), told_to = hit_wall({FractureKind::Large, 0.3f});
    EXPECT_EQ(alone.cuts, told_to.cuts);
}

TEST(FractureKinds, CracksThatRunOutLeaveFewDeadEnds) {
    for (const FractureKind fracture : {FractureKind::Large, FractureKind::Coarse, FractureKind::Fine})
        for (const float branching : {0.0f, 0.3f}) {
            if (fracture == FractureKind::Large && branching > 0) continue;  // large cracks do not fork
            const Found stops = hit_wall({fracture, branching, 0}), runs = hit_wall({fracture, branching, 2});
            EXPECT_LT(runs.dead_ends, stops.dead_ends) << name_of(fracture);
            EXPECT_GE(runs.pieces, stops.pieces) << name_of(fracture);
        }
}

TEST(FractureKinds, TheCracksOfBrickAsItIsInTheTableRunToTheEdgesOrMeetOthers) {
    const MaterialSettings brick = MaterialTable().find("brick").value();
    const Found found = hit_wall({brick.fracture, brick.branching, brick.run_out});
    EXPECT_LT(found.dead_ends, 0.5);  // of about 40 cracks a blow
    EXPECT_GT(found.pieces, 12);      // the prototype: 7.5
    EXPECT_LT(found.largest, 0.6);    // no plug in a wall that is whole otherwise
}

TEST(FractureKinds, NoRandomBlowOnTheTablesBrickIsDroppedOrMakesEnergy) {
    const Model model = brick_of(make_wall(2.4f, 1.8f, 0.078f, 1), 0.1f, {});
    HitBench bench(Subject::Wall, model);
    const Random random{21};
    uint32_t redone = 0;
    for (uint32_t i = 0; i < 100; ++i) {
        const auto speed = static_cast<float>(3 + 22 * random.uniform(i, 0));
        const HitReport report = bench.run(bench.blow(1000 + i, speed));
        EXPECT_FALSE(report.dropped) << i;
        EXPECT_LE(report.end_energy, 1.05 * report.start_energy) << i;
        redone += report.redos;
    }
    EXPECT_LE(redone, 5u);
}

/// A ball of 4 kg at 25 m/s against the curtain wall, where its wall of 25 mm is thinner than an edge is long.
Found hit_castle(FractureKind fracture) {
    const Model model = brick_of(make_castle(3, 11'000), 0.025f, {fracture});
    HitBench bench(Subject::Vase, model);
    const ShellView shell(bench.state(), bench.shell());
    HitDescription hit;
    hit.normal = {0, 0, -1};
    hit.striker_inverse_mass = 1 / 4.0f, hit.striker_radius = 0.08f, hit.striker_speed = 25;
    float front = -1e9f;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 p = shell.state.vertices.rest[shell.vertex(v)];
        const bool is_near = std::fabs(p.x - 0.9f) < 0.1f && std::fabs(p.y - 0.5f) < 0.1f;
        if (shell.state.vertices.element[shell.vertex(v)] != kNone && is_near && p.z > front)
            front = p.z, hit.point = p;
    }
    return hit_once(bench, hit);
}

TEST(FractureKinds, ABrickCastleLosesWhatTheBallStrikes) {
    const Found coarse = hit_castle(FractureKind::Coarse);
    std::printf("castle: parts %.0f, cut edges %.0f, the ball goes on at %.1f m/s\n", coarse.parts, coarse.cuts,
                static_cast<double>(coarse.striker_speed));
    EXPECT_EQ(coarse.dropped, 0u);
    EXPECT_GT(coarse.parts, 8);
    EXPECT_GT(coarse.striker_speed, 5);  // through the hole
    EXPECT_GT(coarse.largest, 0.9);      // which is all that it makes
}

}  // namespace
}  // namespace cullet
