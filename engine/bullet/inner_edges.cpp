#include "engine/bullet/inner_edges.hpp"

#include <algorithm>
#include <array>

#include "engine/bullet/closest_points.hpp"

namespace cullet::bullet {
namespace {

// What is within this of a touch lies beside it, and steps lower than this are none. At five times it kerbs of some
// millimetres are lost, at a fifth tiles that were set by hand have edges again.
// A normal within a twentieth of a degree of a face's is that face's, and a neighbour that rises by less in the
// direction of a normal does not lie in its way. At one degree balls at 20 m/s hop by a centimetre.
constexpr float kFacing = 0.9999996f, kNearlyFacing = 0.99f;
constexpr float kRise = 0.001f;
// A neighbour covers a face that it goes on before: within 60 degrees of the face's normal. Its own surface then leads
// past the face: faces of it that look the same way or against it, within 45 degrees, are no surface to come out of.
constexpr float kBefore = 0.5f;
constexpr float kAlong = 0.7f;
constexpr float kGoesOn = 0.97f;   // cosine of faces of a piece that are one surface, or nearly
constexpr float kBehind = 0.005f;  // m, of scale 1
constexpr float kLevel = 0.9998f;  // cosine of planes that are one
constexpr int kTurns = 3;          // of a direction into a cone
constexpr int kFaces = 4;          // looked at until one is open
// A place on an edge is as exact as its coordinates.
float on_edge(Vec3 place) {
    return 1e-5f + 1e-6f * std::max({std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)});
}

// At a rounded edge the surface lies this much below the plane of a side of it: the place is `margin` along `direction`
// from the core, also where that leads away from the side. Without this, the end of a kerb's piece is inner where the
// next one begins, and the corner of a pane whose cells meet there.
float below_plane(float margin, Vec3 side, Vec3 direction, bool is_firm) {
    const float along = dot(side, direction);
    return margin * (1 - (is_firm ? std::max(0.0f, along) : along));
}

/// A place and a direction in the axes of a hull, from its centre.
struct Local {
    Vec3 place, direction;
    Local(const Body& body, const Hull& hull, Vec3 at, Vec3 along) {
        if (hull.one_sided) {
            place = at - hull.local.centre, direction = along;
            return;
        }
        const Mat3 rotation = rotation_of(body.fresh_at);
        place = transposed_times(rotation, at - from_bullet(body.fresh_at.getOrigin())) - hull.local.centre;
        direction = transposed_times(rotation, along);
    }
};

/// Planes that bound a neighbour near a place: unit normals out of it.
struct Bounds {
    Vec3 out[kMaxFaces];
    uint32_t count = 0;
};

// How far `direction` leads into the cone that the planes leave open: its cosine to the nearest direction in there that
// a few turns find. 0: it leads out, or along the rim.
float leads_in(const Bounds& bounds, Vec3 direction) {
    Vec3 way = direction;
    for (int turn = 0; turn < kTurns; ++turn)
        for (uint32_t k = 0; k < bounds.count; ++k) way = way - std::max(0.0f, dot(way, bounds.out[k])) * bounds.out[k];
    const float size = length(way);
    if (!(size > 1e-4f)) return 0;
    for (uint32_t k = 0; k < bounds.count; ++k)
        if (dot(way, bounds.out[k]) > 0.01f * size) return 0;
    return dot(way, direction) / size;
}

/// What a neighbour is at a place.
struct Beside {
    bool is_near = false;
    float leads_in = 0;      // cosine, of the direction in question
    bool is_level = false;   // it has that plane there
    bool is_before = false;  // the place lies beneath a face of it that looks along the direction
    bool has_way_out = false;
    Vec3 way_out;  // world: to the neighbour's surface and kFlush past it (of the touch's scale)
};

/// Where it is looked for, of what was touched there.
struct Reach {
    float flush, margin;  // m
    bool is_firm;
    Vec3 level;            // of what moves: the plane that is to go on in the neighbour, in world axes
    bool is_wide = false;  // planes bound a neighbour as far as they are flush with the place
    float most() const { return flush + margin; }
};

Beside look_at(const Body& body, const Hull& hull, Vec3 place, Vec3 direction, Reach reach) {
    if (hull.face_count < 4) return {};  // what is flat has no sides to tell where it ends
    const Local at(body, hull, place, direction);
    const float edge = reach.is_wide ? reach.flush : on_edge(place);
    const Vec3 level = transposed_times(rotation_of(body.fresh_at), reach.level);
    Bounds bounds;
    Beside beside;
    float highest = -kFar;
    uint32_t out = 0;
    bool has_face_along = false, is_flush = false;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const Vec3 normal = hull.face_normal[f];
        if (!(dot(normal, normal) > 0.5f)) continue;
        const float height = dot(normal, at.place) - hull.face_height[f] - hull.margin;
        if (height > reach.most()) return {};
        const float below = below_plane(reach.margin, normal, at.direction, reach.is_firm);
        if (height > -edge - below) bounds.out[bounds.count++] = normal;
        if (dot(normal, level) > kLevel && height > -reach.flush - below) beside.is_level = true;
        if (dot(normal, at.direction) >= kAlong) {
            has_face_along = true;
            is_flush |= height > -reach.flush - below;
        }
        if (height > highest && std::fabs(dot(normal, at.direction)) < kAlong)
            highest = height, out = f, beside.has_way_out = true;
    }
    beside.is_near = true;
    beside.leads_in = leads_in(bounds, at.direction);
    beside.is_before = bounds.count == 0 && has_face_along && !is_flush;
    if (beside.has_way_out)
        beside.way_out =
            (std::max(0.0f, -highest) + reach.flush) * (rotation_of(body.fresh_at) * hull.face_normal[out]);
    return beside;
}

