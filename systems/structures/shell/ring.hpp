// The elements and hinges round one vertex, found over neighbour links. The mesh's only such walk.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Elements round a vertex. Scanned meshes have 5 to 7, the pole of a lathe as many as it has segments. Cooking refuses
/// more, and no edge is split that would give a vertex more; doubled, a row of stiffness takes 7 kB of stack more.
inline constexpr uint32_t kMostRing = 64;

/// The elements of one fan, counter-clockwise seen from outside: element[i + 1] lies across the edge that ends at the
/// vertex in element[i]. A chain starts at its first element, a cycle at its smallest one, so that the order does not
/// depend on where the walk began: masses and rows summed in this order are the same bits.
struct Ring {
    uint32_t count = 0;
    uint32_t element[kMostRing];
    uint8_t corner[kMostRing];  // which corner of the element the vertex is
    bool is_closed = false;
    bool is_cut_short = false;  // more than kMostRing elements; count is 0 then
};

/// The fan of Vertices.element: every vertex has one (C3), so walking from any of its elements finds all. A dead vertex
/// has none.
void walk_ring(const ShellView& shell, uint32_t vertex, Ring& ring);
/// With all that it looks at.
using RingView = ShellIn<Tables<const Shells, const Vertices, const Elements>>;
void walk_ring(const RingView& shell, uint32_t vertex, Ring& ring);
/// The same elements in rising order: sums over them do not depend on where a walk began.
void collect_ring(const ShellView& shell, uint32_t vertex, Ring& ring);

/// Hinges that hold the vertex of this ring, as an end of the edge or as a corner opposite; rising, each once.
struct RingHinges {
    uint32_t count = 0;
    uint32_t hinge[2 * kMostRing + 1];
};
void collect_hinges(const ShellView& shell, const Ring& ring, RingHinges& hinges);

/// Elements with a hinge that holds the vertex of this ring: the ring's, and those across from it; rising, each once.
/// Round a corner of a tetrahedron one element lies across from all three of the ring.
struct HingeElements {
    uint32_t count = 0;
    uint32_t element[2 * kMostRing];
};
void collect_hinge_elements(const ShellView& shell, const Ring& ring, HingeElements& elements);

/// Corner of `element` at `vertex`, or 3.
uint8_t corner_of(const ShellView& shell, uint32_t element, uint32_t vertex);

/// Area-weighted normal of the rest shape, unit; zero when the areas cancel.
Vec3 ring_normal(ShellView shell, const Ring& ring);

/// Mass and inverse mass of a vertex: a third of each element of its ring, summed in ring order and never by
/// increments, so that any history of cuts gives the same bits for the same ring.
void weigh_vertex(ShellView shell, uint32_t vertex);

/// `direction` turned into the plane of unit `normal`, as a unit vector; zero when it stands upright on the plane.
Vec3 into_plane(Vec3 direction, Vec3 normal);

}  // namespace cullet
