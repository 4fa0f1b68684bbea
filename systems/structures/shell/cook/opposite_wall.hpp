// How deep a vertex may go before it meets the half of the opposite wall: a ray and the largest ball that touches the
// surface at the vertex (thick shell note A2). Also the distance of any point from the surface.
#pragma once
#include <optional>

#include "systems/structures/shell/cook/extrusion_work.hpp"

namespace cullet {

class OppositeWall {
 public:
    /// `skin` may be null.
    explicit OppositeWall(const ExtrusionWork& work, const InnerSkin* skin = nullptr);

    /// min(wanted, 0.49 distance to the first hit of the ray along m, 0.98 radius of the opposing ball) for vertex v.
    double cap(uint32_t v, Vec3d m, double wanted) const;
    /// Distance from p to the nearest triangle, at most `most`.
    double distance(Vec3d p, double most) const;

    /// Whether the part of vertex v has an inner wall of its own.
    bool has_skin(uint32_t v) const { return skin_ && skin_->is_of_component[work_.component_of_vertex[v]]; }
    /// Distance along m from vertex v to that inner wall, or `far`.
    double way_to_skin(uint32_t v, Vec3d m, double far) const;

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
    const InnerSkin* skin_;
    std::vector<Vec3d> skin_points_;  // local
    std::optional<RayScene> skin_rays_;
};

}  // namespace cullet
