#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"
#include "engine/table.hpp"
#include "systems/cook/disjoint_sets.hpp"

namespace cullet {
namespace {

using Corners = std::array<uint32_t, 4>;

constexpr double kTurn[3] = {0.9, 0.35, 0.25};  // rad: so that flat walls do not run along the lattice
constexpr uint64_t kJitterSeed = 0x1a771ce;
constexpr int32_t kRings = 2;  // cubes around the box: jitter, half a cube of centres, and one ring

/// Axes of the lattice in the body frame.
struct LatticeTurn {
    Vec3d axis[3];
    LatticeTurn() {
        double s[3], c[3];
        for (int k = 0; k < 3; ++k) sine_cosine(kTurn[k], s[k], c[k]);
        axis[0] = {c[0] * c[1], s[0] * c[1], -s[1]};
        axis[1] = {c[0] * s[1] * s[2] - s[0] * c[2], s[0] * s[1] * s[2] + c[0] * c[2], c[1] * s[2]};
        axis[2] = {c[0] * s[1] * c[2] + s[0] * s[2], s[0] * s[1] * c[2] - c[0] * s[2], c[1] * c[2]};
    }
    Vec3d in(Vec3d p) const { return {dot(axis[0], p), dot(axis[1], p), dot(axis[2], p)}; }
    Vec3d out(Vec3d p) const { return p.x * axis[0] + p.y * axis[1] + p.z * axis[2]; }
};

/// All coarse tetrahedra of a box of cubes, by number. Lengths are those of a cube's edge.
class CubeGrid {
 public:
    int32_t low[3], count[3];

    CubeGrid(Vec3d from, Vec3d to, double jitter) {
        for (int k = 0; k < 3; ++k) {
            low[k] = static_cast<int32_t>(std::floor(from[k])) - kRings;
            count[k] = static_cast<int32_t>(std::floor(to[k])) + 1 + kRings - low[k];
        }
        // One more of each behind the last cube: its corners, and the next centres.
        for (int32_t k = 0; k <= count[2]; ++k)
            for (int32_t j = 0; j <= count[1]; ++j)
                for (int32_t i = 0; i <= count[0]; ++i)
                    for (const uint64_t is_centre : {0u, 1u}) {
                        const int32_t x = i + low[0], y = j + low[1], z = k + low[2];
                        const Random random{kJitterSeed + is_centre};
                        const uint64_t here = place_hash(x, y, z);
                        const double half = is_centre ? 0.5 : 0;
                        const auto shift = [&](uint64_t axis) {
                            return half + jitter * (2 * random.uniform(here, axis) - 1);
                        };
                        vertices_.push_back(Vec3d(x, y, z) + Vec3d(shift(0), shift(1), shift(2)));
                    }
    }
    size_t vertex_count() const { return vertices_.size(); }
    Vec3d vertex(uint32_t v) const { return vertices_[v]; }
    uint32_t cube(int32_t i, int32_t j, int32_t k) const {
        return static_cast<uint32_t>((k * count[1] + j) * count[0] + i);
    }
    uint32_t tetrahedron_count() const { return 12u * static_cast<uint32_t>(count[0] * count[1] * count[2]); }
    /// The centre, the next one, and two neighbouring corners of the face between them; of positive volume.
    Corners corners(uint32_t tetrahedron) const {
        const uint32_t cube = tetrahedron / 12, axis = tetrahedron / 4 % 3, quarter = tetrahedron % 4;
        const uint32_t nx = static_cast<uint32_t>(count[0]), ny = static_cast<uint32_t>(count[1]);
        const uint32_t at[3] = {cube % nx, cube / nx % ny, cube / nx / ny};
        constexpr uint32_t kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const auto corner = [&](uint32_t q) {
            uint32_t p[3] = {at[0], at[1], at[2]};
            ++p[axis];
            p[(axis + 1) % 3] += kAround[q % 4][0], p[(axis + 2) % 3] += kAround[q % 4][1];
            return point(p) * 2;
        };
        uint32_t next[3] = {at[0], at[1], at[2]};
        ++next[axis];
        return {2 * point(at) + 1, 2 * point(next) + 1, corner(quarter), corner(quarter + 1)};
    }

