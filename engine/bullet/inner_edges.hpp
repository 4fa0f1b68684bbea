// Edges inside what is flat do not push.
//
// A touch may push along the normals of the surface that stands there as one, whoever its parts belong to: triangles of
// a mesh, convex pieces of a body, bodies side by side that no solver moves: static ones, and kinematic ones that rest
// or move like these. Where a neighbour goes on in the direction in which a
// touch would push, there is no edge to push from; the touch is then the affair of an open face. Nothing is marked when
// a mesh comes in: what lies beside a touch is looked for where it lies, so that corners on edges, slivers, doubled
// points and mixed winding make no difference, nor does it matter which body a neighbour is of.
#pragma once
#include <span>

#include "engine/bullet/body.hpp"
#include "engine/bullet/box_tree.hpp"

namespace cullet::bullet {

/// What may go on where a piece ends.
struct Surroundings {
    const Body* bodies = nullptr;   // by id
    const BoxTree* tree = nullptr;  // of firm ones, see is_firm()
};

/// A piece or triangle that is touched, and what touches it.
struct Touched {
    const Body& body;
    const Hull& hull;
    const Body& other;
    const Hull& piece;     // of the other body
    const Points& points;  // of the piece, where it is in question
};

enum class Push {
    AsFound,  // the normal is one of the surface
    Turned,   // it was not: `normal` is that of an open face now
    None,     // nor is any of the touched piece: all of it lies beneath its neighbours
};

/// May `normal`, unit and out of the touched hull, push at `places` on its surface (world)? The deepest place comes
/// first. World points of the hull must be fresh; its body stands where these are.
Push turn_to_open_face(const Surroundings& around, const Touched& touched, std::span<const Vec3> places, Vec3& normal);
/// The open face of the hull that the piece lies deepest behind or nearest before; false: it has none.
bool find_open_face(const Surroundings& around, const Touched& touched, Vec3 place, Vec3& normal);

/// Whether inner edges of the piece are looked for: no solver moves its body, or other pieces of it go on in the plane
/// of one of its faces. Nothing else of what moves is searched: pieces of shards overlap, and heaps of them have many
/// contacts.
inline bool may_have_inner_edges(const Body& body, const Hull& hull) {
    return is_firm(body) || hull.flush != 0;
}

}  // namespace cullet::bullet
