#include "perf/our_springs.hpp"

#include <cmath>

namespace cullet::perf {

SpringBench bench_of(const SpringNet& net, const std::function<bool(uint32_t)>& is_pinned) {
    std::vector<Vec3d> points;
    for (const Vec3 p : net.points) points.push_back(Vec3d(p));
    std::vector<GivenSpring> springs;
    for (const auto& [a, b] : net.springs)
        springs.push_back({a, b, length(net.points[b] - net.points[a]), net.stiffness});
    SpringSettings settings;
    settings.time_step = net.dt;
    // Of two points of one mass, m / 2 reduced.
    settings.damping_ratio = net.damping / (2 * std::sqrt(net.stiffness * net.mass / 2));
    return SpringBench(points, std::vector<double>(points.size(), double{net.mass}), springs, settings, is_pinned);
}

}  // namespace cullet::perf