 private:
    static uint64_t place_hash(int32_t x, int32_t y, int32_t z) {
        const auto bits = [](int32_t n) { return static_cast<uint64_t>(static_cast<uint32_t>(n)); };
        return Random::mix(bits(x) | bits(y) << 32) + bits(z);
    }
    uint32_t point(const uint32_t (&p)[3]) const {
        return (p[2] * static_cast<uint32_t>(count[1] + 1) + p[1]) * static_cast<uint32_t>(count[0] + 1) + p[0];
    }
    std::vector<Vec3d> vertices_;
};

/// In cubes; what is nearer counts as met, so that rounding leaves nothing out.
constexpr double kSlack = 1e-6;

struct Box {
    double low[3], high[3];
};
template <size_t N>
Box box_of(const std::array<Vec3d, N>& points) {
    Box box;
    for (int k = 0; k < 3; ++k) {
        box.low[k] = box.high[k] = points[0][k];
        for (const Vec3d& p : points)
            box.low[k] = std::min(box.low[k], p[k]), box.high[k] = std::max(box.high[k], p[k]);
    }
    return box;
}

struct FlatTriangle {
    std::array<Vec3d, 3> corner;
    Vec3d normal;
    Box box;
    explicit FlatTriangle(const std::array<Vec3d, 3>& c)
        : corner(c), normal(normalised(cross(c[1] - c[0], c[2] - c[0]))), box(box_of(c)) {}
};

/// A tetrahedron as many triangles ask for it: its box, and its planes from outside.
struct Shape {
    Box box;
    std::array<Vec3d, 4> corner;
    std::array<Vec3d, 4> normal;
    explicit Shape(const std::array<Vec3d, 4>& p) : box(box_of(p)), corner(p) {
        for (size_t k = 0; k < 4; ++k) {
            const auto& face = kFaceCorners[k];
            normal[k] = normalised(cross(p[face[1]] - p[face[0]], p[face[2]] - p[face[0]]));
        }
    }
};

// May say so of what passes by an edge; never leaves out what meets.
bool may_meet(const FlatTriangle& triangle, const Shape& shape) {
    for (int k = 0; k < 3; ++k)
        if (shape.box.low[k] > triangle.box.high[k] + kSlack || shape.box.high[k] < triangle.box.low[k] - kSlack)
            return false;
    bool is_above = true, is_below = true;
    for (const Vec3d& p : shape.corner) {
        const double height = dot(triangle.normal, p - triangle.corner[0]);
        is_above = is_above && height > kSlack, is_below = is_below && height < -kSlack;
    }
    if (is_above || is_below) return false;
    for (size_t k = 0; k < 4; ++k) {
        const Vec3d a = shape.corner[kFaceCorners[k][0]], normal = shape.normal[k];
        if (dot(normal, triangle.corner[0] - a) > kSlack && dot(normal, triangle.corner[1] - a) > kSlack &&
            dot(normal, triangle.corner[2] - a) > kSlack)
            return false;
    }
    return true;
}

/// Shapes of tetrahedra, each made when it is first asked for: most of a box is far from the surface.
class Shapes {
 public:
    explicit Shapes(size_t count) : number_(count, kNone) {}
    template <class Places>
    const Shape& of(uint32_t tetrahedron, Places places) {
        if (number_[tetrahedron] == kNone) {
            number_[tetrahedron] = static_cast<uint32_t>(shapes_.size());
            shapes_.push_back(Shape(places()));
        }
        return shapes_[number_[tetrahedron]];
    }

