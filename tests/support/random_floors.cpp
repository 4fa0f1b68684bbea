#include "tests/support/random_floors.hpp"

#include <algorithm>
#include <cmath>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr float kLow = kFloorLow, kHigh = kFloorHigh, kSide = kFloorSide;
constexpr float kTilt = 0.17f;  // of the steepest hills, less than 10 degrees

// Counter-clockwise from above.
void add_triangle(FloorPart& part, Vec3 a, Vec3 b, Vec3 c) {
    if ((b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z) < 0) std::swap(b, c);
    const auto first = static_cast<uint32_t>(part.points.size());
    part.points.insert(part.points.end(), {a, b, c});
    part.triangles.push_back({first, first + 1, first + 2});
}

std::vector<float> cuts(Chance& chance, float low, float high, float least, float most) {
    std::vector<float> at{low};
    while (at.back() < high - most) at.push_back(at.back() + chance.between(least, most));
    at.push_back(high);
    return at;
}

/// Each cell cut along one diagonal or the other, or in four about a point inside.
Floor grid(const char* name, Chance& chance, const std::vector<float>& xs, const std::vector<float>& zs,
           const Height& height) {
    Floor floor{name, {FloorPart{}}};
    floor.height = height;
    FloorPart& part = floor.parts[0];
    const auto at = [&](float x, float z) { return Vec3{x, height(x, z), z}; };
    const bool is_flat = height(0.3f, 0.2f) == 0 && height(4.1f, 0.7f) == 0;
    for (size_t i = 0; i + 1 < xs.size(); ++i)
        for (size_t j = 0; j + 1 < zs.size(); ++j) {
            const Vec3 a = at(xs[i], zs[j]), b = at(xs[i + 1], zs[j]), c = at(xs[i + 1], zs[j + 1]),
                       d = at(xs[i], zs[j + 1]);
            const uint32_t kind = chance.below(is_flat ? 3 : 2);
            if (kind == 0) {
                add_triangle(part, a, b, c), add_triangle(part, a, c, d);
            } else if (kind == 1) {
                add_triangle(part, a, b, d), add_triangle(part, b, c, d);
            } else {
                const Vec3 m = at(xs[i] + (xs[i + 1] - xs[i]) * chance.between(0.05f, 0.95f),
                                  zs[j] + (zs[j + 1] - zs[j]) * chance.between(0.05f, 0.95f));
                add_triangle(part, a, b, m), add_triangle(part, b, c, m), add_triangle(part, c, d, m),
                    add_triangle(part, d, a, m);
            }
        }
    return floor;
}

Floor bricks(Chance& chance) {
    Floor floor{"T-junctions", {FloorPart{}}};
    const auto rows = cuts(chance, -kSide, kSide, 0.05f, 0.6f);
    for (size_t j = 0; j + 1 < rows.size(); ++j) {
        const auto xs = cuts(chance, kLow, kHigh, 0.05f, 0.8f);
        for (size_t i = 0; i + 1 < xs.size(); ++i) {
            const Vec3 a{xs[i], 0, rows[j]}, b{xs[i + 1], 0, rows[j]}, c{xs[i + 1], 0, rows[j + 1]},
                d{xs[i], 0, rows[j + 1]};
            add_triangle(floor.parts[0], a, b, c), add_triangle(floor.parts[0], a, c, d);
        }
    }
    return floor;
}

Floor fan(Chance& chance) {
    Floor floor{"fan", {FloorPart{}}};
    const Vec3 middle{chance.between(0, 4), 0, chance.between(-0.5f, 0.5f)};
    std::vector<Vec3> rim;
    for (const float x : cuts(chance, kLow, kHigh, 0.02f, 0.5f)) rim.push_back({x, 0, -kSide});
    for (const float z : cuts(chance, -kSide, kSide, 0.02f, 0.5f)) rim.push_back({kHigh, 0, z});
    auto back = cuts(chance, kLow, kHigh, 0.02f, 0.5f);
    for (size_t k = back.size(); k-- > 0;) rim.push_back({back[k], 0, kSide});
    back = cuts(chance, -kSide, kSide, 0.02f, 0.5f);
    for (size_t k = back.size(); k-- > 0;) rim.push_back({kLow, 0, back[k]});
    for (size_t k = 0; k < rim.size(); ++k) {
        const Vec3 next = rim[(k + 1) % rim.size()];
        if (length(next - rim[k]) > 0) add_triangle(floor.parts[0], middle, rim[k], next);
    }
    return floor;
}

Floor slivers(Chance& chance) {
    Floor floor{"slivers", {FloorPart{}}};
    float x = kLow;
    while (x < kHigh) {
        const float wide = chance.below(3) == 0 ? chance.between(0.05f, 0.3f) : chance.between(0.0003f, 0.01f);
        const float next = std::min(kHigh, x + wide);
        const Vec3 a{x, 0, -kSide}, b{next, 0, -kSide}, c{next, 0, kSide}, d{x, 0, kSide};
        if (next > x) add_triangle(floor.parts[0], a, b, c), add_triangle(floor.parts[0], a, c, d);
        x = next;
    }
    return floor;
}

