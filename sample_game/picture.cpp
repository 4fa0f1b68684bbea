#include "sample_game/picture.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "sample_game/picture_light.hpp"
#include "sample_game/picture_lines.hpp"
#include "sample_game/picture_scene.hpp"

namespace cullet {

namespace {

constexpr uint32_t kRowsPerJob = 8;
constexpr uint32_t kFirstSunRays = 1;  // everywhere
constexpr uint32_t kMoreSunRays = 7;   // where neighbours disagree: half-shadows
constexpr uint32_t kFirstSkyRays = 1;
constexpr uint32_t kMoreSkyRays = 3;  // where something shades the sky
constexpr uint32_t kLostRays = 8;     // for a point between pixels that has no like neighbour
constexpr float kLineDarkness = 0.85f, kHairlineDarkness = 0.75f;
constexpr float kFinishedLineDarkness = 0.5f;  // only of glass, whose cracks are thinner than a pixel
constexpr int kFilterReach = 2;                // pixels; 5 x 5 holds every pixel of the 4 x 4 pattern of rays

// What of a pixel's surface the filter and the edges ask for again and again.
struct Pixel {
    SeenSurface surface;
    uint32_t front = kSkyBody;  // body of the first face, transparent or not
};

struct Point2 {
    float x, y;
};
// Four points of a pixel, turned so that near-vertical and near-horizontal edges meet all four one by one.
constexpr std::array<Point2, 4> kInside{{{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}}};

// Weights of the points of kInside in the 3 x 3 pixels about a pixel: a bell of 0.6 pixels.
using LineBell = std::array<std::array<std::array<float, 4>, 3>, 3>;
LineBell line_bell() {
    LineBell bell;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            for (size_t k = 0; k < kInside.size(); ++k) {
                const float x = static_cast<float>(column) - 1.5f + kInside[k].x;
                const float y = static_cast<float>(row) - 1.5f + kInside[k].y;
                const double squared = static_cast<double>(x * x + y * y);
                bell[row][column][k] = static_cast<float>(exponential(-squared / (2 * 0.6 * 0.6)));
            }
        }
    }
    return bell;
}

bool is_alike(const SeenSurface& a, const SeenSurface& b) {
    return a.body == b.body && a.kind == b.kind && dot(a.normal, b.normal) > 0.85f;
}

// Whether both lie on one continuous surface: neither far behind the other's tangent plane.
bool is_continued(const SeenSurface& a, const SeenSurface& b) {
    if (a.body == kGroundBody || a.body == kSkyBody) return a.body == b.body;
    if (!is_alike(a, b)) return false;
    const Vec3 gap = b.point - a.point;
    const float off = std::max(std::fabs(dot(gap, a.face_normal)), std::fabs(dot(gap, b.face_normal)));
    return off < 0.004f * a.distance + 0.1f * length(gap);
}

class Painter {
 public:
    Painter(std::span<const DrawnBody> bodies, const Camera& camera, const Sun& sun, const PictureSettings& settings);
    Picture paint();

 private:
    void each_row(const std::function<void(uint32_t y)>& job) const;
    Vec3 direction_through(float x, float y) const;
    Pixel sight(Vec3 direction) const;
    Light first_light(uint32_t x, uint32_t y) const;
    Light more_light(uint32_t x, uint32_t y) const;
    Light filtered_light(uint32_t x, uint32_t y) const;
    Light light_like_neighbours(const SeenSurface& surface, uint32_t x, uint32_t y) const;
    bool is_edge(uint32_t x, uint32_t y) const;
    Vec3 seen(const Pixel& pixel, const Light& light, Vec3 direction) const;
    Vec3 colour(uint32_t x, uint32_t y, std::array<uint32_t, 4>& front) const;
    float line(uint32_t x, uint32_t y) const;
    std::vector<float> hairlines() const;
    float line_between(uint32_t a, uint32_t b) const;

    size_t at(uint32_t x, uint32_t y) const { return size_t{y} * settings_.width + x; }
    template <class Visit>
    void visit_neighbours(uint32_t x, uint32_t y, int reach, const Visit& visit) const;

    std::span<const DrawnBody> bodies_;
    const PictureSettings& settings_;
    PictureScene scene_;
    PictureLight light_;
    Vec3 eye_, forward_, right_, up_;  // right and up reach from the middle of a picture of height 2 to its edge
    float pixel_angle_;
    std::vector<Pixel> pixels_;
    std::vector<Light> lights_, other_lights_;
    std::vector<Vec3> colours_;
    std::vector<std::array<uint32_t, 4>> fronts_;  // first body at each point of kInside
};

