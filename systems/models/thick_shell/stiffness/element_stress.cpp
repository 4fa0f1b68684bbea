#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/thick_shell/stiffness/element_stress.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <algorithm>
#include <cstring>

#include "systems/models/thick_shell/springs/lanes-inl.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/ring.hpp"

#ifndef CULLET_STRESS_RANGE
#define CULLET_STRESS_RANGE
namespace cullet {
/// Columns of one shell's elements and hinges, from its first rows on.
struct StressColumns {
    const Float4* probe;
    const std::array<uint32_t, 3>*corner, *other_slope;
    const uint8_t* flags;
    const float *axis_x[3], *axis_y[3], *inverse_edges[3], *altitude[3];
    const float *area, *thickness, *scale;
    float *outer[3], *inner[3], *principal;
    float* slope;  // 3 an element
    const float* start_strength;
    uint8_t* over_limit;  // at every eighth element
    float c11, c12, c33, start_limit;
};
}  // namespace cullet
#endif

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

HWY_INLINE V3 load(const float* const (&column)[3], uint32_t e) {
    return load(column[0] + e, column[1] + e, column[2] + e);
}
HWY_INLINE V3 cross(V3 a, V3 b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// Corners of 8 elements, element after element; dead and missing ones read vertex 0 three times: no strain.
HWY_INLINE const uint32_t* corners_of(const StressColumns& t, uint32_t e, uint32_t end,
                                      uint32_t (&patched)[3 * kLanes]) {
    uint64_t flags = 0, dead = 0;
    std::memcpy(&flags, t.flags + e, sizeof flags);
    std::memset(&dead, kDead, sizeof dead);
    if ((flags & dead) == 0 && e + kLanes <= end) return t.corner[e].data();
    for (uint32_t i = 0; i < kLanes; ++i) {
        const bool is_live = e + i < end && !(t.flags[e + i] & kDead);
        for (size_t k = 0; k < 3; ++k) patched[3 * i + k] = is_live ? t.corner[e + i][k] : 0;
    }
    return patched;
}

struct Strain {
    V3 membrane;  // xx, yy, gamma
    V3 slope;     // of the normal displacement against edge 0, 1, 2, towards the corner opposite
};
/// Of elements e to e + kStep with these corners.
HWY_INLINE Strain strain(const StressColumns& t, uint32_t e, const uint32_t* corner) {
    const V3 w = gather<3>(t.probe, corner);
    const V3 d1 = gather<3>(t.probe, corner + 1) - w, d2 = gather<3>(t.probe, corner + 2) - w;
    const V3 x = load(t.axis_x, e), y = load(t.axis_y, e), i = load(t.inverse_edges, e), a = load(t.altitude, e);
    const V x1 = dot(x, d1), y1 = dot(y, d1), x2 = dot(x, d2), y2 = dot(y, d2);
    const V shear = hn::Add(hn::Add(hn::Mul(i.y, x1), hn::Mul(i.z, x2)), hn::Mul(i.x, y1));
    const V3 n = cross(x, y);
    const V n1 = dot(n, d1), n2 = dot(n, d2);
    // Gradient of the normal displacement, then along the three edge normals: altitude * (shape gradient . gradient).
    const V gx = hn::Mul(i.x, n1), gy = hn::Add(hn::Mul(i.y, n1), hn::Mul(i.z, n2));
    const V to_1 = hn::Add(hn::Mul(i.x, gx), hn::Mul(i.y, gy)), to_2 = hn::Mul(i.z, gy);
    return {{hn::Mul(i.x, x1), hn::Add(hn::Mul(i.y, y1), hn::Mul(i.z, y2)), shear},
            {hn::Mul(a.x, to_2), hn::Neg(hn::Mul(a.y, hn::Add(to_1, to_2))), hn::Mul(a.z, to_1)}};
}

HWY_INLINE V3 stress(const StressColumns& t, V scale, V3 eps) {
    const Floats d;
    const V c11 = hn::Set(d, t.c11), c12 = hn::Set(d, t.c12), c33 = hn::Set(d, t.c33);
    return scaled(scale, {hn::Add(hn::Mul(c11, eps.x), hn::Mul(c12, eps.y)),
                          hn::Add(hn::Mul(c12, eps.x), hn::Mul(c11, eps.y)), hn::Mul(c33, eps.z)});
}

/// Larger principal value: mean + sqrt(half difference^2 + shear^2).
HWY_INLINE V principal_of(V3 s) {
    const V half = hn::Set(Floats(), 0.5f);
    const V mean = hn::Mul(half, hn::Add(s.x, s.y)), difference = hn::Mul(half, hn::Sub(s.x, s.y));
    return hn::Add(mean, hn::Sqrt(hn::Add(hn::Mul(difference, difference), hn::Mul(s.z, s.z))));
}

/// Strains of [first, first + count); `use` takes those of each kStep elements.
template <class Use>
HWY_INLINE void strain_range(const StressColumns& t, uint32_t first, uint32_t count, Use use) {
    const uint32_t end = first + count;
    for (uint32_t e = first; e < end; e += kLanes) {
        uint32_t patched[3 * kLanes];
        const uint32_t* corner = corners_of(t, e, end, patched);
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) {
            const Strain s = strain(t, e + lane, corner + 3 * lane);
            hn::StoreInterleaved3(s.slope.x, s.slope.y, s.slope.z, Floats(), t.slope + 3 * (e + lane));
            use(e + lane, s.membrane);
        }
    }
}

