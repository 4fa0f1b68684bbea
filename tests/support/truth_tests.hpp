// The verification cases of a model as tests, one a case: that what `sample_game truth` prints lies within its bounds.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <string>
#include <vector>

#include "sample_game/truth_cases.hpp"

namespace cullet::test {

/// Skips a case that has nothing to measure: it needs test data.
inline void expect_within_bounds(const TruthCase& one) {
    const std::vector<Verdict> verdicts = one.measure();
    if (verdicts.empty()) GTEST_SKIP() << "no test data";
    for (const Verdict& v : verdicts) {
        EXPECT_GE(v.value, v.low) << v.what;
        EXPECT_LE(v.value, v.high) << v.what;
    }
}

inline auto each_of(std::span<const TruthCase> cases) {
    return testing::ValuesIn(std::vector<TruthCase>(cases.begin(), cases.end()));
}

inline std::string name_of_case(const testing::TestParamInfo<TruthCase>& info) {
    std::string name = std::to_string(info.index) + "_" + info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

}  // namespace cullet::test