Painter::Painter(std::span<const DrawnBody> bodies, const Camera& camera, const Sun& sun,
                 const PictureSettings& settings)
    : bodies_(bodies), settings_(settings), scene_(bodies, settings), light_(scene_, sun, settings), eye_(camera.eye) {
    forward_ = normalised(camera.target - camera.eye);
    if (forward_ == Vec3{}) forward_ = {0, 0, -1};
    const Vec3 upright = std::fabs(forward_.y) > 0.999f ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
    double sine, cosine;
    sine_cosine(0.5 * static_cast<double>(camera.vertical_field_of_view), sine, cosine);
    const float spread = static_cast<float>(sine / cosine);
    right_ = spread * normalised(cross(forward_, upright));
    up_ = spread * normalised(cross(right_, forward_));
    pixel_angle_ = 2 * spread / static_cast<float>(settings.height);
    const size_t count = size_t{settings.width} * settings.height;
    pixels_.resize(count);
    lights_.resize(count);
    other_lights_.resize(count);
    colours_.resize(count);
    fronts_.resize(count);
}

void Painter::each_row(const std::function<void(uint32_t y)>& job) const {
    const uint32_t job_count = (settings_.height + kRowsPerJob - 1) / kRowsPerJob;
    const auto rows = [&](uint32_t j) {
        const uint32_t end = std::min(settings_.height, (j + 1) * kRowsPerJob);
        for (uint32_t y = j * kRowsPerJob; y < end; ++y) job(y);
    };
    if (settings_.for_each) return settings_.for_each(job_count, rows);
    for (uint32_t j = 0; j < job_count; ++j) rows(j);
}

template <class Visit>
void Painter::visit_neighbours(uint32_t x, uint32_t y, int reach, const Visit& visit) const {
    const int width = static_cast<int>(settings_.width), height = static_cast<int>(settings_.height);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    for (int v = std::max(0, row - reach); v <= std::min(height - 1, row + reach); ++v)
        for (int u = std::max(0, column - reach); u <= std::min(width - 1, column + reach); ++u)
            visit(static_cast<uint32_t>(u), static_cast<uint32_t>(v), u - column, v - row);
}

// x and y in pixels from the upper left corner.
Vec3 Painter::direction_through(float x, float y) const {
    const float height = static_cast<float>(settings_.height), width = static_cast<float>(settings_.width);
    const float across = (2 * x - width) / height, upwards = 1 - 2 * y / height;
    return normalised(forward_ + across * right_ + upwards * up_);
}

Pixel Painter::sight(Vec3 direction) const {
    Pixel pixel;
    pixel.surface = scene_.opaque(eye_, direction, pixel_angle_);
    pixel.front = pixel.surface.body;
    if (!scene_.has_transparent()) return pixel;
    std::array<SeenSurface, PictureScene::kLayers> layers;
    if (scene_.transparent(eye_, direction, pixel.surface.distance, pixel_angle_, layers) > 0)
        pixel.front = layers[0].body;
    return pixel;
}

Light Painter::first_light(uint32_t x, uint32_t y) const {
    const SeenSurface& surface = pixels_[at(x, y)].surface;
    if (surface.body == kSkyBody) return {};
    return {light_.sun_share(surface, x, y, 0, kFirstSunRays), light_.sky_share(surface, x, y, 0, kFirstSkyRays)};
}

// Casts more rays where a neighbour on the same body saw another share of the sun, and where something shades the sky.
Light Painter::more_light(uint32_t x, uint32_t y) const {
    const SeenSurface& surface = pixels_[at(x, y)].surface;
    Light light = lights_[at(x, y)];
    if (surface.body == kSkyBody) return light;
    bool is_sun_mixed = false, is_sky_shaded = false;
    visit_neighbours(x, y, kFilterReach, [&](uint32_t u, uint32_t v, int du, int dv) {
        const Light& other = lights_[at(u, v)];
        const bool is_close = std::abs(du) <= 1 && std::abs(dv) <= 1;
        if (other.sun == light.sun && (other.sky == 1 || !is_close)) return;
        if (pixels_[at(u, v)].surface.body != surface.body) return;
        is_sun_mixed |= other.sun != light.sun;
        is_sky_shaded |= is_close && other.sky < 1;
    });
    const auto joined = [](float first, uint32_t first_count, float more, uint32_t more_count) {
        const float count = static_cast<float>(first_count + more_count);
        return (static_cast<float>(first_count) * first + static_cast<float>(more_count) * more) / count;
    };
    if (is_sun_mixed)
        light.sun = joined(light.sun, kFirstSunRays, light_.sun_share(surface, x, y, kFirstSunRays, kMoreSunRays),
                           kMoreSunRays);
    if (is_sky_shaded)
        light.sky = joined(light.sky, kFirstSkyRays, light_.sky_share(surface, x, y, kFirstSkyRays, kMoreSkyRays),
                           kMoreSkyRays);
    return light;
}

