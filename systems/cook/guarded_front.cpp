#include "systems/cook/guarded_front.hpp"

#include "systems/cook/element_shape.hpp"

namespace cullet {
namespace {

// Not from 0: an element with a corner at 0 is excused from the volume rule, its neighbours run ahead, and the corner
// never follows.
constexpr double kStart = 1.0 / 64;
constexpr double kLeastStep = 1.0 / 64;  // of cap / rounds; below, a vertex has stopped
constexpr int kStartFalls = 9;           // eight halvings, then 0
constexpr int kRoundFalls = 4;           // three halvings of the advance, then none

class GuardedFront {
 public:
    explicit GuardedFront(ExtrusionWork& work)
        : work_(work),
          faces_(work.surface),
          pairs_(list_pairs(work, faces_)),
          count_(work.vertex_count()),
          depth_(count_),
          trial_(count_),
          step_(count_),
          place_(work.points),
          id_(work.surface.position_ids),
          falls_(count_),
          is_bad_vertex_(count_),
          is_listed_element_(work.triangle_count()),
          is_listed_pair_(pairs_.size()) {
        work.statistics.pairs = static_cast<uint32_t>(pairs_.size());
        place_.insert(place_.end(), work.points.begin(), work.points.end());
        id_.insert(id_.end(), work.surface.position_ids.begin(), work.surface.position_ids.end());
        index_pairs();
    }

    std::vector<double> run() {
        const double rounds = work_.settings.rounds;
        std::vector<uint32_t> active;
        for (uint32_t v = 0; v < count_; ++v) {
            if (!(work_.caps[v] > 0)) continue;
            trial_[v] = kStart * work_.caps[v];
            step_[v] = work_.caps[v] / rounds;
            active.push_back(v);
        }
        settle(active, kStartFalls);
        for (const uint32_t v : active) step_[v] = work_.caps[v] / rounds;  // falls at the start do not count
        work_.statistics.rounds = 0;
        for (uint32_t round = 0; round < work_.settings.rounds + work_.settings.extra_rounds; ++round) {
            std::erase_if(active, [&](uint32_t v) {
                return depth_[v] >= work_.caps[v] || step_[v] < kLeastStep * work_.caps[v] / rounds;
            });
            if (active.empty()) break;
            for (const uint32_t v : active) trial_[v] = std::min(depth_[v] + step_[v], work_.caps[v]);
            settle(active, kRoundFalls);
            ++work_.statistics.rounds;
        }
        return depth_;
    }

 private:
    void index_pairs() {
        std::vector<uint32_t>& start = pairs_of_.start;
        start.assign(count_ + 1, 0);
        const auto for_each_moving = [&](auto visit) {
            for (uint32_t p = 0; p < pairs_.size(); ++p)
                for (const uint32_t face : {pairs_[p].a, pairs_[p].b})
                    for (const uint32_t corner : faces_.corners[face])
                        if (corner >= count_) visit(corner - count_, p);
        };
        for_each_moving([&](uint32_t v, uint32_t) { ++start[v + 1]; });
        for (uint32_t v = 0; v < count_; ++v) start[v + 1] += start[v];
        pairs_of_.row.resize(start[count_]);
        std::vector<uint32_t> next(start.begin(), start.end() - 1);
        for_each_moving([&](uint32_t v, uint32_t p) { pairs_of_.row[next[v]++] = p; });
    }

    // An inner point at depth 0 is the outer point.
    void place(uint32_t v) {
        place_[count_ + v] = trial_[v] > 0 ? work_.inner(v, trial_[v]) : work_.points[v];
        id_[count_ + v] = trial_[v] > 0 ? work_.surface.position_count + v : work_.surface.position_ids[v];
    }

    // Sets back the vertices of bad elements and pairs until nothing is bad, then accepts. Each vertex falls at most
    // `most_falls` times in a call, the last time to where it was, and where all were is valid; so this ends.
    void settle(const std::vector<uint32_t>& moved, int most_falls) {
        for (const uint32_t v : moved) {
            falls_[v] = 0;
            place(v);
        }
        std::vector<uint32_t> changed = moved;
        while (!changed.empty()) {
            find_bad(changed);
            changed.clear();
            for (const uint32_t v : bad_vertices_) {
                is_bad_vertex_[v] = 0;
                if (falls_[v] == 0) step_[v] /= 2;
                ++work_.statistics.collisions;
                trial_[v] = ++falls_[v] < most_falls ? depth_[v] + (trial_[v] - depth_[v]) / 2 : depth_[v];
                place(v);
                changed.push_back(v);
            }
            bad_vertices_.clear();
        }
        for (const uint32_t v : moved) depth_[v] = trial_[v];
    }

    void mark_bad(uint32_t v) {
        if (is_bad_vertex_[v] || !(trial_[v] > depth_[v])) return;
        is_bad_vertex_[v] = 1;
        bad_vertices_.push_back(v);
    }

    void find_bad(const std::vector<uint32_t>& changed) {
        elements_.clear(), listed_pairs_.clear();
        for (const uint32_t v : changed) {
            for (const uint32_t t : work_.ring[v])
                if (!is_listed_element_[t]) is_listed_element_[t] = 1, elements_.push_back(t);
            for (const uint32_t p : pairs_of_[v])
                if (!is_listed_pair_[p]) is_listed_pair_[p] = 1, listed_pairs_.push_back(p);
        }
        for (const uint32_t t : elements_) {
            is_listed_element_[t] = 0;
            const Triangle& c = work_.surface.triangles[t];
            if (!is_sound(work_, t, {place_[count_ + c[0]], place_[count_ + c[1]], place_[count_ + c[2]]},
                          {trial_[c[0]], trial_[c[1]], trial_[c[2]]}))
                for (const uint32_t v : c) mark_bad(v);
        }
        for (const uint32_t p : listed_pairs_) {
            is_listed_pair_[p] = 0;
            FacePair& pair = pairs_[p];
            if (!are_touching(corners(pair.a), corners(pair.b), pair.hint)) continue;
            for (const uint32_t face : {pair.a, pair.b})
                for (const uint32_t corner : faces_.corners[face])
                    if (corner >= count_) mark_bad(corner - count_);
        }
    }

    Corner3 corners(uint32_t face) const {
        const Triangle& c = faces_.corners[face];
        return {{place_[c[0]], place_[c[1]], place_[c[2]]}, {id_[c[0]], id_[c[1]], id_[c[2]]}};
    }

    ExtrusionWork& work_;
    ShellFaces faces_;
    std::vector<FacePair> pairs_;
    uint32_t count_;
    std::vector<double> depth_, trial_, step_;
    std::vector<Vec3d> place_;  // outer, then inner points
    std::vector<uint32_t> id_;  // of those places
    std::vector<int> falls_;
    std::vector<uint8_t> is_bad_vertex_, is_listed_element_, is_listed_pair_;
    std::vector<uint32_t> bad_vertices_, elements_, listed_pairs_;
    VertexRows pairs_of_;
};

}  // namespace

std::vector<double> run_guarded_front(ExtrusionWork& work) {
    return GuardedFront(work).run();
}

}  // namespace cullet