void membrane_range(const StressColumns& t, uint32_t first, uint32_t count) {
    strain_range(t, first, count, [&](uint32_t e, V3 eps) HWY_ATTR {
        store(stress(t, hn::LoadU(Floats(), t.scale + e), eps), t.outer[0] + e, t.outer[1] + e, t.outer[2] + e);
    });
}

/// Sum of 1/2 A h s eps.C eps: each element in float, the sum in double, element after element.
double energy_range(const StressColumns& t, uint32_t first, uint32_t count) {
    const Floats d;
    double sum = 0;
    strain_range(t, first, count, [&](uint32_t e, V3 eps) HWY_ATTR {
        alignas(64) float energy[kStep];
        const V volume = hn::Mul(hn::LoadU(d, t.area + e), hn::LoadU(d, t.thickness + e));
        hn::Store(hn::Mul(volume, dot(eps, stress(t, hn::LoadU(d, t.scale + e), eps))), d, energy);
        for (const float part : energy) sum += static_cast<double>(part);
    });
    return 0.5 * sum;
}

alignas(32) inline constexpr uint32_t kThreeLanes[] = {0, 3, 6, 9, 12, 15, 18, 21};  // hn::Iota goes through memory

/// Angles of the hinges of kStep elements' edges, 0 where there is none: a half without another names itself.
HWY_INLINE V3 hinge_angles(const StressColumns& t, uint32_t e) {
    const Indices u;
    V3 own;
    hn::Vec<Indices> other[3];
    hn::LoadInterleaved3(Floats(), t.slope + 3 * size_t{e}, own.x, own.y, own.z);
    hn::LoadInterleaved3(u, t.other_slope[e].data(), other[0], other[1], other[2]);
    const auto self = hn::Add(hn::Load(u, kThreeLanes), hn::Set(u, 3 * e));
    const auto angle = [&](V slope, uint32_t k) HWY_ATTR {
        const V sum = hn::Add(slope, gather(t.slope, other[k]));
        const auto is_alone = hn::Eq(hn::Add(self, hn::Set(u, k)), other[k]);
        return hn::BitCast(Floats(), hn::IfThenZeroElse(is_alone, hn::BitCast(u, sum)));
    };
    return {angle(own.x, 0), angle(own.y, 1), angle(own.z, 2)};
}

/// Curvature as a strain at distance h / 2: gamma is twice the xy entry.
HWY_INLINE V3 bending_strain(const StressColumns& t, uint32_t e, V3 angle) {
    const V3 i = load(t.inverse_edges, e), a = load(t.altitude, e);
    const V half = hn::Mul(hn::Set(Floats(), 0.5f), hn::LoadU(Floats(), t.thickness + e));
    const V q0 = hn::Mul(half, hn::Mul(a.x, angle.x)), q1 = hn::Mul(half, hn::Mul(a.y, angle.y)),
            q2 = hn::Mul(half, hn::Mul(a.z, angle.z));
    const V sum = hn::Add(i.y, i.z);  // gradients: edge 0 (0, i.z), edge 1 -(i.x, sum), edge 2 (i.x, i.y)
    const V y0 = hn::Mul(q0, i.z), y1 = hn::Mul(q1, sum), y2 = hn::Mul(q2, i.y);
    const V xx = hn::Mul(hn::Mul(i.x, i.x), hn::Add(q1, q2));
    const V yy = hn::Add(hn::Add(hn::Mul(y0, i.z), hn::Mul(y1, sum)), hn::Mul(y2, i.y));
    const V xy = hn::Mul(i.x, hn::Add(y1, y2));
    return {xx, yy, hn::Add(xy, xy)};
}

