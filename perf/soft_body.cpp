#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/fp_mode.hpp"
#include "perf/our_springs.hpp"
#include "perf/perf.hpp"
#include "perf/soft_world.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"

namespace cullet::perf {
namespace {

constexpr int kSide = 107, kIterations = 20;  // 11,449 nodes, 33,708 links

std::unique_ptr<btSoftBody> make_patch(btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body(
        btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, kSide, kSide, 0, true));
    body->setTotalMass(1);
    return body;
}

/// Least time of a link and iteration, s.
double time_links(btSoftBody& body, uint32_t rounds) {
    const auto solve = btSoftBody::getSolver(btSoftBody::ePSolver::Linear);
    body.updateLinkConstants();
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, seconds([&] {
                             for (int i = 0; i < kIterations; ++i) solve(&body, 1, 0);
                         }));
    return least / (kIterations * double(body.m_links.size()));
}

/// Least time of a step of a world with nothing but the patch, falling, with as many iterations; s.
double time_world(uint32_t rounds) {
    SoftWorld made;
    btSoftRigidDynamicsWorld& world = made.world;
    const auto body = make_patch(world.getWorldInfo());
    btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());
    body->m_cfg.piterations = kIterations;
    world.addSoftBody(body.get());
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, seconds([&] { world.stepSimulation(1.0f / 60, 0); }));
    world.removeSoftBody(body.get());
    return least;
}

/// Drawn out by a tenth and bent, so that every spring works.
std::vector<Vec3> drawn_out(const SpringNet& net) {
    std::vector<Vec3> start;
    for (const Vec3 p : net.points) start.push_back({1.1f * p.x, 0.1f * p.x * p.z, p.z});
    return start;
}

/// Farthest that the two are apart after `kSteps` of both, m.
double difference(const SpringNet& net, const std::vector<Vec3>& start) {
    constexpr int kSteps = 50;
    PlainSprings plain(net, start);
    BareSprings bare(net, start);
    for (int i = 0; i < kSteps; ++i) plain.step(), bare.step();
    double most = 0;
    for (uint32_t v = 0; v < start.size(); ++v)
        most = std::max(most, double{length(plain.position(v) - bare.position(v))});
    return most;
}

/// Least of a step, s. Both take turns.
struct SpringTimes {
    double plain = 1e9, bare = 1e9;
};
SpringTimes time_springs(const SpringNet& net, const std::vector<Vec3>& start, uint32_t rounds) {
    PlainSprings plain(net, start);
    BareSprings bare(net, start);
    SpringTimes least;
    const auto five = [](auto& loop) {
        return seconds([&] {
            for (int i = 0; i < 5; ++i) loop.step();
        });
    };
    for (uint32_t round = 0; round < rounds; ++round) {
        least.plain = std::min(least.plain, five(plain) / 5);
        if (BareSprings::is_supported()) least.bare = std::min(least.bare, five(bare) / 5);
    }
    return least;
}

/// Least time of a spring and substep of the library's own, by the inner loop on one thread; s.
double time_ours(const SpringNet& net, const std::vector<Vec3>& start, uint32_t rounds) {
    constexpr uint32_t kSteps = 10;
    SpringBench bench = bench_of(net);
    for (uint32_t v = 0; v < start.size(); ++v) bench.view().place(v, start[v]);
    measure_lengths(bench.view());
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, seconds([&] { run_springs(bench.state(), bench.springs(), kSteps); }));
    return least / (kSteps * static_cast<double>(net.springs.size()));
}

}  // namespace

SpringNet net_of(const btSoftBody& body) {
    SpringNet net;
    for (int i = 0; i < body.m_nodes.size(); ++i)
        net.points.push_back({body.m_nodes[i].m_x.x(), body.m_nodes[i].m_x.y(), body.m_nodes[i].m_x.z()});
    const auto number = [&](const btSoftBody::Node* n) { return static_cast<uint32_t>(n - &body.m_nodes[0]); };
    for (int i = 0; i < body.m_links.size(); ++i)
        net.springs.push_back({number(body.m_links[i].m_n[0]), number(body.m_links[i].m_n[1])});
    net.mass = 1.0f / static_cast<float>(net.points.size());
    net.stiffness = 100;
    net.dt = 0.2f * std::sqrt(net.mass / net.stiffness);
    net.damping = 0.1f * net.stiffness * net.dt;
    return net;
}

// Yardsticks (a), (b), (c) and (e) of springs. The library's own step stands beside (a) to (c) in spring_grids.cpp.
bool measure_soft_body(const Options& options, Figures& figures) {
    const uint32_t rounds = options.rounds_of_a_pass(60);
    btSoftBodyWorldInfo info;
    info.m_sparsesdf.Initialize();
    const auto body = make_patch(info);
    const double links = body->m_links.size();
    const SpringNet net = net_of(*body);
    figures.add("links", links, "");
    figures.add("Bullet, a link and iteration, as given", 1e9 * time_links(*body, rounds), "ns");
    btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());
    const double link = time_links(*body, rounds);
    figures.add("Bullet, a link and iteration, reordered", 1e9 * link, "ns");
    figures.add("Bullet, a whole world step, a link and iteration of 20",
                1e9 * time_world(rounds) / (kIterations * links), "ns");
    const FpMode mode;
    const std::vector<Vec3> start = drawn_out(net);
    const SpringTimes springs = time_springs(net, start, rounds);
    figures.add("plain spring loop, a spring and step", 1e9 * springs.plain / links, "ns");
    const double ours = time_ours(net, start, rounds);
    figures.add_ratio("substep / Bullet, an iteration", 1e9 * ours, 1e9 * link, "ns a spring");
    measure_equal_error(ours, link, figures);
    if (!BareSprings::is_supported()) return true;
    figures.add_ratio("bare spring kernel / plain spring loop", 1e9 * springs.bare / links, 1e9 * springs.plain / links,
                      "ns a spring");
    figures.add_ratio("bare spring kernel, a step / Bullet, an iteration", 1e9 * springs.bare / links, 1e9 * link,
                      "ns a spring");
    const double apart = difference(net, start);
    figures.add("bare and plain springs apart after 50 steps of a patch of 1 m", apart, "m", 1e-5);
    return apart < 1e-5;
}

}  // namespace cullet::perf
