#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/damage/stress_check.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include "systems/damage/element_stiffness.hpp"
#include "systems/damage/stress_check.hpp"
#include "systems/motion/lanes-inl.hpp"

#ifndef CULLET_STRESS_RANGE
#define CULLET_STRESS_RANGE
namespace cullet {
/// Columns of one shell's elements and hinges, from its first rows on.
struct StressTables {
    const Float4* probe;
    const std::array<uint32_t, 3>*corner, *hinge;
    const uint8_t* flags;
    const float *axis_x[3], *axis_y[3], *inverse_edges[3], *curvature[3][3];
    const float *area, *thickness, *scale;
    float *outer[3], *inner[3], *principal;
    const std::array<uint32_t, 4>* hinge_vertex;
    const std::array<float, 12>* gradient;
    float* angle;
    float c11, c12, c33;
};
}  // namespace cullet
#endif

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

/// theta = g1.(w1 - w0) + g2.(w2 - w0) + g3.(w3 - w0), summed by components, then (x + y) + z.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void bend_one(const StressTables& t, uint32_t h) {
    const auto& v = t.hinge_vertex[h];
    if (v[0] == kNone) {
        t.angle[h] = 0;
        return;
    }
    const Float4 &w0 = t.probe[v[0]], &w1 = t.probe[v[1]], &w2 = t.probe[v[2]], &w3 = t.probe[v[3]];
    const float* g = t.gradient[h].data();
    const float x = (g[3] * (w1.x - w0.x) + g[6] * (w2.x - w0.x)) + g[9] * (w3.x - w0.x);
    const float y = (g[4] * (w1.y - w0.y) + g[7] * (w2.y - w0.y)) + g[10] * (w3.y - w0.y);
    const float z = (g[5] * (w1.z - w0.z) + g[8] * (w2.z - w0.z)) + g[11] * (w3.z - w0.z);
    t.angle[h] = (x + y) + z;
}
void bend_range(const StressTables& t, uint32_t first, uint32_t count) {
    for (uint32_t h = first; h < first + count; ++h) bend_one(t, h);
}
#else
using Four = hn::CappedTag<float, 4>;
using V4 = hn::Vec<Four>;
/// The products of one hinge by components (x, y, z, 0).
HWY_INLINE V4 bend_terms(const StressTables& t, uint32_t h) {
    const Four d;
    const auto& v = t.hinge_vertex[h];
    if (v[0] == kNone) return hn::Zero(d);
    const float* g = t.gradient[h].data();
    const V4 w0 = hn::Load(d, &t.probe[v[0]].x);
    const V4 d1 = hn::Sub(hn::Load(d, &t.probe[v[1]].x), w0);
    const V4 d2 = hn::Sub(hn::Load(d, &t.probe[v[2]].x), w0);
    const V4 d3 = hn::Sub(hn::Load(d, &t.probe[v[3]].x), w0);
    // The fourth lane of a difference is 0, that of a gradient some other component. g3 comes from the end of the row.
    const V4 g3 = hn::Shuffle0321(hn::LoadU(d, g + 8));
    return hn::Add(hn::Add(hn::Mul(hn::LoadU(d, g + 3), d1), hn::Mul(hn::LoadU(d, g + 6), d2)), hn::Mul(g3, d3));
}
HWY_INLINE void bend_four(const StressTables& t, const uint32_t (&h)[4], float* angle) {
    const Four d;
    const hn::RepartitionToWide<Four> wide;
    const V4 r0 = bend_terms(t, h[0]), r1 = bend_terms(t, h[1]), r2 = bend_terms(t, h[2]), r3 = bend_terms(t, h[3]);
    const auto low01 = hn::BitCast(wide, hn::InterleaveLower(d, r0, r1));
    const auto low23 = hn::BitCast(wide, hn::InterleaveLower(d, r2, r3));
    const auto high01 = hn::BitCast(wide, hn::InterleaveUpper(d, r0, r1));
    const auto high23 = hn::BitCast(wide, hn::InterleaveUpper(d, r2, r3));
    const V4 x = hn::BitCast(d, hn::InterleaveLower(wide, low01, low23));
    const V4 y = hn::BitCast(d, hn::InterleaveUpper(wide, low01, low23));
    const V4 z = hn::BitCast(d, hn::InterleaveLower(wide, high01, high23));
    hn::StoreU(hn::Add(hn::Add(x, y), z), d, angle);
}
void bend_range(const StressTables& t, uint32_t first, uint32_t count) {
    const uint32_t end = first + count;
    uint32_t h = first;
    for (; h + 4 <= end; h += 4) bend_four(t, {h, h + 1, h + 2, h + 3}, t.angle + h);
    if (h == end) return;
    const uint32_t last = end - 1;
    float angle[4];
    bend_four(t, {h, std::min(h + 1, last), std::min(h + 2, last), last}, angle);
    for (uint32_t i = 0; h + i < end; ++i) t.angle[h + i] = angle[i];
}
#endif

