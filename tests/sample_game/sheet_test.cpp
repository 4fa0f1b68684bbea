#include "sample_game/sheet.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace cullet {
namespace {

Picture plain(uint32_t width, uint32_t height, uint8_t grey) {
    Picture picture = blank_picture(width, height);
    std::fill(picture.rgb.begin(), picture.rgb.end(), grey);
    return picture;
}

TEST(Sheet, TwelvePicturesStandInThreeRowsOfFourInOrder) {
    std::vector<Picture> pictures;
    for (uint32_t k = 0; k < 12; ++k) pictures.push_back(plain(96, 54, static_cast<uint8_t>(60 + 10 * k)));
    std::vector<SheetTile> tiles;
    for (uint32_t k = 0; k < 12; ++k) tiles.push_back({&pictures[k], 100 * k});
    const SheetSettings settings{4, 48, 27, 3};
    const Picture sheet = contact_sheet(tiles, settings);
    EXPECT_EQ(sheet.width, 4 * 51 + 3u);
    EXPECT_EQ(sheet.height, 3 * 30 + 3u);
    for (uint32_t k = 0; k < 12; ++k)
        EXPECT_EQ(sheet.pixel(3 + k % 4 * 51 + 46, 3 + k / 4 * 30 + 26)[1], 60 + 10 * k) << "tile " << k;
}

TEST(Sheet, ACheckerboardScalesToHalfTheLightNotToHalfTheByte) {
    Picture board = blank_picture(64, 64);
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x) std::fill_n(board.pixel(x, y), 3, static_cast<uint8_t>((x + y) % 2 * 255));
    const SheetTile tile{&board, 0};
    const Picture sheet = contact_sheet(std::span(&tile, 1), SheetSettings{1, 32, 32, 0});
    EXPECT_EQ(sheet.pixel(31, 31)[0], 188);  // sRGB of 0.5
}

TEST(Sheet, APictureOfAnotherShapeIsFittedInAndAMissingOneLeavesItsTileDark) {
    const Picture tall = plain(10, 100, 200);
    const std::array<SheetTile, 2> tiles{SheetTile{&tall, 1}, SheetTile{nullptr, 2}};
    const Picture sheet = contact_sheet(tiles, SheetSettings{2, 50, 50, 0});
    EXPECT_EQ(sheet.pixel(25, 45)[0], 200);
    EXPECT_LT(sheet.pixel(45, 45)[0], 100);
    EXPECT_LT(sheet.pixel(95, 45)[0], 100);
}

TEST(Sheet, TheFrameNumberIsWrittenLightOverDark) {
    const Picture white = plain(100, 50, 255), black = plain(100, 50, 0);
    for (const Picture* picture : {&white, &black}) {
        const SheetTile tile{picture, 120};
        const Picture sheet = contact_sheet(std::span(&tile, 1), SheetSettings{1, 100, 50, 0});
        int changed = 0;
        for (uint32_t y = 8; y < 24; ++y)
            for (uint32_t x = 8; x < 46; ++x) changed += sheet.pixel(x, y)[0] != picture->pixel(x, y)[0];
        EXPECT_GT(changed, 40);
    }
}

TEST(Sheet, OfNoTilesIsEmpty) {
    EXPECT_TRUE(contact_sheet({}, SheetSettings{}).rgb.empty());
}

}  // namespace
}  // namespace cullet
