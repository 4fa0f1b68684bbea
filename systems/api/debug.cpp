// Lines that show what a world sees.
#include "cullet/debug.hpp"

#include <array>

#include "components/body_id.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/hulls/hull_edges.hpp"
#include "systems/structure_calls.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr float kContactLength = 0.05f, kVelocitySeconds = 0.1f, kAxisShare = 0.25f;
constexpr uint32_t kRingLines = 24;

struct Pen {
    DebugLine line;
    void* user;
    void operator()(Vec3 from, Vec3 to, uint32_t colour) const { line(user, from, to, colour); }
};

uint32_t colour_of(const Bodies& bodies, uint32_t b) {
    if (bodies.hold_count[b]) return kDebugHeld;
    if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Static) return kDebugStatic;
    return bodies.is_asleep[b] ? kDebugAsleep : kDebugAwake;
}

void draw_box(const Pen& pen, const AxisBox& e, const Pose& pose, uint32_t colour) {
    const auto corner = [&](int k) {
        return to_world(pose, {k & 1 ? e.high.x : e.low.x, k & 2 ? e.high.y : e.low.y, k & 4 ? e.high.z : e.low.z});
    };
    for (int k = 0; k < 8; ++k)
        for (const int axis : {1, 2, 4})
            if (!(k & axis)) pen(corner(k), corner(k | axis), colour);
}

void draw_rings(const Pen& pen, Vec3 centre, float radius, uint32_t colour) {
    const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto place = [&](int ring, uint32_t k) {
        double sine = 0, cosine = 0;
        sine_cosine(6.283185307179586 / kRingLines * k, sine, cosine);
        return centre + static_cast<float>(radius * cosine) * axes[ring] +
               static_cast<float>(radius * sine) * axes[(ring + 1) % 3];
    };
    for (int ring = 0; ring < 3; ++ring)
        for (uint32_t k = 0; k < kRingLines; ++k) pen(place(ring, k), place(ring, k + 1), colour);
}

void draw_hull(const Pen& pen, std::span<const Vec3> points, const Pose& pose, uint32_t colour) {
    for (size_t a = 0; a < points.size(); ++a)
        for (size_t b = a + 1; b < points.size(); ++b)
            if (is_hull_edge(points, a, b)) pen(to_world(pose, points[a]), to_world(pose, points[b]), colour);
}

void draw_pieces(const Pen& pen, const State& state, Row<Bodies> b, uint32_t colour) {
    const Row<Structures> structure = state.bodies.structure[b];
    const Range cells = state.structures.cells[structure];
    const Pose pose = pose_of(state.bodies, b);
    std::array<Vec3, kMostCellPoints> points;
    const uint32_t whole = state.structures.shape_points[structure];
    for (uint32_t k = 0; k < whole; ++k)
        points[k] = state.hull_points.point[state.structures.points[structure].first + k];
    draw_hull(pen, {points.data(), whole}, pose, colour);
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c) {
        uint32_t from = state.structures.points[structure].first + state.cells.first_point[c];
        for (const uint8_t count : state.cells.part_points[c]) {
            for (uint32_t k = 0; k < count; ++k) points[k] = state.hull_points.point[from++];
            draw_hull(pen, {points.data(), count}, pose, colour);
        }
    }
}

void draw_shape(const Pen& pen, const WorldData& d, Row<Bodies> b, uint32_t colour) {
    const Bodies& bodies = d.state.bodies;
    const Vec3 half = d.query_index->half_extents(b);
    if (bodies.is_sphere[b]) return draw_rings(pen, bodies.position[b], bodies.radius[b], colour);
    if (bodies.structure[b].exists()) return draw_pieces(pen, d.state, b, colour);
    if (!d.query_index->triangles(b)) draw_box(pen, {-half, half}, pose_of(bodies, b), colour);
}

// Of the working copy while a hit is worked off.
void draw_cracks(const Pen& pen, const State& state, Row<Bodies> b) {
    const uint32_t task = state.bodies.task[b];
    const Row<Structures> structure = task == kNone ? state.bodies.structure[b] : state.tasks.working[task];
    if (!structure.exists()) return;
    struct InWorld {
        const Pen& pen;
        Pose pose;
    } place{pen, pose_of(state.bodies, b)};
    const auto line = [](void* user, Vec3 from, Vec3 to) {
        const auto& in = *static_cast<const InWorld*>(user);
        in.pen(to_world(in.pose, from), to_world(in.pose, to), kDebugCrack);
    };
    calls_of(state.structures, structure).show_cracks(state, structure, line, &place);
}

void draw_axes(const Pen& pen, const Bodies& bodies, Row<Bodies> b) {
    const float reach = kAxisShare * bodies.radius[b];
    const Vec3 centre = centre_of(bodies, b), axes[3] = {{reach, 0, 0}, {0, reach, 0}, {0, 0, reach}};
    for (int k = 0; k < 3; ++k) pen(centre, centre + rotate(bodies.orientation[b], axes[k]), 0xff0000u >> (8 * k));
}

}  // namespace

void draw_debug(const World& world, uint32_t flags, DebugLine line, void* user) {
    const WorldData& d = world.contents().data;
    const Bodies& bodies = d.state.bodies;
    if (!line) return;
    const Pen pen{line, user};
    for (uint32_t row = 0; row < bodies.size(); ++row) {
        const Row<Bodies> b(row);
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind == BodyKind::Free) continue;
        const uint32_t colour = colour_of(bodies, b);
        if (flags & kDebugBounds) draw_box(pen, d.query_index->extent(b), {}, colour);
        if (flags & kDebugHulls) draw_shape(pen, d, b, colour);
        if (flags & kDebugCracks) draw_cracks(pen, d.state, b);
        if (kind == BodyKind::Static) continue;
        if (flags & kDebugCentres) draw_axes(pen, bodies, b);
        if (!(flags & kDebugVelocities) || bodies.velocity[b] == Vec3{}) continue;
        const Vec3 centre = centre_of(bodies, b);
        pen(centre, centre + kVelocitySeconds * bodies.velocity[b], kDebugVelocity);
    }
    if (flags & kDebugContacts)
        for (const RigidContact& c : d.rigid->contacts())
            pen(c.point, c.point + kContactLength * c.normal, kDebugContact);
}

}  // namespace cullet
