#include "systems/impacts/underlay.hpp"

#include <cmath>

#include "components/body_id.hpp"

namespace cullet {
namespace {

// Within 26 degrees of the push, and of so many planes no more.
constexpr double kAgainst = 0.9;
constexpr int kMostPlanes = 4;

}  // namespace

Underlay::Underlay(const RigidWorld& rigid, const Bodies& bodies, Row<Bodies> body, double reach)
    : rigid_(rigid), pose_(pose_of(bodies, body)), centre_(bodies.centre[body]), body_(body), reach_(reach) {}

bool Underlay::lies_at(Row<Bodies> who, Vec3d place, Vec3d outward) const {
    const Vec3 normal = rotate(pose_.orientation, outward.to_float());
    const Vec3 point = to_world(pose_, (centre_ + place).to_float());
    const Vec3 seen_from = point + (2 * static_cast<float>(reach_)) * normal;
    RigidSurface surface;
    return rigid_.nearest_surface(who, point, static_cast<float>(reach_), surface, &seen_from) &&
           dot(surface.normal, normal) > static_cast<float>(kAgainst);
}

double Underlay::way_through(Vec3d place, Vec3d push, std::span<const BodyLoad> loads) const {
    int planes = 0;
    Row<Bodies> last;
    double last_way = 0;
    for (const BodyLoad& l : loads) {
        if (!l.is_backed || !l.toucher.exists() || dot(l.push, push) > -kAgainst) continue;
        const double way = dot(l.place - place, push);
        if (way < 0 || (last == l.toucher && std::fabs(way - last_way) < reach_)) continue;
        if (++planes > kMostPlanes) return -1;
        last = l.toucher;
        last_way = way;
        const Vec3d end = place + way * push;
        if (lies_at(l.toucher, end, -push) && lies_at(body_, end, push)) return way;
    }
    return -1;
}

}  // namespace cullet
