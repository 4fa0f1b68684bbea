#include "tests/support/lattice_solids.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "engine/assert.hpp"
#include "engine/math.hpp"
#include "engine/random.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNone32 = 0xffffffffu;
using Corners = std::array<uint32_t, 4>;
using Polygon = std::vector<Vec3d>;

struct Lattice {
    std::vector<Vec3d> points;
    std::vector<Corners> coarse;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    uint32_t middle(uint32_t a, uint32_t b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(points.size()));
        if (is_new) points.push_back(0.5 * (points[a] + points[b]));
        return at->second;
    }
    TenNodes nodes_of(const Corners& c) {
        return {c[0],
                c[1],
                c[2],
                c[3],
                middle(c[0], c[1]),
                middle(c[0], c[2]),
                middle(c[0], c[3]),
                middle(c[1], c[2]),
                middle(c[1], c[3]),
                middle(c[2], c[3])};
    }
    void set_upright(Corners& c) const {
        if (dot(cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]), points[c[3]] - points[c[0]]) < 0)
            std::swap(c[0], c[1]);
    }
    // Edges 01 and 23 are the long ones, in a child as well.
    std::vector<Corners> children(const Corners& c) {
        const TenNodes n = nodes_of(c);
        const uint32_t m01 = n[4], m02 = n[5], m03 = n[6], m12 = n[7], m13 = n[8], m23 = n[9];
        std::vector<Corners> made = {{c[0], m01, m02, m03}, {m01, c[1], m12, m13}, {m02, m12, c[2], m23},
                                     {m03, m13, m23, c[3]}, {m01, m23, m02, m12},  {m01, m23, m12, m13},
                                     {m01, m23, m13, m03},  {m01, m23, m03, m02}};
        for (Corners& child : made) set_upright(child);
        return made;
    }
};

Vec3d turned(Vec3d p, bool is_turned) {
    if (!is_turned) return p;
    const double angles[3] = {0.9, 0.35, 0.25};
    double s0, c0, s1, c1, s2, c2;
    sine_cosine(angles[0], s0, c0), sine_cosine(angles[1], s1, c1), sine_cosine(angles[2], s2, c2);
    p = {c0 * p.x - s0 * p.y, s0 * p.x + c0 * p.y, p.z};
    p = {c1 * p.x + s1 * p.z, p.y, -s1 * p.x + c1 * p.z};
    return {p.x, c2 * p.y - s2 * p.z, s2 * p.y + c2 * p.z};
}

// Cubes of `cube`, corners and centres; tetrahedra of a centre, the next one and two corners of the face between.
Lattice lay(Vec3d half, double cube, double jitter, bool is_turned) {
    Lattice lattice;
    const int n = static_cast<int>(std::ceil(length(half) / cube)) + 2;
    std::map<std::array<int, 3>, uint32_t> at;  // in half cubes
    const auto point = [&](std::array<int, 3> p) {
        const auto [entry, is_new] = at.try_emplace(p, static_cast<uint32_t>(lattice.points.size()));
        if (is_new) {
            const Random random{7};
            const uint64_t key =
                static_cast<uint64_t>(((p[0] + 4096) * 8192 + p[1] + 4096) * int64_t{8192} + p[2] + 4096);
            Vec3d place{0.5 * cube * p[0], 0.5 * cube * p[1], 0.5 * cube * p[2]};
            place += jitter * cube *
                     Vec3d{random.uniform(key, 0) - 0.5, random.uniform(key, 1) - 0.5, random.uniform(key, 2) - 0.5};
            lattice.points.push_back(turned(place, is_turned));
        }
        return entry->second;
    };
    const double reach = length(half) + 2 * cube;
    for (int x = -n; x <= n; ++x)
        for (int y = -n; y <= n; ++y)
            for (int z = -n; z <= n; ++z)
                for (int axis = 0; axis < 3; ++axis) {
                    std::array<int, 3> centre{2 * x + 1, 2 * y + 1, 2 * z + 1}, next = centre;
                    next[axis] += 2;
                    if (0.5 * cube * std::sqrt(centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]) >
                        reach)
                        continue;
                    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                    const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> p = centre, q = centre;
                        p[axis] += 1, q[axis] += 1;
                        p[u] += around[k][0], p[v] += around[k][1];
                        q[u] += around[(k + 1) % 4][0], q[v] += around[(k + 1) % 4][1];
                        Corners c{point(centre), point(next), point(p), point(q)};
                        lattice.set_upright(c);
                        lattice.coarse.push_back(c);
                    }
                }
    return lattice;
}

