// Where the meshes of strangers are.
#pragma once
#include <cstdlib>
#include <filesystem>

#include "tests/support/places.hpp"

namespace cullet::test {

/// CULLET_TEST_DATA, or the folder shared/data beside the repository.
inline std::filesystem::path test_data() {
    if (const char* folder = std::getenv("CULLET_TEST_DATA")) return folder;
    return std::filesystem::path(source_folder()) / "../shared/data";
}

}  // namespace cullet::test

/// For the first lines of a test. scripts/test.sh counts these sentences.
#define CULLET_SKIP_WITHOUT_DATA()                                           \
    if (!std::filesystem::exists(::cullet::test::test_data() / "README.md")) \
    GTEST_SKIP() << "no meshes at " << ::cullet::test::test_data() << "; set CULLET_TEST_DATA"
