#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/thick_shell/soft/soft_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include "systems/models/thick_shell/soft/soft_lanes.hpp"
#include "systems/models/thick_shell/springs/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

using Mask = hn::Mask<Floats>;

/// A bit a lane.
HWY_INLINE uint32_t bits_of(Mask mask) {
    alignas(32) uint8_t bits[8] = {};
    hn::StoreMaskBits(Floats(), mask, bits);
    return bits[0];
}
HWY_INLINE V3 set(Vec3 a) {
    const Floats d;
    return {hn::Set(d, a.x), hn::Set(d, a.y), hn::Set(d, a.z)};
}

void mark_inside(SoftContact* contacts, uint32_t count, const Float4* places, const StrikerPlace& striker) {
    const Floats d;
    const V3 centre = set(striker.centre);
    // Axes of the frame's beginning, turned with the striker: their components are dot products.
    const V3 x = set(rotate(striker.turn, Vec3{1, 0, 0})), y = set(rotate(striker.turn, Vec3{0, 1, 0})),
             z = set(rotate(striker.turn, Vec3{0, 0, 1}));
    const V radius = hn::Set(d, striker.radius);
    for (SoftContact* c = contacts; c != contacts + count; ++c) {
        uint32_t inside = 0;
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) {
            const V3 from = gather(places, c->vertex + lane) - centre;
            Mask mask;
            if (striker.is_ball) {
                const V reach = hn::Add(radius, hn::Load(d, c->offset + lane));
                mask = hn::Lt(dot(from, from), hn::Mul(reach, reach));
            } else {
                const V3 normal{hn::Load(d, c->normal[0] + lane), hn::Load(d, c->normal[1] + lane),
                                hn::Load(d, c->normal[2] + lane)};
                mask = hn::Lt(dot(normal, {dot(from, x), dot(from, y), dot(from, z)}), hn::Load(d, c->distance + lane));
            }
            inside |= bits_of(mask) << lane;
        }
        c->inside = inside & ((1u << c->count) - 1);
    }
}

uint32_t find_strained(const StrainLook& look, uint32_t first, uint32_t count, uint32_t* found) {
    const Floats d;
    const Indices u;
    const V longer = hn::Set(d, 1 + look.yield), shorter = hn::Set(d, 1 - look.yield), most = hn::Set(d, look.most);
    const auto none = hn::Set(u, kNone);
    const auto length_of = [&](const Float4* points, const uint32_t* a, const uint32_t* b) HWY_ATTR {
        const V3 x = gather(points, b) - gather(points, a);
        return hn::Sqrt(dot(x, x));
    };
    const auto flows = [&](V now, V plastic) HWY_ATTR {
        return hn::Or(hn::Gt(now, hn::Mul(longer, plastic)), hn::Lt(now, hn::Mul(shorter, plastic)));
    };
    uint32_t listed = 0, s = first;
    for (; s + kLanes <= first + count; s += kLanes) {
        uint32_t bits = 0;
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) {
            const uint32_t at = s + lane;
            alignas(32) uint32_t a[kLanes], b[kLanes];
            const auto ends = [&](const uint32_t* from, uint32_t* to) HWY_ATTR {
                const auto end = hn::LoadU(u, from + at);
                hn::Store(hn::IfThenZeroElse(hn::Eq(end, none), end), u, to);
            };
            ends(look.a, a), ends(look.b, b);
            const V now = length_of(look.outer, a, b);
            const V strain = hn::Sub(hn::Div(now, hn::LoadU(d, look.rest + at)), hn::Set(d, 1));
            hn::StoreU(strain, d, look.strain + at);
            // A row without length at rest has a strain that is no number: it is listed, too.
            Mask mask = hn::Or(hn::Not(hn::Le(strain, most)), flows(now, hn::LoadU(d, look.plastic + at)));
            if (look.inner_plastic)
                mask = hn::Or(mask, flows(length_of(look.inner, a, b), hn::LoadU(d, look.inner_plastic + at)));
            bits |= bits_of(mask) << lane;
        }
        for (; bits != 0; bits &= bits - 1) found[listed++] = s + static_cast<uint32_t>(__builtin_ctz(bits));
    }
    for (; s < first + count; ++s) found[listed++] = s;
    return listed;
}

bool any_above(const float* numbers, uint32_t count, float limit) {
    const Floats d;
    const V bound = hn::Set(d, limit);
    uint32_t i = 0;
    for (; i + kStep <= count; i += kStep)
        if (!hn::AllFalse(d, hn::Gt(hn::LoadU(d, numbers + i), bound))) return true;
    for (; i < count; ++i)
        if (numbers[i] > limit) return true;
    return false;
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(mark_inside);
HWY_EXPORT(find_strained);
HWY_EXPORT(any_above);

void mark_inside(SoftContact* contacts, uint32_t count, const Float4* places, const StrikerPlace& striker) {
    HWY_DYNAMIC_DISPATCH(mark_inside)(contacts, count, places, striker);
}
uint32_t find_strained(const StrainLook& look, uint32_t first, uint32_t count, uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(find_strained)(look, first, count, found);
}
bool any_above(const float* numbers, uint32_t count, float limit) {
    return HWY_DYNAMIC_DISPATCH(any_above)(numbers, count, limit);
}

}  // namespace cullet
#endif