Polygon clip(const Polygon& polygon, const BodyPlane& plane) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double a = dot(plane.normal, p) - plane.offset, b = dot(plane.normal, q) - plane.offset;
        if (a <= 0) kept.push_back(p);
        if ((a <= 0) != (b <= 0)) kept.push_back(p + a / (a - b) * (q - p));
    }
    return kept;
}

Polygon sheet_of(const BodyPlane& plane, double size) {
    const Vec3d n = normalised(plane.normal), middle = plane.offset / length(plane.normal) * n;
    const Vec3d u = normalised(cross(n, std::fabs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})), v = cross(n, u);
    return {middle - size * u - size * v, middle + size * u - size * v, middle + size * u + size * v,
            middle - size * u + size * v};
}

struct Face {
    uint32_t source;  // 0 to 3: of the tetrahedron; from 4 on: planes
    double area;
    Vec3d centroid, normal;
    Polygon polygon;
};
struct Part {
    uint32_t fine, coarse;
    std::vector<Face> faces;
    double volume = 0;
    Vec3d centroid;
    Moments moments{};
};

void measure_face(Face& face) {
    Vec3d sum, middle;
    const Polygon& p = face.polygon;
    for (size_t i = 2; i < p.size(); ++i) sum += 0.5 * cross(p[i - 1] - p[0], p[i] - p[0]);
    face.area = length(sum);
    face.normal = normalised(sum);
    for (size_t i = 2; i < p.size(); ++i) {
        const double a = 0.5 * dot(face.normal, cross(p[i - 1] - p[0], p[i] - p[0]));
        middle += a / 3 * (p[0] + p[i - 1] + p[i]);
    }
    face.centroid = face.area > 0 ? 1 / face.area * middle : Vec3d{};
}

// Barycentric coordinates in the coarse tetrahedron.
std::array<double, 4> inside(const std::array<Vec3d, 4>& t, Vec3d p) {
    const double v = dot(cross(t[1] - t[0], t[2] - t[0]), t[3] - t[0]);
    std::array<double, 4> l{};
    l[1] = dot(cross(p - t[0], t[2] - t[0]), t[3] - t[0]) / v;
    l[2] = dot(cross(t[1] - t[0], p - t[0]), t[3] - t[0]) / v;
    l[3] = dot(cross(t[1] - t[0], t[2] - t[0]), p - t[0]) / v;
    l[0] = 1 - l[1] - l[2] - l[3];
    return l;
}

void measure(Part& part, const std::array<Vec3d, 4>& coarse) {
    Vec3d apex;
    for (const Vec3d& p : coarse) apex += 0.25 * p;
    Vec3d sum;
    for (const Face& face : part.faces)
        for (size_t i = 2; i < face.polygon.size(); ++i) {
            const Vec3d tet[4] = {apex, face.polygon[0], face.polygon[i - 1], face.polygon[i]};
            const double v = dot(cross(tet[1] - apex, tet[2] - apex), tet[3] - apex) / 6;
            part.volume += v;
            sum += v / 4 * (tet[0] + tet[1] + tet[2] + tet[3]);
            std::array<double, 4> l[4], s{};
            for (int k = 0; k < 4; ++k) {
                l[k] = inside(coarse, tet[k]);
                for (int j = 0; j < 4; ++j) s[j] += l[k][j];
            }
            for (int a = 0, at = 0; a < 4; ++a)
                for (int b = a; b < 4; ++b, ++at) {
                    double m = s[a] * s[b];
                    for (int k = 0; k < 4; ++k) m += l[k][a] * l[k][b];
                    part.moments[at] += v / 20 * m;
                }
        }
    part.centroid = part.volume > 0 ? 1 / part.volume * sum : apex;
}

}  // namespace

std::vector<BodyPlane> box_planes(Vec3d h) {
    return {{{1, 0, 0}, h.x},  {{-1, 0, 0}, h.x}, {{0, 1, 0}, h.y},
            {{0, -1, 0}, h.y}, {{0, 0, 1}, h.z},  {{0, 0, -1}, h.z}};
}

std::vector<BodyPlane> column_planes(double radius, double half_height, int sides) {
    std::vector<BodyPlane> planes = {{{0, 0, 1}, half_height}, {{0, 0, -1}, half_height}};
    for (int k = 0; k < sides; ++k) {
        double sine, cosine;
        sine_cosine(2 * std::numbers::pi * k / sides, sine, cosine);
        planes.push_back({{cosine, sine, 0}, radius});
    }
    return planes;
}

