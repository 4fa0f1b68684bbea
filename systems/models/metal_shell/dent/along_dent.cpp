#include "systems/models/metal_shell/dent/along_dent.hpp"

namespace cullet {
namespace {

constexpr double kDented = 2;      // thicknesses, that the sheet has moved at least
constexpr double kMostTurn = 0.5;  // cosine of 60 degrees: what comes more from aside goes its own way

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
    const auto& c = metal.corners(element);
    const Vec3d p(vertices.original[metal.vertex(c[0])]), q(vertices.original[metal.vertex(c[1])]),
        r(vertices.original[metal.vertex(c[2])]);
    const Vec3d across = cross(q - p, r - p);
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

}  // namespace cullet
