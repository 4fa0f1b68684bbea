#include "systems/structures/shell/insert_vertex.hpp"

#include <algorithm>

#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/mesh_quality.hpp"

namespace cullet {
namespace {

bool is_well_shaped(Vec3 a, Vec3 b, Vec3 c, float mean_area, float share) {
    const float twice_area = length(cross(b - a, c - a));
    const float longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    return twice_area > share * kLeastShape * longest && 0.5f * twice_area >= share * kLeastArea * mean_area;
}

// Opposite corners gain an element each.
bool has_place_in_ring(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    return !ring.is_cut_short && ring.count < kMostRing;
}

float mix(float p, float q, float tau) {
    return p + tau * (q - p);
}
Vec3 mix(Vec3 p, Vec3 q, float tau) {
    return p + tau * (q - p);
}

// When the ban at this end is over; ready_time of a vertex with a crack is its tip's.
float end_of_ban(const Vertices& v, uint32_t row) {
    return v.is_start_banned[row] && v.crack[row] == static_cast<uint8_t>(CrackState::None) ? v.ready_time[row] : 0.0f;
}

// Row w between rows p and q. What has no meaning between them is taken from p.
void interpolate_vertex(Vertices& v, uint32_t p, uint32_t q, uint32_t w, float tau) {
    v.copy_rows(v, p, w, 1);
    v.rest.set(w, mix(v.rest[p], v.rest[q], tau));
    const Vec3 to_inner = mix(v.depth[p] * v.inward[p], v.depth[q] * v.inward[q], tau);
    const Vec3 inward = normalised(mix(v.inward[p], v.inward[q], tau));
    const float depth = length(to_inner);
    v.depth[w] = depth;
    v.inward.set(w, depth > 0 ? normalised(to_inner) : inward);
    v.crack_shift.set(w, mix(v.crack_shift[p], v.crack_shift[q], tau));
    v.is_pinned[w] = v.is_pinned[p] && v.is_pinned[q];
    v.strength_factor[w] = mix(v.strength_factor[p], v.strength_factor[q], tau);
    v.stiffness_scale[w] = mix(v.stiffness_scale[p], v.stiffness_scale[q], tau);
    v.ready_time[w] = std::max(end_of_ban(v, p), end_of_ban(v, q));
    v.crack[w] = static_cast<uint8_t>(CrackState::None);
    v.heading.set(w, {});
    v.crack_start[w] = kNone;
    v.is_start_banned[w] = v.is_start_banned[p] || v.is_start_banned[q];
    v.displacement.set(w, mix(v.displacement[p], v.displacement[q], tau));
    v.crush[w] = mix(v.crush[p], v.crush[q], tau);
    v.velocity.set(w, mix(v.velocity[p], v.velocity[q], tau));
    for (int side = 0; side < 2; ++side) {
        const Float4 a = v.probe.data(side)[p], b = v.probe.data(side)[q];
        v.probe.data(side)[w] = {mix(a.x, b.x, tau), mix(a.y, b.y, tau), mix(a.z, b.z, tau), 0};
    }
}

// Writes corner k of `row` between corners k and k + 1 of row `from`.
void interpolate_corner(Elements& elements, uint32_t from, uint32_t from_corner, uint32_t row, uint32_t k, float tau) {
    const uint32_t p = from_corner, q = (from_corner + 1) % 3;
    const auto normal = elements.normal[from];
    const auto uv = elements.uv[from];
    const Vec3 turned = normalised(mix(Vec3{normal[3 * p], normal[3 * p + 1], normal[3 * p + 2]},
                                       Vec3{normal[3 * q], normal[3 * q + 1], normal[3 * q + 2]}, tau));
    elements.normal[row][3 * k] = turned.x;
    elements.normal[row][3 * k + 1] = turned.y;
    elements.normal[row][3 * k + 2] = turned.z;
    for (uint32_t i = 0; i < 2; ++i) elements.uv[row][2 * k + i] = mix(uv[2 * p + i], uv[2 * q + i], tau);
}

// The tensor (xx, yy, xy) in axes x, y, seen in axes a, b of the same plane.
Vec3 turn_tensor(Vec3 t, Vec3 x, Vec3 y, Vec3 a, Vec3 b) {
    const float ax = dot(a, x), ay = dot(a, y), bx = dot(b, x), by = dot(b, y);
    return {t.x * ax * ax + t.y * ay * ay + 2 * t.z * ax * ay, t.x * bx * bx + t.y * by * by + 2 * t.z * bx * by,
            t.x * ax * bx + t.y * ay * by + t.z * (ax * by + ay * bx)};
}

// Springs of an element whose corners changed in its plane; its stress follows into the new axes.
void refresh_element(ShellView shell, uint32_t element, Vec3 axis_x, Vec3 axis_y, const CutRepair& repair) {
    repair.element(repair, shell, element);
    const uint32_t row = shell.element(element);
    const Vec3 a = shell.state.triangle_springs.axis_x[row], b = shell.state.triangle_springs.axis_y[row];
    Elements& elements = shell.state.elements;
    elements.outer_stress.set(row, turn_tensor(elements.outer_stress[row], axis_x, axis_y, a, b));
    elements.inner_stress.set(row, turn_tensor(elements.inner_stress[row], axis_x, axis_y, a, b));
}

// Splits one triangle at corner k's edge; returns the new element, which holds the edge's second end.
uint32_t halve(ShellView shell, uint32_t element, uint32_t k, uint32_t w, float tau) {
    Elements& elements = shell.state.elements;
    const uint32_t made = shell.elements().count++;
    ++shell.structures().live_elements[shell.structure];
    const uint32_t row = shell.element(element), made_row = shell.element(made);
    if (made % kLanes == 0) {  // kernels read the pack that it begins as a whole
        elements.clear_rows(made_row, kLanes);
        shell.state.triangle_springs.clear_rows(made_row, kLanes);
    }
    elements.copy_rows(elements, row, made_row, 1);
    shell.state.triangle_springs.copy_rows(shell.state.triangle_springs, row, made_row, 1);
    elements.start_strength[row] = elements.start_strength[made_row] = 0;  // the new vertex may start a crack
    const uint32_t next = (k + 1) % 3, last = (k + 2) % 3;
    interpolate_corner(elements, row, k, made_row, k, tau);
    // The kept element's corner next to the edge's second end is overwritten after the made one has read it.
    interpolate_corner(elements, row, k, row, next, tau);
    elements.corner[row][next] = w;
    elements.corner[made_row][k] = w;
    elements.mass[row] = tau * elements.mass[made_row];
    elements.mass[made_row] -= elements.mass[row];
    elements.volume[row] = tau * elements.volume[made_row];
    elements.volume[made_row] -= elements.volume[row];
    // The made element took over the edge (second end, opposite corner).
    if (const uint32_t beyond = elements.neighbour[made_row][next]; beyond != kNone) {
        auto& back = elements.neighbour[shell.element(beyond)];
        const auto& corner = elements.corner[made_row];
        back[edge_between(shell, beyond, corner[last], corner[next])] = made;
    }
    elements.neighbour[row][next] = made;
    elements.neighbour[made_row][last] = element;
    elements.edge_kind[row][next] = elements.edge_kind[made_row][last] = static_cast<uint8_t>(EdgeKind::Interior);
    elements.hinge[row][next] = elements.hinge[made_row][last] = kNone;
    const uint32_t cell = elements.cell[row];
    if (cell < shell.cells().count) ++shell.state.cells.element_count[shell.cells().first + cell];
    return made;
}

// The hinge across edge k of `element`, made when `is_new`, gets the vertices it has now.
void refresh_hinge(ShellView shell, uint32_t element, uint32_t k, bool is_new, Touched& touched) {
    Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(element);
    const uint32_t other = elements.neighbour[row][k];
    if (other == kNone || (elements.hinge[row][k] == kNone && !is_new)) return;
    const auto& corner = elements.corner[row];
    const uint8_t j = edge_between(shell, other, corner[(k + 1) % 3], corner[k]);
    if (is_new) {
        const uint32_t made = shell.hinges().count++;
        shell.state.hinges.clear_rows(shell.hinge(made), 1);
        elements.hinge[row][k] = elements.hinge[shell.element(other)][j] = made;
    }
    const uint32_t opposite = elements.corner[shell.element(other)][(j + 2) % 3];
    const uint32_t hinge = elements.hinge[row][k];
    shell.state.hinges.vertex[shell.hinge(hinge)] = {corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3], opposite};
    touched.repair.hinge(shell, hinge);
    touched.add_hinge(shell, hinge);
}

}  // namespace

