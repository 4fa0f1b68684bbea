// The rows through which a host's own engine talks with a world.
#include "engine/host_rigid_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/byte_stream.hpp"

namespace cullet {
namespace {

struct Rows {
    std::vector<uint32_t> generations = std::vector<uint32_t>(8, 1);
    HostRigidWorld world{{8, 64, 512}, generations.data()};

    BodyId id(RigidId row) const { return {row, generations[row]}; }
    void add(RigidId row, Motion motion = {}, RigidKind kind = RigidKind::Dynamic) {
        const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const ConvexPiece pieces[] = {{points, 4}, {std::span(points).first(3), 9}};
        RigidDescription d;
        d.kind = kind;
        d.motion = motion;
        d.mass = 2;
        d.centre = {0.25, 0.25, 0.25};
        d.inertia = {1, 2, 3, 0, 0, 0};
        d.pieces = pieces;
        world.add(row, d);
    }
    void detect(std::vector<HostContact> contacts) {
        ASSERT_TRUE(world.take({nullptr, 0, contacts.data(), static_cast<uint32_t>(contacts.size())}).ok());
        world.detect(0.01f);
    }
};

TEST(HostRigidWorld, ABirthCarriesItsPiecesUntilTheNextChange) {
    Rows rows;
    rows.add(3);
    rows.world.finish();
    const HostChanges changes = rows.world.changes();
    ASSERT_EQ(changes.born.count, 1u);
    const HostShape& shape = changes.born[0];
    EXPECT_EQ(shape.body, rows.id(3));
    ASSERT_EQ(shape.piece_count, 2u);
    EXPECT_EQ(shape.pieces[0].name, 4u);
    EXPECT_EQ(shape.pieces[1].name, 9u);
    EXPECT_EQ(shape.pieces[1].point_count, 3u);
    EXPECT_EQ(shape.pieces[1].points[2].y, 1);
    EXPECT_EQ(shape.inertia[2], 3);
    rows.world.finish();
    EXPECT_EQ(rows.world.changes().born.count, 0u);
}

TEST(HostRigidWorld, ContactsAreTurnedSoThatTheLowerRowComesFirstAndCloseByTheBodiesMotions) {
    Rows rows;
    rows.add(1, {{0, -3, 0}, {}});
    rows.add(2, {{0, 1, 0}, {}});
    rows.detect({{rows.id(2), rows.id(1), {0.25f, 0, 0.25f}, {0, -1, 0}, -0.01f, 7, 5}});
    ASSERT_EQ(rows.world.contacts().size(), 1u);
    const RigidContact c = rows.world.contacts()[0];
    EXPECT_EQ(c.a, 1u);
    EXPECT_EQ(c.cell_a, 5u);
    EXPECT_EQ(c.normal.y, 1);
    EXPECT_FLOAT_EQ(c.approach_speed, 4);
}

TEST(HostRigidWorld, ContactsThatDifferInTheirNormalAloneComeInOneOrder) {
    std::vector<Vec3> normals[2];
    for (const bool is_turned : {false, true}) {
        Rows rows;
        rows.add(1);
        rows.add(2);
        std::vector<HostContact> contacts;
        for (const Vec3 normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}})
            contacts.push_back({rows.id(1), rows.id(2), {}, normal, 0});
        if (is_turned) std::reverse(contacts.begin(), contacts.end());
        rows.detect(contacts);
        for (const RigidContact& c : rows.world.contacts()) normals[is_turned].push_back(c.normal);
    }
    ASSERT_EQ(normals[0].size(), 4u);
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(length(normals[0][k] - normals[1][k]), 0) << k;
}

TEST(HostRigidWorld, RowsBeyondTheBoundsAndRowsThatAreNotThereAreRefused) {
    Rows rows;
    rows.add(1);
    rows.add(2);
    constexpr float kFar = 1.1e6f, kFast = 3e38f;
    const auto refusal = [&](HostBody body, HostContact contact) {
        return rows.world.take({&body, 1, &contact, 1}).error();
    };
    const HostBody body{rows.id(1), {}, {}};
    const HostContact contact{rows.id(1), rows.id(2), {}, {0, 1, 0}, 0};
    EXPECT_EQ(refusal(body, contact), "");
    HostBody far = body, fast = body, spinning = body;
    far.pose.position.z = -kFar, fast.motion.velocity.x = kFast, spinning.motion.angular_velocity.y = kFast;
    EXPECT_NE(refusal(far, contact).find("bodies[0], body 1: the position"), std::string::npos);
    EXPECT_NE(refusal(fast, contact).find("bodies[0], body 1: the velocity"), std::string::npos);
    EXPECT_NE(refusal(spinning, contact).find("bodies[0], body 1: the angular velocity"), std::string::npos);
    HostContact far_point = contact, deep = contact;
    far_point.point.x = kFar, deep.distance = -kFar;
    EXPECT_NE(refusal(body, far_point).find("contacts[0]: the point"), std::string::npos);
    EXPECT_NE(refusal(body, deep).find("contacts[0]: the distance"), std::string::npos);
    EXPECT_NE(rows.world.take({nullptr, 1, nullptr, 0}).error().find("1 bodies"), std::string::npos);
    EXPECT_NE(rows.world.take({nullptr, 0, nullptr, 2}).error().find("2 contacts"), std::string::npos);
}

