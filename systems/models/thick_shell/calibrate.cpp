#include "systems/models/thick_shell/calibrate.hpp"

#include <algorithm>
#include <memory>
#include <new>

#include "components/workbench.hpp"
#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/region.hpp"
#include "systems/models/thick_shell/run_hit.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr uint64_t kSeed = 0x717569636b;
constexpr float kLeastLimit = 1e-5f, kMostLimit = 1;
constexpr uint32_t kPlaces = 5;
/// The ball: a twenty-fifth of the body's mass, two wall thicknesses in radius. So, or nearly, are the balls that the
/// known thresholds of pane and wall are for; a run is too short for twice or half of either to tell.
constexpr float kBallMass = 1.0f / 25, kBallRadius = 2;
constexpr uint64_t kMostTries = 64;  // for an element that nothing holds

/// The middle of a seeded face that the ground does not hold, struck from outside along its normal.
HitDescription ball_on_face(const ShellRows& state, Row<Structures> shell, uint64_t place, float speed) {
    const Range elements = state.shells.elements[state.shell_of(shell)];
    const uint32_t first = state.shells.vertices[state.shell_of(shell)].first;
    HitDescription hit;
    for (uint64_t n = 0; n < kMostTries; ++n) {
        const uint32_t e = elements.first + static_cast<uint32_t>(Random{kSeed}.bits(place, n) % elements.count);
        const auto [a, b, c] = state.elements.corner[e];
        const auto& is_pinned = state.vertices.is_pinned;
        if (state.elements.flags[e] & kDead) continue;
        const bool is_held = is_pinned[first + a] || is_pinned[first + b] || is_pinned[first + c];
        const Vec3 pa = state.vertices.rest[first + a], pb = state.vertices.rest[first + b],
                   pc = state.vertices.rest[first + c];
        hit.point = (1.0f / 3) * (pa + pb + pc);
        hit.normal = normalised(cross(pc - pa, pb - pa));
        if (!is_held) break;
    }
    hit.striker_speed = speed;
    hit.striker_radius = kBallRadius * state.shells.thickness[state.shell_of(shell)];
    hit.striker_inverse_mass = static_cast<float>(1 / (double{kBallMass} * state.structures.mass[shell]));
    return hit;
}

/// A working shell of fine fracture has three times the body's vertices and elements, and slots of springs as for nine
/// times as many. With the room of a cooking no region of a closed body woke here, and its limit was the material's:
/// cows and castles hardly cracked. What a table may hold and does not costs nothing.
Limits limits_for(uint32_t vertices, uint32_t elements) {
    return cooking_limits(4 * vertices, 2 * elements);
}

/// Largest stretch over the strength factor of its end, seen in one run.
float largest_stretch(RunRows& state, Row<Structures> shell, const HitDescription& hit) {
    if (!open_hit(state, shell, hit)) return 0;
    const BrittleLoop loop = make_quick_loop();
    const Blows none(1);
    LoopWorld world{state, none};
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

float calibrated_strain_limit(const ShellRows& from, Row<Structures> source, const QuickSettings& quick,
                              const LayerSettings& layers, float speed) {
    if (!(speed > 0)) return 0;
    try {
        const FpMode mode;
        const auto own = std::make_unique<Workbench>(limits_for(from.shells.vertices[from.shell_of(source)].count,
                                                                from.shells.elements[from.shell_of(source)].count));
        Workbench& state = *own;
        state.materials.append(from.materials.size());
        state.materials.copy_rows(from.materials, 0, 0, from.materials.size());
        state.material_traits.append(from.material_traits.size());
        state.material_traits.copy_rows(from.material_traits, 0, 0, from.material_traits.size());
        const char* full = "";
        const Row<Structures> shell = import_bare_shell(state, from, source, &full);
        if (!shell.exists()) return 0;
        QuickSettings unbroken = quick;
        unbroken.strain_limit = kMostLimit;  // not by the strength, which is what crushes, too
        float found[kPlaces];
        for (uint32_t n = 0; n < kPlaces; ++n) {
            HitDescription hit = ball_on_face(state, shell, n, speed);
            hit.quick = &unbroken, hit.layers = layers;
            found[n] = largest_stretch(state, shell, hit);
        }
        std::sort(found, found + kPlaces);
        const float median = found[kPlaces / 2];
        return median > 0 ? std::clamp(median, kLeastLimit, kMostLimit) : 0;
    } catch (const std::bad_alloc&) {
        return 0;
    }
}

}  // namespace cullet
