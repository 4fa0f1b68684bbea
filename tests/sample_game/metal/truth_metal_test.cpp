// The verification cases of metal shells, as `sample_game truth metal_shell` prints them. Those of a car need the test
// data.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sample_game/metal/metal_car.hpp"
#include "sample_game/metal/truth_metal.hpp"

namespace cullet {
namespace {

class TruthOfMetal : public testing::TestWithParam<TruthCase> {};

TEST_P(TruthOfMetal, LiesWithinTheBounds) {
    const std::vector<Verdict> verdicts = GetParam().measure();
    if (verdicts.empty()) GTEST_SKIP() << "no test data";
    for (const Verdict& v : verdicts) {
        EXPECT_GE(v.value, v.low) << v.what;
        EXPECT_LE(v.value, v.high) << v.what;
    }
}

std::vector<TruthCase> all_cases() {
    const auto cases = metal_truth_cases();
    return {cases.begin(), cases.end()};
}
std::string name_of_case(const testing::TestParamInfo<TruthCase>& info) {
    std::string name = std::to_string(info.index) + "_" + info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Cases, TruthOfMetal, testing::ValuesIn(all_cases()), name_of_case);

}  // namespace
}  // namespace cullet
