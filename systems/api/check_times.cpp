// Frames that rows wait for. One far in the future would let a task, a hit or a body wait for ever.
#include "systems/api/snapshot.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr uint64_t kMostFramesAhead = 60;  // Settings::frames_ahead

struct Times {
    std::string name, trouble;

    template <class Table>
    void expect(const Table& table, const char* column, uint32_t row, uint64_t frame, uint64_t latest) {
        if (frame <= latest || !trouble.empty()) return;
        trouble = name + ": " + table.name() + "." + column + "[" + std::to_string(row) + "] is " +
                  std::to_string(frame) + ", after frame " + std::to_string(latest) +
                  ". The snapshot is damaged or of another build; take it again.";
    }
};

}  // namespace

Result<void> check_times(const State& state, uint64_t frame, float dt, const std::string& name) {
    Times times{name, ""};
    if (frame > ~uint64_t{0} / 2) return Error{name + ": the frame is " + std::to_string(frame) + ". Take it again."};
    const Tasks& tasks = state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) continue;
        times.expect(tasks, "due_frame", t, tasks.due_frame[t], frame + kMostFramesAhead);
        times.expect(tasks, "opened_frame", t, tasks.opened_frame[t],
                     frame + (is_ahead(tasks, t) ? kMostFramesAhead : 0));
    }
    const QueuedHits& queued = state.queued_hits;
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q]) times.expect(queued, "frame", q, queued.frame[q], frame);
    const Bodies& bodies = state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b)
        times.expect(bodies, "retry_frame", b, bodies.retry_frame[b], frame + retry_frames(dt));
    const FragmentAges& fragments = state.fragment_ages;
    for (uint32_t b = 0; b < fragments.size(); ++b) times.expect(fragments, "born", b, fragments.born[b], frame);
    const DebrisAges& debris = state.debris_ages;
    for (uint32_t d = 0; d < debris.size(); ++d) times.expect(debris, "born", d, debris.born[d], frame);
    if (!times.trouble.empty()) return Error{times.trouble};
    return {};
}

}  // namespace cullet
