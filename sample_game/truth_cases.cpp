#include "sample_game/truth_cases.hpp"

#include <fmt/format.h>

namespace cullet {

std::span<const TruthCase> truth_cases() {
    static const TruthCase kCases[] = {
        {1, "stretched strip", stretched_strip}, {2, "cantilever", cantilever},
        {3, "hanging chain", hanging_chain},     {4, "catenary", catenary},
        {5, "wave on a chain", wave_on_a_chain}, {6, "clamped disc under a point load", clamped_disc},
        {7, "spinning shell", spinning_shell},   {8, "tearing strip", tearing_strip}};
    return kCases;
}

std::vector<std::string> print_truth_cases() {
    std::vector<std::string> faults;
    for (const TruthCase& one : truth_cases()) {
        fmt::print("case {}, {}\n", one.number, one.name);
        for (const Verdict& v : one.measure()) {
            fmt::print("  {:<62} {:>12.6g}  {:.6g} to {:.6g}  {}\n", v.what, v.value, v.low, v.high,
                       v.is_met() ? "met" : "NOT MET");
            if (!v.is_met())
                faults.push_back(fmt::format("case {}, {}: {} is {:.6g}, not {:.6g} to {:.6g}.", one.number, one.name,
                                             v.what, v.value, v.low, v.high));
        }
    }
    return faults;
}

}  // namespace cullet
