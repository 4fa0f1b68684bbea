#include "systems/models/metal_shell/dent/along_dent.hpp"

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr double kDented = 2;      // thicknesses, that the sheet has moved at least
constexpr double kMostTurn = 0.5;  // cosine of 60 degrees: what comes more from aside goes its own way

Vec3d original_across(const MetalView& metal, uint32_t element) {
    const MetalVertices& v = metal.vertices();
    const auto& c = metal.corners(element);
    const Vec3d p(v.original[metal.vertex(c[0])]), q(v.original[metal.vertex(c[1])]), r(v.original[metal.vertex(c[2])]);
    return cross(q - p, r - p);
}

}  // namespace

Striker along_dent(const MetalView& metal, const Striker& ball) {
    const MetalVertices& vertices = metal.vertices();
    double nearest = 1e30;
    uint32_t touched = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3d from = Vec3d(vertices.start[metal.vertex(v)]) - ball.point;
        if (const double square = dot(from, from);
            square < nearest && metal.shell.state.vertices.element[metal.shell.vertex(v)] != kNone)
            nearest = square, touched = v;
    }
    const uint32_t row = metal.vertex(touched),
                   element = metal.shell.state.vertices.element[metal.shell.vertex(touched)];
    if (element == kNone) return ball;
    const Vec3d across = original_across(metal, element);
    if (!(length(across) > 0)) return ball;
    Vec3d way = (1 / length(across)) * across;
    if (dot(way, ball.push) < 0) way = -way;
    const double depth = dot(Vec3d(vertices.start[row]) - Vec3d(vertices.original[row]), way);
    const double thickness = double{metal.shell.shells().thickness[metal.shell.row]};
    if (!(depth > kDented * thickness) || dot(way, ball.push) < kMostTurn) return ball;
    Striker turned = ball;
    turned.point = ball.point + ball.radius * (way - ball.push);
    turned.push = way;
    return turned;
}

Vec3d into_sheet(const MetalView& metal, Vec3d point, Vec3d push) {
    const Vertices& vertices = metal.shell.state.vertices;
    double nearest = 1e30;
    uint32_t touched = kNone;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.shell.vertex(v);
        const Vec3d from = Vec3d(vertices.rest[row]) - point;
        if (const double square = dot(from, from); square < nearest && vertices.element[row] != kNone)
            nearest = square, touched = v;
    }
    if (touched == kNone) return push;
    Ring ring;
    collect_ring(metal.shell, touched, ring);
    // A side counts as much as it is in the way.
    Vec3d sum;
    for (uint32_t k = 0; k < ring.count; ++k) {
        const Vec3d across = original_across(metal, ring.element[k]);
        sum += dot(across, push) * across;
    }
    return dot(sum, push) > 0 ? normalised(sum) : push;
}

}  // namespace cullet
