#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <memory>

#include "engine/fp_mode.hpp"
#include "engine/rigid_world.hpp"
#include "perf/perf.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kSide = 10, kHulls = kSide * kSide * kSide, kFirst = 200, kLast = 240;
constexpr float kMass = 1, kStepSeconds = 1.0f / 60;
constexpr float kTheirMargin = 0.04f, kPieceMargin = 0.001f;  // Bullet's own, and that of a piece so wide

/// Twelve points, the corners of an icosahedron, the margin inside of the radius.
std::vector<Vec3> hull_points(float radius, float margin) {
    const float a = 0.525731112f, b = 0.850650808f, r = radius - margin;
    std::vector<Vec3> points;
    for (int k = 0; k < 3; ++k)
        for (const float s : {1.0f, -1.0f})
            for (const float t : {1.0f, -1.0f}) {
                const float p[3] = {0, r * s * a, r * t * b};
                points.push_back({p[(3 - k) % 3], p[(4 - k) % 3], p[(5 - k) % 3]});
            }
    return points;
}
/// A cube of as much volume as the icosahedron: 2.5362 of its radius cubed.
std::vector<Vec3> cube_points(float radius, float margin) {
    const float h = 0.5f * 1.3637f * radius - margin;
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.push_back({k & 1 ? h : -h, k & 2 ? h : -h, k & 4 ? h : -h});
    return points;
}
Vec3 place_of(uint32_t k, float radius) {
    const auto at = [](uint32_t i) { return static_cast<float>(i) - 0.5f * static_cast<float>(kSide - 1); };
    const uint32_t x = k % kSide, y = k / (kSide * kSide), z = k / kSide % kSide;
    // Odd layers stand a little beside the even ones, so that the pile spreads.
    const float beside = y % 2 ? 0.2f : 0.0f, apart = 2.13f, above = 2.07f;  // radii
    return {radius * (apart * at(x) + beside), radius * (1.3f + above * static_cast<float>(y)),
            radius * (apart * at(z) + beside)};
}

/// Mean of the frames' least times over runs, s.
class FrameTimes {
 public:
    template <class Step>
    void run(Step step) {
        for (uint32_t frame = 0; frame < kLast; ++frame) {
            const double taken = seconds(step);
            if (frame < kFirst) continue;
            if (frame - kFirst == least_.size()) least_.push_back(taken);
            least_[frame - kFirst] = std::min(least_[frame - kFirst], taken);
        }
    }
    double mean() const {
        double sum = 0;
        for (const double t : least_) sum += t;
        return sum / static_cast<double>(least_.size());
    }

 private:
    std::vector<double> least_;
};

void run_plain(float radius, const std::vector<Vec3>& points, FrameTimes& times, uint32_t& contacts) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity({0, -9.81f, 0});
    btBoxShape ground({20, 0.5f, 20});
    btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground));
    floor.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, -0.5f, 0}));
    world.addRigidBody(&floor);
    btConvexHullShape hull;
    for (const Vec3 p : points) hull.addPoint({p.x, p.y, p.z}, false);
    hull.recalcLocalAabb();
    btVector3 inertia;
    hull.calculateLocalInertia(kMass, inertia);
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    for (uint32_t k = 0; k < kHulls; ++k) {
        bodies.push_back(
            std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(kMass, nullptr, &hull, inertia)));
        const Vec3 p = place_of(k, radius);
        bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), {p.x, p.y, p.z}));
        bodies.back()->setActivationState(DISABLE_DEACTIVATION);
        world.addRigidBody(bodies.back().get());
    }
    times.run([&] { world.stepSimulation(kStepSeconds, 0); });
    contacts = 0;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
        contacts += static_cast<uint32_t>(dispatcher.getManifoldByIndexInternal(i)->getNumContacts());
    for (auto& body : bodies) world.removeRigidBody(body.get());
    world.removeRigidBody(&floor);
}

void run_ours(float radius, float margin, const std::vector<Vec3>& points, FrameTimes& times, uint32_t& contacts) {
    const FpMode mode;
    const auto world = make_bullet_world(kHulls + 1);
    world->set_gravity({0, -9.81f, 0});
    const Vec3 p[] = {{-20, 0, -20}, {20, 0, -20}, {20, 0, 20}, {-20, 0, 20}};
    const std::array<uint32_t, 3> t[] = {{0, 2, 1}, {0, 3, 2}};
    world->add_static_triangles(0, p, t, 0.5f, 0, 1, ~0u);
    const ConvexPiece piece{points, 0};
    for (uint32_t k = 0; k < kHulls; ++k) {
        RigidDescription d;
        d.pieces = {&piece, 1};
        d.mass = kMass;
        const double moment = 0.4 * double{kMass} * radius * radius;
        d.inertia = {moment, moment, moment};
        d.margin = margin;
        d.friction = 0.5f;
        d.restitution = 0;
        d.pose.position = place_of(k, radius);
        world->add(k + 1, d);
    }
    times.run([&] {
        for (uint32_t k = 1; k <= kHulls; ++k) world->wake(k);
        world->detect(kStepSeconds);
        world->solve(kStepSeconds);
    });
    contacts = world->counts().contacts;
}

}  // namespace

// The choice of shapes leaves the icosahedron a hull: the box about it has 1.9 times its volume, a box is chosen below
// 1.15 (design section 8 and the shapes). What it makes boxes of are bricks, so these have a row of their own:
// cubes, which plain Bullet is given as hulls of eight points, as it was the others. Ours are measured twice: as plain
// Bullet's hulls are, and with the thin margin that pieces are born with. That gives another pile. Its hulls lie
// closer, with a fifth more pairs at 0.15 m and 2.4 times as many at 0.05 m. Its bricks still tumble in these frames.
// In frames 200 to 600 they cost what rounded ones do, within 3 %.
bool measure_pile(const Options& options, Figures& figures) {
    struct Row {
        const char* name;
        float radius;
        std::vector<Vec3> (*points)(float radius, float margin);
        double limit;
    };
    const Row rows[] = {{"hulls of 0.15 m: ", 0.15f, hull_points, 0.75},
                        {"hulls of 0.05 m: ", 0.05f, hull_points, 0.75},
                        {"bricks of 0.2 m, boxes by choice: ", 0.15f, cube_points, 0.5}};
    for (const auto& [label, radius, points, limit] : rows) {
        const std::string name(label);
        FrameTimes plain, alike, thin;
        uint32_t plain_contacts = 0, alike_contacts = 0, thin_contacts = 0;
        for (uint32_t round = 0; round < options.rounds_of_a_pass(2); ++round) {
            run_plain(radius, points(radius, kTheirMargin), plain, plain_contacts);
            run_ours(radius, kTheirMargin, points(radius, kTheirMargin), alike, alike_contacts);
            run_ours(radius, kPieceMargin, points(radius, kPieceMargin), thin, thin_contacts);
        }
        figures.add(name + "plain Bullet, contacts", plain_contacts, "");
        figures.add(name + "ours, contacts", alike_contacts, "");
        figures.add(name + "ours with 1 mm of margin, contacts", thin_contacts, "");
        figures.add_ratio(name + "a frame, ours / plain Bullet", 1e3 * alike.mean(), 1e3 * plain.mean(), "ms", limit);
        figures.add_ratio(name + "a frame, ours with 1 mm of margin / plain Bullet", 1e3 * thin.mean(),
                          1e3 * plain.mean(), "ms", limit);
    }
    return true;
}

}  // namespace cullet::perf
