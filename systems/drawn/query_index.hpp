// Where bodies are, for queries: a box a body in a tree of boxes, made anew at the end of each step, and beside it the
// few bodies that calls have moved since. Not state: it follows from the rows and from the triangles that the game
// gave.
#pragma once
#include <array>
#include <memory>
#include <span>

#include "components/bodies.hpp"
#include "systems/hulls/box_levels.hpp"

namespace cullet {

struct ByteWriter;
class ByteReader;

/// What add_static was given, world axes.
struct StaticTriangles {
    std::vector<std::array<Vec3, 3>> corners;
    std::vector<AxisBox> extents;
    BoxLevels tree;

    void measure();
};

class QueryIndex {
 public:
    explicit QueryIndex(uint32_t body_limit);

    // Between steps.
    void set_triangles(uint32_t body, std::span<const Vec3> positions,
                       std::span<const std::array<uint32_t, 3>> triangles);
    void set_box(uint32_t body, Vec3 half_extents) { half_extents_[body] = half_extents; }
    /// A body that was made, moved or removed. Cheap: every 64th makes the tree anew.
    void touch(const Bodies& bodies, uint32_t body);
    /// All triangles that the game gave move by this.
    void shift(Vec3 by);

    /// What does not follow from the rows: the game's triangles and boxes.
    void save(ByteWriter& out, const Bodies& bodies) const;
    /// Of the bodies that `bodies` has; the tree is made by refresh().
    void load(ByteReader& in, const Bodies& bodies);

    /// All bodies that are there now. Allocates nothing. 13 ns a body where all stand as they
    /// stood, 100 ns where they move.
    void refresh(const Bodies& bodies);

    const AxisBox& extent(uint32_t body) const { return extents_[body]; }
    const StaticTriangles* triangles(uint32_t body) const { return triangles_[body].get(); }
    Vec3 half_extents(uint32_t body) const { return half_extents_[body]; }

    /// visit(body) for each body whose box is no farther than the limit, as BoxLevels::visit.
    template <class Far, class Limit, class Visit>
    void visit(Far&& far, Limit&& limit, Visit&& visit_body) const {
        const auto look = [&](uint32_t body) {
            if (far(extents_[body]) <= limit()) visit_body(body);
        };
        tree_.visit(far, limit, [&](uint32_t body) {
            if (!is_loose_[body]) look(body);
        });
        for (const uint32_t body : loose_)
            if (stands_[body].is_there) look(body);
    }

 private:
    /// What a body's box was made of.
    struct Stand {
        Pose pose;
        uint32_t generation = 0, stamp = 0;
        bool is_there = false;
    };
    bool place(const Bodies& bodies, uint32_t body);
    AxisBox world_extent(const Bodies& bodies, uint32_t body) const;

    std::vector<Stand> stands_;
    std::vector<AxisBox> extents_;  // world
    std::vector<Vec3> half_extents_;
    std::vector<std::unique_ptr<StaticTriangles>> triangles_;
    BoxLevels tree_;
    std::vector<uint32_t> there_, loose_;
    std::vector<uint8_t> is_loose_;
};

}  // namespace cullet
