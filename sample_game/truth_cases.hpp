// The verification cases of the methods: what a formula, or a solution that is known, says about the springs and the
// hidden step.
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

/// One case of `sample_game truth MODEL`, seconds each. A case more is a line in truth_cases.cpp, of metal in
/// metal/truth_metal.cpp, of solids in truth_lattice.cpp.
struct TruthCase {
    int number;  // of the method note's section 15
    const char* name;
    std::vector<Verdict> (*measure)();
};
std::span<const TruthCase> truth_cases();
std::span<const TruthCase> metal_truth_cases();
std::span<const TruthCase> lattice_truth_cases();

std::vector<Verdict> stretched_strip();
std::vector<Verdict> cantilever();
std::vector<Verdict> hanging_chain();
std::vector<Verdict> catenary();
std::vector<Verdict> wave_on_a_chain();
std::vector<Verdict> clamped_disc();
std::vector<Verdict> spinning_shell();
std::vector<Verdict> tearing_strip();
std::vector<Verdict> plate_frequency();

/// Measured by name; case 9, which takes minutes and settings, is told by truth_hits.hpp.
struct CaseSummary {
    int number;
    const char* name;
    std::vector<Verdict> verdicts;
};

/// Prints a case's figures with bounds; adds sentences about those that are not met.
void print_verdicts(int number, const char* name, std::span<const Verdict> verdicts, std::vector<std::string>& faults);
/// One line a case, by number.
void print_summaries(std::vector<CaseSummary> summaries);

}  // namespace cullet
