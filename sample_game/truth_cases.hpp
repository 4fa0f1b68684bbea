// The verification cases of the methods: what a formula, or a solution that is known, says about the springs.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace cullet {

/// One figure of a case and what it has to lie in.
struct Verdict {
    std::string what;  // "contraction over elongation"
    double value = 0, low = 0, high = 0;
    bool is_met() const { return value >= low && value <= high; }
};

/// One row of `sample_game truth thick_shell`. A case more is a line in truth_cases.cpp.
struct TruthCase {
    int number;  // of the method note's section 15
    const char* name;
    std::vector<Verdict> (*measure)();
};
std::span<const TruthCase> truth_cases();

std::vector<Verdict> stretched_strip();
std::vector<Verdict> cantilever();
std::vector<Verdict> hanging_chain();
std::vector<Verdict> catenary();
std::vector<Verdict> wave_on_a_chain();
std::vector<Verdict> clamped_disc();
std::vector<Verdict> spinning_shell();
std::vector<Verdict> tearing_strip();

/// Prints each case's figures with bounds; sentences about those that are not met.
std::vector<std::string> print_truth_cases();

}  // namespace cullet
