#include "systems/births/limit_flight.hpp"

#include <gtest/gtest.h>

namespace cullet {
namespace {

constexpr double kExact = 1e-12;

/// A body that flew at 1 m/s along x and turned at 2 rad/s about z, hit at 5 m/s.
FlightLimit limit_of_hit() {
    return {kMostRelativeSpeed * 5, {0, 0.1, 0}, {1, 0, 0}, {0, 0, 2}};
}

PartMotion part_at(Vec3d centre, Vec3d velocity, Vec3d spin) {
    PartMotion part;
    part.mass = 0.5;
    part.centre = centre;
    part.radius = 0.04;
    part.inertia = {1e-4, 1e-4, 1e-4, 0, 0, 0};
    part.velocity = velocity;
    part.spin = spin;
    return part;
}

TEST(LimitFlight, IsTwiceTheImpactSpeedAtTheSolidsCentreAndTheRestOfTheMomentumIsHandedOut) {
    const FlightLimit limit = limit_of_hit();
    const Vec3d solid{0.2, 0.1, 0}, before{1, 0.4, 0};  // V + W x (0.2, 0, 0)
    PartMotion part = part_at({0.19, 0.1, 0}, before + Vec3d{0, 0, 12}, {});
    const Vec3d cut = limit_flight(limit, solid, part);
    EXPECT_NEAR(length(part.velocity - before - Vec3d{0, 0, 10}), 0, kExact);
    EXPECT_NEAR(length(cut - Vec3d{0, 0, 1}), 0, kExact);  // half a kilogram, 2 m/s
    EXPECT_TRUE(part.is_speed_clamped);
    EXPECT_FALSE(part.is_spin_clamped);
}

TEST(LimitFlight, IsThatOfTheRimAsFarAsTheSolidMayReach) {
    const FlightLimit limit = limit_of_hit();
    PartMotion part = part_at({0, 0.1, 0}, limit.velocity, {300, 0, 2});
    EXPECT_EQ(length(limit_flight(limit, {0.01, 0.1, 0}, part)), 0);
    EXPECT_TRUE(part.is_spin_clamped);
    EXPECT_NEAR(part.spin.x, 10 / 0.05, 1e-9);  // the rim is 4 cm from a centre that is a centimetre off
    EXPECT_NEAR(part.spin.z, 2, kExact);
}

TEST(LimitFlight, LeavesTheSpinThatTheBodyHadAndTheLossOfIt) {
    FlightLimit limit = limit_of_hit();
    limit.spin = {0, 0, 400};
    for (const Vec3d spin : {Vec3d{0, 0, 410}, Vec3d{0, 0, 5}}) {
        PartMotion part = part_at(limit.centre, limit.velocity, spin);
        limit_flight(limit, limit.centre, part);
        EXPECT_EQ(part.spin.z, spin.z);
        EXPECT_FALSE(part.is_spin_clamped);
    }
}

TEST(LimitFlight, SlowsDownAboutThePiecesOwnAxisWhereTheBodysSpinWasTheLivelierOne) {
    FlightLimit limit = limit_of_hit();
    limit.spin = {0, 0, 1000};
    PartMotion part = part_at(limit.centre, limit.velocity, {300, 0, 0});
    limit_flight(limit, limit.centre, part);
    EXPECT_NEAR(length(part.spin - Vec3d{250, 0, 0}), 0, 1e-9);
}

TEST(LimitFlight, TakesNothingFromWhatIsSlowerStandsOrWasNotHit) {
    const Vec3d centre{0, 0.1, 0};
    PartMotion slow = part_at(centre, {1, 9.9, 0}, {0, 0, 100});
    EXPECT_EQ(length(limit_flight(limit_of_hit(), centre, slow)), 0);
    EXPECT_EQ(slow.velocity.y, 9.9);
    PartMotion pinned = part_at(centre, {50, 0, 0}, {});
    pinned.is_static = true;
    EXPECT_EQ(length(limit_flight(limit_of_hit(), centre, pinned)), 0);
    PartMotion cut_off = part_at(centre, {50, 0, 0}, {900, 0, 0});
    EXPECT_EQ(length(limit_flight({}, centre, cut_off)), 0);
    EXPECT_EQ(cut_off.velocity.x, 50);
    EXPECT_EQ(cut_off.spin.x, 900);
}

}  // namespace
}  // namespace cullet
