#include "systems/models/thick_shell/quick/run_on.hpp"

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/heading.hpp"
#include "systems/models/thick_shell/hidden/join.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr uint64_t kBumpSeed = 0x62756d70;
/// Cosine of the largest turn from a crack's way to the edge that it takes next (C4: a forward component of 0.3).
constexpr float kForward = 0.3f;
/// Of the way along the crack, over the straight one: it may go round a body, but not on for ever.
constexpr float kMostWay = 4;
constexpr float kFarEnough = 1e-4f;  // of a length: sums of floats
/// Cosine of how far the plane may leave the crack's way before it is laid along it again: 40 degrees.
constexpr float kPlaneCosine = 0.77f;

/// Turned about the unit vector `axis`.
Vec3 turn(Vec3 v, Vec3 axis, double angle) {
    double sine = 0, cosine = 1;
    sine_cosine(angle, sine, cosine);
    const auto s = static_cast<float>(sine), c = static_cast<float>(cosine);
    return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

/// The plane in which the crack goes on; 0: it ends here. `ahead` and `up` are unit vectors, the way and the normal
/// here.
Vec3 next_plane(const Splitting& s, uint32_t tip, Vec3 start, Vec3 ahead, Vec3 up, Vec3& normal) {
    const uint32_t other = find_crack_ahead(s.shell(), tip, ahead, s.shell().shells().mean_edge[s.shell().row]);
    if (other != kNone) {
        const Vec3 goal = into_plane(s.rest(other) - s.rest(tip), up);
        if (dot(goal, goal) > 0) return cross(up, goal);
    }
    if (length(s.rest(tip) - start) > s.run_length) return {};
    const Vec3 along = cross(normal, up);
    const float l = length(along);
    if (!(std::fabs(dot(along, ahead)) > kPlaneCosine * l) || !(l > kForward)) normal = cross(up, ahead);
    const double bump = s.bump_angle * (2 * Random{kBumpSeed}.uniform(tip, s.step) - 1);
    return turn(normal, up, bump);
}

}  // namespace

void run_on(Splitting& s, uint32_t tip, Vec3 way, Vec3 normal, uint32_t root) {
    Vertices& vertices = s.state().vertices;
    const Vec3 start = s.rest(tip);
    float left = kMostWay * s.run_length;
    const uint32_t most = s.kind == FractureKind::Large ? kNone : kCoarseRunSteps;
    for (uint32_t steps = 0; left > 0 && steps < most && !s.is_full; ++steps) {
        Ring ring;
        walk_ring(s.shell(), tip, ring);
        if (ring.count < 2 || ring.is_closed) return;
        const Vec3 up = ring_normal(s.shell(), ring), ahead = into_plane(way, up);
        if (!(dot(ahead, ahead) > 0)) return;
        const Vec3 plane = next_plane(s, tip, start, ahead, up, normal);
        if (!(dot(plane, plane) > 0)) return;
        const uint32_t first_copy = s.shell().vertex_count();
        const Split split = split_along(s, tip, plane, root);
        if (!split.is_cut) return;
        vertices.crack_start[s.row(tip)] = root;
        // Cracks that start beside a long one would make slivers of it.
        if (s.kind == FractureKind::Large) close_neighbours(s, tip, split.ends, first_copy);
        if (s.touched.is_enough()) flush(s);
        const uint32_t end = split.ends.end[0];
        const Vec3 along = s.rest(end) - s.rest(tip);
        const float l = length(along);
        if (!split.ends.is_interior[0] || dot(along, ahead) < kForward * l) return;
        left -= std::max(l, kFarEnough * s.run_length);
        way = along;
        tip = end;
    }
}

}  // namespace cullet