/// Boxes side by side, 0.2 m high: bodies of triangles or of convex pieces with a margin, or pieces of one body.
Floor tiles(Chance& chance) {
    const uint32_t kind = chance.below(3);
    Floor floor{kind == 0 ? "tiles of triangles" : kind == 1 ? "tiles with margins" : "pieces of one body", {}};
    const auto xs = cuts(chance, kLow, kHigh, 0.15f, 0.9f);
    if (kind == 2) floor.parts.emplace_back();
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
        const auto zs = cuts(chance, -kSide, kSide, 0.3f, 2.0f);
        for (size_t j = 0; j + 1 < zs.size(); ++j) {
            const float margin = kind == 0 ? 0 : 0.001f;
            const Vec3 half{0.5f * (xs[i + 1] - xs[i]), 0.1f, 0.5f * (zs[j + 1] - zs[j])},
                centre{0.5f * (xs[i] + xs[i + 1]), -0.1f, 0.5f * (zs[j] + zs[j + 1])};
            const auto points = box_points(half - Vec3{margin, margin, margin}, centre);
            if (kind != 2) floor.parts.emplace_back();
            FloorPart& part = floor.parts.back();
            part.margin = margin;
            if (kind == 0) {
                part.points = points;
                part.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
            } else {
                part.pieces.push_back(points);
            }
        }
    }
    return floor;
}

/// How cells of a plank are set: their cores meet as those of a shell do, or their surfaces as tiles' do.
struct Setting {
    float margin = 0.001f;
    bool do_cores_meet = false;
};

/// A prism over an outline that runs round in the plane; all of its sides but those on the plank's rim are inner.
void add_prism(FloorPart& part, const std::vector<Vec3>& outline, float low, float high, Extent extent,
               Setting setting) {
    const float m = setting.margin;
    Vec3 middle;
    for (const Vec3 p : outline) middle += (1 / real(outline.size())) * p;
    std::vector<Vec3> points;
    for (size_t k = 0; k < outline.size(); ++k) {
        const Vec3 before = outline[(k + outline.size() - 1) % outline.size()], here = outline[k],
                   after = outline[(k + 1) % outline.size()];
        // Both sides go inwards by the margin, where they are not to meet.
        const auto inwards = [&](Vec3 from, Vec3 to) {
            Vec3 n = normalised(Vec3{to.z - from.z, 0, from.x - to.x});
            if (dot(n, middle - from) < 0) n = -n;
            const Vec3 half = 0.5f * (from + to);
            const bool is_rim = half.x == extent.low || half.x == extent.high || std::fabs(half.z) == extent.side;
            return std::pair{n, setting.do_cores_meet && !is_rim ? 0 : m};
        };
        const auto [n, first] = inwards(before, here);
        const auto [o, second] = inwards(here, after);
        // p = here + a n + b o with p . n = first, p . o = second.
        const float cosine = dot(n, o), square = 1 - cosine * cosine;
        const float a = (first - cosine * second) / square, b = (second - cosine * first) / square;
        const Vec3 p = here + a * n + b * o;
        points.push_back({p.x, low + m, p.z}), points.push_back({p.x, high - m, p.z});
    }
    part.pieces.push_back(points);
}

/// Cells between the cuts: whole, or each cut along one diagonal or the other, or in four about a point inside.
void add_layer(FloorPart& part, Chance& chance, bool are_prisms, float low, float high, Extent extent,
               Setting setting) {
    const bool is_aligned = chance.below(2) > 0;
    const float size = chance.between(0.25f, 0.8f) * extent.side;
    const auto xs = cuts(chance, extent.low, extent.high, 0.3f * size, size);
    auto zs = cuts(chance, -extent.side, extent.side, 0.5f * size, 1.2f * size);
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
        if (!is_aligned) zs = cuts(chance, -extent.side, extent.side, 0.5f * size, 1.2f * size);
        for (size_t j = 0; j + 1 < zs.size(); ++j) {
            const Vec3 a{xs[i], 0, zs[j]}, b{xs[i + 1], 0, zs[j]}, c{xs[i + 1], 0, zs[j + 1]}, d{xs[i], 0, zs[j + 1]};
            const uint32_t cut = are_prisms ? chance.below(4) : 3;
            const Vec3 m{xs[i] + (xs[i + 1] - xs[i]) * chance.between(0.2f, 0.8f), 0,
                         zs[j] + (zs[j + 1] - zs[j]) * chance.between(0.2f, 0.8f)};
            std::vector<std::vector<Vec3>> cells;
            if (cut == 0) cells = {{a, b, c}, {a, c, d}};
            if (cut == 1) cells = {{a, b, d}, {b, c, d}};
            if (cut == 2) cells = {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}};
            if (cut == 3) cells = {{a, b, c, d}};
            for (const auto& cell : cells) add_prism(part, cell, low, high, extent, setting);
        }
    }
}

