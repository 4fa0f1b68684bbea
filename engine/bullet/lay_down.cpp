// What is put somewhere, by a spawn or a set_pose, is on the side of its centre of mass of every sheet that cuts it:
// the whole body moves there. A sheet that it merely reaches around does not cut it, see body_ways.hpp.
#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/sides.hpp"

namespace cullet::bullet {
namespace {

constexpr int kMoves = 100;  // a groove of 20 degrees takes two of three of these

}  // namespace

// Of all meshes the lowest one that cuts the way.
bool BulletWorld::find_cut_of(const Body& body, Vec3 from, Vec3 over, Vec3 to, Cut& cut) const {
    RigidId lowest = kNoRigid;
    Box box{from, from};
    include(box, over), include(box, to);
    visit_meshes(body, box, [&](const Body& other) {
        if (other.id < lowest && find_cut(*other.mesh, from, over, to, cut)) lowest = other.id;
    });
    return lowest != kNoRigid;
}

// The nearest piece that no sheet hides from the centre, else the nearest one. A body of many pieces need not have its
// centre within it; one that is reached around may then stand between the centre and all of them.
uint32_t BulletWorld::find_middle_piece(const Body& body, Vec3 centre) const {
    uint32_t nearest = 0, number = 0;
    float least = kFar;
    bool is_seen = false;
    for (const Vec3 point : ways_.points()) {
        Cut cut;
        const float far = length(point - centre);
        const bool sees = !find_cut_of(body, centre, centre, point, cut);
        if (sees > is_seen || (sees == is_seen && far < least)) nearest = number, least = far, is_seen = sees;
        ++number;
    }
    return nearest;
}

// Quickly: what lies free has no triangle between its centre and a piece.
bool BulletWorld::may_be_cut(const Body& body, Vec3 centre) const {
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        Cut cut;
        if (find_cut_of(body, centre, centre, inner_point(*hull, body.fresh_at), cut)) return true;
    }
    return false;
}

void BulletWorld::settle_laid(Body& body) {
    if (mesh_count_ == 0 || body.kind != RigidKind::Dynamic || body.is_soft) return;
    const Vec3 centre = from_bullet(body.bullet->getCenterOfMassPosition());
    if (!may_be_cut(body, centre)) return;
    ways_.list(body);
    const uint32_t middle = find_middle_piece(body, centre);
    // A move out of one sheet may take it through another: the way begins where it was put down.
    const Vec3 start = body.hull_count == 1 ? centre : ways_.points()[middle];
    for (int move = 0; move < kMoves; ++move) {
        PutThrough deepest;
        ways_.visit_cut_off(
            start, middle,
            [&](Vec3 from, Vec3 over, Vec3 to, Cut& cut) { return find_cut_of(body, from, over, to, cut); },
            [&](Vec3 point, const Cut& cut) {
                const float depth = clearance_at(point) - dot(point - cut.place, cut.normal);
                if (depth > deepest.depth) deepest = {depth, cut.normal, point};
            });
        if (!(deepest.depth > 0)) return;
        ways_.shift(deepest.depth * deepest.normal);
        lift_new(body, deepest);
    }
}

}  // namespace cullet::bullet