std::vector<BodyPlane> ball_planes(double radius, int sides) {
    std::vector<BodyPlane> planes;
    for (int k = 0; k < sides; ++k) {
        const double z = 1 - (2 * k + 1.0) / sides, r = std::sqrt(1 - z * z);
        double sine, cosine;
        sine_cosine(k * std::numbers::pi * (3 - std::sqrt(5.0)), sine, cosine);
        planes.push_back({{r * cosine, r * sine, z}, radius});
    }
    return planes;
}

Solid fill_convex(const std::vector<BodyPlane>& planes, Vec3d half, const LatticeFill& fill) {
    Lattice lattice = lay(half, fill.edge * fill.elements, fill.jitter, fill.is_turned);
    Solid solid;
    std::vector<Part> parts;
    std::vector<std::array<uint32_t, 2>> fine_parts;  // part of each fine one, or none
    const double size = 4 * (length(half) + fill.edge);
    const auto add_fine = [&](const Corners& corners, uint32_t coarse) {
        const uint32_t fine = static_cast<uint32_t>(solid.lattice.fine.size());
        solid.lattice.fine.push_back(corners);
        solid.lattice.coarse_of.push_back(coarse);
        std::array<Vec3d, 4> p;
        for (int k = 0; k < 4; ++k) p[k] = lattice.points[corners[k]];
        std::vector<BodyPlane> sides;
        Part part{fine, coarse, {}, 0, {}, {}};
        for (uint32_t k = 0; k < 4; ++k) {
            Vec3d a = p[(k + 1) % 4], b = p[(k + 2) % 4], c = p[(k + 3) % 4];
            if (dot(cross(b - a, c - a), p[k] - a) > 0) std::swap(b, c);
            const Vec3d normal = normalised(cross(b - a, c - a));
            sides.push_back({normal, dot(normal, a)});
            part.faces.push_back({k, 0, {}, {}, {a, b, c}});
        }
        std::vector<uint32_t> crossing;
        bool is_out = false;
        for (uint32_t k = 0; k < planes.size(); ++k) {
            int out = 0;
            for (const Vec3d& c : p) out += dot(planes[k].normal, c) > planes[k].offset;
            if (out == 4) is_out = true;
            if (out > 0) crossing.push_back(k);
        }
        fine_parts.push_back({kNone32, 0});
        if (is_out) return;
        for (Face& face : part.faces)
            for (const uint32_t k : crossing) face.polygon = clip(face.polygon, planes[k]);
        for (const uint32_t k : crossing) {
            Face face{4 + k, 0, {}, {}, sheet_of(planes[k], size)};
            for (const BodyPlane& side : sides) face.polygon = clip(face.polygon, side);
            for (const uint32_t other : crossing)
                if (other != k) face.polygon = clip(face.polygon, planes[other]);
            part.faces.push_back(face);
        }
        std::erase_if(part.faces, [](const Face& face) { return face.polygon.size() < 3; });
        if (part.faces.size() < 4) return;
        for (Face& face : part.faces) measure_face(face);
        std::array<Vec3d, 4> whole;
        for (int k = 0; k < 4; ++k) whole[k] = lattice.points[solid.lattice.coarse[coarse][k]];
        measure(part, whole);
        if (!(part.volume > 1e-9 * fill.edge * fill.edge * fill.edge)) return;
        fine_parts[fine] = {static_cast<uint32_t>(parts.size()), 1};
        parts.push_back(part);
    };
    for (const Corners& coarse : lattice.coarse) {
        bool is_out = false;
        const double margin = 1.5 * fill.edge * fill.elements;
        for (const BodyPlane& plane : planes) {
            int out = 0;
            for (const uint32_t c : coarse) out += dot(plane.normal, lattice.points[c]) > plane.offset + margin;
            is_out |= out == 4;
        }
        if (is_out) continue;
        const uint32_t row = static_cast<uint32_t>(solid.lattice.coarse.size());
        solid.lattice.coarse.push_back(lattice.nodes_of(coarse));
        for (const Corners& child : lattice.children(coarse)) {
            if (fill.elements == 2) {
                add_fine(child, row);
            } else {
                for (const Corners& last : lattice.children(child)) add_fine(last, row);
            }
        }
    }
    solid.lattice.edge = fill.edge;
    solid.lattice.points = lattice.points;
    std::map<std::array<uint32_t, 3>, std::pair<uint32_t, uint32_t>> open;
    solid.lattice.neighbours.assign(solid.lattice.fine.size(), {kNone32, kNone32, kNone32, kNone32});
    for (uint32_t f = 0; f < solid.lattice.fine.size(); ++f)
        for (uint32_t k = 0; k < 4; ++k) {
            const Corners& c = solid.lattice.fine[f];
            std::array<uint32_t, 3> key{c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
            std::sort(key.begin(), key.end());
            const auto [at, is_new] = open.try_emplace(key, f, k);
            if (is_new) continue;
            solid.lattice.neighbours[f][k] = at->second.first;
            solid.lattice.neighbours[at->second.first][at->second.second] = f;
        }

    // Small parts join the neighbour that they share most with, smallest first.
    const uint32_t count = static_cast<uint32_t>(parts.size());
    std::vector<std::map<uint32_t, double>> shared(count);
    std::vector<double> volume(count);
    std::vector<uint32_t> group(count);
    for (uint32_t i = 0; i < count; ++i) {
        group[i] = i, volume[i] = parts[i].volume;
        for (const Face& face : parts[i].faces) {
            if (face.source >= 4) continue;
            const uint32_t other = solid.lattice.neighbours[parts[i].fine][face.source];
            if (other != kNone32 && fine_parts[other][1]) shared[i][fine_parts[other][0]] += face.area;
        }
    }
    double full = fill.edge * fill.edge * fill.edge / 12, sum = 0;
    for (const Part& part : parts) sum += part.volume;
    full = std::min(full, 2 * sum / count);
    std::set<std::pair<double, uint32_t>> small;
    for (uint32_t i = 0; i < count; ++i)
        if (volume[i] < fill.merge * full) small.insert({volume[i], i});
    while (!small.empty()) {
        const auto [v, i] = *small.begin();
        small.erase(small.begin());
        uint32_t into = kNone32;
        double most = 0;
        for (const auto& [other, area] : shared[i])
            if (area > most) most = area, into = other;
        if (into == kNone32) continue;
        small.erase({volume[into], into});
        volume[into] += v;
        for (uint32_t& g : group)
            if (g == i) g = into;
        for (const auto& [other, area] : shared[i]) {
            shared[other].erase(i);
            if (other != into) shared[into][other] += area, shared[other][into] += area;
        }
        shared[i].clear();
        if (volume[into] < fill.merge * full) small.insert({volume[into], into});
    }

    std::vector<uint32_t> cell_of_group(count, kNone32);
    std::vector<double> largest;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t& cell = cell_of_group[group[i]];
        if (cell == kNone32) {
            cell = static_cast<uint32_t>(solid.cells.size());
            solid.cells.push_back({});
            largest.push_back(0);
        }
        SolidCell& row = solid.cells[cell];
        if (parts[i].volume > largest[cell]) largest[cell] = parts[i].volume, row.tetrahedron = parts[i].fine;
        row.centroid += parts[i].volume * parts[i].centroid;
        row.volume += parts[i].volume;
        solid.volume += parts[i].volume;
    }
    for (SolidCell& row : solid.cells) row.centroid = 1 / row.volume * row.centroid;
    std::map<std::pair<uint32_t, uint32_t>, Moments> moments;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t cell = cell_of_group[group[i]];
        Moments& own = moments.try_emplace({cell, parts[i].coarse}, Moments{}).first->second;
        for (size_t k = 0; k < 10; ++k) own[k] += parts[i].moments[k];
        for (const Face& face : parts[i].faces) {
            if (face.source >= 4) {
                solid.area += face.area;
                solid.patches.push_back({2 * (face.source - 4), cell, face.area, face.centroid});
                continue;
            }
            const uint32_t other = solid.lattice.neighbours[parts[i].fine][face.source];
            if (other == kNone32 || !fine_parts[other][1]) continue;
            const uint32_t beside = cell_of_group[group[fine_parts[other][0]]];
            if (cell < beside)
                solid.bonds.push_back(
                    {cell, beside, parts[i].fine, face.source, face.area, face.centroid, face.normal});
        }
    }
    for (const auto& [key, value] : moments) solid.moments.push_back({key.first, key.second, value});
    std::stable_sort(solid.bonds.begin(), solid.bonds.end(),
                     [](const SolidBond& p, const SolidBond& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
    std::stable_sort(solid.patches.begin(), solid.patches.end(),
                     [](const SurfacePatch& p, const SurfacePatch& q) { return p.triangle < q.triangle; });
    solid.thickness = 2 * solid.volume / solid.area;
    return solid;
}

}  // namespace cullet
