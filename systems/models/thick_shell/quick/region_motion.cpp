#include "systems/models/thick_shell/quick/region_motion.hpp"

#include <algorithm>
#include <optional>

#include "systems/bodies/coupling.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/start_explosions.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Substeps that a wave takes for an edge: 0.35 edges a step (B6). Rings beyond its reach, so that what is held is not
/// met.
constexpr float kEdgesAStep = 0.35f;
constexpr uint32_t kSpareRings = 3;
/// J/kg, what a centimetre a second is: under it lengths of springs, which are floats, round to as much as a run gains.
constexpr double kLeastScale = 5e-5;

template <class F>
void for_each_contact(const RunRows& state, Row<Tasks> task, F&& f) {
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) f(c);
}

float diagonal_of(const ShellView& shell) {
    const VertexSums sums = vertex_sums(shell);
    return sums.high.x >= sums.low.x ? length(sums.high - sums.low) : 0;
}

/// All of the shell stands still at its rest shape: what is asleep may be cut, too.
void rest_all(const SpringView& view) {
    Vertices& vertices = view.state.vertices;
    const ShellView& shell = view.shell;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        view.place(v, vertices.rest[row]);
        vertices.velocity.set(row, {});
        vertices.displacement.set(row, {});
        vertices.crush[row] = 0;
    }
}

void rest_twins(const RegionView& region) {
    const SpringView& view = region.springs;
    if (!view.has_layers()) return;
    region.for_each([&](uint32_t v, bool) {
        view.place_twin(v, inner_rest(view, v).to_float());
        view.state.twins.velocity.set(view.twin(v), {});
        view.state.twins.length[view.twin(v)] = length(view.twin_position(v) - view.position(v));
    });
}

/// A patch vertex's inverse mass: of its outer point where there are two.
float inverse_mass_of(const SpringView& view, uint32_t v) {
    return view.has_layers() ? view.state.twins.inverse_mass[view.twin(v)]
                             : view.state.vertices.inverse_mass[view.shell.vertex(v)];
}

/// Speeds of the strikers as the body sees them, which its strain limit asks for.
void see_strikers(RunRows& state, Row<Tasks> task) {
    const BodyMotion motion(state, task);
    TaskContacts& contacts = state.task_contacts;
    for_each_contact(state, task, [&](uint32_t c) {
        const auto along = dot(motion.at(contacts.point[c]), Vec3d(contacts.normal[c]));
        contacts.striker_speed[c] = contacts.start_speed[c] - along;
        contacts.striker_travel[c] = contacts.impulse[c] = 0;
    });
}

}  // namespace

uint32_t region_rings(uint32_t steps) {
    return static_cast<uint32_t>(static_cast<float>(steps) * kEdgesAStep) + kSpareRings;
}

bool wake_region(RunRows& state, Row<Tasks> task, const char** full) {
    build_patches(state, task);
    choose_region(state, task, region_rings(state.quick_runs.steps[task]));
    see_strikers(state, task);
    if (take_region_springs(state, task, state.quick_runs.layers[task], full)) return true;
    state.tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);
    return false;
}

bool wake_region_alone(RunRows& state, const Blows& blows, Row<Tasks> task, const char** full) {
    if (!wake_region(state, task, full)) return false;
    const RegionView region(state, task);
    const uint32_t first = region.first_row(), end = first + region.pack_count();
    for (uint32_t row = first; row < end; row += kRowsPerChunk<MarkedPacks>) measure_region_springs(region, row);
    for (uint32_t row = first; row < end; row += kRowsPerChunk<MarkedPacks>) lay_region_springs(region, row);
    start_region(state, blows, task);
    return true;
}

