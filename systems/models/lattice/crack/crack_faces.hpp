// Crack faces that look broken and not built of tetrahedra (solid cooking note, section 7, steps 1 and 2).
#pragma once
#include <cstdint>
#include <span>

#include "engine/arena.hpp"
#include "systems/models/lattice/cook/breakable_solid.hpp"
#include "systems/models/lattice/cook/lattice_points.hpp"

namespace cullet {

struct FaceRules {
    double majority = 1.02;  // a cell changes to a piece that it shares more than this times its own area with
    uint32_t sweeps = 4;
    uint32_t rounds = 3;         // of moving points
    double most_move = 0.6;      // of a point's shortest edge, from its place in the lattice
    double least_volume = 0.15;  // of each tetrahedron's
    double hold = 0.02;          // how much a point wants to stay
};

struct FacePlane {
    uint32_t a = 0, b = 0;  // pieces, a below b
    double area = 0;
    Vec3d normal, centroid;  // sums, weighted by area
};
struct CrackFaces {
    std::span<Vec3d> places;    // of all points of the lattice
    std::span<uint32_t> moved;  // points, ascending
    uint32_t moved_count = 0;
    // Working room.
    std::span<uint32_t> faces;        // bonds between two pieces
    std::span<uint32_t> first, list;  // faces at each point
    std::span<uint32_t> seen;         // by bond: the point that has counted it
    std::span<uint8_t> is_settled;    // by point: earlier breaks have it
    std::span<uint32_t> part, open;   // by cell
    std::span<double> part_volume;
    uint32_t face_count = 0;
};
uint64_t faces_bytes(const BreakableSolid& body);
/// Points are where the lattice has them.
CrackFaces take_faces(Arena& arena, const BreakableSolid& body);

// `foreign`: the number of what left the body before; it neither gives nor takes.
inline constexpr uint32_t kNothingLeft = 0xffffffffu;

/// Teeth go: cells that stick out into another piece join it. Returns how many. `volume`: of pieces, which change with
/// it.
uint32_t filter_by_majority(const BreakableSolid& body, const FaceRules& rules, std::span<uint32_t> piece,
                            std::span<double> volume, uint32_t foreign = kNothingLeft);
/// What the filter has cut off from the rest of its piece joins the piece that it shares most area with.
void join_islands(const BreakableSolid& body, std::span<uint32_t> piece, std::span<double> volume, CrackFaces& faces,
                  uint32_t foreign = kNothingLeft);

/// Points of faces between pieces move onto planes that fit the faces around them. Those on the lattice's rim stay, and
/// so do those of faces towards what left the body, and those that are not where the lattice has them: earlier breaks
/// put them there. `faces.places` is where all are.
void fit_planes(const BreakableSolid& body, const LatticePoints& points, const FaceRules& rules,
                std::span<const uint32_t> piece, CrackFaces& faces, uint32_t foreign = kNothingLeft);

}  // namespace cullet
