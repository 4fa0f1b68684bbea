#include "cullet/result.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "cullet/version.hpp"

namespace cullet {
namespace {

TEST(Result, AConstResultIsReadThroughItsStar) {
    const Result<std::string> good(std::string("vase"));
    EXPECT_EQ(*good, "vase");
    EXPECT_EQ(good->size(), 4u);
    EXPECT_TRUE(good.error().empty());
}

TEST(Result, ATemporaryResultGivesItsValueAway) {
    const std::unique_ptr<int> taken = *Result<std::unique_ptr<int>>(std::make_unique<int>(7));
    EXPECT_EQ(*taken, 7);
}

TEST(Result, ValueOrStandsInForAnError) {
    const Result<int> good(3), bad(Error{"speed is -1 m/s; use 0 or more."});
    EXPECT_EQ(good.value_or(5), 3);
    EXPECT_EQ(bad.value_or(5), 5);
    EXPECT_EQ(Result<std::unique_ptr<int>>(Error{"none"}).value_or(nullptr), nullptr);
    EXPECT_EQ(bad.error(), "speed is -1 m/s; use 0 or more.");
}

// In every build: whoever goes on without the value would go on with whatever stands there.
TEST(Result, TheValueOfARefusalStopsWithItsSentence) {
    const auto of = [] { return Result<std::string>(Error{"speed is -1 m/s; use 0 or more."}); };
    const char* const sentence = "speed is -1 m/s; use 0 or more";
    EXPECT_DEATH((void)of().value(), sentence);
    EXPECT_DEATH((void)*of(), sentence);
    EXPECT_DEATH((void)of()->size(), sentence);
    Result<std::string> named = of();
    EXPECT_DEATH((void)named.value(), sentence);
    const Result<std::string> fixed = of();
    EXPECT_DEATH((void)fixed.value(), sentence);
    EXPECT_DEATH((void)fixed->size(), sentence);
}

TEST(Version, TheTextIsMadeOfTheMacros) {
    EXPECT_EQ(version(), std::to_string(CULLET_VERSION_MAJOR) + "." + std::to_string(CULLET_VERSION_MINOR) + "." +
                             std::to_string(CULLET_VERSION_PATCH));
}

}  // namespace
}  // namespace cullet
