#include "sample_game/truth_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cullet {

std::span<const TruthCase> truth_cases() {
    static const TruthCase kCases[] = {{1, "stretched strip", stretched_strip},
                                       {2, "cantilever", cantilever},
                                       {3, "hanging chain", hanging_chain},
                                       {4, "catenary", catenary},
                                       {5, "wave on a chain", wave_on_a_chain},
                                       {6, "clamped disc under a point load", clamped_disc},
                                       {7, "spinning shell", spinning_shell},
                                       {8, "tearing strip", tearing_strip},
                                       {10, "first frequency of a plate", plate_frequency}};
    return kCases;
}

void print_verdicts(int number, const char* name, std::span<const Verdict> verdicts, std::vector<std::string>& faults) {
    fmt::print("case {}, {}\n", number, name);
    for (const Verdict& v : verdicts) {
        fmt::print("  {:<62} {:>12.6g}  {:.6g} to {:.6g}  {}\n", v.what, v.value, v.low, v.high,
                   v.is_met() ? "met" : "NOT MET");
        if (!v.is_met())
            faults.push_back(fmt::format("case {}, {}: {} is {:.6g}, not {:.6g} to {:.6g}.", number, name, v.what,
                                         v.value, v.low, v.high));
    }
    std::fflush(stdout);
}

void print_summaries(std::vector<CaseSummary> summaries) {
    std::sort(summaries.begin(), summaries.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    fmt::print("case  figures   met  verdict\n");
    for (const CaseSummary& one : summaries) {
        const auto met = std::count_if(one.verdicts.begin(), one.verdicts.end(), [](auto& v) { return v.is_met(); });
        const bool is_met = static_cast<size_t>(met) == one.verdicts.size();
        fmt::print("{:>4}  {:>7}  {:>4}  {:<8} {}\n", one.number, one.verdicts.size(), met, is_met ? "met" : "NOT MET",
                   one.name);
    }
}

}  // namespace cullet
