// The numbers that decide where cracks start and run (thick shell note C1, C2, C5, section 8).
#pragma once
#include "systems/structures/shell/mesh_quality.hpp"

namespace cullet {

/// Strength at the short load of an impact over the handbook's tensile strength, which is for seconds: static fatigue
/// of exponent 16 gives (1 s / 0.1 ms)^(1/17) = 1.7. Everyday 2. Doubled, a vase needs twice the speed to crack.
inline constexpr float kShortLoadFactor = 2.0f;

/// Weibull modulus of the strength of one vertex about the median, and the bounds of the factor. Everyday 8 (brick) to
/// 20 (glass). Doubled, all places break at nearly the same stress and breaks look alike.
inline constexpr double kWeibullModulus = 12;
inline constexpr double kLeastStrengthFactor = 0.5, kMostStrengthFactor = 1.5;

/// No crack starts within this many mean edges of a cut of the same run. Everyday 2 to 5. Doubled, a wall falls into
/// few large pieces; without it the contact crumbles and the rest stays whole.
inline constexpr float kStartSpacing = 3.0f;

/// Coarse fracture: the ban lasts as long as a wave takes for this many mean edges. Everyday 6 to 24. Without forks:
/// doubled, a wall falls into as few pieces as with the lasting ban; halved, into nearly as many as without one.
inline constexpr float kCoarseBanEdges = 12.0f;

/// Coarse fracture: a tip forks no nearer than this many mean edges to where its crack started or forked last. Everyday
/// 3 to 6: a brick wall falls into 26, 20, 16 lumps a blow at 3, 4, 6; at 0 into as many pieces as by fine fracture.
inline constexpr float kForkSpacing = 4.0f;

/// Half the angle between the branches of a tip that forks: cosine and sine of 30 degrees.
inline constexpr float kBranchCosine = 0.8660254f, kBranchSine = 0.5f;

/// sigma_2 / sigma_1 from which a start opens four and six edges instead of two. Everyday 0.5 and 0.75: plates bent by
/// a ball see 1. Raised to 1 there are no stars, only round plugs.
inline constexpr float kFourArmRatio = 0.5f, kSixArmRatio = 0.75f;

/// Speed of a crack tip over sqrt(E / density). Everyday 0.2 to 0.5 (glass 0.3: 1,500 of 5,300 m/s). Doubled, tips
/// outrun the waves that steer them and cracks come out straight.
inline constexpr float kTipSpeed = 0.35f;

/// Directions a tip tries on either side of its heading: twelve steps of 5 degrees. Doubled, tips may turn back and
/// close rings.
inline constexpr int kHeadingSteps = 12;
inline constexpr double kHeadingStep = 5.0 * 3.14159265358979323846 / 180.0;  // rad

/// A tip whose next step ends within this many mean edges of a crack turns to it. Everyday 1.5; 0 leaves thin strips
/// between parallel cracks; doubled, neighbouring radial cracks of a star run together.
inline constexpr float kJoinReach = 1.5f;
/// Cosine of how far ahead and how parallel a crack vertex must be: 60 degrees both.
inline constexpr float kJoinCosine = 0.5f;
/// Within this many mean edges of its root a tip does not join its own crack, or the arms of a star would close at
/// once.
inline constexpr float kRootReach = 3.0f;

/// Cosine of the largest turn from the wanted direction to the edge that is taken instead: 60 degrees.
inline constexpr float kTurnCosine = 0.5f;

}  // namespace cullet
