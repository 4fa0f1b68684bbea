#include "systems/fragments/cell_hulls.hpp"

#include <algorithm>
#include <span>

namespace cullet {
namespace {

constexpr uint32_t kMostCorners = 1536;  // of a cell's elements, each vertex as often as it is used
constexpr uint32_t kMostCandidates = 1024;

/// A vertex of the cell, and the sum of the ways in from the free edges that it is an end of.
struct Corner {
    uint32_t vertex, sequence;
    Vec3 way_in;
};

struct Frame {
    Vec3 x, y, n;
};

struct CandidateList {
    Vec3 point[kMostCandidates];
    uint32_t count = 0;
};

// Cosine and sine of k * 30 degrees.
constexpr float kHalfRoot3 = 0.8660254f;
constexpr float kTurn[12][2] = {
    {1, 0},  {kHalfRoot3, 0.5f},   {0.5f, kHalfRoot3},   {0, 1},  {-0.5f, kHalfRoot3}, {-kHalfRoot3, 0.5f},
    {-1, 0}, {-kHalfRoot3, -0.5f}, {-0.5f, -kHalfRoot3}, {0, -1}, {0.5f, -kHalfRoot3}, {kHalfRoot3, -0.5f}};

/// Direction k of the fixed order: the rims of both faces, the two normals, slanted ones, the rims' middles.
Vec3 direction(const Frame& f, uint32_t k) {
    const auto turned = [&](uint32_t t, float lift) {
        return kTurn[t % 12][0] * f.x + kTurn[t % 12][1] * f.y + lift * f.n;
    };
    if (k < 24) return turned(k % 12, k < 12 ? 0.3f : -0.3f);
    if (k < 26) return (k == 24 ? 1.0f : -1.0f) * f.n;
    if (k < 38) return turned(k - 26, k % 2 ? 1.0f : -1.0f);
    const Vec3 between = turned(k, 0) + turned(k + 1, 0);
    return between + (k < 50 ? 0.3f : -0.3f) * f.n;
}
constexpr uint32_t kDirections = 62;

/// Keeps at most 32 of the candidates, extremes by rising direction; ties go to the candidate that came first.
void keep_extremes(CandidateList& list, const Frame& frame) {
    bool is_chosen[kMostCandidates] = {};
    uint32_t chosen[kMostHullPoints], count = 0;
    for (uint32_t k = 0; k < kDirections && count < kMostHullPoints && count < list.count; ++k) {
        const Vec3 d = direction(frame, k);
        uint32_t best = 0;
        float reach = dot(d, list.point[0]);
        for (uint32_t i = 1; i < list.count; ++i)
            if (const float r = dot(d, list.point[i]); r > reach) best = i, reach = r;
        if (!is_chosen[best]) is_chosen[best] = true, chosen[count++] = best;
    }
    std::sort(chosen, chosen + count);
    for (uint32_t i = 0; i < count; ++i) list.point[i] = list.point[chosen[i]];
    list.count = count;
}

Vec3 corner_place(const ShellView& shell, uint32_t row, int k) {
    return shell.state.vertices.rest[shell.vertex(shell.state.elements.corner[row][k])];
}

/// Normal by area, longest way from the middle, and what is square to both.
Frame cell_frame(const ShellView& shell, uint32_t first, uint32_t last) {
    Vec3 n, middle;
    for (uint32_t e = first; e < last; ++e) {
        const uint32_t row = shell.element(e);
        const Vec3 p = corner_place(shell, row, 0), q = corner_place(shell, row, 1), r = corner_place(shell, row, 2);
        n += cross(q - p, r - p);
        middle += (1.0f / (3.0f * static_cast<float>(last - first))) * (p + q + r);
    }
    n = normalised(n);
    if (!(dot(n, n) > 0)) n = {0, 1, 0};  // closed or folded: no normal of its own
    Vec3 longest;
    for (uint32_t e = first; e < last; ++e)
        for (int k = 0; k < 3; ++k) {
            const Vec3 way = corner_place(shell, shell.element(e), k) - middle;
            const Vec3 flat = way - dot(way, n) * n;
            if (dot(flat, flat) > dot(longest, longest)) longest = flat;
        }
    Vec3 x = normalised(longest);
    if (!(dot(x, x) > 0)) x = normalised(std::fabs(n.x) < 0.7f ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
    return {x, cross(n, x), n};
}

uint32_t gather_corners(const ShellView& shell, uint32_t first, uint32_t last, Corner* corners) {
    const Elements& elements = shell.state.elements;
    uint32_t count = 0;
    for (uint32_t e = first; e < last; ++e) {
        const uint32_t row = shell.element(e);
        const Vec3 place[3] = {corner_place(shell, row, 0), corner_place(shell, row, 1), corner_place(shell, row, 2)};
        const Vec3 normal = normalised(cross(place[1] - place[0], place[2] - place[0]));
        Vec3 way_in[3];
        for (int k = 0; k < 3; ++k) {
            if (elements.neighbour[row][k] != kNone) continue;
            const Vec3 in = normalised(cross(normal, place[(k + 1) % 3] - place[k]));
            way_in[k] += in;
            way_in[(k + 1) % 3] += in;
        }
        for (int k = 0; k < 3; ++k, ++count) corners[count] = {elements.corner[row][k], count, way_in[k]};
    }
    std::sort(corners, corners + count, [](const Corner& a, const Corner& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.sequence < b.sequence;
    });
    return count;
}

void add_candidates(const ShellView& shell, std::span<const Corner> corners, float margin, const Frame& frame,
                    CandidateList& list) {
    const Vertices& vertices = shell.state.vertices;
    for (size_t i = 0; i < corners.size();) {
        const uint32_t v = corners[i].vertex, row = shell.vertex(v);
        Vec3 way_in;
        for (; i < corners.size() && corners[i].vertex == v; ++i) way_in += corners[i].way_in;
        if (list.count + 2 > kMostCandidates) keep_extremes(list, frame);
        const float pull = std::min(margin, 0.5f * vertices.depth[row]);
        const Vec3 p = vertices.rest[row] + margin * normalised(way_in), m = vertices.inward[row];
        list.point[list.count++] = p + pull * m;
        list.point[list.count++] = p + (vertices.depth[row] - pull) * m;
    }
}

}  // namespace

float hull_margin(const ShellView& shell) {
    return std::min(0.2f * shell.shells().thickness[shell.row], 0.001f);
}

void build_hulls(ShellView shell) {
    Corner corners[kMostCorners];
    CandidateList list;
    const float margin = hull_margin(shell);
    const Range cells = shell.shells().cells[shell.row];
    Range& points = shell.shells().points[shell.row];
    points.count = 0;
    uint32_t e = 0;
    for (uint32_t c = 0; c < cells.count; ++c) {
        const uint32_t first = e;
        while (e < shell.element_count() && shell.state.elements.cell[shell.element(e)] == c) ++e;
        list.count = 0;
        const Frame frame = first < e ? cell_frame(shell, first, e) : Frame{};
        constexpr uint32_t kBatch = kMostCorners / 3;
        for (uint32_t batch = first; batch < e; batch += kBatch) {
            const uint32_t count = gather_corners(shell, batch, std::min(e, batch + kBatch), corners);
            add_candidates(shell, {corners, count}, margin, frame, list);
        }
        keep_extremes(list, frame);
        CULLET_ASSERT(points.count + list.count <= points.capacity, "hull points of cell %u do not fit", c);
        for (uint32_t i = 0; i < list.count; ++i)
            shell.state.hull_points.point.set(points.first + points.count + i, list.point[i]);
        Cells& table = shell.state.cells;
        table.first_point[cells.first + c] = points.count;
        table.point_count[cells.first + c] = list.count;
        table.element_count[cells.first + c] = e - first;
        points.count += list.count;
    }
    CULLET_ASSERT(e == shell.element_count(), "elements of shell %u are not sorted by cell", shell.row.index);
}

}  // namespace cullet
