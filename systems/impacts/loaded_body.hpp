// A body under loads: the tables that say what it bears.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

inline constexpr double kNeverSnaps = 1e30;  // Pa

struct LoadedBody {
    const Bodies& bodies;
    const Structures& structures;
    const Shells& shells;
    const Vertices& vertices;
    const Materials& materials;
    const PinBoxes& pin_boxes;
    Row<Bodies> body;
    bool yields_to_weights = true;  // false: to what the game moves alone

    Row<Structures> structure() const { return bodies.structure[body]; }
    Row<Shells> shell() const { return shell_of(structures, structure()); }
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
};

}  // namespace cullet
