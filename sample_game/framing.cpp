#include "sample_game/framing.hpp"

#include <algorithm>
#include <cmath>

#include "systems/world_contents.hpp"

namespace cullet {

namespace {

constexpr float kSlow = 0.05f;             // m/s; what is slower lies still
constexpr float kSecondsAhead = 1.0f;      // so far ahead something is about to be met
constexpr double kNotedSeconds = 3;        // and so long it stays in the picture
constexpr size_t kMostMoving = 128;        // that others are compared with
constexpr float kLeastReach = 0.08f;       // m
constexpr float kOutlier = 1.25f;          // times the mean distance; what is farther is let go
constexpr float kMostBehind = 0.4f;        // of the reach, that the picture's middle lags
constexpr float kGone = 20;                // m below the ground
constexpr Vec3 kFrom{0.50f, 0.40f, 1.0f};  // from the middle to the eye

/// Share of the way that is gone in one step, for a motion that falls to 1/e in `seconds`.
float share_of(double step, double seconds) {
    return static_cast<float>(step / (seconds + step));
}

}  // namespace

void Framing::note_what_is_met(const std::vector<Seen>& moving, const std::vector<Seen>& still, uint64_t until_frame) {
    for (const Seen& thing : still)
        for (size_t m = 0; m < std::min(kMostMoving, moving.size()); ++m) {
            const Vec3 gap = thing.centre - moving[m].centre, way = kSecondsAhead * moving[m].velocity;
            const float length_squared = dot(way, way);
            const float along = length_squared > 0 ? std::clamp(dot(gap, way) / length_squared, 0.0f, 1.0f) : 0.0f;
            if (length(gap - along * way) < thing.radius + moving[m].radius) noted_until_[thing.row] = until_frame;
        }
}

void Framing::follow(const GameWorld& game) {
    const Stage& stage = game.stage();
    const Bodies& bodies = game.world().contents().data.state.bodies;
    const double step = static_cast<double>(stage.settings().step_seconds);
    const float ground = stage.ground_height();
    noted_until_.resize(std::max<size_t>(noted_until_.size(), bodies.size()));
    std::vector<Seen> moving, still;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        const bool is_thing = bodies.is_sphere[b] || bodies.structure[b].exists();
        if (kind == BodyKind::Free || kind == BodyKind::Scenery || !is_thing) continue;
        const Vec3d c = bodies.centre[b];
        const Vec3 centre{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
        const Vec3 place = bodies.position[b] + matrix(Quat(bodies.orientation[b])) * centre;
        if (stage.has_ground() && place.y < ground - kGone) continue;
        const bool moves = kind == BodyKind::Dynamic && !bodies.is_asleep[b] && !bodies.has_pins[b] &&
                           length(bodies.velocity[b]) > kSlow;
        (moves ? moving : still).push_back({place, bodies.velocity[b], bodies.radius[b], b});
    }
    const uint64_t now = game.frame();
    note_what_is_met(moving, still, now + static_cast<uint64_t>(kNotedSeconds / step));
    std::vector<Seen> wanted = moving;
    for (const Seen& thing : still)
        if (noted_until_[thing.row] > now || (reach_ == 0 && moving.empty())) wanted.push_back(thing);
    if (wanted.empty() && reach_ > 0) return;

    // What is large counts for more. What flew off alone is let go.
    Vec3 sum{};
    float weights = 0, spread = 0;
    for (const Seen& thing : wanted) {
        const float weight = thing.radius * thing.radius;
        sum += weight * thing.centre, weights += weight;
    }
    const Vec3 mean = weights > 0 ? (1 / weights) * sum : Vec3{0, ground + 0.5f, 0};
    for (const Seen& thing : wanted)
        spread += thing.radius * thing.radius * (length(thing.centre - mean) + thing.radius) / weights;
    Vec3 low = mean, high = mean;
    for (const Seen& thing : wanted) {
        if (length(thing.centre - mean) > kOutlier * spread + thing.radius) continue;
        const Vec3 r{thing.radius, thing.radius, thing.radius}, from = thing.centre - r, to = thing.centre + r;
        low = {std::min(low.x, from.x), std::min(low.y, from.y), std::min(low.z, from.z)};
        high = {std::max(high.x, to.x), std::max(high.y, to.y), std::max(high.z, to.z)};
    }
    const Vec3 middle = 0.5f * (low + high);
    const float reach = std::max(kLeastReach, 0.5f * length(high - low));
    const bool is_first = reach_ == 0;
    middle_ += (is_first ? 1 : share_of(step, 0.25)) * (middle - middle_);
    reach_ += (is_first ? 1 : share_of(step, reach > reach_ ? 0.2 : 1.0)) * (reach - reach_);
    const Vec3 behind = middle - middle_;
    const float most_behind = kMostBehind * reach_;
    if (length(behind) > most_behind) middle_ = middle - (most_behind / length(behind)) * behind;

    double sine, cosine;
    sine_cosine(0.5 * static_cast<double>(camera_.vertical_field_of_view), sine, cosine);
    camera_.target = middle_;
    camera_.eye = middle_ + (1.05f * reach_ / static_cast<float>(sine)) * normalised(kFrom);
    if (stage.has_ground()) camera_.eye.y = std::max(camera_.eye.y, ground + 0.1f * reach_);
}

}  // namespace cullet
