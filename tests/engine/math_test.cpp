#include "engine/math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"

namespace cullet {
namespace {

constexpr double kPi = 3.14159265358979323846;

// n values from a to b, both included, and as many at random between them.
template <class F>
void over(double a, double b, F call) {
    constexpr int kSteps = 20000;
    for (int n = 0; n <= kSteps; ++n) call(a + (b - a) * n / kSteps);
    for (uint32_t n = 0; n < kSteps; ++n) call(a + (b - a) * Random{11}.uniform(n));
}

TEST(Math, SineAndCosineAreWithin1em13ForAnglesUpTo10000) {
    double worst = 0;
    const auto check = [&](double x) {
        double s, c;
        sine_cosine(x, s, c);
        worst = std::max({worst, std::abs(s - std::sin(x)), std::abs(c - std::cos(x))});
    };
    over(-10, 10, check);
    over(-1e4, 1e4, check);
    for (int quarter = -6366; quarter <= 6366; ++quarter)
        check(quarter * (kPi / 2)), check((quarter + 0.5) * (kPi / 2));
    EXPECT_LT(worst, 1e-13);
}

TEST(Math, TheSineOfASmallAngleIsTheAngle) {
    double s, c;
    sine_cosine(1e-30, s, c);
    EXPECT_EQ(s, 1e-30);
    EXPECT_EQ(c, 1.0);
}

TEST(Math, ArcCosineIsWithin1em12AndClamps) {
    double worst = 0;
    const auto check = [&](double x) { worst = std::max(worst, std::abs(arc_cosine(x) - std::acos(x))); };
    over(-1, 1, check);
    over(-1, -1 + 1e-9, check);
    over(1 - 1e-9, 1, check);
    EXPECT_LT(worst, 1e-12);
    EXPECT_EQ(arc_cosine(1.5), 0.0);
    EXPECT_EQ(arc_cosine(1), 0.0);
    EXPECT_NEAR(arc_cosine(-1.5), kPi, 1e-15);
}

TEST(Math, LogarithmIsWithin1em14Relative) {
    double worst = 0;
    const auto check = [&](double x) {
        const double libm = std::log(x);
        if (libm != 0) worst = std::max(worst, std::abs(logarithm(x) - libm) / std::abs(libm));
    };
    over(1e-6, 4, check);
    over(1 - 1e-6, 1 + 1e-6, check);
    over(1, 1e9, check);
    for (double x = 1e-300; x < 1e300; x *= 1.7) check(x);
    EXPECT_LT(worst, 1e-14);
    EXPECT_EQ(logarithm(1), 0.0);
}

TEST(Math, ExponentialIsWithin1em14Relative) {
    double worst = 0;
    const auto check = [&](double x) { worst = std::max(worst, std::abs(exponential(x) - std::exp(x)) / std::exp(x)); };
    over(-2, 2, check);
    over(-699.9, 699.9, check);
    EXPECT_LT(worst, 1e-14);
    EXPECT_EQ(exponential(0), 1.0);
}

TEST(Math, TheLogarithmOfTheExponentialIsTheNumber) {
    over(-300, 300, [](double x) { ASSERT_NEAR(logarithm(exponential(x)), x, 1e-13 * (1 + std::abs(x))); });
}

double at_random(uint32_t n, uint32_t k) {
    return 2 * Random{23}.uniform(n, k) - 1;
}

TEST(Math, AMatrixTimesItsInverseIsOne) {
    for (uint32_t n = 0; n < 2000; ++n) {
        // Sum of outer products: positive definite, like an inertia.
        Sym3d m{};
        for (uint32_t k = 0; k < 4; ++k)
            m = m + outer({at_random(n, 3 * k), at_random(n, 3 * k + 1), at_random(n, 3 * k + 2)});
        if (determinant(m) < 1e-3) continue;
        const Sym3d i = inverse(m);
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3d e{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
            const Vec3d same = m * (i * e) - e;
            ASSERT_LT(length(same), 1e-10);
        }
    }
}

TEST(Math, ASingularMatrixHasTheInverseZero) {
    const Sym3d zero = inverse(Sym3d{}), flat = inverse(outer({1, 2, 4}));
    EXPECT_EQ(trace(zero), 0.0);
    EXPECT_EQ(trace(flat), 0.0);
    EXPECT_EQ(flat.xy, 0.0);
}

TEST(Math, TheInertiaOfADumbbellIsMTimesDistanceSquared) {
    // Two of 3 kg at x = -2 and 2 m: 24 kg m2 about y and z, none about x.
    const Sym3d i = inertia_of(3.0 * outer({2, 0, 0}) + 3.0 * outer({-2, 0, 0}));
    EXPECT_EQ(i.xx, 0.0);
    EXPECT_EQ(i.yy, 24.0);
    EXPECT_EQ(i.zz, 24.0);
}

Quat about(Vec3 axis, double angle) {
    double s, c;
    sine_cosine(angle / 2, s, c);
    const Vec3 v = static_cast<float>(s) * normalised(axis);
    return {v.x, v.y, v.z, static_cast<float>(c)};
}

Quat some_turn(uint32_t n) {
    return normalised(Quat{static_cast<float>(at_random(n, 0)), static_cast<float>(at_random(n, 1)),
                           static_cast<float>(at_random(n, 2)), static_cast<float>(at_random(n, 3))});
}

TEST(Math, AQuarterTurnAboutYTakesZToX) {
    const Vec3 x = rotate(about({0, 1, 0}, kPi / 2), {0, 0, 1});
    EXPECT_NEAR(x.x, 1, 1e-6);
    EXPECT_NEAR(x.y, 0, 1e-6);
    EXPECT_NEAR(x.z, 0, 1e-6);
}

TEST(Math, AQuaternionItsMatrixAndItsConjugateAgree) {
    for (uint32_t n = 0; n < 1000; ++n) {
        const Quat q = some_turn(n), p = some_turn(n + 5000);
        const Vec3 v{static_cast<float>(at_random(n, 7)), static_cast<float>(at_random(n, 8)), 0.5f};
        ASSERT_LT(length(rotate(q, v) - matrix(q) * v), 2e-6f);
        ASSERT_LT(length(rotate(conjugate(q), v) - transposed_times(matrix(q), v)), 2e-6f);
        ASSERT_LT(length(rotate(q * p, v) - rotate(q, rotate(p, v))), 2e-6f);
        ASSERT_LT(length(rotate(conjugate(q), rotate(q, v)) - v), 2e-6f);
        ASSERT_NEAR(length(rotate(q, v)), length(v), 2e-6f);
        const Pose pose{{1, 2, 3}, q};
        ASSERT_LT(length(to_body(pose, to_world(pose, v)) - v), 4e-6f);
    }
}

TEST(Math, TheZeroVectorAndTheZeroQuaternionNormaliseToSomethingFinite) {
    EXPECT_EQ(normalised(Vec3{}), (Vec3{}));
    EXPECT_EQ(normalised(Vec3d{}), (Vec3d{}));
    const Quat q = normalised(Quat{0, 0, 0, 0});
    EXPECT_EQ(q.w, 1.0f);
}

TEST(Random, NumbersDependOnTheirNamesAndSpreadEvenly) {
    const Random random{3};
    EXPECT_EQ(random.bits(5, 6), Random{3}.bits(5, 6));
    EXPECT_NE(random.bits(5, 6), random.bits(6, 5));
    EXPECT_NE(random.bits(5, 6), Random{4}.bits(5, 6));
    double sum = 0, squares = 0;
    constexpr uint32_t kMany = 100000;
    for (uint32_t n = 0; n < kMany; ++n) {
        const double u = random.uniform(n / 300, n % 300);
        ASSERT_TRUE(u >= 0 && u < 1);
        sum += u, squares += u * u;
    }
    EXPECT_NEAR(sum / kMany, 0.5, 4 * std::sqrt(1.0 / 12 / kMany));
    EXPECT_NEAR(squares / kMany, 1.0 / 3, 0.005);
}

}  // namespace
}  // namespace cullet