bool can_insert(ShellView shell, uint32_t element, uint32_t edge, float tau, bool& is_full, float share) {
    const ShellRows& state = shell.state;
    is_full = false;
    const uint32_t row = shell.element(element);
    if (state.elements.edge_kind[row][edge] == static_cast<uint8_t>(EdgeKind::Crack)) return false;
    const auto& corner = state.elements.corner[row];
    const auto rest = [&](uint32_t v) { return state.vertices.rest[shell.vertex(v)]; };
    const uint32_t p = corner[edge], q = corner[(edge + 1) % 3], r = corner[(edge + 2) % 3];
    const Vec3 w = mix(rest(p), rest(q), tau);
    const float l = shell.shells().mean_edge[shell.row];
    const float mean_area = kEquilateralArea * l * l;
    if (!is_well_shaped(rest(p), w, rest(r), mean_area, share) ||
        !is_well_shaped(w, rest(q), rest(r), mean_area, share))
        return false;
    if (!has_place_in_ring(shell, r)) return false;
    if (const uint32_t other = state.elements.neighbour[row][edge]; other != kNone) {
        const uint32_t s = state.elements.corner[shell.element(other)][(edge_between(shell, other, q, p) + 2) % 3];
        if (s == r) return false;  // two triangles back to back
        if (!is_well_shaped(rest(q), w, rest(s), mean_area, share) ||
            !is_well_shaped(w, rest(p), rest(s), mean_area, share))
            return false;
        if (!has_place_in_ring(shell, s)) return false;
    }
    is_full = shell.vertex_count() + kInsertVertices > shell.vertices().capacity ||
              shell.element_count() + kInsertElements > shell.elements().capacity ||
              shell.hinge_count() + kInsertHinges > shell.hinges().capacity;
    return !is_full;
}