// `seen_from` lies on the side of the triangle that is out.
Beside look_at(const StaticTriangle& triangle, Vec3 place, Vec3 direction, Reach reach, Vec3 seen_from) {
    const Vec3* c = triangle.corner;
    const Vec3d across = cross(Vec3d(c[1]) - Vec3d(c[0]), Vec3d(c[2]) - Vec3d(c[0]));
    const Vec3 normal = normalised(across).to_float();
    const float height = dot(normal, place - c[0]), edge = on_edge(place);
    if (!(std::fabs(height) <= reach.most())) return {};
    Bounds bounds;
    for (int k = 0; k < 3; ++k) {
        const Vec3 outwards = normalised(cross(c[(k + 1) % 3] - c[k], normal));
        const float past = dot(outwards, place - c[k]);
        if (!(past <= reach.most())) return {};
        // Beside the triangle, and on the way from it: it goes on somewhere else. (At the top of a kerb that was cut
        // into triangles the slant of one, a quarter of a millimetre below a ball's touch, took it away.)
        if (past > edge && dot(outwards, direction) > 0) return {};
        if (past > -edge - below_plane(reach.margin, outwards, direction, reach.is_firm))
            bounds.out[bounds.count++] = outwards;
    }
    Beside beside;
    beside.is_near = true;
    // In its plane, whichever side the direction is on.
    const float up = dot(normal, direction);
    const Vec3 flat = direction - up * normal;
    const float size = length(flat);
    if (size > 1e-3f) beside.leads_in = size * leads_in(bounds, (1 / size) * flat);
    if (std::fabs(up) < kAlong) {
        const float side = dot(normal, seen_from - c[0]) < 0 ? -1.0f : 1.0f;
        beside.has_way_out = true;
        beside.way_out = (std::max(0.0f, -side * height) + reach.flush) * (side * normal);
    }
    return beside;
}

bool are_same(const StaticTriangle& triangle, const Hull& hull) {
    const Points& p = hull.world;
    for (int k = 0; k < 3; ++k) {
        const Vec3 d = triangle.corner[k] - (p.centre + p[static_cast<uint32_t>(k)]);
        if (dot(d, d) > 0) return false;
    }
    return true;
}

Vec3 velocity_at(const Body& body, Vec3 place) {
    if (body.kind == RigidKind::Static) return {};
    const Vec3 from = place - from_bullet(body.bullet->getCenterOfMassPosition());
    return from_bullet(body.bullet->getLinearVelocity()) + cross(from_bullet(body.bullet->getAngularVelocity()), from);
}

// What is beside rises and sinks with what is touched, and does not come towards it: the two are as one surface. Past
// each other they may go, as a turntable in its floor.
bool moves_along(const Body& beside, const Body& touched, Vec3 place, Vec3 direction, const Beside& there) {
    if (beside.kind == RigidKind::Static && touched.kind == RigidKind::Static) return true;
    const Vec3 apart = velocity_at(touched, place) - velocity_at(beside, place);
    if (dot(apart, direction) > kAsOne) return false;
    const Vec3 up = there.has_way_out ? normalised(there.way_out) : direction;
    return std::fabs(dot(apart, up)) < kAsOne;
}

