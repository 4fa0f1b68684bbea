#include "systems/births/make_debris.hpp"

#include "components/body_id.hpp"

namespace cullet {
namespace {

// m, of the ball of this volume; the cube root by Newton from above.
float radius_of(double volume) {
    double r = 1;
    for (int i = 0; i < 60; ++i) r = (2 * r + 0.2387 * volume / (r * r)) / 3;
    return static_cast<float>(r);
}

}  // namespace

uint32_t make_debris(DebrisTables tables, const Bodies& bodies, const RigidWorld& rigid, const NewDebris& piece,
                     uint64_t frame, Events<DebrisEvent>& told) {
    Debris& debris = tables.debris;
    uint32_t row = 0;
    while (row < debris.size() && debris.is_used[row]) ++row;
    if (row == debris.size() && debris.append(1) == kNone) return kNone;
    const Vec3 place = rigid.to_side_of(piece.parent, piece.place);
    debris.is_used[row] = 1;
    debris.is_resting[row] = 0;
    debris.position.set(row, place);
    debris.velocity.set(row, piece.velocity);
    debris.mass[row] = piece.mass;
    debris.radius[row] = radius_of(piece.volume);
    // Where the rigid world tells what is in the way, nothing else stops it.
    constexpr float kNoFloor = -1e6f;
    debris.floor[row] = rigid.knows_surfaces() ? kNoFloor : rigid.height_below(place, kNoFloor) + debris.radius[row];
    debris.colour[row] = bodies.colour[piece.parent];
    set_born(tables.ages, row, frame);
    told.push({body_id(bodies, piece.parent), bodies.user_data[piece.parent], place, piece.velocity, piece.mass});
    return row;
}

}  // namespace cullet
