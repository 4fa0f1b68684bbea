// The scene `wall`: its ball goes through at 10 m/s, bounces at 0.7 m/s, and loses what others receive.
#include <gtest/gtest.h>

#include <map>

#include "components/state.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr float kThickness = 0.1f,
                kBallRadius = 0.14f;  // m; the wall's faces are z = 0, where the ball comes, and -0.1

ScenePlan plan_wall(std::vector<std::string> set) {
    RunOptions options;
    options.scene = "wall";
    options.threads = 2;
    options.set = std::move(set);
    return plan_scene(*find_scene("wall"), options);
}

State& state_of(GameWorld& game) {
    return game.world().contents().data.state;
}

uint32_t ball_of(const Bodies& bodies) {
    uint32_t ball = kNone;
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (bodies.is_sphere[b]) ball = b;
    return ball;
}

void step(GameWorld& game) {
    game.before_step();
    game.step();
    game.after_step();
}

TEST(WallBall, GoesThroughTheWallAtTenMetresASecondAndStaysBeyond) {
    for (const char* seed : {"scene.seed=1", "scene.seed=2", "scene.seed=3"}) {
        const ScenePlan plan = plan_wall({seed});
        GameWorld game = std::move(GameWorld::create(plan).value());
        const Bodies& bodies = state_of(game).bodies;
        const uint32_t ball = ball_of(bodies);
        uint32_t beyond_since = 0;  // frame after which the whole ball never came back to the far face
        for (uint32_t frame = 1; frame <= 240; ++frame) {
            step(game);
            const bool is_beyond = bodies.position[ball].z < -kThickness - kBallRadius;
            if (is_beyond && beyond_since == 0) beyond_since = frame;
            if (!is_beyond) beyond_since = 0;
        }
        EXPECT_GT(game.sums().born, 3u) << seed;
        EXPECT_GT(beyond_since, 0u) << seed << ": the ball ends at z = " << bodies.position[ball].z;
        EXPECT_LT(beyond_since, 120u) << seed;
    }
}

TEST(WallBall, BouncesFromTheWholeWallAtSeventyCentimetresASecond) {
    // Without gravity, which would let so slow a ball fall to the floor before it arrives.
    const ScenePlan plan = plan_wall({"scene.speed_mps=0.7", "gravity_mps2=0"});
    GameWorld game = std::move(GameWorld::create(plan).value());
    Bodies& bodies = state_of(game).bodies;
    const uint32_t ball = ball_of(bodies);
    const BodyId id{ball, bodies.generation[ball]};
    ASSERT_TRUE(game.world().set_motion(id, {{0, 0, -0.7f}, {}}).ok());  // level
    for (uint32_t frame = 0; frame < 200; ++frame) step(game);
    EXPECT_GT(game.sums().events["impact"], 0u);
    EXPECT_GT(bodies.velocity[ball].z, 0.05f);
    EXPECT_LT(bodies.velocity[ball].z, 0.7f);
    EXPECT_GT(bodies.position[ball].z, kBallRadius);
    EXPECT_EQ(game.sums().born, 0u);
    EXPECT_EQ(game.sums().events["crack_started"], 0u);
}

/// Watches one hit, one hidden step a frame: what the foot takes is summed from the springs' forces on the pinned
/// vertices, step by step, and the rest read from rows. Nothing of it comes from make_break's books.
struct HitLedger {
    GameWorld& game;
    uint32_t ball;
    Vec3d ball_before, pieces, loose, pins, frozen, pending;  // N s
    Vec3d booked_before, booked;                              // N s, to what is static
    uint32_t steps = 0, breaks = 0;
    uint64_t clamped = 0;

