#include "tests/support/drawn_look.hpp"

#include <cmath>

#include "tests/support/closed_view.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// u is the way along the crack and v the depth below the outer face, both in m, as the positions have them.
std::string wrong_on_edge(const ViewVertex& a, const ViewVertex& b) {
    if (!(a.uv.x >= 0 && a.uv.y >= 0)) return "a crack's place is less than none";
    const float way = length(b.position - a.position);
    if (a.uv.y == 0 && b.uv.y == 0 && !(std::fabs(std::fabs(b.uv.x - a.uv.x) - way) <= 1e-5f * (1 + a.uv.x)))
        return "u runs on by " + std::to_string(b.uv.x - a.uv.x) + " along " + std::to_string(way) + " m of a crack";
    if (a.uv.x == b.uv.x && !(std::fabs(std::fabs(b.uv.y - a.uv.y) - way) <= 2e-6f))
        return "v runs on by " + std::to_string(b.uv.y - a.uv.y) + " over " + std::to_string(way) + " m of depth";
    return "";
}

/// Of the crack faces; counts those that there are.
std::string wrong_on_cracks(const BodyView& view, uint32_t& with_cracks) {
    for (uint32_t r = 0; r < view.run_count; ++r) {
        const auto& run = view.runs[r];
        if (run.kind != SurfaceKind::Crack) continue;
        ++with_cracks;
        for (uint32_t i = run.first_index; i < run.first_index + run.index_count; ++i) {
            const ViewVertex& a = view.vertices[view.indices[i]];
            const ViewVertex& b = view.vertices[view.indices[i % 3 == 2 ? i - 2 : i + 1]];
            if (const std::string wrong = wrong_on_edge(a, b); !wrong.empty()) return wrong;
        }
    }
    return "";
}

}  // namespace

std::string DrawnLook::at(const World& world) {
    for (const BodyId id : all_bodies(world)) {
        const Result<BodyView> view = world.view(id);
        if (!view.ok() || view->index_count == 0) continue;
        uint32_t& stamp = stamps_[{id.index, id.generation}];
        if (stamp == view->stamp + 1) continue;
        stamp = view->stamp + 1;
        ++looked_at_;
        std::string wrong = find_open_edge(*view);
        if (wrong.empty()) wrong = wrong_on_cracks(*view, with_cracks_);
        if (!wrong.empty()) return "body " + std::to_string(id.index) + ": " + wrong;
    }
    return "";
}

}  // namespace cullet::test
