// Cuts triangles by the tetrahedra of a lattice, exactly: polygons, and the part of every face that lies inside (solid
// cooking note, 4.1 to 4.4). Cooking calls it with all triangles, a break with those near its cracks and with moved
// points.
#pragma once
#include <span>

#include "engine/room.hpp"
#include "systems/structures/tetrahedra/cook/closed_mesh.hpp"
#include "systems/structures/tetrahedra/cook/exact.hpp"
#include "systems/structures/tetrahedra/cook/lattice_faces.hpp"

namespace cullet {

/// The name of a point: two are the same if their keys are. Positions follow from keys.
enum class CutKeyKind : uint64_t {
    MeshVertex,    // a: vertex
    OnPair,        // a: pair of sides of triangles, b: face of the lattice
    OnTriangle,    // a: triangle, b: edge of the lattice
    LatticePoint,  // a: point
};
struct CutKey {
    uint64_t bits = 0;
    CutKey() = default;
    CutKey(CutKeyKind kind, uint32_t a, uint32_t b = 0)
        : bits(static_cast<uint64_t>(kind) << 62 | static_cast<uint64_t>(a) << 31 | b) {}
    CutKeyKind kind() const { return static_cast<CutKeyKind>(bits >> 62); }
    uint32_t a() const { return static_cast<uint32_t>(bits >> 31) & 0x7fffffffu; }
    uint32_t b() const { return static_cast<uint32_t>(bits) & 0x7fffffffu; }
    friend bool operator==(CutKey p, CutKey q) { return p.bits == q.bits; }
    friend bool operator<(CutKey p, CutKey q) { return p.bits < q.bits; }
};

/// How often one part of the mesh winds around a point, if it does.
struct Winding {
    uint32_t part = 0;
    int32_t count = 0;
};
/// Of lattice points. Point p has [first[p], first[p + 1]), by part.
struct Windings {
    List<uint32_t> first;
    List<Winding> list;
    std::span<const Winding> of(uint32_t point) const {
        return {list.data() + first[point], list.data() + first[point + 1]};
    }
};

/// What a triangle has in a tetrahedron: convex, keys counter-clockwise.
struct CutPolygon {
    uint32_t triangle = 0, tetrahedron = 0;
    uint32_t first = 0, count = 0;  // in Cut::keys and Cut::places
};
/// A way round the inside part of a face, counter-clockwise from outside of its first tetrahedron. One that runs the
/// other way is a hole in another.
struct CutLoop {
    uint32_t face = 0, part = 0;
    uint32_t first = 0, count = 0;
};
/// A triangle goes through an edge of the lattice.
struct Piercing {
    uint32_t edge = 0, triangle = 0;
    int32_t sign = 0;  // from the lower end: 1 enters the solid, -1 leaves it
};

struct Cut {
    List<CutPolygon> polygons;      // by triangle
    List<CutLoop> loops;            // by face
    List<CutKey> keys;              // of polygons, then of loops
    List<Vec3d> places;             // m, of each key; the same for the same key
    List<Piercing> piercings;       // by edge, then from the lower end on
    List<uint32_t> first_piercing;  // of each edge
    Windings windings;
    List<uint32_t> tetrahedron_of;  // of mesh vertices: where they are; kNone where no cut triangle asked
    uint32_t restarts = 0;          // because a point lay in a plane
};

struct CutRequest {
    const ClosedMesh& mesh;
    const CoverLattice& lattice;  // topology; and points, if none are given here
    const LatticeFaces& faces;
    std::span<const Vec3d> points = {};        // of the lattice, moved; empty: as cooked
    std::span<const uint32_t> triangles = {};  // ascending; empty: all
    /// Faces whose loops are wanted. All triangles that meet them must be among those above. Empty: all.
    std::span<const uint32_t> wanted_faces = {};
    /// Where known windings are (as of cooking), and which of them still hold: not those of moved points. Null: nobody
    /// is known, all points on the rim are outside.
    const Windings* known = nullptr;
    std::span<const uint8_t> is_known = {};         // of each point
    std::span<const uint32_t> tetrahedron_of = {};  // a guess where mesh vertices are, or empty
};

/// An error: a point stays in a plane after 40 restarts, or the lattice does not cover a triangle.
Result<Cut> cut_mesh(const CutRequest& request);

}  // namespace cullet
