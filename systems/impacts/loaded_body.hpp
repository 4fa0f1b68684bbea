// A body under loads: the tables that say what it bears.
#pragma once
#include <array>

#include "components/world_rows.hpp"
#include "systems/bodies/held_parts.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

inline constexpr double kNeverSnaps = 1e30;  // Pa

/// What it is made of is asked once a body, not once a load.
class LoadedBody {
 public:
    LoadedBody(const WorldRows& rows, Row<Bodies> of)
        : bodies(rows.bodies), structures(rows.structures), materials(rows.materials), body(of), rows_(rows) {}

    const Bodies& bodies;
    const Structures& structures;
    const Materials& materials;
    Row<Bodies> body;
    bool yields_to_weights = true;  // false: to what the game moves alone

    Row<Structures> structure() const { return bodies.structure[body]; }
    bool bears_loads() const { return calls().bears_loads; }
    /// It is crushed, where what is hollow crumples at its walls.
    bool is_filled() const { return calls().is_filled; }
    /// m: of what is filled its mean thickness.
    double wall() const {
        if (wall_ < 0) wall_ = calls().wall(rows_, body);
        return wall_;
    }
    /// Each of these ways, unit, body axes: all that its surface goes to, from the centre of mass.
    template <size_t N>
    std::array<Reach, N> reach(const Vec3d (&ways)[N]) const {
        std::array<Reach, N> along;
        calls().reach(rows_, body, std::span<const Vec3d>(ways, N), along);
        return along;
    }
    HeldParts held_along(Vec3d axis) const {
        HeldParts held;
        calls().add_held(rows_, body, axis, held);
        return held;
    }
    uint32_t elements_of_run() const { return calls().elements_of_run(rows_, structure()); }
    Row<Materials> material() const { return structures.material[structure()]; }
    bool is_pinned() const { return static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static; }
    /// A body that has cracks bears half, as for blows (kWakeShare).
    double strength_share() const {
        return (structures.has_cracks[structure()] ? 0.5 : 1.0) * double{bodies.strength_scale[body]};
    }
    /// Pa. What yields does not snap: it has no strength.
    double strength() const {
        const double most = materials.tensile_strength[material()];
        return most > 0 ? strength_share() * most : kNeverSnaps;
    }
    double solid_volume() const { return bodies.mass[body] / materials.density[material()]; }

 private:
    const StructureCalls& calls() const { return calls_of(structures, structure()); }

    const WorldRows& rows_;
    mutable double wall_ = -1;  // m; not asked yet
};

}  // namespace cullet
