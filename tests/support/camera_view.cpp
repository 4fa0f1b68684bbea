#include "tests/support/camera_view.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cullet/query.hpp"
#include "systems/world_contents.hpp"

namespace cullet::test {
namespace {

class View {
 public:
    explicit View(const Camera& camera) : eye_(camera.eye) {
        forward_ = normalised(camera.target - camera.eye);
        right_ = normalised(cross(forward_, Vec3{0, 1, 0}));
        up_ = cross(right_, forward_);
        height_ = std::tan(0.5f * camera.vertical_field_of_view);
    }
    /// Pictures are 16 to 9.
    bool holds(Vec3 place) const {
        const Vec3 away = place - eye_;
        const float depth = dot(away, forward_);
        return depth > 0 && std::fabs(dot(away, up_)) <= height_ * depth &&
               std::fabs(dot(away, right_)) <= height_ * depth * 16 / 9;
    }
    /// From -1 at the picture's lower side to 1 at its upper side.
    double height_of(Vec3 place) const {
        return static_cast<double>(dot(place - eye_, up_) / (height_ * dot(place - eye_, forward_)));
    }
    Vec3 eye() const { return eye_; }

 private:
    Vec3 eye_, forward_, right_, up_;
    float height_ = 0;
};

/// What is spawned of a model, whole or in pieces; balls, floors and walls are not.
bool is_of_model(const World& world, BodyId id) {
    return world.contents().data.state.bodies.structure[id.index].exists();
}

/// Something that does not break stands before the place.
bool is_hidden(const World& world, Vec3 eye, Vec3 place) {
    const float distance = length(place - eye);
    const SurfaceHit hit = ray(world, eye, place - eye, 0.99f * distance);
    return hit && !is_of_model(world, hit.body);
}

}  // namespace

Seen seen_of(const GameWorld& game) {
    const World& world = game.world();
    const View view(game.stage().camera);
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    Seen seen;
    for (const BodyId id : ids) {
        const Result<BodyView> drawn = world.view(id);
        if (!is_of_model(world, id) || !drawn.ok()) continue;
        for (uint32_t i = 0; i + 2 < drawn->index_count; i += 3) {
            Vec3 p[3];
            for (uint32_t k = 0; k < 3; ++k)
                p[k] = to_world(drawn->pose, drawn->vertices[drawn->indices[i + k]].position);
            const double area = 0.5 * static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0])));
            const Vec3 middle = (1.0f / 3) * (p[0] + p[1] + p[2]);
            seen.all += area;
            if (!view.holds(middle)) continue;
            seen.inside += area;
            seen.lowest = std::min(seen.lowest, view.height_of(middle));
            seen.highest = std::max(seen.highest, view.height_of(middle));
            if (i % 24 == 0 && is_hidden(world, view.eye(), middle)) seen.hidden += 8 * area;
        }
    }
    return seen;
}

}  // namespace cullet::test
