#include <algorithm>

#include "perf/springs.hpp"

namespace cullet::perf {

PlainSprings::PlainSprings(const SpringNet& net, const std::vector<Vec3>& start)
    : stiffness_(net.stiffness), damping_(net.damping), dt_(net.dt), inverse_mass_(1 / net.mass) {
    for (const Vec3 x : start) vertices_.push_back({x, {}, {}, 0});
    for (const auto& [a, b] : net.springs)
        springs_.push_back({a, b, length(net.points[b] - net.points[a]), length(start[b] - start[a])});
}

void PlainSprings::step() {
    for (Vertex& v : vertices_) v.f = {}, v.strain = -1;
    for (Spring& s : springs_) {
        Vertex &a = vertices_[s.a], &b = vertices_[s.b];
        const Vec3 d = b.x - a.x;
        const float now = length(d);
        const float pull = stiffness_ * (now - s.rest) + damping_ * (now - s.length) / dt_;
        const Vec3 f = (pull / now) * d;
        a.f += f;
        b.f -= f;
        const float strain = (now - s.rest) / s.rest;
        a.strain = std::max(a.strain, strain);
        b.strain = std::max(b.strain, strain);
        s.length = now;
    }
    for (Vertex& v : vertices_) {
        v.v += (dt_ * inverse_mass_) * v.f;
        v.x += dt_ * v.v;
    }
}

}  // namespace cullet::perf
