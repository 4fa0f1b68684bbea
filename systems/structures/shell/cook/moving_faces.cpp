#include "systems/structures/shell/cook/moving_faces.hpp"

namespace cullet {

MovingFaces::MovingFaces(ExtrusionWork& work)
    : work_(work),
      faces_(work.surface),
      pairs_(list_pairs(work, faces_)),
      count_(work.vertex_count()),
      place_(work.points),
      id_(work.surface.position_ids) {
    work.statistics.pairs = pair_count();
    place_.insert(place_.end(), work.points.begin(), work.points.end());
    id_.insert(id_.end(), work.surface.position_ids.begin(), work.surface.position_ids.end());

    // A vertex of both faces has the pair once: tested twice, single vertex took half as long again.
    std::vector<uint32_t>& start = pairs_of_.start;
    start.assign(count_ + 1, 0);
    std::vector<uint32_t> last(count_, kNone);
    const auto for_each_entry = [&](auto visit) {
        std::fill(last.begin(), last.end(), kNone);
        for (uint32_t p = 0; p < pair_count(); ++p)
            for_each_inner(p, [&](uint32_t v) {
                if (last[v] != p) visit(v, p);
                last[v] = p;
            });
    };
    for_each_entry([&](uint32_t v, uint32_t) { ++start[v + 1]; });
    for (uint32_t v = 0; v < count_; ++v) start[v + 1] += start[v];
    pairs_of_.row.resize(start[count_]);
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for_each_entry([&](uint32_t v, uint32_t p) { pairs_of_.row[next[v]++] = p; });
}

uint32_t MovingFaces::count_crossings() {
    uint32_t crossings = 0;
    for (uint32_t p = 0; p < pair_count(); ++p) {
        const Corner3 a = corners(pairs_[p].a), b = corners(pairs_[p].b);
        int shared = 0;
        for (const uint32_t i : a.id)
            for (const uint32_t j : b.id) shared += i == j;
        crossings += shared < 2 && is_touching(p);
    }
    return crossings;
}

}  // namespace cullet
