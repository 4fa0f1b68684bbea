// What the two layouts of the hidden step share, included once a target after foreach_target.h.
#if defined(CULLET_PACK_STEP_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CULLET_PACK_STEP_INL_HPP
#undef CULLET_PACK_STEP_INL_HPP
#else
#define CULLET_PACK_STEP_INL_HPP
#endif

#include "systems/models/thick_shell/hidden/integrate_packs.hpp"
#include "systems/models/thick_shell/springs/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

inline constexpr uint32_t kPacksAhead = 1;  // 3 to 4 KB

/// v += dt f / m, u += dt v, next w = u + beta v, for vertices v to v + kStep.
HWY_INLINE void advance(const HiddenStep& step, uint32_t v, V3 force) {
    const Floats d;
    const V dt = hn::Set(d, step.dt);
    V3 velocity = load(step.v[0] + v, step.v[1] + v, step.v[2] + v);
    velocity = add(velocity, scaled(hn::Mul(dt, hn::LoadU(d, step.inverse_mass + v)), force));
    store(velocity, step.v[0] + v, step.v[1] + v, step.v[2] + v);
    V3 u = load(step.u[0] + v, step.u[1] + v, step.u[2] + v);
    u = add(u, scaled(dt, velocity));
    store(u, step.u[0] + v, step.u[1] + v, step.u[2] + v);
    store_points(add(u, scaled(hn::Set(d, step.beta), velocity)), step.next_probe + v);
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();
#endif
