#include "sample_game/palette.hpp"

#include <algorithm>
#include <array>

#include "engine/math.hpp"

namespace cullet {

namespace {

constexpr uint8_t kBodyColour[3] = {192, 184, 172};  // warm grey
constexpr uint32_t kHueCount = 12;
constexpr uint8_t kHues[kHueCount][3] = {
    {98, 164, 92},    // muted green
    {198, 162, 58},   // ochre
    {198, 98, 72},    // terracotta
    {74, 134, 190},   // blue
    {72, 164, 166},   // teal
    {128, 128, 72},   // olive
    {190, 106, 148},  // pink
    {142, 100, 190},  // violet
    {172, 136, 104},  // tan
    {118, 170, 140},  // sea green
    {214, 138, 96},   // apricot
    {104, 112, 176},  // slate blue
};

double to_linear(double s) {
    return s <= 0.04045 ? s / 12.92 : exponential(2.4 * logarithm((s + 0.055) / 1.055));
}
double to_srgb(double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * exponential(logarithm(l) / 2.4) - 0.055;
}

// Steps of 1/4096; between them a straight line, wrong by less than a third of a level in the darkest 20 steps.
constexpr int kSteps = 4096;

std::array<float, kSteps + 2> encoding_table() {
    std::array<float, kSteps + 2> table{};
    for (int i = 0; i < kSteps + 2; ++i) table[i] = static_cast<float>(255.0 * to_srgb(std::min(1.0, i / 4096.0)));
    return table;
}

std::array<float, 256> decoding_table() {
    std::array<float, 256> table{};
    for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(to_linear(i / 255.0));
    return table;
}

}  // namespace

float linear_from_srgb(uint8_t value) {
    static const std::array<float, 256> table = decoding_table();
    return table[value];
}

Vec3 linear_from_srgb(uint8_t red, uint8_t green, uint8_t blue) {
    return {linear_from_srgb(red), linear_from_srgb(green), linear_from_srgb(blue)};
}

float srgb_from_linear(float light) {
    static const std::array<float, kSteps + 2> table = encoding_table();
    const float at = kSteps * (light > 0 ? std::min(light, 1.0f) : 0.0f);  // not a number becomes black
    const int step = static_cast<int>(at);
    return table[step] + (at - static_cast<float>(step)) * (table[step + 1] - table[step]);
}

Vec3 fragment_colour(uint32_t id) {
    if (id == 0) return linear_from_srgb(kBodyColour[0], kBodyColour[1], kBodyColour[2]);
    const uint32_t hue = (id - 1) % kHueCount, round = (id - 1) / kHueCount;
    constexpr float kBrightness[4] = {1.0f, 0.7f, 1.14f, 0.85f};
    const uint8_t* own = kHues[hue];
    const uint8_t* next = kHues[(hue + 1 + round / 4) % kHueCount];
    const float mixed = 0.12f * static_cast<float>(round % 4);
    const Vec3 colour =
        (1 - mixed) * linear_from_srgb(own[0], own[1], own[2]) + mixed * linear_from_srgb(next[0], next[1], next[2]);
    return kBrightness[round % 4] * colour;
}

}  // namespace cullet
