#include "systems/models/thick_shell/shared/working_room.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"

namespace cullet {

namespace {

/// A vase of some hundred vertices takes up to 600 copies and inserted vertices in a hard hit, a house of 900 under a
/// charge within it up to a thousand.
constexpr uint32_t kLeastSpare = 1024;
/// Small ones take less: clearing rows for a thousand was nine tenths of the opening of a hit on a shard of thirty.
constexpr uint32_t kSpareAVertex = 8;

/// Finer fracture cuts more edges, and a cut without room for its copies is refused.
uint32_t spare_vertices(const MaterialRows& state, Row<Materials> material, uint32_t vertices) {
    const FractureKind fracture = material_traits(state, material).fracture;
    const uint32_t share = fracture == FractureKind::Fine ? 1 : fracture == FractureKind::Coarse ? 2 : 4;
    const uint32_t least = std::min(kLeastSpare, kSpareAVertex * vertices);
    return (std::max(least, vertices / share) + kLanes - 1) / kLanes * kLanes;
}

ShellRoom room_with(uint32_t spare, uint32_t vertices, uint32_t elements, uint32_t hinges) {
    ShellRoom room;
    room.vertices = (vertices + kLanes - 1) / kLanes * kLanes + spare;
    room.elements = elements + 2 * spare;
    room.hinges = hinges + 3 * spare;
    return room;
}

uint32_t spare_vertices(const ShellView& source) {
    return spare_vertices(source.state, source.structures().material[source.structure], source.vertex_count());
}

}  // namespace

// Cracks that run on across the whole body take a copy and an inserted vertex or two an edge. With the hidden run's
// spare a wall of 823 vertices was full after seven of them, and the rest ended where it was.
ShellRoom quick_room(const MaterialRows& state, Row<Materials> material, uint32_t vertices, uint32_t elements,
                     uint32_t hinges) {
    return room_with(2 * spare_vertices(state, material, vertices), vertices, elements, hinges);
}

ShellRoom hidden_room(const MaterialRows& state, Row<Materials> material, uint32_t vertices, uint32_t elements,
                      uint32_t hinges) {
    return room_with(spare_vertices(state, material, vertices), vertices, elements, hinges);
}

ShellRoom quick_room(ShellView source) {
    ShellRoom room = quick_room(source.state, source.structures().material[source.structure], source.vertex_count(),
                                source.element_count(), source.hinge_count());
    room.cells = source.cells().count;
    return room;
}

ShellRoom working_room(ShellView source) {
    const uint32_t spare = spare_vertices(source);
    const ShellRoom stiffness = stiffness_room(source, spare);
    ShellRoom room;
    room.vertices = std::max(source.vertex_count() + spare, stiffness.vertices);
    room.elements = source.element_count() + 2 * spare;
    room.hinges = source.hinge_count() + 3 * spare;
    room.blocks = stiffness.blocks;
    room.links = stiffness.links;
    room.cells = source.cells().count;
    return room;
}

bool may_find_room(const BodyRows& state, Row<Bodies> body) {
    const ShellView source(const_cast<BodyRows&>(state), state.bodies.structure[body]);
    const Shells& own = state.shells;
    const ShellRoom room = is_quick_body(state, body) ? quick_room(source) : working_room(source);
    const auto fits = [](const AnyTable& table, const Range& beside, uint32_t wanted) {
        return uint64_t{beside.capacity} + wanted <= table.limit();
    };
    return fits(state.vertices, own.vertices[source.row], room.vertices) &&
           fits(state.elements, own.elements[source.row], room.elements) &&
           fits(state.hinges, own.hinges[source.row], room.hinges) &&
           fits(state.stiffness_blocks, own.blocks[source.row], room.blocks) &&
           fits(state.stiffness_links, own.links[source.row], room.links);
}

// Where there is a grain the slowest waves are those across it.
float run_seconds(const MaterialRows& state, uint32_t material, float area) {
    const Materials& materials = state.materials;
    const TraitsRow traits = material_traits(state, Row<Materials>(material));
    const float along = materials.young_modulus[material];
    const float slowest = traits.has_grain() ? std::min(along, traits.across_young_modulus) : along;
    const float speed_of_sound = std::sqrt(slowest / materials.density[material]);
    return std::max(materials.run_seconds[material], 3.6f * std::sqrt(area) / speed_of_sound);
}

void set_task_times(RunRows& state, Row<Tasks> task) {
    const Row<Structures> source = state.tasks.source[task];
    state.hidden_runs.time_step[task] = state.shells.time_step[state.shell_of(source)];
    state.hidden_runs.damping_time[task] = 0.15f * state.hidden_runs.time_step[task];
    state.hidden_runs.end_time[task] =
        run_seconds(state, state.structures.material[source], state.structures.area[source]);
    state.hidden_runs.quiet_time[task] = 0.4f * state.hidden_runs.end_time[task];
}

}  // namespace cullet
