// What all readers of strangers' formats do alike: they hand on triangles, three corners each, and get a model in which
// equal points are joined and everything left out or replaced is counted.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/import/import.hpp"
#include "engine/math.hpp"

namespace cullet {

/// x -> linear x + move, in double, so that a deep tree of nodes costs no digits.
struct Affine {
    Vec3d row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3d move;
};

/// The linear part alone.
Vec3d turned(const Affine& a, Vec3d v);
Vec3d placed(const Affine& a, Vec3d point);
/// Normals turn with the cofactor matrix det(A) A^-T, which exists for singular A too. Its sign follows the
/// determinant, so that normals stay on the outside of a mirrored surface once the winding is turned.
Vec3d turned_normal(const Affine& a, Vec3d n);
double determinant(const Affine& a);
/// x -> scale x.
Affine scaled(double scale);
/// x -> parent(child(x)).
Affine chained(const Affine& parent, const Affine& child);

/// One corner as it stands in the file.
struct SourceCorner {
    Vec3d position;
    Vec3d normal;  // of any length
    Vec2 uv;
};

struct SourceTriangle {
    SourceCorner corner[3];  // counter-clockwise from outside, before the place is applied
    bool has_normals = false, has_uvs = false;
    uint16_t material = 0;
};

/// Three entries a triangle, before equal points are joined.
struct Corners {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<uint16_t> materials;  // one a triangle
    bool has_normals = false, has_uvs = false;
    uint64_t collapsed = 0;  // triangles left out
    uint64_t left_out = 0;   // lines and points
    uint64_t unusable_normals = 0, unusable_uvs = 0;
    uint64_t points = 0;             // of the file, that triangles use, once for each place of their mesh
    std::vector<std::string> notes;  // as those of ConvertedModel
};

/// False for a triangle with a repeated corner, which is counted and left out: a vertex that only such triangles used
/// must not stay behind. A place that mirrors turns the winding.
bool append_triangle(Corners& out, const SourceTriangle& triangle, const Affine& place);

/// Counts the points of a mesh that triangles use, at one of its places.
class UsedPoints {
 public:
    explicit UsedPoints(uint64_t points) : is_used_(points) {}
    /// Those of a triangle that was appended.
    template <class Points>
    void add(Corners& out, const Points& points) {
        for (const auto p : points) {
            out.points += !is_used_[p];
            is_used_[p] = true;
        }
    }

 private:
    std::vector<bool> is_used_;
};

/// More than a mesh file holds.
bool has_too_many_triangles(const Corners& corners);
Result<void> check_triangles(const Corners& corners, const std::string& path);

/// Joins points whose three coordinates are equal to the last bit. The mesh is named after the file.
ConvertedModel joined_model(Corners&& corners, const std::string& path);

}  // namespace cullet
