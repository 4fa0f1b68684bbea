#include "engine/import/fbx_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cullet {
namespace {

Vec3d axis(int number, int sign) {
    return {number == 0 ? sign : 0.0, number == 1 ? sign : 0.0, number == 2 ? sign : 0.0};
}

bool is_right_handed(Vec3d x, Vec3d y, Vec3d z) {
    return dot(cross(x, y), z) > 0;
}

double largest_difference(Vec3d a, Vec3d b) {
    return std::fmax(std::fabs(a.x - b.x), std::fmax(std::fabs(a.y - b.y), std::fabs(a.z - b.z)));
}

/// All six ways for up times four for the right, with either sign of the front.
template <class Call>
void for_all_axes(const Call& call) {
    for (int up = 0; up < 3; ++up)
        for (int coord = 0; coord < 3; ++coord)
            for (int signs = 0; signs < 8 && up != coord; ++signs) {
                FbxAxes axes;
                axes.up = up, axes.coord = coord, axes.front = 3 - up - coord;
                axes.up_sign = (signs & 1) != 0 ? -1 : 1;
                axes.coord_sign = (signs & 2) != 0 ? -1 : 1;
                axes.front_sign = (signs & 4) != 0 ? -1 : 1;
                call(axes);
            }
}

TEST(FbxPlace, UpIsUpAndRightIsRightForAllAxesAndSigns) {
    int count = 0;
    for_all_axes([&](const FbxAxes& axes) {
        ++count;
        std::vector<std::string> notes;
        FbxAxes metres = axes;
        metres.unit = 100;
        const Affine place = place_of(metres, notes);
        const Vec3d x = axis(axes.coord, axes.coord_sign), y = axis(axes.up, axes.up_sign),
                    z = axis(axes.front, axes.front_sign);
        EXPECT_LT(largest_difference(placed(place, x), {1, 0, 0}), 1e-12);
        EXPECT_LT(largest_difference(placed(place, y), {0, 1, 0}), 1e-12);
        EXPECT_NEAR(determinant(place), 1, 1e-12) << "no file is mirrored";
        if (is_right_handed(x, y, z)) {
            EXPECT_LT(largest_difference(placed(place, z), {0, 0, 1}), 1e-12);
            EXPECT_TRUE(notes.empty()) << notes[0];
        } else {
            EXPECT_EQ(notes.size(), 1u);
        }
    });
    EXPECT_EQ(count, 48);
}

TEST(FbxPlace, ItsUnitIsInCentimetres) {
    for (const double unit : {0.1, 1.0, 2.54, 30.48, 91.44, 100.0, 100000.0, 1e-4}) {
        std::vector<std::string> notes;
        FbxAxes axes;
        axes.unit = unit;
        const Affine place = place_of(axes, notes);
        EXPECT_NEAR(placed(place, {3, 5, 7}).y, 0.05 * unit, 1e-12 * unit);
        EXPECT_TRUE(notes.empty());
    }
}

TEST(FbxPlace, WhatIsNoAxisOrNoUnitIsSaidAndTheDefaultStandsIn) {
    for (const double unit :
         {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        std::vector<std::string> notes;
        FbxAxes axes;
        axes.unit = unit;
        EXPECT_NEAR(placed(place_of(axes, notes), {100, 0, 0}).x, 1, 1e-12);
        EXPECT_EQ(notes.size(), 1u) << unit;
    }
    for (int up = -1; up <= 3; ++up)
        for (int front = -1; front <= 3; ++front)
            for (int coord = -1; coord <= 3; ++coord) {
                std::vector<std::string> notes;
                FbxAxes axes;
                axes.up = up, axes.front = front, axes.coord = coord, axes.unit = 100;
                const Affine place = place_of(axes, notes);
                EXPECT_NEAR(determinant(place), 1, 1e-12);
                if (up >= 0 && up < 3) {
                    EXPECT_LT(largest_difference(placed(place, axis(up, 1)), {0, 1, 0}), 1e-12);
                }
                const auto is_axis = [](int a) { return a >= 0 && a < 3; };
                const bool are_three =
                    is_axis(up) && is_axis(front) && is_axis(coord) && up != front && front != coord && coord != up;
                EXPECT_TRUE(are_three || !notes.empty());
            }
}

}  // namespace
}  // namespace cullet
