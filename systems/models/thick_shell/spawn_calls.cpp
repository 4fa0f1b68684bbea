#include "systems/models/thick_shell/spawn_calls.hpp"

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/calibrate.hpp"
#include "systems/models/thick_shell/hidden/strength_factors.hpp"
#include "systems/models/thick_shell/restore_calls.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/stiffness/stiffen_pinned.hpp"
#include "systems/structures/shell/cook/apply_pins.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

void seed_strength(const ShellView& shell, const SpawnSettings& settings) {
    if (settings.strength_seed != 0) fill_strength_factors(shell, settings.strength_seed);
}

uint32_t pin(const ShellView& shell, const SpawnSettings& settings) {
    uint32_t pinned = 0;
    for (uint32_t i = 0; i < settings.pin_count; ++i)
        pinned += apply_pins(shell, settings.pins[i].low, settings.pins[i].high);
    return pinned;
}

Error no_pinned(const SpawnSettings& settings) {
    return Error{"no vertex lies in any of the " + std::to_string(settings.pin_count) +
                 " pin boxes; they are in body coordinates, in metres."};
}

// A shell of the body's own, as springs need it.
Result<Row<Structures>> soft_copy(ShellRows& state, Row<Structures> source, const SpawnSettings& settings) {
    const char* full = "";
    const Row<Structures> copy = copy_soft_shell(state, source, &full);
    if (!copy.exists()) return Error{std::string("no room for a ductile or elastic body; raise ") + full + "."};
    if (settings.pin_count > 0 && pin(ShellView(state, copy), settings) == 0) {
        release_shell(state, copy);
        return no_pinned(settings);
    }
    return copy;
}

// Large bodies have a shell of their own from the start: what a hit changes is written into it (cut_out.hpp).
bool wants_own_shell(const ShellRows& state, Row<Structures> source, const SpawnSettings& settings) {
    if (settings.thick_shell.fracture == FractureMode::Quick)
        return state.shells.vertices[state.shell_of(source)].count > kWholeCopyVertices;
    const bool is_brittle = material_traits(state, state.structures.material[source]).kind == MaterialKind::Brittle;
    return is_brittle && settings.is_breakable && is_for_cut_outs(state, source, false);
}

// Measured now, and not in the frame of the first hit.
void remember_sums(const ShellView& shell) {
    keep_vertex_sums(shell);
    measure_outdated(shell);
}

// Rows of a body's own shell; of a large one with those that cracks will add.
ShellRoom own_room(ShellRows& state, Row<Structures> source, const SpawnSettings& settings) {
    ShellRoom room = room_of(state, source);
    if (!wants_own_shell(state, source, settings)) return room;
    const ShellRoom quick = quick_room(ShellView(state, source));
    room.vertices = quick.vertices, room.elements = quick.elements, room.hinges = quick.hinges;
    room.points += room.points / 4 + 32 * kMostCellPoints;  // hulls that a hit changes are written behind the others
    return room;
}

Result<Row<Structures>> own_copy(ShellRows& state, Row<Structures> source, const SpawnSettings& settings) {
    const char* full = "";
    ShellRoom room = own_room(state, source, settings);
    room.blocks = room.links = 0;
    const Row<Structures> copy = copy_shell(state, source, room, &full);
    if (!copy.exists())
        return Error{std::string("no room for a large body that breaks near its hits; raise ") + full + "."};
    seed_strength(ShellView(state, copy), settings);
    remember_sums(ShellView(state, copy));
    return copy;
}

// A shell of the body's own with these vertices pinned, its limits and rows made anew (B7: pins change what an unpinned
// item is).
Result<Row<Structures>> pinned_copy(ShellRows& state, Row<Structures> source, const SpawnSettings& settings) {
    const char* full = "";
    const Row<Structures> copy = copy_shell(state, source, own_room(state, source, settings), &full);
    if (!copy.exists()) return Error{std::string("no room for a pinned body; raise ") + full + "."};
    const ShellView shell(state, copy);
    if (pin(shell, settings) == 0) {
        release_shell(state, copy);
        return no_pinned(settings);
    }
    if (!stiffen_pinned(shell)) {
        release_shell(state, copy);
        return Error{"the pinned body's stiffness does not fit the model's rows; please report this mesh."};
    }
    seed_strength(shell, settings);
    if (wants_own_shell(state, source, settings)) remember_sums(shell);
    return copy;
}

bool is_brittle(const MaterialRows& state, Row<Materials> material) {
    return material_traits(state, material).kind == MaterialKind::Brittle;
}

// What never gives way needs no springs.
bool is_soft(const MaterialRows& state, Row<Materials> material, const Spawning& spawning) {
    return !is_brittle(state, material) && spawning.is_breakable && spawning.knows_surfaces;
}

}  // namespace

Result<Row<Structures>> spawn_shell(ShellRows& state, Row<Structures> source, const Spawning& spawning) {
    const SpawnSettings& settings = spawning.settings;
    if (is_soft(state, state.structures.material[source], spawning)) return soft_copy(state, source, settings);
    if (settings.pin_count > 0) return pinned_copy(state, source, settings);
    if (wants_own_shell(state, source, settings)) return own_copy(state, source, settings);
    return source;
}

const char* why_not_cut(const BodyRows& state, Row<Bodies> body) {
    switch (material_traits(state, state.structures.material[state.bodies.structure[body]]).kind) {
        case MaterialKind::Ductile:
            return "its material is ductile; cut one of a material that breaks";
        case MaterialKind::Elastic:
            return "its material is elastic; cut one of a material that breaks";
        default:
            return nullptr;
    }
}

Result<ShellRoom> spawn_body(SoftRows& state, Row<Bodies> body, const Spawning& spawning) {
    const ThickShellSpawnSettings& settings = spawning.settings.thick_shell;
    const Row<Structures> shell = state.bodies.structure[body];
    const Row<Materials> material = state.structures.material[shell];
    const bool is_breakable = spawning.is_breakable && is_brittle(state, material);
    state.bodies.is_breakable[body] = is_breakable;
    QuickSettings quick = settings.quick;
    if (settings.fracture == FractureMode::Quick && is_breakable && quick.strain_limit == 0)
        quick.strain_limit =
            calibrated_strain_limit(state, shell, quick, settings.springs, state.structures.first_crack_speed[shell]);
    set_fracture(state, body, settings.fracture, quick, settings.springs);
    if (is_breakable) return room_of_hit(state, body);
    if (!is_soft(state, material, spawning)) return ShellRoom{};
    const Result<Row<SoftBodies>> soft =
        make_soft(state, body, settings.springs, spawning.step_seconds, spawning.units_a_frame);
    if (!soft) return Error{soft.error()};
    return room_of(state, shell);
}

}  // namespace cullet
