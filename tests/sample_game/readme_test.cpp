// The page that people read first says what is so.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/support/places.hpp"

namespace cullet {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(source_folder() + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ShowsTheExampleThatIsBuiltAndRun) {
    const std::string example = text_of("/tests/consumer/main.cpp");
    ASSERT_FALSE(example.empty());
    EXPECT_NE(text_of("/README.md").find(example), std::string::npos);
    EXPECT_LE(std::count(example.begin(), example.end(), '\n'), 64);  // somebody reads it to the end
}

TEST(Embedding, ShowsOnlyCodeThatIsBuiltAndRun) {
    const std::string page = text_of("/docs/embedding.md"), open = "```cpp\n", close = "```\n";
    const std::string code = text_of("/tests/consumer/embedding.cpp") + text_of("/tests/host/plain_physics.hpp");
    size_t blocks = 0;
    for (size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
        at += open.size();
        const std::string block = page.substr(at, page.find(close, at) - at);
        EXPECT_NE(code.find(block), std::string::npos) << block;
        ++blocks;
    }
    EXPECT_EQ(blocks, 10u);
}

}  // namespace
}  // namespace cullet
