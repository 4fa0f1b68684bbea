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

bool touches(const RigidContact& c) {
    return c.impulse > 0 || c.distance <= 0;
}

}  // namespace

bool is_anything_driven(const Bodies& bodies) {
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Kinematic) continue;
        if (length(bodies.velocity[b]) > 0 || length(bodies.spin[b]) > 0) return true;
    }
    return false;
}

LoadLists::LoadLists(Bodies& bodies, const Squeezes& squeezes, std::span<const RigidContact> contacts, Step step,
                     Arena& arena)
    : bodies_(bodies),
      squeezes_(squeezes),
      contacts_(contacts),
      step_(step),
      next_(arena.take<uint32_t>(2 * contacts.size())) {
    for (uint32_t b = 0; b < bodies.size(); ++b) bodies.first_load[b] = kNone;
    for (size_t c = next_.size() / 2; c-- > 0;) {
        if (!touches(contacts[c]) || !counts(contacts[c])) continue;
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

// Of what stands in the grip of a run nobody tells what it stands on, or lies in.
bool LoadLists::counts(const RigidContact& c) const {
    const auto is_in_a_grip = [&](uint32_t b) {
        return static_cast<BodyKind>(bodies_.kind[b]) == BodyKind::Dynamic && bodies_.hold_count[b] &&
               !is_squeezed(squeezes_, Row<Bodies>(b));
    };
    const auto is_free = [&](uint32_t b) { return yields(bodies_, Row<Bodies>(b)) && !bodies_.is_asleep[b]; };
    return is_free(c.a) || is_free(c.b) || (!is_in_a_grip(c.a) && !is_in_a_grip(c.b));
}

bool LoadLists::is_driven(Row<Bodies> b) const {
    if (!b.exists()) return false;
    return static_cast<BodyKind>(bodies_.kind[b]) == BodyKind::Kinematic || is_squeezed(squeezes_, b);
}

Vec3 LoadLists::spin_of(Row<Bodies> b) const {
    return is_driven(b) ? bodies_.spin[b] : Vec3{};
}

Vec3 LoadLists::velocity_at(Row<Bodies> b, Vec3 point) const {
    if (!is_driven(b)) return {};
    const Vec3 centre = to_world(pose_of(bodies_, b), bodies_.centre[b].to_float());
    return bodies_.velocity[b] + cross(bodies_.spin[b], point - centre);
}

float LoadLists::deepest(Row<Bodies> body) const {
    float deepest = 0;
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone; entry = next_[entry])
        deepest = std::max(deepest, -contacts_[entry / 2].distance);
    return deepest;
}

void LoadLists::Behind::meet(const LoadLists& lists, Row<Bodies> other) {
    const float at = dot(lists.velocity_at(other, place), push);
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
            behind.meet(*this, as.striker);
        else
            look_behind(as.striker, body, looks, behind);
    }
}

BodyLoad LoadLists::load_of(uint32_t entry) const {
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
    l.force = c.impulse / step_.dt;
    l.depth = -c.distance;
    l.closing = std::max(0.0f, c.approach_speed);
    l.stands = !yields(bodies_, other);
    l.is_squeezed = l.stands && other.exists() && is_squeezed(squeezes_, other);
    Behind behind;
    behind.place = as.point;
    behind.push = as.normal;
    uint32_t looks = 0;
    if (stands(bodies_, other))
        behind.meet(*this, other);
    else
        look_behind(other, as.body, looks, behind);
    l.is_backed = behind.stands;
    if (!behind.stands) return l;
    const Vec3 centre = to_world(pose, bodies_.centre[as.body].to_float());
    l.driven_speed = behind.speed;
    l.velocity = in_body_axes(velocity_at(behind.who, centre));
    l.spin = in_body_axes(spin_of(behind.who));
    return l;
}

LoadLists::Pressing LoadLists::pressing_of(Row<Bodies> body, Vec3 push) const {
    Pressing out;
    out.unborne = bodies_.mass[body] * step_.dt * dot(step_.gravity, push);
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone; entry = next_[entry]) {
        const float along = dot(impact_of(contacts_[entry / 2], static_cast<int>(entry & 1)).normal, push);
        out.supports += along < -kBehind;
        out.unborne += contacts_[entry / 2].impulse * along;
    }
    return out;
}

// N s, that those who stand on `by.body` press on it beyond what the solver gave it, and those on them: of what each
// weighs, what nothing bears yet. A speed that it has come to meanwhile is none of its weight. It goes to all that it
// stands on, by their contacts.
double LoadLists::passed_on(const Through& by, uint32_t& looks) const {
    double sum = 0;
    for (uint32_t entry = bodies_.first_load[by.body], end; entry != kNone && looks < kMostLooks; entry = end) {
        const Row<Bodies> other = impact_of(contacts_[entry / 2], static_cast<int>(entry & 1)).striker;
        uint32_t count = 0;
        double speed = 0;
        for (end = entry; end != kNone; end = next_[end]) {
            const Impact as = impact_of(contacts_[end / 2], static_cast<int>(end & 1));
            if (as.striker != other) break;
            ++looks;
            if (dot(as.normal, by.push) < kBehind) continue;
            ++count;
            speed += as.approach_speed;
        }
        if (count == 0 || other == by.on || stands(bodies_, other)) continue;
        speed = std::max(0.0, by.speed + speed / count);
        const Pressing pressing = pressing_of(other, by.push);
        const double own = std::clamp(pressing.unborne, 0.0, bodies_.mass[other] * speed);
        sum += count * (own + passed_on({other, by.body, by.push, speed}, looks)) / std::max(pressing.supports, 1u);
    }
    return sum;
}

// A solver that has few iterations leaves what is heavy, or driven, closing on the body: stopping it takes its mass
// times that speed, as long as the body cannot give way. All contacts with one toucher stop it together. What is heavy
// may press through what is light, which takes more iterations yet; a sleeper stands, for the solver, and gets it all.
void LoadLists::share_what_is_missing(std::span<BodyLoad> loads, Row<Bodies> body) const {
    for (size_t first = 0, end; first < loads.size(); first = end) {
        const Row<Bodies> other = loads[first].toucher;
        double speed = 0;
        for (end = first; end < loads.size() && loads[end].toucher == other; ++end)
            speed += contacts_[loads[end].contact].approach_speed;
        const auto count = static_cast<double>(end - first);
        const double mass = bodies_.mass[loads[first].stands ? body : other] / count;
        double through = 0;
        if (!bodies_.is_asleep[body] && !stands(bodies_, other)) {
            const Vec3 push = rotate(bodies_.orientation[body], loads[first].push.to_float());
            uint32_t looks = 0;
            through =
                passed_on({other, body, push, speed / count}, looks) / std::max(pressing_of(other, push).supports, 1u);
        }
        for (BodyLoad& l : loads.subspan(first, end - first)) {
            l.force += (mass * std::max(0.0f, contacts_[l.contact].approach_speed) + through) / step_.dt;
            l.bears = l.is_backed ? kBearsAll : l.force;
        }
    }
}

uint32_t LoadLists::take(Row<Bodies> body, std::span<BodyLoad> loads) const {
    uint32_t count = 0;
    for (uint32_t entry = bodies_.first_load[body]; entry != kNone && count < loads.size(); entry = next_[entry])
        loads[count++] = load_of(entry);
    share_what_is_missing(loads.first(count), body);
    return count;
}

}  // namespace cullet
