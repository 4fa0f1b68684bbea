// Case 8: at what strain, and where, a strip tears that is drawn apart slowly beside sound, by the loop that a world
// runs its soft bodies with: springs' step, flow, tears, splits.
#include <algorithm>
#include <cmath>

#include "components/state.hpp"
#include "sample_game/spring_truth.hpp"
#include "sample_game/truth_cases.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {
namespace {

constexpr double kLimit = 0.004;                            // strain at which springs tear
constexpr StripSize kStrip{10, 8, 0.01, 0.002};             // m
constexpr uint32_t kSpareVertices = 256, kMostParts = 256;  // more than ever come
constexpr double kHalf = kStrip.half_edges * kStrip.edge;   // m, of the length
constexpr double kYoungModulus = 1e7, kDensity = 1000;      // Pa, kg/m3: of BenchMaterial
constexpr double kNotch = 0.5 * kStrip.edge;                // m off the middle
constexpr double kSlowness = 20;                            // times that a wave crosses until the limit is reached

bool is_end(Vec3d p) {
    return std::fabs(p.x) > kHalf - 0.6 * kStrip.edge;
}

/// A notch is a triangle less at each of the long borders, beside the middle.
BenchMesh strip_mesh(bool has_notch) {
    BenchMesh mesh = bench_strip(kStrip.half_edges, kStrip.rows, kStrip.edge);
    const auto is_cut_out = [&](const std::array<uint32_t, 3>& t) {
        const Vec3d middle = (1.0 / 3) * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
        const double to_border = std::min(middle.y, kStrip.width() - middle.y);
        return std::fabs(middle.x - kNotch) < 0.1 * kStrip.edge && to_border < 0.5 * kStrip.row_height();
    };
    if (has_notch) std::erase_if(mesh.triangles, is_cut_out);
    return mesh;
}

SpringSettings strip_settings() {
    SpringSettings settings;
    settings.damping_ratio = 0.3f;
    settings.spare = 1;
    return settings;
}

/// A strip that is a soft body's shell: its ends are led, its springs tear at the limit and never flow.
class SoftStrip {
 public:
    explicit SoftStrip(bool has_notch)
        : bench_(strip_mesh(has_notch), kStrip.thickness, {kYoungModulus, 1.0 / 3, kDensity}, strip_settings(), is_end,
                 kSpareVertices),
          loop_(make_soft_loop(SpringLayout::OneLayer)) {
        State& s = bench_.state();
        const Row<Bodies> body(s.bodies.append(1));
        s.bodies.structure[body] = bench_.shell();
        soft_ = Row<SoftBodies>(s.soft_bodies.append(1));
        s.soft_strikers.append(kMostStrikers);
        s.soft_bodies.is_used[soft_] = s.soft_bodies.is_awake[soft_] = s.soft_bodies.is_elastic[soft_] = 1;
        s.soft_bodies.body[soft_] = body;
        s.soft_bodies.break_strain[soft_] = static_cast<float>(kLimit);
        start();
    }

    /// Nominal strain that a substep adds.
    double rate() const { return kLimit / kSlowness * std::sqrt(kYoungModulus / kDensity) / (2 * kHalf) * step_; }

    /// The ends go to where this strain has them, and a substep is run.
    void lead(double strain) {
        const SpringView view = bench_.view();
        for (const uint32_t v : ends_) view.place(v, drawn(rest(v), strain));
        SoftWorld world{bench_.state()};
        loop_.run_alone(world, {soft_, view.own().steps[view.row], 1, nullptr});
    }

    uint32_t tears() { return bench_.state().soft_bodies.tear_count[soft_]; }
    bool lacks_room() { return bench_.state().soft_bodies.lacks_room[soft_]; }
    uint32_t parts() {
        std::vector<FragmentPart> found(kMostParts);
        return group_fragments(ShellView(bench_.state(), bench_.shell()), found);
    }
    /// How far off the notch the vertices lie that a crack passes, the farthest, m.
    double farthest_crack() {
        double farthest = 0;
        for (uint32_t v = 0; v < bench_.size(); ++v)
            if (bench_.state().vertices.crack[bench_.view().shell.vertex(v)] != static_cast<uint8_t>(CrackState::None))
                farthest = std::max(farthest, std::fabs(rest(v).x - kNotch));
        return farthest;
    }

 private:
    Vec3d rest(uint32_t v) { return Vec3d(bench_.state().vertices.rest[bench_.view().shell.vertex(v)]); }

    // Places, not speeds, lead the ends: a step's way rounds to a hundredth of itself. Sideways they contract as the
    // middle does. What is between them has its share of their speed from the start, so that no wave runs through it.
    static Vec3 drawn(Vec3d p, double strain) {
        const double axis = kStrip.width() / 2;
        return Vec3d((1 + strain) * p.x, p.y - strain / 3 * (p.y - axis), 0).to_float();
    }
    void start() {
        step_ = bench_.time_step();
        for (uint32_t v = 0; v < bench_.size(); ++v) {
            const Vec3d p = rest(v);
            if (is_end(p)) ends_.push_back(v);
            if (!is_end(p))
                bench_.set_velocity(v, ((rate() / step_) * Vec3d(p.x, (kStrip.width() / 2 - p.y) / 3, 0)).to_float());
        }
    }

    SpringBench bench_;
    SoftInnerLoop loop_;
    Row<SoftBodies> soft_;
    std::vector<uint32_t> ends_;
    double step_ = 0;
};

struct Tear {
    double first = 0;        // nominal strain when the first spring tore, over the limit
    double look = 0;         // nominal strain between two looks at the springs, over the limit
    double first_reach = 0;  // how far off the middle the first cracks lie, edges
    double parted = 0;       // nominal strain when the strip was in pieces, over the limit; 0: it never was
    double reach = 0;        // how far off the middle all cracks lie then, edges
    uint32_t parts = 0;
    bool lacks_room = false;
};

Tear pull_apart(bool has_notch) {
    SoftStrip strip(has_notch);
    Tear tear;
    tear.look = kSubstepsAFlow * strip.rate() / kLimit;
    for (double strain = strip.rate(); strain < 2 * kLimit; strain += strip.rate()) {
        const uint32_t before = strip.tears();
        strip.lead(strain);
        if (strip.tears() == before) continue;
        if (before == 0) tear.first = strain / kLimit, tear.first_reach = strip.farthest_crack() / kStrip.edge;
        if (strip.parts() == 1) continue;
        tear.parted = strain / kLimit, tear.reach = strip.farthest_crack() / kStrip.edge, tear.parts = strip.parts();
        break;
    }
    tear.lacks_room = strip.lacks_room();
    return tear;
}

}  // namespace

std::vector<Verdict> tearing_strip() {
    const Tear whole = pull_apart(false), notched = pull_apart(true);
    return {{"strain at the first tear over the limit, within one look", whole.first, 1 - whole.look, 1 + whole.look},
            {"strain when it is in two over the limit", whole.parted, 1 - whole.look, 1.05},
            {"notched: strain at the first tear over the limit", notched.first, 0.1, 0.95},
            {"notched: the first cracks off the notch, edges", notched.first_reach, 0, 1.6},
            {"notched: strain when it is in two over that of the first tear", notched.parted / notched.first, 1, 1.05},
            {"notched: all cracks off the notch, edges", notched.reach, 0, 1.6},
            {"refused for want of room", whole.lacks_room + notched.lacks_room + 0.0, 0, 0}};
}

}  // namespace cullet