TEST(HostRigidWorld, ASpinClosesWhereItsArmIs) {
    Rows rows;
    rows.add(1, {{}, {0, 0, 2}});
    rows.add(2, {}, RigidKind::Static);
    rows.detect({{rows.id(1), rows.id(2), {-0.75f, 0.25f, 0.25f}, {0, 1, 0}, 0}});
    ASSERT_EQ(rows.world.contacts().size(), 1u);
    EXPECT_FLOAT_EQ(rows.world.contacts()[0].approach_speed, 2);  // w x r = 2 * -1 downwards
}

TEST(HostRigidWorld, ContactsOfWhatRestsIsHeldOrGoneAreLeftOut) {
    Rows rows;
    rows.add(1);
    rows.add(2);
    rows.world.hold(1);
    rows.world.hold(2);
    const HostContact contact{rows.id(1), rows.id(2), {}, {0, 1, 0}, 0};
    rows.detect({contact});
    EXPECT_TRUE(rows.world.contacts().empty());
    rows.world.release(2);
    rows.detect({contact});
    EXPECT_EQ(rows.world.contacts().size(), 1u);
    ++rows.generations[2];
    rows.detect({contact});
    EXPECT_TRUE(rows.world.contacts().empty());
}

TEST(HostRigidWorld, SiblingsArePassedOverWhileTheyOverlapAndForAQuarterOfASecondAtMost) {
    Rows rows;
    rows.add(1);
    rows.add(2);
    rows.world.part_siblings(2, 1, {});
    const HostContact deep{rows.id(1), rows.id(2), {}, {0, 1, 0}, -0.01f};
    int ignored = 0;
    while (ignored < 100 && (rows.detect({deep}), rows.world.contacts().empty())) ++ignored;
    EXPECT_NEAR(ignored, 25, 1);  // steps of 10 ms
    rows.world.part_siblings(1, 2, {});
    rows.detect({deep});
    EXPECT_TRUE(rows.world.contacts().empty());
    rows.detect({});  // apart
    rows.detect({deep});
    EXPECT_EQ(rows.world.contacts().size(), 1u);
}

TEST(HostRigidWorld, HoldAndReleaseInOneStepAreNoNewsAndAHeldBodyKeepsItsMotion) {
    Rows rows;
    rows.add(1, {{5, 0, 0}, {}});
    rows.world.finish();
    rows.world.hold(1);
    rows.world.release(1);
    rows.world.finish();
    EXPECT_EQ(rows.world.changes().held.count + rows.world.changes().released.count, 0u);
    rows.world.hold(1);
    rows.world.finish();
    ASSERT_EQ(rows.world.changes().held.count, 1u);
    const HostBody stopped{rows.id(1), {}, {}};
    ASSERT_TRUE(rows.world.take({&stopped, 1}).ok());
    rows.world.release(1);
    rows.world.finish();
    ASSERT_EQ(rows.world.changes().released.count, 1u);
    EXPECT_EQ(rows.world.changes().released[0].motion.velocity.x, 5);
}

TEST(HostRigidWorld, PiecesThatComeOffMoveTheCentreAndTheMotionWithIt) {
    Rows rows;
    rows.add(1, {{}, {0, 0, 2}});
    rows.world.finish();
    const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const ConvexPiece piece{points, 1};
    rows.world.set_shape(1, 1.5, {0.75, 0.25, 0.25}, {1, 1, 1}, {&piece, 1});
    rows.world.finish();
    ASSERT_EQ(rows.world.changes().reshaped.count, 1u);
    const HostShape& shape = rows.world.changes().reshaped[0];
    EXPECT_EQ(shape.mass, 1.5);
    EXPECT_EQ(shape.piece_count, 1u);
    EXPECT_FLOAT_EQ(shape.motion.velocity.y, 1);  // 2 rad/s at half a metre
}

TEST(HostRigidWorld, DebrisFindsTheTrianglesBelowIt) {
    Rows rows;
    const Vec3 corners[] = {{-1, 2, -1}, {1, 2, -1}, {0, 2, 1}, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 2}, {3, 4, 5}};
    rows.world.add_static_triangles(4, corners, triangles, 0.5f, 0, 1, ~0u, false);
    EXPECT_EQ(rows.world.height_below({0, 5, 0}, -9), 2);
    EXPECT_EQ(rows.world.height_below({0, 1, 0}, -9), 0);
    EXPECT_EQ(rows.world.height_below({3, 1, 0}, -9), -9);
    rows.world.shift({0, 1, 0});
    EXPECT_EQ(rows.world.height_below({0, 5, 0}, -9), 3);
    rows.world.remove(4);
    EXPECT_EQ(rows.world.height_below({0, 5, 0}, -9), -9);
}

}  // namespace
}  // namespace cullet
