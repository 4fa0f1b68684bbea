#include "sample_game/unmoved.hpp"

namespace cullet {
namespace {

/// Calls visit(n, vertex) for the n-th corner of this kind.
template <class Visit>
void each_corner(const BodyView& view, SurfaceKind kind, const Visit& visit) {
    size_t n = 0;
    for (uint32_t r = 0; r < view.run_count; ++r) {
        const MaterialRun& run = view.runs[r];
        if (run.kind != kind) continue;
        for (uint32_t i = run.first_index; i < run.first_index + run.index_count; ++i) visit(n++, view.indices[i]);
    }
}

}  // namespace

Unmoved::Corners Unmoved::corners_of(const BodyView& view, SurfaceKind kind) {
    Corners corners;
    each_corner(view, kind, [&](size_t, uint32_t v) { corners.push_back(view.vertices[v].position); });
    return corners;
}

void Unmoved::remember(const GameWorld& game) {
    const World& world = game.world();
    const std::vector<Look>& looks = game.stage().looks;
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    for (const BodyId id : ids) {
        const uint64_t look = world.user_data(id).value_or(0);
        const Finish finish = looks[look < looks.size() ? look : 0].finish;
        if (finish != Finish::Cloth && finish != Finish::Rubber) continue;
        const auto [place, is_new] = seen_.try_emplace({id.index, id.generation});
        if (!is_new) continue;
        const Result<BodyView> view = world.view(id);
        if (view.ok()) place->second = {corners_of(*view, SurfaceKind::Outer), corners_of(*view, SurfaceKind::Inner)};
    }
}

std::vector<Vec3> Unmoved::of(BodyId body, const BodyView& view) const {
    std::vector<Vec3> places;
    const auto found = seen_.find({body.index, body.generation});
    if (found == seen_.end()) return places;
    for (uint32_t v = 0; v < view.vertex_count; ++v) places.push_back(view.vertices[v].position);
    const auto put = [&](SurfaceKind kind, const Corners& corners) {
        size_t count = 0;
        each_corner(view, kind, [&](size_t, uint32_t) { ++count; });
        if (count != corners.size()) return;
        each_corner(view, kind, [&](size_t n, uint32_t v) { places[v] = corners[n]; });
    };
    put(SurfaceKind::Outer, found->second.first);
    put(SurfaceKind::Inner, found->second.second);
    return places;
}

}  // namespace cullet
