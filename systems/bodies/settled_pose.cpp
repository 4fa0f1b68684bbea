#include "systems/bodies/settled_pose.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {
namespace {

// What is put elsewhere goes at least 0.01 mm, far from the origin two steps of a float more (bullet/sides.hpp).
constexpr float kLeastMove = 8e-6f;   // m
constexpr float kRounding = 2.5e-7f;  // of a coordinate

}  // namespace

bool take_settled_pose(Bodies& bodies, const RigidWorld& rigid, Row<Bodies> body) {
    const Vec3 said = bodies.position[body], put = rigid.pose(body).position;
    const float far = std::max({std::fabs(said.x), std::fabs(said.y), std::fabs(said.z)});
    if (!(length(put - said) > kLeastMove + kRounding * far)) return false;
    bodies.position.set(body, put);
    bodies.previous_position.set(body, put);
    return true;
}

}  // namespace cullet
