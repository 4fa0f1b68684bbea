// At which speeds the three known bodies crack and break, quickly and by the hidden run.
#include <gtest/gtest.h>

#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "sample_game/thresholds.hpp"

namespace cullet {
namespace {

constexpr uint32_t kPlacements = 3;

MedianSpread first_pieces(HitBench& bench, double guess, MedianSpread& cracks) {
    std::vector<double> crack, piece;
    for (uint32_t placement = 0; placement < kPlacements; ++placement) {
        const Thresholds found = find_thresholds(bench, placement, guess);
        EXPECT_EQ(found.dropped, 0u) << "placement " << placement;
        crack.push_back(found.first_crack), piece.push_back(found.first_piece);
    }
    cracks = spread_of(crack);
    return spread_of(piece);
}

TEST(QuickThresholds, StandBesideThoseOfTheHiddenRun) {
    for (const Subject subject : kSubjects) {
        const Result<HitSubject> known = make_subject(subject);
        ASSERT_TRUE(known.ok()) << known.error();
        HitBench bench(subject, known->model);
        MedianSpread hidden_crack;
        const MedianSpread hidden = first_pieces(bench, known->known.first_crack, hidden_crack);
        std::printf("%s, hidden: first crack %.2f m/s, first piece %.2f\n", known->name, hidden_crack.median,
                    hidden.median);
        for (const uint32_t layers : {1u, 2u}) {
            QuickSettings quick;
            quick.layers = layers;
            bench.break_quickly(quick, static_cast<float>(hidden_crack.median));
            MedianSpread crack;
            const MedianSpread piece = first_pieces(bench, known->known.first_crack, crack);
            std::printf("%s, quick, %u layers: first crack %.2f m/s (%.2f to %.2f), first piece %.2f (%.2f to %.2f)\n",
                        known->name, layers, crack.median, crack.least, crack.most, piece.median, piece.least,
                        piece.most);
            EXPECT_GT(crack.median, 0.5 * hidden_crack.median) << known->name << ", " << layers << " layers";
            EXPECT_LT(crack.median, 2 * hidden_crack.median) << known->name << ", " << layers << " layers";
        }
        bench.break_quickly({});
    }
}

// The paper's claim for figure 3: the same ball, two walls.
TEST(QuickThresholds, AThinWallCracksBeforeAThickOne) {
    for (const uint32_t layers : {1u, 2u}) {
        std::vector<double> found;
        for (const float thickness : {0.05f, 0.1f}) {
            CookSettings settings;
            settings.material = "brick", settings.thickness = thickness, settings.longest_edge = 100;
            const Result<Model> wall = cook(view_of(make_wall(2.4f, 1.8f, 0.078f)), settings);
            ASSERT_TRUE(wall.ok()) << wall.error();
            HitBench bench(Subject::Wall, *wall);
            QuickSettings quick;
            quick.layers = layers;
            bench.break_quickly(quick, bench.state().structures.first_crack_speed[bench.shell()]);
            MedianSpread crack;
            const MedianSpread piece = first_pieces(bench, 2, crack);
            std::printf("wall of %.2f m, %u layers: first crack %.2f m/s, first piece %.2f\n",
                        static_cast<double>(thickness), layers, crack.median, piece.median);
            found.push_back(crack.median);
        }
        EXPECT_LT(found[0], found[1]) << layers << " layers";
    }
}

}  // namespace
}  // namespace cullet
