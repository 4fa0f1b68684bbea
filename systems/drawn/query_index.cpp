#include "systems/drawn/query_index.hpp"

#include <cmath>
#include <numeric>

#include "components/body_id.hpp"
#include "engine/byte_stream.hpp"

namespace cullet {
namespace {

constexpr size_t kMostLoose = 64;

bool is_same(const Pose& a, const Pose& b) {
    const Quat p = a.orientation, q = b.orientation;
    return a.position == b.position && p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
}

// Of the box `local` at this pose; wider by what floats round away.
AxisBox turned(const AxisBox& local, const Pose& pose) {
    const Mat3 m = matrix(pose.orientation);
    const Vec3 half = 0.5f * (local.high - local.low);
    const Vec3 centre = to_world(pose, 0.5f * (local.low + local.high));
    const auto reach = [&](Vec3 row) {
        return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
    };
    Vec3 wide{reach(m.row[0]), reach(m.row[1]), reach(m.row[2])};
    const float size = std::max({std::fabs(local.low.x), std::fabs(local.high.x), std::fabs(local.low.y),
                                 std::fabs(local.high.y), std::fabs(local.low.z), std::fabs(local.high.z)});
    const Vec3 p = pose.position;
    const float rounded = 1e-6f * (size + std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)})) + 1e-7f;
    wide += Vec3{rounded, rounded, rounded};
    return {centre - wide, centre + wide};
}

}  // namespace

void StaticTriangles::measure() {
    extents.assign(corners.size(), {});
    std::vector<uint32_t> all(corners.size());
    std::iota(all.begin(), all.end(), 0u);
    for (size_t t = 0; t < corners.size(); ++t)
        for (const Vec3 p : corners[t]) extents[t].include(p);
    tree.reserve(corners.size());
    tree.build(all, extents);
}

QueryIndex::QueryIndex(uint32_t body_limit)
    : stands_(body_limit),
      extents_(body_limit),
      half_extents_(body_limit),
      triangles_(body_limit),
      is_loose_(body_limit, 0) {
    tree_.reserve(body_limit);
    there_.reserve(body_limit);
    loose_.reserve(kMostLoose);
}

void QueryIndex::set_triangles(uint32_t body, std::span<const Vec3> positions,
                               std::span<const std::array<uint32_t, 3>> triangles) {
    auto made = std::make_unique<StaticTriangles>();
    for (const auto& t : triangles) made->corners.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
    made->measure();
    triangles_[body] = std::move(made);
}

AxisBox QueryIndex::world_extent(const Bodies& bodies, uint32_t body) const {
    const Pose pose = pose_of(bodies, body);
    if (triangles_[body]) return triangles_[body]->tree.whole();
    const float r = bodies.radius[body];
    if (bodies.is_sphere[body]) return turned({{-r, -r, -r}, {r, r, r}}, {pose.position, {}});
    if (!bodies.structure[body].exists()) return turned({-half_extents_[body], half_extents_[body]}, pose);
    const auto& drawn = bodies.drawn_box[body];
    return turned({{drawn[0], drawn[1], drawn[2]}, {drawn[3], drawn[4], drawn[5]}}, pose);
}

// False when it stands as it stood.
bool QueryIndex::place(const Bodies& bodies, uint32_t body) {
    Stand& stand = stands_[body];
    const bool is_there = static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Free;
    if (!is_there) {
        triangles_[body].reset();
        return std::exchange(stand.is_there, false);
    }
    const Stand now{pose_of(bodies, body), bodies.generation[body], bodies.view_stamp[body], true};
    if (stand.is_there && stand.generation == now.generation && stand.stamp == now.stamp &&
        is_same(stand.pose, now.pose))
        return false;
    stand = now;
    extents_[body] = world_extent(bodies, body);
    return true;
}

void QueryIndex::touch(const Bodies& bodies, uint32_t body) {
    place(bodies, body);
    if (is_loose_[body]) return;
    if (loose_.size() == kMostLoose) return refresh(bodies);
    is_loose_[body] = 1;
    loose_.push_back(body);
}

void QueryIndex::shift(Vec3 by) {
    for (const auto& triangles : triangles_) {
        if (!triangles) continue;
        for (auto& corners : triangles->corners)
            for (Vec3& p : corners) p += by;
        triangles->measure();
    }
    for (Stand& stand : stands_) stand.generation = 0;  // every box is made anew
}

void QueryIndex::refresh(const Bodies& bodies) {
    bool has_changed = !loose_.empty();
    there_.clear();
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        has_changed = place(bodies, b) || has_changed;
        if (stands_[b].is_there) there_.push_back(b);
    }
    if (!has_changed) return;
    for (const uint32_t body : loose_) is_loose_[body] = 0;
    loose_.clear();
    tree_.build(there_, extents_);
}

// Triangles of what is static, boxes of what is kinematic.
void QueryIndex::save(ByteWriter& out, const Bodies& bodies) const {
    const auto put = [&](Vec3 p) { out.number(p.x), out.number(p.y), out.number(p.z); };
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind == BodyKind::Kinematic) put(half_extents_[b]);
        if (kind != BodyKind::Static) continue;
        out.number(static_cast<uint32_t>(triangles_[b] ? triangles_[b]->corners.size() : 0));
        if (!triangles_[b]) continue;
        for (const auto& corners : triangles_[b]->corners)
            for (const Vec3 p : corners) put(p);
    }
}

void QueryIndex::load(ByteReader& in, const Bodies& bodies) {
    const auto take = [&] {
        Vec3 p;
        for (float* x : {&p.x, &p.y, &p.z}) {
            *x = in.number<float>("a place");
            in.expect(std::isfinite(*x), "a place that is not finite");
        }
        return p;
    };
    for (uint32_t b = 0; b < bodies.size() && in.is_sound(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind == BodyKind::Kinematic) half_extents_[b] = take();
        if (kind != BodyKind::Static) continue;
        const uint32_t count = in.count("the number of static triangles", 36, 1u << 28);
        if (count == 0) continue;
        auto made = std::make_unique<StaticTriangles>();
        made->corners.resize(count);
        for (auto& corners : made->corners)
            for (Vec3& p : corners) p = take();
        made->measure();
        triangles_[b] = std::move(made);
    }
}

}  // namespace cullet
