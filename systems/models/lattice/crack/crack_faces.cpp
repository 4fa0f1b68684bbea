#include "systems/models/lattice/crack/crack_faces.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr uint32_t kNobody = 0xffffffffu;
constexpr size_t kMostPlanes = 8;  // pairs of pieces that meet around a point; more are left out
constexpr int kHalvings = 5;

std::array<uint32_t, 3> corners_of(const Solid& solid, uint32_t bond) {
    const SolidBond& b = solid.bonds[bond];
    const auto& corners = solid.lattice.fine[b.tetrahedron];
    return {corners[(b.face + 1) % 4], corners[(b.face + 2) % 4], corners[(b.face + 3) % 4]};
}

// Where the face is now, turned as its bond is: from a to b.
struct FacePlace {
    Vec3d normal, centroid;  // unit; m
};
FacePlace place_of(const Solid& solid, std::span<const Vec3d> places, uint32_t bond) {
    const auto c = corners_of(solid, bond);
    const Vec3d p = places[c[0]], q = places[c[1]], r = places[c[2]];
    const Vec3d normal = normalised(cross(q - p, r - p));
    return {dot(normal, solid.bonds[bond].normal) < 0 ? -normal : normal, 1.0 / 3 * (p + q + r)};
}

struct Planes {
    std::array<FacePlane, kMostPlanes> plane;
    size_t count = 0;
    FacePlane* of(uint32_t a, uint32_t b) {
        for (size_t i = 0; i < count; ++i)
            if (plane[i].a == a && plane[i].b == b) return &plane[i];
        return nullptr;
    }
};

// Pairs of pieces that meet at the point; their faces at it and at the corners of those.
Planes planes_around(const BreakableSolid& body, std::span<const uint32_t> piece, CrackFaces& faces, uint32_t point) {
    Planes planes;
    const Solid& solid = body.solid;
    const auto pair_of_bond = [&](uint32_t bond) {
        return std::minmax(piece[solid.bonds[bond].a], piece[solid.bonds[bond].b]);
    };
    for (uint32_t i = faces.first[point]; i < faces.first[point + 1]; ++i) {
        const auto [a, b] = pair_of_bond(faces.list[i]);
        if (!planes.of(a, b) && planes.count < kMostPlanes) planes.plane[planes.count++] = {a, b, 0, {}, {}};
    }
    for (uint32_t i = faces.first[point]; i < faces.first[point + 1]; ++i)
        for (const uint32_t corner : corners_of(solid, faces.list[i]))
            for (uint32_t k = faces.first[corner]; k < faces.first[corner + 1]; ++k) {
                const uint32_t bond = faces.list[k];
                if (faces.seen[bond] == point) continue;
                faces.seen[bond] = point;
                const auto [a, b] = pair_of_bond(bond);
                FacePlane* plane = planes.of(a, b);
                if (!plane) continue;
                const FacePlace place = place_of(solid, faces.places, bond);
                const double area = solid.bonds[bond].area, side = piece[solid.bonds[bond].a] == a ? area : -area;
                plane->area += area;
                plane->normal += side * place.normal;
                plane->centroid += area * place.centroid;
            }
    return planes;
}

// The least squares of n . (x + d - c) over the planes, and hold |d|^2.
Vec3d step_to(const Planes& planes, Vec3d x, double hold) {
    Sym3d matrix{hold, hold, hold, 0, 0, 0};
    Vec3d right;
    for (size_t i = 0; i < planes.count; ++i) {
        const FacePlane& plane = planes.plane[i];
        const Vec3d n = normalised(plane.normal);
        if (!(plane.area > 0) || !(dot(n, n) > 0)) continue;
        matrix = matrix + outer(n);
        right += dot(n, 1 / plane.area * plane.centroid - x) * n;
    }
    return inverse(matrix) * right;
}

bool is_sound(const BreakableSolid& body, const LatticePoints& points, const CrackFaces& faces, uint32_t point,
              double least) {
    for (const uint32_t t : points.of(point))
        if (!(volume_of(body.solid.lattice, faces.places, t) >=
              least * volume_of(body.solid.lattice, body.solid.lattice.points, t)))
            return false;
    return true;
}