Height hill_of(Chance& chance) {
    const float along = chance.between(0.3f, 1.2f), across = chance.between(0.2f, 0.8f), phase = chance.between(0, 6),
                steep = chance.between(0.03f, kTilt);
    return
        [=](float x, float z) { return steep / (along + across) * std::sin(along * x + phase) * std::cos(across * z); };
}

std::vector<float> even_cuts(float low, float high, float wide) {
    std::vector<float> at;
    const int count = static_cast<int>(std::ceil((high - low) / wide));
    for (int k = 0; k <= count; ++k) at.push_back(low + (high - low) * real(k) / real(count));
    return at;
}

Ground any_ground(Chance& chance, uint32_t kinds) {
    const Height flat = [](float, float) { return 0.0f; };
    switch (chance.below(kinds)) {
        case 0: {
            const float cell = chance.between(0.08f, 0.5f);
            return {grid("grid", chance, even_cuts(kLow, kHigh, cell), even_cuts(-kSide, kSide, cell), flat),
                    two_triangles()};
        }
        case 1:
            return {grid("uneven grid", chance, cuts(chance, kLow, kHigh, 0.02f, 0.6f),
                         cuts(chance, -kSide, kSide, 0.1f, 0.9f), flat),
                    two_triangles()};
        case 2:
            return {bricks(chance), two_triangles()};
        case 3:
            return {fan(chance), two_triangles()};
        case 4:
            return {slivers(chance), two_triangles()};
        case 5:
            return {tiles(chance), two_triangles()};
        default:
            return random_hill(chance);
    }
}

}  // namespace

Floor two_triangles() {
    Floor floor{"two triangles", {FloorPart{}}};
    add_triangle(floor.parts[0], {kLow, 0, -kSide}, {kHigh, 0, -kSide}, {kHigh, 0, kSide});
    add_triangle(floor.parts[0], {kLow, 0, -kSide}, {kHigh, 0, kSide}, {kLow, 0, kSide});
    return floor;
}

Ground random_ground(Chance& chance) {
    return any_ground(chance, 7);
}

Ground random_flat_ground(Chance& chance) {
    return any_ground(chance, 6);
}

Plank random_plank(Chance& chance, Extent extent, float thickness) {
    Plank plank;
    plank.extent = extent, plank.thickness = thickness;
    const uint32_t kind = chance.below(3);
    // Grown corners of triangles that do not meet would leave holes of some millimetres between them.
    const bool are_prisms = kind == 1 || (kind == 2 && chance.below(2) > 0);
    const Setting setting{0.001f, are_prisms || chance.below(2) > 0};
    static constexpr const char* kNames[] = {"tiles", "prisms", "two layers"};
    plank.floor = {kNames[kind], {FloorPart{}}};
    FloorPart& part = plank.floor.parts[0];
    part.margin = setting.margin;
    const float low = -thickness, half = kind == 2 ? 0.5f * low : low;
    if (kind == 2) add_layer(part, chance, are_prisms, low, half, extent, setting);
    add_layer(part, chance, are_prisms, half, 0, extent, setting);
    plank.plain = {"one box", {FloorPart{}}};
    const float m = plank.plain.parts[0].margin = setting.margin;
    plank.plain.parts[0].pieces.push_back(
        box_points(Vec3{0.5f * (extent.high - extent.low), 0.5f * thickness, extent.side} - Vec3{m, m, m},
                   {0.5f * (extent.low + extent.high), 0.5f * low, 0}));
    return plank;
}

Ground random_hill(Chance& chance) {
    const Height hill = hill_of(chance);
    const float cell = chance.between(0.08f, 0.2f);
    Chance other = chance;
    return {grid("hill", chance, even_cuts(kLow, kHigh, cell), even_cuts(-kSide, kSide, cell), hill),
            grid("finest hill", other, even_cuts(kLow, kHigh, 0.05f), even_cuts(-kSide, kSide, 0.05f), hill), true};
}

Ground random_ridges(Chance& chance) {
    const float middle = 0.5f * (kLow + kHigh), radius = chance.between(36, 50), cell = chance.between(0.3f, 0.9f);
    const Height hill = [=](float x, float) { return -0.5f * (x - middle) * (x - middle) / radius; };
    Chance other = chance;
    return {grid("ridges", chance, even_cuts(kLow, kHigh, cell), even_cuts(-kSide, kSide, cell), hill),
            grid("finest hill", other, even_cuts(kLow, kHigh, 0.05f), even_cuts(-kSide, kSide, 0.05f), hill), true};
}

Floor cut_in_four(const Floor& floor) {
    Floor fine = floor;
    for (FloorPart& part : fine.parts) {
        const FloorPart coarse = part;
        part.points.clear(), part.triangles.clear();
        for (const auto& [i, j, k] : coarse.triangles) {
            const Vec3 a = coarse.points[i], b = coarse.points[j], c = coarse.points[k];
            const Vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
            add_triangle(part, a, ab, ca), add_triangle(part, ab, b, bc);
            add_triangle(part, ca, bc, c), add_triangle(part, ab, bc, ca);
        }
    }
    return fine;
}

}  // namespace cullet