// Average over the 5 x 5 pixels that continue this one's surface; the sun's share by a narrower bell than the sky's,
// whose shadows are broad.
Light Painter::filtered_light(uint32_t x, uint32_t y) const {
    constexpr float kSkyBell[3] = {1.0f, 0.9f, 0.55f}, kSunBell[3] = {1.0f, 0.8f, 0.4f};
    const SeenSurface& surface = pixels_[at(x, y)].surface;
    const Light own = other_lights_[at(x, y)];
    bool is_even = true;
    visit_neighbours(x, y, kFilterReach, [&](uint32_t u, uint32_t v, int, int) {
        const Light& light = other_lights_[at(u, v)];
        is_even &= light.sun == own.sun && light.sky == own.sky;
    });
    if (is_even || surface.body == kSkyBody) return own;
    float sun = 0, sky = 0, sun_weights = 0, sky_weights = 0;
    visit_neighbours(x, y, kFilterReach, [&](uint32_t u, uint32_t v, int du, int dv) {
        if (!is_continued(surface, pixels_[at(u, v)].surface)) return;
        const Light& light = other_lights_[at(u, v)];
        const float sun_weight = kSunBell[std::abs(du)] * kSunBell[std::abs(dv)];
        const float sky_weight = kSkyBell[std::abs(du)] * kSkyBell[std::abs(dv)];
        sun += sun_weight * light.sun, sun_weights += sun_weight;
        sky += sky_weight * light.sky, sky_weights += sky_weight;
    });
    return {sun / sun_weights, sky / sky_weights};
}

// A point between pixels takes the light of the nearest pixel on its own surface; alone, it casts rays of its own.
Light Painter::light_like_neighbours(const SeenSurface& surface, uint32_t x, uint32_t y) const {
    if (surface.body == kSkyBody) return {};
    Light nearest;
    float least = 1e30f;
    visit_neighbours(x, y, 1, [&](uint32_t u, uint32_t v, int, int) {
        const SeenSurface& other = pixels_[at(u, v)].surface;
        const Vec3 gap = other.point - surface.point;
        if (!is_continued(surface, other) || dot(gap, gap) >= least) return;
        least = dot(gap, gap);
        nearest = lights_[at(u, v)];
    });
    if (least < 1e30f) return nearest;
    return {light_.sun_share(surface, x, y, 0, kLostRays), light_.sky_share(surface, x, y, 0, kLostRays)};
}

bool Painter::is_edge(uint32_t x, uint32_t y) const {
    const Pixel& pixel = pixels_[at(x, y)];
    bool is_found = false;
    visit_neighbours(x, y, 1, [&](uint32_t u, uint32_t v, int, int) {
        const Pixel& other = pixels_[at(u, v)];
        if (other.front != pixel.front || !is_continued(pixel.surface, other.surface)) is_found = true;
    });
    return is_found;
}

Vec3 Painter::seen(const Pixel& pixel, const Light& light, Vec3 direction) const {
    Vec3 colour = light_.shaded(pixel.surface, light, direction);
    if (pixel.front == pixel.surface.body) return colour;
    std::array<SeenSurface, PictureScene::kLayers> layers;
    size_t count = scene_.transparent(eye_, direction, pixel.surface.distance, pixel_angle_, layers);
    while (count > 0) colour = light_.through(layers[--count], direction, colour);
    return colour;
}

// A full line between two outlined bodies, half of one between an outlined body and what stands behind it.
float Painter::line_between(uint32_t a, uint32_t b) const {
    if (a == b) return 0;
    return 0.5f * (static_cast<float>(scene_.is_outlined(a)) + static_cast<float>(scene_.is_outlined(b)));
}

// How dark the line is here: 4 f (1 - f), f being the share of other bodies under a bell of 0.6 pixels about the
// middle. At a distance d from an edge f is the normal distribution of -d / 0.6. Summed over pixels across the edge the
// ink is then the same within 2 per cent wherever the edge passes between them. So slanted lines do not look dotted.
float Painter::line(uint32_t x, uint32_t y) const {
    static const LineBell bell = line_bell();
    const uint32_t middle = pixels_[at(x, y)].front;
    uint32_t difference = 0;
    visit_neighbours(x, y, 1, [&](uint32_t u, uint32_t v, int, int) {
        for (const uint32_t body : fronts_[at(u, v)]) difference |= body ^ middle;
    });
    if (difference == 0) return 0;
    float all = 0, other = 0, strength = 0;
    visit_neighbours(x, y, 1, [&](uint32_t u, uint32_t v, int du, int dv) {
        for (size_t k = 0; k < kInside.size(); ++k) {
            const float weight = bell[dv + 1][du + 1][k];
            const uint32_t body = fronts_[at(u, v)][k];
            all += weight;
            if (body == middle) continue;
            other += weight;
            strength += weight * line_between(middle, body);
        }
    });
    const float share = std::min(0.5f, other / all);
    return 4 * share * (1 - share) * (strength / other);
}