 private:
    std::vector<uint32_t> number_;
    std::vector<Shape> shapes_;
};

/// What a tetrahedron is to the solid.
enum Kind : uint8_t { Outside, Around, Holds };

// Whoever is neither met nor hangs together, over common vertices and tetrahedra that are not met, with a vertex that
// is outside is enclosed. Then those that share a vertex with what holds solid.
void enclose(std::vector<Kind>& kinds, const std::vector<Corners>& corners, std::vector<uint8_t> is_outside) {
    DisjointSets sets(is_outside.size() + 1);
    const uint32_t outside = static_cast<uint32_t>(is_outside.size());
    for (uint32_t v = 0; v < is_outside.size(); ++v)
        if (is_outside[v]) sets.unite(v, outside);
    for (uint32_t t = 0; t < corners.size(); ++t)
        if (kinds[t] != Holds)
            for (int k = 1; k < 4; ++k) sets.unite(corners[t][0], corners[t][k]);
    std::vector<uint8_t> is_held(is_outside.size());
    const uint32_t root = sets.find(outside);
    for (uint32_t t = 0; t < corners.size(); ++t) {
        if (kinds[t] != Holds && sets.find(corners[t][0]) != root) kinds[t] = Holds;
        if (kinds[t] == Holds)
            for (const uint32_t v : corners[t]) is_held[v] = 1;
    }
    for (uint32_t t = 0; t < corners.size(); ++t)
        if (kinds[t] == Outside)
            for (const uint32_t v : corners[t])
                if (is_held[v]) kinds[t] = Around;
}

/// Middles of edges, numbered after all points that are there.
class Middles {
 public:
    explicit Middles(std::vector<Vec3d>& points) : points_(points), of_(points.size()) {}
    uint32_t between(uint32_t a, uint32_t b) {
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        for (const auto& [other, middle] : of_[low])
            if (other == high) return middle;
        points_.push_back(0.5 * (points_[low] + points_[high]));
        of_[low].push_back({high, static_cast<uint32_t>(points_.size() - 1)});
        return of_[low].back().second;
    }
    TenNodes nodes(const Corners& c) {
        return {c[0],
                c[1],
                c[2],
                c[3],
                between(c[0], c[1]),
                between(c[0], c[2]),
                between(c[0], c[3]),
                between(c[1], c[2]),
                between(c[1], c[3]),
                between(c[2], c[3])};
    }

 private:
    std::vector<Vec3d>& points_;
    std::vector<std::vector<std::pair<uint32_t, uint32_t>>> of_;
};

bool is_positive(const std::vector<Vec3d>& points, const Corners& c) {
    return dot(cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]), points[c[3]] - points[c[0]]) > 0;
}

// Four at the corners and four around a diagonal of the octahedron between them. Between the middles of the two long
// edges (0, 1) and (2, 3) all eight have the shape of the whole; the shortest is that one, but for jitter.
std::array<Corners, 8> cut_in_eight(const std::vector<Vec3d>& points, const TenNodes& n, bool is_shortest) {
    // Middles by number: 4 (01), 5 (02), 6 (03), 7 (12), 8 (13), 9 (23). Poles, then the ring between them.
    constexpr uint32_t kDiagonals[3][6] = {{4, 9, 5, 6, 8, 7}, {5, 8, 4, 6, 9, 7}, {6, 7, 4, 5, 9, 8}};
    uint32_t best = 0;
    double shortest = 0;
    for (uint32_t d = 0; d < (is_shortest ? 3u : 1u); ++d) {
        const double way = length(points[n[kDiagonals[d][0]]] - points[n[kDiagonals[d][1]]]);
        if (d == 0 || way < shortest) best = d, shortest = way;
    }
    const auto& d = kDiagonals[best];
    std::array<Corners, 8> children{
        {{n[0], n[4], n[5], n[6]}, {n[4], n[1], n[7], n[8]}, {n[5], n[7], n[2], n[9]}, {n[6], n[8], n[9], n[3]}}};
    for (uint32_t k = 0; k < 4; ++k) children[4 + k] = {n[d[0]], n[d[1]], n[d[2 + k]], n[d[2 + (k + 1) % 4]]};
    for (Corners& c : children)
        if (!is_positive(points, c)) std::swap(c[2], c[3]);
    return children;
}

/// In the frame of the lattice, in cubes.
std::vector<FlatTriangle> turned_triangles(const ClosedMesh& mesh, const LatticeTurn& turn, Vec3d centre, double cube) {
    std::vector<Vec3d> places;
    places.reserve(mesh.positions.size());
    for (const Vec3d& p : mesh.positions) places.push_back((1 / cube) * turn.in(p - centre));
    std::vector<FlatTriangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        triangles.push_back(FlatTriangle({places[t[0]], places[t[1]], places[t[2]]}));
    return triangles;
}

