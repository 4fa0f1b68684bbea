#include "systems/structures/shell/mass_properties.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

// Of the largest tetrahedron: a smaller one below 0 is one of no volume (a corner without depth).
constexpr double kRounding = 1e-6;

bool is_live(const ShellView& shell, uint32_t element) {
    return (shell.state.elements.flags[shell.element(element)] & kDead) == 0;
}

// Volumes above 0 alone make a second moment that some body has. Those of a prism that a soft body's motion has turned
// inside out are not: its inertia would come out with a sign below 0, which the rigid solver answers with energy from
// nowhere. Such an element weighs on its outer triangle, as one without volume does, and as a ball of its depth about
// it, so that one whose corners lie on a line has an inertia too.
Moments moments_in(const ShellView& shell, uint32_t element, const Prism& prism) {
    const uint32_t row = shell.element(element);
    Moments sum;
    double least = 0, most = 0;
    for_each_tetrahedron(prism, [&](Vec3d p, Vec3d q, Vec3d r, Vec3d s, double volume) {
        least = volume < least ? volume : least;
        most = volume > most ? volume : most;
        const Vec3d total = p + q + r + s;
        sum.mass += volume;
        sum.first += volume / 4 * total;
        sum.second = sum.second + volume / 20 * (outer(p) + outer(q) + outer(r) + outer(s) + outer(total));
    });
    const double mass = shell.state.elements.mass[row];
    const double density = shell.state.materials.density[shell.structures().material[shell.structure]];
    // Mass has a floor of depth (build_shell); below a tenth of it the tetrahedra say nothing about where it lies.
    const bool is_turned = least < -kRounding * most;
    if (!is_turned && sum.mass * density > 0.1 * mass) {
        const double scale = mass / sum.mass;
        return {mass, scale * sum.first, scale * sum.second};
    }
    const Vec3d total = prism.outer[0] + prism.outer[1] + prism.outer[2];
    const Sym3d squares = outer(prism.outer[0]) + outer(prism.outer[1]) + outer(prism.outer[2]);
    Moments flat{mass, mass / 3 * total, mass / 12 * (squares + outer(total))};
    if (!is_turned) return flat;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
        const Vec3d through = prism.inner[k] - prism.outer[k];
        square += dot(through, through) / 3;
    }
    flat.second = flat.second + mass / 12 * square * Sym3d{1, 1, 1, 0, 0, 0};
    return flat;
}

}  // namespace

Moments element_moments(const ShellView& shell, uint32_t element) {
    return moments_in(shell, element, load_prism(shell, element));
}

Moments shell_moments(const ShellView& shell) {
    Moments sum;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (is_live(shell, e)) sum = sum + element_moments(shell, e);
    return sum;
}

MassProperties mass_properties(const Moments& moments) {
    if (!(moments.mass > 0)) return {};
    const Vec3d centre = (1.0 / moments.mass) * moments.first;
    return {moments.mass, centre, inertia_of(moments.second - moments.mass * outer(centre))};
}

Moments moments_of(const MassProperties& p) {
    // I = tr(C) 1 - C gives tr(C) = tr(I) / 2.
    const double half = trace(p.inertia) / 2;
    const Sym3d about_centre{half - p.inertia.xx, half - p.inertia.yy, half - p.inertia.zz,
                             -p.inertia.xy,       -p.inertia.xz,       -p.inertia.yz};
    return {p.mass, p.mass * p.centre, about_centre + p.mass * outer(p.centre)};
}

ShellSums element_sums(const ShellView& shell, uint32_t element) {
    const Prism prism = load_prism(shell, element);
    ShellSums sums{moments_in(shell, element, prism), prism_area(prism), 0};
    double depth = 0;
    for (uint32_t v : shell.state.elements.corner[shell.element(element)])
        depth += static_cast<double>(shell.state.vertices.depth[shell.vertex(v)]);
    sums.depth_area = sums.area * depth / 3;
    return sums;
}

ShellSums sums_of(const ShellView& shell) {
    const Structures& s = shell.structures();
    const Row<Structures> row = shell.structure;
    const double area = s.area[row];
    return {moments_of({s.mass[row], s.centre[row], s.inertia[row]}), area, area * shell.shells().thickness[shell.row]};
}

void write_sums(ShellView shell, const ShellSums& sums) {
    const MassProperties properties = mass_properties(sums.moments);
    Structures& s = shell.structures();
    s.mass[shell.structure] = properties.mass;
    s.centre.set(shell.structure, properties.centre);
    s.inertia.set(shell.structure, properties.inertia);
    s.area[shell.structure] = static_cast<float>(sums.area);
    shell.shells().thickness[shell.row] = sums.area > 0 ? static_cast<float>(sums.depth_area / sums.area) : 0.0f;
}

void measure_shell(ShellView shell) {
    ShellSums sums;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (is_live(shell, e)) sums = sums + element_sums(shell, e);
    write_sums(shell, sums);
}

float radius_of(const ShellView& shell) {
    const Vec3 centre = shell.structures().centre[shell.structure].to_float();
    const Vertices& vertices = shell.state.vertices;
    const Range& range = shell.vertices();
    float most = 0;
    for (uint32_t v = range.first; v < range.first + range.count; ++v) {
        if (vertices.element[v] == kNone) continue;
        const Vec3 arm = vertices.rest[v] - centre;
        most = std::max(most, dot(arm, arm));
    }
    return std::sqrt(most);
}

void sum_vertex_masses(ShellView shell) {
    Vertices& vertices = shell.state.vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) vertices.mass[shell.vertex(v)] = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (!is_live(shell, e)) continue;
        const uint32_t row = shell.element(e);
        for (uint32_t v : shell.state.elements.corner[row])
            vertices.mass[shell.vertex(v)] += shell.state.elements.mass[row] / 3;
    }
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const bool moves = vertices.element[row] != kNone && !vertices.is_pinned[row] && vertices.mass[row] > 0;
        vertices.inverse_mass[row] = moves ? static_cast<float>(1.0 / vertices.mass[row]) : 0.0f;
    }
}

}  // namespace cullet
