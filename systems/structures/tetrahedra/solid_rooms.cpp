#include "systems/structures/tetrahedra/solid_rooms.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

constexpr double kFewTriangles = 4;  // that enclose anything

bool is_open(const Tasks& tasks, const BreakingRoom& room) {
    return room.task.exists() && static_cast<TaskState>(tasks.state[room.task]) != TaskState::Free &&
           tasks.working[room.task] == room.working;
}

/// Shares of the three corners at a place in the plane of a triangle.
std::array<double, 3> shares_at(const std::array<Vec3d, 3>& corners, Vec3d place) {
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = dot(normal, normal);
    if (!(size > 0)) return {1, 0, 0};
    std::array<double, 3> shares;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d from = corners[(k + 1) % 3], to = corners[(k + 2) % 3];
        shares[k] = std::clamp(dot(normal, cross(to - from, place - from)) / size, 0.0, 1.0);
    }
    const double sum = shares[0] + shares[1] + shares[2];
    for (double& share : shares) share /= sum;
    return shares;
}

BrokenTriangle flat_triangle(const PieceSkin& skin, const PieceTriangle& t, const ClosedMesh& mesh) {
    BrokenTriangle made{t.corners, {}, {}, 0, 1};
    const Vec3d p = skin.places[t.corners[0]],
                across = cross(skin.places[t.corners[1]] - p, skin.places[t.corners[2]] - p);
    const double size = length(across);
    const Vec3 normal = size > 0 ? ((1 / size) * across).to_float() : Vec3{0, 1, 0};
    for (size_t k = 0; k < 3; ++k) {
        made.normals[3 * k] = normal.x, made.normals[3 * k + 1] = normal.y, made.normals[3 * k + 2] = normal.z;
        const auto uv = inside_uv(skin.places[t.corners[k]], size > 0 ? across : Vec3d(0, 1, 0), mesh.low, mesh.high);
        made.uv[2 * k] = uv[0], made.uv[2 * k + 1] = uv[1];
    }
    return made;
}

/// With what its source has at the same places; a corner of the source keeps its very bits.
BrokenTriangle triangle_of(Read<SolidRows> rows, uint32_t source, const ClosedMesh& mesh, uint32_t triangle,
                           const PieceSkin& skin, const PieceTriangle& t) {
    const SkinTriangles& all = rows.skin_triangles;
    BrokenTriangle made{t.corners, {}, {}, all.drawn_material[source], all.is_inside[source]};
    std::array<Vec3d, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.triangles[triangle][k]];
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d place = skin.places[t.corners[k]];
        size_t same = 3;
        for (size_t j = 0; j < 3; ++j)
            if (place == corners[j]) same = j;
        if (same < 3) {
            for (size_t i = 0; i < 3; ++i) made.normals[3 * k + i] = all.normals[source][3 * same + i];
            for (size_t i = 0; i < 2; ++i) made.uv[2 * k + i] = all.uv[source][2 * same + i];
            continue;
        }
        const auto shares = shares_at(corners, place);
        Vec3d normal;
        double u = 0, v = 0;
        for (size_t j = 0; j < 3; ++j) {
            const auto& n = all.normals[source];
            normal += shares[j] * Vec3d(double{n[3 * j]}, double{n[3 * j + 1]}, double{n[3 * j + 2]});
            u += shares[j] * double{all.uv[source][2 * j]}, v += shares[j] * double{all.uv[source][2 * j + 1]};
        }
        const Vec3 unit = normalised(normal).to_float();
        made.normals[3 * k] = unit.x, made.normals[3 * k + 1] = unit.y, made.normals[3 * k + 2] = unit.z;
        made.uv[2 * k] = static_cast<float>(u), made.uv[2 * k + 1] = static_cast<float>(v);
    }
    return made;
}

