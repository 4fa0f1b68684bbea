// Worlds with one sheet of a ductile or elastic material, and what tests measure of it.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>

#include "components/state.hpp"
#include "sample_game/meshes.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {

/// 0.4 m wide, edge 25 mm, its lower border at y = 0, in the plane z = 0.
inline Model cook_sheet(const char* material, float thickness) {
    CookSettings settings;
    settings.model = "thick_shell";
    settings.material = material;
    settings.thickness = thickness;
    settings.longest_edge = 100;
    const Mesh mesh = make_pane(0.4f, 0.025f);
    Result<Model> model = cook(view_of_mesh(mesh), settings);
    if (!model) ADD_FAILURE() << model.error(), std::abort();
    return std::move(model).value();
}
inline const Model& rubber_sheet() {
    static const Model model = cook_sheet("rubber", 0.004f);
    return model;
}
inline const Model& cloth_sheet() {
    static const Model model = cook_sheet("cloth", 0.0004f);
    return model;
}
inline const Model& steel_sheet() {
    static const Model model = cook_sheet("steel", 0.0015f);
    return model;
}

inline Settings soft_settings(uint32_t threads = 1) {
    Settings settings = small_settings();
    settings.units_a_frame = 8'000'000;
    settings.threads = threads;
    return settings;
}

/// Vertices on all four borders.
inline std::vector<Box> frame_pins() {
    return {{{-1, -0.01f, -1}, {1, 0.004f, 1}},
            {{-1, 0.396f, -1}, {1, 0.41f, 1}},
            {{-1, -0.01f, -1}, {-0.196f, 0.41f, 1}},
            {{0.196f, -0.01f, -1}, {1, 0.41f, 1}}};
}

struct Sheet {
    World world;
    BodyId body, ball;

    State& state() { return state_of(world); }
    Row<Bodies> row() const { return Row<Bodies>(body.index); }
    Row<SoftBodies> soft() { return state().bodies.soft[row()]; }
    bool is_awake() { return soft().exists() && state().soft_bodies.is_awake[soft()]; }
    void call() { state().soft_bodies.is_called[soft()] = 1; }
    SpringView view() { return SpringView(state(), springs_of(state(), soft())); }
    ShellView shell() { return ShellView(state(), state().bodies.structure[row()]); }
    std::vector<Vec3> shape() {
        std::vector<Vec3> places;
        for (uint32_t v = 0; v < shell().vertex_count(); ++v)
            places.push_back(state().vertices.rest[shell().vertex(v)]);
        return places;
    }
};

inline Sheet make_sheet(const Model& model, const Settings& settings, const std::vector<Box>& pins = {},
                        float strength = 1) {
    Sheet sheet{make_world(settings), {}, {}};
    SpawnSettings spawn;
    spawn.pins = pins.data();
    spawn.pin_count = static_cast<uint32_t>(pins.size());
    spawn.strength_scale = strength;
    const Result<ModelId> id = sheet.world.add_model(model);
    if (!id) ADD_FAILURE() << id.error(), std::abort();
    const Result<BodyId> body = sheet.world.spawn(id.value(), spawn);
    if (!body) ADD_FAILURE() << body.error(), std::abort();
    sheet.body = body.value();
    return sheet;
}

/// A ball on its way along -z to the middle of the sheet.
inline void throw_ball(Sheet& sheet, float mass, float speed, float radius = 0.04f) {
    sheet.ball = sheet.world.add_sphere(ball_at({0.01f, 0.21f, 0}, mass, speed, radius)).value();
}

inline float farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    float most = 0;
    for (size_t v = 0; v < a.size(); ++v) most = std::max(most, length(a[v] - b[v]));
    return most;
}

/// J: motion and springs of the sheet, motion of the ball.
inline double energy_of(Sheet& sheet) {
    const SpringView view = sheet.view();
    double energy = spring_energy(view) + motion_of(view).kinetic;
    if (sheet.ball) {
        const Motion m = sheet.world.motion(sheet.ball).value();
        const double mass = sheet.world.mass(sheet.ball).value();
        const Bodies& bodies = sheet.state().bodies;
        const double inertia = bodies.inertia[sheet.ball.index].xx;
        energy += 0.5 * mass * double(dot(m.velocity, m.velocity)) +
                  0.5 * inertia * double(dot(m.angular_velocity, m.angular_velocity));
    }
    return energy;
}

}  // namespace cullet::test