void start_region(RunRows& state, const Blows& blows, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const TaskContacts& contacts = state.task_contacts;
    const RegionView region(state, task);
    const SpringView& view = region.springs;
    const ShellView& shell = region.shell;
    const uint32_t steps = state.quick_runs.steps[task];
    limit_region_springs(region);
    state.quick_runs.diagonal[task] = diagonal_of(ShellView(state, tasks.source[task]));
    rest_all(view);
    rest_twins(region);
    HiddenRuns& runs = state.hidden_runs;
    runs.time_step[task] = view.own().time_step[view.row];
    runs.damping_time[task] = 0;
    runs.end_time[task] = (static_cast<float>(steps) - 0.5f) * runs.time_step[task];
    runs.quiet_time[task] = runs.end_time[task];  // so short a run is over before it is quiet
    runs.last_event_time[task] = 0;
    tasks.steps_done[task] = 0;
    tasks.crack_count[task] = tasks.start_count[task] = 0;
    tasks.lacks_room[task] = 0;
    build_patches(state, task);  // now that step and softening are known
    start_explosions(state, blows, task);
    if (view.has_layers())
        region.for_each([&](uint32_t v, bool) {
            state.twins.velocity.set(view.twin(v), state.vertices.velocity[shell.vertex(v)]);
        });
    runs.start_energy[task] = region_energy(region).total();
    double scale = std::max(runs.start_energy[task], kLeastScale * state.structures.mass[shell.structure]);
    for_each_contact(state, task, [&](uint32_t c) {
        if (contacts.striker_inverse_mass[c] > 0) return;
        scale += 0.5 * state.structures.mass[shell.structure] * contacts.striker_speed[c] * contacts.striker_speed[c];
    });
    state.quick_runs.energy_scale[task] = scale;
}

void close_region(RunRows& state, Row<Tasks> task, const BodyMotion& motion) {
    QuickRuns& runs = state.quick_runs;
    if (!runs.springs[task].exists()) return;
    const RegionView region(state, task);
    const SpringView& view = region.springs;
    const ShellView& shell = region.shell;
    Vertices& vertices = state.vertices;
    if (view.has_layers())
        region.for_each([&](uint32_t v, bool) {
            const uint32_t row = shell.vertex(v);
            vertices.velocity.set(row, 0.5f * (vertices.velocity[row] + state.twins.velocity[view.twin(v)]));
        });
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const bool is_free = vertices.inverse_mass[row] > 0;
        const Vec3d whole = motion.at(vertices.rest[row]) + Vec3d(vertices.velocity[row]);
        vertices.velocity.set(row, is_free ? whole.to_float() : Vec3{});
    }
    TaskContacts& contacts = state.task_contacts;
    for_each_contact(state, task, [&](uint32_t c) {
        contacts.striker_speed[c] += dot(motion.at(contacts.point[c]), Vec3d(contacts.normal[c]));
    });
    release_springs(state, shell.structure);
    runs.springs[task] = {};
    state.hidden_runs.pack_count[task] = 0;
    state.marked_packs.clear_rows(task * kMostMarkedPacks, kMostMarkedPacks);
}

bool region_forces(const RegionView& region) {
    RunRows& state = region.state;
    PatchVertices& patches = state.patch_vertices;
    const TaskContacts& contacts = state.task_contacts;
    bool touches = false;
    for_each_contact(state, region.task, [&](uint32_t c) {
        const auto travel = static_cast<float>(contacts.striker_travel[c]);
        for (uint32_t p = contacts.first_patch[c]; p < contacts.first_patch[c] + contacts.patch_count[c]; ++p) {
            const uint32_t v = patches.vertex[p];
            const float depth = travel - dot(contacts.normal[c], region.moved(v));
            float& crush = state.vertices.crush[region.shell.vertex(v)];
            patches.force[p] = patches.stiffness[p] > 0 ? patch_spring(patches, p).force(depth, crush) : 0.0f;
            touches = touches || patches.force[p] > 0;
        }
    });
    return touches;
}

// Semi-implicit, as the springs' own step, which has moved the points already: what the patch adds to a velocity moves
// its point for the length of this step.
void push_region(const RegionView& region) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    TaskContacts& contacts = state.task_contacts;
    const double dt = state.hidden_runs.time_step[region.task];
    const uint32_t first = state.tasks.first_contact[region.task];
    double forces[kMostContacts] = {};
    for_each_contact(state, region.task, [&](uint32_t c) {
        const Vec3 n = contacts.normal[c];
        double& force = forces[c - first];
        for (uint32_t p = contacts.first_patch[c]; p < contacts.first_patch[c] + contacts.patch_count[c]; ++p) {
            const float f = state.patch_vertices.force[p];
            if (f == 0) continue;
            force += f;
            const uint32_t v = state.patch_vertices.vertex[p], row = region.shell.vertex(v);
            const Vec3 dv = (static_cast<float>(dt) * inverse_mass_of(view, v) * f) * n;
            state.vertices.velocity.set(row, state.vertices.velocity[row] + dv);
            Float4& x = state.vertices.probe.data(view.side())[row];
            const Vec3 dx = static_cast<float>(dt) * dv;
            x = {x.x + dx.x, x.y + dx.y, x.z + dx.z, x.w};
        }
        contacts.striker_speed[c] -= dt * contacts.striker_inverse_mass[c] * force;
        contacts.impulse[c] += dt * force;
    });
    // What pushes a striker at one contact moves it at its others too.
    for_each_contact(state, region.task, [&](uint32_t c) {
        for_each_contact(state, region.task, [&](uint32_t other) {
            if (share_a_striker(contacts, c, other))
                contacts.striker_speed[c] -= dt * coupling(contacts, c, other) * forces[other - first];
        });
        contacts.striker_travel[c] += dt * contacts.striker_speed[c];
    });
}

