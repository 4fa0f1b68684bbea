#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/thick_shell/springs/spring_packs.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <algorithm>

#include "systems/models/thick_shell/springs/lanes-inl.hpp"
#include "systems/models/thick_shell/springs/spring_packs.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

// A length under it is none: the direction is not defined, and x = 0 makes the force 0 whatever the pull is. Squares of
// differences of 1e-19 m are 0 in floats, and k L / 1e-18 stays finite up to 1e20 N: give_springs takes 1e18.
inline constexpr float kLeastLength = 1e-18f;

// A pack's loop over slots asks for the slots of their numbers so many packs later: 4 KB ahead, which is further than
// the processor looks by itself at the end of a page. Where all is in the caches it costs nothing.
inline constexpr uint32_t kPacksAhead = 4, kPairPacksAhead = 2;

HWY_INLINE uint32_t slot_ahead(const SpringStep& step, uint32_t pack, uint32_t packs) {
    return step.first_slot[std::min(pack + packs, step.pack_count - 1)];
}

HWY_INLINE V load_floats(const float* row) {
    return hn::Load(Floats(), row);
}

/// What a spring pulls with, over its length: times x it is the force on the end that x starts at.
struct Pull {
    V scale, strain, length;
};
HWY_INLINE Pull pull_of(V3 x, const float* inverse_rest, const float* stiffness_rest, const float* damping,
                        const float* before) {
    const Floats d;
    Pull p;
    p.length = hn::Sqrt(dot(x, x));
    p.strain = hn::Sub(hn::Mul(p.length, load_floats(inverse_rest)), hn::Set(d, 1));
    V pull = hn::Mul(load_floats(stiffness_rest), p.strain);
    if (damping) pull = hn::Add(pull, hn::Mul(load_floats(damping), hn::Sub(p.length, load_floats(before))));
    p.scale = hn::Div(pull, hn::Max(p.length, hn::Set(d, kLeastLength)));
    return p;
}

/// Real springs of the lanes whose length is 0, of all slots of a pack: seldom called.
HWY_NOINLINE uint32_t count_zero_lengths(const SpringSlot* slot, uint32_t count) {
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t k = 0; k < kLanes; ++k)
            found += slot[i].stiffness_rest[k] > 0 && !(slot[i].length[k] > kLeastLength);
    return found;
}

/// Points of a pack's lanes with the fourth number of each.
HWY_INLINE void store_points_and(V3 a, V w, Float4* to) {
#if HWY_TARGET == HWY_SCALAR
    to->x = hn::GetLane(a.x), to->y = hn::GetLane(a.y), to->z = hn::GetLane(a.z), to->w = hn::GetLane(w);
#else
    constexpr uint32_t h = kStep - 4;
    const Floats d;
    const hn::RepartitionToWide<Floats> wide;
    const auto xy_low = hn::BitCast(wide, hn::InterleaveLower(d, a.x, a.y));
    const auto zw_low = hn::BitCast(wide, hn::InterleaveLower(d, a.z, w));
    const auto xy_high = hn::BitCast(wide, hn::InterleaveUpper(d, a.x, a.y));
    const auto zw_high = hn::BitCast(wide, hn::InterleaveUpper(d, a.z, w));
    store_pair(hn::BitCast(d, hn::InterleaveLower(wide, xy_low, zw_low)), to, to + h);
    store_pair(hn::BitCast(d, hn::InterleaveUpper(wide, xy_low, zw_low)), to + 1, to + h + 1);
    store_pair(hn::BitCast(d, hn::InterleaveLower(wide, xy_high, zw_high)), to + 2, to + h + 2);
    store_pair(hn::BitCast(d, hn::InterleaveUpper(wide, xy_high, zw_high)), to + 3, to + h + 3);
#endif
}

/// v += dt (f / m + g) where m is finite, then x + dt v to the other side.
struct PackMotion {
    V dt;
    V3 fall;  // dt g
    explicit PackMotion(const SpringStep& step) {
        const Floats d;
        dt = hn::Set(d, step.dt);
        fall = {hn::Set(d, step.dt * step.gravity.x), hn::Set(d, step.dt * step.gravity.y),
                hn::Set(d, step.dt * step.gravity.z)};
    }
    HWY_INLINE void move(V3 own, V3 force, V most, V inverse_mass, float* const* velocity, uint32_t v,
                         Float4* next) const {
        const Floats d;
        const auto is_free = hn::Gt(inverse_mass, hn::Zero(d));
        const V push = hn::Mul(dt, inverse_mass);
        V3 now = load(velocity[0] + v, velocity[1] + v, velocity[2] + v);
        const auto moved = [&](V speed, V f, V g) {
            return hn::Add(hn::Add(speed, hn::IfThenElseZero(is_free, hn::Mul(push, f))),
                           hn::IfThenElseZero(is_free, g));
        };
        now = {moved(now.x, force.x, fall.x), moved(now.y, force.y, fall.y), moved(now.z, force.z, fall.z)};
        store(now, velocity[0] + v, velocity[1] + v, velocity[2] + v);
        store_points_and(add(own, scaled(dt, now)), most, next + v);
    }
};

