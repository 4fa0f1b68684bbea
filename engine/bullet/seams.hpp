// Seams between the pieces of one body: what they cover of each other's faces, see mark_covered().
#pragma once
#include <span>
#include <vector>

#include "engine/bullet/body.hpp"

namespace cullet::bullet {

struct Ball {
    Vec3 centre;  // hull frame
    float radius;
};
/// Pieces beside those that the body lost know their seams no more.
void forget_seams(Body& body, std::span<const Ball> lost);

/// A piece whose seams are looked for, or one beside it.
struct Seam {
    Box box;  // with the reach of seams
    Hull* hull;
    bool is_firm;         // its body is
    uint32_t first, end;  // those of its body in the list
};
/// Lists the pieces of a body that do not know their seams, and all that are near them.
void list_seams(Body& body, std::vector<Seam>& seams);
/// Finds what others cover of the piece at `place`, and writes to nothing else: several may be marked at once. None
/// knows its seams before all are marked.
void mark_seam(std::span<const Seam> seams, uint32_t place);

}  // namespace cullet::bullet
