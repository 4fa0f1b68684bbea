#include "systems/models/metal_shell/dent/raise_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "systems/models/metal_shell/dent/dent.hpp"
#include "systems/models/metal_shell/dent/ways.hpp"

namespace cullet {
namespace {

constexpr int kMostGuesses = 60;
constexpr double kGoodGuess = 1e-8;      // of the energy
constexpr double kDeepest = 0.3;         // of the extent along the push
constexpr double kDragged = 0.5;         // of the depth
constexpr double kOverPerimeter = 0.25;  // of its width: a round section over its perimeter
constexpr double kFacing = 0.05;         // cosine: what looks away from the striker is not crushed
constexpr int kSweeps = 40;              // of cells, and of vertices
constexpr double kRelaxation = 1.6;
// How much the field alone may stretch and shorten edges; folds, creases and what clears the striker do more. Of a
// metal that stretches little, as aluminium does, they take the greater part.
constexpr double kStretchOfField = 1.6, kLeastStretch = 0.02, kMostStretch = 0.1;  // of the break strain squared
constexpr double kShorteningOfField = 1.6, kLeastShortening = 0.15, kMostShortening = 0.38;  // of the break strain
constexpr float kTieFall = 0.5f;  // of the field, of the gap between two sheets

// m, between the body's longest and shortest side: of what its crush pressure is that of.
double width_of(const MetalView& metal) {
    Vec3d low(1e30, 1e30, 1e30), high(-1e30, -1e30, -1e30);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3d p(metal.vertices().original[metal.vertex(v)]);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3d size = high - low;
    return std::min({std::max(size.x, size.y), std::max(size.y, size.z), std::max(size.x, size.z)});
}

// m2 of a wall that the striker takes by its open edges: how long each is, times how deep he goes in, as far as the
// wall lies along his way.
double taken_edges(const MetalView& metal, const Striker& striker, double depth, uint32_t element) {
    const auto& beside = metal.shell.state.elements.neighbour[metal.shell.element(element)];
    if (beside[0] != kNone && beside[1] != kNone && beside[2] != kNone) return 0;
    const auto& c = metal.corners(element);
    const std::array<Vec3d, 3> p{Vec3d(metal.vertices().start[metal.vertex(c[0])]),
                                 Vec3d(metal.vertices().start[metal.vertex(c[1])]),
                                 Vec3d(metal.vertices().start[metal.vertex(c[2])])};
    const Vec3d across = cross(p[1] - p[0], p[2] - p[0]);
    if (!(dot(across, across) > 0)) return 0;
    const Vec3d normal = normalised(across);
    double area = 0;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d &a = p[k], &b = p[(k + 1) % 3];
        const double met = dot(cross(normal, b - a), striker.push);
        if (beside[k] != kNone || !(met > 0)) continue;
        const double in =
            striker.covers(a, depth) + 4 * striker.covers(0.5 * (a + b), depth) + striker.covers(b, depth);
        area += met * in / 6;
    }
    return area;
}

// m3 that the striker takes of what faces it, or what resists him as much: a tube that is hit on its open end has
// nothing that faces him, and yet the load of the section that it encloses. Over its perimeter that is a quarter of its
// width, which holds for edges of any wall. Of a body that has both the larger one counts; a closed one has no edges.
double crushed_volume(const MetalView& metal, const Striker& striker, double depth, double width) {
    const Striker wider = striker.widened(kDragged * depth);
    const MetalVertices& v = metal.vertices();
    double edges = 0;
    const bool comes_first_at_its_point = striker.shape != StrikerShape::Front;
    double volume = 0;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e)) continue;
        edges += taken_edges(metal, wider, depth, e);
        const auto& c = metal.corners(e);
        const Vec3d p(v.start[metal.vertex(c[0])]), q(v.start[metal.vertex(c[1])]), r(v.start[metal.vertex(c[2])]);
        const Vec3d centroid = (1.0 / 3) * (p + q + r);
        if (comes_first_at_its_point && dot(centroid - striker.point, striker.push) >= depth) continue;
        const Vec3d across = cross(q - p, r - p);
        const double facing = -0.5 * dot(across, striker.push);
        if (!(facing > 0) || !(facing * facing > 0.25 * kFacing * kFacing * dot(across, across))) continue;
        volume += facing * wider.covers(centroid, depth);
    }
    return std::max(volume, kOverPerimeter * width * edges);
}

