#include "systems/quick/calibrate.hpp"

#include <algorithm>
#include <new>

#include "engine/fp_mode.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/damage/run_hit.hpp"
#include "systems/quick/quick_loop.hpp"
#include "systems/quick/region.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr uint64_t kSeed = 0x717569636b;
constexpr float kLeastLimit = 1e-5f, kMostLimit = 1;

/// Largest stretch over the strength factor of its end, seen in one run.
float largest_stretch(State& state, Row<Shells> shell, const HitDescription& hit) {
    if (!open_hit(state, shell, hit)) return 0;
    const BrittleLoop loop = make_quick_loop();
    LoopWorld world{state};
    Tasks& tasks = state.tasks;
    float most = 0;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        tasks.steps_granted[kTask] = 1;
        loop.run_alone(world, {kTask, tasks.steps_done[kTask], 1, task_goes_on});
        const RegionView region(state, kTask);
        region.for_each([&](uint32_t v, bool is_held) {
            const float factor = state.vertices.strength_factor[region.shell.vertex(v)];
            if (!is_held) most = std::max(most, region.springs.largest_strain(v) / factor);
        });
    }
    (void)finish_hit(state);
    close_hit(state);
    return most;
}

}  // namespace

float calibrated_strain_limit(const State& from, Row<Shells> source, const QuickSettings& quick, float speed) {
    if (!(speed > 0)) return 0;
    try {
        const FpMode mode;
        State state(cooking_limits(from.shells.vertices[source].count, from.shells.elements[source].count));
        state.materials.append(from.materials.size());
        state.materials.copy_rows(from.materials, 0, 0, from.materials.size());
        state.material_traits.append(from.material_traits.size());
        state.material_traits.copy_rows(from.material_traits, 0, 0, from.material_traits.size());
        const char* full = "";
        const Row<Shells> shell = import_shell(state, from, source, &full);
        if (!shell.exists()) return 0;
        QuickSettings unbroken = quick;
        unbroken.strain_limit = kMostLimit;  // not by the strength, which is what crushes, too
        float found[3];
        for (uint32_t n = 0; n < 3; ++n) {
            HitDescription hit = fall_on_floor(state, shell, seeded_direction(kSeed, n), speed);
            hit.quick = &unbroken;
            found[n] = largest_stretch(state, shell, hit);
        }
        std::sort(found, found + 3);
        return found[1] > 0 ? std::clamp(found[1], kLeastLimit, kMostLimit) : 0;
    } catch (const std::bad_alloc&) {
        return 0;
    }
}

}  // namespace cullet
