#include "tests/support/random_hits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/state.hpp"
#include "tests/support/random_meshes.hpp"

namespace cullet::test {
namespace {

/// Kinetic energy, and what a body gains that is still to be struck back: its own task decides how, and its share of a
/// striker's loss that another task has seen already.
double energy_of(const World& world, const Matter& matter) {
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

}  // namespace

Shape random_shape(uint32_t shape, std::optional<FractureKind> fracture) {
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
    settings.thick_shell.measures_threshold = false;
    settings.fracture = fracture;
    Result<Model> model = cook(view_of_mesh(mesh), settings);
    if (!model) ADD_FAILURE() << model.error(), std::abort();
    return {std::move(model).value(), length(high - low) / 2};
}

void Watch::look(const World& world, const std::string& system) {
    const uint64_t broke = world.contents().data.counts.broke;
    if (system == "remember_poses") {
        before = matter_of(world);
        energy_before = energy_of(world, before);
        broke_before = broke;
    }
    if (system != "make_births" || broke == broke_before) return;
    ++breaks;
    const Matter after = matter_of(world);
    most_kept = worse(most_kept, (energy_of(world, after) - of_old_debris) / (energy_before - of_old_debris));
    worst_mass = worse(worst_mass, std::fabs(after.mass / before.mass - 1));
    double change = 0;
    for (int k = 0; k < 3; ++k) change = std::hypot(change, after.momentum[k] - before.momentum[k]);
    // A momentum to compare with that no frame of reference makes zero.
    worst_momentum = worse(worst_momentum, change / std::sqrt(2 * before.mass * before.kinetic_energy));
}

Throw throw_at(World& world, const Shape& shape, Draw draw, SpawnSettings body) {
    const ModelId model = world.add_model(shape.model).value();
    const float radius = shape.radius;
    const Vec3 axis = draw.in_ball(1);
    // Cosine and sine of half the angle by its quarter's tangent: libm's differ between libraries.
    const double tangent = draw.between(-1, 1), scale = 1 / (1 + tangent * tangent);
    const Vec3 part = float(2 * tangent * scale) / length(axis) * axis;
    body.pose.orientation = {part.x, part.y, part.z, float((1 - tangent * tangent) * scale)};
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
    return {model, id, world.add_sphere(ball).value()};
}

void clear_away(World& world, ModelId model) {
    for (const BodyId left : shells_of(world)) EXPECT_TRUE(world.remove(left).ok());
    EXPECT_TRUE(world.remove_model(model).ok());
    world.step();
}

void hit_once(World& world, const Shape& shape, Draw draw, SpawnSettings body) {
    const Throw thrown = throw_at(world, shape, draw, body);
    for (int frame = 0; frame < 16; ++frame) world.step();
    EXPECT_TRUE(world.remove(thrown.striker).ok());
    clear_away(world, thrown.model);
}

}  // namespace cullet::test