/// Where `missing` (J), which rises from -energy at 0 to `above` at `deepest`, is none: along chords, each of which
/// halves what an end says that stays for a second time. A volume over all elements is dear; bisection takes thirty.
template <class Missing>
double depth_of(double deepest, double above, double energy, Missing missing) {
    double low = 0, high = deepest, below = energy;
    int last = 0;
    for (int k = 0; k < kMostGuesses; ++k) {
        const double d = low + (high - low) * (below / (below + above)), more = missing(d);
        if (std::fabs(more) <= kGoodGuess * energy || !(d > low && d < high)) return d;
        if (more < 0) {
            low = d, below = -more;
            if (last < 0) above *= 0.5;
            last = -1;
        } else {
            high = d, above = more;
            if (last > 0) below *= 0.5;
            last = 1;
        }
    }
    return low;
}

// Cells first: on them a field comes as far as it must in a few sweeps. What a cell has to give is the mean of what its
// vertices have to.
void relax_cells(const MetalView& metal) {
    SubShells& cells = metal.cells();
    const MetalVertices& vertices = metal.vertices();
    const uint32_t count = metal.cell_count();
    for (uint32_t c = 0; c < count; ++c) {
        cells.field[metal.cell(c)] = 0, cells.weights[metal.cell(c)] = 0;
        cells.is_touched[metal.cell(c)] = 0;
    }
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v), c = metal.cell(vertices.cell[row][0]);
        cells.field[c] += vertices.field[row], cells.weights[c] += 1;
        if (vertices.way[row] < kNoWay) cells.is_touched[c] = 1;
    }
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = metal.cell(c);
        if (cells.weights[row] > 0) cells.field[row] /= cells.weights[row];
        cells.least_field[row] = cells.field[row];
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (uint32_t c = 0; c < count; ++c) {
            const uint32_t row = metal.cell(c);
            if (!cells.is_touched[row]) continue;
            double sum = 0, weight = 0;
            metal.for_each_border(c, [&](uint32_t other, float length) {
                sum += double{length} * cells.field[metal.cell(other)], weight += double{length};
            });
            if (!(weight > 0)) continue;
            const double now = double{cells.field[row]};
            cells.field[row] =
                static_cast<float>(std::max(double{cells.least_field[row]}, now + kRelaxation * (sum / weight - now)));
        }
}

float blended(const MetalView& metal, uint32_t vertex_row) {
    const MetalVertices& vertices = metal.vertices();
    float sum = 0;
    for (uint32_t k = 0; k < kBlended; ++k)
        sum += vertices.weight[vertex_row][k] * metal.cells().field[metal.cell(vertices.cell[vertex_row][k])];
    return sum;
}

// By how much less the other end of an edge may go along the push than this one, so that the edge is neither longer nor
// shorter than it may be. One that is too long already goes as far as makes it shortest.
float fall_along(Vec3 edge, Vec3 push, float longest, float shortest) {
    const float along = dot(edge, push), square = along * along - dot(edge, edge);
    const float most = std::max(0.0f, along + std::sqrt(std::max(0.0f, square + longest * longest)));
    const float within = square + shortest * shortest;  // above 0: on its way it becomes too short
    return along > 0 && within > 0 ? std::min(most, std::max(0.0f, along - std::sqrt(within))) : most;
}

// What is beside a striker that went in deeper than it is wide would stand at its side as a wall, longer than the sheet
// stretches; what trails it would stay behind. It is dragged along, so far that no edge asks for more.
void drag_along(const MetalView& metal, Vec3 push, float most_stretch, float most_shortening) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    float top = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) top = std::max(top, vertices.field[metal.vertex(v)]);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        vertices.way[row] = vertices.field[row] > 0 ? top - vertices.field[row] : kNoWay;
    }
    spread_ways(metal, top, [&](uint32_t v, uint32_t other, uint32_t spring) {
        if (springs.is_tie[spring]) return kTieFall * springs.length[spring];
        const Vec3 edge = vertices.start[metal.vertex(other)] - vertices.start[metal.vertex(v)];
        // What an earlier impact shortened is shortened on, as it folds on.
        const float whole = springs.length[spring], least = std::min(whole, length(edge));
        return fall_along(edge, push, (1 + most_stretch) * whole, (1 - most_shortening) * least);
    });
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!metal.is_pinned(v)) vertices.field[row] = std::max(vertices.field[row], top - vertices.way[row]);
    }
}

}  // namespace

