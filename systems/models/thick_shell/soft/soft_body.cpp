#include "systems/models/thick_shell/soft/soft_body.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/soft/soft_units.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/fastest_mode.hpp"
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "systems/structures/shell/cell_hulls.hpp"

namespace cullet {
namespace {

// Of the step at which the fastest element alone runs away: damping, of the speed a step before, takes 0.06 of it.
constexpr double kStepShare = 0.9;
constexpr float kNeverBreaks = 1e6f;                    // strain of a material that gives none
constexpr float kSpare = 0.5f;                          // rows for springs that tears make
constexpr float kDragTime = 0.15f, kDragBounce = 1.2f;  // s: of what does not bounce, and what restitution adds

uint32_t row_for(SoftRows& state) {
    SoftBodies& soft = state.soft_bodies;
    for (uint32_t s = 0; s < soft.size(); ++s)
        if (!soft.is_used[s]) return s;
    const uint32_t row = soft.append(1);
    if (row != kNone) state.soft_strikers.append(kMostStrikers);
    return row;
}

/// Rows of contacts for every vertex of the shell.
void make_contact_rows(SoftRows& state, Row<Structures> shell) {
    const Range vertices = state.shells.vertices[state.shell_of(shell)];
    const uint32_t end = first_contact_row(vertices.first + vertices.capacity + kLanes - 1);
    if (end > state.soft_contacts.size()) state.soft_contacts.append(end - state.soft_contacts.size());
}

}  // namespace

bool soft_material(const MaterialRows& state, Row<Materials> row, SoftMaterial& out) {
    const auto kind = material_traits(state, row).kind;
    if (kind == MaterialKind::Brittle) return false;
    const Materials& materials = state.materials;
    const MaterialTraits& traits = state.material_traits;
    out.is_elastic = kind == MaterialKind::Elastic;
    out.density = materials.density[row];
    out.young_modulus = materials.young_modulus[row];
    out.restitution = materials.restitution[row];
    if (row < traits.size()) {
        out.yield_strain = out.is_elastic ? 0 : traits.yield_strain[row];
        out.break_strain = traits.break_strain[row];
        out.is_sheet = traits.bending_stiffness[row] > 0;
    }
    return true;
}

Row<Structures> copy_soft_shell(ShellRows& state, Row<Structures> source, const char** full) {
    ShellRoom room = room_of(state, source);
    const uint32_t count = state.shells.vertices[state.shell_of(source)].count;
    room.vertices = (count + std::max(64u, count / 2) + kLanes - 1) / kLanes * kLanes;
    room.blocks = room.links = 0;
    room.points = std::max(room.points, most_points(room.cells, room.elements));
    return copy_shell(state, source, room, full);
}

Result<Row<SoftBodies>> make_soft(SoftRows& state, Row<Bodies> body, const LayerSettings& layers, float step_seconds,
                                  uint64_t units) {
    const Row<Structures> shell = state.bodies.structure[body];
    SoftMaterial material;
    if (!soft_material(state, state.structures.material[shell], material))
        return Error{"a brittle body has no springs; please report this."};
    SpringSettings settings;
    settings.layout = spring_layout(!material.is_sheet, layers.layout);
    settings.length_factor = layers.length_factor;
    settings.area_energy = layers.area_energy;
    settings.volume_energy = layers.volume_energy;
    settings.young_modulus = material.young_modulus;
    settings.spare = kSpare;
    settings.is_slender = true;
    Result<Row<ShellSprings>> springs = give_springs(state, shell, settings);
    if (!springs) return Error{springs.error()};
    const SpringView stiff(state, *springs);
    const double stable = kStepShare * 2 / std::sqrt(std::max(fastest_mode(stiff), 1.0)),
                 wanted = step_seconds / stable;
    const uint64_t cost = soft_units_a_substep(state.shell_springs, *springs);
    const uint64_t most = std::clamp<uint64_t>(units / kSoftShare / cost, kLeastSubsteps, kMostSubsteps);
    const auto substeps = static_cast<uint32_t>(std::clamp(std::ceil(wanted), double{kLeastSubsteps}, double(most)));
    const double step = double{step_seconds} / substeps, softening = std::max(1.0, step * step / (stable * stable));
    release_springs(state, shell);
    settings.young_modulus = static_cast<float>(double{material.young_modulus} / softening);
    settings.time_step = static_cast<float>(step);
    springs = give_springs(state, shell, settings);
    if (!springs) return Error{springs.error()};
    state.shell_springs.keeps_lengths[*springs] |= kKeepsLengths;
    const uint32_t row = row_for(state);
    if (row == kNone) return Error{"limits.bodies is reached; raise it."};
    make_contact_rows(state, shell);
    SoftBodies& soft = state.soft_bodies;
    soft.clear_rows(row, 1);
    soft.is_used[row] = 1;
    soft.body[row] = body;
    state.bodies.soft[body] = Row<SoftBodies>(row);
    soft.is_elastic[row] = material.is_elastic;
    soft.is_called[row] = material.is_elastic && state.bodies.has_pins[body];
    soft.substeps[row] = substeps;
    soft.softening[row] = static_cast<float>(softening);
    const float stretch = static_cast<float>(std::sqrt(softening)), strength = state.bodies.strength_scale[body];
    if (!(material.break_strain > 0)) material.break_strain = kNeverBreaks;
    const float most_shown = std::max(material.break_strain, 1.0f);
    soft.break_strain[row] = strength * std::min(stretch * material.break_strain, most_shown);
    soft.yield_strain[row] = strength * std::min(stretch * material.yield_strain, 0.5f * most_shown);
    const float sound = std::sqrt(material.young_modulus / material.density);
    soft.wake_speed[row] = material.is_elastic
                               ? kElasticWakeSpeed
                               : std::max(kLeastWakeSpeed, strength * kWakeYieldShare * sound * material.yield_strain);
    soft.drag_time[row] = kDragTime + kDragBounce * material.restitution;
    return Row<SoftBodies>(row);
}

void inherit_soft(SoftRows& state, Row<SoftBodies> parent, Row<Bodies> body) {
    const uint32_t row = row_for(state);
    if (row == kNone) return;
    make_contact_rows(state, state.bodies.structure[body]);
    SoftBodies& soft = state.soft_bodies;
    soft.copy_rows(soft, parent, row, 1);
    soft.body[row] = body;
    state.bodies.soft[body] = Row<SoftBodies>(row);
    soft.is_awake[row] = soft.is_torn[row] = 0;
    soft.is_called[row] = 1;
    soft.partner_count[row] = soft.tear_count[row] = 0;
    soft.quiet_seconds[row] = soft.awake_seconds[row] = 0;
    soft.most_motion[row] = 0;
}

void release_soft(SoftRows& state, Row<Bodies> body) {
    Row<SoftBodies>& soft = state.bodies.soft[body];
    if (soft.exists()) state.soft_bodies.clear_rows(soft, 1);
    soft = {};
}

Row<ShellSprings> springs_of(const SoftRows& state, Row<SoftBodies> soft) {
    return springs_of(state, state.bodies.structure[state.soft_bodies.body[soft]]);
}

}  // namespace cullet
