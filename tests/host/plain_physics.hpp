// A host's own physics: corners of convex pieces on a floor at y = 0, impulses at points, semi-implicit Euler.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <vector>

#include "cullet/world.hpp"

namespace plain {

using namespace cullet;
using Eigen::Map, Eigen::Vector3f;

inline Map<Vector3f> at(Vec3& v) {
    return Map<Vector3f>(&v.x);
}

struct Thing {
    HostShape shape;                          // with its pose and motion of now
    std::vector<Vector3f> corners;            // of its pieces, body axes, from the centre of mass
    bool is_held = false, is_passed = false;  // passed: what it met has had the blow of this step
    Map<Eigen::Quaternionf> turn() { return Map<Eigen::Quaternionf>(&shape.pose.orientation.x); }
    Vector3f offset() { return turn() * Map<Eigen::Vector3d>(shape.centre).cast<float>(); }
    Vector3f velocity(Vector3f arm) { return at(shape.motion.velocity) + at(shape.motion.angular_velocity).cross(arm); }

    // Adds `change` to the speed along `way` at `arm` from the centre, by an impulse of 0 to `most`, which it gives.
    float push(Vector3f arm, Vector3f way, float change, float most) {
        const double* i = shape.inertia;
        const Eigen::Matrix3d inertia{{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}};
        const Vector3f spin =
            turn() * (inertia.inverse().cast<float>() * (turn().inverse() * arm.cross(way)));  // by 1 N s
        const float mass = static_cast<float>(shape.mass), loose = 1 / mass + spin.cross(arm).dot(way);
        const float impulse = std::clamp(change / loose, 0.0f, most);
        at(shape.motion.velocity) += impulse / mass * way, at(shape.motion.angular_velocity) += impulse * spin;
        return impulse;
    }
};

struct Physics {
    BodyId floor;
    std::map<uint32_t, Thing> things;  // by BodyId::index

    Result<void> step(World& world, float dt, Vec3 gravity) {
        std::vector<HostBody> bodies;
        std::vector<HostContact> contacts;  // what touches the floor, or will within this step
        for (auto& [index, t] : things) {
            bodies.push_back({t.shape.body, t.shape.pose, t.shape.motion});
            for (const Vector3f& corner : t.corners) {
                const Vector3f arm = t.turn() * corner, p = at(t.shape.pose.position) + t.offset() + arm;
                const float gap = p.y() - t.shape.margin;
                if (gap + dt * std::min(t.velocity(arm).y(), 0.0f) < 0.005f)
                    contacts.push_back({t.shape.body, floor, {p.x(), p.y(), p.z()}, {0, 1, 0}, gap});
            }
        }
        const Result<void> done = world.step({bodies.data(), static_cast<uint32_t>(bodies.size()), contacts.data(),
                                              static_cast<uint32_t>(contacts.size())});
        if (done) apply(world.host_changes());
        std::erase_if(contacts, [&](const HostContact& c) {
            return !things.count(c.a.index) || things[c.a.index].is_held || things[c.a.index].is_passed;
        });
        for (auto& [index, t] : things)
            if (!t.is_held) at(t.shape.motion.velocity) += dt * at(gravity);
        for (int iteration = 0; iteration < 20; ++iteration)
            for (HostContact& c : contacts) solve(things.at(c.a.index), c, dt);
        for (auto& [index, t] : things) {
            t.is_passed = false;
            if (t.is_held) continue;
            const Vector3f spin = at(t.shape.motion.angular_velocity), before = t.offset();
            t.turn() = Eigen::AngleAxisf(dt * spin.norm(), spin.stableNormalized()) * t.turn();
            at(t.shape.pose.position) += dt * at(t.shape.motion.velocity) + before - t.offset();
            at(t.shape.motion.angular_velocity) *= 1 - dt;  // air
        }
        return done;
    }

    void apply(const HostChanges& changes) {
        for (const BodyId id : changes.removed) things.erase(id.index);
        for (const auto& list : {changes.born, changes.reshaped})
            for (const HostShape& s : list) {
                Thing& t = things[s.body.index] = {s, {}, false, true};
                for (uint32_t k = 0; k < s.piece_count; ++k)
                    for (uint32_t p = 0; p < s.pieces[k].point_count; ++p)
                        t.corners.push_back(Vector3f(&s.pieces[k].points[p].x) -
                                            Eigen::Vector3d(s.centre).cast<float>());
            }
        for (const BodyId id : changes.held) things.at(id.index).is_held = true;
        for (const HostMotion& m : changes.released) things.at(m.body.index).is_held = false;
        for (const auto& list : {changes.released, changes.moved})
            for (const HostMotion& m : list)
                things.at(m.body.index).shape.pose = m.pose, things.at(m.body.index).shape.motion = m.motion;
        for (const HostPair& pair : changes.apart)
            things.at((pair.b == floor ? pair.a : pair.b).index).is_passed = true;
    }

    // No corner goes through the floor within this step; and Coulomb's friction.
    static void solve(Thing& t, HostContact& c, float dt) {
        const Vector3f arm = at(c.point) - at(t.shape.pose.position) - t.offset(), v = t.velocity(arm);
        const float wanted = c.distance > 0 ? -c.distance / dt : std::min(-0.1f * c.distance / dt, 0.2f);
        const float pushed = t.push(arm, Vector3f::UnitY(), wanted - v.y(), 1e9f);
        const Vector3f sliding{v.x(), 0, v.z()};
        t.push(arm, -sliding.stableNormalized(), sliding.norm(), t.shape.friction * pushed);
    }
};

}  // namespace plain