HWY_INLINE void note_zero_lengths(const SpringStep& step, uint32_t pack, V least) {
    const Floats d;
    if (HWY_LIKELY(hn::AllTrue(d, hn::Gt(least, hn::Set(d, kLeastLength))))) return;
    step.zero_lengths[pack] += count_zero_lengths(step.slots + step.first_slot[pack], step.slot_count[pack]);
}

void integrate_spring_packs(const SpringStep& given, uint32_t first_pack, uint32_t pack_count) {
    const SpringStep step = given;  // nothing that is written can be it: its numbers stay in registers
    const Floats d;
    const PackMotion motion(step);
    for (uint32_t pack = first_pack; pack < first_pack + pack_count; ++pack) {
        SpringSlot* const first = step.slots + step.first_slot[pack];
        SpringSlot* const end = first + step.slot_count[pack];
        const SpringSlot* const later = step.slots + slot_ahead(step, pack, kPacksAhead);
        V lowest = hn::Set(d, 1);
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) {
            const uint32_t v = pack * kLanes + lane;
            const V3 own = load_points(step.position + v);
            V3 force{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
            V most = hn::Set(d, -1), least = hn::Set(d, 1);
            for (SpringSlot* slot = first; slot != end; ++slot) {
                if (lane == 0) prefetch(later + (slot - first), sizeof(SpringSlot));
                const V3 x = gather(step.position, slot->neighbour + lane) - own;
                const Pull p = pull_of(x, slot->inverse_rest + lane, slot->stiffness_rest + lane, slot->damping + lane,
                                       slot->length + lane);
                force = add(force, scaled(p.scale, x));
                most = hn::Max(most, p.strain);
                least = hn::Min(least, p.length);
                hn::Store(p.length, d, slot->length + lane);
            }
            motion.move(own, force, most, hn::LoadU(d, step.inverse_mass + v), step.velocity, v, step.next_position);
            lowest = hn::Min(lowest, least);
        }
        note_zero_lengths(step, pack, lowest);
    }
}

template <bool kIsCrossed>
HWY_INLINE void integrate_pairs(const SpringStep& given, uint32_t first_pack, uint32_t pack_count) {
    const SpringStep step = given;
    const Floats d;
    const PackMotion motion(step);
    for (uint32_t pack = first_pack; pack < first_pack + pack_count; ++pack) {
        const uint32_t first = step.first_slot[pack], end = first + step.slot_count[pack];
        const uint32_t later = slot_ahead(step, pack, kPairPacksAhead);
        V lowest = hn::Set(d, 1);
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) {
            const uint32_t v = pack * kLanes + lane;
            const V3 x = load_points(step.position + v), y = load_points(step.inner_position + v);
            const V3 through = x - y;
            V3 fx{hn::Zero(d), hn::Zero(d), hn::Zero(d)}, fy = fx, shared = fx;
            V most = hn::Set(d, -1), inner_most = most, least = hn::Set(d, 1);
            for (uint32_t i = first; i != end; ++i) {
                if (lane == 0) {
                    prefetch(step.slots + later + (i - first), sizeof(SpringSlot));
                    prefetch(step.layers + later + (i - first), sizeof(LayerSlot));
                }
                SpringSlot& slot = step.slots[i];
                LayerSlot& more = step.layers[i];
                const V3 xn = gather(step.position, slot.neighbour + lane),
                         yn = gather(step.inner_position, slot.neighbour + lane);
                const V3 dx = xn - x, dy = yn - y;
                const Pull outer = pull_of(dx, slot.inverse_rest + lane, slot.stiffness_rest + lane,
                                           slot.damping + lane, slot.length + lane);
                const Pull inner = pull_of(dy, more.inverse_rest + lane, more.stiffness_rest + lane,
                                           more.damping + lane, more.length + lane);
                fx = add(fx, scaled(outer.scale, dx));
                fy = add(fy, scaled(inner.scale, dy));
                if constexpr (kIsCrossed) {
                    const V3 down = yn - x, up = xn - y;
                    fx = add(fx, scaled(pull_of(down, more.first_inverse + lane, more.first_stiffness + lane, nullptr,
                                                nullptr)
                                            .scale,
                                        down));
                    fy = add(fy, scaled(pull_of(up, more.second_inverse + lane, more.second_stiffness + lane, nullptr,
                                                nullptr)
                                            .scale,
                                        up));
                } else {
                    const V3 middle = add(dx, dy), across = add(xn - yn, through);
                    const V mid =
                        pull_of(middle, more.first_inverse + lane, more.first_stiffness + lane, nullptr, nullptr).scale;
                    const V shear = hn::Mul(load_floats(more.second_inverse + lane),
                                            hn::Sub(dot(middle, across), load_floats(more.second_stiffness + lane)));
                    fx = add(fx, scaled(hn::Sub(mid, shear), middle));
                    fy = add(fy, scaled(hn::Add(mid, shear), middle));
                    shared = add(shared, scaled(shear, across));
                }
                most = hn::Max(most, outer.strain);
                inner_most = hn::Max(inner_most, inner.strain);
                least = hn::Min(least, outer.length);
                hn::Store(outer.length, d, slot.length + lane);
                hn::Store(inner.length, d, more.length + lane);
            }
            fx = add(fx, shared), fy = add(fy, shared);
            // The internal spring: from x inward to y.
            const V length = hn::Sqrt(dot(through, through));
            const V strain = hn::Sub(hn::Mul(length, hn::LoadU(d, step.twin_inverse_rest + v)), hn::Set(d, 1));
            const V closing = hn::Sub(length, hn::LoadU(d, step.twin_length + v));
            const V pull = hn::Add(hn::Mul(hn::LoadU(d, step.twin_stiffness_rest + v), strain),
                                   hn::Mul(hn::LoadU(d, step.twin_damping + v), closing));
            const V3 inward = scaled(hn::Div(pull, hn::Max(length, hn::Set(d, kLeastLength))), through);
            fx = fx - inward, fy = add(fy, inward);
            hn::StoreU(length, d, step.twin_length + v);
            const V inverse_mass = hn::LoadU(d, step.inverse_mass + v);
            motion.move(x, fx, most, inverse_mass, step.velocity, v, step.next_position);
            motion.move(y, fy, inner_most, inverse_mass, step.inner_velocity, v, step.next_inner_position);
            lowest = hn::Min(lowest, least);
        }
        note_zero_lengths(step, pack, lowest);
    }
}

