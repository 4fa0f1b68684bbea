// The verification cases of the method note, as `sample_game truth thick_shell` prints them.
#include <gtest/gtest.h>

#include <algorithm>

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
