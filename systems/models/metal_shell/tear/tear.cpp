#include "systems/models/metal_shell/tear/tear.hpp"

#include <array>
#include <numbers>

#include "systems/models/metal_shell/tear/metal_repair.hpp"
#include "systems/models/metal_shell/tear/open_petals.hpp"
#include "systems/structures/shell/cut_shell.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {
namespace {

constexpr uint32_t kRingPoints = 13;                   // of what is punched out; the last is the first
constexpr double kUnevenRing = 0.06;                   // of its radius
constexpr double kBeyondRing = 0.95;                   // of it, where arms begin
constexpr double kFarthestOfPlug = 1.6;                // of its radius, beyond which it has not come off
constexpr double kOutsideRing = 1.5, kPastTip = 1.02;  // of the ring, and of the longest arm: nothing is cut beyond
constexpr float kMargin = 4;                           // mean edges
constexpr double kOtherSide = 0.5;                     // arms; what lies so far behind the dent's bottom is not torn

struct Tearing {
    const MetalView& metal;
    const Dent& dent;
    const TearStar& star;
    const PinBoxes& pin_boxes;
    Tear tear;

    Vec3 place(Across at) const { return (star.middle + at.x * star.x + at.y * star.y).to_float(); }
    CutWindow window(double inner, double outer) const {
        CutWindow window;
        window.middle = star.middle.to_float();
        window.inner = static_cast<float>(inner), window.outer = static_cast<float>(outer);
        window.low = static_cast<float>(-dent.deep - star.length);
        window.high = static_cast<float>(kOtherSide * star.length);
        window.margin = kMargin * metal.shells().mean_edge[metal.row];
        return window;
    }
    void cut(std::span<const Vec3> line, double inner, double outer) {
        const CutSurface surface(star.push.to_float(), line, window(inner, outer));
        const CutReport report = cut_shell(metal.shell, surface, pin_boxes, {}, MetalRepair(metal));
        tear.cut_edges += report.cut_edges;
        tear.is_full = tear.is_full || report.is_full;
        follow_copies(metal);
    }
};

void cut_ring(Tearing& tearing) {
    const TearStar& star = tearing.star;
    std::array<Vec3, kRingPoints> line;
    for (uint32_t k = 0; k + 1 < kRingPoints; ++k) {
        double sine = 0, cosine = 1;
        sine_cosine(2 * std::numbers::pi * k / (kRingPoints - 1), sine, cosine);
        const double r = star.plug * (1 + kUnevenRing * (2 * scatter(star.seed, 100 + k) - 1));
        line[k] = tearing.place({r * cosine, r * sine});
    }
    line.back() = line.front();
    tearing.cut(line, 0, kOutsideRing * star.plug);
}

// Two arms that lie opposite are one line, which every crack crosses in the middle.
void cut_arms(Tearing& tearing) {
    const TearStar& star = tearing.star;
    const uint32_t half = star.arms / 2;
    for (uint32_t k = 0; k < half; ++k) {
        const Vec3 line[] = {tearing.place(star.tip[k]), star.middle.to_float(), tearing.place(star.tip[k + half])};
        tearing.cut(line, kBeyondRing * star.plug, kPastTip * star.length);
    }
}

// Vertices of what came off round the middle; none, when that reaches farther than it should.
bool mark_punched(const MetalView& metal, uint32_t vertex, const TearStar& star) {
    const ShellView& shell = metal.shell;
    const Elements& elements = shell.state.elements;
    MetalVertices& own = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) own.is_queued[metal.vertex(v)] = 0;
    if (!(star.plug > 0)) return false;
    group_fragments(shell, {});
    const uint32_t part = elements.part[shell.element(shell.state.vertices.element[shell.vertex(vertex)])];
    bool is_small = true;
    for (uint32_t e = 0; e < metal.element_count() && is_small; ++e) {
        if (elements.part[shell.element(e)] != part) continue;
        for (const uint32_t v : metal.corners(e)) {
            const Across at = star.across(Vec3d(shell.state.vertices.rest[shell.vertex(v)]));
            is_small = is_small && dot(at, at) < kFarthestOfPlug * kFarthestOfPlug * star.plug * star.plug;
            own.is_queued[metal.vertex(v)] = kPunched;
        }
    }
    for (uint32_t v = 0; v < metal.vertex_count() && !is_small; ++v) own.is_queued[metal.vertex(v)] = 0;
    return is_small;
}

}  // namespace

Tear tear_sheet(const MetalView& metal, const Dent& dent, const PinBoxes& pin_boxes, bool may_pass) {
    TearStar star = plan_star(metal, dent, may_pass);
    Tearing tearing{metal, dent, star, pin_boxes, {}};
    if (star.arms == 0) return tearing.tear;
    const RowsBefore before = rows_of(metal);
    if (star.plug > 0) cut_ring(tearing);
    if (!mark_punched(metal, dent.vertex, star)) star.plug = 0;
    cut_arms(tearing);
    lay_springs_anew(metal, before);
    mark_punched(metal, dent.vertex, star);
    open_petals(metal, dent, star);
    tearing.tear.is_through = star.is_through && tearing.tear.cut_edges > 0;
    tearing.tear.work = star.work;
    return tearing.tear;
}

}  // namespace cullet
