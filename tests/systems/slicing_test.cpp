// One blow gives the same bytes however its steps are cut into calls and whoever works on them.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/hash.hpp"
#include "sample_game/hit_bench.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr uint32_t kUnlimited = 1u << 20;

/// Drives the task that open_hit made; `steps_a_call` at a time, by one thread alone or by a team.
void drive(State& state, uint32_t steps_a_call, uint32_t team_size) {
    const BrittleLoop loop = make_brittle_loop();
    LoopWorld world{state, state.blows};
    Tasks& tasks = state.tasks;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        tasks.steps_granted[kTask] = steps_a_call;
        const BrittleLoop::Run run{kTask, tasks.steps_done[kTask], steps_a_call, task_goes_on};
        if (team_size == 1) {
            loop.run_alone(world, run);
            continue;
        }
        BrittleLoop::Team team(loop, world, run, team_size);
        const auto work = [&team] {
            const FpMode mode;
            team.work();
        };
        std::vector<std::thread> helpers;
        for (uint32_t i = 1; i < team_size; ++i) helpers.emplace_back(work);
        work();
        for (std::thread& helper : helpers) helper.join();
    }
}

/// Hash of all that the blow left behind: cracks, pieces, motion, contact.
uint64_t hash_of_blow(HitBench& bench, const HitDescription& hit, uint32_t steps_a_call, uint32_t team_size,
                      HitReport& report) {
    const FpMode mode;
    State& state = bench.state();
    EXPECT_TRUE(open_hit(state, bench.shell(), hit));
    drive(state, steps_a_call, team_size);
    const Row<Structures> working = state.tasks.working[kTask];
    std::vector<uint8_t> bytes;
    const auto add = [&bytes](const void* data, size_t size) {
        const auto* first = static_cast<const uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + size);
    };
    const ShellView shell(state, working);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const Vec3 vectors[] = {state.vertices.rest[row], state.vertices.displacement[row],
                                state.vertices.velocity[row], state.vertices.heading[row]};
        add(vectors, sizeof vectors);
        add(&state.vertices.crack[row], 1);
        add(&state.vertices.mass[row], sizeof(double));
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        add(&state.elements.corner[row], sizeof state.elements.corner[row]);
        add(&state.elements.neighbour[row], sizeof state.elements.neighbour[row]);
    }
    report = finish_hit(state);
    for (uint32_t e = 0; e < shell.element_count(); ++e) add(&state.elements.part[shell.element(e)], sizeof(uint32_t));
    add(&report.impulse, sizeof report.impulse);
    add(&report.steps, sizeof report.steps);
    close_hit(state);
    return hash_bytes(bytes.data(), bytes.size(), 0);
}

class Slicing : public testing::TestWithParam<Subject> {};

TEST_P(Slicing, ABlowGivesTheSameBytesWhateverTheSlicesAndTheTeam) {
    const Result<HitSubject> known = make_subject(GetParam());
    ASSERT_TRUE(known.ok()) << known.error();
    HitBench bench(GetParam(), known->model);
    const HitDescription hit = bench.blow(3, known->hit_speed);
    HitReport report;
    const uint64_t whole = hash_of_blow(bench, hit, kUnlimited, 1, report);
    EXPECT_GT(report.parts, 1u) << "a blow that breaks nothing shows little";
    for (const uint32_t steps_a_call : {1u, 7u, kUnlimited})
        for (const uint32_t team_size : {1u, 2u, 3u}) {
            if (team_size > 1 && steps_a_call == 1) continue;  // some thousand teams
            if (team_size > 2 && steps_a_call == 7) continue;
            EXPECT_EQ(hash_of_blow(bench, hit, steps_a_call, team_size, report), whole)
                << steps_a_call << " steps a call, " << team_size << " threads";
        }
}

INSTANTIATE_TEST_SUITE_P(All, Slicing, testing::ValuesIn(kSubjects), [](const auto& of) {
    return std::string(std::array{"Vase", "Pane", "Wall"}[static_cast<size_t>(of.param)]);
});

}  // namespace
}  // namespace cullet
