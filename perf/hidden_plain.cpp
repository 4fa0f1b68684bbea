#include "perf/hidden_yardsticks.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"

namespace cullet::perf {

PlainHidden::PlainHidden(ShellView shell, float dt, float beta) : dt_(dt), beta_(beta) {
    const ShellRows& s = shell.state;
    const PlaneStress c = plane_stress(s, shell.structure);
    c11_ = static_cast<float>(c.c11), c12_ = static_cast<float>(c.c12), c33_ = static_cast<float>(c.c33);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const Float4 w = s.vertices.probe.data(0)[row];
        vertices_.push_back({s.vertices.displacement[row],
                             s.vertices.velocity[row],
                             {w.x, w.y, w.z},
                             {},
                             s.vertices.inverse_mass[row]});
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        const TriangleSprings& t = s.triangle_springs;
        const auto& corner = s.elements.corner[row];
        triangles_.push_back({{corner[0], corner[1], corner[2]},
                              t.axis_x[row],
                              t.axis_y[row],
                              t.inverse_edges[row],
                              t.area[row] * t.thickness[row] * t.scale[row]});
    }
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) {
        const uint32_t row = shell.hinge(h);
        const auto& v = s.hinges.vertex[row];
        const auto& g = s.hinges.gradient[row];
        hinges_.push_back({{v[0], v[1], v[2], v[3]},
                           {{g[0], g[1], g[2]}, {g[3], g[4], g[5]}, {g[6], g[7], g[8]}, {g[9], g[10], g[11]}},
                           s.hinges.stiffness[row] * s.hinges.scale[row]});
    }
}

void PlainHidden::step() {
    for (Vertex& v : vertices_) v.f = {};
    for (const Triangle& t : triangles_) {
        Vertex &a = vertices_[t.corner[0]], &b = vertices_[t.corner[1]], &c = vertices_[t.corner[2]];
        const Vec3 d1 = b.w - a.w, d2 = c.w - a.w, i = t.inverse_edges;
        const Vec3 dx = i.x * d1, dy = i.y * d1 + i.z * d2;
        const float xx = dot(t.x, dx), yy = dot(t.y, dy), xy = dot(t.x, dy) + dot(t.y, dx);
        const float sx = t.volume * (c11_ * xx + c12_ * yy), sy = t.volume * (c12_ * xx + c11_ * yy),
                    sxy = t.volume * c33_ * xy;
        const Vec3 along_x = sx * t.x + sxy * t.y, along_y = sxy * t.x + sy * t.y;
        const Vec3 fb = i.x * along_x + i.y * along_y, fc = i.z * along_y;
        b.f -= fb;
        c.f -= fc;
        a.f += fb + fc;
    }
    for (const Hinge& h : hinges_) {
        Vertex* v[4];
        for (int k = 0; k < 4; ++k) v[k] = &vertices_[h.vertex[k]];
        float theta = 0;
        for (int k = 1; k < 4; ++k) theta += dot(h.gradient[k], v[k]->w - v[0]->w);
        const float moment = h.stiffness * theta;
        for (int k = 0; k < 4; ++k) v[k]->f -= moment * h.gradient[k];
    }
    for (Vertex& v : vertices_) {
        v.v += (dt_ * v.inverse_mass) * v.f;
        v.u += dt_ * v.v;
        v.w = v.u + beta_ * v.v;
    }
}

}  // namespace cullet::perf
