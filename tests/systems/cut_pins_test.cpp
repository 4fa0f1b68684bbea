// A cut through or beside pinned vertices leaves pins on the side that the pins' boxes hold, and nowhere else.
#include <gtest/gtest.h>

#include "components/state.hpp"
#include "sample_game/meshes.hpp"
#include "systems/bodies/pin_boxes.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/random_hits.hpp"
#include "tests/support/small_worlds.hpp"

// Designated initializers name what they set.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

namespace cullet::test {
namespace {

constexpr float kEdge = 0.04f;  // m, of the pane

const Model& pane() {
    static const Model model = [] {
        CookSettings settings;
        settings.material = "glass";
        settings.thickness = 0.006f;
        settings.longest_edge = 100;
        settings.thick_shell.measures_threshold = false;
        const Mesh mesh = make_pane(1, kEdge);
        return cook(view_of_mesh(mesh), settings).value();
    }();
    return model;
}

Settings falling_settings() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.limits.vertices = 1u << 17;
    settings.limits.elements = 1u << 18;
    return settings;
}

struct Hung {
    World world;
    BodyId body;
    double mass = 0;
};

/// 1 m wide, in the plane z = 0, its lower border at y = 0 of the body, which stands half a metre above the floor.
Hung hang(const std::vector<Box>& pins, FractureMode mode) {
    Hung hung{make_world(falling_settings()), {}, 0};
    SpawnSettings spawn;
    spawn.pose.position = {0, 0.5f, 0};
    spawn.pins = pins.data();
    spawn.pin_count = static_cast<uint32_t>(pins.size());
    spawn.thick_shell.fracture = mode;
    hung.body = hung.world.spawn(hung.world.add_model(pane()).value(), spawn).value();
    hung.mass = hung.world.mass(hung.body).value();
    return hung;
}

/// kg of what moves, debris left out, and of what hangs.
struct Masses {
    double falls = 0, hangs = 0;
};
Masses masses_of(World& world) {
    Masses masses;
    const Bodies& bodies = state_of(world).bodies;
    for (const BodyId id : shells_of(world)) {
        const bool is_static = static_cast<BodyKind>(bodies.kind[id.index]) == BodyKind::Static;
        (is_static ? masses.hangs : masses.falls) += bodies.mass[id.index];
    }
    return masses;
}

const Box kUpperBorder{{-1, 0.999f, -1}, {1, 1.01f, 1}};

// A mesh that has no vertices near the cut is given some, down to a strip of a twentieth of an edge; below that all
// falls.
TEST(CutPins, WhatIsCutOffAllAlongFalls) {
    for (const FractureMode mode : {FractureMode::Hidden, FractureMode::Quick})
        for (const float below :
             {0.001f, 0.002f, 0.003f, 0.005f, 0.01f, 0.015f, 0.02f, 0.03f, 0.035f, 0.04f, 0.06f, 0.3f, 0.5f}) {
            Hung hung = hang({kUpperBorder}, mode);
            ASSERT_TRUE(hung.world.cut(hung.body, {.place = {0, 1.5f - below, 0}}).ok());
            for (int frame = 0; frame < 3; ++frame) hung.world.step();
            const Masses masses = masses_of(hung.world);
            EXPECT_NEAR(masses.falls, (1.0 - double{below}) * hung.mass, 0.012 * hung.mass) << below;
            EXPECT_NEAR(masses.falls + masses.hangs, hung.mass, 1e-3 * hung.mass) << below;
        }
}

TEST(CutPins, WhatHangsOnBothSidesHangsOn) {
    for (const float at : {0.9505f, 0.96f, 0.97f, 0.98f, 0.99f}) {
        Hung hung = hang({{{-1, 0.9f, -1}, {1, 1.01f, 1}}}, FractureMode::Hidden);
        ASSERT_TRUE(hung.world.cut(hung.body, {.place = {0, 0.5f + at, 0}}).ok());
        for (int frame = 0; frame < 3; ++frame) hung.world.step();
        EXPECT_EQ(masses_of(hung.world).falls, 0) << at;
    }
}

// The box ends 10 mm below the cut, between two rows of vertices: what is left in it holds the lower side.
TEST(CutPins, ABoxThatReachesBeyondTheCutHoldsTheOtherSide) {
    for (const float low : {0.925f, 0.935f, 0.945f, 0.955f}) {
        Hung hung = hang({{{-1, low, -1}, {1, 1.01f, 1}}}, FractureMode::Hidden);
        ASSERT_TRUE(hung.world.cut(hung.body, {.place = {0, 0.5f + 0.95f, 0}}).ok());
        for (int frame = 0; frame < 3; ++frame) hung.world.step();
        const Masses masses = masses_of(hung.world);
        EXPECT_EQ(masses.falls == 0, low < 0.95f) << low << ": " << masses.falls << " kg";
        EXPECT_GT(masses.hangs, 0.03 * hung.mass) << low;
    }
}

TEST(CutPins, ACutFarFromThePinsLeavesThemAsTheyAre) {
    Hung hung = hang({kUpperBorder}, FractureMode::Hidden);
    const auto pins = [&] {
        State& state = state_of(hung.world);
        const ShellView shell(state, state.bodies.structure[hung.body.index]);
        uint32_t count = 0;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) count += state.vertices.is_pinned[shell.vertex(v)];
        return count;
    };
    const uint32_t before = pins();
    ASSERT_TRUE(hung.world.cut(hung.body, {.place = {0, 1, 0}, .normal = {0.1f, 0.995f, 0}}).ok());
    for (int frame = 0; frame < 3; ++frame) hung.world.step();
    EXPECT_EQ(pins(), before);
    EXPECT_GT(masses_of(hung.world).falls, 0.3 * hung.mass);
}

