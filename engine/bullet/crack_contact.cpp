#include "engine/bullet/crack_contact.hpp"

#include <algorithm>

#include "engine/bullet/bullet_types.hpp"

namespace cullet::bullet {
namespace {

// Lengths are those of pieces of scale 1.
constexpr float kNear = 0.003f;  // m beyond the boxes of two pieces at which a crack's touch is theirs
constexpr float kNoWay = -1;
// Two faces that turned this far against each other, by its cosine, and lie so deep in each other face no more: a shard
// at 100 rad/s turns by a right angle in a step. Of 500 hidden breaks the most that neighbours throw each other is 1.06
// m/s without this.
constexpr float kFacing = 0.9f;
constexpr float kTurnedIn = 0.003f;  // m
constexpr float kSeconds = 0.25f;    // at a second pieces of walls fall asleep a decimetre deep in each other

}  // namespace

void find_near(const Hull& a, const Hull& b, std::span<const CrackTouch> touches,
               std::vector<const CrackTouch*>& near) {
    near.clear();
    const float reach = scale_of(a, b) * kNear;
    for (const CrackTouch& t : touches) {
        const Box at{t.point, t.point};
        const bool is_near = overlap(a.world_box, at, reach) && overlap(b.world_box, at, reach);
        const bool has_direction = dot(t.normal, t.normal) > 0.5f;
        if (is_near && has_direction && near.size() < near.capacity()) near.push_back(&t);
    }
}

CrackContact crack_contact(std::span<const CrackTouch* const> near, const btTransform& at_a, const btTransform& at_b,
                           bool is_turned) {
    CrackContact contact;
    contact.seconds = kSeconds;
    if (near.empty()) return contact;
    Vec3 middle;
    for (const CrackTouch* t : near) middle += t->point;
    middle = 1 / static_cast<float>(near.size()) * middle;
    const CrackTouch* chosen[kPatchPoints];
    for (uint32_t k = 0; k < kPatchPoints; contact.count = ++k) {
        const CrackTouch* farthest = nullptr;
        float most = kNoWay;
        for (const CrackTouch* t : near) {
            float way = k == 0 ? length(t->point - middle) : kFar;
            for (uint32_t c = 0; c < k; ++c) way = std::min(way, length(t->point - chosen[c]->point));
            if (way > most) most = way, farthest = t;
        }
        if (k > 0 && !(most > 0)) break;
        chosen[k] = farthest;
        contact.on_a[k] = from_bullet(at_a.invXform(to_bullet(farthest->point)));
        contact.on_b[k] = from_bullet(at_b.invXform(to_bullet(farthest->point)));
        const btVector3 normal = to_bullet((is_turned ? -1.0f : 1.0f) * farthest->normal);
        contact.normal[k] = from_bullet(normal * at_b.getBasis());
        contact.normal_of_a[k] = from_bullet(normal * at_a.getBasis());
        contact.reach[k] = farthest->reach;
    }
    return contact;
}

Patch crack_patch(const CrackContact& contact, const btTransform& at_a, const btTransform& at_b, float scale) {
    Patch patch;
    for (uint32_t k = 0; k < contact.count; ++k) {
        const Vec3 on_a = from_bullet(at_a * to_bullet(contact.on_a[k])),
                   on_b = from_bullet(at_b * to_bullet(contact.on_b[k])),
                   normal = from_bullet(at_b.getBasis() * to_bullet(contact.normal[k]));
        const float apart = dot(on_a - on_b, normal);
        const Vec3 normal_of_a = from_bullet(at_a.getBasis() * to_bullet(contact.normal_of_a[k]));
        if (apart < -scale * kTurnedIn && dot(normal, normal_of_a) < kFacing) continue;
        if (apart > scale * kContactRange || length(on_a - on_b - apart * normal) > contact.reach[k]) continue;
        if (patch.count == 0) patch.normal = normal;
        patch.point[patch.count++] = {on_a, on_b, apart, normal};
    }
    return patch;
}

}  // namespace cullet::bullet
