// Large, coarse and fine fracture of the brick wall of the note's section 8.
#include <gtest/gtest.h>

#include "engine/fp_mode.hpp"
#include "sample_game/hit_bench.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/materials.hpp"
#include "systems/damage/crack_candidates.hpp"

namespace cullet {
namespace {

constexpr uint32_t kPlacements = 10;

struct Found {
    double pieces = 0, dead_ends = 0, cuts = 0, largest = 0;
    uint32_t dropped = 0, redone = 0;
};

Model wall_of(FractureKind fracture, float run_out) {
    MaterialTable table;
    MaterialSettings brick = table.find("brick").value();
    brick.fracture = fracture;
    brick.run_out = run_out;
    EXPECT_TRUE(table.change(brick).ok());
    CookSettings settings{.material = "brick", .materials = &table, .thickness = 0.1f, .longest_edge = 100};
    settings.measures_threshold = false;
    Result<Model> model = cook(view_of(make_wall(2.4f, 1.8f, 0.078f, 1)), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return std::move(model).value();
}

/// Means over the placements of the ball of 30 kg at 10 m/s.
Found hit_wall(FractureKind fracture, float run_out) {
    const Model model = wall_of(fracture, run_out);
    HitBench bench(Subject::Wall, model);
    Found found;
    for (uint32_t p = 0; p < kPlacements; ++p) {
        const FpMode mode;
        State& state = bench.state();
        const HitReport report = run_hit(state, bench.shell(), bench.blow(p, 10));
        double total = 0, largest = 0;
        uint32_t pieces = 0, dead_ends = 0;
        for (uint32_t k = 0; k < report.parts; ++k)
            total += state.fragments.part[k].mass, largest = std::max(largest, state.fragments.part[k].mass);
        for (uint32_t k = 0; k < report.parts; ++k) pieces += state.fragments.part[k].mass > 0.005 * total;
        const ShellView shell(state, state.tasks.shell[0]);
        for (uint32_t v = 0; v < shell.vertex_count(); ++v)
            dead_ends += state.vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(CrackState::Tip);
        close_hit(state);
        found.pieces += pieces / double{kPlacements};
        found.largest += largest / total / double{kPlacements};
        found.cuts += report.cuts / double{kPlacements};
        found.dead_ends += dead_ends / double{kPlacements};
        found.dropped += report.dropped;
        found.redone += report.redos;
    }
    std::printf("%-6s run_out %.1f: pieces %.1f, largest %.2f, cut edges %.0f, dead ends %.1f, redone %u, dropped %u\n",
                name_of(fracture), static_cast<double>(run_out), found.pieces, found.largest, found.cuts,
                found.dead_ends, found.redone, found.dropped);
    return found;
}

TEST(FractureKinds, AFinerKindBreaksAWallIntoMorePieces) {
    const Found large = hit_wall(FractureKind::Large, 0), coarse = hit_wall(FractureKind::Coarse, 0),
                fine = hit_wall(FractureKind::Fine, 0);
    EXPECT_GT(coarse.pieces, large.pieces);
    EXPECT_GT(fine.pieces, coarse.pieces);
    EXPECT_EQ(large.dropped + coarse.dropped + fine.dropped, 0u);
}

TEST(FractureKinds, CracksThatRunOutLeaveFewerDeadEnds) {
    for (const FractureKind kind : {FractureKind::Large, FractureKind::Coarse, FractureKind::Fine}) {
        const Found stops = hit_wall(kind, 0), runs = hit_wall(kind, 2);
        EXPECT_LT(runs.dead_ends, stops.dead_ends) << name_of(kind);
        EXPECT_GE(runs.pieces, stops.pieces) << name_of(kind);
    }
}

}  // namespace
}  // namespace cullet
