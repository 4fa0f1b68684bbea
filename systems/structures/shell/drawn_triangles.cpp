#include "systems/structures/shell/drawn_triangles.hpp"

#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

uint32_t run_of(const DrawnMaterials& materials, SurfaceKind kind, uint16_t id) {
    uint32_t at = 0;
    while (at + 1 < materials.count && materials.id[at] < id) ++at;
    return static_cast<uint32_t>(kind) * kMostDrawnMaterials + at;
}

DrawnPoint point(const ShellView& shell, uint32_t vertex, bool is_inner) {
    return {vertex, is_inner && shell.state.vertices.depth[shell.vertex(vertex)] > 0};
}

/// Of the wall below edge k: rims are drawn with the inner surface.
SurfaceKind kind_of(const ShellView& shell, uint32_t element, uint32_t which) {
    if (which == kOuterFace) return SurfaceKind::Outer;
    if (which == kInnerFace) return SurfaceKind::Inner;
    const uint32_t edge = (which - kFirstWall) / 2;
    const auto kind = static_cast<EdgeKind>(shell.state.elements.edge_kind[shell.element(element)][edge]);
    return kind == EdgeKind::Crack ? SurfaceKind::Crack : SurfaceKind::Inner;
}

/// Where corner k is drawn on a smoothed crack, along the edges to the next two corners: the triangle's own normals and
/// uvs go on that far. 0, 0 where it stands.
Vec2 drawn_share(const ShellView& shell, uint32_t e, uint32_t k) {
    const auto corner = shell.state.elements.corner[shell.element(e)];
    const Vec3 shift = shell.state.vertices.crack_shift[shell.vertex(corner[k])];
    if (shift == Vec3{}) return {};
    const auto rest = [&](uint32_t i) { return shell.state.vertices.rest[shell.vertex(corner[i % 3])]; };
    const Vec3 a = rest(k + 1) - rest(k), b = rest(k + 2) - rest(k);
    const float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), whole = aa * bb - ab * ab;
    if (!(whole > 1e-6f * aa * bb)) return {};
    const float x = dot(shift, a), y = dot(shift, b);
    return {(bb * x - ab * y) / whole, (aa * y - ab * x) / whole};
}

struct Attributes {
    Vec3 normal;
    Vec2 uv;
};
/// The game's own, where the corner is drawn.
Attributes drawn_attributes(const ShellView& shell, uint32_t e, uint32_t k) {
    const auto& normal = shell.state.elements.normal[shell.element(e)];
    const auto& uv = shell.state.elements.uv[shell.element(e)];
    const auto n = [&](uint32_t i) {
        return Vec3{normal[3 * (i % 3)], normal[3 * (i % 3) + 1], normal[3 * (i % 3) + 2]};
    };
    const auto t = [&](uint32_t i) { return Vec2{uv[2 * (i % 3)], uv[2 * (i % 3) + 1]}; };
    const Vec2 share = drawn_share(shell, e, k);
    if (share.x == 0 && share.y == 0) return {n(k), t(k)};
    const Vec2 own = t(k), u = t(k + 1), v = t(k + 2);
    return {normalised(n(k) + share.x * (n(k + 1) - n(k)) + share.y * (n(k + 2) - n(k))),
            {own.x + share.x * (u.x - own.x) + share.y * (v.x - own.x),
             own.y + share.x * (u.y - own.y) + share.y * (v.y - own.y)}};
}

}  // namespace

Vec3 drawn_place(const ShellView& shell, DrawnPoint p) {
    const uint32_t row = shell.vertex(p.vertex);
    return p.is_inner ? smoothed_twin(shell.state, row).to_float() : smoothed_place(shell.state, row);
}