/// Numbers of the coarse tetrahedra whose cubes are about a triangle.
template <class Visit>
void for_each_near(const CubeGrid& grid, const FlatTriangle& triangle, double jitter, Visit visit) {
    // A tetrahedron reaches from the corners of its cube to the centre of the next.
    int32_t from[3], to[3];
    for (int k = 0; k < 3; ++k) {
        from[k] =
            std::max(0, static_cast<int32_t>(std::ceil(triangle.box.low[k] - 1.5 - jitter - kSlack)) - grid.low[k]);
        to[k] = std::min(grid.count[k] - 1,
                         static_cast<int32_t>(std::floor(triangle.box.high[k] + jitter + kSlack)) - grid.low[k]);
    }
    for (int32_t k = from[2]; k <= to[2]; ++k)
        for (int32_t j = from[1]; j <= to[1]; ++j)
            for (int32_t i = from[0]; i <= to[0]; ++i)
                for (uint32_t t = 0; t < 12; ++t) visit(12 * grid.cube(i, j, k) + t);
}

std::array<Vec3d, 4> places_of(const CubeGrid& grid, const Corners& c) {
    return {grid.vertex(c[0]), grid.vertex(c[1]), grid.vertex(c[2]), grid.vertex(c[3])};
}

}  // namespace

double edge_for(double volume, double cells) {
    // Cube root by Newton, of 1 to 8: times a power of two it is the same for a mesh scaled by one.
    int exponent = 0;
    const double fraction = std::frexp(12 * volume / cells, &exponent);  // 0.5 to 1
    const int third = (exponent >= 0 ? exponent : exponent - 2) / 3;
    const double cube = std::ldexp(fraction, exponent - 3 * third);  // 0.5 to 4
    double root = 1.2;
    for (int step = 0; step < 8; ++step) root = (2 * root + cube / (root * root)) / 3;
    return std::ldexp(root, third);
}

