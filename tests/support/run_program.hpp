// A program run to its end, and what it took.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace cullet::test {

struct ProgramRun {
    int exit_code = -1;  // -1: ended by a signal, or never started
    double seconds = 0;
    uint64_t peak_bytes = 0;  // the most that it, or one of its children, held in memory
    std::string output, error;
};

/// The first argument is the program's path.
ProgramRun run_program(std::vector<std::string> arguments);

}  // namespace cullet::test
