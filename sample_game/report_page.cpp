#include "sample_game/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/html_text.hpp"
#include "sample_game/notes.hpp"

namespace cullet {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #23211e; --soft: #6d675f; --paper: #faf8f4; --card: #fff; --line: #e2ddd4;
        --quiet: #7c93ab; --broke: #c2562a; --budget: #2f7d4f; }
@media (prefers-color-scheme: dark) { :root { --ink: #e9e5dd; --soft: #a49d92; --paper: #1b1a18; --card: #242220;
        --line: #3a3733; --quiet: #7f9cbb; --broke: #e3834f; --budget: #6fc08f; } }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 1100px; margin: 0 auto; padding: 2rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; margin: 0; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
p.facts, figcaption { color: var(--soft); margin: .2rem 0; font-size: .92rem; }
figure { margin: 0; } svg, img, video { width: 100%; height: auto; display: block; border-radius: 6px; }
svg { background: var(--card); border: 1px solid var(--line); }
svg text { fill: var(--soft); font: 12px system-ui, sans-serif; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
td, th { text-align: left; padding: .2rem 1.4rem .2rem 0; border-bottom: 1px solid var(--line); font-weight: 400; }
th { color: var(--soft); }
)";

/// 1, 2 or 5 times a power of ten: about a fifth of `most`.
double grid_step(double most) {
    double step = 1e-3;
    for (int k = 0; step * 6 < most; ++k) step *= k % 3 == 1 ? 2.5 : 2.0;
    return step;
}

// One bar a column of the plot: of the frames that fall together the longest. Frames that broke something stand out.
std::string plot(const Report& r) {
    constexpr double kWidth = 1060, kHeight = 260, kLeft = 48, kBottom = 28, kTop = 14;
    const std::vector<float>& ms = r.each_frame_ms;
    if (ms.empty()) return "";
    const auto found = r.yardsticks.find("budget_ms");
    const double budget = found == r.yardsticks.end() ? 0 : found->second, frame = 1000 * r.dt_s;
    const double most = 1.08 * std::max({static_cast<double>(*std::max_element(ms.begin(), ms.end())), budget, 0.01});
    const double plot_width = kWidth - kLeft - 10, plot_height = kHeight - kBottom - kTop;
    const auto height_of = [&](double value) { return kTop + plot_height * (1 - value / most); };
    std::string svg =
        fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"milliseconds of each frame\">\n",
                    kWidth, kHeight);
    const double step = grid_step(most);
    for (double value = 0; value < most; value += step) {
        const double y = height_of(value);
        svg += fmt::format(
            "<path d=\"M{:.0f} {:.1f}H{:.0f}\" stroke=\"var(--line)\"/><text x=\"{:.0f}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{:g}</text>\n",
            kLeft, y, kWidth - 10, kLeft - 6, y + 4, value);
    }
    const size_t columns = std::min<size_t>(ms.size(), static_cast<size_t>(plot_width / 2));
    std::string quiet, broke;
    for (size_t c = 0; c < columns; ++c) {
        const size_t first = c * ms.size() / columns, end = std::max(first + 1, (c + 1) * ms.size() / columns);
        float longest = 0;
        bool has_broken = false;
        for (size_t f = first; f < end; ++f) {
            longest = std::max(longest, ms[f]);
            has_broken |= f < r.each_frame_broke.size() && r.each_frame_broke[f];
        }
        const double x = kLeft + plot_width * (static_cast<double>(c) + 0.5) / static_cast<double>(columns);
        (has_broken ? broke : quiet) +=
            fmt::format("M{:.1f} {:.1f}V{:.1f}", x, height_of(0), height_of(static_cast<double>(longest)));
    }
    const double pen = std::clamp(0.8 * plot_width / static_cast<double>(columns), 1.0, 8.0);
    svg += fmt::format("<path d=\"{}\" stroke=\"var(--quiet)\" stroke-width=\"{:.1f}\"/>\n", quiet, pen);
    svg += fmt::format("<path d=\"{}\" stroke=\"var(--broke)\" stroke-width=\"{:.1f}\"/>\n", broke, pen);
    const auto line = [&](double value, const char* what, const char* dashes) {
        if (value <= 0 || value > most) return;
        const double y = height_of(value);
        svg += fmt::format(
            "<path d=\"M{0:.0f} {1:.1f}H{2:.0f}\" stroke=\"var(--budget)\" stroke-width=\"1.5\" "
            "stroke-dasharray=\"{3}\"/>"
            "<text x=\"{2:.0f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5} {6:.2f} ms</text>\n",
            kLeft, y, kWidth - 12, dashes, y - 5, what, value);
    };
    line(budget, "budget", "none");
    line(frame, "a frame", "5 4");
    const double last = static_cast<double>(ms.size());
    const double apart = std::max(1.0, grid_step(last));
    for (double f = 0; f < last; f += apart)
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{:.0f}</text>\n",
                           kLeft + plot_width * (f + 0.5) / last, kHeight - 9, f);
    return svg + "</svg>\n";
}

std::string row(const std::string& name, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, escaped(value));
}