uint32_t insert_vertex(ShellView shell, uint32_t element, uint32_t edge, float tau, Touched& touched) {
    ShellRows& state = shell.state;
    Elements& elements = state.elements;
    const uint32_t row = shell.element(element);
    const uint32_t k = edge, next = (edge + 1) % 3, last = (edge + 2) % 3;
    const uint32_t p = elements.corner[row][k], q = elements.corner[row][next], r = elements.corner[row][last];
    const uint32_t other = elements.neighbour[row][k];
    const bool had_hinge = elements.hinge[row][k] != kNone;
    const Vec3 axis_x = state.triangle_springs.axis_x[row], axis_y = state.triangle_springs.axis_y[row];

    const uint32_t w = shell.vertices().count++;
    interpolate_vertex(state.vertices, shell.vertex(p), shell.vertex(q), shell.vertex(w), tau);
    const uint32_t made = halve(shell, element, k, w, tau);
    refresh_element(shell, element, axis_x, axis_y, touched.repair);
    refresh_element(shell, made, axis_x, axis_y, touched.repair);

    uint32_t s = kNone;
    if (other != kNone) {
        // Seen from the other triangle the edge runs from q to p: it keeps (q, w), the made one gets (w, p).
        const uint32_t other_row = shell.element(other);
        const uint32_t j = edge_between(shell, other, q, p);
        s = elements.corner[other_row][(j + 2) % 3];
        const Vec3 other_x = state.triangle_springs.axis_x[other_row],
                   other_y = state.triangle_springs.axis_y[other_row];
        const uint32_t other_made = halve(shell, other, j, w, 1 - tau);
        elements.neighbour[row][k] = other_made;
        elements.neighbour[shell.element(other_made)][j] = element;
        elements.neighbour[shell.element(made)][k] = other;
        elements.neighbour[other_row][j] = made;
        elements.hinge[shell.element(made)][k] = elements.hinge[other_row][j] = kNone;
        refresh_element(shell, other, other_x, other_y, touched.repair);
        refresh_element(shell, other_made, other_x, other_y, touched.repair);
        refresh_hinge(shell, element, k, false, touched);
        if (had_hinge) refresh_hinge(shell, made, k, true, touched);
        refresh_hinge(shell, other, (j + 1) % 3, true, touched);
        refresh_hinge(shell, other, (j + 2) % 3, false, touched);
        refresh_hinge(shell, other_made, (j + 1) % 3, false, touched);
        state.vertices.element[shell.vertex(s)] = other;
    }
    refresh_hinge(shell, element, next, true, touched);
    refresh_hinge(shell, element, last, false, touched);
    refresh_hinge(shell, made, next, false, touched);

    state.vertices.element[shell.vertex(w)] = element;
    state.vertices.element[shell.vertex(p)] = element;
    state.vertices.element[shell.vertex(q)] = made;
    state.vertices.element[shell.vertex(r)] = element;
    for (const uint32_t v : {p, q, r, s, w}) {
        if (v == kNone) continue;
        weigh_vertex(shell, v);
        touched.add(v);
    }
    return w;
}

}  // namespace cullet
