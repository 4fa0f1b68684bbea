#include "sample_game/sheet.hpp"

#include <algorithm>
#include <cmath>

#include "engine/math.hpp"
#include "sample_game/palette.hpp"

namespace cullet {

namespace {

constexpr uint8_t kBackground = 40, kInk = 250, kRim = 30;       // sRGB greys
constexpr uint32_t kGlyphWidth = 5, kGlyphHeight = 7, kPen = 2;  // a glyph's dot is kPen pixels wide

// Rows from the top, bit 4 is the left dot.
constexpr uint8_t kDigits[10][kGlyphHeight] = {
    {14, 17, 17, 17, 17, 17, 14}, {4, 12, 4, 4, 4, 4, 14},    {14, 17, 1, 2, 4, 8, 31},   {31, 2, 4, 2, 1, 17, 14},
    {2, 6, 10, 18, 31, 2, 2},     {31, 16, 30, 1, 1, 17, 14}, {6, 8, 16, 30, 17, 17, 14}, {31, 1, 2, 4, 8, 8, 8},
    {14, 17, 17, 14, 17, 17, 14}, {14, 17, 17, 15, 1, 2, 12},
};

struct Rectangle {
    uint32_t x, y, width, height;
};

void fill(Picture& picture, Rectangle r, uint8_t grey) {
    for (uint32_t y = r.y; y < std::min(picture.height, r.y + r.height); ++y)
        for (uint32_t x = r.x; x < std::min(picture.width, r.x + r.width); ++x)
            std::fill_n(picture.pixel(x, y), 3, grey);
}

void write_digit(Picture& sheet, uint32_t digit, uint32_t left, uint32_t top, uint8_t grey) {
    for (uint32_t row = 0; row < kGlyphHeight; ++row)
        for (uint32_t column = 0; column < kGlyphWidth; ++column)
            if (kDigits[digit][row] >> (kGlyphWidth - 1 - column) & 1)
                fill(sheet, {left + kPen * column, top + kPen * row, kPen, kPen}, grey);
}

// Light digits with a dark rim of one pixel, legible on any picture.
void write_number(Picture& sheet, uint32_t number, uint32_t left, uint32_t top) {
    const std::string text = std::to_string(number);
    const auto write = [&](uint32_t x, uint32_t y, uint8_t grey) {
        for (uint32_t k = 0; k < text.size(); ++k)
            write_digit(sheet, static_cast<uint32_t>(text[k] - '0'), x + k * (kGlyphWidth + 2) * kPen, y, grey);
    };
    for (uint32_t y = 0; y < 3; ++y)
        for (uint32_t x = 0; x < 3; ++x) write(left + x, top + y, kRim);
    write(left + 1, top + 1, kInk);
}

// Mean over [x0, x1) x [y0, y1) of the picture, in linear light; pixels cut by the border count by their part inside.
Vec3 mean_light(const Picture& picture, float x0, float x1, float y0, float y1) {
    const auto last = [](float end, uint32_t size) { return std::min(size, static_cast<uint32_t>(std::ceil(end))); };
    Vec3 sum{};
    float weights = 0;
    for (uint32_t y = static_cast<uint32_t>(y0); y < last(y1, picture.height); ++y) {
        const float row = std::min(y1, static_cast<float>(y + 1)) - std::max(y0, static_cast<float>(y));
        for (uint32_t x = static_cast<uint32_t>(x0); x < last(x1, picture.width); ++x) {
            const float part = row * (std::min(x1, static_cast<float>(x + 1)) - std::max(x0, static_cast<float>(x)));
            const uint8_t* rgb = picture.pixel(x, y);
            sum += part * linear_from_srgb(rgb[0], rgb[1], rgb[2]);
            weights += part;
        }
    }
    return weights > 0 ? (1 / weights) * sum : sum;
}

void place(Picture& sheet, const Picture& picture, Rectangle tile) {
    const float width = static_cast<float>(picture.width), height = static_cast<float>(picture.height);
    const float scale = std::max(width / static_cast<float>(tile.width), height / static_cast<float>(tile.height));
    const uint32_t fit_width = std::max(1u, std::min(tile.width, static_cast<uint32_t>(width / scale + 0.5f)));
    const uint32_t fit_height = std::max(1u, std::min(tile.height, static_cast<uint32_t>(height / scale + 0.5f)));
    const uint32_t left = tile.x + (tile.width - fit_width) / 2, top = tile.y + (tile.height - fit_height) / 2;
    const float step_x = width / static_cast<float>(fit_width), step_y = height / static_cast<float>(fit_height);
    for (uint32_t y = 0; y < fit_height; ++y) {
        for (uint32_t x = 0; x < fit_width; ++x) {
            const float x0 = static_cast<float>(x) * step_x, y0 = static_cast<float>(y) * step_y;
            const Vec3 light = mean_light(picture, x0, x0 + step_x, y0, y0 + step_y);
            uint8_t* rgb = sheet.pixel(left + x, top + y);
            rgb[0] = static_cast<uint8_t>(srgb_from_linear(light.x) + 0.5f);
            rgb[1] = static_cast<uint8_t>(srgb_from_linear(light.y) + 0.5f);
            rgb[2] = static_cast<uint8_t>(srgb_from_linear(light.z) + 0.5f);
        }
    }
}

}  // namespace

Picture contact_sheet(std::span<const SheetTile> tiles, const SheetSettings& settings) {
    const uint32_t count = static_cast<uint32_t>(tiles.size());
    const uint32_t columns = std::max(1u, std::min(settings.columns, count));
    const uint32_t rows = (count + columns - 1) / columns, margin = settings.margin;
    if (rows == 0 || settings.tile_width == 0 || settings.tile_height == 0) return {};
    Picture sheet = blank_picture(columns * (settings.tile_width + margin) + margin,
                                  rows * (settings.tile_height + margin) + margin);
    fill(sheet, {0, 0, sheet.width, sheet.height}, kBackground);
    for (uint32_t t = 0; t < count; ++t) {
        const uint32_t left = margin + t % columns * (settings.tile_width + margin);
        const uint32_t top = margin + t / columns * (settings.tile_height + margin);
        if (tiles[t].picture && !tiles[t].picture->rgb.empty())
            place(sheet, *tiles[t].picture, {left, top, settings.tile_width, settings.tile_height});
        write_number(sheet, tiles[t].frame, left + 8, top + 8);
    }
    return sheet;
}

}  // namespace cullet