std::string numbers(const Report& r) {
    std::string table = "<table>\n";
    table += row("fragments",
                 fmt::format("{} born, {} live, {} of debris", r.fragments.born, r.fragments.live, r.fragments.debris));
    table += row("hits", fmt::format("{} looked at, {} broke something, {} late, {} dropped", r.tasks.opened,
                                     r.tasks.broke, r.tasks.late, r.tasks.dropped));
    table += row("a frame", fmt::format("{:.2f} ms in the middle, 99 of 100 below {:.2f}, worst {:.2f}", r.frame_ms.p50,
                                        r.frame_ms.p99, r.frame_ms.max));
    table += row("frames that broke something",
                 fmt::format("{}, worst {:.2f} ms", r.fracture_frames.count, r.fracture_frames.max_ms));
    table += row("worst", worst_frame_line(r).substr(6));
    table += row("mass", fmt::format("{:.6f} kg put in, {:.6f} kg at the end", r.mass_kg.start, r.mass_kg.end));
    table += row("at the end", fmt::format("{:.1f} % asleep", 100 * r.rest.asleep_share));
    if (!r.hash.empty()) table += row("hash", r.hash);
    return table + "</table>\n";
}

}  // namespace

std::string report_page(const Report& r, const RunOptions& options) {
    std::string page = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>{0}</title><style>{1}</style></head><body><main>\n"
        "<h1>{0}</h1>\n<p class=\"facts\">{2} frames of {3:.2f} ms on {4} threads, seed {5}. {6}</p>\n",
        escaped(r.scene), kStyle, r.frames, 1000 * r.dt_s, r.threads, r.seed, escaped(r.machine));
    if (options.has_sheet)
        page += "<h2>Twelve frames</h2>\n<figure><img src=\"sheet.png\" alt=\"twelve frames of the run\"></figure>\n";
    if (options.has_video) page += "<h2>Film</h2>\n<video src=\"film.mp4\" controls loop muted></video>\n";
    page += "<h2>Milliseconds of each frame</h2>\n<figure>" + plot(r) +
            "<figcaption>Orange: something broke. Budget: the time that a frame's damage work may take on these "
            "threads.</figcaption></figure>\n<h2>Numbers</h2>\n" +
            numbers(r);
    if (!r.notes.empty()) {
        page += "<h2>Notes</h2>\n<ul>\n";
        for (const std::string& note : counted_notes(r.notes)) page += fmt::format("<li>{}</li>\n", escaped(note));
        page += "</ul>\n";
    }
    return page +
           "<p class=\"facts\">All of it in numbers: <a "
           "href=\"report.json\">report.json</a></p>\n</main></body></html>\n";
}

}  // namespace cullet
