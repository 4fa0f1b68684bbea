// The list of pairs beside a set of them.
#include "engine/bullet/pair_list.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>

#include "engine/random.hpp"
#include "sample_game/allocations.hpp"

namespace cullet::bullet {
namespace {

using Names = std::pair<RigidId, RigidId>;

struct Dice {
    Random random{5};
    uint64_t thrown = 0;
    RigidId below(uint32_t end) {
        const double number = random.uniform(thrown++) * end;
        return std::min(static_cast<uint32_t>(number), end - 1);
    }
};

void expect_same(const PairList& list, const std::set<Names>& wanted) {
    ASSERT_EQ(list.rows().size(), wanted.size());
    auto next = wanted.begin();
    for (const Pair& pair : list.rows()) {  // a set rises, too
        EXPECT_EQ((Names{pair.a, pair.b}), *next++);
        EXPECT_EQ(list.memory_of(pair.a, pair.b), pair.algorithm);
    }
}

TEST(PairList, HoldsWhatASetHoldsWhilePairsAreFoundPartAndLoseTheirBodies) {
    constexpr uint32_t kBodies = 40;
    PairWork work(kBodies);
    PairList list(kBodies);
    Dice dice;
    std::set<Names> wanted;
    std::map<Names, const PairAlgorithm*> memory;
    for (int round = 0; round < 300; ++round) {
        std::set<Names> found, parted;
        for (uint32_t k = dice.below(60); k-- > 0;) {
            const RigidId a = dice.below(kBodies), b = dice.below(kBodies);
            if (a == b) continue;
            list.find(a, b);  // in either order, some again, some known
            found.insert(std::minmax(a, b));
        }
        const uint32_t gone = dice.below(3 * kBodies);  // a body leaves every third round
        if (gone < kBodies) {
            list.drop(gone);
            const auto is_of_it = [&](const Names& pair) { return pair.first == gone || pair.second == gone; };
            std::erase_if(found, is_of_it);
            std::erase_if(wanted, is_of_it);
            expect_same(list, wanted);
        }
        // What parts is no pair, even when it was found once more.
        for (const Names& pair : wanted)
            if (dice.below(4) == 0) parted.insert(pair);
        list.renew(work, [&](RigidId a, RigidId b) { return !parted.contains({a, b}); });
        std::set<Names> stay = wanted;
        for (const Names& pair : parted) stay.erase(pair);
        for (const Names& pair : parted) found.erase(pair);
        wanted = stay;
        wanted.merge(found);
        expect_same(list, wanted);
        // Pairs that stay keep what they remember, and no two have the same.
        std::map<Names, const PairAlgorithm*> now;
        std::set<const PairAlgorithm*> taken;
        for (const Pair& pair : list.rows()) {
            EXPECT_TRUE(taken.insert(pair.algorithm).second);
            now[{pair.a, pair.b}] = pair.algorithm;
        }
        for (const Names& pair : stay) EXPECT_EQ(now.at(pair), memory.at(pair));
        memory = now;
    }
}

TEST(PairList, IsLoadedInItsOwnOrder) {
    PairWork work(4);
    PairList list(4);
    const std::set<Names> pairs{{0, 1}, {0, 3}, {1, 2}};
    for (const auto& [a, b] : pairs) list.append(a, b, work);
    expect_same(list, pairs);
    EXPECT_EQ(list.memory_of(1, 3), nullptr);
    EXPECT_EQ(list.memory_of(2, 3), nullptr);
}

TEST(PairList, AsksForNoMemoryWhilePairsComeAndGo) {
    constexpr uint32_t kBodies = 64;
    PairWork work(kBodies);
    PairList list(kBodies);
    start_counting_allocations();
    for (int round = 0; round < 3; ++round) {
        for (RigidId a = 0; a < kBodies; ++a)
            for (RigidId b = a + 1; b < kBodies; ++b) list.find(a, b);
        list.renew(work, [](RigidId, RigidId) { return true; });
        for (RigidId id = 0; id < kBodies; id += 2) list.drop(id);
        list.renew(work, [](RigidId, RigidId) { return false; });
    }
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
}

}  // namespace
}  // namespace cullet::bullet
