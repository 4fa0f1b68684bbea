#include "systems/structures/shell/cook/single_vertex.hpp"

#include "systems/structures/shell/cook/element_shape.hpp"

namespace cullet {
namespace {

constexpr double kLeastStep = 1.0 / 32;  // of cap / rounds; below, a vertex waits for the next round

class SingleVertex {
 public:
    SingleVertex(ExtrusionWork& work, bool tests_elements)
        : work_(work),
          faces_(work),
          tests_elements_(tests_elements),
          depth_(work.vertex_count()),
          axes_(faces_.pair_count()),
          blocker_(work.vertex_count(), kNone) {}

    std::vector<double> run() {
        work_.statistics.rounds = work_.settings.rounds;
        for (uint32_t round = 0; round < work_.settings.rounds; ++round) {
            for (uint32_t v = 0; v < work_.vertex_count(); ++v)
                if (depth_[v] < work_.caps[v]) push(v);
            work_.keep(depth_);
        }
        return std::move(depth_);
    }

 private:
    void push(uint32_t v) {
        const double full = work_.caps[v] / work_.settings.rounds, before = depth_[v];
        for (double step = full; step >= kLeastStep * full; step /= 2) {
            depth_[v] = std::min(before + step, work_.caps[v]);
            faces_.place(v, depth_[v]);
            if (!is_bad(v)) return;
            ++work_.statistics.collisions;
        }
        depth_[v] = before;
        faces_.place(v, before);
    }

    // What stopped the vertex last time stops it most often again; asked first, a failure costs one test.
    bool is_bad(uint32_t v) {
        const uint32_t last = blocker_[v];
        if (last != kNone && is_bad_item(last)) return true;
        if (tests_elements_)
            for (const uint32_t t : work_.ring[v])
                if (t != last && is_bad_item(t)) return blocker_[v] = t, true;
        for (const uint32_t p : faces_.pairs_of(v))
            if (work_.triangle_count() + p != last && faces_.is_touching(p, axes_))
                return blocker_[v] = work_.triangle_count() + p, true;
        return false;
    }

    // Elements first, then pairs.
    bool is_bad_item(uint32_t item) {
        if (item >= work_.triangle_count()) return faces_.is_touching(item - work_.triangle_count(), axes_);
        const Triangle& c = work_.surface.triangles[item];
        return !is_sound(work_, item, {faces_.inner(c[0]), faces_.inner(c[1]), faces_.inner(c[2])},
                         {depth_[c[0]], depth_[c[1]], depth_[c[2]]});
    }

    ExtrusionWork& work_;
    MovingFaces faces_;
    bool tests_elements_;
    std::vector<double> depth_;
    std::vector<Vec3d> axes_;  // of pairs
    std::vector<uint32_t> blocker_;
};

}  // namespace

std::vector<double> run_single_vertex(ExtrusionWork& work, bool tests_elements) {
    return SingleVertex(work, tests_elements).run();
}

}  // namespace cullet
