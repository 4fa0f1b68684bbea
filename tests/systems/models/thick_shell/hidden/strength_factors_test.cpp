// The spread of strength over a shell.
#include "systems/models/thick_shell/hidden/strength_factors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/crack_meshes.hpp"

namespace cullet {
namespace {

using namespace crack_test;

std::vector<float> factors(Shell& shell, uint64_t seed) {
    fill_strength_factors(shell.view, seed);
    std::vector<float> found;
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v)
        found.push_back(shell.state->vertices.strength_factor[shell.view.vertex(v)]);
    return found;
}

TEST(StrengthFactors, FollowWeibullOfModulusTwelveAboutTheMedian) {
    Shell shell = make_shell_of(sheet(150, 150, 1, 1), 0, 0);
    std::vector<float> found = factors(shell, 42);
    std::sort(found.begin(), found.end());
    EXPECT_GE(found.front(), 0.5f);
    EXPECT_LE(found.back(), 1.5f);
    for (const double part : {0.05, 0.25, 0.5, 0.75, 0.95}) {
        const double wanted = std::pow(std::log(1 / (1 - part)) / std::log(2.0), 1.0 / 12);
        EXPECT_NEAR(found[static_cast<size_t>(part * static_cast<double>(found.size()))], wanted, 0.005);
    }
}

TEST(StrengthFactors, DependOnTheSeedAndTheVertexAlone) {
    Shell small = make_shell_of(sheet(5, 5, 1, 1), 0, 0), large = make_shell_of(sheet(9, 9, 1, 1), 0, 0);
    const auto a = factors(small, 1), b = factors(large, 1), c = factors(small, 2);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
    EXPECT_NE(a, c);
}

}  // namespace
}  // namespace cullet