CrushPlan plan_crush(const MetalView& metal, const Striker& striker, double energy) {
    double low_end = 1e30, high_end = -1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const double along = dot(Vec3d(metal.vertices().start[metal.vertex(v)]), striker.push);
        low_end = std::min(low_end, along), high_end = std::max(high_end, along);
    }
    const double pressure = double{metal.shells().crush_pressure[metal.row]};
    const double deepest = kDeepest * std::max(0.0, high_end - low_end);
    CrushPlan plan;
    if (!(pressure > 0) || !(energy > 0)) return plan;
    const double width = width_of(metal);
    const double most = pressure * crushed_volume(metal, striker, deepest, width);
    if (most <= energy) return {deepest, energy - most};
    plan.depth = depth_of(deepest, most - energy, energy,
                          [&](double d) { return pressure * crushed_volume(metal, striker, d, width) - energy; });
    return plan;
}

// The obstacle is what the striker covers. Least Laplace energy above it, by projected over-relaxation in the order of
// the vertices.
void raise_body(const MetalView& metal, const Striker& striker, double depth, double wanted_reach) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
    const uint32_t count = metal.vertex_count();
    const auto reach = static_cast<float>(wanted_reach);
    for (uint32_t v = 0; v < count; ++v) {
        const uint32_t row = metal.vertex(v);
        const auto covered = static_cast<float>(striker.covers(Vec3d(vertices.start[row]), depth));
        vertices.field[row] = metal.is_pinned(v) ? 0 : covered;
        vertices.way[row] = vertices.field[row] > 0 ? 0 : kNoWay;
    }
    spread_ways(metal, reach);
    relax_cells(metal);
    const auto least = [&](uint32_t row) {  // what is on its way to the striker is not in it
        return vertices.way[row] > 0 ? 0 : static_cast<float>(striker.covers(Vec3d(vertices.start[row]), depth));
    };
    for (uint32_t v = 0; v < count; ++v) {
        const uint32_t row = metal.vertex(v);
        if (!(vertices.way[row] <= reach) || metal.is_pinned(v)) continue;
        const float begun = blended(metal, row) * (1 - vertices.way[row] / reach);
        vertices.field[row] = std::max(vertices.field[row], std::max(0.0f, begun));
    }
    // The ring that ways were spread with is free again.
    uint32_t within = 0;
    for (uint32_t v = 0; v < count; ++v)
        if (vertices.way[metal.vertex(v)] <= reach && !metal.is_pinned(v)) vertices.queued[metal.vertex(within++)] = v;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (uint32_t k = 0; k < within; ++k) {
            const uint32_t v = vertices.queued[metal.vertex(k)], row = metal.vertex(v);
            double sum = 0, weight = 0;
            metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
                sum += double{springs.stiffness[spring]} * vertices.field[metal.vertex(other)];
                weight += double{springs.stiffness[spring]};
            });
            if (!(weight > 0)) continue;
            const double now = double{vertices.field[row]};
            vertices.field[row] = std::max(least(row), static_cast<float>(now + kRelaxation * (sum / weight - now)));
        }
    // A ball that comes along a wall would drag it out of the body.
    const double breaks = striker.shape == StrikerShape::Sphere ? 1 : sheet_metal(metal).break_strain;
    drag_along(metal, striker.push.to_float(),
               static_cast<float>(std::clamp(kStretchOfField * breaks * breaks, kLeastStretch, kMostStretch)),
               static_cast<float>(std::clamp(kShorteningOfField * breaks, kLeastShortening, kMostShortening)));
}

}  // namespace cullet