void hold_region(const RegionView& region) {
    const SpringView& view = region.springs;
    RunRows& state = region.state;
    const MarkedPacks& packs = state.marked_packs;
    const auto put = [](Float4& x, Vec3 place) { x = {place.x, place.y, place.z, x.w}; };
    for (uint32_t row = region.first_row(); row < region.first_row() + region.pack_count(); ++row)
        for (uint32_t k = 0; packs.held[row] >> k; ++k) {
            if (!(packs.held[row] >> k & 1)) continue;
            const uint32_t v = packs.pack[row] * kLanes + k;
            put(state.vertices.probe.data(view.side())[region.shell.vertex(v)],
                state.vertices.rest[region.shell.vertex(v)]);
            if (view.has_layers())
                put(state.twins.position.data(view.side())[view.twin(v)], inner_rest(view, v).to_float());
        }
}

bool has_blown_up(const RegionView& region) {
    TaskEnergy energy = region_energy(region);
    energy.membrane = kept_spring_energy(region.springs);
    const double wanted = region.state.hidden_runs.start_energy[region.task] + energy.work;
    return !(energy.total() <= wanted + 0.05 * std::max(region.state.quick_runs.energy_scale[region.task], wanted));
}

TaskEnergy region_energy(const RegionView& region) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    const TaskContacts& contacts = state.task_contacts;
    const PatchVertices& patches = state.patch_vertices;
    TaskEnergy energy;
    region.for_each([&](uint32_t v, bool is_held) {
        if (is_held) return;
        const uint32_t row = region.shell.vertex(v);
        const Vec3d own(state.vertices.velocity[row]);
        double square = dot(own, own);
        if (view.has_layers()) {
            const Vec3d inner(state.twins.velocity[view.twin(v)]);
            square = 0.5 * (square + dot(inner, inner));
        }
        energy.kinetic += 0.5 * state.vertices.mass[row] * square;
    });
    energy.membrane = spring_energy(view);
    std::optional<BodyMotion> motion;  // a pass over the body: made when it is asked for
    for_each_contact(state, region.task, [&](uint32_t c) {
        const double inverse_mass = contacts.striker_inverse_mass[c], speed = contacts.striker_speed[c];
        bool is_shared = false;
        for_each_contact(state, region.task,
                         [&](uint32_t other) { is_shared = is_shared || share_a_striker(contacts, c, other); });
        if (is_shared) {  // what pushes did to it, as in the hidden run
            if (!motion) motion.emplace(state, region.task);
            const double start =
                contacts.start_speed[c] - dot(motion->at(contacts.point[c]), Vec3d(contacts.normal[c]));
            energy.strikers += 0.5 * start * start / inverse_mass - 0.5 * contacts.impulse[c] * (start + speed);
        } else if (inverse_mass > 0) {
            energy.strikers += 0.5 * speed * speed / inverse_mass;
        } else {
            energy.work += contacts.impulse[c] * speed;
        }
        for (uint32_t p = contacts.first_patch[c]; p < contacts.first_patch[c] + contacts.patch_count[c]; ++p) {
            if (!(patches.stiffness[p] > 0)) continue;
            const uint32_t v = patches.vertex[p];
            const auto depth =
                static_cast<float>(contacts.striker_travel[c]) - dot(contacts.normal[c], region.moved(v));
            energy.contact += patch_spring(patches, p).energy(depth, state.vertices.crush[region.shell.vertex(v)]);
        }
    });
    return energy;
}

}  // namespace cullet
