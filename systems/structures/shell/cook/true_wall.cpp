#include "systems/structures/shell/cook/true_wall.hpp"

#include <algorithm>

#include "systems/structures/shell/cook/extrusion_work.hpp"
#include "systems/structures/shell/cook/opposite_wall.hpp"

namespace cullet {

TrueWall measure_true_wall(const Surface& surface, const Extrusion& extrusion, double thickness) {
    ExtrusionWork work(surface, thickness, {});
    const OppositeWall wall(work);
    struct Sample {
        double wall, area;
        uint32_t vertex;
    };
    std::vector<Sample> samples;
    double area_sum = 0, sum = 0;
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        double area = 0;
        for (const uint32_t t : work.ring[v]) area += work.areas[t];
        const double depth = work.frame.scale * extrusion.depth[v];
        const double share = wall.distance(work.points[v] + depth * extrusion.direction[v], depth) / work.thickness;
        samples.push_back({share, area, v});
        area_sum += area, sum += area * share;
    }
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
        return a.wall != b.wall ? a.wall < b.wall : a.vertex < b.vertex;
    });
    TrueWall result{sum / area_sum, samples.back().wall, samples.front().wall};
    double below = 0;
    for (const Sample& s : samples)
        if ((below += s.area) >= 0.05 * area_sum) {
            result.low = s.wall;
            break;
        }
    return result;
}

}  // namespace cullet
