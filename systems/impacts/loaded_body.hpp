// A body under loads: the tables that say what it bears.
#pragma once
#include "components/body_rows.hpp"
#include "components/solid_rows.hpp"

namespace cullet {

inline constexpr double kNeverSnaps = 1e30;  // Pa

/// Where the surface of a solid is.
struct SolidTables {
    const Solids& solids;
    const CookedSolids& cooked;
    const SkinPoints& points;
};

struct LoadedBody {
    const Bodies& bodies;
    const Structures& structures;
    const Shells& shells;
    const Vertices& vertices;
    const Materials& materials;
    const PinBoxes& pin_boxes;
    const SolidTables& solid;
    Row<Bodies> body;
    bool yields_to_weights = true;  // false: to what the game moves alone

    Row<Structures> structure() const { return bodies.structure[body]; }
    bool is_solid() const { return !is_shell(structures, structure()); }
    Row<Shells> shell() const { return shell_of(structures, structure()); }
    /// m: of a solid its mean thickness.
    double wall() const {
        if (!is_solid()) return double{shells.thickness[shell()]};
        return 2 * solid_volume() / std::max(double{structures.area[structure()]}, 1e-30);
    }
    /// All that its surface reaches to, from the centre of mass, body axes.
    template <class Use>
    void for_each_corner(Use&& use) const {
        const Vec3d centre = bodies.centre[body];
        if (is_solid()) {
            const Row<Solids> row = solid_of(structures, structure());
            const Range points =
                solid.solids.is_whole[row] ? solid.cooked.points[solid.solids.cooked[row]] : solid.solids.points[row];
            for (uint32_t p = points.first; p < points.first + points.count; ++p)
                use(Vec3d(solid.points.place[p]) - centre);
            return;
        }
        const Range rows = shells.vertices[shell()];
        for (uint32_t v = rows.first; v < rows.first + rows.count; ++v) {
            if (vertices.element[v] == kNone) continue;
            const Vec3d outer = Vec3d(vertices.rest[v]) - centre;
            use(outer);
            use(outer + double{vertices.depth[v]} * Vec3d(vertices.inward[v]));
        }
    }
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
