// Which way a crack tip wants to go.
#pragma once
#include "systems/models/thick_shell/hidden/crack_rules.hpp"
#include "systems/models/thick_shell/hidden/grain.hpp"
#include "systems/models/thick_shell/hidden/vertex_stress.hpp"

namespace cullet {

/// The directions phi = -60, -55, .. 60 degrees from a heading and their weights cos(phi)^q. Made once a check that has
/// tips to look at: the powers need a logarithm and an exponential each.
struct HeadingFan {
    HeadingFan() = default;
    explicit HeadingFan(float power);
    float sine[kHeadingSteps + 1], cosine[kHeadingSteps + 1], weight[kHeadingSteps + 1];
};

/// Stress tensor of one face in two unit axes of the tangent plane.
struct FaceStress {
    float xx = 0, yy = 0, xy = 0;  // Pa
};

/// The tensor at a vertex in other unit axes of its tangent plane.
FaceStress in_axes(const VertexStress& stress, Vec3 x, Vec3 y);

struct ChosenHeading {
    Vec3 direction;    // unit, in the tangent plane
    float stress = 0;  // Pa, sigma_nn cos^q of that direction; <= 0: nothing opens
};

/// Maximises sigma_nn(phi) cos(phi)^q over the fan about `heading` and over the faces. sigma_nn is the tension across a
/// crack in direction phi; x is the heading, y = normal x heading, and the tensors are in these axes. Of equal values
/// the smaller turn wins, then the positive one, then the outer face.
/// With a grain the tension counts by the least tip limit over that in its direction.
ChosenHeading choose_heading(const HeadingFan& fan, Vec3 x, Vec3 y, const FaceStress (&face)[2],
                             const GrainLimits& grain = {});

}  // namespace cullet
