#include "systems/structures/shell/cook/front.hpp"

namespace cullet {

std::vector<double> run_front(ExtrusionWork& work) {
    MovingFaces faces(work);
    const uint32_t count = work.vertex_count();
    std::vector<double> depth(count), trial(count), step(count);
    for (uint32_t v = 0; v < count; ++v) step[v] = work.caps[v] / work.settings.rounds;
    std::vector<uint8_t> has_met(count);
    for (uint32_t round = 0; round < work.settings.rounds; ++round) {
        for (uint32_t v = 0; v < count; ++v) {
            trial[v] = std::min(depth[v] + step[v], work.caps[v]);
            faces.place(v, trial[v]);
        }
        for (uint32_t p = 0; p < faces.pair_count(); ++p) {
            if (!faces.is_touching(p)) continue;
            ++work.statistics.collisions;
            faces.for_each_inner(p, [&](uint32_t v) { has_met[v] = 1; });
        }
        for (uint32_t v = 0; v < count; ++v) {
            if (!has_met[v]) continue;
            has_met[v] = 0;
            trial[v] = depth[v];
            step[v] /= 2;
            faces.place(v, depth[v]);
        }
        depth.swap(trial);
        work.keep(depth);
        ++work.statistics.rounds;
    }
    work.statistics.crossings = faces.count_crossings();
    return depth;
}

}  // namespace cullet
