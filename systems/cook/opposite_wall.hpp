// How deep a vertex may go before it meets the half of the opposite wall: a ray and the largest ball that touches the
// surface at the vertex (thick shell note A2). Also the distance of any point from the surface.
#pragma once
#include "systems/cook/extrusion_work.hpp"

namespace cullet {

class OppositeWall {
 public:
    explicit OppositeWall(const ExtrusionWork& work);

    /// min(wanted, 0.49 distance to the first hit of the ray along m, 0.98 radius of the opposing ball) for vertex v.
    double cap(uint32_t v, Vec3d m, double wanted) const;
    /// Distance from p to the nearest triangle, at most `most`.
    double distance(Vec3d p, double most) const;

 private:
    struct Face {
        std::array<Vec3d, 3> point;
        Vec3d normal;
    };
    double first_hit(uint32_t v, Vec3d m, double far) const;
    double ball_radius(uint32_t v, Vec3d m, double r) const;
    bool is_excluded(uint32_t v, uint32_t triangle) const;

    const ExtrusionWork& work_;
    BoxTree tree_;
    std::vector<Face> faces_;            // in tree order
    std::vector<TreeBox> normal_boxes_;  // range of the normals under a node
    RayScene rays_;
};

}  // namespace cullet
