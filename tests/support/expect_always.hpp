// Properties: what holds for every input, tried on random ones. RapidCheck makes them and shrinks one that fails.
#pragma once
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace cullet::test {

/// Calls `property` with random arguments of its parameters' types until it held `cases` times; it fails by RC_ASSERT.
/// Always the same inputs, unless CULLET_PROPERTY_SEED names another seed than 1. A failure prints the smallest input
/// found that fails.
template <class Property>
void expect_always(int cases, Property&& property) {
    rc::detail::TestParams params;
    const char* seed = std::getenv("CULLET_PROPERTY_SEED");
    params.seed = seed ? std::strtoull(seed, nullptr, 10) : 1;
    params.maxSuccess = cases;
    rc::detail::TestMetadata metadata;
    if (const auto* info = ::testing::UnitTest::GetInstance()->current_test_info())
        metadata.id = std::string(info->test_suite_name()) + "." + info->name();
    const rc::detail::TestResult result = rc::detail::checkTestable(std::forward<Property>(property), metadata, params);
    if (result.template is<rc::detail::SuccessResult>()) return;
    std::ostringstream sentence;
    rc::detail::printResultMessage(result, sentence);
    ADD_FAILURE() << sentence.str() << "\n(seed " << params.seed << "; CULLET_PROPERTY_SEED chooses another)";
}

}  // namespace cullet::test
