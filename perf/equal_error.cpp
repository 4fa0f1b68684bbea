// Yardstick (e): substeps and iterations do not converge alike, so the ratio of their times says little by itself. Here
// both hold up a strip of 107 x 9 nodes and 1 m that should not stretch. Bullet's soft body does so by iterations over
// its links, a frame of 1/60 s at once. Our springs do so by substeps that share the frame, as stiff as a step of that
// length bears. How far it stretches is the error. At equal time ours is to be no larger.
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <memory>

#include "engine/fp_mode.hpp"
#include "perf/our_springs.hpp"
#include "perf/perf.hpp"
#include "perf/soft_world.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"

namespace cullet::perf {
namespace {

constexpr int kLong = 107, kWide = 9, kFrames = 240, kFirst = 120;  // the mean of the last two seconds
constexpr float kGravity = 9.81f, kFrameSeconds = 1.0f / 60;

/// Its first row is held: nodes 0, kLong, 2 kLong... stand at x = 0.
std::unique_ptr<btSoftBody> make_strip(btSoftBodyWorldInfo& info) {
    const btScalar wide = btScalar(kWide - 1) / (kLong - 1);
    std::unique_ptr<btSoftBody> body(
        btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {1, 0, 0}, {0, 0, wide}, {1, 0, wide}, kLong, kWide, 0, true));
    body->setTotalMass(1);
    for (int row = 0; row < kWide; ++row) body->setMass(row * kLong, 0);
    return body;
}

/// Of the strip's length 1 m, at `x(node)`.
template <class X>
double stretch_now(X x) {
    double sum = 0;
    for (int row = 0; row < kWide; ++row) sum += x(row * kLong + kLong - 1);
    return sum / kWide - 1;
}

double stretch_of_bullet(int iterations) {
    SoftWorld made;
    btSoftRigidDynamicsWorld& world = made.world;
    world.getWorldInfo().m_gravity = {kGravity, 0, 0};
    world.setGravity({kGravity, 0, 0});
    const auto body = make_strip(world.getWorldInfo());
    btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());
    body->m_cfg.piterations = iterations;
    world.addSoftBody(body.get());
    double sum = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        world.stepSimulation(kFrameSeconds, 0);
        if (frame >= kFirst) sum += stretch_now([&](int node) { return double{body->m_nodes[node].m_x.x()}; });
    }
    world.removeSoftBody(body.get());
    return sum / (kFrames - kFirst);
}

/// A frame in so many substeps of integrate_springs, run by the inner loop as the frame of the game runs it.
double stretch_of_springs(const SpringNet& strip, int steps) {
    SpringNet net = strip;
    net.dt = kFrameSeconds / static_cast<float>(steps);
    net.stiffness = 0.25f * net.mass / (net.dt * net.dt);  // dt = 0.5 sqrt(m / k), of at most 0.7
    net.damping = 0.1f * net.stiffness * net.dt;
    SpringBench bench = bench_of(net, [](uint32_t v) { return v % kLong == 0; });
    float* along = bench.state().vertices.velocity.lane(0) +
                   bench.state().shells.vertices[bench.state().shell_of(bench.shell())].first;
    double sum = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        for (int step = 0; step < steps; ++step) {
            for (uint32_t v = 0; v < bench.size(); ++v)
                if (v % kLong != 0) along[v] += kGravity * net.dt;
            run_springs(bench.state(), bench.springs(), 1);
        }
        if (frame >= kFirst) sum += stretch_now([&](int node) { return bench.middle(static_cast<uint32_t>(node)).x; });
    }
    return sum / (kFrames - kFirst);
}

/// The least number of steps a frame whose stretch is no more than that.
int steps_for(const SpringNet& strip, double stretch) {
    int enough = 1;
    while (enough < 4096 && !(stretch_of_springs(strip, enough) <= stretch)) enough *= 2;
    for (int least = enough / 2; enough - least > 1;) {
        const int middle = (least + enough) / 2;
        (stretch_of_springs(strip, middle) <= stretch ? enough : least) = middle;
    }
    return enough;
}

}  // namespace

void measure_equal_error(double substep, double link_iteration, Figures& figures) {
    btSoftBodyWorldInfo info;
    info.m_sparsesdf.Initialize();
    const SpringNet strip = net_of(*make_strip(info));
    const FpMode mode;
    for (const int iterations : {20, 80}) {
        const double stretch = stretch_of_bullet(iterations);
        const int steps = steps_for(strip, stretch);
        const std::string name = "equal error, " + std::to_string(iterations) + " iterations of Bullet: ";
        figures.add(name + "stretch of a strip that hangs", 100 * stretch, "%");
        figures.add(name + "substeps that stretch it no more", steps, "");
        figures.add_ratio(name + "substeps / Bullet, a frame", 1e9 * substep * steps, 1e9 * link_iteration * iterations,
                          "ns a spring");
        // As many as Bullet's links have time for; its own world step beside them is not counted.
        const int in_time = std::max(1, static_cast<int>(link_iteration * iterations / substep));
        const std::string equal = "equal time, " + std::to_string(iterations) + " iterations of Bullet: ";
        figures.add(equal + "substeps", in_time, "");
        figures.add_ratio(equal + "our error / Bullet's", 100 * stretch_of_springs(strip, in_time), 100 * stretch,
                          "% stretched", 1);
    }
}

}  // namespace cullet::perf