/// Strain (xx, yy, gamma) of elements e to e + kStep from their corners, given as three lists of indices.
HWY_INLINE V3 strain(const StressTables& t, uint32_t e, const uint32_t* a, const uint32_t* b, const uint32_t* c) {
    const V3 w = gather(t.probe, a);
    const V3 d1 = gather(t.probe, b) - w, d2 = gather(t.probe, c) - w;
    const V3 x = load(t.axis_x[0] + e, t.axis_x[1] + e, t.axis_x[2] + e);
    const V3 y = load(t.axis_y[0] + e, t.axis_y[1] + e, t.axis_y[2] + e);
    const V3 i = load(t.inverse_edges[0] + e, t.inverse_edges[1] + e, t.inverse_edges[2] + e);
    const V x1 = dot(x, d1), y1 = dot(y, d1), x2 = dot(x, d2), y2 = dot(y, d2);
    const V shear = hn::Add(hn::Add(hn::Mul(i.y, x1), hn::Mul(i.z, x2)), hn::Mul(i.x, y1));
    return {hn::Mul(i.x, x1), hn::Add(hn::Mul(i.y, y1), hn::Mul(i.z, y2)), shear};
}

HWY_INLINE V3 stress(const StressTables& t, V scale, V3 eps) {
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

inline constexpr uint32_t kBatch = 64;  // elements whose lists are turned into columns at a time

struct Batch {
    uint32_t corner[3][kBatch];
    float angle[3][kBatch];
};
/// Dead and missing elements read vertex 0 three times: no strain.
HWY_INLINE void fill_batch(const StressTables& t, uint32_t first, uint32_t count, uint32_t end, Batch& batch) {
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t e = first + i;
        const bool is_live = e < end && !(t.flags[e] & kDead);
        for (size_t k = 0; k < 3; ++k) {
            batch.corner[k][i] = is_live ? t.corner[e][k] : 0;
            const uint32_t h = is_live ? t.hinge[e][k] : kNone;
            batch.angle[k][i] = h == kNone ? 0.0f : t.angle[h];
        }
    }
}