/// Calls found(beside) for what is near the place, until it says true; whether it did.
template <class Found>
bool any_beside(const Surroundings& around, const Touched& touched, Vec3 place, Vec3 direction, Found found,
                Vec3 level = {}, bool is_wide = false) {
    const Reach reach{kFlush * scale_of(touched.hull, touched.piece), touched.hull.margin, is_firm(touched.body), level,
                      is_wide};
    const Box box = grown({place, place}, reach.most());
    bool is_any = false;
    const auto is_one = [&](const Body& body, const Beside& beside) {
        return &body == &touched.body || moves_along(body, touched.body, place, direction, beside);
    };
    const auto look_in = [&](const Body& body) {
        for (const Hull* hull = body.hulls; hull && !is_any; hull = hull->next) {
            if (hull == &touched.hull || !overlap(hull->world_box, box, 0)) continue;
            const Beside beside = look_at(body, *hull, place, direction, reach);
            is_any = beside.is_near && is_one(body, beside) && found(beside);
        }
        if (!body.mesh || is_any) return;
        const Vec3 seen_from = touched.points.centre;
        visit_triangles(*body.mesh, box, [&](uint32_t t) {
            const StaticTriangle& triangle = body.mesh->triangles[t];
            if (is_any || (touched.hull.one_sided && &body == &touched.body && are_same(triangle, touched.hull)))
                return;
            const Beside beside = look_at(triangle, place, direction, reach, seen_from);
            is_any = beside.is_near && is_one(body, beside) && found(beside);
        });
    };
    look_in(touched.body);
    if (is_any || !is_firm(touched.body)) return is_any;
    around.tree->visit(box, [&](uint32_t id) {
        const Body& body = around.bodies[id];
        if (is_any || &body == &touched.body) return;
        if (!body.is_used || body.is_soft || !body.meets_layer_of(touched.other)) return;
        if (overlap(body.shape.box, box, 0)) look_in(body);
    });
    return is_any;
}

// Is the place on the face `face` of the hull, or over it?
bool is_on_face(const Body& body, const Hull& hull, uint32_t face, Vec3 place, float flush) {
    const Local at(body, hull, place, {});
    if (hull.one_sided) {
        const Vec3 normal = hull.is_turned ? -hull.face_normal[0] : hull.face_normal[0];
        for (uint32_t k = 0; k < 3; ++k) {
            const Vec3 from = hull.local[k], along = hull.local[(k + 1) % 3] - from;
            if (dot(normalised(cross(along, normal)), at.place - from) > on_edge(place)) return false;
        }
        return true;
    }
    // What looks about the same way goes on where the face ends.
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const bool goes_on = is_firm(body) && dot(hull.face_normal[f], hull.face_normal[face]) > kGoesOn;
        const float beyond = hull.margin + (goes_on ? flush : on_edge(place));
        if (f != face && dot(hull.face_normal[f], at.place) > hull.face_height[f] + beyond) return false;
    }
    return true;
}

Vec3 out_of_face(const Body& body, const Hull& hull, uint32_t face) {
    return hull.one_sided ? hull.face_normal[0] : rotation_of(body.fresh_at) * hull.face_normal[face];
}

/// What neighbours do to a face at a place.
struct Cover {
    bool is_whole = false;   // one goes on before the face, and nothing of the face stands out of that there
    bool is_in_way = false;  // one rises before it, if only a little
};

// A neighbour that covers the face is in its way as well, so that it does not matter which of them is met first.
Cover cover_of(const Surroundings& around, const Touched& touched, uint32_t face, Vec3 normal, Vec3 place,
               Vec3 level = {}) {
    const float flush = kFlush * scale_of(touched.hull, touched.piece);
    Cover cover;
    const auto covers = [&](const Beside& beside) {
        cover.is_in_way |= beside.leads_in > kRise;
        if (beside.is_before && is_firm(touched.body)) return true;
        if (beside.leads_in < kBefore || !beside.has_way_out) return false;
        if (!is_firm(touched.body) && !beside.is_level) return false;
        return !is_on_face(touched.body, touched.hull, face, place + beside.way_out, flush);
    };
    cover.is_whole = any_beside(around, touched, place, normal, covers, level);
    return cover;
}

