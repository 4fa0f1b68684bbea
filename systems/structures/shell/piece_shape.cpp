#include "systems/structures/shell/piece_shape.hpp"

#include <algorithm>

#include "systems/hulls/fit_box.hpp"
#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostVertices = kMostExtremeCandidates / 2;
constexpr float kGoodEnough = 0.2f;  // of the margin, as for cells
constexpr float kTooMuch = 0.3f;     // of the margin: a hull that leaves out more is none
constexpr double kWidthShare = 0.2;
constexpr float kMostMargin = 0.001f;  // m
constexpr float kOnEdges = 0.85f;      // of the margin, see pull_of()
constexpr uint32_t kBoxCorners = 8;

/// The points that are drawn, outer and inner, vertex by vertex.
struct Solid {
    Vec3 point[2 * kMostVertices];
    uint32_t vertex[kMostVertices];
    uint32_t count = 0;  // vertices

    std::span<const Vec3> points() const { return {point, 2 * count}; }
};

template <class Visit>
void for_each_element(const ShellView& shell, const FragmentPart* part, Visit visit) {
    if (part)
        for (uint32_t e = part->first_element; e != kNone; e = shell.state.elements.next[shell.element(e)]) visit(e);
    else
        for (uint32_t e = 0; e < shell.element_count(); ++e) visit(e);
}

/// False: there are too many. Each vertex names one of its elements.
bool gather(const ShellView& shell, const FragmentPart* part, Solid& solid) {
    const ShellRows& state = shell.state;
    bool has_room = true;
    for_each_element(shell, part, [&](uint32_t e) {
        for (const uint32_t v : state.elements.corner[shell.element(e)]) {
            const uint32_t row = shell.vertex(v);
            if (!has_room || state.vertices.element[row] != e) continue;
            has_room = solid.count < kMostVertices;
            if (!has_room) continue;
            const Vec3 p = smoothed_place(state, row);
            solid.point[2 * solid.count] = p;
            solid.point[2 * solid.count + 1] = p + state.vertices.depth[row] * state.vertices.inward[row];
            solid.vertex[solid.count++] = v;
        }
    });
    return has_room && solid.count > 0;
}

/// For each chosen point the sum of the ways in from the free edges that it is an end of.
void find_ways_in(const ShellView& shell, const FragmentPart* part, const Solid& solid, const ExtremePoints& chosen,
                  Vec3 (&way_in)[kMostHullPoints]) {
    const Elements& elements = shell.state.elements;
    uint32_t vertex[kMostHullPoints];
    for (uint32_t k = 0; k < kMostHullPoints; ++k) vertex[k] = k < chosen.count ? solid.vertex[chosen.index[k] / 2] : 0;
    for_each_element(shell, part, [&](uint32_t e) {
        const auto& corner = elements.corner[shell.element(e)];
        for (int k = 0; k < 3; ++k) {
            if (elements.neighbour[shell.element(e)][k] != kNone) continue;
            const uint32_t a = corner[k], b = corner[(k + 1) % 3];
            bool is_chosen = false;
            for (uint32_t i = 0; i < kMostHullPoints; ++i) is_chosen |= vertex[i] == a || vertex[i] == b;
            if (!is_chosen) continue;
            Vec3 p[3];
            for (int j = 0; j < 3; ++j) p[j] = shell.state.vertices.rest[shell.vertex(corner[j])];
            const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
            const Vec3 in = normalised(cross(normal, p[(k + 1) % 3] - p[k]));
            for (uint32_t i = 0; i < chosen.count; ++i)
                if (vertex[i] == a || vertex[i] == b) way_in[i] += in;
        }
    });
}

