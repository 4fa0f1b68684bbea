#include "systems/cook/hit_advice.hpp"

#include <cmath>
#include <cstdio>

namespace cullet {
namespace {

constexpr double kLongestInThicknesses = 2;

std::string millions(double units) {
    return std::to_string(static_cast<uint64_t>(units / 1e6 + 0.5)) + " million";
}
std::string millimetres(double metres) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
    return text;
}

}  // namespace

double edge_for_units(double mean_edge, uint64_t units, uint64_t wanted) {
    return mean_edge * std::cbrt(static_cast<double>(units) / static_cast<double>(wanted));
}

std::string hit_advice(uint64_t units, double mean_edge, double thickness, double longest_edge) {
    if (units <= kDefaultHoldUnits) return {};
    std::string text = "A hit needs about " + millions(static_cast<double>(units)) +
                       " units in the hidden run and will be late at the default budget of " +
                       millions(static_cast<double>(kDefaultHoldUnits)) +
                       " a hold (bodies that break quickly do not need it); ";
    const double wanted = edge_for_units(mean_edge, units, kDefaultHoldUnits),
                 longest = kLongestInThicknesses * thickness;
    const double asked = wanted < longest ? wanted : longest;
    const std::string setting = longest_edge > 0
                                    ? "longest_edge " + millimetres(longest_edge * asked / mean_edge) + " instead of " +
                                          millimetres(longest_edge) + ", or a coarser mesh"
                                    : "a coarser mesh";
    const std::string now =
        "edges of about " + millimetres(asked) + " instead of " + millimetres(mean_edge) + " (" + setting + ")";
    if (wanted <= longest)
        text += now + " would fit, or ";
    else if (const double share = mean_edge / longest; share < 0.9)
        text += now + ", twice the thickness, would need " +
                millions(static_cast<double>(units) * share * share * share) + "; then ";
    return text + "raise units_a_frame or hold_seconds.";
}

}  // namespace cullet