/// A plane in body coordinates: a vertex that a cut passed nearer than this may have been drawn to it.
struct Plane {
    Vec3 place, normal;
    float away(Vec3 p) const { return std::fabs(dot(p - place, normal)); }
};

bool is_in(const std::vector<Box>& boxes, Vec3 p, float wider) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
        return p.x >= b.low.x - wider && p.y >= b.low.y - wider && p.z >= b.low.z - wider && p.x <= b.high.x + wider &&
               p.y <= b.high.y + wider && p.z <= b.high.z + wider;
    });
}

/// Pins where the boxes are; bodies that have pins stand, those that have none fall.
void expect_pins(World& world, const std::vector<Box>& boxes, const std::vector<Plane>& cuts, uint64_t round) {
    State& state = state_of(world);
    const Vertices& vertices = state.vertices;
    for (const BodyId id : shells_of(world)) {
        const Row<Bodies> body(id.index);
        const ShellView shell(state, state.bodies.structure[body]);
        const bool is_static = static_cast<BodyKind>(state.bodies.kind[body]) == BodyKind::Static;
        bool has_pins = false;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const uint32_t row = shell.vertex(v);
            if (vertices.element[row] == kNone) continue;
            const Vec3 p = vertices.rest[row];
            const bool is_pinned = vertices.is_pinned[row] != 0;
            has_pins = has_pins || is_pinned;
            float away = 1;
            for (const Plane& cut : cuts) away = std::min(away, cut.away(p));
            if (away > 1.5f * kEdge && is_static) {
                EXPECT_EQ(is_pinned, is_in(boxes, p, 0)) << "round " << round << " at " << p.x << ", " << p.y;
            }
            if (is_pinned) {
                EXPECT_TRUE(is_in(boxes, p, away > 1.5f * kEdge ? 0 : 1.5f * kEdge)) << "round " << round;
            }
            EXPECT_EQ(vertices.inverse_mass[row] == 0, is_pinned || !(vertices.mass[row] > 0)) << "round " << round;
            // What lies well inside of a box, on either side of whatever was cut, holds its body.
            if (is_in(boxes, p, -1.5f * kEdge)) {
                EXPECT_TRUE(is_static) << "round " << round;
            }
        }
        EXPECT_EQ(is_static, has_pins) << "round " << round << ", body " << id.index;
        EXPECT_EQ(state.bodies.has_pins[body] != 0, has_pins) << "round " << round << ", body " << id.index;
    }
}

