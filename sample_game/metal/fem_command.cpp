#include "sample_game/metal/fem_command.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sample_game/metal/fem_wanted.hpp"
#include "sample_game/report.hpp"

namespace cullet {
namespace {

int refuse(const std::string& sentence) {
    fmt::print(stderr, "{}\n", sentence);
    return 2;
}

std::string csv_of(const MidLine& line, const FemCurve& curve) {
    std::string text = "x_m,ours_m,fem_m\n";
    for (size_t k = 0; k < line.x.size(); ++k)
        text += fmt::format("{:.6f},{:.7f},{:.7f}\n", line.x[k], line.depth[k], curve.at(line.x[k]));
    return text;
}

}  // namespace

int run_fem(const FemOptions& options) {
    if (!options.deck.empty()) {
        if (auto written = write_text(fem_deck(options.sheet), options.deck); !written.ok())
            return refuse(written.error());
        fmt::print("{}: run ccx -i {}\n", options.deck, std::filesystem::path(options.deck).stem().string());
        return 0;
    }
    if (options.curve.empty() == options.results.empty())
        return refuse("fem: give --curve FILE, or --results FILE of ccx, or --deck FILE to write a deck.");
    const Result<FemCurve> curve =
        options.curve.empty() ? read_fem_results(options.results, options.sheet) : read_fem_curve(options.curve);
    if (!curve.ok()) return refuse(curve.error());
    FemBlow blow = options.blow;
    if (!(blow.work > 0)) blow.work = curve->work;
    if (!(blow.work > 0)) return refuse("fem: the curve does not say its work; give --work-j.");
    if (options.is_published) blow.published = kAllPublished;
    const Result<FemDent> dent = dent_of(options.sheet, blow);
    if (!dent.ok()) return refuse(dent.error());
    const FemMeasures measures = compare_with_fem(dent->line, *curve);
    fmt::print("work {:.0f} J, ball of {:.0f} mm, {} mm of {}: {:.1f} mm deep, contact {:.0f} mm\n", blow.work,
               1e3 * dent->ball_radius, 1e3 * options.sheet.thickness, options.sheet.material, 1e3 * dent->depth,
               1e3 * dent->contact);
    bool is_met = true;
    for (const Verdict& v : fem_verdicts(measures, blow.work)) {
        is_met = is_met && v.is_met();
        fmt::print("  {:<42} {:>8.4f}  {:.4g} to {:.4g}  {}\n", v.what, v.value, v.low, v.high,
                   v.is_met() ? "met" : "NOT MET");
    }
    if (blow.work < kLeastFemWork) fmt::print("  below {:.0f} J nothing is asked\n", kLeastFemWork);
    if (!options.out.empty()) {
        std::error_code error;
        std::filesystem::create_directories(options.out, error);
        if (auto written = write_text(csv_of(dent->line, *curve), options.out + "/mid_line.csv"); !written.ok())
            return refuse(written.error());
    }
    return is_met ? 0 : 1;
}

}  // namespace cullet
