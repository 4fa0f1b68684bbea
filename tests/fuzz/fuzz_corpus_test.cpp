// Every input that once was a finding, and some seconds of others, through the readers. scripts/fuzz.sh looks further.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/fuzz/fuzz.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/places.hpp"

namespace cullet::fuzz {
namespace {

/// Of each format: 2, in the long run 20, or as many as CULLET_FUZZ_SECONDS says.
double seconds_to_look() {
    const char* text = std::getenv("CULLET_FUZZ_SECONDS");
    return text ? std::atof(text) : test::few_or_all(2.0, 20.0);
}

/// A line of a corpus: the input in hexadecimal; what a finding was called may follow it.
Bytes bytes_of_hex(const std::string& line) {
    Bytes bytes;
    for (size_t at = 0; at + 1 < line.size() && line[at] != ' '; at += 2)
        bytes.push_back(static_cast<uint8_t>(std::stoul(line.substr(at, 2), nullptr, 16)));
    return bytes;
}

class EveryFormat : public testing::TestWithParam<const Format*> {};

TEST_P(EveryFormat, EveryGoodFileIsAccepted) {
    const Format& format = *GetParam();
    for (const Bytes& seed : seeds_of(format)) EXPECT_TRUE(format.read(seed)) << format.name;
}

TEST_P(EveryFormat, TheCorpusIsReadOrRefused) {
    const Format& format = *GetParam();
    const std::string path = source_folder() + "/tests/fuzz/corpus/" + format.name + ".txt";
    std::ifstream file(path);
    size_t count = 0;
    for (std::string line; std::getline(file, line); ++count) {
        SCOPED_TRACE(line);
        (void)run(format, bytes_of_hex(line));
    }
    EXPECT_GT(count, 100u) << path;
}

TEST_P(EveryFormat, DamagedFilesAreReadOrRefused) {
    const Format& format = *GetParam();
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds_to_look());
    uint32_t inputs = 0, accepted = 0;
    for (; std::chrono::steady_clock::now() < end; ++inputs) {
        RecordProperty("input", static_cast<int>(inputs));
        accepted += run(format, mutation(inputs));
    }
    // Edits of numbers that any value suits are to be let through, or nothing behind the reader is looked at.
    EXPECT_GT(accepted, inputs / 1000) << "of " << inputs;
    EXPECT_LT(accepted, inputs) << "every damaged file was taken";
    std::printf("%s: %u inputs, %u accepted\n", format.name, inputs, accepted);
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat, testing::Values(&mesh_file, &model_file, &snapshot, &recording),
                         [](const auto& format) { return std::string(format.param->name); });

}  // namespace
}  // namespace cullet::fuzz