/// Crack faces look like one broken face and not like tetrahedra: corners take the mean of the faces around them that
/// bend away by less than this; a sharper edge stays one.
constexpr double kSmooth = 0.7071;  // cosine of 45 degrees
void smooth_cracks(const PieceSkin& skin, std::span<BrokenTriangle> made) {
    List<uint32_t> first(skin.places.size() + 1);
    List<Vec3d> across(made.size());
    for (size_t t = 0; t < made.size(); ++t) {
        if (skin.triangles[t].source != kNone) continue;
        const auto& c = made[t].corners;
        const Vec3d p = skin.places[c[0]];
        across[t] = cross(skin.places[c[1]] - p, skin.places[c[2]] - p);
        for (const uint32_t v : c) ++first[v + 1];
    }
    for (size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
    List<uint32_t> around(first.back()), next(first.begin(), first.end() - 1);
    for (uint32_t t = 0; t < made.size(); ++t)
        if (skin.triangles[t].source == kNone)
            for (const uint32_t v : made[t].corners) around[next[v]++] = t;
    for (size_t t = 0; t < made.size(); ++t) {
        const double size = length(across[t]);
        if (skin.triangles[t].source != kNone || !(size > 0)) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = made[t].corners[k];
            Vec3d sum;
            for (uint32_t i = first[v]; i < first[v + 1]; ++i)
                if (dot(across[around[i]], across[t]) > kSmooth * size * length(across[around[i]]))
                    sum += across[around[i]];
            const Vec3 normal = normalised(sum).to_float();
            made[t].normals[3 * k] = normal.x, made[t].normals[3 * k + 1] = normal.y;
            made[t].normals[3 * k + 2] = normal.z;
        }
    }
}

void weigh_piece(const PieceSkin& skin, BrokenPiece& piece) {
    const Vec3d origin = skin.places[0];
    VolumeSums sums;
    for (const PieceTriangle& t : skin.triangles) {
        const Vec3d corners[] = {skin.places[t.corners[0]] - origin, skin.places[t.corners[1]] - origin,
                                 skin.places[t.corners[2]] - origin};
        add_fan(corners, Vec3d(), 1, sums);
    }
    piece.volume = sums.volume;
    if (!(sums.volume > 0)) return;
    const Vec3d centre = (1 / sums.volume) * sums.first;
    piece.centre = origin + centre;
    Sym3d second = sums.second;
    const Sym3d moved = outer(centre);
    second.xx -= sums.volume * moved.xx, second.yy -= sums.volume * moved.yy, second.zz -= sums.volume * moved.zz;
    second.xy -= sums.volume * moved.xy, second.xz -= sums.volume * moved.xz, second.yz -= sums.volume * moved.yz;
    piece.inertia = inertia_of(second);
    double most = 0;
    for (const Vec3d& p : skin.places) most = std::max(most, length(p - piece.centre));
    piece.radius = most;
}

}  // namespace

void BrokenSolid::clear() {
    piece_of.clear(), cells.clear(), moved.clear(), moved_to.clear(), points.clear(), triangles.clear();
    hulls.clear(), hull_points.clear(), pieces.clear(), touches.clear();
}

// Faces between twenty pieces of a thousand cells are some thousand triangles on both sides.
void BrokenSolid::reserve(const CookedSolid& solid) {
    constexpr size_t kPieces = 64, kHulls = 8, kHullPoints = 32, kTrianglesACell = 16;
    const size_t count = solid.solid.cells.size(), lattice = solid.solid.lattice.points.size();
    const size_t skin = 2 * solid.mesh.triangles.size() + kTrianglesACell * count;
    piece_of.reserve(count), cells.reserve(count), moved.reserve(lattice), moved_to.reserve(lattice);
    points.reserve(skin), triangles.reserve(skin);
    hulls.reserve(kPieces * kHulls), hull_points.reserve(kPieces * kHulls * kHullPoints);
    pieces.reserve(kPieces), touches.reserve(kPieces * kHulls);
}

KnownSolid* SolidRooms::find(uint64_t content) const {
    for (const auto& one : known)
        if (one->content == content) return one.get();
    return nullptr;
}

const KnownSolid* known_solid(Read<SolidRows> rows, Row<Structures> structure) {
    if (!rows.solid_work.rooms) return nullptr;
    return rows.solid_work.rooms->find(
        rows.cooked_solids.content[rows.solids.cooked[solid_of(rows.structures, structure)]]);
}

BreakingRoom* room_of_task(RoomsOfTasks rows, Row<Tasks> task) {
    if (!rows.solid_work.rooms) return nullptr;
    for (BreakingRoom& room : rows.solid_work.rooms->rooms)
        if (room.task == task && is_open(rows.tasks, room)) return &room;
    return nullptr;
}