// The two triangles of a wall are seen from outside of the solid, and split its quad as the prisms do (A7).
std::array<DrawnPoint, 3> drawn_corners(const ShellView& shell, uint32_t element, uint32_t which) {
    const auto corner = shell.state.elements.corner[shell.element(element)];
    if (which == kOuterFace)
        return {point(shell, corner[0], false), point(shell, corner[1], false), point(shell, corner[2], false)};
    if (which == kInnerFace)
        return {point(shell, corner[0], true), point(shell, corner[2], true), point(shell, corner[1], true)};
    const uint32_t edge = (which - kFirstWall) / 2, half = (which - kFirstWall) % 2;
    const uint32_t a = corner[edge], b = corner[(edge + 1) % 3];
    const DrawnPoint ao = point(shell, a, false), bo = point(shell, b, false), ai = point(shell, a, true),
                     bi = point(shell, b, true);
    if (a < b) return half == 0 ? std::array{bo, ao, bi} : std::array{ao, ai, bi};
    return half == 0 ? std::array{bo, ao, ai} : std::array{bo, ai, bi};
}

bool is_drawn(const ShellView& shell, uint32_t element, uint32_t which) {
    const uint32_t row = shell.element(element);
    if (shell.state.elements.flags[row] & kDead) return false;
    if (which < kFirstWall) return true;
    if (shell.state.elements.neighbour[row][(which - kFirstWall) / 2] != kNone) return false;
    const auto p = drawn_corners(shell, element, which);
    return !(p[0] == p[1] || p[1] == p[2] || p[2] == p[0]);
}

uint32_t drawn_run(const ShellView& shell, const DrawnMaterials& materials, uint32_t element, uint32_t which) {
    return run_of(materials, kind_of(shell, element, which),
                  shell.state.elements.drawn_material[shell.element(element)]);
}

void write_faces(const ShellView& shell, uint32_t e, ViewVertex* outer, ViewVertex* inner) {
    const Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(e);
    const auto corner = elements.corner[row];
    Vec3 below[3];
    for (int k = 0; k < 3; ++k) below[k] = drawn_place(shell, point(shell, corner[k], true));
    const Vec3 flat = normalised(cross(below[2] - below[0], below[1] - below[0]));
    for (int k = 0; k < 3; ++k) {
        const auto [n, uv] = drawn_attributes(shell, e, static_cast<uint32_t>(k));
        outer[k] = {smoothed_place(shell.state, shell.vertex(corner[k])), n, uv};
        const bool runs_along = dot(-n, flat) > 0.8f || dot(flat, flat) < 0.5f;  // no area, no normal
        inner[(3 - k) % 3] = {below[k], runs_along ? -n : flat, uv};
    }
}

void write_wall(const ShellView& shell, uint32_t e, uint32_t which, float along, ViewVertex* out) {
    const uint32_t k = (which - kFirstWall) / 2, a = shell.state.elements.corner[shell.element(e)][k];
    const float edge = drawn_length(shell, e, k);
    const auto corners = drawn_corners(shell, e, which);
    Vec3 p[3];
    for (int i = 0; i < 3; ++i) p[i] = drawn_place(shell, corners[i]);
    const Vec3 normal = normalised(cross(p[1] - p[0], p[2] - p[0]));
    for (int i = 0; i < 3; ++i) {
        const float u = along + (corners[i].vertex == a ? 0.0f : edge);
        const float v = corners[i].is_inner ? shell.state.vertices.depth[shell.vertex(corners[i].vertex)] : 0.0f;
        out[i] = {p[i], normal, {u, v}};
    }
}

float drawn_length(const ShellView& shell, uint32_t e, uint32_t k) {
    const auto corner = shell.state.elements.corner[shell.element(e)];
    return length(drawn_place(shell, {corner[(k + 1) % 3], false}) - drawn_place(shell, {corner[k], false}));
}

void step_along_border(const ShellView& shell, uint32_t& e, uint32_t& k) {
    const Elements& elements = shell.state.elements;
    k = (k + 1) % 3;
    while (elements.neighbour[shell.element(e)][k] != kNone) {
        const uint32_t from = elements.corner[shell.element(e)][k];
        e = elements.neighbour[shell.element(e)][k];
        const auto corner = elements.corner[shell.element(e)];
        k = corner[0] == from ? 0 : corner[1] == from ? 1 : 2;
    }
}

}  // namespace cullet
