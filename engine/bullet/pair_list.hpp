// Which bodies may touch: pairs whose wide boxes meet, in rising (a, b), each with what it remembers.
#pragma once
#include <vector>

#include "engine/bullet/pair_algorithm.hpp"

namespace cullet::bullet {

struct Pair {
    RigidId a, b;  // a < b
    PairAlgorithm* algorithm;
    bool comes_before(RigidId other_a, RigidId other_b) const { return a != other_a ? a < other_a : b < other_b; }
};

class PairList {
 public:
    explicit PairList(uint32_t body_limit) : memory_(16 * static_cast<size_t>(body_limit) + 4096) {
        pairs_.reserve(64 * static_cast<size_t>(body_limit) + 4096);
        merged_.reserve(pairs_.capacity());
        found_.reserve(pairs_.capacity());
    }
    const std::vector<Pair>& rows() const { return pairs_; }
    /// What is remembered of two bodies, a < b; null when they are no pair.
    const PairAlgorithm* memory_of(RigidId a, RigidId b) const;
    /// In any order, repeats and all; they are pairs from the next renew() on.
    void find(RigidId a, RigidId b) { found_.push_back({std::min(a, b), std::max(a, b), nullptr}); }
    /// Drops the pairs of which `is_near(a, b)` is false and takes in what was found.
    template <class IsNear>
    void renew(PairWork& work, IsNear is_near) {
        sort_found();
        merged_.clear();
        size_t next = 0;
        for (const Pair& pair : pairs_) {
            for (; next < found_.size() && found_[next].comes_before(pair.a, pair.b); ++next)
                take_in(found_[next], work);
            if (next < found_.size() && !pair.comes_before(found_[next].a, found_[next].b)) ++next;  // known
            if (is_near(pair.a, pair.b))
                merged_.push_back(pair);
            else
                give_back(pair);
        }
        for (; next < found_.size(); ++next) take_in(found_[next], work);
        found_.clear();
        pairs_.swap(merged_);
    }
    /// After all others: for loading.
    PairAlgorithm& append(RigidId a, RigidId b, PairWork& work) {
        take_in({a, b, nullptr}, work);
        pairs_.push_back(merged_.back());
        merged_.clear();
        return *pairs_.back().algorithm;
    }
    /// All pairs of a body that leaves.
    void drop(RigidId id);

 private:
    void sort_found();
    void take_in(const Pair& pair, PairWork& work);
    void give_back(const Pair& pair);

    std::vector<Pair> pairs_, merged_, found_;
    Pool<PairAlgorithm> memory_;
};

}  // namespace cullet::bullet
