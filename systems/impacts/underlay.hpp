// What a load goes straight through a body into: what lies on a flat floor bends no more than the floor does.
#pragma once
#include <span>

#include "systems/impacts/overload.hpp"

namespace cullet {

class Underlay {
 public:
    /// `reach`, m: how near to each other the surfaces of the body and of what bears it have to be.
    Underlay(const RigidWorld& rigid, const Bodies& bodies, Row<Bodies> body, double reach);

    /// How far from the place along the push (as in BodyLoad) the body ends, where somebody who is backed lies under it
    /// just there, m; negative: nobody does. Contacts are few, so that surfaces are asked.
    double way_through(Vec3d place, Vec3d push, std::span<const BodyLoad> loads) const;

 private:
    bool lies_at(Row<Bodies> who, Vec3d place, Vec3d outward) const;

    const RigidWorld& rigid_;
    Pose pose_;
    Vec3d centre_;
    Row<Bodies> body_;
    double reach_;
};

}  // namespace cullet
