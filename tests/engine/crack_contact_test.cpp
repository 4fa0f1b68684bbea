// Where two pieces meet that were one: places of their crack, as long as these face each other.
#include "engine/bullet/crack_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/bullet/bullet_types.hpp"

namespace cullet::bullet {
namespace {

const btTransform kHere = btTransform::getIdentity();

/// Along x from -0.1 to 0.1 m, the normal up.
std::vector<CrackTouch> row_of_touches() {
    std::vector<CrackTouch> touches;
    for (int k = -10; k <= 10; ++k) touches.push_back({{0.01f * static_cast<float>(k), 0, 0}, {0, 1, 0}, 0.02f});
    return touches;
}

CrackContact contact_of(const std::vector<CrackTouch>& touches, bool is_turned = false) {
    std::vector<const CrackTouch*> near;
    for (const CrackTouch& t : touches) near.push_back(&t);
    return crack_contact(near, kHere, kHere, is_turned);
}

Hull box_at(Vec3 middle, Vec3 half) {
    Vec3 points[8];
    for (int k = 0; k < 8; ++k)
        points[k] = middle + Vec3{k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z};
    Hull hull;
    build_hull(hull, points, 0, 0);
    refresh_world(hull, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {});
    return hull;
}

constexpr float kScale = 1;  // of walls of 5 mm and more

TEST(CrackContact, TakesThePlacesThatLieFarthestApart) {
    const CrackContact contact = contact_of(row_of_touches());
    ASSERT_EQ(contact.count, 4u);
    std::vector<float> along;
    for (uint32_t k = 0; k < contact.count; ++k) {
        along.push_back(contact.on_a[k].x);
        EXPECT_EQ(contact.on_a[k].x, contact.on_b[k].x);
    }
    std::sort(along.begin(), along.end());
    EXPECT_NEAR(along.front(), -0.1f, 1e-6f);
    EXPECT_NEAR(along.back(), 0.1f, 1e-6f);
    for (size_t k = 1; k < along.size(); ++k) EXPECT_GE(along[k] - along[k - 1], 0.049f);
}

TEST(CrackContact, OfNoTouchesHasNone) {
    EXPECT_EQ(contact_of({}).count, 0u);
    EXPECT_EQ(crack_patch(contact_of({}), kHere, kHere, kScale).count, 0);
}

TEST(CrackContact, OfFewPlacesTakesEachOnce) {
    const CrackTouch one{{0.1f, 0.2f, 0.3f}, {0, 0, 1}, 0.01f};
    EXPECT_EQ(contact_of({one, one, one}).count, 1u);
}

TEST(CrackContact, LooksForTouchesNearBothThatHaveADirection) {
    std::vector<CrackTouch> touches = row_of_touches();
    touches[12].normal = {};  // of an edge of no length, at 2 cm
    const Hull a = box_at({0.05f, 0.05f, 0}, {0.05f, 0.05f, 0.05f}),
               b = box_at({0.05f, -0.05f, 0}, {0.05f, 0.05f, 0.05f});
    std::vector<const CrackTouch*> near;
    near.reserve(64);
    find_near(a, b, touches, near);
    EXPECT_EQ(near.size(), 10u) << "of x from 0 to 0.1, but for one";
    std::vector<const CrackTouch*> few;
    few.reserve(4);
    find_near(a, b, touches, few);
    EXPECT_EQ(few.size(), few.capacity());
}

TEST(CrackContact, TellsHowFarItsPlacesAreApartAlongTheNormalAsBothTurn) {
    const CrackContact contact = contact_of(row_of_touches());
    btTransform raised = kHere;
    raised.setOrigin({0.003f, 0.002f, 0});
    const Patch patch = crack_patch(contact, raised, kHere, kScale);
    ASSERT_EQ(patch.count, 4);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(patch.point[k].distance, 0.002f, 1e-6f);
    const btTransform turned(btQuaternion({0, 0, 1}, 1.0f), {1, 2, 3});
    const Patch both = crack_patch(contact, turned * raised, turned, kScale);
    ASSERT_EQ(both.count, 4);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(both.point[k].distance, 0.002f, 1e-6f);
    EXPECT_NEAR(length(both.normal - from_bullet(turned.getBasis() * btVector3(0, 1, 0))), 0, 1e-6f);
}

TEST(CrackContact, LeavesOutWhatHasSlidPastItsEdgeOrParted) {
    const CrackContact contact = contact_of(row_of_touches());
    btTransform slid = kHere, parted = kHere;
    slid.setOrigin({0, -0.001f, 0.021f});
    parted.setOrigin({0, kContactRange + 0.001f, 0});
    EXPECT_EQ(crack_patch(contact, slid, kHere, kScale).count, 0);
    EXPECT_EQ(crack_patch(contact, parted, kHere, kScale).count, 0);
    slid.setOrigin({0, -0.001f, 0.019f});
    EXPECT_EQ(crack_patch(contact, slid, kHere, kScale).count, 4);
}

TEST(CrackContact, LeavesOutFacesThatTurnedIntoEachOtherButNotThoseThatWerePressedIn) {
    const CrackContact contact = contact_of(row_of_touches());
    btTransform pressed = kHere;
    pressed.setOrigin({0, -0.005f, 0});
    EXPECT_EQ(crack_patch(contact, pressed, kHere, kScale).count, 4);
    // About the row itself, so that its places stay where they are.
    const btTransform turned(btQuaternion({1, 0, 0}, 0.6f), {0, -0.005f, 0});
    EXPECT_EQ(crack_patch(contact, turned, kHere, kScale).count, 0);
    const btTransform turned_apart(btQuaternion({1, 0, 0}, 0.6f), {0, 0.001f, 0});
    EXPECT_EQ(crack_patch(contact, turned_apart, kHere, kScale).count, 4);
}

TEST(CrackContact, TurnsTheNormalWithTheOrderOfTheTwo) {
    const Patch patch = crack_patch(contact_of(row_of_touches(), true), kHere, kHere, kScale);
    ASSERT_EQ(patch.count, 4);
    EXPECT_EQ(patch.point[0].normal.y, -1);
}

}  // namespace
}  // namespace cullet::bullet
