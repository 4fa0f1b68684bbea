#include "tests/support/large_hits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "components/state.hpp"
#include "sample_game/allocations.hpp"
#include "sample_game/meshes.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/structures/shell/cook/check_shell_rows.hpp"
#include "tests/support/random_hits.hpp"

namespace cullet::test {

Result<Model> cook_vase(float height, float edge, CookSettings settings) {
    const Mesh mesh = make_vase(height, edge);
    settings.thick_shell.measures_threshold = false;
    return cook(view_of_mesh(mesh), settings);
}

Model porcelain_vase(float height, float edge, FractureKind kind) {
    CookSettings settings;
    settings.material = "porcelain", settings.thickness = 0.005f;
    settings.longest_edge = 100;
    settings.fracture = kind;
    Result<Model> cooked = cook_vase(height, edge, settings);
    EXPECT_TRUE(cooked.ok()) << cooked.error();
    return std::move(cooked).value();
}

Settings large_settings(uint32_t threads, uint64_t units) {
    Settings settings = small_settings();
    settings.threads = threads;
    settings.units_a_frame = units;
    settings.debris_share = 0, settings.debris_elements = 3;
    settings.limits = {512, 8, 1u << 17, 1u << 18, 8, 1u << 20, 512};
    return settings;
}

std::vector<uint64_t> hashes_of(World& world, uint32_t frames) {
    std::vector<uint64_t> hashes;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        world.step();
        hashes.push_back(world.hash());
    }
    return hashes;
}

std::string trouble_of_shells(State& state) {
    for (uint32_t row = 0; row < state.shells.size(); ++row) {
        if (state.structures.users[row] == 0) continue;
        Wear wear = Wear::Worn;
        for (uint32_t t = 0; t < state.tasks.size(); ++t)
            if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free && state.tasks.working[t] == row &&
                is_cut_out(state, t))
                wear = Wear::CutOut;
        const Result<void> sound = check_shell_rows(ShellView(state, Row<Structures>(row)), wear, "shell", "");
        if (!sound.ok()) return sound.error();
    }
    return {};
}

void expect_same_hashes(const std::function<Breakage(const Settings&)>& make, uint32_t frames) {
    std::vector<uint64_t> first;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Breakage b = make(large_settings(threads));
        const std::vector<uint64_t> hashes = hashes_of(b.world, frames);
        if (threads == 1)
            first = hashes;
        else
            EXPECT_EQ(hashes, first) << threads << " threads";
    }
}

void expect_matter_is_kept(Breakage& b, uint32_t frames) {
    World* w = &b.world;
    Matter before{};
    uint64_t broke = 0;
    uint32_t breaks = 0;
    double worst = 0, worst_mass = 0;
    const double scale = std::fabs(matter_of(b.world).momentum[2]);
    after_each_system(b.world, [&](const std::string& system) {
        if (system == "settle_tasks") before = matter_of(*w), broke = w->contents().data.counts.broke;
        if (system != "make_births" || w->contents().data.counts.broke == broke) return;
        ++breaks;
        const Matter after = matter_of(*w);
        for (int k = 0; k < 3; ++k) worst = worse(worst, std::fabs(after.momentum[k] - before.momentum[k]) / scale);
        worst_mass = worse(worst_mass, std::fabs(after.mass / before.mass - 1));
        EXPECT_LE(after.kinetic_energy, 1.0001 * before.kinetic_energy);
    });
    for (uint32_t frame = 0; frame < frames; ++frame) b.world.step();
    std::printf("%u breaks, momentum off by %.1e of the balls', mass by %.1e, hidden rounding %.1e\n", breaks, worst,
                worst_mass, b.world.contents().data.counts.worst_rounding);
    EXPECT_GT(breaks, 0u);
    EXPECT_LT(worst, 1e-6);
    EXPECT_LT(worst_mass, 1e-6);
    EXPECT_LT(b.world.contents().data.counts.worst_rounding, 2e-4);
}

void expect_goes_on(World& world, const Settings& settings, uint32_t frames) {
    const auto bytes = world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World other = make_world(settings);
    const Result<void> loaded = other.restore(bytes->data(), bytes->size());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_EQ(hashes_of(world, frames), hashes_of(other, frames));
}

void expect_no_allocation(Breakage& b, uint32_t frames) {
    start_counting_allocations();
    for (uint32_t frame = 0; frame < frames; ++frame) b.world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(shells_of(b.world).size(), 1u);
}

}  // namespace cullet::test