void list_faces(const BreakableSolid& body, std::span<const uint32_t> piece, CrackFaces& faces, uint32_t foreign) {
    const Solid& solid = body.solid;
    std::fill(faces.first.begin(), faces.first.end(), 0u);
    std::fill(faces.seen.begin(), faces.seen.end(), kNobody);
    faces.face_count = 0;
    for (uint32_t b = 0; b < solid.bonds.size(); ++b) {
        const uint32_t one = piece[solid.bonds[b].a], other = piece[solid.bonds[b].b];
        if (one == other || one == foreign || other == foreign) continue;
        faces.faces[faces.face_count++] = b;
        for (const uint32_t p : corners_of(solid, b)) ++faces.first[p + 1];
    }
    for (size_t p = 0; p + 1 < faces.first.size(); ++p) faces.first[p + 1] += faces.first[p];
    // Ends move down to starts as the lists fill from behind.
    for (uint32_t i = faces.face_count; i-- > 0;)
        for (const uint32_t p : corners_of(solid, faces.faces[i])) faces.list[--faces.first[p + 1]] = faces.faces[i];
    for (size_t p = 0; p + 1 < faces.first.size(); ++p) faces.first[p] = faces.first[p + 1];
    faces.first.back() = 3 * faces.face_count;
}

// Numbers what hangs together over bonds within a piece. Afterwards `open` holds a cell of each part.
uint32_t flood_pieces(const BreakableSolid& body, std::span<const uint32_t> piece, CrackFaces& faces) {
    std::fill(faces.part.begin(), faces.part.end(), kNobody);
    uint32_t parts = 0;
    const uint32_t cells = static_cast<uint32_t>(piece.size());
    for (uint32_t start = 0; start < cells; ++start) {
        if (faces.part[start] != kNobody) continue;
        // The stack stands above the parts' cells: there are never more of both than cells.
        uint32_t open = parts + 1;
        faces.open[parts] = start;
        faces.part[start] = parts;
        faces.part_volume[parts] = 0;
        faces.open[open++] = start;
        while (open > parts + 1) {
            const uint32_t c = faces.open[--open];
            faces.part_volume[parts] += body.solid.cells[c].volume;
            for (const uint32_t b : body.paths.of_cell(c)) {
                const uint32_t other = body.solid.bonds[b].a == c ? body.solid.bonds[b].b : body.solid.bonds[b].a;
                if (piece[other] != piece[start] || faces.part[other] != kNobody) continue;
                faces.part[other] = parts;
                faces.open[open++] = other;
            }
        }
        ++parts;
    }
    return parts;
}

// The piece that a part shares most area with; its own, if it is beside no other.
uint32_t largest_beside(const BreakableSolid& body, std::span<const uint32_t> piece, const CrackFaces& faces,
                        uint32_t part, uint32_t own, uint32_t foreign) {
    std::array<std::pair<uint32_t, double>, kMostPlanes> found;
    size_t count = 0;
    for (const SolidBond& bond : body.solid.bonds) {
        const bool is_a = faces.part[bond.a] == part, is_b = faces.part[bond.b] == part;
        if (is_a == is_b) continue;
        const uint32_t other = piece[is_a ? bond.b : bond.a];
        if (other == foreign) continue;
        size_t i = 0;
        while (i < count && found[i].first != other) ++i;
        if (i == count && count < found.size()) found[count++] = {other, 0.0};
        if (i < count) found[i].second += bond.area;
    }
    std::pair<uint32_t, double> best{own, 0.0};
    for (size_t i = 0; i < count; ++i)
        if (found[i].second > best.second) best = found[i];
    return best.first;
}

}  // namespace

uint32_t filter_by_majority(const BreakableSolid& body, const FaceRules& rules, std::span<uint32_t> piece,
                            std::span<double> volume, uint32_t foreign) {
    uint32_t changed = 0;
    for (uint32_t sweep = 0; sweep < rules.sweeps; ++sweep) {
        const uint32_t before = changed;
        for (uint32_t c = 0; c < piece.size(); ++c) {
            if (piece[c] == foreign) continue;
            const auto beside = [&](uint32_t bond) {
                const SolidBond& b = body.solid.bonds[bond];
                return piece[b.a == c ? b.b : b.a];
            };
            double own = 0, most = 0;
            uint32_t best = piece[c];
            for (const uint32_t bond : body.paths.of_cell(c)) {
                const uint32_t other = beside(bond);
                if (other == foreign) continue;
                double area = 0;
                for (const uint32_t again : body.paths.of_cell(c))
                    if (beside(again) == other) area += body.solid.bonds[again].area;
                if (other == piece[c])
                    own = area;
                else if (area > most)
                    most = area, best = other;
            }
            const double size = body.solid.cells[c].volume;
            if (!(most > rules.majority * own) || best == piece[c] || !(volume[piece[c]] > 1.5 * size)) continue;
            volume[piece[c]] -= size, volume[best] += size;
            piece[c] = best;
            ++changed;
        }
        if (changed == before) break;
    }
    return changed;
}

