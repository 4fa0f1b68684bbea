#include "systems/models/thick_shell/cook/hit_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "systems/models/thick_shell/shared/cut_out.hpp"

namespace cullet {
namespace {

constexpr double kLongestInThicknesses = 2;
constexpr int kTries = 8;  // of longest edges; each splits the mesh
// Of the budget: halved edges are not alike, and the worst of them sets the time step. Units came out up to 1.15 times
// what the mean edge says.
constexpr double kShareAimedAt = 0.75;

std::string millions(double units) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g million", 1e-6 * units);
    return text;
}
std::string millimetres(double metres) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
    return text;
}

/// The longest edge with which the mesh has mean edges from `asked` to `longest`, m; 0 when there is none.
double longest_edge_for(const HitOfModel& hit, double asked, double longest, const MeanEdgeWhenSplitAt& split) {
    double length = hit.longest_edge * asked / hit.mean_edge;
    for (int n = 0; n < kTries; ++n) {
        const double mean = split(length);
        if (mean >= asked) return mean <= longest ? length : 0;
        length *= std::max(1.03, asked / mean);
    }
    return 0;
}

std::string edges_advice(const HitOfModel& hit, const MeanEdgeWhenSplitAt& split) {
    const double longest = kLongestInThicknesses * hit.thickness,
                 asked = edge_for_units(hit, static_cast<uint64_t>(kShareAimedAt * kDefaultHoldUnits));
    if (asked > longest) return {};
    if (hit.longest_edge > 0)
        if (const double length = longest_edge_for(hit, asked, longest, split); length > 0)
            return "; or cook it with a longest edge of " + millimetres(length) + " in place of " +
                   millimetres(hit.longest_edge);
    return "; or cook a mesh with edges of about " + millimetres(asked) + " in place of " + millimetres(hit.mean_edge);
}

}  // namespace

double edge_for_units(const HitOfModel& hit, uint64_t wanted) {
    const double share = static_cast<double>(hit.units) / static_cast<double>(wanted), vertices = hit.vertices;
    if (!hit.is_local) return hit.mean_edge * std::cbrt(share);
    if (vertices / (share * share) > kWholeHiddenVertices) return hit.mean_edge * share;
    const double whole = share * vertices / kWholeCopyVertices;
    return hit.mean_edge * std::max(std::cbrt(whole), std::sqrt(vertices / kWholeHiddenVertices));
}

std::string hit_advice(const HitOfModel& hit, const MeanEdgeWhenSplitAt& split) {
    if (hit.units <= kDefaultHoldUnits) return {};
    const auto units = static_cast<double>(hit.units);
    const double frames = kDefaultHoldUnits / 8e6, units_a_frame = 1e5 * std::ceil(1e-5 * units / frames);
    return "A hit needs about " + millions(1e6 * std::ceil(1e-6 * units)) + " units in the hidden run, more than the " +
           millions(kDefaultHoldUnits) +
           " that a hold has at the default budget, and will be late: spawn it to break quickly, which is cheapest; or "
           "raise units_a_frame to " +
           millions(units_a_frame) + edges_advice(hit, split) + ".";
}

}  // namespace cullet
