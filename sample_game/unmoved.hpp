// Where the places of soft bodies were before anything bent them, so that what is woven into a cloth stays with it.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "sample_game/game_world.hpp"

namespace cullet {

class Unmoved {
 public:
    /// Remembers the bodies of cloth and rubber that it has not seen yet. Once a frame.
    void remember(const GameWorld& game);
    /// One a vertex of the view: where it was, as far as that is known, or where it is. Pieces that came off are not
    /// known. What tore is, but for the faces along the tear.
    std::vector<Vec3> of(BodyId body, const BodyView& view) const;

 private:
    using Corners = std::vector<Vec3>;  // 3 a triangle, in the order of its run
    static Corners corners_of(const BodyView& view, SurfaceKind kind);

    std::map<std::pair<uint32_t, uint32_t>, std::pair<Corners, Corners>> seen_;  // by handle: outer and inner faces
};

}  // namespace cullet
