// Cooking touches nothing that is shared.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "sample_game/meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

// The bytes of the model file of a cooked vase; empty when something was refused.
std::string cooked_bytes(const std::string& file) {
    CookSettings settings;
    settings.longest_edge = 100;
    const Mesh mesh = make_vase(0.3f, 0.02f);
    const Result<Model> model = cook(view_of_mesh(mesh), settings);
    const std::string path = testing::TempDir() + file;
    if (!model || !write_model(*model, path).ok()) return {};
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(CookOnThreads, TwoAtOnceGiveTheBytesOfOneAlone) {
    const std::string alone = cooked_bytes("cook_alone.cmodel");
    ASSERT_GT(alone.size(), 10'000u);
    for (int repeat = 0; repeat < 2; ++repeat) {
        std::string first, second;
        std::thread a([&] { first = cooked_bytes("cook_first.cmodel"); });
        std::thread b([&] { second = cooked_bytes("cook_second.cmodel"); });
        a.join(), b.join();
        EXPECT_TRUE(first == alone) << "the first thread's model differs";
        EXPECT_TRUE(second == alone) << "the second thread's model differs";
    }
}

}  // namespace
}  // namespace cullet::test
