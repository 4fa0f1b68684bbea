// Blows that the game asked for: pushes without a rigid striker, explosions, cuts.
#pragma once
#include <array>

#include "components/bodies.hpp"
#include "components/tasks.hpp"

namespace cullet {

enum class BlowKind : uint8_t { None = 0, Push, Explosion, Cut };

inline constexpr uint32_t kMostCutPoints = 32;  // corners of a polyline

/// One row is one blow, from the call that asks for it until it is worked off. Rows keep the order of the calls. What
/// the game asked of all bodies stands in world axes (body kNone) until the next step takes it. Then each body that it
/// reaches gets a row of its own, in the body's frame, which its pieces share. Calls fill half of the table; the other
/// half is for those rows.
struct Blows : Table<Blows> {
    using Table::Table;
    CULLET_TABLE(blows);
    Column<uint8_t> kind{*this, "kind"};          // BlowKind
    Column<Row<Bodies>> body{*this, "body"};      // kNone: all that it reaches, and the rest stands in world axes
    Column<uint32_t> task{*this, "task"};         // the open task that works it off, or kNone: it waits
    Column<uint8_t> is_taken{*this, "is_taken"};  // some step has looked at it
    Column<uint8_t> is_paid{*this, "is_paid"};    // the body has got `impulse` and `turning`
    Column<uint8_t> goes_on{*this, "goes_on"};    // of a cut: there was no room for all of it
    Column<Vec3> point{*this, "point", "m"};      // of the push; centre of the explosion; in the cutting plane
    Column<Vec3> direction{*this,
                           "direction"};  // unit: of the push; normal of the plane; what a polyline is swept along
    Column<float> speed{*this, "speed", "m/s"};                 // approach of a push; of a bare wall under an explosion
    Column<float> inverse_mass{*this, "inverse_mass", "1/kg"};  // of what pushes, effective along `direction`
    Column<float> radius{*this, "radius", "m"};                 // of what pushes; reach of the explosion
    Column<float> strength{*this, "strength", "Pa s"};          // of the explosion at its centre
    // What the body gets as a rigid one, body axes; a break that is on time takes the place of it.
    Column<Vec3d> impulse{*this, "impulse", "N s"};
    Column<Vec3d> turning{*this, "turning", "N m s"};    // about the body's centre of mass
    Column<uint32_t> point_count{*this, "point_count"};  // of the polyline; 0: a plane
    Column<std::array<float, 3 * kMostCutPoints>> points{*this, "points", "m"};
};

/// Row `row` goes, the ones behind it keep their order.
inline void remove_blow(Blows& blows, uint32_t row) {
    const uint32_t behind = blows.size() - row - 1;
    if (behind) blows.copy_rows(blows, row + 1, row, behind);
    blows.truncate(blows.size() - 1);
}
inline bool is_kind(const Blows& blows, uint32_t row, BlowKind kind) {
    return static_cast<BlowKind>(blows.kind[row]) == kind;
}
/// The task's work is a cut: it needs no hidden run.
inline bool is_cut_task(const Blows& blows, Row<Tasks> task) {
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index && is_kind(blows, b, BlowKind::Cut)) return true;
    return false;
}
inline Vec3 cut_point(const Blows& blows, uint32_t row, uint32_t i) {
    const auto& p = blows.points[row];
    return {p[3 * i], p[3 * i + 1], p[3 * i + 2]};
}
inline void set_cut_point(Blows& blows, uint32_t row, uint32_t i, Vec3 place) {
    auto& p = blows.points[row];
    p[3 * i] = place.x, p[3 * i + 1] = place.y, p[3 * i + 2] = place.z;
}

/// What an explosion is to one body, in its frame.
struct Explosion {
    Vec3 centre;         // m
    float radius = 0;    // reach, m
    float strength = 0;  // N s/m2 at the centre
};

}  // namespace cullet