    const Tasks& tasks() const { return state_of(game).tasks; }
    Vec3d ball_momentum() const {
        const Bodies& bodies = state_of(game).bodies;
        return bodies.mass[ball] * Vec3d(bodies.velocity[ball]);
    }
    Vec3d all_momentum() const {
        const Matter m = measure_matter(game.world());
        return {m.momentum[0], m.momentum[1], m.momentum[2]};
    }
    void look_ahead() {
        const ShellView shell(state_of(game), tasks().working[0]);
        pending = double{state_of(game).hidden_runs.time_step[0]} * pin_force(shell, tasks().steps_done[0] & 1);
    }
    Vec3d books() const {
        const double* given = game.world().contents().data.counts.impulse_to_static;
        return {given[0], given[1], given[2]};
    }
    // What the parts that hang on the foot carry when the run ends: they stop, and the foot takes it. And what the
    // others carry, before the faces of their cracks meet the foot's.
    void freeze() {
        const State& state = state_of(game);
        const ShellView shell(state_of(game), tasks().working[0]);
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const uint32_t row = shell.vertex(v), element = state.vertices.element[row];
            if (element == kNone) continue;
            const FragmentPart& part = state.shell_parts.part[state.elements.part[shell.element(element)]];
            (part.has_pins ? frozen : loose) += state.vertices.mass[row] * Vec3d(state.vertices.velocity[row]);
        }
    }
    void after(const std::string& system) {
        const auto task_state = static_cast<TaskState>(tasks().state[0]);
        if (breaks > 0 || task_state == TaskState::Free) return;
        if (system == "start_tasks" && tasks().steps_done[0] == 0) pins = {}, steps = 0, look_ahead();
        if (system == "advance_runs") {
            EXPECT_EQ(tasks().steps_done[0], steps + 1);
            EXPECT_EQ(state_of(game).hidden_runs.redo_count[0], 0);
            steps = tasks().steps_done[0];
            pins += pending;
            look_ahead();
        }
        if (system == "settle_tasks") ball_before = ball_momentum(), booked_before = books();
        if (system == "find_parts" && task_state == TaskState::Broke) freeze();
    }
    void after_births() {
        const DamageCounts& counts = game.world().contents().data.counts;
        if (breaks > 0 || counts.broke == 0) return;
        booked = books() - booked_before;
        breaks = static_cast<uint32_t>(counts.broke);
        clamped = counts.clamped;
        pieces = all_momentum() - ball_momentum();
    }
};

TEST(WallBall, TheMomentumThatItLosesIsWhatPiecesAndFootReceive) {
    const ScenePlan plan = plan_wall({"gravity_mps2=0", "units_a_frame=1000"});  // one step a frame
    Result<GameWorld> created = GameWorld::create(plan);
    ASSERT_TRUE(created.ok()) << created.error();
    GameWorld& game = created.value();
    game.world().contents().data.damage_settings.hold_seconds = 100;  // more than a game may ask for
    HitLedger ledger{game, ball_of(state_of(game).bodies), {}, {}, {}, {}, {}, {}, {}, {}};
    Vec3d lost;
    game.world().contents().after_each_system = [&](const PlannedSystem<WorldData>& system) {
        const std::string name = system.name;
        ledger.after(name);
        const bool was_broken = ledger.breaks > 0;
        if (name == "make_births") ledger.after_births();
        if (!was_broken && ledger.breaks > 0) lost = ledger.ball_before - ledger.ball_momentum();
    };
    for (uint32_t frame = 0; frame < 2000 && ledger.breaks == 0; ++frame) step(game);
    ASSERT_EQ(ledger.breaks, 1u);
    EXPECT_EQ(ledger.clamped, 0u);  // a clamp would hand momentum to the support
    EXPECT_GT(ledger.steps, 200u);
    EXPECT_GT(-lost.z, 100);  // N s of the ball's 300
    EXPECT_GT(length(ledger.pieces), 10);
    EXPECT_GT(length(ledger.pins), 0.1);
    const Vec3d received = ledger.loose + ledger.pins + ledger.frozen;
    EXPECT_LT(length(lost - received), 1e-4 * length(lost))
        << "lost " << lost.z << ", pieces " << ledger.loose.z << ", foot in the run " << ledger.pins.z
        << ", foot when what hangs on it stops " << ledger.frozen.z;
    // Pieces whose crack faces are on their way into the foot's stop there, and it takes that, too: the books say so.
    EXPECT_LT(length(lost - ledger.pieces - ledger.booked), 1e-4 * length(lost));
    RecordProperty("lost", std::to_string(lost.z));
    RecordProperty("pieces", std::to_string(ledger.pieces.z));
    RecordProperty("foot", std::to_string(ledger.pins.z + ledger.frozen.z));
    RecordProperty("relative_error", std::to_string(length(lost - received) / length(lost)));
}

}  // namespace
}  // namespace cullet
