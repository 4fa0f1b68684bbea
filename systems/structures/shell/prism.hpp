// One element as three tetrahedra (thick shell note A7). Neighbours agree on the diagonal of every side quad because it
// starts at the outer corner of the smaller vertex: with corners s0 < s1 < s2 the diagonals are s0-s1', s0-s2', s1-s2'.
#pragma once
#include <utility>

#include "components/shell_rows.hpp"

namespace cullet {

/// The six points of a prism, corners by rising vertex; sign -1 when that order turns the triangle over.
struct Prism {
    Vec3d outer[3], inner[3];
    double sign = 1;
};

/// Where the vertex's inner twin is, in double from the stored floats.
template <class Rows>
Vec3d inner_twin(const Rows& state, uint32_t row) {
    return Vec3d(state.vertices.rest[row]) +
           static_cast<double>(state.vertices.depth[row]) * Vec3d(state.vertices.inward[row]);
}

/// Where the point is drawn and collides, outside and inside: at rest, but on a smoothed crack.
template <class Rows>
Vec3 smoothed_place(const Rows& state, uint32_t row) {
    return state.vertices.rest[row] + state.vertices.crack_shift[row];
}
template <class Rows>
Vec3d smoothed_twin(const Rows& state, uint32_t row) {
    return inner_twin(state, row) + Vec3d(state.vertices.crack_shift[row]);
}

/// The prism whose points outer_of(row) and inner_of(row) say, Vec3d.
template <class Outer, class Inner>
Prism make_prism(const ShellView& shell, uint32_t element, Outer&& outer_of, Inner&& inner_of) {
    std::array<uint32_t, 3> c = shell.state.elements.corner[shell.element(element)];
    Prism prism;
    const auto order = [&](int i, int j) {
        if (c[i] > c[j]) std::swap(c[i], c[j]), prism.sign = -prism.sign;
    };
    order(0, 1), order(1, 2), order(0, 1);
    for (int k = 0; k < 3; ++k) {
        prism.outer[k] = outer_of(shell.vertex(c[k]));
        prism.inner[k] = inner_of(shell.vertex(c[k]));
    }
    return prism;
}
/// At rest.
inline Prism load_prism(const ShellView& shell, uint32_t element) {
    const ShellRows& state = shell.state;
    return make_prism(
        shell, element, [&](uint32_t row) { return Vec3d(state.vertices.rest[row]); },
        [&](uint32_t row) { return inner_twin(state, row); });
}
/// As it is drawn.
inline Prism load_smoothed_prism(const ShellView& shell, uint32_t element) {
    const ShellRows& state = shell.state;
    return make_prism(
        shell, element, [&](uint32_t row) { return Vec3d(smoothed_place(state, row)); },
        [&](uint32_t row) { return smoothed_twin(state, row); });
}

/// Calls visit(p, q, r, s, volume) for the three tetrahedra; volumes are positive in a sound element.
template <class Visit>
void for_each_tetrahedron(const Prism& prism, Visit visit) {
    const Vec3d(&o)[3] = prism.outer;
    const Vec3d(&i)[3] = prism.inner;
    const auto volume = [&](Vec3d p, Vec3d q, Vec3d r, Vec3d s) {
        return -prism.sign / 6 * dot(cross(q - p, r - p), s - p);
    };
    visit(o[0], o[1], o[2], i[2], volume(o[0], o[1], o[2], i[2]));
    visit(o[0], o[1], i[2], i[1], volume(o[0], o[1], i[2], i[1]));
    visit(o[0], i[1], i[2], i[0], volume(o[0], i[1], i[2], i[0]));
}

inline double prism_volume(const Prism& prism) {
    double sum = 0;
    for_each_tetrahedron(prism, [&](Vec3d, Vec3d, Vec3d, Vec3d, double volume) { sum += volume; });
    return sum;
}

inline double prism_area(const Prism& p) {
    return 0.5 * length(cross(p.outer[1] - p.outer[0], p.outer[2] - p.outer[0]));
}

}  // namespace cullet
