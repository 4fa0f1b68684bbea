// No quick break adds energy: some hundreds of random shapes, materials, kinds of fracture, layers and strikers.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/support/effort.hpp"
#include "tests/support/random_hits.hpp"

namespace cullet::test {
namespace {

constexpr uint32_t kShapes = 24, kMostHits = 2000;
const uint32_t kBreaks = few_or_all(150u, 300u);

TEST(QuickBreaks, SomeHundredsAddNoEnergyAndKeepMassAndMomentum) {
    World world = make_world(small_settings());
    Watch watch;
    after_each_system(world, [&](const std::string& system) { watch.look(world, system); });
    constexpr std::array kinds{FractureKind::Fine, FractureKind::Coarse, FractureKind::Large};
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < kShapes; ++s) shapes.push_back(random_shape(s, kinds[s / 4 % kinds.size()]));
    uint32_t hits = 0;
    for (; hits < kMostHits && watch.breaks < kBreaks; ++hits) {
        SpawnSettings spawn;
        spawn.thick_shell.fracture = FractureMode::Quick;
        spawn.thick_shell.quick.layers = 1 + hits / kShapes % 2;
        // Every third turn of the shapes by the published layout, every third with energies.
        const uint32_t turn = hits / kShapes / 2 % 3;
        if (turn == 1) spawn.thick_shell.springs.layout = LayerLayout::Crossed;
        if (turn == 2) spawn.thick_shell.springs.area_energy = spawn.thick_shell.springs.volume_energy = 0.2f;
        watch.begin_hit(world);
        hit_once(world, shapes[hits % kShapes], {{6}, hits}, spawn);
        ASSERT_LE(watch.most_kept, 1 + 1e-6) << "hit " << hits;
    }
    const DamageCounts& counts = world.contents().data.counts;
    std::printf(
        "%u breaks in %u hits; at most %.4f of the energy kept, momentum to %.1e, mass to %.1e; %u of %u runs "
        "dropped\n",
        watch.breaks, hits, watch.most_kept, watch.worst_momentum, watch.worst_mass,
        static_cast<uint32_t>(counts.dropped), static_cast<uint32_t>(counts.opened));
    EXPECT_GE(watch.breaks, kBreaks);
    EXPECT_LE(counts.dropped, counts.opened / 50) << "runs whose energy grew";
    EXPECT_LT(watch.worst_momentum, 1e-6);
    EXPECT_LT(watch.worst_mass, 1e-6);
}

}  // namespace
}  // namespace cullet::test
