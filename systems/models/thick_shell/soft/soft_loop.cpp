#include "systems/models/thick_shell/soft/soft_loop.hpp"

#include "systems/models/thick_shell/soft/find_strikers.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/soft_shape.hpp"
#include "systems/systems.hpp"

namespace cullet {

Row<ShellSprings> SoftWorld::springs_of(uint32_t soft) const {
    return cullet::springs_of(state, Row<SoftBodies>(soft));
}

SoftInnerLoop make_soft_loop(SpringLayout layout) {
    SoftInnerLoop loop;
    if (layout == SpringLayout::OneLayer)
        loop.then<integrate_springs>();
    else
        loop.then<integrate_layers>();
    loop.then<meet_strikers>()
        .then<end_spring_step>()
        .then<flow_springs>(kSubstepsAFlow)
        .then<tear_springs>(kSubstepsAFlow);
    if (layout == SpringLayout::OneLayer) loop.then<bend_sheets>(kSubstepsAFlow);
    loop.finish();
    return loop;
}

std::string SoftLoop::describe() const {
    return one_layer_.describe() + "      the same, of bodies with an inner and an outer layer\n" + layers_.describe();
}

SoftLoop::SoftLoop(JobSystem& jobs, Profiler& profiler)
    : jobs_(jobs),
      profiler_(profiler),
      one_layer_(make_soft_loop(SpringLayout::OneLayer)),
      layers_(make_soft_loop(SpringLayout::Sandwich)),
      zone_(profiler.add_zone("soft body")) {}

void SoftLoop::advance(SoftRows& state, const RigidWorld& rigid, const Step& step) {
    static constexpr uint32_t kMostAtOnce = 256;
    SoftWorld world{state};
    SoftBodies& soft = state.soft_bodies;
    uint32_t awake[kMostAtOnce], count = 0;
    // More than that many: the next ones rest for the frame. Rows rise, so it is always the same ones.
    for (uint32_t s = 0; s < soft.size() && count < kMostAtOnce; ++s)
        if (soft.is_used[s] && soft.is_awake[s]) awake[count++] = s;
    if (count == 0) return;
    parallel_for(jobs_, count, [&](uint32_t i) { find_strikers(state, rigid, Row<SoftBodies>(awake[i]), step); });
    share_strikers(state);
    const uint32_t workers = jobs_.worker_count();
    uint32_t alone[kMostAtOnce], together[kMostAtOnce], alone_count = 0, together_count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const Row<Shells> shell = state.bodies.shell[soft.body[awake[i]]];
        if (state.shells.vertices[shell].count > kSoftTeamVertices && workers > 1)
            together[together_count++] = awake[i];
        else
            alone[alone_count++] = awake[i];
    }
    if (together_count >= workers) {
        for (uint32_t i = 0; i < together_count; ++i) alone[alone_count++] = together[i];
        together_count = 0;
    }
    const auto loop_of = [&](uint32_t s) -> const SoftInnerLoop& {
        const Row<ShellSprings> row = world.springs_of(s);
        const bool has_layers = static_cast<SpringLayout>(state.shell_springs.layout[row]) != SpringLayout::OneLayer;
        return has_layers ? layers_ : one_layer_;
    };
    const auto run_of = [&](uint32_t s) {
        return SoftInnerLoop::Run{s, state.shell_springs.steps[world.springs_of(s)], soft.granted[s], nullptr};
    };
    for (uint32_t i = 0; i < together_count; ++i) {
        SoftInnerLoop::Team team(loop_of(together[i]), world, run_of(together[i]), workers);
        parallel_for(jobs_, workers, [&](uint32_t worker) {
            const uint64_t start = now_ns();
            team.work(worker);
            profiler_.add_span(zone_, start, now_ns());
        });
    }
    parallel_for(jobs_, alone_count, [&](uint32_t i) {
        const uint64_t start = now_ns();
        loop_of(alone[i]).run_alone(world, run_of(alone[i]));
        profiler_.add_span(zone_, start, now_ns());
    });
    parallel_for(jobs_, count, [&](uint32_t i) { end_soft_frame(state, Row<SoftBodies>(awake[i]), step); });
}

void advance_soft(Serial, Step step, SoftRows& rows, const RigidWorld& rigid, SoftLoop& loop) {
    loop.advance(rows, rigid, step);
}

}  // namespace cullet