/// Returns a bit for each of kStep elements: its stress passes the limit of starts.
HWY_INLINE unsigned stress_lanes(const StressColumns& t, uint32_t e) {
    const Floats d;
    const V3 bend = stress(t, hn::LoadU(d, t.scale + e), bending_strain(t, e, hinge_angles(t, e)));
    const V3 membrane = load(t.outer[0] + e, t.outer[1] + e, t.outer[2] + e);
    const V3 outer = membrane - bend, inner = add(membrane, bend);
    store(outer, t.outer[0] + e, t.outer[1] + e, t.outer[2] + e);
    store(inner, t.inner[0] + e, t.inner[1] + e, t.inner[2] + e);
    const V largest = hn::Max(principal_of(outer), principal_of(inner));
    hn::StoreU(largest, d, t.principal + e);
    const V limit = hn::Mul(hn::Set(d, t.start_limit), hn::LoadU(d, t.start_strength + e));
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Gt(largest, limit), bits);
    return bits[0];
}

void stress_range(const StressColumns& t, uint32_t first, uint32_t count) {
    for (uint32_t e = first; e < first + count; e += kLanes) {
        unsigned bits = 0;
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) bits |= stress_lanes(t, e + lane) << lane;
        t.over_limit[e] = static_cast<uint8_t>(bits);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(membrane_range);
HWY_EXPORT(stress_range);
HWY_EXPORT(energy_range);

namespace {

void lanes_of(const Column<Vec3>& column, uint32_t first, const float* (&out)[3]) {
    for (int k = 0; k < 3; ++k) out[k] = column.lane(k) + first;
}
void lanes_of(Column<Vec3>& column, uint32_t first, float* (&out)[3]) {
    for (int k = 0; k < 3; ++k) out[k] = column.lane(k) + first;
}

StressColumns stress_columns(const StressView& shell, uint32_t side, float start_limit = kNeverStarts) {
    const StressTables& state = shell.state;
    const TriangleSprings& springs = state.triangle_springs;
    const uint32_t e = shell.elements().first;
    const PlaneStress c = plane_stress(state, shell.structure);
    StressColumns t{};
    t.probe = state.vertices.probe.data(static_cast<int>(side & 1)) + shell.vertices().first;
    t.corner = state.elements.corner.data() + e;
    t.other_slope = state.elements.other_slope.data() + e;
    t.slope = state.elements.slope[e].data();
    t.flags = state.elements.flags.data() + e;
    lanes_of(springs.axis_x, e, t.axis_x);
    lanes_of(springs.axis_y, e, t.axis_y);
    lanes_of(springs.inverse_edges, e, t.inverse_edges);
    lanes_of(springs.altitude, e, t.altitude);
    t.area = springs.area.data() + e;
    t.thickness = springs.thickness.data() + e;
    t.scale = springs.scale.data() + e;
    lanes_of(state.elements.outer_stress, e, t.outer);
    lanes_of(state.elements.inner_stress, e, t.inner);
    t.principal = state.elements.principal.data() + e;
    t.start_strength = state.elements.start_strength.data() + e;
    t.over_limit = state.elements.over_limit.data() + e;
    t.start_limit = start_limit;
    t.c11 = static_cast<float>(c.c11), t.c12 = static_cast<float>(c.c12), t.c33 = static_cast<float>(c.c33);
    // With a grain the kernels leave strains; follow_grain makes stresses of them.
    if (c.has_grain) t.c11 = t.c33 = 1, t.c12 = 0;
    return t;
}

// Stresses from the scaled strains of both faces. Plain code: wood is rare, and three products more a triangle in the
// kernel would cost all others a tenth.
void follow_grain(const StressView& shell, const PlaneStress& stress, uint32_t first, uint32_t count,
                  float start_limit) {
    Elements& elements = shell.state.elements;
    for (uint32_t e = first; e < first + count; ++e) {
        const uint32_t row = shell.element(e);
        const TriangleTerms terms(shell.state.triangle_springs, row, stress);
        const PlaneStiffness& c = terms.full;
        float largest = 0;
        for (Column<Vec3>* face : {&elements.outer_stress, &elements.inner_stress}) {
            const Vec3d eps((*face)[row]);
            const Vec3d s(c.c11 * eps.x + c.c12 * eps.y + c.c16 * eps.z, c.c12 * eps.x + c.c22 * eps.y + c.c26 * eps.z,
                          c.c16 * eps.x + c.c26 * eps.y + c.c66 * eps.z);
            const double half = 0.5 * (s.x - s.y);
            face->set(row, s.to_float());
            largest = std::max(largest, static_cast<float>(0.5 * (s.x + s.y) + std::sqrt(half * half + s.z * s.z)));
        }
        elements.principal[row] = largest;
        uint8_t& over = elements.over_limit[shell.element(e / kLanes * kLanes)];
        if (e % kLanes == 0) over = 0;
        if (largest > start_limit * elements.start_strength[row]) over = static_cast<uint8_t>(over | 1u << e % kLanes);
    }
}

double grained_membrane_energy(const StressView& shell, const PlaneStress& stress, uint32_t side, uint32_t first,
                               uint32_t count) {
    const StressTables& state = shell.state;
    const Float4* w = state.vertices.probe.data(static_cast<int>(side & 1)) + shell.vertices().first;
    double sum = 0;
    for (uint32_t e = first; e < first + count; ++e) {
        const uint32_t row = shell.element(e);
        if (state.elements.flags[row] & kDead) continue;
        const TriangleTerms terms(state.triangle_springs, row, stress);
        double eps[3] = {};
        for (size_t i = 0; i < 3; ++i) {
            const Float4 u = w[state.elements.corner[row][i]];
            const double along_x = dot(Vec3d(u.x, u.y, u.z), terms.x), along_y = dot(Vec3d(u.x, u.y, u.z), terms.y);
            eps[0] += terms.g[i][0] * along_x, eps[1] += terms.g[i][1] * along_y;
            eps[2] += terms.g[i][1] * along_x + terms.g[i][0] * along_y;
        }
        sum += terms.volume * state.triangle_springs.scale[row] * terms.full.product(eps, eps);
    }
    return 0.5 * sum;
}

void link_slopes_of(const ShellView& shell, uint32_t element) {
    Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(element);
    const auto& corner = elements.corner[row];
    for (uint32_t k = 0; k < 3; ++k) {
        uint32_t& other_slope = elements.other_slope[row][k];
        other_slope = 3 * element + k;
        const uint32_t other = elements.neighbour[row][k];
        if (other == kNone || elements.hinge[row][k] == kNone || (elements.flags[row] & kDead)) continue;
        const uint8_t edge = edge_between(shell, other, corner[(k + 1) % 3], corner[k]);
        if (edge < 3) other_slope = 3 * other + edge;
    }
}

}  // namespace

void link_slopes(ShellView shell) {
    for (uint32_t e = 0; e < shell.element_count(); ++e) link_slopes_of(shell, e);
}
void link_slopes(ShellView shell, std::span<const uint32_t> vertices) {
    Ring ring;
    for (const uint32_t v : vertices) {
        collect_ring(shell, v, ring);
        for (uint32_t i = 0; i < ring.count; ++i) link_slopes_of(shell, ring.element[i]);
    }
}

void strain_elements(StressView shell, uint32_t side, uint32_t first, uint32_t count) {
    HWY_DYNAMIC_DISPATCH(membrane_range)(stress_columns(shell, side), first, count);
}
void stress_elements(StressView shell, uint32_t first, uint32_t count, float start_limit) {
    HWY_DYNAMIC_DISPATCH(stress_range)(stress_columns(shell, 0, start_limit), first, count);
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    if (stress.has_grain) follow_grain(shell, stress, first, count, start_limit);
}
void check_stress(ShellView shell, uint32_t side) {
    link_slopes(shell);
    strain_elements(shell, side, 0, shell.element_count());
    stress_elements(shell, 0, shell.element_count(), kNeverStarts);
}
// The kernel runs with a grain, too: it writes the slopes that the bending energy is made of.
double membrane_energy(StressView shell, uint32_t side, uint32_t first, uint32_t count) {
    const double energy = HWY_DYNAMIC_DISPATCH(energy_range)(stress_columns(shell, side), first, count);
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    return stress.has_grain ? grained_membrane_energy(shell, stress, side, first, count) : energy;
}

}  // namespace cullet
#endif