BreakingRoom* take_room(RoomsOfTasks rows, Row<Tasks> task) {
    if (!rows.solid_work.rooms) return nullptr;
    BreakingRoom* free = nullptr;
    for (BreakingRoom& room : rows.solid_work.rooms->rooms) {
        if (room.task == task) {  // of an earlier one of the same row
            free = &room;
            break;
        }
        if (!free && !is_open(rows.tasks, room)) free = &room;
    }
    if (!free) return nullptr;
    free->task = task, free->working = rows.tasks.working[task];
    free->broken.clear();
    return free;
}

uint32_t taken_rooms(Tables<const Structures, const Tasks> rows) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < rows.tasks.size(); ++t) {
        const bool is_free = static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Free;
        count += !is_free && rows.tasks.source[t].exists() && !is_shell(rows.structures, rows.tasks.source[t]);
    }
    return count;
}

void lay_piece(Read<SolidRows> rows, Row<CookedSolids> row, const CookedSolid& solid, const PieceSkin& skin,
               std::span<const uint32_t> labels, uint32_t label, BrokenSolid& broken) {
    if (broken.piece_of.empty()) broken.piece_of.assign(labels.size(), kNone);
    BrokenPiece piece;
    if (static_cast<double>(skin.triangles.size()) < kFewTriangles) return;
    weigh_piece(skin, piece);
    if (!(piece.volume > 0)) return;
    const auto number = static_cast<uint32_t>(broken.pieces.size());
    piece.one_with = number;
    piece.cells.first = static_cast<uint32_t>(broken.cells.size());
    for (uint32_t c = 0; c < labels.size(); ++c) {
        if (labels[c] != label) continue;
        broken.piece_of[c] = number;
        broken.cells.push_back(c);
        ++piece.cells.count;
    }
    piece.points = {static_cast<uint32_t>(broken.points.size()), static_cast<uint32_t>(skin.places.size())};
    broken.points.insert(broken.points.end(), skin.places.begin(), skin.places.end());
    piece.triangles = {static_cast<uint32_t>(broken.triangles.size()), static_cast<uint32_t>(skin.triangles.size())};
    const uint32_t first_source = rows.cooked_solids.triangles[row].first;
    for (const PieceTriangle& t : skin.triangles)
        broken.triangles.push_back(t.source == kNone
                                       ? flat_triangle(skin, t, solid.mesh)
                                       : triangle_of(rows, first_source + t.source, solid.mesh, t.source, skin, t));
    smooth_cracks(skin, std::span(broken.triangles).subspan(piece.triangles.first));
    broken.pieces.push_back(piece);
}

void lay_touches(const Solid& solid, BrokenSolid& broken) {
    for (const SolidBond& bond : solid.bonds) {
        const uint32_t a = broken.piece_of[bond.a], b = broken.piece_of[bond.b];
        if (a == b || a == kNone || b == kNone) continue;
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        auto at = std::find_if(broken.touches.begin(), broken.touches.end(),
                               [&](const BrokenTouch& t) { return t.a == low && t.b == high; });
        if (at == broken.touches.end()) at = broken.touches.insert(at, BrokenTouch{low, high, 0, {}, {}});
        at->area += bond.area;
        at->point += bond.area * bond.centroid;
        // The bond's normal runs from its a to its b.
        at->normal += (a == low ? -bond.area : bond.area) * bond.normal;
    }
}

void lay_hulls(std::span<const SolidHull> hulls, uint32_t piece, BrokenSolid& broken) {
    BrokenPiece& of = broken.pieces[piece];
    of.hulls.first = static_cast<uint32_t>(broken.hulls.size());
    of.hull_points.first = static_cast<uint32_t>(broken.hull_points.size());
    for (const SolidHull& hull : hulls) {
        broken.hulls.push_back(static_cast<uint8_t>(hull.points.size()));
        broken.hull_points.insert(broken.hull_points.end(), hull.points.begin(), hull.points.end());
    }
    of.hulls.count = static_cast<uint32_t>(broken.hulls.size()) - of.hulls.first;
    of.hull_points.count = static_cast<uint32_t>(broken.hull_points.size()) - of.hull_points.first;
}

}  // namespace cullet
