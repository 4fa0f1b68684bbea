#include "systems/models/thick_shell/hidden/forget_run.hpp"

#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {
namespace {

void forget_springs(const SpringView& view) {
    ShellRows& s = view.state;
    const ShellSprings& own = view.own();
    const auto clear = [&](AnyTable& table, const Column<Range>& column) {
        const Range range = column[view.row];
        if (range.count > 0) table.clear_rows(range.first, range.count);
    };
    clear(s.spring_slots, own.slots);
    clear(s.layer_slots, own.layer_slots);
    for (uint32_t i = 0; i < view.spring_count(); ++i) {
        s.springs.length[view.spring(i)] = 0;
        if (view.has_layers()) s.layer_springs.length[view.layer(i)] = 0;
    }
    if (!view.has_layers()) return;
    const Range twins = own.twins[view.row];
    for (uint32_t row = twins.first; row < twins.first + twins.capacity; ++row) {
        for (int side = 0; side < 2; ++side) s.twins.position.set(row, {}, side);
        s.twins.velocity.set(row, {});
        s.twins.length[row] = 0;
    }
}

}  // namespace

void forget_run(RunRows& state, Row<Tasks> task) {
    TaskContacts& contacts = state.task_contacts;
    const uint32_t first = state.tasks.first_contact[task], end = first + state.tasks.contact_count[task];
    for (uint32_t c = first; c < end; ++c) {
        contacts.striker_speed[c] = contacts.start_speed[c];
        contacts.striker_travel[c] = contacts.impulse[c] = 0;
        for (uint32_t p = contacts.first_patch[c]; p < contacts.first_patch[c] + contacts.patch_count[c]; ++p)
            state.patch_vertices.force[p] = 0;
    }
    const Row<Structures> shell = state.tasks.working[task];
    if (!shell.exists()) return;
    const Range vertices = state.shells.vertices[state.shell_of(shell)];
    for (uint32_t row = vertices.first; row < vertices.first + vertices.capacity; ++row) {
        state.vertices.velocity.set(row, {});
        state.vertices.displacement.set(row, {});
        state.vertices.crush[row] = 0;
        for (int side = 0; side < 2; ++side) state.vertices.probe.set(row, {}, side);
    }
    if (const Row<ShellSprings> springs = springs_of(state, shell); springs.exists())
        forget_springs(SpringView(state, springs));
}

}  // namespace cullet
