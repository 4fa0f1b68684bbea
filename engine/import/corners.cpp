#include "engine/import/corners.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <tuple>
#include <utility>

#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

/// False for one that is zero or not finite.
bool is_usable_normal(Vec3 unit) {
    const float squared = dot(unit, unit);
    return squared > 0.99f && squared < 1.01f;
}

bool is_usable_uv(Vec2 uv) {
    return std::fabs(uv.x) <= kLargestCoordinate && std::fabs(uv.y) <= kLargestCoordinate;
}

bool has_repeated_corner(const Vec3* p) {
    return p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
}

void append_corner(Corners& out, const SourceTriangle& triangle, const SourceCorner& corner, const Affine& place,
                   Vec3d face_normal) {
    Vec3 normal;
    if (triangle.has_normals) {
        const double side = determinant(place) < 0 ? -1 : 1;
        normal = normalised(side * turned_normal(place, corner.normal)).to_float();
    }
    if (!is_usable_normal(normal)) {
        out.unusable_normals += triangle.has_normals;
        normal = normalised(face_normal).to_float();
    }
    out.normals.push_back(normal);
    Vec2 uv;
    if (triangle.has_uvs) uv = corner.uv;
    if (!is_usable_uv(uv)) uv = {}, ++out.unusable_uvs;
    out.uvs.push_back(uv);
}

/// For each corner its vertex: corners share one when all three coordinates are equal. Vertices are numbered as corners
/// first name them, so the order of the file is kept.
std::vector<uint32_t> join_equal_points(const std::vector<Vec3>& points, std::vector<Vec3>& vertices) {
    const auto key = [&points](uint32_t c) {
        return std::tuple(std::bit_cast<uint32_t>(points[c].x), std::bit_cast<uint32_t>(points[c].y),
                          std::bit_cast<uint32_t>(points[c].z), c);
    };
    std::vector<uint32_t> order(points.size()), first(points.size()), vertex(points.size());
    for (uint32_t c = 0; c < order.size(); ++c) order[c] = c;
    std::sort(order.begin(), order.end(), [&key](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        const Vec3 p = points[order[i]], q = points[order[i > 0 ? i - 1 : 0]];
        const bool is_new = i == 0 || std::bit_cast<uint32_t>(p.x) != std::bit_cast<uint32_t>(q.x) ||
                            std::bit_cast<uint32_t>(p.y) != std::bit_cast<uint32_t>(q.y) ||
                            std::bit_cast<uint32_t>(p.z) != std::bit_cast<uint32_t>(q.z);
        first[order[i]] = is_new ? order[i] : first[order[i - 1]];
    }
    for (uint32_t c = 0; c < points.size(); ++c) {
        if (first[c] == c) {
            vertex[c] = static_cast<uint32_t>(vertices.size());
            vertices.push_back(points[c]);
        } else {
            vertex[c] = vertex[first[c]];  // first[c] < c
        }
    }
    return vertex;
}

std::string name_of(const std::string& path) {
    std::string name = one_line(std::filesystem::path(path).stem().string());
    return name.substr(0, kLongestMeshName);
}

}  // namespace

Vec3d turned(const Affine& a, Vec3d v) {
    return {dot(a.row[0], v), dot(a.row[1], v), dot(a.row[2], v)};
}

Vec3d placed(const Affine& a, Vec3d point) {
    return turned(a, point) + a.move;
}

Vec3d turned_normal(const Affine& a, Vec3d n) {
    return {dot(cross(a.row[1], a.row[2]), n), dot(cross(a.row[2], a.row[0]), n), dot(cross(a.row[0], a.row[1]), n)};
}

double determinant(const Affine& a) {
    return dot(a.row[0], cross(a.row[1], a.row[2]));
}

Affine scaled(double scale) {
    Affine a;
    a.row[0].x = a.row[1].y = a.row[2].z = scale;
    return a;
}

Affine chained(const Affine& parent, const Affine& child) {
    Affine both;
    for (int i = 0; i < 3; ++i) {
        const Vec3d r = parent.row[i];
        both.row[i] = r.x * child.row[0] + r.y * child.row[1] + r.z * child.row[2];
    }
    both.move = placed(parent, child.move);
    return both;
}

bool append_triangle(Corners& out, const SourceTriangle& triangle, const Affine& place) {
    out.has_normals = out.has_normals || triangle.has_normals;
    out.has_uvs = out.has_uvs || triangle.has_uvs;
    const bool is_mirrored = determinant(place) < 0;
    const SourceCorner* corner[3] = {&triangle.corner[0], &triangle.corner[is_mirrored ? 2 : 1],
                                     &triangle.corner[is_mirrored ? 1 : 2]};
    Vec3d exact[3];
    Vec3 rounded[3];
    for (int c = 0; c < 3; ++c) {
        // One number that is none would make all three so: the refusal is to name it as it stands in the file.
        const Vec3d p = corner[c]->position;
        exact[c] = std::isfinite(p.x + p.y + p.z) ? placed(place, p) : p;
        rounded[c] = exact[c].to_float() + Vec3{};  // adding zero makes -0 into 0, so that joining can compare bits
    }
    if (has_repeated_corner(rounded)) {
        ++out.collapsed;
        return false;
    }
    const Vec3d face_normal = cross(exact[1] - exact[0], exact[2] - exact[0]);
    for (int c = 0; c < 3; ++c) {
        out.positions.push_back(rounded[c]);
        append_corner(out, triangle, *corner[c], place, face_normal);
    }
    out.materials.push_back(triangle.material);
    return true;
}

bool has_too_many_triangles(const Corners& corners) {
    return corners.materials.size() > kMostMeshRows;
}

Result<void> check_triangles(const Corners& corners, const std::string& path) {
    if (!has_too_many_triangles(corners)) return {};
    return Error{path + ": has more than " + std::to_string(kMostMeshRows) + " triangles. Split the model."};
}

ConvertedModel joined_model(Corners&& corners, const std::string& path) {
    ConvertedModel model;
    Mesh& mesh = model.mesh;
    const std::vector<uint32_t> vertex = join_equal_points(corners.positions, mesh.positions);
    model.collapsed = corners.collapsed;
    model.left_out = corners.left_out;
    model.unusable_normals = corners.unusable_normals;
    model.unusable_uvs = corners.unusable_uvs;
    model.joined = corners.points - mesh.positions.size();
    model.notes = std::move(corners.notes);
    mesh.name = name_of(path);
    for (size_t c = 0; c < vertex.size(); c += 3) mesh.triangles.push_back({vertex[c], vertex[c + 1], vertex[c + 2]});
    if (corners.has_normals) mesh.corner_normals = std::move(corners.normals);
    if (corners.has_uvs) mesh.corner_uvs = std::move(corners.uvs);
    mesh.materials = std::move(corners.materials);
    return model;
}

}  // namespace cullet
