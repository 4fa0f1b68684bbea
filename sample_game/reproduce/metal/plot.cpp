#include "sample_game/reproduce/metal/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cullet::reproduce {
namespace {

constexpr double kWidth = 760, kHeight = 380, kLeft = 74, kRight = 18, kTop = 16, kBottom = 52;
constexpr const char* kColours[] = {"#2f6fab", "#b3541e", "#2f7d4f", "#7a4a9e", "#8a6d1f", "#555555"};

struct Axis {
    double low = 1e300, high = -1e300;
    void include(double v) { low = std::min(low, v), high = std::max(high, v); }
    void widen() {
        if (!(high > low)) low -= 0.5, high += 0.5;
        const double more = 0.04 * (high - low);
        low -= low == 0 ? 0 : more, high += more;
    }
    double share(double v) const { return (v - low) / (high - low); }
};

// 1, 2 or 5 times a power of ten, for about six marks.
double step_of(const Axis& axis) {
    const double wanted = (axis.high - axis.low) / 6;
    double power = 1;
    while (10 * power <= wanted) power *= 10;
    while (power > wanted) power /= 10;
    for (const double times : {1.0, 2.0, 5.0})
        if (times * power >= wanted) return times * power;
    return 10 * power;
}

}  // namespace

std::string to_svg(const Plot& plot) {
    Axis x, y;
    for (const PlotLine& line : plot.lines) {
        for (const double v : line.x) x.include(v);
        for (const double v : line.y) y.include(v);
    }
    x.widen(), y.widen();
    const auto at_x = [&](double v) { return kLeft + x.share(v) * (kWidth - kLeft - kRight); };
    const auto at_y = [&](double v) { return kHeight - kBottom - y.share(v) * (kHeight - kTop - kBottom); };
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"system-ui, sans-serif\" "
        "font-size=\"13\"><rect width=\"100%\" height=\"100%\" fill=\"#fdfcfa\"/>\n",
        kWidth, kHeight);
    for (double v = std::ceil(x.low / step_of(x)) * step_of(x); v <= x.high; v += step_of(x))
        svg += fmt::format(
            "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#e2ddd4\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
            "text-anchor=\"middle\" fill=\"#555\">{4:.4g}</text>\n",
            at_x(v), kTop, kHeight - kBottom, kHeight - kBottom + 18, v + 0.0);
    for (double v = std::ceil(y.low / step_of(y)) * step_of(y); v <= y.high; v += step_of(y))
        svg += fmt::format(
            "<path d=\"M{1:.1f} {0:.1f}H{2:.1f}\" stroke=\"#e2ddd4\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
            "text-anchor=\"end\" fill=\"#555\">{5:.4g}</text>\n",
            at_y(v), kLeft, kWidth - kRight, kLeft - 7, at_y(v) + 4, v + 0.0);
    for (size_t k = 0; k < plot.lines.size(); ++k) {
        const PlotLine& line = plot.lines[k];
        const char* colour = kColours[k % std::size(kColours)];
        std::string points;
        for (size_t i = 0; i < line.x.size(); ++i)
            points += fmt::format("{:.1f},{:.1f} ", at_x(line.x[i]), at_y(line.y[i]));
        svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", points,
                           colour, line.is_dashed ? " stroke-dasharray=\"6 5\"" : "");
        const double at = kTop + 16 + 18 * static_cast<double>(k);
        svg += fmt::format(
            "<path d=\"M{0:.0f} {1:.0f}h26\" stroke=\"{2}\" stroke-width=\"2\"{4}/><text x=\"{5:.0f}\" "
            "y=\"{6:.0f}\" fill=\"#222\">{3}</text>\n",
            kLeft + 14, at, colour, line.name, line.is_dashed ? " stroke-dasharray=\"6 5\"" : "", kLeft + 46, at + 4);
    }
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\" fill=\"#222\">{}</text>\n",
                       0.5 * (kLeft + kWidth - kRight), kHeight - 12, plot.x_name);
    svg += fmt::format(
        "<text transform=\"translate(16 {:.0f}) rotate(-90)\" text-anchor=\"middle\" "
        "fill=\"#222\">{}</text>\n</svg>\n",
        0.5 * (kTop + kHeight - kBottom), plot.y_name);
    return svg;
}

}  // namespace cullet::reproduce
