#include "systems/structures/tetrahedra/cook/grid_points.hpp"

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"

namespace cullet {
namespace {

constexpr double kLargest = 0x1p21 - 16;
constexpr uint64_t kSeed = 0x9e17;

GridPoint shift_of(uint32_t number, uint32_t times, int32_t reach) {
    const uint64_t bits = Random{kSeed + static_cast<uint64_t>(reach)}.bits(number, times);
    const auto units = static_cast<uint64_t>(2 * reach + 1);
    const auto one = [&](uint32_t k) { return static_cast<double>((bits >> (20 * k)) % units) - reach; };
    return {one(0), one(1), one(2)};
}

List<GridPoint> on_grid(std::span<const Vec3d> places, Vec3d centre, double scale, int32_t reach) {
    List<GridPoint> points(places.size());
    for (uint32_t v = 0; v < places.size(); ++v) {
        const Vec3d p = scale * (places[v] - centre);
        const GridPoint s = shift_of(v, 0, reach);
        points[v] = {std::floor(p.x + 0.5) + s.x, std::floor(p.y + 0.5) + s.y, std::floor(p.z + 0.5) + s.z};
    }
    return points;
}

}  // namespace

GridPoints::GridPoints(std::span<const Vec3d> mesh_places, std::span<const Vec3d> lattice_places, Vec3d centre) {
    double largest = 0;
    for (const std::span<const Vec3d> places : {mesh_places, lattice_places})
        for (const Vec3d& p : places)
            largest =
                std::max({largest, std::fabs(p.x - centre.x), std::fabs(p.y - centre.y), std::fabs(p.z - centre.z)});
    int exponent = 0;
    std::frexp(kLargest / largest, &exponent);
    const double scale = std::ldexp(1, exponent - 1);
    mesh = on_grid(mesh_places, centre, scale, kMeshShift);
    lattice = on_grid(lattice_places, centre, scale, kLatticeShift);
    mesh_shifts_.assign(mesh.size(), 1);
    lattice_shifts_.assign(lattice.size(), 1);
}

void GridPoints::shift(GridPoint& point, uint32_t before, uint32_t number, int32_t reach) {
    const GridPoint old = shift_of(number, before - 1, reach), now = shift_of(number, before, reach);
    point = {point.x - old.x + now.x, point.y - old.y + now.y, point.z - old.z + now.z};
}

}  // namespace cullet
