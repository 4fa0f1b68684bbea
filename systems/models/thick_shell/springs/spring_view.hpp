// One shell and its springs, in a set or a list of tables, with their ranges looked up.
#pragma once
#include "components/shell_groups.hpp"

namespace cullet {

/// In place of the springs of an element that moves with the body: none are ever made for it, and what has springs
/// beside it has a border there (quick mode).
inline constexpr uint32_t kAsleepSpring = kNone - 1;

template <class Rows>
struct SpringsIn {
    Rows state;
    Row<ShellSprings> row;
    ShellIn<Rows> shell;

    SpringsIn(Rows s, Row<ShellSprings> r) : state(s), row(r), shell(s, s.shell_springs.structure[r]) {}
    /// Of a view of more.
    template <class More>
    requires std::is_convertible_v<const More&, Rows> SpringsIn(const SpringsIn<More>& o)
        : state(o.state), row(o.row), shell(o.shell) {}

    auto& own() const { return state.shell_springs; }
    SpringLayout layout() const { return static_cast<SpringLayout>(own().layout[row]); }
    bool has_layers() const { return layout() != SpringLayout::OneLayer; }
    /// The side of two-sided positions that is current.
    int side() const { return static_cast<int>(own().steps[row] & 1); }
    uint32_t spring_count() const { return own().springs[row].count; }
    uint32_t pack_count() const { return own().packs[row].count; }
    /// Table rows of relative indices.
    uint32_t spring(uint32_t s) const { return own().springs[row].first + s; }
    uint32_t layer(uint32_t s) const { return own().layers[row].first + s; }
    uint32_t edges(uint32_t e) const { return own().edges[row].first + e; }
    uint32_t pack(uint32_t p) const { return own().packs[row].first + p; }
    uint32_t slot(uint32_t s) const { return own().slots[row].first + s; }
    uint32_t layer_slot(uint32_t s) const { return own().layer_slots[row].first + s; }
    uint32_t twin(uint32_t v) const { return own().twins[row].first + v; }

    Vec3 position(uint32_t v) const {
        const Float4 p = state.vertices.probe.get(shell.vertex(v), side());
        return {p.x, p.y, p.z};
    }
    Vec3 twin_position(uint32_t v) const {
        const Float4 p = state.twins.position.get(twin(v), side());
        return {p.x, p.y, p.z};
    }
    /// Largest elongation among the springs of the outer point before the last step; -1 without one.
    float largest_strain(uint32_t v) const { return state.vertices.probe.get(shell.vertex(v), side()).w; }
    /// Puts the point there, now and before; its springs' lengths are not told.
    void place(uint32_t v, Vec3 p) const {
        for (int k = 0; k < 2; ++k) state.vertices.probe.set(shell.vertex(v), {p.x, p.y, p.z, -1}, k);
    }
    void place_twin(uint32_t v, Vec3 p) const {
        for (int k = 0; k < 2; ++k) state.twins.position.set(twin(v), {p.x, p.y, p.z, -1}, k);
    }
};
using SpringView = SpringsIn<ShellRows&>;

using SteppedView = SpringsIn<SteppedTables>;
using FlowingView = SpringsIn<FlowingTables>;
using BentView = SpringsIn<BentTables>;

}  // namespace cullet
