// The primitives of a glTF's meshes: their accessors, opened once, and the triangles that their modes make of indices.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/import/gltf/accessors.hpp"
#include "engine/import/gltf/draco.hpp"
#include "engine/import/gltf/texture_coordinates.hpp"

namespace cullet::gltf {

/// What a weight of 1 adds. nullptr: nothing.
struct MorphTarget {
    const Accessor* position = nullptr;
    const Accessor* normal = nullptr;
    const Accessor* uv = nullptr;
};

enum Mode : uint64_t { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

/// nullptr stands for what the primitive does not have.
struct Primitive {
    std::string place;  // "meshes[0].primitives[1]"
    uint64_t mode = kTriangles;
    uint16_t material = 0;  // without one, the number after the last
    const Accessor* position = nullptr;
    const Accessor* normal = nullptr;
    const Accessor* uv = nullptr;
    const Accessor* indices = nullptr;
    std::vector<const Accessor*> joints, weights;  // four a point in each; as many of the one as of the other
    std::vector<MorphTarget> targets;
    TextureCoordinates coordinates;
    std::shared_ptr<const DracoMesh> unpacked;  // holds the accessors of a packed primitive, and its triangles
    bool has_colours = false, has_tangents = false;
    uint64_t further_uvs = 0;  // sets

    uint64_t corners() const { return indices != nullptr ? indices->count : position->count; }
    /// The number of points, lines or half-built triangles that it holds and that make no triangle.
    uint64_t points_and_lines() const;
    uint64_t corners_left_over() const;
    uint64_t triangles() const;
    /// Points of triangle t, counter-clockwise. Throws when one is not there.
    std::array<uint64_t, 3> triangle(uint64_t t) const;

 private:
    uint64_t point(uint64_t corner) const;
};

struct GltfMesh {
    std::vector<Primitive> primitives;
    std::vector<double> weights;  // default ones
};

class Meshes {
 public:
    explicit Meshes(const Document& document) : document_(document), accessors_(document) {}

    /// The mesh that `asker` names by its number. It stays where it is.
    const GltfMesh& at(const Part& asker);
    Accessors& accessors() { return accessors_; }
    const std::map<uint64_t, GltfMesh>& known() const { return known_; }

 private:
    Primitive read(const Part& part);
    void unpack(const Part& part, Primitive& primitive);
    void read_attributes(const Part& part, Primitive& primitive);
    void read_influences(const Part& part, Primitive& primitive);
    void read_targets(const Part& part, Primitive& primitive);
    /// An attribute by its name, with so many components; nullptr when there is none.
    const Accessor* attribute(const Primitive& primitive, const Part& attributes, const std::string& name,
                              unsigned components);

    const Document& document_;
    Accessors accessors_;
    std::map<uint64_t, GltfMesh> known_;
};

}  // namespace cullet::gltf
