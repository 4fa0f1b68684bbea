// Bodies that have less room than they take.
#pragma once
#include "components/bodies.hpp"

namespace cullet {

/// One row is one body that cannot give way, between one who yields to nothing and what leaves it too little room.
/// There are no rows while none is.
struct Squeezes : Table<Squeezes> {
    using Table::Table;
    CULLET_TABLE(squeezes);
    Column<Row<Bodies>> body{*this, "body"};
    Column<Row<Bodies>> by{*this, "by"};               // who came, and moved
    Column<Row<Bodies>> against{*this, "against"};     // who stands on the other side
    Column<uint32_t> generation{*this, "generation"};  // of each, as a row is used again
    Column<uint32_t> generation_by{*this, "generation_by"};
    Column<uint32_t> generation_against{*this, "generation_against"};
    Column<Vec3> push{*this, "push"};        // unit, world: from `by` to `against`
    Column<float> room{*this, "room", "m"};  // that they leave along it
    // Of the room, that the centre is away from `by`. 0: what is against it gives way, and it goes as `by` does.
    Column<float> share{*this, "share"};
    Column<Vec3> point_by{*this, "point_by", "m"};  // where the body's centre is, in the frames of both
    Column<Vec3> point_against{*this, "point_against", "m"};
};

/// Row `row` goes, the ones behind it keep their order.
inline void remove_squeeze(Squeezes& squeezes, uint32_t row) {
    const uint32_t behind = squeezes.size() - row - 1;
    if (behind) squeezes.copy_rows(squeezes, row + 1, row, behind);
    squeezes.truncate(squeezes.size() - 1);
}
inline bool is_squeezed(const Squeezes& squeezes, Row<Bodies> body) {
    for (uint32_t row = 0; row < squeezes.size(); ++row)
        if (squeezes.body[row] == body) return true;
    return false;
}

}  // namespace cullet
