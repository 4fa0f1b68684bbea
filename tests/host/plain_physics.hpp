// A host's own physics: convex pieces on a floor at y = 0, semi-implicit Euler, impulses at points.
#pragma once
#include <algorithm>
#include <vector>

#include "cullet/world.hpp"
#include "tests/host/vectors.hpp"

namespace plain {

using namespace cullet;

struct Thing {
    HostShape shape;  // with its pose and motion of now
    std::vector<Vec3> points;
    bool is_held = false;
    bool is_free() const { return !is_held && !shape.is_static; }
};
struct Touch {
    BodyId body;
    Vec3 arm;  // from the centre of mass
    float distance, pushed;
};

struct Physics {
    BodyId floor;
    std::vector<Thing> things;
    std::vector<Touch> touches;

    Result<void> step(World& world, float dt, Vec3 gravity) {
        find_touches(dt);
        std::vector<HostBody> bodies;
        std::vector<HostContact> contacts;
        for (const Thing& t : things) bodies.push_back({t.shape.body, t.shape.pose, t.shape.motion});
        for (const Touch& t : touches)
            contacts.push_back({t.body, floor, centre(find(t.body)->shape) + t.arm, {0, 1, 0}, t.distance});
        const Result<void> done = world.step({bodies.data(), static_cast<uint32_t>(bodies.size()), contacts.data(),
                                              static_cast<uint32_t>(contacts.size())});
        if (!done) return done;
        apply(world.host_changes());
        for (Thing& t : things)
            if (t.is_free()) t.shape.motion.velocity = t.shape.motion.velocity + dt * gravity;
        for (int iteration = 0; iteration < 20; ++iteration)
            for (Touch& t : touches) push(*find(t.body), t, dt);
        for (Thing& t : things)
            if (t.is_free()) move(t.shape, dt);
        return {};
    }

    // What is on the floor, or will be within this step.
    void find_touches(float dt) {
        touches.clear();
        for (const Thing& t : things)
            for (const Vec3 point : t.points) {
                const Vec3 p = t.shape.pose.position + rotate(t.shape.pose.orientation, point);
                const Vec3 arm = p - centre(t.shape);
                const float distance = p.y - t.shape.margin, way = dt * velocity(t.shape, arm).y;
                if (distance + std::min(way, 0.0f) < 0.005f) touches.push_back({t.shape.body, arm, distance, 0});
            }
    }

    void apply(const HostChanges& changes) {
        for (const BodyId id : changes.removed) {
            forget_touches(id);
            std::erase_if(things, [id](const Thing& t) { return t.shape.body == id; });
        }
        for (const HostShape& s : changes.born) things.push_back(made_of(s));
        for (const HostShape& s : changes.reshaped) *find(s.body) = made_of(s), forget_touches(s.body);
        for (const BodyId id : changes.held) find(id)->is_held = true;
        for (const HostMotion& m : changes.released) find(m.body)->is_held = false;
        for (const HostMotion& m : changes.moved) find(m.body)->shape.pose = m.pose;
        for (const auto& list : {changes.released, changes.moved})
            for (const HostMotion& m : list) find(m.body)->shape.motion = m.motion;
        for (const HostPair& pair : changes.apart) forget_touches(pair.b == floor ? pair.a : pair.b);
    }

    // The impulse that keeps the point from going through the floor within this step, and Coulomb's friction.
    void push(Thing& thing, Touch& touch, float dt) {
        if (!thing.is_free()) return;
        HostShape& s = thing.shape;
        const Vec3 up{0, 1, 0}, v = velocity(s, touch.arm), sliding{v.x, 0, v.z};
        const float wanted = touch.distance > 0 ? -touch.distance / dt : std::min(-0.1f * touch.distance / dt, 0.2f);
        const float before = touch.pushed, speed = length(sliding);
        touch.pushed = std::max(0.0f, before + (wanted - v.y) * effective_mass(s, touch.arm, up));
        kick(s, touch.arm, (touch.pushed - before) * up);
        if (speed == 0) return;
        const Vec3 along = (1 / speed) * sliding;
        kick(s, touch.arm, -std::min(speed * effective_mass(s, touch.arm, along), s.friction * touch.pushed) * along);
    }

    static Thing made_of(const HostShape& s) {
        Thing thing{s, {}};
        for (uint32_t k = 0; k < s.piece_count; ++k)
            thing.points.insert(thing.points.end(), s.pieces[k].points, s.pieces[k].points + s.pieces[k].point_count);
        return thing;
    }
    Thing* find(BodyId id) {
        return &*std::find_if(things.begin(), things.end(), [id](const Thing& t) { return t.shape.body == id; });
    }
    void forget_touches(BodyId id) {
        std::erase_if(touches, [id](const Touch& t) { return t.body == id; });
    }
};

}  // namespace plain