void join_islands(const BreakableSolid& body, std::span<uint32_t> piece, std::span<double> volume, CrackFaces& faces,
                  uint32_t foreign) {
    constexpr int kPasses = 4;  // an island may join another one
    for (int pass = 0; pass < kPasses; ++pass) {
        const uint32_t parts = flood_pieces(body, piece, faces);
        bool is_any = false;
        for (uint32_t p = 0; p < parts; ++p) {
            const uint32_t own = piece[faces.open[p]];
            if (own == foreign) continue;
            bool is_island = false;
            for (uint32_t q = 0; q < parts && !is_island; ++q)
                is_island = q != p && piece[faces.open[q]] == own &&
                            (faces.part_volume[q] > faces.part_volume[p] ||
                             (faces.part_volume[q] == faces.part_volume[p] && q < p));
            if (!is_island) continue;
            const uint32_t into = largest_beside(body, piece, faces, p, own, foreign);
            if (into == own) continue;
            is_any = true;
            volume[own] -= faces.part_volume[p], volume[into] += faces.part_volume[p];
            for (uint32_t c = 0; c < piece.size(); ++c)
                if (faces.part[c] == p) piece[c] = into;
        }
        if (!is_any) return;
    }
}

void fit_planes(const BreakableSolid& body, const LatticePoints& points, const FaceRules& rules,
                std::span<const uint32_t> piece, CrackFaces& faces, uint32_t foreign) {
    const auto& lattice = body.solid.lattice;
    list_faces(body, piece, faces, foreign);
    for (uint32_t p = 0; p < lattice.points.size(); ++p) faces.is_settled[p] = !(faces.places[p] == lattice.points[p]);
    for (uint32_t b = 0; b < body.solid.bonds.size(); ++b)
        if ((piece[body.solid.bonds[b].a] == foreign) != (piece[body.solid.bonds[b].b] == foreign))
            for (const uint32_t p : corners_of(body.solid, b)) faces.is_settled[p] = 1;
    for (uint32_t round = 0; round < rules.rounds; ++round) {
        std::fill(faces.seen.begin(), faces.seen.end(), kNobody);
        for (uint32_t p = 0; p < lattice.points.size(); ++p) {
            if (faces.first[p] == faces.first[p + 1] || points.is_rim[p]) continue;
            if (faces.is_settled[p]) continue;
            const Vec3d before = faces.places[p], home = lattice.points[p];
            Vec3d step = step_to(planes_around(body, piece, faces, p), before, rules.hold);
            const double most = rules.most_move * double{points.shortest[p]};
            const Vec3d away = before + step - home;
            if (const double far = length(away); far > most) step = home + most / far * away - before;
            for (int halving = 0; halving <= kHalvings; ++halving) {
                faces.places[p] = before + step;
                if (is_sound(body, points, faces, p, rules.least_volume)) break;
                faces.places[p] = before;
                step = 0.5 * step;
            }
        }
    }
    faces.moved_count = 0;
    for (uint32_t p = 0; p < lattice.points.size(); ++p)
        if (!(faces.places[p] == lattice.points[p])) faces.moved[faces.moved_count++] = p;
}

namespace {

template <class Take>
void for_each_array(const BreakableSolid& body, CrackFaces& faces, Take take) {
    const size_t points = body.solid.lattice.points.size(), bonds = body.solid.bonds.size();
    take(faces.places, points), take(faces.moved, points), take(faces.faces, bonds), take(faces.first, points + 1);
    take(faces.list, 3 * bonds + 1), take(faces.seen, bonds), take(faces.is_settled, points);
    take(faces.part, body.solid.cells.size()), take(faces.open, body.solid.cells.size() + 2);
    take(faces.part_volume, body.solid.cells.size());
}

}  // namespace

uint64_t faces_bytes(const BreakableSolid& body) {
    constexpr uint64_t kSlack = 64;  // what alignment may take
    uint64_t bytes = 0;
    CrackFaces none;
    for_each_array(body, none, [&](const auto& array, size_t count) { bytes += count * sizeof(array[0]) + kSlack; });
    return bytes;
}

CrackFaces take_faces(Arena& arena, const BreakableSolid& body) {
    CrackFaces faces;
    for_each_array(body, faces, [&]<class T>(std::span<T>& array, size_t count) { array = arena.take<T>(count); });
    std::copy(body.solid.lattice.points.begin(), body.solid.lattice.points.end(), faces.places.begin());
    return faces;
}

}  // namespace cullet