Result<CoverLattice> cover_lattice(const ClosedMesh& mesh, const CoverSettings& settings) {
    const LatticeTurn turn;
    const Vec3d centre = 0.5 * (mesh.low + mesh.high);
    const double cube = settings.element_edges * settings.edge;
    const std::vector<FlatTriangle> triangles = turned_triangles(mesh, turn, centre, cube);
    Box box = triangles[0].box;
    for (const FlatTriangle& t : triangles)
        for (int k = 0; k < 3; ++k)
            box.low[k] = std::min(box.low[k], t.box.low[k]), box.high[k] = std::max(box.high[k], t.box.high[k]);
    double cubes = 1;
    for (int k = 0; k < 3; ++k) cubes *= box.high[k] - box.low[k] + 2 * kRings + 1;
    if (!(12 * cubes <= settings.most_coarse))
        return Error{"its box holds more than " + std::to_string(settings.most_coarse) +
                     " tetrahedra of the size that its volume asks for; take fewer cells"};
    const CubeGrid grid({box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}, settings.jitter);

    std::vector<Corners> coarse(grid.tetrahedron_count());
    for (uint32_t t = 0; t < coarse.size(); ++t) coarse[t] = grid.corners(t);
    std::vector<Kind> kinds(coarse.size(), Outside);
    Shapes shapes(coarse.size());
    for (const FlatTriangle& triangle : triangles)
        for_each_near(grid, triangle, settings.jitter, [&](uint32_t t) {
            if (kinds[t] == Outside && may_meet(triangle, shapes.of(t, [&] { return places_of(grid, coarse[t]); })))
                kinds[t] = Holds;
        });
    // The first layers are not met: rings are laid around the box.
    std::vector<uint8_t> is_outside(grid.vertex_count());
    for (const uint32_t v : coarse[0]) is_outside[v] = 1;
    enclose(kinds, coarse, is_outside);

    CoverLattice lattice;
    lattice.edge = settings.edge;
    std::vector<uint32_t> number(grid.vertex_count(), kNone), kept(coarse.size(), kNone);
    std::vector<Corners> corners;
    std::vector<Kind> kinds_kept;
    for (uint32_t t = 0; t < coarse.size(); ++t)
        if (kinds[t] != Outside) {
            for (const uint32_t v : coarse[t]) number[v] = 0;
            kept[t] = static_cast<uint32_t>(corners.size());
            corners.push_back(coarse[t]);
            kinds_kept.push_back(kinds[t]);
        }
    std::vector<Vec3d> places;  // of points, in the frame of the lattice
    for (uint32_t v = 0; v < number.size(); ++v)
        if (number[v] != kNone) {
            number[v] = static_cast<uint32_t>(places.size());
            places.push_back(grid.vertex(v));
        }
    for (Corners& c : corners) {
        for (uint32_t& v : c) v = number[v];
        if (!is_positive(places, c)) std::swap(c[2], c[3]);
    }
    Middles middles(places);
    for (const Corners& c : corners) lattice.coarse.push_back(middles.nodes(c));
    std::vector<Corners> halves;
    for (const TenNodes& nodes : lattice.coarse)
        for (const Corners& c : cut_in_eight(places, nodes, false)) halves.push_back(c);

    if (settings.element_edges == 4) {
        // The second cut is made around the solid alone.
        std::vector<Kind> half_kinds(halves.size(), Outside);
        Shapes half_shapes(halves.size());
        for (const FlatTriangle& triangle : triangles)
            for_each_near(grid, triangle, settings.jitter, [&](uint32_t t) {
                if (kinds[t] != Holds) return;
                for (uint32_t h = 8 * kept[t]; h < 8 * kept[t] + 8; ++h) {
                    if (half_kinds[h] != Outside) continue;
                    const Shape& shape = half_shapes.of(h, [&] {
                        const Corners& c = halves[h];
                        return std::array{places[c[0]], places[c[1]], places[c[2]], places[c[3]]};
                    });
                    if (may_meet(triangle, shape)) half_kinds[h] = Holds;
                }
            });
        std::vector<uint8_t> is_out(places.size());
        for (uint32_t h = 0; h < halves.size(); ++h)
            if (kinds_kept[h / 8] == Around)
                for (const uint32_t v : halves[h]) is_out[v] = 1;
        enclose(half_kinds, halves, is_out);
        Middles second(places);
        for (uint32_t h = 0; h < halves.size(); ++h) {
            if (half_kinds[h] == Outside) continue;
            for (const Corners& c : cut_in_eight(places, second.nodes(halves[h]), true)) {
                lattice.fine.push_back(c);
                lattice.coarse_of.push_back(h / 8);
            }
        }
    } else {
        lattice.fine = std::move(halves);
        for (uint32_t h = 0; h < lattice.fine.size(); ++h) lattice.coarse_of.push_back(h / 8);
    }
    for (const Vec3d& p : places) lattice.points.push_back(centre + cube * turn.out(p));
    find_neighbours(lattice);
    return lattice;
}

void find_neighbours(CoverLattice& lattice) {
    struct Face {
        uint32_t middle, high, tetrahedron, corner;
    };
    // Faces stand in a list of their lowest corner, a few dozen each.
    std::vector<std::vector<Face>> faces(lattice.points.size());
    lattice.neighbours.assign(lattice.fine.size(), {kNone, kNone, kNone, kNone});
    for (uint32_t t = 0; t < lattice.fine.size(); ++t)
        for (uint32_t k = 0; k < 4; ++k) {
            uint32_t v[3];
            for (uint32_t i = 0; i < 3; ++i) v[i] = lattice.fine[t][kFaceCorners[k][i]];
            std::sort(v, v + 3);
            std::vector<Face>& list = faces[v[0]];
            const auto other = std::find_if(list.begin(), list.end(),
                                            [&](const Face& f) { return f.middle == v[1] && f.high == v[2]; });
            if (other == list.end()) {
                list.push_back({v[1], v[2], t, k});
                continue;
            }
            lattice.neighbours[t][k] = other->tetrahedron;
            lattice.neighbours[other->tetrahedron][other->corner] = t;
            *other = list.back();
            list.pop_back();
        }
}

}  // namespace cullet
