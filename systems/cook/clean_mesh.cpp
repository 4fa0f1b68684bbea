#include "systems/cook/clean_mesh.hpp"

#include <algorithm>
#include <numeric>

namespace cullet {
namespace {

constexpr double kLeastArea = 1e-12;  // of the diagonal squared; a triangle below has no normal worth the name

struct Corners {
    Triangle id;
    uint32_t source;
    std::array<uint8_t, 3> corner;
};

bool is_finite(Vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Result<void> check(const Mesh& mesh) {
    const std::string where = mesh.name.empty() ? "mesh" : "mesh \"" + mesh.name + "\"";
    if (mesh.positions.size() >= kNone / 4 || mesh.triangles.size() >= kNone / 4)
        return Error{where + ": more than 1e9 vertices or triangles; split it."};
    for (size_t v = 0; v < mesh.positions.size(); ++v)
        if (!is_finite(mesh.positions[v]))
            return Error{where + ": position of vertex " + std::to_string(v) +
                         " is not finite; every coordinate must be a number. Repair the vertex or remove it."};
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const uint32_t v : mesh.triangles[t])
            if (v >= mesh.positions.size())
                return Error{where + ": triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                             std::to_string(mesh.positions.size()) + "; indices start at 0. Repair the index list."};
    const size_t corners = 3 * mesh.triangles.size();
    if ((!mesh.corner_normals.empty() && mesh.corner_normals.size() != corners) ||
        (!mesh.corner_uvs.empty() && mesh.corner_uvs.size() != corners) ||
        (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()))
        return Error{where + ": " + std::to_string(mesh.corner_normals.size()) + " corner normals, " +
                     std::to_string(mesh.corner_uvs.size()) + " corner texture coordinates and " +
                     std::to_string(mesh.materials.size()) + " materials for " + std::to_string(mesh.triangles.size()) +
                     " triangles; give three a triangle (materials: one), or none."};
    return {};
}

// Rank of every vertex among the distinct positions in (x, y, z) order. Negative zero equals zero.
std::vector<uint32_t> weld(const Mesh& mesh, std::vector<Vec3d>& distinct) {
    struct Keyed {
        Vec3 p;
        uint32_t vertex;
    };
    std::vector<Keyed> keyed(mesh.positions.size());
    for (uint32_t v = 0; v < keyed.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        keyed[v] = {{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, v};
    }
    std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
        if (a.p.x != b.p.x) return a.p.x < b.p.x;
        if (a.p.y != b.p.y) return a.p.y < b.p.y;
        if (a.p.z != b.p.z) return a.p.z < b.p.z;
        return a.vertex < b.vertex;
    });
    std::vector<uint32_t> rank(keyed.size());
    for (size_t k = 0; k < keyed.size(); ++k) {
        if (k == 0 || !(keyed[k].p == keyed[k - 1].p)) distinct.push_back(Vec3d(keyed[k].p));
        rank[keyed[k].vertex] = static_cast<uint32_t>(distinct.size() - 1);
    }
    return rank;
}

// Positions within the tolerance of an earlier one (in each coordinate) become that one; returns how many did.
uint32_t weld_near(const std::vector<Vec3d>& distinct, double tolerance, std::vector<uint32_t>& rank) {
    Vec3d low = distinct[0], high = low;
    for (const Vec3d p : distinct) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double reach = tolerance * length(high - low);
    std::vector<uint32_t> kept(distinct.size(), kNone);
    uint32_t count = 0;
    for (uint32_t a = 0; a < distinct.size(); ++a) {
        if (kept[a] != kNone) continue;
        kept[a] = a;
        for (uint32_t b = a + 1; b < distinct.size() && distinct[b].x - distinct[a].x <= reach; ++b)
            if (kept[b] == kNone && std::fabs(distinct[b].y - distinct[a].y) <= reach &&
                std::fabs(distinct[b].z - distinct[a].z) <= reach)
                kept[b] = a, ++count;
    }
    for (uint32_t& r : rank) r = kept[r];
    return count;
}

Corners smallest_first(Corners c) {
    const size_t first = static_cast<size_t>(std::min_element(c.id.begin(), c.id.end()) - c.id.begin());
    Corners turned = c;
    for (size_t k = 0; k < 3; ++k) {
        turned.id[k] = c.id[(k + first) % 3];
        turned.corner[k] = static_cast<uint8_t>((k + first) % 3);
    }
    return turned;
}

// The same corners stand beside each other whatever their winding; the source decides last, so there are no ties.
bool canonical_before(const Corners& a, const Corners& b) {
    const auto key = [](const Corners& c) {
        return std::array<uint32_t, 5>{c.id[0], std::min(c.id[1], c.id[2]), std::max(c.id[1], c.id[2]), c.id[1],
                                       c.source};
    };
    return key(a) < key(b);
}

bool same_corners(const Corners& a, const Corners& b) {
    return a.id[0] == b.id[0] && std::min(a.id[1], a.id[2]) == std::min(b.id[1], b.id[2]) &&
           std::max(a.id[1], a.id[2]) == std::max(b.id[1], b.id[2]);
}

void measure(CleanMesh& clean, const std::vector<Corners>& corners) {
    clean.low = clean.high = clean.positions[corners[0].id[0]];
    for (const Corners& c : corners)
        for (const uint32_t v : c.id) {
            const Vec3d p = clean.positions[v];
            clean.low = {std::min(clean.low.x, p.x), std::min(clean.low.y, p.y), std::min(clean.low.z, p.z)};
            clean.high = {std::max(clean.high.x, p.x), std::max(clean.high.y, p.y), std::max(clean.high.z, p.z)};
        }
    clean.diagonal = length(clean.high - clean.low);
}

// Renumbers so that only used positions remain, in the same order.
void drop_unused(CleanMesh& clean, uint32_t distinct, SurfaceRepairs& repairs) {
    std::vector<uint32_t> renumbered(distinct, kNone);
    for (const Triangle& t : clean.triangles)
        for (const uint32_t v : t) renumbered[v] = 0;
    uint32_t count = 0;
    for (uint32_t v = 0; v < distinct; ++v)
        if (renumbered[v] != kNone) {
            clean.positions[count] = clean.positions[v];
            renumbered[v] = count++;
        }
    clean.positions.resize(count);
    for (Triangle& t : clean.triangles)
        for (uint32_t& v : t) v = renumbered[v];
    repairs.unused_vertices = distinct - count;
}

}  // namespace

Result<CleanMesh> clean_mesh(const Mesh& mesh, const SurfaceSettings& settings, SurfaceRepairs& repairs) {
    if (auto checked = check(mesh); !checked) return Error{checked.error()};
    CleanMesh clean;
    std::vector<uint32_t> rank = weld(mesh, clean.positions);
    const uint32_t distinct = static_cast<uint32_t>(clean.positions.size());
    repairs.welded_vertices = static_cast<uint32_t>(mesh.positions.size()) - distinct;
    uint32_t near_count = 0;
    if (settings.weld_tolerance > 0) near_count = weld_near(clean.positions, settings.weld_tolerance, rank);
    repairs.welded_vertices += near_count;

    std::vector<Corners> corners;
    corners.reserve(mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& m = mesh.triangles[t];
        const Corners c{{rank[m[0]], rank[m[1]], rank[m[2]]}, t, {0, 1, 2}};
        if (c.id[0] != c.id[1] && c.id[1] != c.id[2] && c.id[2] != c.id[0]) {
            corners.push_back(smallest_first(c));
        } else {
            ++repairs.repeated_corner_triangles;
            clean.repeated.push_back(t);
        }
    }
    const auto nothing_left = [&] {
        return Error{"mesh \"" + mesh.name + "\": none of its " + std::to_string(mesh.triangles.size()) +
                     " triangles has an area; give at least one triangle with three corners apart."};
    };
    if (corners.empty()) return nothing_left();
    measure(clean, corners);
    const double least = 2 * kLeastArea * clean.diagonal * clean.diagonal;
    const size_t before = corners.size();
    std::erase_if(corners, [&](const Corners& c) {
        const Vec3d a = clean.positions[c.id[0]];
        return length(cross(clean.positions[c.id[1]] - a, clean.positions[c.id[2]] - a)) < least;
    });
    repairs.zero_area_triangles = static_cast<uint32_t>(before - corners.size());
    if (corners.empty()) return nothing_left();

    std::sort(corners.begin(), corners.end(), canonical_before);
    for (size_t k = 0; k < corners.size(); ++k) {
        if (k > 0 && same_corners(corners[k], corners[k - 1])) {
            ++repairs.repeated_triangles;
            clean.repeated.push_back(corners[k].source);
            continue;
        }
        clean.triangles.push_back(corners[k].id);
        clean.source_triangles.push_back(corners[k].source);
        clean.source_corners.push_back(corners[k].corner);
    }
    std::sort(clean.repeated.begin(), clean.repeated.end());
    measure(clean, corners);
    drop_unused(clean, distinct, repairs);
    repairs.unused_vertices -= near_count;
    return clean;
}

}  // namespace cullet
