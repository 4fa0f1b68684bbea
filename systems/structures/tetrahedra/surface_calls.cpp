#include "systems/structures/tetrahedra/surface_calls.hpp"

#include <algorithm>

#include "components/blows.hpp"
#include "systems/bodies/explosion.hpp"
#include "systems/structures/tetrahedra/draw_solid.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

constexpr double kPatchOfBall = 0.35;  // of a ball's radius, as on shells
constexpr double kPatchOfCell = 1.2;   // of a cell's edge: a break knows no less

Row<CookedSolids> cooked_of(Read<SolidRows> rows, Row<Structures> structure) {
    return rows.solids.cooked[solid_of(rows.structures, structure)];
}

float patch_radius(Read<SolidRows> rows, Row<Structures> structure, float radius) {
    const double edge = rows.cooked_solids.edge[cooked_of(rows, structure)];
    return static_cast<float>(std::max(kPatchOfCell * edge, kPatchOfBall * double{radius}));
}

Vec3d nearest_of(Vec3d a, Vec3d b, Vec3d c, Vec3d p) {
    // Regions of the triangle's plane, as in Ericson's Real-Time Collision Detection, 5.1.5.
    const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    const double sum = va + vb + vc;
    return sum > 0 ? a + (vb / sum) * ab + (vc / sum) * ac : a;
}

struct SkinTriangle {
    std::array<Vec3d, 3> corners;
};
template <class Visit>
void for_each_triangle(Read<SolidRows> rows, Row<Structures> structure, Visit&& visit) {
    const SkinRange skin = skin_of(rows, structure);
    for (uint32_t t = skin.triangles.first; t < skin.triangles.first + skin.triangles.count; ++t) {
        SkinTriangle triangle;
        for (size_t k = 0; k < 3; ++k)
            triangle.corners[k] = rows.skin_points.place[skin.points.first + rows.skin_triangles.corners[t][k]];
        visit(triangle);
    }
}

struct Nearest {
    Vec3d place, normal;
    double squared = 1e300;
};
Nearest nearest_place(Read<SolidRows> rows, Row<Structures> structure, Vec3 place) {
    Nearest found;
    for_each_triangle(rows, structure, [&](const SkinTriangle& t) {
        const Vec3d at = nearest_of(t.corners[0], t.corners[1], t.corners[2], Vec3d(place));
        const Vec3d away = at - Vec3d(place);
        if (dot(away, away) >= found.squared) return;
        found.squared = dot(away, away);
        found.place = at;
        found.normal = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    });
    return found;
}

// Inward, of the triangle that the place is on, where it is on the contact's side.
Vec3 struck_normal(Read<SolidRows> rows, Row<Structures> structure, Vec3 place, Vec3 normal, float) {
    constexpr float kSameWay = 0.7f;  // cosine of 45 degrees
    const Vec3d outward = nearest_place(rows, structure, place).normal;
    const double size = length(outward);
    if (!(size > 0)) return normal;
    const Vec3 inward = ((-1 / size) * outward).to_float();
    return dot(inward, normal) > kSameWay ? inward : normal;
}

Vec3 nearest_point(Read<SolidRows> rows, Row<Structures> structure, Vec3 place) {
    const Nearest found = nearest_place(rows, structure, place);
    return found.squared < 1e300 ? found.place.to_float() : place;
}

// What faces the centre is lit; what other parts of the body hide is not told apart.
ExplosionSums measure(Read<SolidRows> rows, Row<Structures> structure, const Explosion& explosion, Vec3d about) {
    ExplosionSums sums;
    for_each_triangle(rows, structure, [&](const SkinTriangle& t) {
        const Vec3d middle = (1.0 / 3) * (t.corners[0] + t.corners[1] + t.corners[2]);
        const Vec3d away = middle - Vec3d(explosion.centre);
        const double distance = length(away);
        const Vec3d area = 0.5 * cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        const double size = length(area);
        if (!(distance < double{explosion.radius}) || !(distance > 0) || !(size > 0)) return;
        const double facing = dot(area, away) / (size * distance);
        if (!(facing < 0)) return;
        const double left = 1 - distance / double{explosion.radius};
        const Vec3d impulse = (double{explosion.strength} * left * left * facing) * area;
        const double strength = length(impulse);
        sums.impulse += impulse;
        sums.turning += cross(middle - about, impulse);
        sums.place += strength * middle;
        sums.size += strength;
    });
    const double mass = rows.structures.mass[structure];
    if (sums.size > 0) sums.place = (1 / sums.size) * sums.place;
    if (mass > 0) {
        sums.energy = 0.5 * dot(sums.impulse, sums.impulse) / mass;
        sums.speed = static_cast<float>(length(sums.impulse) / mass);
    }
    return sums;
}

// And why not is told: solids are not cut yet.
template <class... Asked>
bool always(Asked...) {
    return true;
}
// Nothing follows from the drawn mesh, and no edge of it is a crack.
template <class... Asked>
void nothing(Asked...) {}

// Sources are numbers of triangles, which are divided by what a shell's element may have.
uint32_t drawn_parts(Read<SolidRows> rows, Row<Structures> structure) {
    return skin_of(rows, structure).triangles.count;
}

}  // namespace

void add_solid_surface_calls(StructureCalls& calls) {
    calls.patch_radius = call<patch_radius>;
    calls.struck_normal = call<struck_normal>;
    calls.nearest_point = call<nearest_point>;
    calls.measure_explosion = call<measure>;
    calls.is_cut_by = always;
    calls.draw = call<draw_solid_body>;
    calls.remember_drawn = nothing;
    calls.drawn_parts = call<drawn_parts>;
    calls.show_cracks = nothing;
}

}  // namespace cullet
