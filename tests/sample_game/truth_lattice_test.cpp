// The verification cases of solids, as `sample_game truth lattice` prints them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "sample_game/truth_cases.hpp"

namespace cullet {
namespace {

class TruthOfSolids : public testing::TestWithParam<TruthCase> {};

TEST_P(TruthOfSolids, LiesWithinTheBounds) {
    for (const Verdict& v : GetParam().measure()) {
        EXPECT_GE(v.value, v.low) << v.what;
        EXPECT_LE(v.value, v.high) << v.what;
    }
}

std::vector<TruthCase> all_cases() {
    const auto cases = lattice_truth_cases();
    return {cases.begin(), cases.end()};
}
std::string name_of_case(const testing::TestParamInfo<TruthCase>& info) {
    std::string name = std::to_string(info.index) + "_" + info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, TruthOfSolids, testing::ValuesIn(all_cases()), name_of_case);

}  // namespace
}  // namespace cullet
