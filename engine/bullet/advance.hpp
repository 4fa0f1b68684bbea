// Conservative advancement (Mirtich 1996): how far two pieces may move along their motions before they touch, over axes
// whose gap is measured from support points. Never late.
#pragma once
#include <LinearMath/btTransformUtil.h>

#include <algorithm>

#include "engine/bullet/pair_algorithm.hpp"

namespace cullet::bullet {

/// A body's motion through one step, from where it stands now.
struct Mover {
    Body* body;
    btTransform start;
    Vec3d velocity, spin;

    btTransform at(double fraction, float dt) const {
        const auto f = static_cast<float>(std::min(fraction, static_cast<double>(body->moved_fraction)));
        if (!(f > 0) || !is_moving()) return start;
        btTransform out;
        btTransformUtil::integrateTransform(start, to_bullet(velocity.to_float()), to_bullet(spin.to_float()), f * dt,
                                            out);
        return out;
    }
    bool is_moving() const { return dot(velocity, velocity) + dot(spin, spin) > 0; }
};

/// At rest, unless the body is free or driven. With what it glances along.
Mover mover_of(Body& body);

/// How far turning takes a point `reach` away from the centre of mass, at most, m.
float turned(const Mover& mover, float reach, float dt);
void include_way(Box& out, const Box& box, Vec3d velocity, float dt);
/// What a box sweeps over in the world: moved by the velocity, grown by what turning can do to points `reach` away from
/// the centre of mass.
Box swept_box(const Box& box, const Mover& mover, float reach, float dt);
/// Both were stopped in this step, at different times: one stands still while the other moves on. Where only one is
/// fast the other's way hardly counts.
bool are_split(const Body& a, const Body& b);
/// Two bodies are swept against each other when a point may travel farther than contacts reach plus a tenth of the
/// least width of both: less than that, the overlap is small and pushed out on the right side.
bool is_far(double way, float scale, float thickness);
/// Of the point that goes farthest, m.
double travel(const Mover& mover, float dt);
/// Of a piece's farthest point from the centre of mass, at most, m.
float reach_of(const Body& body, const Hull& hull);

/// The axes of the contacts that the pieces of two bodies have.
struct KnownAxes {
    const PairAlgorithm* pair = nullptr;  // null: they do not touch
    bool is_turned = false;               // the first body is the pair's second one
    /// From b towards a; zero for pieces that do not touch.
    Vec3d of(const Hull& a, const Hull& b) const;
    /// They lie in each other since birth: contacts at their crack keep them from going deeper.
    bool at_crack(const Hull& a, const Hull& b) const;
};

/// The fraction of the step at which the two pieces come within half a millimetre (lengths are those of scale 1);
/// `limit` when they do not before it. World points are those of the start; `axis` is a first guess, such as the last
/// one of the same two bodies. Pieces that touch already may go a millimetre deeper, of two free bodies a tenth of the
/// thinner one's width, lively ones in all a third of it, along the axis that `known` has for them. What comes to an
/// edge inside of something flat goes on as if it touched the open face there, and what glides over a face as if it had
/// touched it before.
double touch_fraction(const Surroundings& around, const Mover& a, const Hull& hull_a, const Mover& b,
                      const Hull& hull_b, float dt, double limit, Vec3d& axis, const KnownAxes& known = {});

/// How much a box is grown beyond what it sweeps over, m.
inline constexpr float kBoxGrowth = 0.01f;

}  // namespace cullet::bullet
