// Seams between the pieces of one body: what they cover of each other's faces, see mark_covered().
#pragma once
#include <span>
#include <vector>

#include "engine/bullet/body.hpp"

namespace cullet::bullet {

struct Seam {
    Box box;  // of the piece, with the reach of its seams
    Hull* hull;
};
struct Ball {
    Vec3 centre;  // hull frame
    float radius;
};

/// Pieces beside those that the body lost know their seams no more.
void forget_seams(Body& body, std::span<const Ball> lost);
/// Finds the seams of all pieces that do not know theirs. `near` is working memory.
void mark_seams(Body& body, std::vector<Seam>& near);

}  // namespace cullet::bullet
