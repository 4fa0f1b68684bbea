#include "systems/bodies/rigid_shape.hpp"

#include "components/body_id.hpp"

namespace cullet {

namespace {

template <class IsWanted>
std::span<const ConvexPiece> pieces_of(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                       RigidId broken_body, IsWanted&& is_wanted) {
    const Range cells = state.structures.cells[structure];
    const uint32_t first_point = state.structures.points[structure].first;
    uint32_t part_count = 0, count = 0;
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c)
        if (is_wanted(c))
            for (const uint8_t part_points : state.cells.part_points[c]) part_count += part_points > 0;
    const auto pieces = arena.take<ConvexPiece>(part_count);
    for (uint32_t c = 0; c < cells.count; ++c) {
        const uint32_t row = cells.first + c, same = state.cells.same_cell[row], shape = state.cells.shape[row];
        if (!is_wanted(row)) continue;
        uint32_t from = first_point + state.cells.first_point[row];
        for (uint32_t part = 0; part < kMostCellParts && count < pieces.size(); ++part) {
            const auto points = arena.take<Vec3>(state.cells.part_points[row][part]);
            if (points.empty()) continue;
            for (Vec3& p : points) p = state.hull_points.point[from++];
            ConvexPiece& piece = pieces[count++] = {points, kMostCellParts * c + part};
            if (broken_body == kNoRigid) continue;
            piece.same_body = same == kNone ? kNoRigid : broken_body;
            piece.same_cell = same == kNone ? kNone : kMostCellParts * same + part;
            piece.shape = shape == kNone ? kNone : kMostCellParts * shape + part;
        }
    }
    return pieces.first(count);
}

std::span<const ConvexPiece> one_piece(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                       bool is_made) {
    const auto pieces = arena.take<ConvexPiece>(1);
    const auto points = arena.take<Vec3>(state.structures.shape_points[structure]);
    for (uint32_t k = 0; k < points.size(); ++k)
        points[k] = state.hull_points.point[state.structures.points[structure].first + k];
    pieces[0] = {points, 0};
    if (is_made) pieces[0].shape = kMostCellParts * state.structures.made_shape[structure];
    return pieces;
}

}  // namespace

std::span<const ConvexPiece> convex_pieces(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                           RigidId broken_body) {
    if (state.structures.shape_points[structure]) return one_piece(state, structure, arena, broken_body != kNoRigid);
    return pieces_of(state, structure, arena, broken_body, [](uint32_t) { return true; });
}

std::span<const ConvexPiece> changed_pieces(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                            std::span<const uint32_t>& gone) {
    const Range cells = state.structures.cells[structure];
    const auto is_wanted = [&](uint32_t row) { return state.cells.same_cell[row] == kNone; };
    uint32_t count = 0, next = 0;
    for (uint32_t c = 0; c < cells.count; ++c) count += is_wanted(cells.first + c);
    const auto names = arena.take<uint32_t>(kMostCellParts * count);
    for (uint32_t c = 0; c < cells.count; ++c)
        for (uint32_t part = 0; part < kMostCellParts && is_wanted(cells.first + c); ++part)
            names[next++] = kMostCellParts * c + part;
    gone = names;
    return pieces_of(state, structure, arena, 0, is_wanted);
}

// Rolling friction is a length, by which the point that bears a body may miss its centre. It is a seventieth of the
// root of its area, as of a rim that is chipped, and no more than the gravel of a floor. With a third of it whole vases
// roll to and fro on a heap for six seconds after the last break. Without a bound a slab of 750 kg takes ten to tip
// over. At three times it slabs stand upright on one corner. What is too large for gravel rolls on its own rim. The
// round of a tower of 20 m, with the bound alone, rolls for minutes. With the share of shards no slab of it would tip
// over. Where it was set it is that of a ball of as much surface.
constexpr float kRollingShare = 0.0135f, kLargeRollingShare = 0.002f;
constexpr float kMostRolling = 0.00675f;    // m, of what is not large
constexpr float kRadiusShare = 0.2820948f;  // sqrt(1 / (4 pi)), of the root of a ball's surface

namespace {

float rolling_length(float setting, float area) {
    const float root = std::sqrt(area);
    if (setting >= 0) return setting * kRadiusShare * root;
    return std::min(kRollingShare * root, std::max(kMostRolling, kLargeRollingShare * root));
}

}  // namespace

RigidDescription describe_rigid(const Bodies& bodies, const Structures& structures, Row<Bodies> b,
                                std::span<const ConvexPiece> pieces) {
    const Row<Structures> structure = bodies.structure[b];
    RigidDescription d;
    d.kind = bodies.kind[b] == static_cast<uint8_t>(BodyKind::Dynamic) ? RigidKind::Dynamic : RigidKind::Static;
    d.pose = pose_of(bodies, b);
    d.motion = {bodies.velocity[b], bodies.spin[b]};
    d.mass = bodies.mass[b];
    d.centre = bodies.centre[b];
    d.inertia = bodies.inertia[b];
    d.margin = structures.margin[structure];
    d.friction = bodies.friction[b];
    d.restitution = bodies.restitution[b];
    d.rolling_friction = rolling_length(bodies.rolling_friction[b], structures.area[structure]);
    d.rolling_share = std::max(bodies.rolling_friction[b], 0.0f);
    d.layer = bodies.layer[b];
    d.mask = bodies.mask[b];
    d.pieces = pieces;
    return d;
}

namespace {

void take_inertia(Bodies& bodies, const Structures& structures, Row<Bodies> b) {
    const Row<Structures> structure = bodies.structure[b];
    bodies.mass[b] = structures.mass[structure];
    bodies.centre.set(b, structures.centre[structure]);
    bodies.inertia[b] = structures.inertia[structure];
}

}  // namespace

void take_mass_properties(Bodies& bodies, const Structures& structures, Row<Bodies> b, float radius) {
    take_inertia(bodies, structures, b);
    bodies.radius[b] = radius;
}

void take_rest_properties(Bodies& bodies, const Structures& structures, Row<Bodies> b) {
    const Vec3 moved = (structures.centre[bodies.structure[b]] - bodies.centre[b]).to_float();
    take_inertia(bodies, structures, b);
    bodies.radius[b] += length(moved);
}

}  // namespace cullet
