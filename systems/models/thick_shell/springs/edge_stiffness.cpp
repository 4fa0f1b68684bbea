#include "systems/models/thick_shell/springs/edge_stiffness.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/spring_lists.hpp"

namespace cullet {
namespace {

/// Areas at rest of the one or two elements at an edge, on the outer and the inner skin.
struct EdgeAreas {
    double outer = 0, inner = 0;
};

/// Area of a triangle by its sides (Heron): 0 where they do not close.
double area_of(double a, double b, double c) {
    const double product = (a + b + c) * (b + c - a) * (c + a - b) * (a + b - c);
    return product > 0 ? 0.25 * std::sqrt(product) : 0;
}

/// By the lengths at rest of the element's own springs: of a shell whose rest shape is the one that it has now. False:
/// some spring is not made yet.
bool add_kept_areas(const SpringView& view, uint32_t element, EdgeAreas& sum) {
    const auto& spring = view.state.element_springs.spring[view.edges(element)];
    double outer[3], inner[3] = {};
    for (int k = 0; k < 3; ++k) {
        if (spring[k] == kNone || !(view.state.springs.rest_length[view.spring(spring[k])] > 0)) return false;
        outer[k] = view.state.springs.rest_length[view.spring(spring[k])];
        if (view.has_layers()) inner[k] = view.state.layer_springs.inner_length[view.layer(spring[k])];
    }
    sum.outer += area_of(outer[0], outer[1], outer[2]);
    sum.inner += area_of(inner[0], inner[1], inner[2]);
    return true;
}

EdgeAreas areas_at(const SpringView& view, uint32_t element, uint32_t edge) {
    const ShellView& shell = view.shell;
    const Elements& elements = view.state.elements;
    EdgeAreas sum;
    for (const uint32_t e : {element, elements.neighbour[shell.element(element)][edge]}) {
        if (e == kNone || (elements.flags[shell.element(e)] & kDead)) continue;
        if ((view.own().keeps_lengths[view.row] & kKeepsLengths) && add_kept_areas(view, e, sum)) continue;
        const auto& corner = elements.corner[shell.element(e)];
        const auto area = [&](auto rest) {
            const auto first = rest(view, corner[0]);
            return 0.5 * length(cross(rest(view, corner[1]) - first, rest(view, corner[2]) - first));
        };
        sum.outer += area(outer_rest<ShellRows&>);
        if (view.has_layers()) sum.inner += area(inner_rest<ShellRows&>);
    }
    return sum;
}

/// Edge of `element` that spring s runs along, by its ends.
uint32_t edge_of(const SpringView& view, uint32_t s) {
    const Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s);
    const auto& corner = view.state.elements.corner[view.shell.element(springs.element[row])];
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t from = corner[k], to = corner[(k + 1) % 3];
        if ((from == springs.a[row] && to == springs.b[row]) || (from == springs.b[row] && to == springs.a[row]))
            return k;
    }
    return kNone;
}

float damping_of(const SpringView& view, double stiffness, uint32_t a, uint32_t b, double share) {
    const Vertices& vertices = view.state.vertices;
    const double ma = share * vertices.mass[view.shell.vertex(a)], mb = share * vertices.mass[view.shell.vertex(b)];
    const double reduced = ma + mb > 0 ? ma * mb / (ma + mb) : 0;
    return static_cast<float>(2 * double{view.own().damping_ratio[view.row]} * std::sqrt(stiffness * reduced));
}

struct EdgeMaterial {
    double young, shear;
};
EdgeMaterial material_of(const SpringView& view) {
    const double e = view.own().young_modulus[view.row];
    const double nu = view.state.materials.poisson_ratio[view.shell.structures().material[view.shell.structure]];
    return {e, e / (2 * (1 + nu))};
}

}  // namespace

