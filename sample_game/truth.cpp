#include "sample_game/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "sample_game/report.hpp"
#include "sample_game/truth_cases.hpp"
#include "sample_game/truth_hits.hpp"

namespace cullet {
namespace {

/// What is to be true of a damage model: a line more is a model more.
struct Truth {
    const char* model;
    std::span<const TruthCase> (*cases)();
    bool has_hidden_run = false;  // whose thresholds are measured as well
};
constexpr Truth kTruths[] = {
    {"thick_shell", truth_cases, true}, {"metal_shell", metal_truth_cases}, {"lattice", lattice_truth_cases}};

}  // namespace

std::string truth_models() {
    std::string names;
    for (const Truth& truth : kTruths) names += (names.empty() ? "" : ", ") + std::string(truth.model);
    return names;
}

int run_truth(const std::string& model, const TruthSettings& given) {
    const auto truth =
        std::find_if(std::begin(kTruths), std::end(kTruths), [&](const Truth& t) { return model == t.model; });
    if (truth == std::end(kTruths)) {
        fmt::print(stderr, "truth {}: not known; there are {}.\n", model, truth_models());
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
    for (const TruthCase& one : truth->cases()) tell(one.number, one.name, one.measure());
    nlohmann::json json;
    if (truth->has_hidden_run) {
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
