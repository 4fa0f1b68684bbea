#include "sample_game/finish.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cullet {

namespace {

uint32_t mixed(uint32_t x) {  // finaliser of MurmurHash3
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

/// In [0, 1), by three whole numbers.
float chance(int32_t x, int32_t y, int32_t z) {
    const uint32_t bits =
        mixed(mixed(mixed(static_cast<uint32_t>(x)) + static_cast<uint32_t>(y)) + static_cast<uint32_t>(z));
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// Far from the origin a pattern may lose its detail; it must not overflow.
int32_t whole(float x) {
    return static_cast<int32_t>(std::floor(std::clamp(x, -1e6f, 1e6f)));
}

Vec3 between(Vec3 a, Vec3 b, float share) {
    return (1 - share) * a + share * b;
}

/// Smooth noise from -1 to 1 with bumps about 1 wide.
float noise(Vec3 p) {
    const int32_t x = whole(p.x), y = whole(p.y), z = whole(p.z);
    const auto eased = [](float t) { return std::clamp(t, 0.0f, 1.0f); };
    float u = eased(p.x - static_cast<float>(x)), v = eased(p.y - static_cast<float>(y)),
          w = eased(p.z - static_cast<float>(z));
    u = u * u * (3 - 2 * u), v = v * v * (3 - 2 * v), w = w * w * (3 - 2 * w);
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        sum += (i ? u : 1 - u) * (j ? v : 1 - v) * (l ? w : 1 - w) * chance(x + i, y + j, z + l);
    }
    return 2 * sum - 1;
}

/// How much of what is `size` wide can be seen.
float seen_share(float size, float footprint) {
    return std::clamp(1.5f - 1.5f * footprint / size, 0.0f, 1.0f);
}

/// Noise with bumps of `size` m and finer ones, as far as they can be seen.
float grain(Vec3 p, float size, float footprint, int octaves = 3) {
    float sum = 0, strength = 1;
    for (int k = 0; k < octaves; ++k, size *= 0.5f, strength *= 0.6f) {
        const float share = seen_share(size, footprint);
        if (share == 0) break;
        sum += share * strength * noise((1 / size) * p + Vec3{7.3f * static_cast<float>(k), 0, 0});
    }
    return sum;
}

/// How a broken face is uneven, with bumps of `size` m: by its place alone, so that both sides of a crack match.
Vec3 broken(const FinishPlace& place, float size, float strength) {
    const Vec3 p = place.point;
    return strength * Vec3{grain(p, size, place.footprint), grain({p.y + 3.1f, p.z, p.x}, size, place.footprint),
                           grain({p.z, p.x + 5.7f, p.y}, size, place.footprint)};
}

/// Integral from 0 to x of the pattern that is 1 within `half` of every multiple of `period`.
float line_integral(float x, float period, float half) {
    const float nearest = std::floor(x / period + 0.5f);
    return 2 * half * nearest + std::clamp(x - nearest * period, -half, half);
}

/// Share of the footprint about x that lies within `half` of multiples of `period`.
float cover(float x, float period, float half, float footprint) {
    const float width = std::max(footprint, 0.1f * half);
    return std::clamp(
        (line_integral(x + 0.5f * width, period, half) - line_integral(x - 0.5f * width, period, half)) / width, 0.0f,
        1.0f);
}

/// The two directions along a surface: u along it, v upwards where it stands. Axis 0 to 2: the normal is next to it.
struct Flat {
    float u, v;
    int axis;
};
Flat flat_of(Vec3 point, Vec3 normal) {
    const float x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    if (y > 0.8f * std::max(x, z) && y > 0.6f) return {point.x, point.z, 1};
    return x > z ? Flat{point.z, point.y, 0} : Flat{point.x, point.y, 2};
}

Vec3 brick_colour(float chance_of_it) {
    const Vec3 dark{0.25f, 0.075f, 0.05f}, middle{0.38f, 0.125f, 0.075f}, light{0.46f, 0.20f, 0.115f};
    return chance_of_it < 0.5f ? between(dark, middle, 2 * chance_of_it) : between(middle, light, 2 * chance_of_it - 1);
}

// Where walls of brick lean they are a roof: tiles of 20 x 26 cm, each row over the one below.
FinishLook roof_tile(const FinishPlace& place) {
    constexpr float kWide = 0.20f, kRise = 0.17f;
    const float across = std::fabs(place.normal.x) > std::fabs(place.normal.z) ? place.point.z : place.point.x;
    const int32_t row = whole(place.point.y / kRise);
    const float along = across + (row & 1 ? 0.5f * kWide : 0.0f);
    const float shows = seen_share(kRise, place.footprint);
    const float up = place.point.y / kRise - static_cast<float>(row), side = along / kWide - std::floor(along / kWide);
    const float lip = shows * (up < 0.16f ? 1.0f : 0.0f), round = shows * (side - 0.5f);
    const float own = shows * (chance(whole(along / kWide), row, 3) - 0.5f);
    const float rough = grain(place.point, 0.03f, place.footprint);
    FinishLook look;
    look.colour = (1 + 0.35f * own + 0.08f * rough - 0.45f * lip) * Vec3{0.235f, 0.085f, 0.055f};
    const bool is_along_z = std::fabs(place.normal.x) > std::fabs(place.normal.z);
    look.tilt = 0.5f * round * (is_along_z ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
    look.gloss = 0.2f;
    look.sharpness = 16;
    look.spread = 0.8f;
    return look;
}

// Bricks of 24 x 7.1 cm with joints of 12 mm, in stretcher bond. Where a crack runs through them, joints are level.
FinishLook brick(const FinishPlace& place) {
    constexpr float kLength = 0.25f, kHeight = 1.0f / 12, kJoint = 0.012f;
    const bool is_crack = place.kind == FaceKind::Crack;
    const bool is_roof =
        place.kind == FaceKind::Outer && !place.is_model && place.normal.y > 0.3f && place.normal.y < 0.97f;
    if (is_roof) return roof_tile(place);
    const Flat flat = flat_of(place.point, place.normal);
    const float height = is_crack ? place.point.y : flat.v;
    const int32_t course = whole(height / kHeight);
    const float along = flat.u + (course & 1 ? 0.5f * kLength : 0.0f);
    const int32_t number = is_crack ? whole((place.point.x + place.point.z) / kLength) : whole(along / kLength);
    const float level = cover(height, kHeight, 0.5f * kJoint, place.footprint);
    const float upright = is_crack ? 0.0f : cover(along, kLength, 0.5f * kJoint, place.footprint);
    const float joint = 1 - (1 - level) * (1 - upright);
    const float rough = grain(place.point, 0.02f, place.footprint, 4);
    const float own = 0.5f + (chance(number, course, flat.axis) - 0.5f) * seen_share(kHeight, place.footprint);
    Vec3 colour = (1 + 0.16f * rough) * brick_colour(own);
    if (is_crack) colour = (1 + 0.22f * rough) * between(colour, {0.56f, 0.23f, 0.135f}, 0.65f);
    const Vec3 mortar = (1 + 0.1f * rough) * Vec3{0.40f, 0.385f, 0.35f};
    FinishLook look;
    look.colour = between(colour, mortar, joint);
    if (is_crack) {
        look.tilt = broken(place, 0.012f, 0.35f);
        return look;
    }
    // Joints lie deeper: edges of bricks are round.
    const float share = seen_share(0.004f, place.footprint);
    const auto bevel = [](float x, float period) {
        const float off = x - period * std::floor(x / period + 0.5f), far = std::fabs(off);
        return far > 0.5f * kJoint - 0.002f && far < 0.5f * kJoint + 0.005f ? (off > 0 ? -1.0f : 1.0f) : 0.0f;
    };
    const float up = -0.55f * share * bevel(height, kHeight), side = -0.55f * share * bevel(along, kLength);
    const float bump = 0.10f * rough;
    look.tilt = flat.axis == 0   ? Vec3{0, up + bump, side - bump}
                : flat.axis == 1 ? Vec3{side - bump, 0, up + bump}
                                 : Vec3{side - bump, up + bump, 0};
    return look;
}

FinishLook porcelain(const FinishPlace& place) {
    FinishLook look;
    if (place.kind == FaceKind::Crack) {  // unglazed: dull, a little rough
        const float rough = grain(place.point, 0.002f, place.footprint);
        look.colour = (1 + 0.10f * rough) * Vec3{0.66f, 0.56f, 0.45f};
        look.tilt = broken(place, 0.004f, 0.10f);
        return look;
    }
    const float cloud = noise(14.0f * place.point);
    look.colour = (1 + 0.012f * cloud) * Vec3{0.695f, 0.71f, 0.715f};
    look.gloss = 1;
    look.facing = 0.06f;
    look.sharpness = 512;
    return look;
}

FinishLook concrete(const FinishPlace& place) {
    const float stain = noise(1.7f * place.point) + 0.6f * noise(6.1f * place.point);
    const float rough = grain(place.point, 0.012f, place.footprint, 4);
    FinishLook look;
    if (place.kind == FaceKind::Crack) {  // gravel in cement
        const Vec3 p = 55.0f * place.point;
        const float stone = chance(whole(p.x + 0.4f * noise(p)), whole(p.y + 0.4f * noise(1.1f * p)), whole(p.z));
        const float shows = seen_share(0.018f, place.footprint) * (stone > 0.55f ? 1.0f : 0.0f);
        look.colour = (1 + 0.15f * rough) *
                      between({0.47f, 0.45f, 0.42f}, (0.25f + 0.5f * stone) * Vec3{0.80f, 0.74f, 0.66f}, shows);
        look.tilt = broken(place, 0.018f, 0.40f);
        return look;
    }
    const float pore = seen_share(0.008f, place.footprint) * std::max(0.0f, noise(90.0f * place.point) - 0.72f);
    look.colour = (1 + 0.06f * stain + 0.035f * rough - 1.2f * pore) * Vec3{0.45f, 0.445f, 0.43f};
    look.tilt = 0.012f * rough * Vec3{1, 1, -1};
    return look;
}

// Brushed along x, and along y where it stands across that; what has much gloss is polished.
FinishLook metal(const FinishPlace& place, Vec3 colour, float gloss) {
    const bool is_end = std::fabs(place.normal.x) > 0.8f;
    const Vec3 p = place.point;
    const Vec3 stretched = is_end ? Vec3{p.z, p.y / 30, p.x} : Vec3{p.x / 30, p.y, p.z};
    const float brushed = grain(stretched, 0.016f, place.footprint, 5);
    const bool is_torn = place.kind == FaceKind::Crack, is_polished = gloss > 0.5f;
    FinishLook look;
    look.colour = (is_torn ? 0.75f : is_polished ? 0.12f : 0.30f) * colour;
    look.mirror = (is_polished ? 1 : 1 + 0.10f * brushed) * colour;
    look.gloss = is_torn ? 0.35f : 0.85f;
    look.facing = 0.75f;
    look.sharpness = is_torn ? 16 : is_polished ? 256 : 32;
    look.spread = is_torn ? 0.8f : is_polished ? 0.08f : 0.45f;
    if (is_polished) return look;
    look.tilt = is_end ? Vec3{0, 0, 0.035f * brushed} : Vec3{0, 0.035f * brushed, 0.035f * brushed};
    return look;
}

// Grown along y, the ring's middle beside the thing.
FinishLook wood(const FinishPlace& place) {
    constexpr float kRing = 0.011f;
    const Vec3 p = place.point, slow{2.2f * p.x, 0.35f * p.y, 2.2f * p.z};
    const float x = p.x + 0.11f + 0.05f * noise(slow), z = p.z + 0.05f + 0.05f * noise(slow + Vec3{9, 0, 4});
    const float ring = std::sqrt(x * x + z * z) / kRing;
    const float late = ring - std::floor(ring);
    const float shows = seen_share(kRing, place.footprint);
    const float dark = 0.5f + shows * (late * late * late - 0.5f) * 0.9f;
    const float fibre = grain({p.x, p.y / 25, p.z}, 0.004f, place.footprint);
    FinishLook look;
    look.colour =
        (1 + 0.12f * fibre) * between({0.33f, 0.185f, 0.085f}, {0.19f, 0.095f, 0.04f}, std::clamp(dark, 0.0f, 1.0f));
    if (place.kind == FaceKind::Crack) {
        look.colour = (1 + 0.30f * fibre) * Vec3{0.60f, 0.42f, 0.23f};
        return look;
    }
    look.gloss = 0.35f;
    look.sharpness = 32;
    look.spread = 0.6f;
    return look;
}

// Gingham of 4 cm, threads of 4 mm. It lies in x and y, as sheets do that are cooked; where it stands across them, in
// z.
FinishLook cloth(const FinishPlace& place) {
    constexpr float kCheck = 0.08f, kThread = 0.004f;
    const Vec3 p = place.point, n = place.normal;
    const bool is_flat = std::fabs(n.z) > 0.2f;
    const float u = is_flat || std::fabs(n.y) > std::fabs(n.x) ? p.x : p.z,
                v = is_flat || std::fabs(n.y) <= std::fabs(n.x) ? p.y : p.z;
    const float warp = cover(u, kCheck, 0.25f * kCheck, place.footprint),
                weft = cover(v, kCheck, 0.25f * kCheck, place.footprint);
    const int32_t i = whole(u / kThread), j = whole(v / kThread);
    const float shows = seen_share(kThread, place.footprint);
    const bool is_over = ((i + j) & 1) != 0;  // which of both threads is seen
    const float mean = 0.5f * (warp + weft);
    const float dyed = mean + shows * ((is_over ? warp : weft) - mean);
    const float across = is_over ? u / kThread - static_cast<float>(i) : v / kThread - static_cast<float>(j);
    const float round = shows * 0.55f * (4 * across * (1 - across) - 0.67f);
    FinishLook look;
    look.colour = (1 + round + 0.06f * noise(9.0f * p)) * between({0.70f, 0.66f, 0.58f}, {0.36f, 0.055f, 0.06f}, dyed);
    look.sheen = 0.22f;
    if (place.kind == FaceKind::Crack) look.colour = {0.66f, 0.60f, 0.52f};
    return look;
}

FinishLook rubber(const FinishPlace& place) {
    const float dust = noise(11.0f * place.point) + grain(place.point, 0.01f, place.footprint);
    FinishLook look;
    look.colour = (1 + 0.10f * dust) * Vec3{0.040f, 0.041f, 0.044f};
    if (place.kind == FaceKind::Crack) look.colour = {0.075f, 0.073f, 0.07f};
    look.gloss = 0.7f;
    look.sharpness = 8;
    look.spread = 0.85f;
    look.sheen = 0.5f;
    return look;
}

/// The colour is what light has after a way through it.
FinishLook glass(const FinishPlace& place) {
    FinishLook look;
    look.colour = place.kind == FaceKind::Crack ? Vec3{0.34f, 0.60f, 0.50f} : Vec3{0.965f, 0.99f, 0.98f};
    look.gloss = 1;
    look.sharpness = 512;
    return look;
}

FinishLook plain(const FinishPlace& place, Vec3 own, float gloss, bool is_floor) {
    FinishLook look;
    look.gloss = gloss;
    const float rough =
        0.6f * grain(place.point, is_floor ? 0.03f : 0.02f, place.footprint) + noise(1.3f * place.point);
    look.colour = (1 + 0.035f * rough) * own;
    return look;
}

}  // namespace

Finish finish_of(const std::string& material) {
    constexpr std::pair<const char*, Finish> kFinishes[] = {
        {"porcelain", Finish::Porcelain}, {"brick", Finish::Brick}, {"concrete", Finish::Concrete},
        {"glass", Finish::Glass},         {"steel", Finish::Steel}, {"aluminium", Finish::Aluminium},
        {"copper", Finish::Copper},       {"wood", Finish::Wood},   {"cloth", Finish::Cloth},
        {"rubber", Finish::Rubber}};
    for (const auto& [name, finish] : kFinishes)
        if (material == name) return finish;
    return Finish::Plain;
}

FinishLook finish_at(Finish finish, const FinishPlace& place, Vec3 own, float own_gloss) {
    switch (finish) {
        case Finish::Porcelain:
            return porcelain(place);
        case Finish::Brick:
            return brick(place);
        case Finish::Concrete:
            return concrete(place);
        case Finish::Glass:
            return glass(place);
        case Finish::Steel:
            return metal(place, {0.63f, 0.635f, 0.64f}, own_gloss);
        case Finish::Aluminium:
            return metal(place, {0.78f, 0.79f, 0.80f}, own_gloss);
        case Finish::Copper:
            return metal(place, {0.80f, 0.40f, 0.24f}, own_gloss);
        case Finish::Wood:
            return wood(place);
        case Finish::Cloth:
            return cloth(place);
        case Finish::Rubber:
            return rubber(place);
        case Finish::Plain:
        case Finish::Floor:
            break;
    }
    return plain(place, own, own_gloss, finish == Finish::Floor);
}

}  // namespace cullet
