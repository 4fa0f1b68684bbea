// No break adds energy: a thousand breaks of random shapes, materials, placements, speeds and strikers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/random.hpp"
#include "tests/support/random_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr uint32_t kBreaks = 1000, kShapes = 40, kMostHits = 4000;

/// Numbers of one hit.
struct Draw {
    Random random;
    uint64_t hit;
    uint64_t count = 0;
    double between(double low, double high) { return low + (high - low) * random.uniform(hit, count++); }
    Vec3 in_ball(double radius) {
        for (;;) {
            const Vec3 p{float(between(-1, 1)), float(between(-1, 1)), float(between(-1, 1))};
            if (dot(p, p) <= 1 && dot(p, p) > 1e-4f) return float(radius) * p;
        }
    }
};

struct Shape {
    Model model;
    float radius = 0;  // m, half the diagonal of its bounds
};

/// 0.1 to 0.6 m, of one of the four brittle materials that are not wood, 1 to 4 % of its size thick.
Shape random_shape(uint32_t shape) {
    Draw draw{{77}, shape};
    Mesh mesh = random_mesh(1000 + shape);
    const float size = float(draw.between(0.1, 0.6));
    Vec3 low = size * mesh.positions[0], high = low;
    for (Vec3& p : mesh.positions) {
        p = size * p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    CookSettings settings;
    settings.material = std::array{"glass", "porcelain", "brick", "concrete"}[shape % 4];
    settings.thickness = size * float(draw.between(0.01, 0.04));
    settings.longest_edge = 100;
    settings.measures_threshold = false;
    Result<Model> model = cook(view_of_mesh(mesh), settings);
    if (!model) ADD_FAILURE() << model.error(), std::abort();
    return {std::move(model).value(), length(high - low) / 2};
}

/// What moves, before the systems of damage and after the births: nothing but them lies between, so that Bullet's
/// solver has no part in it.
struct Watch {
    Matter before;
    double energy_before = 0, of_old_debris = 0;
    uint64_t broke_before = 0;
    uint32_t breaks = 0;
    double most_kept = 0, worst_momentum = 0, worst_mass = 0;

    /// Kinetic energy, and what a body gains that is still to be struck back: its own task decides how, and its share
    /// of a striker's loss that another task has seen already.
    static double energy_of(const World& world, const Matter& matter) {
        const State& state = world.contents().data.state;
        double energy = matter.kinetic_energy;
        for (uint32_t t = 0; t < state.tasks.size(); ++t) {
            if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free) continue;
            const uint32_t first = state.tasks.first_contact[t];
            for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c)
                energy += state.task_contacts.answer_energy[c];
        }
        return energy;
    }

    void look(const World& world, const std::string& system) {
        const uint64_t broke = world.contents().data.counts.broke;
        if (system == "remember_poses") {
            before = matter_of(world);
            energy_before = energy_of(world, before);
            broke_before = broke;
        }
        if (system != "make_births" || broke == broke_before) return;
        ++breaks;
        const Matter after = matter_of(world);
        most_kept =
            std::max(most_kept, (energy_of(world, after) - of_old_debris) / (energy_before - of_old_debris));
        worst_mass = std::max(worst_mass, std::fabs(after.mass / before.mass - 1));
        double change = 0;
        for (int k = 0; k < 3; ++k) change = std::hypot(change, after.momentum[k] - before.momentum[k]);
        // A momentum to compare with that no frame of reference makes zero.
        worst_momentum = std::max(worst_momentum, change / std::sqrt(2 * before.mass * before.kinetic_energy));
    }
};

/// A body that flies and turns, and a ball that catches up with it, towards a place within half its size.
void hit_once(World& world, const Shape& shape, Draw draw) {
    const ModelId model = world.add_model(shape.model).value();
    const float radius = shape.radius;
    SpawnSettings body;
    const Vec3 axis = draw.in_ball(1);
    const double half = draw.between(0, 3.14159);
    const Vec3 part = float(std::sin(half)) / length(axis) * axis;
    body.pose.orientation = {part.x, part.y, part.z, float(std::cos(half))};
    body.motion = {draw.in_ball(3), draw.in_ball(10)};
    const BodyId id = world.spawn(model, body).value();
    SphereSettings ball;
    ball.radius = radius * float(draw.between(0.05, 0.3));
    ball.mass = float(shape.model.report().mass * draw.between(0.1, 2));
    const Vec3 way = draw.in_ball(1);
    const Vec3 unit = 1 / length(way) * way;
    const Bodies& bodies = state_of(world).bodies;
    const Vec3 centre = to_world(body.pose, bodies.centre[id.index].to_float());
    ball.pose.position = centre + draw.in_ball(0.5 * radius) - (1.6f * radius + ball.radius) * unit;
    ball.motion.velocity = body.motion.velocity + float(draw.between(3, 25)) * unit;
    const BodyId striker = world.add_sphere(ball).value();
    for (int frame = 0; frame < 16; ++frame) world.step();
    EXPECT_TRUE(world.remove(striker).ok());
    for (const BodyId left : shells_of(world)) EXPECT_TRUE(world.remove(left).ok());
    EXPECT_TRUE(world.remove_model(model).ok());
    world.step();
}

TEST(RandomBreaks, AThousandAddNoEnergyAndKeepMassAndMomentum) {
    World world = make_world(small_settings());
    Watch watch;
    after_each_system(world, [&](const std::string& system) { watch.look(world, system); });
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < kShapes; ++s) shapes.push_back(random_shape(s));
    uint32_t hits = 0;
    for (; hits < kMostHits && watch.breaks < kBreaks; ++hits) {
        watch.of_old_debris = matter_of(world).kinetic_energy;
        hit_once(world, shapes[hits % kShapes], {{5}, hits});
        ASSERT_LE(watch.most_kept, 1 + 1e-6) << "hit " << hits;
    }
    std::printf("%u breaks in %u hits; at most %.4f of the energy kept, momentum to %.1e, mass to %.1e\n", watch.breaks,
                hits, watch.most_kept, watch.worst_momentum, watch.worst_mass);
    EXPECT_GE(watch.breaks, kBreaks);
    EXPECT_LT(watch.worst_momentum, 1e-6);
    EXPECT_LT(watch.worst_mass, 1e-6);
}

}  // namespace
}  // namespace cullet::test