// Sandwich: skins at +-gamma h / 2 that carry all of E h would bend 3 gamma^2 times too stiffly; so they carry 1 / (3
// gamma^2) of it, and the mid springs, which do not bend, the rest. The shear pair has the transverse shear rigidity of
// the true thickness, k = (5/6) G h w L^2 / (4 H^2 l), but no more than the edge: a slender shell does not see the
// difference, and the step would (B5). All damping is in the skins, at the stiffness that the edge has as a whole.
void measure_spring(const SpringView& view, uint32_t s, bool is_new) {
    Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s), a = springs.a[row], b = springs.b[row];
    const uint32_t edge = edge_of(view, s);
    CULLET_ASSERT(edge < 3, "spring %u is no edge of its element", s);
    const EdgeAreas areas = areas_at(view, springs.element[row], edge);
    const double h = 0.5 * (stiff_depth(view, a) + stiff_depth(view, b));
    const EdgeMaterial material = material_of(view);
    const Vec3d oa = outer_rest(view, a), ob = outer_rest(view, b);
    if (is_new) springs.plastic_length[row] = springs.rest_length[row] = static_cast<float>(length(ob - oa));
    const auto rule = [&](double depth, double area, double rest) {
        return rest > 0 ? material.young * depth * area / (rest * rest) : 0;
    };
    const double l = springs.rest_length[row];
    if (!view.has_layers()) {
        springs.stiffness[row] = static_cast<float>(rule(h, areas.outer, l));
        springs.damping[row] = damping_of(view, springs.stiffness[row], a, b, 1);
        return;
    }
    LayerSprings& layers = view.state.layer_springs;
    const uint32_t layer = view.layer(s);
    const Vec3d ia = inner_rest(view, a), ib = inner_rest(view, b);
    if (is_new) {
        layers.inner_plastic[layer] = layers.inner_length[layer] = static_cast<float>(length(ib - ia));
        layers.mid_length[layer] = static_cast<float>(0.5 * length((ob + ib) - (oa + ia)));
        layers.cross_length[layer] = {static_cast<float>(length(ib - oa)), static_cast<float>(length(ob - ia))};
    }
    const double outer = rule(0.5 * h, areas.outer, l), inner = rule(0.5 * h, areas.inner, layers.inner_length[layer]);
    const double gamma = view.own().length_factor[view.row];
    const double skin = view.layout() == SpringLayout::Sandwich ? std::min(1.0, 1 / (3 * gamma * gamma)) : 1;
    springs.stiffness[row] = static_cast<float>(skin * outer);
    springs.damping[row] = damping_of(view, outer, a, b, 0.5);
    layers.inner_stiffness[layer] = static_cast<float>(skin * inner);
    layers.inner_damping[layer] = damping_of(view, inner, a, b, 0.5);
    layers.mid_stiffness[layer] = 0;
    if (view.layout() == SpringLayout::Crossed) {
        // The paper gives cross springs no value: as stiff as the skins are on average, which keeps the prism square.
        layers.cross_stiffness[layer] = static_cast<float>(0.5 * (outer + inner));
        return;
    }
    layers.mid_stiffness[layer] = static_cast<float>((1 - skin) * (outer + inner));
    const double height = gamma * h, diagonal = 0.5 * (layers.cross_length[layer][0] + layers.cross_length[layer][1]);
    const double width = l > 0 ? 2.0 / 3 * areas.outer / l : 0;
    const double shear =
        l > 0 ? 5.0 / 6 * material.shear * h * width * diagonal * diagonal / (4 * height * height * l) : 0;
    const double most = view.own().keeps_lengths[view.row] & kIsSlender ? 0.5 * skin : 1;
    layers.cross_stiffness[layer] = static_cast<float>(std::min(shear, most * (outer + inner)));
}

void measure_twin(const SpringView& view, uint32_t v, bool is_new) {
    VertexSprings list;
    collect_springs(view, v, list);
    measure_twin(view, v, list, is_new);
}

void measure_twin(const SpringView& view, uint32_t v, const VertexSprings& list, bool is_new) {
    Twins& twins = view.state.twins;
    const uint32_t row = view.twin(v);
    Ring ring;
    walk_ring(view.shell, v, ring);
    const double young = view.own().young_modulus[view.row], reach = length(inner_rest(view, v) - outer_rest(view, v));
    double area = 0, skin = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto [a, b, c] = view.state.elements.corner[view.shell.element(ring.element[i])];
        const Vec3d pa = outer_rest(view, a);
        area += length(cross(outer_rest(view, b) - pa, outer_rest(view, c) - pa)) / 6;  // a third of the triangle
    }
    // Of its own springs alone: a cut beside it changes others of its triangles.
    for (uint32_t i = 0; i < list.count; ++i) skin += view.state.springs.stiffness[view.spring(list.spring[i])];
    if (is_new) twins.inverse_rest[row] = reach > 0 ? static_cast<float>(1 / reach) : 0;
    const double rest = twins.inverse_rest[row] > 0 ? 1 / double{twins.inverse_rest[row]} : 0;
    double k = rest > 0 ? young * area / rest : 0;
    if (list.count > 0) k = std::min(k, 10 * skin / list.count);
    const double share = twins.mass_share[row], dt = view.own().time_step[view.row];
    const double c = 2 * double{view.own().damping_ratio[view.row]} * std::sqrt(k * share / 2);
    twins.stiffness_rest[row] = static_cast<float>(k * rest);
    twins.damping[row] = dt > 0 ? static_cast<float>(c / dt) : 0;
}

void weigh_points(const SpringView& view, uint32_t v) {
    weigh_vertex(view.shell, v);
    if (!view.has_layers()) return;
    const uint32_t row = view.shell.vertex(v), twin = view.twin(v);
    const double share = 0.5 * view.state.vertices.mass[row];
    view.state.twins.mass_share[twin] = static_cast<float>(share);
    view.state.twins.inverse_mass[twin] =
        view.state.vertices.inverse_mass[row] > 0 && share > 0 ? static_cast<float>(1 / share) : 0.0f;
}

}  // namespace cullet
