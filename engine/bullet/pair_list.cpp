#include "engine/bullet/pair_list.hpp"

#include <algorithm>

namespace cullet::bullet {

void PairList::sort_found() {
    std::sort(found_.begin(), found_.end(), [](const Pair& p, const Pair& q) { return p.comes_before(q.a, q.b); });
    const auto are_same = [](const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; };
    found_.erase(std::unique(found_.begin(), found_.end(), are_same), found_.end());
}

void PairList::take_in(const Pair& pair, PairWork& work) {
    PairAlgorithm* const algorithm = memory_.take();
    *algorithm = PairAlgorithm(pair.a, pair.b, work);
    merged_.push_back({pair.a, pair.b, algorithm});
}

void PairList::give_back(const Pair& pair) {
    pair.algorithm->forget();
    memory_.give(pair.algorithm);
}

const PairAlgorithm* PairList::memory_of(RigidId a, RigidId b) const {
    const auto at =
        std::partition_point(pairs_.begin(), pairs_.end(), [&](const Pair& pair) { return pair.comes_before(a, b); });
    return at != pairs_.end() && at->a == a && at->b == b ? at->algorithm : nullptr;
}

void PairList::drop(RigidId id) {
    const auto is_gone = [&](const Pair& pair) {
        if (pair.a != id && pair.b != id) return false;
        give_back(pair);
        return true;
    };
    std::erase_if(pairs_, is_gone);
    std::erase_if(found_, [id](const Pair& pair) { return pair.a == id || pair.b == id; });
}

}  // namespace cullet::bullet
