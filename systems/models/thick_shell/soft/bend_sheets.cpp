// Sheets bend: where the material gives its own bending stiffness D (cloth), the hinges that one layer of springs
// lacks. Hinge of edge (a, b) with opposite corners c and d, k_h = D L^2 / (A1 + A2) (thick shell note B3), in a form
// that holds for any turn of the sheet and any fold (Bergou et al. 2006). With the cotangents of the four angles at the
// edge as they are at rest, K = (cot b1 + cot b2, cot a1 + cot a2, -cot a1 - cot b1, -cot a2 - cot b2),
//     E = D |K x|^2 / (2 (A1 + A2)),  F_i = -D K_i (K x) / (A1 + A2).
// K sums to 0 and each F_i lies along K x: momentum and angular momentum are exact. |K x| = 2 L sin(theta / 2), and at
// rest, flat, it is 0: a sheet that was modelled in folds opens. Lattices of equilateral triangles bend by D in any
// direction, with a Poisson ratio of -1/3. Without damping: air and the springs have theirs.
#include <algorithm>
#include <cmath>

#include "systems/models/thick_shell/soft/sheet_energy.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {
namespace {

// Bending is far slower than stretching, so a hinge pushes once in some substeps: in a tenth of l^2 sqrt(rho h / D),
// half over the fastest frequency of an even lattice. Twice as long and folds of one edge ring.
constexpr double kPeriodShare = 0.1;
constexpr uint32_t kMostSubstepsABend = 256;
// Most of k sum K_i^2 / m_i dt^2 of one hinge: small triangles and light corners beside a cut are bent softer.
constexpr double kMostSlope = 0.05;

/// What holds two triangles flat.
struct Hinge {
    uint32_t row[4];  // of Vertices
    double weight[4], inverse_mass[4];
    double stiffness;  // D / (A1 + A2), less where it would be too stiff for the step
    Vec3d sum;         // K x
};

struct Sheet {
    const BentView& view;
    double bending, dt;

    float rest_length(uint32_t element, size_t k) const {
        const uint32_t spring = view.state.element_springs.spring[view.edges(element)][k];
        return spring < view.spring_count() ? view.state.springs.rest_length[view.spring(spring)] : 0;
    }

    /// Area, and the cotangents of the angles at the ends of edge k, at rest.
    struct Half {
        double area = 0, cot_start = 0, cot_end = 0;
    };
    Half half_of(uint32_t element, size_t k) const {
        const double base = rest_length(element, k), ahead = rest_length(element, (k + 1) % 3),
                     back = rest_length(element, (k + 2) % 3);
        const double bb = base * base, aa = ahead * ahead, cc = back * back;
        const double sixteen = 4 * aa * cc - (aa + cc - bb) * (aa + cc - bb);  // 16 A^2, Heron
        Half half;
        if (!(sixteen > 0)) return half;
        const double four = std::sqrt(sixteen);
        half.area = 0.25 * four;
        half.cot_start = (bb + cc - aa) / four;
        half.cot_end = (bb + aa - cc) / four;
        return half;
    }

    /// False: a triangle of no area, or nothing of it is free.
    bool find(uint32_t element, size_t k, uint32_t across, Hinge& out) const {
        const BentTables& s = view.state;
        const auto& corner = s.elements.corner[view.shell.element(element)];
        const auto& other = s.elements.corner[view.shell.element(across)];
        const uint32_t a = corner[k], b = corner[(k + 1) % 3];
        size_t j = 0;
        while (j < 3 && !(other[j] == b && other[(j + 1) % 3] == a)) ++j;
        if (j == 3) return false;
        const Half one = half_of(element, k), two = half_of(across, j);
        if (!(one.area > 0 && two.area > 0)) return false;
        const uint32_t vertex[4] = {a, b, corner[(k + 2) % 3], other[(j + 2) % 3]};
        const double weight[4] = {one.cot_end + two.cot_start, one.cot_start + two.cot_end,
                                  -one.cot_start - one.cot_end, -two.cot_start - two.cot_end};
        double slope = 0;
        out.sum = {};
        for (size_t i = 0; i < 4; ++i) {
            out.row[i] = view.shell.vertex(vertex[i]);
            out.weight[i] = weight[i];
            out.inverse_mass[i] = s.vertices.inverse_mass[out.row[i]];
            out.sum += weight[i] * Vec3d(view.position(vertex[i]));
            slope += weight[i] * weight[i] * out.inverse_mass[i];
        }
        if (!(slope > 0)) return false;
        out.stiffness = std::min(bending / (one.area + two.area), kMostSlope / (dt * dt * slope));
        return true;
    }

    void push(const Hinge& hinge) const {
        for (size_t i = 0; i < 4; ++i) {
            const double size = -(dt * hinge.stiffness) * hinge.weight[i] * hinge.inverse_mass[i];
            auto& velocity = view.state.vertices.velocity;
            velocity.set(hinge.row[i], velocity[hinge.row[i]] + (size * hinge.sum).to_float());
        }
    }

    template <class F>
    void for_each_hinge(F&& visit) const {
        for (uint32_t e = 0; e < view.shell.element_count(); ++e) {
            const uint32_t row = view.shell.element(e);
            if (view.state.elements.flags[row] & kDead) continue;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t across = view.state.elements.neighbour[row][k];
                Hinge hinge;
                if (across != kNone && across > e && find(e, k, across, hinge)) visit(hinge);
            }
        }
    }
};

/// A power of two times the substeps between two looks.
uint32_t substeps_a_bend(const BentView& view, double bending) {
    const Shells& shells = view.shell.shells();
    const uint32_t row = view.shell.row;
    const double sheet_mass =
        view.state.materials.density[view.state.structures.material[view.shell.structure]] * shells.thickness[row];
    const double edge = shells.mean_edge[row], step = view.own().time_step[view.row];
    const double most = kPeriodShare * edge * edge * std::sqrt(sheet_mass / bending) / step;
    uint32_t substeps = kSubstepsAFlow;
    while (2 * substeps <= kMostSubstepsABend && 2 * substeps <= most) substeps *= 2;
    return substeps;
}

double bending_of(const BentView& view) {
    const MaterialTraits& traits = view.state.material_traits;
    const uint32_t material = view.state.structures.material[view.shell.structure];
    return material < traits.size() ? traits.bending_stiffness[material] : 0;
}

Sheet sheet_of(const BentView& view, double bending, uint32_t substeps) {
    return {view, bending, double{view.own().time_step[view.row]} * substeps};
}

}  // namespace

void bend_sheets(Of<ShellSprings> springs, BentTables rows) {
    const BentView view(rows, springs.row);
    const double bending = bending_of(view);
    if (!(bending > 0)) return;
    const uint32_t substeps = substeps_a_bend(view, bending);
    if (view.own().steps[view.row] % substeps != 0) return;
    const Sheet sheet = sheet_of(view, bending, substeps);
    sheet.for_each_hinge([&](const Hinge& hinge) { sheet.push(hinge); });
}

double sheet_energy(const BentView& view) {
    const double bending = bending_of(view);
    double sum = 0;
    if (!(bending > 0) || view.has_layers()) return sum;
    const Sheet sheet = sheet_of(view, bending, substeps_a_bend(view, bending));
    sheet.for_each_hinge([&](const Hinge& hinge) { sum += 0.5 * hinge.stiffness * dot(hinge.sum, hinge.sum); });
    return sum;
}

}  // namespace cullet
