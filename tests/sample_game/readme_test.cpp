// The page that people read first says what is so.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace cullet {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(std::string(CULLET_SOURCE_DIR) + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ShowsTheExampleThatIsBuiltAndRun) {
    const std::string example = text_of("/tests/consumer/main.cpp");
    ASSERT_FALSE(example.empty());
    EXPECT_NE(text_of("/README.md").find(example), std::string::npos);
    EXPECT_LE(std::count(example.begin(), example.end(), '\n'), 64);  // somebody reads it to the end
}

}  // namespace
}  // namespace cullet