void write_hull(const ShellView& shell, const FragmentPart* part, const Solid& solid, const ExtremePoints& chosen,
                float margin, uint32_t first_point) {
    const Vertices& vertices = shell.state.vertices;
    Vec3 way_in[kMostHullPoints];
    find_ways_in(shell, part, solid, chosen, way_in);
    for (uint32_t k = 0; k < chosen.count; ++k) {
        const uint32_t row = shell.vertex(solid.vertex[chosen.index[k] / 2]);
        const float pull = pull_of(margin, vertices.depth[row], way_in[k]);
        const bool is_inner = chosen.index[k] % 2 != 0;
        const Vec3 moved = margin * normalised(way_in[k]) + (is_inner ? -pull : pull) * vertices.inward[row];
        shell.state.hull_points.point.set(first_point + k, solid.point[chosen.index[k]] + moved);
    }
}

void write_box(const ShellView& shell, const FittedBox& box, float margin, uint32_t first_point) {
    const double m = margin;
    for (uint32_t k = 0; k < kBoxCorners; ++k) {
        const Vec3d x = (k & 1 ? 1 : -1) * (box.half.x - m) * box.axis[0],
                    y = (k & 2 ? 1 : -1) * (box.half.y - m) * box.axis[1],
                    z = (k & 4 ? 1 : -1) * (box.half.z - m) * box.axis[2];
        shell.state.hull_points.point.set(first_point + k, (box.centre + x + y + z).to_float());
    }
}

}  // namespace

float pull_of(float margin, float depth, Vec3 way_in) {
    const bool is_on_edge = dot(way_in, way_in) > 0;
    return std::min(is_on_edge ? kOnEdges * margin : margin, 0.5f * depth);
}

float margin_for(double least_width) {
    return std::min(static_cast<float>(kWidthShare * least_width), kMostMargin);
}

void clear_shape(ShellView shell) {
    Structures& structures = shell.structures();
    structures.shape[shell.structure] = static_cast<uint8_t>(ShapeKind::Cells);
    structures.shape_points[shell.structure] = 0;
    structures.box_ratio[shell.structure] = structures.hull_ratio[shell.structure] = 0;
}

void choose_shape(ShellView shell, uint32_t first_point, const FragmentPart* part) {
    Structures& structures = shell.structures();
    clear_shape(shell);
    const uint32_t elements = part ? part->element_count : shell.element_count();
    const Scratch<Solid> gathered(shell.state.scratch);
    Solid& solid = *gathered;
    if (elements > kMostWholeElements || !gather(shell, part, solid)) return;
    ExtremePoints chosen;
    choose_extremes(shell.state.scratch, solid.points(), kMostHullPoints,
                    kGoodEnough * structures.margin[shell.structure], chosen);
    const double density = shell.state.materials.density[structures.material[shell.structure]];
    const double volume = (part ? part->mass : structures.mass[shell.structure]) / density;
    if (chosen.face_count == 0 || !(volume > 0)) return;
    const FittedBox box = fit_box(solid.points(), chosen);
    const double box_ratio = box.volume() / volume, hull_ratio = hull_volume(solid.points(), chosen) / volume;
    structures.box_ratio[shell.structure] = static_cast<float>(box_ratio);
    structures.hull_ratio[shell.structure] = static_cast<float>(hull_ratio);
    if (!part)
        structures.margin[shell.structure] =
            std::min(structures.margin[shell.structure], margin_for(box.least_width()));
    const float margin = structures.margin[shell.structure];
    if (box_ratio < kMostBoxRatio && box.least_width() > 2.5 * double{margin}) {
        structures.shape[shell.structure] = static_cast<uint8_t>(ShapeKind::Box);
        structures.shape_points[shell.structure] = kBoxCorners;
        write_box(shell, box, margin, first_point);
    } else if (hull_ratio < kMostHullRatio && chosen.left_out < kTooMuch * margin) {
        structures.shape[shell.structure] = static_cast<uint8_t>(ShapeKind::Hull);
        structures.shape_points[shell.structure] = static_cast<uint8_t>(chosen.count);
        write_hull(shell, part, solid, chosen, margin, first_point);
    }
}

}  // namespace cullet