void integrate_sandwich_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count) {
    integrate_pairs<false>(step, first_pack, pack_count);
}
void integrate_crossed_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count) {
    integrate_pairs<true>(step, first_pack, pack_count);
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(integrate_spring_packs);
HWY_EXPORT(integrate_sandwich_packs);
HWY_EXPORT(integrate_crossed_packs);

void integrate_spring_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count) {
    HWY_DYNAMIC_DISPATCH(integrate_spring_packs)(step, first_pack, pack_count);
}
void integrate_sandwich_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count) {
    HWY_DYNAMIC_DISPATCH(integrate_sandwich_packs)(step, first_pack, pack_count);
}
void integrate_crossed_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count) {
    HWY_DYNAMIC_DISPATCH(integrate_crossed_packs)(step, first_pack, pack_count);
}

SpringStep::SpringStep(const SteppedView& view, uint32_t current) {
    const SteppedTables& state = view.state;
    const ShellSprings& own = view.own();
    const uint32_t packs = own.packs[view.row].first, first = view.shell.vertices().first;
    const int side = static_cast<int>(current & 1), next = 1 - side;
    first_slot = state.spring_packs.first_slot.data() + packs;
    slot_count = state.spring_packs.slot_count.data() + packs;
    zero_lengths = state.spring_packs.zero_lengths.data() + packs;
    slots = state.spring_slots.slot.data() + own.slots[view.row].first;
    inverse_mass = state.vertices.inverse_mass.data() + first;
    for (int k = 0; k < 3; ++k) velocity[k] = state.vertices.velocity.lane(k) + first;
    position = state.vertices.probe.data(side) + first;
    next_position = state.vertices.probe.data(next) + first;
    dt = own.time_step[view.row];
    gravity = own.gravity[view.row];
    pack_count = own.packs[view.row].count;
    layers = nullptr;
    if (!view.has_layers()) return;
    const uint32_t twin = own.twins[view.row].first;
    layers = state.layer_slots.slot.data() + own.layer_slots[view.row].first;
    inverse_mass = state.twins.inverse_mass.data() + twin;
    for (int k = 0; k < 3; ++k) inner_velocity[k] = state.twins.velocity.lane(k) + twin;
    inner_position = state.twins.position.data(side) + twin;
    next_inner_position = state.twins.position.data(next) + twin;
    twin_inverse_rest = state.twins.inverse_rest.data() + twin;
    twin_stiffness_rest = state.twins.stiffness_rest.data() + twin;
    twin_damping = state.twins.damping.data() + twin;
    twin_length = state.twins.length.data() + twin;
}

}  // namespace cullet
#endif
