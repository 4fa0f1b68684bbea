// Yardstick (e): substeps and iterations do not converge alike, so the ratio of their times says little by itself. Here
// both hold up a strip of 107 x 9 nodes and 1 m that should not stretch: Bullet's soft body by iterations over its
// links, a frame of 1/60 s at once; springs by steps that share the frame, as stiff as a step of that length bears.
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <memory>

#include "engine/fp_mode.hpp"
#include "perf/perf.hpp"
#include "perf/soft_world.hpp"
#include "perf/springs.hpp"

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

double stretch_of_springs(const SpringNet& strip, int steps) {
    SpringNet net = strip;
    net.dt = kFrameSeconds / static_cast<float>(steps);
    net.stiffness = 0.25f * net.mass / (net.dt * net.dt);  // dt = 0.5 sqrt(m / k), of at most 0.7
    net.damping = 0.1f * net.stiffness * net.dt;
    PlainSprings springs(net, net.points);
    double sum = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        for (int step = 0; step < steps; ++step) {
            springs.step();
            springs.accelerate({kGravity * net.dt, 0, 0});
            for (int row = 0; row < kWide; ++row)
                springs.put(static_cast<uint32_t>(row * kLong), net.points[static_cast<uint32_t>(row * kLong)]);
        }
        if (frame >= kFirst)
            sum += stretch_now([&](int node) { return double{springs.position(static_cast<uint32_t>(node)).x}; });
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

void measure_equal_error(double spring_step, double link_iteration, Figures& figures) {
    btSoftBodyWorldInfo info;
    info.m_sparsesdf.Initialize();
    const SpringNet strip = net_of(*make_strip(info));
    for (const int iterations : {20, 80}) {
        const double stretch = stretch_of_bullet(iterations);
        const FpMode mode;
        const int steps = steps_for(strip, stretch);
        const std::string name = "equal error, " + std::to_string(iterations) + " iterations of Bullet: ";
        figures.add(name + "stretch of a strip that hangs", 100 * stretch, "%");
        figures.add(name + "steps of springs that stretch no more", steps, "");
        figures.add_ratio(name + "bare spring kernel / Bullet, a frame", 1e9 * spring_step * steps,
                          1e9 * link_iteration * iterations, "ns a spring");
    }
}

}  // namespace cullet::perf