std::vector<float> Painter::hairlines() const {
    if (std::all_of(bodies_.begin(), bodies_.end(), [](const DrawnBody& body) { return body.lines.empty(); }))
        return std::vector<float>(pixels_.size());
    std::vector<PixelFace> faces;
    faces.reserve(pixels_.size());
    for (const Pixel& pixel : pixels_) {
        const SeenSurface& s = pixel.surface;
        faces.push_back(
            {s.body, pixel.front, s.kind, s.distance, std::fabs(dot(s.face_normal, normalised(s.point - eye_)))});
    }
    return hairline_ink(bodies_, {eye_, forward_, right_, up_, settings_.width, settings_.height}, faces);
}

Vec3 Painter::colour(uint32_t x, uint32_t y, std::array<uint32_t, 4>& front) const {
    const float left = static_cast<float>(x), top = static_cast<float>(y);
    const Pixel& pixel = pixels_[at(x, y)];
    front.fill(pixel.front);
    if (!is_edge(x, y)) return seen(pixel, lights_[at(x, y)], direction_through(left + 0.5f, top + 0.5f));
    Vec3 sum{};
    for (size_t k = 0; k < kInside.size(); ++k) {
        const Vec3 direction = direction_through(left + kInside[k].x, top + kInside[k].y);
        const Pixel between = sight(direction);
        front[k] = between.front;
        const Vec3 light = seen(between, light_like_neighbours(between.surface, x, y), direction);
        // A highlight at an edge must not outshine the other three points.
        sum += {std::min(light.x, 2.0f), std::min(light.y, 2.0f), std::min(light.z, 2.0f)};
    }
    return 0.25f * sum;
}

// Straight up to 0.7, then bends towards 1 with the same slope at the join.
float shoulder(float x) {
    if (!(x > 0.7f)) return x;
    const float over = (x - 0.7f) / 0.3f;
    return 0.7f + 0.3f * over / (1 + over);
}

// Adds up to one level of noise before rounding down, so that slow gradients have no steps.
void store(uint8_t* rgb, Vec3 colour, uint32_t x, uint32_t y) {
    const float channels[3] = {colour.x, colour.y, colour.z};
    uint32_t noise = (x * 0x9e3779b9u) ^ (y * 0x85ebca6bu);
    noise = (noise ^ (noise >> 15)) * 0x2c1b3c6du;
    noise = (noise ^ (noise >> 12)) * 0x297a2d39u;
    noise ^= noise >> 15;
    const float dither = static_cast<float>(noise >> 8) * 0x1p-24f;
    for (int c = 0; c < 3; ++c)
        rgb[c] = static_cast<uint8_t>(std::min(255.0f, srgb_from_linear(shoulder(channels[c])) + dither));
}

Picture Painter::paint() {
    Picture picture = blank_picture(settings_.width, settings_.height);
    const uint32_t width = settings_.width;
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x)
            pixels_[at(x, y)] = sight(direction_through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
    });
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x) lights_[at(x, y)] = first_light(x, y);
    });
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x) other_lights_[at(x, y)] = more_light(x, y);
    });
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x) lights_[at(x, y)] = filtered_light(x, y);
    });
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x) colours_[at(x, y)] = colour(x, y, fronts_[at(x, y)]);
    });
    const std::vector<float> hairline = hairlines();
    each_row([&](uint32_t y) {
        for (uint32_t x = 0; x < width; ++x) {
            const float darkness = settings_.has_finishes ? kFinishedLineDarkness : kLineDarkness;
            const float ink = std::max(darkness * line(x, y), kHairlineDarkness * hairline[at(x, y)]);
            store(picture.pixel(x, y), (settings_.exposure * (1 - ink)) * colours_[at(x, y)], x, y);
        }
    });
    return picture;
}

}  // namespace

Picture draw(std::span<const DrawnBody> bodies, const Camera& camera, const Sun& sun, const PictureSettings& settings) {
    if (settings.width == 0 || settings.height == 0) return {};
    return Painter(bodies, camera, sun, settings).paint();
}

}  // namespace cullet
