// The tree of boxes beside a plain list of them.
#include "engine/bullet/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/random.hpp"
#include "sample_game/allocations.hpp"

namespace cullet::bullet {
namespace {

/// The same leaves in both; items are places in the list.
class TwoLists {
 public:
    explicit TwoLists(uint32_t limit, uint64_t seed) : tree_(limit), random_{seed} {}

    float next(float low, float high) { return low + (high - low) * static_cast<float>(random_.uniform(thrown_++)); }
    uint32_t below(uint32_t end) { return std::min(static_cast<uint32_t>(next(0, static_cast<float>(end))), end - 1); }
    Box any_box() {
        const Vec3 at{next(-5, 5), next(-1, 1), next(-5, 5)};
        const float size = next(0, 1);
        return {at, at + size * Vec3{next(0, 1), next(0, 1), next(0, 1)}};
    }
    void add(const Box& box) {
        const auto free = std::find_if(rows_.begin(), rows_.end(), [](const Row& row) { return !row.is_used; });
        const auto item = static_cast<uint32_t>(free - rows_.begin());
        if (free == rows_.end()) rows_.emplace_back();
        rows_[item] = {true, box, tree_.add(box, item)};
    }
    void remove(uint32_t item) {
        if (!rows_[item].is_used) return;
        tree_.remove(rows_[item].leaf);
        rows_[item].is_used = false;
    }
    void move(uint32_t item, Vec3 by) {
        if (!rows_[item].is_used) return;
        const Box box{rows_[item].box.low + by, rows_[item].box.high + by};
        tree_.remove(rows_[item].leaf);
        rows_[item] = {true, box, tree_.add(box, item)};
    }
    void shift(Vec3 by) {
        tree_.shift(by);
        for (Row& row : rows_) row.box = {row.box.low + by, row.box.high + by};
    }
    void expect_same(const Box& box) {
        std::vector<uint32_t> found, wanted;
        tree_.visit(box, [&](uint32_t item) { found.push_back(item); });
        for (uint32_t item = 0; item < rows_.size(); ++item)
            if (rows_[item].is_used && overlap(rows_[item].box, box, 0)) wanted.push_back(item);
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, wanted);
    }
    void expect_same_about_all() {
        for (const Row& row : rows_) {
            if (!row.is_used) continue;
            EXPECT_TRUE(holds(tree_.box(row.leaf), row.box) && holds(row.box, tree_.box(row.leaf)));
            expect_same(row.box);
        }
    }
    uint32_t size() const { return static_cast<uint32_t>(rows_.size()); }

 private:
    struct Row {
        bool is_used = false;
        Box box;
        uint32_t leaf = 0;
    };
    BoxTree tree_;
    std::vector<Row> rows_;
    Random random_;
    uint64_t thrown_ = 0;
};

TEST(BoxTree, AnEmptyTreeHoldsNothingAndOneLeafIsAllOfIt) {
    TwoLists lists(4, 1);
    const Box unit{{0, 0, 0}, {1, 1, 1}};
    lists.expect_same(unit);
    lists.add(unit);
    lists.expect_same(unit);
    lists.expect_same({{1, 1, 1}, {2, 2, 2}});              // a corner in common counts
    lists.expect_same({{1.01f, 1.01f, 1.01f}, {2, 2, 2}});  // a gap does not
    lists.remove(0);
    lists.expect_same(unit);
}

TEST(BoxTree, FindsWhatAPlainListFindsWhileLeavesComeMoveAndGo) {
    constexpr uint32_t kLimit = 400;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        TwoLists lists(kLimit, seed);
        for (uint32_t round = 0; round < 4000; ++round) {
            const float what = lists.next(0, 1);
            // More come than go at first, fewer later.
            if (what < (round < 2000 ? 0.35f : 0.2f) && lists.size() < kLimit)
                lists.add(lists.any_box());
            else if (what < 0.5f && lists.size() > 0)
                lists.remove(lists.below(lists.size()));
            else if (lists.size() > 0)
                lists.move(lists.below(lists.size()), {lists.next(-1, 1), lists.next(-0.2f, 0.2f), lists.next(-1, 1)});
            if (round % 20 == 0) lists.expect_same(lists.any_box());
            if (round % 1000 == 999) lists.shift({100, -2, 30});
            if (round % 500 == 499) lists.expect_same_about_all();
        }
    }
}

// A tree out of balance would be as high as it has leaves, and a walk has room for 64 open nodes.
TEST(BoxTree, ALongRowAndAHeapOfEqualBoxesStayLow) {
    constexpr uint32_t kCount = 3000;
    TwoLists row(kCount, 1), heap(kCount, 1);
    for (uint32_t k = 0; k < kCount; ++k) {
        const auto x = static_cast<float>(k);
        row.add({{x, 0, 0}, {x + 1.5f, 1, 1}});
        heap.add({{0, 0, 0}, {1, 1, 1}});
    }
    row.expect_same({{17, 0, 0}, {40, 1, 1}});
    heap.expect_same({{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}});
    for (uint32_t k = 0; k < kCount; k += 2) row.remove(k), heap.remove(k);
    row.expect_same({{17, 0, 0}, {40, 1, 1}});
    heap.expect_same({{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}});
}

TEST(BoxTree, AsksForNoMemoryUpToItsLimit) {
    constexpr uint32_t kLimit = 256;
    TwoLists boxes(1, 3);
    BoxTree tree(kLimit);
    std::vector<uint32_t> leaves(kLimit);
    start_counting_allocations();
    for (uint32_t round = 0; round < 3; ++round) {
        for (uint32_t& leaf : leaves) leaf = tree.add(boxes.any_box(), 0);
        for (const uint32_t leaf : leaves) tree.remove(leaf);
    }
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
}

}  // namespace
}  // namespace cullet::bullet