bool is_face_covered(const Surroundings& around, const Touched& touched, uint32_t face, Vec3 normal, Vec3 place,
                     Vec3 level = {}) {
    return cover_of(around, touched, face, normal, place, level).is_whole;
}

// How far any neighbour at the place lies in the way of a normal, see Beside::leads_in.
float most_in_the_way(const Surroundings& around, const Touched& touched, Vec3 normal, Vec3 place) {
    float most = 0;
    any_beside(
        around, touched, place, normal,
        [&most](const Beside& beside) {
            most = std::max(most, beside.leads_in);
            return false;
        },
        {}, true);
    return most;
}

struct Facing {
    uint32_t face = 0;
    float cosine = -kFar;
    Vec3 normal;
};

Facing facing_face(const Touched& touched, Vec3 normal) {
    Facing best;
    for (uint32_t f = 0; f < touched.hull.face_count; ++f) {
        const Vec3 out = out_of_face(touched.body, touched.hull, f);
        const float cosine = dot(out, normal);
        if (cosine > best.cosine) best = {f, cosine, out};
    }
    return best;
}

// The open face that the piece lies deepest behind or nearest before. A place on the rounding of an edge lies beneath
// the planes of the faces that end there, and aside of them: each face is looked at from where it begins, `margin`
// along its normal from the place in the core. From the rounding itself, at a corner of four cells of a shell, each
// cell lay beneath another one, and none of them pushed. Of faces that are as good as equally far the one with the
// least of neighbours in its way: past the edge of a cell of a hollow slab a side may lean out by ten degrees, and lie
// beneath the next cell all but there. A ball at 6 m/s hopped by 28 mm from it.
bool find_open_face_from(const Surroundings& around, const Touched& touched, Vec3 core, float margin, Vec3& normal) {
    const Hull& hull = touched.hull;
    std::array<double, kMaxFaces> gap;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const Vec3 out = out_of_face(touched.body, hull, f);
        const bool is_sound = dot(out, out) > 0.5f && !hull.is_face_inner[f];
        gap[f] = is_sound ? gap_along(touched.points, hull.world, Vec3d(out)) : -1e30;
    }
    const double as_far = 2 * static_cast<double>(kFlush * scale_of(hull, touched.piece));
    double first_gap = 0;
    float least = kFar;  // it is not asked before there is a choice
    bool is_any = false;
    Vec3 place;  // on the face that `normal` is of
    for (int k = 0; k < kFaces; ++k) {
        const auto most = std::max_element(gap.begin(), gap.begin() + hull.face_count);
        if (most == gap.begin() + hull.face_count || *most <= -1e30) break;
        if (is_any && *most < first_gap - as_far) break;
        if (is_any && !(least < kFar)) least = most_in_the_way(around, touched, normal, place);
        if (!(least > kRise)) break;
        const auto face = static_cast<uint32_t>(most - gap.begin());
        const Vec3 out = out_of_face(touched.body, hull, face), at = core + margin * out;
        if (!is_face_covered(around, touched, face, out, at)) {
            const float leads = is_any ? most_in_the_way(around, touched, out, at) : kFar;
            if (!is_any) first_gap = *most;
            if (!is_any || leads < least) least = leads, normal = out, place = at;
            is_any = true;
        }
        *most = -1e30;
    }
    return is_any;
}

}  // namespace

bool find_open_face(const Surroundings& around, const Touched& touched, Vec3 place, Vec3& normal) {
    return find_open_face_from(around, touched, place, 0, normal);
}

namespace {

// Of the faces that go on in a neighbour's the one that looks most along the normal, if the place is on it.
bool find_flush_face(const Touched& touched, Vec3 place, Vec3& normal) {
    const Hull& hull = touched.hull;
    const Local at(touched.body, hull, place, normal);
    const float flush = kFlush * scale_of(hull, touched.piece);
    float most = -kFar;
    uint32_t best = 0;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        if (!(hull.flush >> f & 1) || hull.is_face_inner[f]) continue;
        const float along = dot(hull.face_normal[f], at.direction),
                    height = dot(hull.face_normal[f], at.place) - hull.face_height[f] - hull.margin;
        if (height < -flush - below_plane(hull.margin, hull.face_normal[f], at.direction, false)) continue;
        if (along > most) most = along, best = f;
    }
    if (most <= -kFar) return false;
    normal = rotation_of(touched.body.fresh_at) * hull.face_normal[best];
    return true;
}

