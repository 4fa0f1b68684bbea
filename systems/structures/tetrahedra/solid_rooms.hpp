// What follows from cooked solids, and what their breaks work in and leave until pieces are born. It stands beside the
// tables, in no file and no hash: the same steps make it again.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "components/solid_rows.hpp"
#include "components/tasks.hpp"
#include "systems/structures/tetrahedra/cook/convex_pieces.hpp"
#include "systems/structures/tetrahedra/cook/cut_pieces.hpp"

namespace cullet {

/// As a row of SkinTriangles.
struct BrokenTriangle {
    std::array<uint32_t, 3> corners;  // of the piece's points
    std::array<float, 9> normals;
    std::array<float, 6> uv;
    uint16_t drawn_material;
    uint8_t is_inside;
};
/// Some of a list.
struct Part {
    uint32_t first = 0, count = 0;
    template <class T>
    std::span<const T> of(const std::vector<T>& all) const {
        return std::span<const T>(all).subspan(first, count);
    }
};
struct BrokenPiece {
    Part cells, points, triangles, hulls, hull_points;  // in the lists below
    double volume = 0;                                  // m3
    Vec3d centre;                                       // m
    Sym3d inertia;                                      // about the centre, of density 1
    double radius = 0;                                  // m, no point is farther from the centre
    uint32_t one_with = 0;                              // the piece that takes it along; its own number as a rule
    bool has_pins = false;                              // it stays where it is
    Vec3d impulse, turning;                             // N s, N m s about its centre: what an explosion gives it
};
/// Where two pieces lie at each other.
struct BrokenTouch {
    uint32_t a = 0, b = 0;
    double area = 0;
    Vec3d point, normal;  // sums by area; out of b
};

/// Lists are emptied and not given back: they keep the room that they have once had.
struct BrokenSolid {
    std::vector<uint32_t> piece_of;  // by cell; kNone: others have it
    std::vector<uint32_t> cells;     // piece by piece, ascending
    std::vector<uint32_t> moved;     // points of the lattice that are not where they were cooked
    std::vector<Vec3d> moved_to;
    std::vector<Vec3d> points;
    std::vector<BrokenTriangle> triangles;
    std::vector<uint8_t> hulls;  // how many points each has
    std::vector<Vec3> hull_points;
    std::vector<BrokenPiece> pieces;
    std::vector<BrokenTouch> touches;

    void clear();
    void reserve(const CookedSolid& solid);
};

/// What follows from what was cooked. `of_model` belongs to the model that breaks it.
struct KnownSolid {
    uint64_t content = 0;
    CookedSolid cooked;
    std::shared_ptr<const void> of_model;
};
/// What one task works in, or none.
struct BreakingRoom {
    Row<Tasks> task;
    Row<Structures> working;
    BrokenSolid broken;
    std::shared_ptr<void> of_model;
};

struct SolidRooms {
    std::vector<std::unique_ptr<KnownSolid>> known;
    std::vector<BreakingRoom> rooms;

    KnownSolid* find(uint64_t content) const;
};

/// So many tasks break solids at a time; others wait.
inline constexpr uint32_t kSolidRooms = 8;

/// Of what a structure was cooked; null: nobody has asked for it yet.
const KnownSolid* known_solid(Read<SolidRows> rows, Row<Structures> structure);
using RoomsOfTasks = Tables<const Tasks, SolidWork>;

/// Null: the task has none.
BreakingRoom* room_of_task(RoomsOfTasks rows, Row<Tasks> task);
/// One that no open task has, or null.
BreakingRoom* take_room(RoomsOfTasks rows, Row<Tasks> task);
/// Tasks that have one.
uint32_t taken_rooms(Tables<const Structures, const Tasks> rows);

/// Of one piece as it was cut, of the cells with this label: its surface with the artist's normals and uvs, and what it
/// weighs. One that encloses nothing is left out.
void lay_piece(Read<SolidRows> rows, Row<CookedSolids> row, const CookedSolid& solid, const PieceSkin& skin,
               std::span<const uint32_t> labels, uint32_t label, BrokenSolid& broken);
/// Who is beside whom, when all are laid.
void lay_touches(const Solid& solid, BrokenSolid& broken);
/// Of the next piece that has none.
void lay_hulls(std::span<const SolidHull> hulls, uint32_t piece, BrokenSolid& broken);

}  // namespace cullet
