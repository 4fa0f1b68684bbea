#include "systems/structures/tetrahedra/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "components/materials.hpp"
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"

namespace cullet {

namespace {

constexpr uint32_t kMostPointsAtBirth = 1000;  // pieces are cut already: rows are copied, which is quick

}  // namespace

SkinRange skin_of(Read<SolidRows> rows, Row<Structures> structure) {
    const Row<Solids> solid = solid_of(rows.structures, structure);
    if (!rows.solids.is_whole[solid]) return {rows.solids.points[solid], rows.solids.triangles[solid]};
    const Row<CookedSolids> cooked = rows.solids.cooked[solid];
    return {rows.cooked_solids.points[cooked], rows.cooked_solids.triangles[cooked]};
}

void measure_solid(SolidRows rows, Row<Structures> structure) {
    const SkinRange skin = skin_of(rows, structure);
    const auto place = [&](uint32_t p) -> Vec3d { return rows.skin_points.place[skin.points.first + p]; };
    // About a point of it: far from the origin the sums would lose digits.
    const Vec3d origin = skin.points.count > 0 ? place(0) : Vec3d();
    VolumeSums sums;
    double area = 0;
    for (uint32_t t = skin.triangles.first; t < skin.triangles.first + skin.triangles.count; ++t) {
        const auto& c = rows.skin_triangles.corners[t];
        const Vec3d corners[] = {place(c[0]) - origin, place(c[1]) - origin, place(c[2]) - origin};
        add_fan(corners, Vec3d(), 1, sums);
        area += 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    }
    Structures& structures = rows.structures;
    const double density = double{rows.materials.density[structures.material[structure]]};
    const double volume = std::max(sums.volume, 1e-30);
    const Vec3d centre = (1 / volume) * sums.first;
    const Sym3d& m = sums.second;
    const double xx = m.xx - volume * centre.x * centre.x, yy = m.yy - volume * centre.y * centre.y,
                 zz = m.zz - volume * centre.z * centre.z;
    Sym3d inertia;
    inertia.xx = density * (yy + zz), inertia.yy = density * (xx + zz), inertia.zz = density * (xx + yy);
    inertia.xy = -density * (m.xy - volume * centre.x * centre.y);
    inertia.xz = -density * (m.xz - volume * centre.x * centre.z);
    inertia.yz = -density * (m.yz - volume * centre.y * centre.z);
    structures.mass[structure] = density * volume;
    structures.centre.set(structure, centre + origin);
    structures.inertia[structure] = inertia;
    structures.area[structure] = static_cast<float>(area);
    rows.solids.volume[solid_of(structures, structure)] = volume;
}

float radius_of_solid(Read<SolidRows> rows, Row<Structures> structure) {
    const SkinRange skin = skin_of(rows, structure);
    const Vec3d centre = rows.structures.centre[structure];
    double most = 0;
    for (uint32_t p = skin.points.first; p < skin.points.first + skin.points.count; ++p) {
        const Vec3d away = Vec3d(rows.skin_points.place[p]) - centre;
        most = std::max(most, dot(away, away));
    }
    return static_cast<float>(std::sqrt(most)) * 1.000001f;
}

std::array<float, 2> inside_uv(Vec3d place, Vec3d normal, Vec3d low, Vec3d high) {
    const Vec3d helper = std::fabs(normal.y) < 0.8 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
    const Vec3d along = normalised(cross(helper, normal)), up = cross(normalised(normal), along);
    const Vec3d from = place - 0.5 * (low + high);
    const double reach = length(high - low);
    return {static_cast<float>(dot(from, along) + reach), static_cast<float>(dot(from, up) + reach)};
}

uint32_t points_at_birth(Read<SolidRows> rows, Row<Structures> structure) {
    // A working copy has no skin before its run is done.
    const Row<CookedSolids> cooked = rows.solids.cooked[solid_of(rows.structures, structure)];
    return std::min(kMostPointsAtBirth, rows.cooked_solids.points[cooked].count);
}

Result<void> check_skin(Read<SolidRows> rows, Row<Structures> structure) {
    const SkinRange skin = skin_of(rows, structure);
    std::map<std::array<uint32_t, 2>, int> balance;
    for (uint32_t t = skin.triangles.first; t < skin.triangles.first + skin.triangles.count; ++t) {
        const auto& c = rows.skin_triangles.corners[t];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = c[k], b = c[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : balance)
        if (sum != 0)
            return Error{"the skin is open between points " + std::to_string(edge[0]) + " and " +
                         std::to_string(edge[1])};
    return {};
}

}  // namespace cullet
