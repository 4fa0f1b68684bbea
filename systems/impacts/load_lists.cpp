#include "systems/impacts/load_lists.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/impacts/fragile.hpp"

namespace cullet {
namespace {

// What stands behind: within 37 degrees of the push, and through a heap so many contacts are looked at, no more.
constexpr float kBehind = 0.8f;
constexpr uint32_t kMostLooks = 64;

bool yields(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic && !bodies.hold_count[b];
}

bool stands(const Bodies& bodies, Row<Bodies> b) {
    return !yields(bodies, b) || bodies.is_asleep[b];
}

bool is_driven(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Kinematic;
}

// m/s and rad/s, of who is driven; what stands still or sleeps has none.
Vec3 spin_of(const Bodies& bodies, Row<Bodies> b) {
    return is_driven(bodies, b) ? bodies.spin[b] : Vec3{};
}
Vec3 velocity_at(const Bodies& bodies, Row<Bodies> b, Vec3 point) {
    if (!is_driven(bodies, b)) return {};
    const Vec3 centre = to_world(pose_of(bodies, b), bodies.centre[b].to_float());
    return bodies.velocity[b] + cross(bodies.spin[b], point - centre);
}

bool touches(const RigidContact& c) {
    return c.impulse > 0 || c.distance <= 0;
}

}  // namespace

LoadLists::LoadLists(Bodies& bodies, std::span<const RigidContact> contacts, Arena& arena)
    : bodies_(bodies), contacts_(contacts), next_(arena.take<uint32_t>(2 * contacts.size())) {
    for (uint32_t b = 0; b < bodies.size(); ++b) bodies.first_load[b] = kNone;
    for (size_t c = next_.size() / 2; c-- > 0;) {
        if (!touches(contacts[c])) continue;
        for (uint32_t side = 2; side-- > 0;) {
            const Row<Bodies> body(side == 0 ? contacts[c].a : contacts[c].b);
            const uint32_t entry = 2 * static_cast<uint32_t>(c) + side;
            next_[entry] = bodies.first_load[body];
            bodies.first_load[body] = entry;
        }
    }
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        uint32_t count = 0;
        for (uint32_t entry = bodies.first_load[b]; entry != kNone; entry = next_[entry]) ++count;
        longest_ = std::max(longest_, count);
    }
}

float LoadLists::deepest(Row<Bodies> body) const {
    float deepest = 0;
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone; entry = next_[entry])
        deepest = std::max(deepest, -contacts_[entry / 2].distance);
    return deepest;
}

void LoadLists::Behind::meet(const Bodies& bodies, Row<Bodies> other) {
    const float at = dot(velocity_at(bodies, other, place), push);
    if (stands && at <= speed) return;
    who = other;
    stands = true;
    speed = at;
}

// Who cannot be pushed further against the push by `from`: it sleeps or does not yield, or such a one is behind.
void LoadLists::look_behind(Row<Bodies> body, Row<Bodies> from, uint32_t& looks, Behind& behind) const {
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone; entry = next_[entry]) {
        if (++looks > kMostLooks) return;
        const Impact as = impact_of(contacts_[entry / 2], static_cast<int>(entry & 1));
        if (as.striker == from || dot(as.normal, behind.push) < kBehind) continue;
        if (stands(bodies_, as.striker))
            behind.meet(bodies_, as.striker);
        else
            look_behind(as.striker, body, looks, behind);
    }
}

BodyLoad LoadLists::load_of(uint32_t entry, float dt) const {
    const RigidContact& c = contacts_[entry / 2];
    const Impact as = impact_of(c, static_cast<int>(entry & 1));
    const Pose pose = pose_of(bodies_, as.body);
    const Row<Bodies> other = as.striker;
    const auto in_body_axes = [&](Vec3 v) { return Vec3d(rotate(conjugate(pose.orientation), v)); };
    BodyLoad l;
    l.contact = entry / 2;
    l.toucher = other;
    l.place = Vec3d(to_body(pose, as.point)) - bodies_.centre[as.body];
    l.push = in_body_axes(as.normal);
    l.force = c.impulse / dt;
    l.depth = -c.distance;
    l.stands = !yields(bodies_, other);
    Behind behind;
    behind.place = as.point;
    behind.push = as.normal;
    uint32_t looks = 0;
    if (stands(bodies_, other))
        behind.meet(bodies_, other);
    else
        look_behind(other, as.body, looks, behind);
    l.is_backed = behind.stands;
    if (!behind.stands) return l;
    const Vec3 centre = to_world(pose, bodies_.centre[as.body].to_float());
    l.driven_speed = behind.speed;
    l.velocity = in_body_axes(velocity_at(bodies_, behind.who, centre));
    l.spin = in_body_axes(spin_of(bodies_, behind.who));
    return l;
}

// A solver that has few iterations leaves what is heavy, or driven, closing on the body: stopping it takes its mass
// times that speed, as long as the body cannot give way. All contacts with one toucher stop it together.
void LoadLists::share_what_is_missing(std::span<BodyLoad> loads, Row<Bodies> body, float dt) const {
    for (size_t first = 0, end; first < loads.size(); first = end) {
        const Row<Bodies> other = loads[first].toucher;
        for (end = first + 1; end < loads.size() && loads[end].toucher == other;) ++end;
        const double mass = bodies_.mass[loads[first].stands ? body : other] / static_cast<double>(end - first);
        for (BodyLoad& l : loads.subspan(first, end - first)) {
            l.force += mass * std::max(0.0f, contacts_[l.contact].approach_speed) / dt;
            l.bears = l.is_backed ? kBearsAll : l.force;
        }
    }
}

uint32_t LoadLists::take(Row<Bodies> body, float dt, std::span<BodyLoad> loads) const {
    uint32_t count = 0;
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone && count < loads.size(); entry = next_[entry])
        loads[count++] = load_of(entry, dt);
    share_what_is_missing(loads.first(count), body, dt);
    return count;
}

}  // namespace cullet
