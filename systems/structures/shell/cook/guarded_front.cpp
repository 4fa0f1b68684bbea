#include "systems/structures/shell/cook/guarded_front.hpp"

#include "systems/structures/shell/cook/element_shape.hpp"

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
          faces_(work),
          count_(work.vertex_count()),
          depth_(count_),
          trial_(count_),
          step_(count_),
          falls_(count_),
          is_bad_vertex_(count_),
          is_listed_element_(work.triangle_count()),
          is_listed_pair_(faces_.pair_count()) {}

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
        work_.keep(depth_);
        for (const uint32_t v : active) step_[v] = work_.caps[v] / rounds;  // falls at the start do not count
        work_.statistics.rounds = 0;
        for (uint32_t round = 0; round < work_.settings.rounds + work_.settings.extra_rounds; ++round) {
            std::erase_if(active, [&](uint32_t v) {
                return depth_[v] >= work_.caps[v] || step_[v] < kLeastStep * work_.caps[v] / rounds;
            });
            if (active.empty()) break;
            for (const uint32_t v : active) trial_[v] = std::min(depth_[v] + step_[v], work_.caps[v]);
            settle(active, kRoundFalls);
            work_.keep(depth_);
            ++work_.statistics.rounds;
        }
        return depth_;
    }

 private:
    // Sets back the vertices of bad elements and pairs until nothing is bad, then accepts. Each vertex falls at most
    // `most_falls` times in a call, the last time to where it was, and where all were is valid; so this ends.
    void settle(const std::vector<uint32_t>& moved, int most_falls) {
        for (const uint32_t v : moved) {
            falls_[v] = 0;
            faces_.place(v, trial_[v]);
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
                faces_.place(v, trial_[v]);
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
            for (const uint32_t p : faces_.pairs_of(v))
                if (!is_listed_pair_[p]) is_listed_pair_[p] = 1, listed_pairs_.push_back(p);
        }
        for (const uint32_t t : elements_) {
            is_listed_element_[t] = 0;
            const Triangle& c = work_.surface.triangles[t];
            if (!is_sound(work_, t, {faces_.inner(c[0]), faces_.inner(c[1]), faces_.inner(c[2])},
                          {trial_[c[0]], trial_[c[1]], trial_[c[2]]}))
                for (const uint32_t v : c) mark_bad(v);
        }
        for (const uint32_t p : listed_pairs_) {
            is_listed_pair_[p] = 0;
            if (faces_.is_touching(p)) faces_.for_each_inner(p, [this](uint32_t v) { mark_bad(v); });
        }
    }

    ExtrusionWork& work_;
    MovingFaces faces_;
    uint32_t count_;
    std::vector<double> depth_, trial_, step_;
    std::vector<int> falls_;
    std::vector<uint8_t> is_bad_vertex_, is_listed_element_, is_listed_pair_;
    std::vector<uint32_t> bad_vertices_, elements_, listed_pairs_;
};

}  // namespace

std::vector<double> run_guarded_front(ExtrusionWork& work) {
    return GuardedFront(work).run();
}

}  // namespace cullet
