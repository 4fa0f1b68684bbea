// The verification cases of the method note, as `sample_game truth thick_shell` prints them.
#include <gtest/gtest.h>

#include <algorithm>

#include "sample_game/spring_bench.hpp"
#include "sample_game/truth_cases.hpp"

namespace cullet {
namespace {

class TruthOfSprings : public testing::TestWithParam<TruthCase> {};

TEST_P(TruthOfSprings, LiesWithinTheBounds) {
    const std::vector<Verdict> verdicts = GetParam().measure();
    EXPECT_FALSE(verdicts.empty());
    for (const Verdict& v : verdicts) {
        EXPECT_GE(v.value, v.low) << v.what;
        EXPECT_LE(v.value, v.high) << v.what;
        EXPECT_LT(v.low, v.high + 1e-12) << v.what;
    }
}

TEST(BenchDisc, HasAllTrianglesRoundEveryPointWithinItsRings) {
    for (const uint32_t rings : {1u, 5u, 10u, 20u, 40u}) {
        const BenchMesh mesh = bench_disc(rings, 1);
        std::vector<uint32_t> triangles(mesh.points.size());
        for (const auto& triangle : mesh.triangles)
            for (const uint32_t v : triangle) ++triangles[v];
        for (uint32_t v = 0; v < mesh.points.size(); ++v) {
            if (length(mesh.points[v]) <= rings - 0.5) {
                EXPECT_EQ(triangles[v], 6u) << rings << " rings, point " << v;
            }
        }
    }
}

std::vector<TruthCase> all_cases() {
    const auto cases = truth_cases();
    return {cases.begin(), cases.end()};
}
std::string name_of(const testing::TestParamInfo<TruthCase>& info) {
    std::string name = "Case" + std::to_string(info.param.number) + "_" + info.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(ThickShell, TruthOfSprings, testing::ValuesIn(all_cases()), name_of);

}  // namespace
}  // namespace cullet
