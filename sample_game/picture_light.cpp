#include "sample_game/picture_light.hpp"

#include <algorithm>
#include <array>

namespace cullet {

namespace {

const Vec3 kBounce{0.36f, 0.345f, 0.32f};  // light that comes up from the ground
constexpr float kSkyStrength = 0.78f;
constexpr float kGroundBlocks = 0.45f;  // a ray that meets the ground nearby counts as blocked by this much

constexpr uint32_t kBayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

uint32_t mixed(uint32_t x) {  // finaliser of MurmurHash3
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}
float unit(uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

struct Point3 {
    float a, b, c;  // in [0, 1)
};

// Point n of Roberts' R3 sequence, shifted by a hash of the 4 x 4 tile: even within a tile, without bands from tile to
// tile. Its steps are powers of 1 / 1.2207, the root of x^4 = x + 1, as fixed-point fractions.
Point3 point_of(uint32_t x, uint32_t y, uint32_t sample, uint32_t stream) {
    const uint32_t n = 16 * sample + kBayer[y & 3][x & 3];
    const uint32_t tile = mixed(mixed((x >> 2) + 0x9e3779b9u * stream) + (y >> 2));
    return {unit(tile + n * 0xd1b54a33u), unit(mixed(tile + 1) + n * 0xabc98389u),
            unit(mixed(tile + 2) + n * 0x8cb92ba7u)};
}

struct PlaneTurn {
    float cosine, sine;
};

// 1024 directions are finer than any shadow edge drawn with them.
std::array<PlaneTurn, 1024> turns() {
    std::array<PlaneTurn, 1024> table;
    for (int i = 0; i < 1024; ++i) {
        double sine, cosine;
        sine_cosine(i * (6.283185307179586 / 1024), sine, cosine);
        table[i] = {static_cast<float>(cosine), static_cast<float>(sine)};
    }
    return table;
}

PlaneTurn turn_of(float share) {
    static const std::array<PlaneTurn, 1024> table = turns();
    return table[static_cast<size_t>(share * 1024)];
}

// Two unit vectors across n (Duff et al. 2017).
void across(Vec3 n, Vec3& t, Vec3& b) {
    const float sign = n.z < 0 ? -1.0f : 1.0f, a = -1 / (sign + n.z), xy = n.x * n.y * a;
    t = {1 + sign * n.x * n.x * a, sign * xy, -sign * n.x};
    b = {xy, sign + n.y * n.y * a, -n.y};
}

Vec3 times(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

Vec3 hemisphere(Vec3 normal) {
    const float up = 0.5f + 0.5f * normal.y;
    const Vec3 sky = kSkyStrength * (0.5f * (sky_light({0, 1, 0}) + sky_light({1, 0, 0})));
    return up * sky + (1 - up) * kBounce;
}

// Schlick's share of light that a surface of refractive index 1.5 mirrors.
float mirrored(float cosine, float facing = 0.04f) {
    const float m = 1 - std::clamp(cosine, 0.0f, 1.0f);
    return facing + (1 - facing) * (m * m) * (m * m) * m;
}

/// x to a power of two.
float raised(float x, float power) {
    for (float p = 1; p < power; p *= 2) x *= x;
    return x;
}

/// x from above 0 to 1, to a power from 1 to 4: by straight lines between whole ones.
float raised_to(float x, float power) {
    float low = x;
    while (power >= 2) low *= x, power -= 1;
    return low * (1 - (power - 1) * (1 - x));
}

/// The ground far away is half sky.
Vec3 hazed(const SeenSurface& surface, Vec3 direction, Vec3 seen) {
    if (surface.body != kGroundBody) return seen;
    const float half_haze = surface.has_finish ? 200 : 60;  // m
    const float far = surface.distance / half_haze, haze = far * far / (1 + far * far);
    const Vec3 level = normalised(Vec3{direction.x, 0, direction.z});
    return (1 - haze) * seen + haze * (surface.has_finish ? clear_sky(level) : sky_light(level));
}

float to_the_64th(float x) {
    for (int k = 0; k < 6; ++k) x *= x;
    return x;
}

}  // namespace

PictureLight::PictureLight(const PictureScene& scene, const Sun& sun, const PictureSettings& settings)
    : scene_(scene),
      settings_(settings),
      towards_(normalised(sun.towards)),
      sunlight_(sun.strength * sun.colour),
      angular_radius_(sun.angular_radius) {
    across(towards_, across_, aside_);
}

// A surface that faces away gets no sun and costs no rays.
float PictureLight::sun_share(const SeenSurface& surface, uint32_t x, uint32_t y, uint32_t first,
                              uint32_t count) const {
    if (dot(surface.normal, towards_) <= 0) return 0;
    float sum = 0;
    for (uint32_t k = first; k < first + count; ++k) {
        const Point3 p = point_of(x, y, k, 0);
        const float radius = angular_radius_ * std::sqrt(p.a);
        const PlaneTurn turn = turn_of(p.b);
        const Vec3 direction = towards_ + radius * (turn.cosine * across_ + turn.sine * aside_);
        sum += scene_.passes(surface.point, direction);
    }
    return sum / static_cast<float>(count);
}

// Rays are denser towards the normal (by the cosine) and of uneven reach, so that a nearer blocker darkens more.
float PictureLight::sky_share(const SeenSurface& surface, uint32_t x, uint32_t y, uint32_t first,
                              uint32_t count) const {
    Vec3 t, b;
    across(surface.normal, t, b);
    float sum = 0;
    for (uint32_t k = first; k < first + count; ++k) {
        const Point3 p = point_of(x, y, k, 1);
        const float radius = std::sqrt(p.a);
        const PlaneTurn turn = turn_of(p.b);
        Vec3 direction = radius * (turn.cosine * t + turn.sine * b) + std::sqrt(1 - p.a) * surface.normal;
        const float below = dot(direction, surface.face_normal);
        if (below < 0) direction = direction - 2 * below * surface.face_normal;
        const float reach = settings_.ambient_reach * (0.1f + 0.9f * p.c * p.c);
        const float end = surface.point.y + reach * direction.y;
        if (scene_.is_near(surface.point, direction, reach)) continue;
        const bool meets_ground = settings_.has_ground && surface.body != kGroundBody && end < settings_.ground_height;
        sum += meets_ground ? 1 - kGroundBlocks : 1;
    }
    return sum / static_cast<float>(count);
}

Vec3 PictureLight::shaded(const SeenSurface& surface, const Light& light, Vec3 direction) const {
    if (surface.body == kSkyBody) return surface.colour;
    if (surface.has_finish) return hazed(surface, direction, finished(surface, light, direction));
    const float facing = std::max(0.0f, dot(surface.normal, towards_));
    const Vec3 falling = (light.sun * facing) * sunlight_ + light.sky * hemisphere(surface.normal);
    Vec3 seen = times(surface.colour, falling);
    if (surface.gloss > 0) {
        const float highlight = to_the_64th(std::max(0.0f, dot(surface.normal, normalised(towards_ - direction))));
        const Vec3 mirror = direction - 2 * dot(direction, surface.normal) * surface.normal;
        const float mirrors = surface.gloss * mirrored(-dot(direction, surface.normal));
        seen += (surface.gloss * light.sun * highlight) * sunlight_ + (mirrors * light.sky) * sky_light(mirror);
    }
    return hazed(surface, direction, seen);
}

Vec3 PictureLight::finished(const SeenSurface& surface, const Light& light, Vec3 direction) const {
    const float facing = std::max(0.0f, dot(surface.normal, towards_)), towards_eye = -dot(surface.normal, direction);
    const Vec3 falling = (light.sun * facing) * sunlight_ + light.sky * hemisphere(surface.normal);
    Vec3 seen = times(surface.colour, falling);
    if (surface.sheen > 0) {
        const float grazing = 1 - std::clamp(towards_eye, 0.0f, 1.0f);
        seen += (surface.sheen * grazing * grazing * grazing) * times(2 * surface.colour, falling);
    }
    if (surface.gloss == 0) return seen;
    const float share = surface.gloss * mirrored(towards_eye, surface.facing);
    const float closeness = std::max(0.0f, dot(surface.normal, normalised(towards_ - direction)));
    const float highlight = 0.125f * (surface.sharpness + 8) * raised(closeness, surface.sharpness);
    const Vec3 around = light.sky * mirrored_light(surface, direction);
    const Vec3 shine = times(surface.mirror, around + std::min(40.0f, light.sun * facing * highlight) * sunlight_);
    return (1 - (surface.facing < 0.5f ? share : 0)) * seen + share * shine;
}

// A dull mirror shows a broad piece of what is around, by rays turned anew at each place.
Vec3 PictureLight::mirrored_light(const SeenSurface& surface, Vec3 direction) const {
    constexpr uint32_t kDullRays = 5;
    const auto mirror = [&](Vec3 normal) { return direction - 2 * dot(direction, normal) * normal; };
    const Vec3 dull = hemisphere(mirror(surface.normal));
    if (surface.spread > 0.7f) return dull;
    if (surface.spread < 0.2f)
        return surface.spread * dull + (1 - surface.spread) * met_by(surface, mirror(surface.normal));
    Vec3 t, b, sum{};
    across(surface.normal, t, b);
    const Vec3 place = 1e3f * surface.point;  // places are at most 1e6 m away
    const uint32_t start = mixed(mixed(mixed(static_cast<uint32_t>(static_cast<int32_t>(place.x))) +
                                       static_cast<uint32_t>(static_cast<int32_t>(place.y))) +
                                 static_cast<uint32_t>(static_cast<int32_t>(place.z)));
    for (uint32_t k = 0; k < kDullRays; ++k) {
        const PlaneTurn turn = turn_of(unit(start + k * 0x9e3779b9u));
        const float radius = 0.5f * surface.spread * std::sqrt((static_cast<float>(k) + 0.5f) / kDullRays);
        sum += met_by(surface, mirror(normalised(surface.normal + radius * (turn.cosine * t + turn.sine * b))));
    }
    return (1.0f / kDullRays) * sum;
}

// Things in full sun without shadows, which nobody misses in a mirror.
Vec3 PictureLight::met_by(const SeenSurface& surface, Vec3 mirror) const {
    constexpr float kWide = 0.01f;  // rad, of the mirrored ray
    const SeenSurface met = scene_.opaque(surface.point, mirror, kWide);
    // The air about the sun is bright.
    if (met.body == kSkyBody) return met.colour + raised(std::max(0.0f, dot(mirror, towards_)), 8) * sunlight_;
    const float facing = std::max(0.0f, dot(met.normal, towards_));
    return hazed(met, mirror, times(met.colour, (0.8f * facing) * sunlight_ + 0.8f * hemisphere(met.normal)));
}

Vec3 PictureLight::through(const SeenSurface& glass, Vec3 direction, Vec3 behind) const {
    if (glass.has_finish) return clear(glass, direction, behind);
    const float mirrors = mirrored(-dot(direction, glass.normal));
    const float edge = glass.kind == FaceKind::Crack ? 0.35f : 0.0f;  // the rim of a pane is where its colour shows
    const float opacity = std::min(1.0f, glass.opacity + edge);
    const float facing = std::max(0.0f, dot(glass.normal, towards_));
    const Vec3 own = times(glass.colour, (0.5f * facing + 0.2f) * sunlight_ + hemisphere(glass.normal));
    const float highlight = to_the_64th(std::max(0.0f, dot(glass.normal, normalised(towards_ - direction))));
    const Vec3 mirror = direction - 2 * dot(direction, glass.normal) * glass.normal;
    const Vec3 inside = (1 - opacity) * behind + opacity * own;
    return (1 - mirrors) * inside + mirrors * sky_light(mirror) + (glass.gloss * highlight) * sunlight_;
}

// A broken edge of glass is where light comes out that ran along it: brighter and greener than the pane.
Vec3 PictureLight::clear(const SeenSurface& glass, Vec3 direction, Vec3 behind) const {
    constexpr float kEdge = 0.7f;
    const float towards_eye = -dot(glass.normal, direction), mirrors = mirrored(towards_eye, glass.facing);
    const float closeness = std::max(0.0f, dot(glass.normal, normalised(towards_ - direction)));
    const float highlight = 0.125f * (glass.sharpness + 8) * raised(closeness, glass.sharpness);
    // The way through is longer, the more it slants.
    const float way = 1 / std::max(0.25f, towards_eye);
    const Vec3 passed{raised_to(glass.colour.x, way), raised_to(glass.colour.y, way), raised_to(glass.colour.z, way)};
    Vec3 inside = times(passed, behind);
    if (glass.kind == FaceKind::Crack)
        inside = (1 - kEdge) * times(glass.colour, behind) +
                 kEdge * times(glass.colour, 1.15f * hemisphere(glass.normal) + 0.25f * sunlight_);
    return (1 - mirrors) * inside +
           mirrors * (mirrored_light(glass, direction) + std::min(40.0f, highlight) * sunlight_);
}

}  // namespace cullet
