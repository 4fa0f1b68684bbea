#include "systems/models/lattice/solve/inertia.hpp"

namespace cullet {
namespace {

void add_at(std::span<double> loads, uint32_t rank, Vec3d force) {
    loads[size_t{rank} * 3] += force.x;
    loads[size_t{rank} * 3 + 1] += force.y;
    loads[size_t{rank} * 3 + 2] += force.z;
}

template <class Use>
void for_each_part(const SolidElements& solid, std::span<const uint32_t> cells, Use use) {
    for (const uint32_t cell : cells)
        for (uint32_t p = solid.first_part[cell]; p < solid.first_part[cell + 1]; ++p)
            if (volume_of(solid.parts[p].moments) > 0) use(solid.parts[p]);
}

}  // namespace

PieceMass mass_of(const SolidElements& solid, std::span<const uint32_t> cells, double density) {
    PieceMass piece;
    Vec3d sum;
    for_each_part(solid, cells, [&](const SolidPart& part) {
        const double m = density * volume_of(part.moments);
        piece.mass += m;
        sum += m * centroid_of(part.moments, solid, solid.elements[part.element]);
    });
    if (!(piece.mass > 0)) return piece;
    piece.centre = 1 / piece.mass * sum;
    Sym3d second;
    for_each_part(solid, cells, [&](const SolidPart& part) {
        const Vec3d from = centroid_of(part.moments, solid, solid.elements[part.element]) - piece.centre;
        second = second + density * volume_of(part.moments) * outer(from);
    });
    piece.inertia = inertia_of(second);
    return piece;
}

void add_force(const SolidElements& solid, const ElementPlace& at, Vec3d force, std::span<double> loads) {
    const std::array<double, 10> shape = shapes_at(at.at);
    const SolidElement& element = solid.elements[at.element];
    for (uint32_t n = 0; n < 10; ++n) add_at(loads, solid.plan.rank[element.node[n]], shape[n] * force);
}

TotalLoad total_of(const SolidElements& solid, std::span<const double> loads, Vec3d centre) {
    TotalLoad total;
    for (uint32_t n = 0; n < solid.places.size(); ++n) {
        const double* f = loads.data() + size_t{solid.plan.rank[n]} * 3;
        const Vec3d force{f[0], f[1], f[2]};
        total.force += force;
        total.torque += cross(solid.places[n] - centre, force);
    }
    return total;
}

void relieve(const SolidElements& solid, std::span<const uint32_t> cells, double density, const PieceMass& mass,
             Vec3d spin, std::span<double> loads) {
    const TotalLoad total = total_of(solid, loads, mass.centre);
    const Vec3d along = 1 / mass.mass * total.force;
    const Vec3d turn = inverse(mass.inertia) * (total.torque - cross(spin, mass.inertia * spin));
    for_each_part(solid, cells, [&](const SolidPart& part) {
        const SolidElement& element = solid.elements[part.element];
        const Vec3d from = centroid_of(part.moments, solid, element) - mass.centre;
        const Vec3d push = -density * (along + cross(turn, from) + cross(spin, cross(spin, from)));
        const std::array<double, 10> share = shape_integrals(part.moments);
        for (uint32_t n = 0; n < 10; ++n) add_at(loads, solid.plan.rank[element.node[n]], share[n] * push);
    });
}

}  // namespace cullet
