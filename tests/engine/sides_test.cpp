// On which side of static triangles a place is.
#include "engine/bullet/sides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cullet {
namespace {

float real(uint32_t k) {
    return static_cast<float>(k);
}

TEST(Sides, AWayThroughAnEdgeOrACornerOfASheetCrossesItOnce) {
    std::mt19937 random(3);
    for (int k = 0; k < 500; ++k) {
        // A fan of triangles about a corner, and a triangle beneath it: what lies beneath is hidden from above.
        const auto spokes = static_cast<uint32_t>(3 + random() % 6);
        std::vector<Vec3> corners{{0, 0, 0}, {-1, -1, -1}, {2, -1, -1}, {-1, -1, 2}};
        std::vector<std::array<uint32_t, 3>> triangles{{1, 2, 3}};
        for (uint32_t s = 0; s < spokes; ++s) {
            const float angle = 6.2831853f * real(s) / real(spokes);
            corners.push_back({std::round(8 * std::cos(angle)), 0, std::round(8 * std::sin(angle))});
            triangles.push_back({0, 4 + s, 4 + (s + 1) % spokes});
            if (random() % 2) std::swap(triangles.back()[1], triangles.back()[2]);
        }
        const bullet::StaticMesh mesh = bullet::sort_static_triangles(corners, triangles);
        uint32_t beneath = 0;
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
            if (mesh.triangles[t].corner[0].y < 0) beneath = t;
        // Through the middle, and through a place on a spoke that is exactly on it.
        const float out = k % 2 ? 0 : 0.125f;
        const Vec3 through = out * corners[4 + random() % spokes], to{0, -1, 0}, from = through + (through - to);
        ASSERT_TRUE(bullet::is_hidden(mesh, beneath, from, to)) << k;
    }
}

}  // namespace
}  // namespace cullet
