// A host with its own physics, whole: a vase falls on its floor and breaks. It links cullet::core, in which there is no
// Bullet. Its things fall and land, they do not turn or meet each other (docs/embedding.md has a richer one).
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "cullet/world.hpp"
using namespace cullet;

struct Thing {
    HostBody row;
    Vec3 foot;  // its lowest corner, body axes
    bool is_held = false;
    float gap() const { return row.pose.position.y + foot.y; }
};

Model vase() {
    std::vector<Vec3> points;
    std::vector<uint32_t> faces;
    float x = 1, z = 0;  // turns by a 32nd of a circle a point; no sine, whose last bits differ between libraries
    for (uint32_t i = 0; i < 24 * 32; ++i) {
        const float height = 0.01f * static_cast<float>(i / 32);
        const float radius = 0.05f + 26 * height * (height - 0.125f) * (height - 0.25f);
        points.push_back({radius * x, height, radius * z});
        const float before = x;
        x = 0.98078528f * x - 0.19509032f * z;
        z = 0.19509032f * before + 0.98078528f * z;
        const uint32_t next = i % 32 == 31 ? i - 31 : i + 1;
        if (i >= 32) faces.insert(faces.end(), {i - 32, i, next - 32, next - 32, i, next});
    }
    return cook({points.data(), points.size(), faces.data(), faces.size() / 3}, {.thickness = 0.004f}).value();
}

int main() {
    World world = std::move(World::create_hosted({.units_a_frame = 50'000'000})).value();
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    const BodyId floor = world.add_static({corners, 4, quad, 2}).value();
    world.spawn(world.add_model(vase()).value(), {.pose = {{0, 1.2f, 0}, {}}}).value();
    std::map<uint32_t, Thing> things;  // by BodyId::index
    for (int frame = 0; frame < 240; ++frame) {
        std::vector<HostBody> bodies;
        std::vector<HostContact> contacts;  // with the floor, now or within this step
        for (auto& [index, t] : things) {
            const Vec3 p = t.row.pose.position;
            bodies.push_back(t.row);
            if (t.gap() + t.row.motion.velocity.y / 60 < 0)
                contacts.push_back({t.row.body, floor, {p.x + t.foot.x, 0, p.z + t.foot.z}, {0, 1, 0}, t.gap()});
        }
        const Result<void> done =
            world.step({bodies.data(), uint32_t(bodies.size()), contacts.data(), uint32_t(contacts.size())});
        if (!done.ok()) return std::fprintf(stderr, "%s\n", done.error().c_str()), 1;
        const HostChanges& changes = world.host_changes();
        for (const BodyId id : changes.removed) things.erase(id.index);
        for (const auto& list : {changes.born, changes.reshaped})
            for (const HostShape& s : list) {
                Thing& t = things[s.body.index] = {{s.body, s.pose, s.motion}, {0, 1e9f, 0}};
                for (uint32_t k = 0; k < s.piece_count; ++k)
                    for (uint32_t c = 0; c < s.pieces[k].point_count; ++c)
                        if (s.pieces[k].points[c].y < t.foot.y) t.foot = s.pieces[k].points[c];
            }
        for (const BodyId id : changes.held) things.at(id.index).is_held = true;
        for (const HostMotion& m : changes.released) things.at(m.body.index).is_held = false;
        for (const auto& list : {changes.released, changes.moved})
            for (const HostMotion& m : list) things.at(m.body.index).row = {m.body, m.pose, m.motion};
        for (auto& [index, t] : things) {
            if (t.is_held) continue;
            Vec3& v = t.row.motion.velocity;
            v.y -= 9.81f / 60;
            if (t.gap() + v.y / 60 < 0) v = {};
            const Vec3 p = t.row.pose.position;
            t.row.pose.position = {p.x + v.x / 60, p.y + v.y / 60, p.z + v.z / 60};
            t.row.motion.angular_velocity = {};
        }
    }
    std::printf("the vase broke into %zu pieces\n", things.size());
    return things.size() > 3 ? 0 : 1;
}
