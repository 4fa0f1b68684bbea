#include "sample_game/truth.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sample_game/report.hpp"
#include "sample_game/truth_hits.hpp"

namespace cullet {

int run_truth(const std::string& model, const TruthSettings& given) {
    const bool is_thick = model == "thick_shell", is_metal = model == "metal_shell";
    if (!is_thick && !is_metal && model != "lattice") {
        fmt::print(stderr, "truth {}: not known; use thick_shell, metal_shell or lattice.\n", model);
        return 2;
    }
    std::error_code error;
    if (!given.out.empty() && (std::filesystem::create_directories(given.out, error), error)) {
        fmt::print(stderr, "truth --out {}: the folder could not be made ({}); choose another.\n", given.out,
                   error.message());
        return 2;
    }
    TruthSettings settings = given;
    if (settings.threads == 0) settings.threads = 2;
    // The hidden run comes last: it takes minutes, the others seconds.
    std::vector<std::string> faults;
    std::vector<CaseSummary> summaries;
    const auto tell = [&](int number, const char* name, const std::vector<Verdict>& verdicts) {
        print_verdicts(number, name, verdicts, faults);
        summaries.push_back({number, name, verdicts});
    };
    for (const TruthCase& one : is_metal ? metal_truth_cases() : is_thick ? truth_cases() : lattice_truth_cases())
        tell(one.number, one.name, one.measure());
    nlohmann::json json;
    if (is_thick) {
        fmt::print("case 9 is measured: the hidden run\n");
        Result<HitTruth> hits = tell_hits(settings);
        if (!hits.ok()) {
            fmt::print(stderr, "{}\n", hits.error());
            return 1;
        }
        tell(9, "thresholds of the hidden run", hits->verdicts);
        json = std::move(hits->json);
    }
    print_summaries(summaries);
    for (const std::string& fault : faults) fmt::print("NOT MET  {}\n", fault);
    if (faults.empty()) fmt::print("all figures are met\n");
    if (!settings.out.empty()) {
        for (const CaseSummary& one : summaries)
            for (const Verdict& v : one.verdicts)
                json["verdicts"].push_back({{"case", one.number},
                                            {"what", v.what},
                                            {"value", v.value},
                                            {"low", v.low},
                                            {"high", v.high},
                                            {"met", v.is_met()}});
        json["faults"] = faults;
        if (auto written = write_text(json.dump(2) + "\n", settings.out + "/truth.json"); !written.ok()) {
            fmt::print(stderr, "{}\n", written.error());
            return 2;
        }
    }
    return faults.empty() ? 0 : 1;
}

}  // namespace cullet
