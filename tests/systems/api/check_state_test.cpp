// Rows of a snapshot that no world would write are refused before a system follows them; those that one writes are not.
#include <gtest/gtest.h>

#include <functional>

#include "components/state.hpp"
#include "systems/api/snapshot.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// The sentence that refuses the world's bytes, or an empty one.
std::string refusal(World& world) {
    const Result<std::vector<uint8_t>> bytes = world.snapshot();
    if (!bytes) return "no snapshot: " + bytes.error();
    World other = make_world(small_settings());
    const Result<void> loaded = other.restore(bytes->data(), bytes->size());
    return loaded.ok() ? "" : loaded.error();
}

/// A hit that is being worked off: its task is the first.
Breakage world_in_a_hit() {
    Settings settings = small_settings();
    settings.units_a_frame = 600'000;
    Breakage hit = vase_and_ball(settings);
    for (int frame = 0; frame < 60 && open_tasks(hit.world) == 0; ++frame) hit.world.step();
    hit.world.step();
    EXPECT_EQ(static_cast<TaskState>(tasks_of(hit.world).state[0]), TaskState::Running);
    return hit;
}

/// Saved after `edit`, it is refused by a sentence that names the place.
void expect_refused(const std::function<void(State&, Row<Bodies> vase, Row<Bodies> ball)>& edit, const char* place) {
    Breakage hit = world_in_a_hit();
    EXPECT_EQ(refusal(hit.world), "");
    edit(state_of(hit.world), Row<Bodies>(hit.body.index), Row<Bodies>(hit.ball.index));
    EXPECT_NE(refusal(hit.world).find(place), std::string::npos) << place << ": " << refusal(hit.world);
}

TEST(CheckState, AWorldWhoseRoomForDrawnMeshesIsFullIsLoadedAgain) {
    Breakage probe = vase_and_ball(small_settings());
    const uint32_t drawn = probe.world.view(probe.body).value().vertex_count;
    Settings settings = small_settings();
    settings.limits.view_vertices = std::max(4096u, drawn + 16);
    Breakage hit = vase_and_ball(settings);
    const Bodies& bodies = state_of(hit.world).bodies;
    for (int frame = 0; frame < 60 && bodies.is_owed_births[hit.body.index] != kOwedDrawing; ++frame) hit.world.step();
    ASSERT_EQ(bodies.is_owed_births[hit.body.index], kOwedDrawing);
    EXPECT_EQ(refusal(hit.world), "");
}

TEST(CheckState, FramesThatNothingWouldWaitForAreRefused) {
    constexpr uint64_t kFar = 1'000'000;
    expect_refused([](State& state, Row<Bodies>, Row<Bodies>) { state.tasks.due_frame[0] = kFar; },
                   "tasks.due_frame[0]");
    expect_refused([](State& state, Row<Bodies>, Row<Bodies>) { state.tasks.opened_frame[0] = kFar; },
                   "tasks.opened_frame[0]");
    expect_refused([](State& state, Row<Bodies> vase, Row<Bodies>) { state.bodies.retry_frame[vase] = kFar; },
                   "bodies.retry_frame[0]");
    expect_refused(
        [](State& state, Row<Bodies> vase, Row<Bodies>) {
            state.queued_hits.is_used[0] = 1;
            state.queued_hits.body[0] = vase;
            state.queued_hits.striker[0] = {};
            state.queued_hits.frame[0] = kFar;
        },
        "queued_hits.frame[0]");
    expect_refused([](State& state, Row<Bodies> vase, Row<Bodies>) { set_born(state.fragment_ages, vase, kFar); },
                   "fragment_ages.born[0]");
}

TEST(CheckState, AQueuedHitOnABallIsRefused) {
    expect_refused(
        [](State& state, Row<Bodies>, Row<Bodies> ball) {
            state.queued_hits.is_used[0] = 1;
            state.queued_hits.body[0] = ball;
            state.queued_hits.striker[0] = {};
        },
        "queued_hits.body[0]");
}

TEST(CheckState, PiecesThatABallIsOwedAreRefused) {
    expect_refused([](State& state, Row<Bodies>, Row<Bodies> ball) { state.bodies.is_owed_births[ball] = kOwedBirths; },
                   "bodies.is_owed_births[1]");
}

TEST(CheckState, AHitThatIsWorkedOffOnABallIsRefused) {
    expect_refused(
        [](State& state, Row<Bodies> vase, Row<Bodies> ball) {
            state.tasks.body[0] = ball;
            state.bodies.task[vase] = kNone;
            state.bodies.task[ball] = 0;
        },
        "tasks.source[0]");
}

TEST(CheckState, RangesThatDoNotBeginWhereTheirPoolBeginsOnesAreRefused) {
    expect_refused(
        [](State& state, Row<Bodies> vase, Row<Bodies>) {
            Range& vertices = state.shells.vertices[state.shell_of(state.bodies.structure[vase])];
            ++vertices.first, --vertices.count, --vertices.capacity;
        },
        "the range of vertices of structure");
}

TEST(CheckState, AStructureWithoutAShellOfItsOwnOrWithTheSpringsOfAnotherIsRefused) {
    const auto own = [](State& state, Row<Bodies> vase) -> uint32_t& {
        return state.structures.rows[state.bodies.structure[vase]];
    };
    expect_refused([&](State& state, Row<Bodies> vase, Row<Bodies>) { own(state, vase) = state.shells.size(); },
                   "structures.rows[");
    expect_refused([&](State& state, Row<Bodies> vase,
                       Row<Bodies>) { own(state, vase) = state.structures.rows[state.tasks.working[0]]; },
                   "structures.rows[");
    expect_refused(
        [](State& state, Row<Bodies> vase, Row<Bodies>) { state.structures.kind[state.bodies.structure[vase]] = 7; },
        "structures.kind[");
    expect_refused([&](State& state, Row<Bodies> vase,
                       Row<Bodies>) { state.shells.springs[Row<Shells>(own(state, vase))] = Row<ShellSprings>(0); },
                   "shells.springs[");
    expect_refused([](State& state, Row<Bodies> vase,
                      Row<Bodies>) { ++state.structures.live_elements[state.bodies.structure[vase]]; },
                   "structures.live_elements is");
    expect_refused([](State& state, Row<Bodies> vase, Row<Bodies>) { state.bodies.soft[vase] = Row<SoftBodies>(0); },
                   "bodies.soft[");
}

TEST(CheckState, AWorkingShellThatIsSomebodyElsesTooIsRefused) {
    expect_refused(
        [](State& state, Row<Bodies>, Row<Bodies>) {
            const uint32_t model = state.models.append(1);
            state.models.is_used[model] = 1;
            state.models.structure[model] = state.tasks.working[0];
            state.models.mesh[model] = {};
            ++state.structures.users[state.tasks.working[0]];
        },
        "tasks.working[0]");
}

TEST(CheckState, ContactsAndPatchesOfAnotherHitAreRefused) {
    expect_refused([](State& state, Row<Bodies>, Row<Bodies>) { state.tasks.first_contact[0] = kMostContacts; },
                   "tasks.first_contact[0]");
    expect_refused(
        [](State& state, Row<Bodies>, Row<Bodies>) { state.task_contacts.first_patch[0] += kMostPatchVertices; },
        "task_contacts.first_patch[0]");
}

}  // namespace
}  // namespace cullet::test