// A face of what is firm pushes, whatever edge of what moves lies on it.
bool is_firm_face(const Touched& touched, Vec3 normal) {
    if (!is_firm(touched.other)) return false;
    for (uint32_t f = 0; f < touched.piece.face_count; ++f)
        if (!touched.piece.is_face_inner[f] && dot(out_of_face(touched.other, touched.piece, f), normal) > kFacing)
            return true;
    return false;
}

// Of what moves its own pieces alone count, and edges between faces in one plane.
Push turn_to_flush_face(const Surroundings& around, const Touched& touched, std::span<const Vec3> places,
                        Vec3& normal) {
    const Facing facing = facing_face(touched, normal);
    const Vec3 wanted = normal;
    Vec3 open = normal;
    if (!find_flush_face(touched, places[0], open)) return Push::AsFound;
    // What reaches far behind that face did not come over it: a vase's foot of many facets stands on a floor.
    const double gap = gap_along(touched.points, touched.hull.world, Vec3d(open));
    if (gap < -static_cast<double>(kBehind * scale_of(touched.hull, touched.piece))) return Push::AsFound;
    // It lies on a face that no other goes on, beside the open one: a pane was held by a seam below it as by its own
    // side.
    const bool is_own_face = touched.hull.covered[facing.face] == 0 && !(touched.hull.flush >> facing.face & 1);
    if (facing.cosine > kNearlyFacing && is_own_face) return Push::AsFound;
    if (facing.cosine > kFacing) {
        if (touched.hull.covered[facing.face] == 0) return Push::AsFound;
        for (const Vec3 place : places)
            if (!is_face_covered(around, touched, facing.face, wanted, place, open)) return Push::AsFound;
    } else if (is_firm_face(touched, -1 * wanted) ||
               !any_beside(
                   around, touched, places[0], wanted,
                   [](const Beside& beside) { return beside.is_level && beside.leads_in > kRise; }, open)) {
        return Push::AsFound;
    }
    normal = open;
    return Push::Turned;
}

// Of a triangle that is touched along another direction than its own, the place on the edge that is touched: what else
// of it lies near the other piece is farther back.
Vec3 touched_place(const Touched& touched, std::span<const Vec3> places, Vec3 normal) {
    if (!touched.hull.one_sided) return places[0];
    return *std::max_element(places.begin(), places.end(), [normal](Vec3 p, Vec3 q) { return dot(p - q, normal) < 0; });
}

// Another face looks about the same way: the piece is no box.
bool has_face_beside(const Hull& hull, uint32_t face) {
    for (uint32_t f = 0; f < hull.face_count; ++f)
        if (f != face && !hull.is_face_inner[f] && dot(hull.face_normal[f], hull.face_normal[face]) > kBefore)
            return true;
    return false;
}

}  // namespace

Push turn_to_open_face(const Surroundings& around, const Touched& touched, std::span<const Vec3> places, Vec3& normal) {
    if (touched.hull.face_count == 0 || places.empty()) return Push::AsFound;
    if (!is_firm(touched.body)) return turn_to_flush_face(around, touched, places, normal);
    const Facing facing = facing_face(touched, normal);
    const Vec3 wanted = normal, touch = touched_place(touched, places, normal);
    if (facing.cosine > kFacing) {
        bool is_open = false, is_in_way = false;
        for (size_t k = 0; k < places.size() && !is_open; ++k) {
            const Cover cover = cover_of(around, touched, facing.face, wanted, places[k]);
            is_open = !cover.is_whole;
            if (k == 0) is_in_way = cover.is_in_way;
        }
        if (is_open && !(is_in_way && has_face_beside(touched.hull, facing.face))) return Push::AsFound;
        if (touched.hull.one_sided) return Push::None;
    } else if (!any_beside(around, touched, touch, wanted,
                           [](const Beside& beside) { return beside.leads_in > kRise; })) {
        return Push::AsFound;
    }
    const Vec3 core = touch - touched.hull.margin * wanted;
    if (!find_open_face_from(around, touched, core, touched.hull.margin, normal)) return Push::None;
    return dot(normal, wanted) > kFacing ? Push::AsFound : Push::Turned;
}

}  // namespace cullet::bullet
