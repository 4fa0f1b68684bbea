// The tree of nodes: which of them the scene shows, and where each stands.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/import/corners.hpp"
#include "engine/import/gltf/document.hpp"

namespace cullet::gltf {

struct Nodes {
    std::vector<Affine> places;   // of each node, from its own axes to the scene's
    std::vector<uint32_t> shown;  // by the scene, parents before children and children in their order
};

/// Throws where a node has two parents, or is its own ancestor.
Nodes read_nodes(const Document& document);

/// Turns by the quaternion (x, y, z, w), made a unit one, after scaling, and before moving.
Affine placed_by(Vec3d translation, const double* rotation, Vec3d scale, const Part& asker);

/// Of 16 numbers in column order. Its last row must be 0 0 0 1.
Affine affine_of(const double* matrix, const std::string& place);

}  // namespace cullet::gltf
