#include "systems/births/stop_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/random.hpp"

namespace cullet {
namespace {

// The bodies stand for the fragments from here on.
constexpr uint32_t kFirst = 3;

struct Contacts {
    Touches rows{64};

    void add(uint32_t a, uint32_t b, Vec3d point, Vec3d normal) {
        const uint32_t t = rows.append(1);
        rows.a[t] = Row<Fragments>(kFirst + a), rows.b[t] = Row<Fragments>(kFirst + b);
        rows.point.set(t, point), rows.normal.set(t, normal);
    }
    void stop(std::vector<Touching>& bodies) { stop_approach(bodies, kFirst, rows, {0, rows.size()}, 1); }
    Vec3d impulse(uint32_t t) const { return rows.impulse[t]; }
    double pushed(uint32_t t) const { return dot(rows.impulse[t], rows.normal[t]); }
    /// The speed at which any two still close.
    double most_closing(const std::vector<Touching>& bodies) const {
        double most = 0;
        for (uint32_t t = 0; t < rows.size(); ++t) {
            const Touching &a = bodies[rows.a[t] - kFirst], &b = bodies[rows.b[t] - kFirst];
            const Vec3d point = rows.point[t];
            const Vec3d parting =
                a.velocity + cross(a.spin, point - a.centre) - b.velocity - cross(b.spin, point - b.centre);
            most = std::max(most, -dot(parting, rows.normal[t]));
        }
        return most;
    }
};

struct Sums {
    Vec3d momentum, turning;
    double energy = 0;
};

Sums sums_of(const std::vector<Touching>& bodies) {
    Sums sum;
    for (const Touching& b : bodies) {
        const Vec3d impulse = (1 / b.inverse_mass) * b.velocity, own = inverse(b.inverse_inertia) * b.spin;
        sum.momentum += impulse;
        sum.turning += cross(b.centre, impulse) + own;
        sum.energy += 0.5 * (dot(impulse, b.velocity) + dot(own, b.spin));
    }
    return sum;
}

// m1 v1 + m2 v2 over both masses, where one touch lies on the line of the centres.
TEST(StopApproach, TwoThatMeetHeadOnGoOnTogether) {
    const Sym3d round{1, 1, 1, 0, 0, 0};
    std::vector<Touching> bodies{{{-1, 0, 0}, {3, 0, 0}, {}, 1, round}, {{1, 0, 0}, {}, {}, 0.5, round}};
    Contacts touches;
    touches.add(0, 1, {}, {-1, 0, 0});
    touches.stop(bodies);
    EXPECT_NEAR(bodies[0].velocity.x, 1, 1e-12);
    EXPECT_NEAR(bodies[1].velocity.x, 1, 1e-12);
    EXPECT_NEAR(touches.pushed(0), 2, 1e-12);
}

TEST(StopApproach, WhatPartsAlreadyIsLeftAloneBitForBit) {
    const Sym3d round{1, 1, 1, 0, 0, 0};
    std::vector<Touching> bodies{{{-1, 0, 0}, {-3, 0.3, 0}, {0, 0, 1}, 1, round},
                                 {{1, 0, 0}, {0.1, 0, 0}, {}, 0.5, round}};
    Contacts touches;
    touches.add(0, 1, {}, {-1, 0, 0});
    touches.stop(bodies);
    EXPECT_EQ(bodies[0].velocity, (Vec3d{-3, 0.3, 0}));
    EXPECT_EQ(bodies[1].velocity, (Vec3d{0.1, 0, 0}));
    EXPECT_EQ(touches.impulse(0), Vec3d{});
}

TEST(StopApproach, WhatStandsTakesTheImpulseAndStands) {
    const Sym3d round{1, 1, 1, 0, 0, 0};
    std::vector<Touching> bodies{{{0, 1, 0}, {0, -2, 0}, {}, 1, round}, {}};
    Contacts touches;
    touches.add(0, 1, {}, {0, 1, 0});
    touches.stop(bodies);
    EXPECT_NEAR(bodies[0].velocity.y, 0, 1e-12);
    EXPECT_EQ(bodies[1].velocity, Vec3d{});
    EXPECT_NEAR(touches.pushed(0), 2, 1e-12);
}

// Rough faces: the slide of 1 m/s becomes (1, 0.6) / 1.36 of it, along the teeth.
TEST(StopApproach, WhatSlidesOpensBySixTenthsOfWhatItSlidesAndLosesEnergy) {
    std::vector<Touching> bodies{{{-1, 0, 0}, {0, 1, 0}, {}, 1, {}}, {}};
    Contacts touches;
    touches.add(0, 1, {}, {-1, 0, 0});
    touches.stop(bodies);
    EXPECT_NEAR(bodies[0].velocity.x, -0.6 / 1.36, 1e-12);
    EXPECT_NEAR(bodies[0].velocity.y, 1 / 1.36, 1e-12);
}

TEST(StopApproach, RandomHeapsKeepMomentumAndAngularMomentumLoseEnergyAndHardlyCloseAnyMore) {
    const Random random{4};
    for (uint64_t heap = 0; heap < 200; ++heap) {
        uint64_t count = 0;
        const auto draw = [&](double low, double high) { return low + (high - low) * random.uniform(heap, count++); };
        const auto vector = [&](double size) { return Vec3d{draw(-size, size), draw(-size, size), draw(-size, size)}; };
        std::vector<Touching> bodies(6);
        for (Touching& b : bodies) {
            const Sym3d moments{draw(0.5, 2), draw(0.5, 2), draw(0.5, 2), draw(-0.1, 0.1), draw(-0.1, 0.1), 0};
            b = {vector(1), vector(5), vector(5), draw(0.2, 5), inverse(moments)};
        }
        Contacts touches;
        for (uint32_t a = 0; a < 6; ++a)
            for (uint32_t b = a + 1; b < 6; ++b) {
                const Vec3d between = bodies[a].centre - bodies[b].centre;
                const Vec3d middle = 0.5 * (bodies[a].centre + bodies[b].centre);
                for (int k = 0; k < 3; ++k) touches.add(a, b, middle + vector(0.2), (1 / length(between)) * between);
            }
        const Sums before = sums_of(bodies);
        const double worst_before = touches.most_closing(bodies);
        touches.stop(bodies);
        const double worst = touches.most_closing(bodies);
        const Sums after = sums_of(bodies);
        EXPECT_LT(length(after.momentum - before.momentum), 1e-10);
        EXPECT_LT(length(after.turning - before.turning), 1e-10);
        EXPECT_LE(after.energy, before.energy) << "heap " << heap;
        EXPECT_LT(worst, 0.05 * worst_before) << "heap " << heap;
    }
}

}  // namespace
}  // namespace cullet
