// How a body moves while a run on it goes on.
#pragma once
#include "components/run_rows.hpp"

namespace cullet {

/// The body's own motion at a place while a task runs, body axes: about the centre of the vertices' masses.
struct BodyMotion {
    Vec3d centre, velocity, spin;
    BodyMotion(const RunRows& state, Row<Tasks> task);
    BodyMotion(Vec3d c, Vec3d v, Vec3d w) : centre(c), velocity(v), spin(w) {}
    Vec3d at(Vec3 place) const { return velocity + cross(spin, Vec3d(place) - centre); }
};

}  // namespace cullet