// Planes through the pane, one after another, pieces of pieces too, saved and loaded between two.
TEST(CutPins, RandomCutsLeavePinsInTheBoxesAlone) {
    for (uint64_t round = 0; round < test::few_or_all(12u, 24u); ++round) {
        Draw draw{Random{0x70696e73}, round};
        const FractureMode mode = round % 2 ? FractureMode::Quick : FractureMode::Hidden;
        std::vector<Box> boxes;
        for (uint64_t k = 0; k < 1 + round % 3; ++k) {
            const Vec3 middle{float(draw.between(-0.5, 0.5)), float(draw.between(0, 1)), 0};
            const Vec3 half{float(draw.between(0.03, 0.4)), float(draw.between(0.03, 0.2)), 0.1f};
            boxes.push_back({middle - half, middle + half});
        }
        Hung hung = hang(boxes, mode);
        Hung other = hang({kUpperBorder}, mode);
        std::vector<Plane> cuts;
        bool is_loaded = false;
        for (int k = 0; k < 4; ++k) {
            Vec3 normal = draw.in_ball(1);
            normal.z = 0;
            const Plane cut{{float(draw.between(-0.4, 0.4)), float(draw.between(0.1, 0.9)), 0}, normalised(normal)};
            cuts.push_back(cut);
            World& world = is_loaded ? other.world : hung.world;
            // What hangs has not moved: the pieces that fall are cut where they are, and theirs are no pins to have.
            for (const BodyId id : shells_of(world))
                if (state_of(world).bodies.has_pins[id.index]) {
                    EXPECT_TRUE(world.cut(id, {.place = cut.place + Vec3{0, 0.5f, 0}, .normal = cut.normal}).ok());
                }
            world.step();
            const std::vector<uint8_t> saved = world.snapshot().value();
            for (int frame = 0; frame < 4; ++frame) world.step();
            expect_pins(world, boxes, cuts, round);
            World& loads = is_loaded ? hung.world : other.world;
            ASSERT_TRUE(loads.restore(saved.data(), saved.size()).ok());
            for (int frame = 0; frame < 4; ++frame) loads.step();
            EXPECT_EQ(loads.hash(), world.hash()) << "round " << round;
            is_loaded = !is_loaded;
            if (testing::Test::HasFailure()) return;
        }
    }
}

TEST(CutPins, ACutWithPinsIsTheSameOnAnyNumberOfThreads) {
    std::vector<uint64_t> hashes;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Settings settings = falling_settings();
        settings.threads = threads;
        World world = make_world(settings);
        const ModelId model = world.add_model(pane()).value();
        for (int k = 0; k < 4; ++k) {
            SpawnSettings spawn;
            spawn.pose.position = {0, 0.5f, 0.2f * static_cast<float>(k)};
            spawn.pins = &kUpperBorder;
            spawn.pin_count = 1;
            ASSERT_TRUE(world.spawn(model, spawn).ok());
        }
        ASSERT_TRUE(world.cut({}, {.place = {0, 1.49f, 0}, .normal = normalised(Vec3{0.02f, 1, 0})}).ok());
        for (int frame = 0; frame < 20; ++frame) world.step();
        hashes.push_back(world.hash());
    }
    for (const uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

// Boxes of bodies that are gone make room.
TEST(CutPins, BoxesDoNotPileUp) {
    Settings settings = falling_settings();
    settings.limits.bodies = 8;
    World world = make_world(settings);
    const ModelId model = world.add_model(pane()).value();
    const std::vector<Box> boxes(20, kUpperBorder);
    std::vector<BodyId> alive;
    for (int k = 0; k < 60; ++k) {
        SpawnSettings spawn;
        spawn.pins = boxes.data();
        spawn.pin_count = static_cast<uint32_t>(1 + k % 20);
        const Result<BodyId> body = world.spawn(model, spawn);
        ASSERT_TRUE(body.ok()) << body.error();
        alive.push_back(*body);
        if (alive.size() > 3) {
            ASSERT_TRUE(world.remove(alive[k % 3]).ok());
            alive.erase(alive.begin() + k % 3);
        }
        for (const BodyId id : alive) {
            const Range pins = state_of(world).bodies.pins[id.index];
            ASSERT_GT(pins.count, 0u);
            EXPECT_TRUE(is_held(state_of(world).pin_boxes, pins, {0, 1, 0}));
        }
    }
    SpawnSettings spawn;
    const std::vector<Box> many(1000, kUpperBorder);
    spawn.pins = many.data();
    spawn.pin_count = 1000;
    const Result<BodyId> refused = world.spawn(model, spawn);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().find("pin boxes"), std::string::npos) << refused.error();
}

}  // namespace
}  // namespace cullet::test
