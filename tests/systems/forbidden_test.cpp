// The compiler sees to it that a system, and each helper below it, reaches what its parameters name and nothing else.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"

namespace cullet {
namespace {

std::set<uint32_t> marked_lines(const std::string& path) {
    std::ifstream file(path);
    std::set<uint32_t> marked;
    uint32_t number = 0;
    for (std::string line; std::getline(file, line);)
        if (++number; line.find("// forbidden: ") != line.npos) marked.insert(number);
    return marked;
}

#ifdef __clang__  // whose driver ends after 20 errors
constexpr const char* kEveryError = "-ferror-limit=0";
#else
constexpr const char* kEveryError = "-fmax-errors=0";
#endif

/// Lines of the file in which the compiler found an error, or what a template of the library was asked for wrongly.
std::set<uint32_t> refused_lines(const std::string& said) {
    static const std::regex place("forbidden\\.cpp:(\\d+):\\d+:\\s+(error|required from here|note: in instantiation)");
    std::set<uint32_t> refused;
    for (std::sregex_iterator at(said.begin(), said.end(), place), end; at != end; ++at)
        refused.insert(static_cast<uint32_t>(std::stoul((*at)[1])));
    return refused;
}

TEST(Forbidden, WhatASystemDoesNotDeclareDoesNotCompile) {
    const std::string folder = source_folder(), path = folder + "/tests/systems/forbidden/forbidden.cpp";
    const test::ProgramRun run =
        test::run_program({compiler(), "-std=c++20", "-fsyntax-only", kEveryError, "-I" + folder,
                           "-I" + folder + "/engine/include", "-isystem", "/usr/include/eigen3", path});
    EXPECT_NE(run.exit_code, 0);
    const std::set<uint32_t> marked = marked_lines(path);
    EXPECT_GE(marked.size(), 11u);
    EXPECT_EQ(refused_lines(run.error), marked) << run.error;
}

}  // namespace
}  // namespace cullet