HWY_INLINE void stress_lanes(const StressTables& t, uint32_t e, const Batch& batch, uint32_t i) {
    const Floats d;
    const V3 eps = strain(t, e, batch.corner[0] + i, batch.corner[1] + i, batch.corner[2] + i);
    V3 bend{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (size_t k = 0; k < 3; ++k)
        bend = add(bend, scaled(hn::LoadU(d, batch.angle[k] + i),
                                load(t.curvature[k][0] + e, t.curvature[k][1] + e, t.curvature[k][2] + e)));
    // Curvature (xx, yy, xy) as a strain: gamma is twice the xy entry.
    const V h = hn::Mul(hn::Set(d, 0.5f), hn::LoadU(d, t.thickness + e));
    bend = V3{hn::Mul(h, bend.x), hn::Mul(h, bend.y), hn::Mul(hn::Add(h, h), bend.z)};
    const V scale = hn::LoadU(d, t.scale + e);
    const V3 outer = stress(t, scale, eps - bend), inner = stress(t, scale, add(eps, bend));
    store(outer, t.outer[0] + e, t.outer[1] + e, t.outer[2] + e);
    store(inner, t.inner[0] + e, t.inner[1] + e, t.inner[2] + e);
    hn::StoreU(hn::Max(principal_of(outer), principal_of(inner)), d, t.principal + e);
}

void stress_range(const StressTables& t, uint32_t first, uint32_t count) {
    Batch batch;
    const uint32_t end = first + count;
    for (uint32_t e = first; e < end; e += kBatch) {
        const uint32_t rows = std::min(kBatch, (end - e + kLanes - 1) / kLanes * kLanes);
        fill_batch(t, e, rows, end, batch);
        for (uint32_t i = 0; i < rows; i += kStep) stress_lanes(t, e + i, batch, i);
    }
}

/// Sum of 1/2 A h s eps.C eps: each element in float, the sum in double, element after element.
double energy_range(const StressTables& t, uint32_t first, uint32_t count) {
    const Floats d;
    Batch batch;
    alignas(64) float energy[kBatch];
    double sum = 0;
    const uint32_t end = first + count;
    for (uint32_t e = first; e < end; e += kBatch) {
        const uint32_t rows = std::min(kBatch, (end - e + kLanes - 1) / kLanes * kLanes);
        fill_batch(t, e, rows, end, batch);
        for (uint32_t i = 0; i < rows; i += kStep) {
            const V3 eps = strain(t, e + i, batch.corner[0] + i, batch.corner[1] + i, batch.corner[2] + i);
            const V density = dot(eps, stress(t, hn::LoadU(d, t.scale + e + i), eps));
            const V volume = hn::Mul(hn::LoadU(d, t.area + e + i), hn::LoadU(d, t.thickness + e + i));
            hn::StoreU(hn::Mul(volume, density), d, energy + i);
        }
        for (uint32_t i = 0; i < rows; ++i) sum += energy[i];
    }
    return 0.5 * sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(bend_range);
HWY_EXPORT(stress_range);
HWY_EXPORT(energy_range);

namespace {

void lanes_of(const Column<Vec3>& column, uint32_t first, const float* (&out)[3]) {
    for (int k = 0; k < 3; ++k) out[k] = column.lane(k) + first;
}
void lanes_of(Column<Vec3>& column, uint32_t first, float* (&out)[3]) {
    for (int k = 0; k < 3; ++k) out[k] = column.lane(k) + first;
}

StressTables stress_tables(const ShellView& shell, uint32_t side) {
    State& state = shell.state;
    const TriangleSprings& springs = state.triangle_springs;
    const uint32_t e = shell.elements().first, h = shell.hinges().first;
    const PlaneStress c = plane_stress(state, shell.row);
    StressTables t{};
    t.probe = state.vertices.probe.data(static_cast<int>(side & 1)) + shell.vertices().first;
    t.corner = state.elements.corner.data() + e;
    t.hinge = state.elements.hinge.data() + e;
    t.flags = state.elements.flags.data() + e;
    lanes_of(springs.axis_x, e, t.axis_x);
    lanes_of(springs.axis_y, e, t.axis_y);
    lanes_of(springs.inverse_edges, e, t.inverse_edges);
    lanes_of(springs.curvature_0, e, t.curvature[0]);
    lanes_of(springs.curvature_1, e, t.curvature[1]);
    lanes_of(springs.curvature_2, e, t.curvature[2]);
    t.area = springs.area.data() + e;
    t.thickness = springs.thickness.data() + e;
    t.scale = springs.scale.data() + e;
    lanes_of(state.elements.outer_stress, e, t.outer);
    lanes_of(state.elements.inner_stress, e, t.inner);
    t.principal = state.elements.principal.data() + e;
    t.hinge_vertex = state.hinges.vertex.data() + h;
    t.gradient = state.hinges.gradient.data() + h;
    t.angle = state.hinges.angle.data() + h;
    t.c11 = static_cast<float>(c.c11), t.c12 = static_cast<float>(c.c12), t.c33 = static_cast<float>(c.c33);
    return t;
}

}  // namespace

void bend_hinges(ShellView shell, uint32_t side, uint32_t first, uint32_t count) {
    HWY_DYNAMIC_DISPATCH(bend_range)(stress_tables(shell, side), first, count);
}
void stress_elements(ShellView shell, uint32_t side, uint32_t first, uint32_t count) {
    HWY_DYNAMIC_DISPATCH(stress_range)(stress_tables(shell, side), first, count);
}
double membrane_energy(ShellView shell, uint32_t side, uint32_t first, uint32_t count) {
    return HWY_DYNAMIC_DISPATCH(energy_range)(stress_tables(shell, side), first, count);
}

}  // namespace cullet
#endif
