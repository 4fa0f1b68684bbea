#include "sample_game/picture_scene.hpp"

#include <algorithm>

namespace cullet {

namespace {

constexpr float kCrackShade = 0.62f;       // crack faces are drawn darker by this
constexpr float kInnerSaturation = 0.65f;  // and inner faces lose a third of their colour
constexpr float kGlassShadow = 0.35f;      // share of light that a glass body keeps from what lies behind it
constexpr float kClearShadow = 0.16f;      // and one whose finish is glass
const Vec3 kGroundColour{0.60f, 0.595f, 0.58f};
const Vec3 kLineColour{0.20f, 0.21f, 0.23f};
const Vec3 kFloorColour{0.205f, 0.195f, 0.18f};

Vec3 coloured(Vec3 colour, FaceKind kind) {
    if (kind == FaceKind::Outer) return colour;
    const float grey = dot(colour, {0.2126f, 0.7152f, 0.0722f});
    const Vec3 faded = kInnerSaturation * colour + ((1 - kInnerSaturation) * grey) * Vec3{1, 1, 1};
    return kind == FaceKind::Inner ? 0.9f * faded : kCrackShade * colour;
}

// Moves a point of a flat triangle onto the tangent planes of its corners, weighted as the normal is. Without it the
// smooth surface casts shadows of its facets onto itself where the sun grazes it (Hanika, Ray Tracing Gems II, chapter
// 4). A corner whose tangent plane lies below does nothing, so concave places keep their points.
Vec3 lifted(Vec3 point, const Vec3 corner[3], const Vec3 normal[3], const float weight[3]) {
    Vec3 moved{};
    for (int k = 0; k < 3; ++k) {
        const float below = std::min(0.0f, dot(point - corner[k], normal[k]));
        moved += weight[k] * (point - below * normal[k]);
    }
    return moved;
}

// Above the rounding errors of a point at these coordinates (about 1e-7 of them), below the thickness of any shell.
float clearance(Vec3 p) {
    return 1e-5f + 4e-6f * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z));
}

// Integral from 0 to x of the pattern that is 1 within `half` of every multiple of `spacing`.
float line_integral(float x, float spacing, float half) {
    const float nearest = std::floor(x / spacing + 0.5f);
    return 2 * half * nearest + std::clamp(x - nearest * spacing, -half, half);
}

// Share of a footprint that grid lines cover. Lines are at least a pixel wide and fade out where they would merge into
// grey.
float line_cover(float x, float footprint, float spacing) {
    const float half = 0.5f * std::max(0.012f * spacing, footprint);
    const float fade = std::clamp(1.25f - 5.0f * footprint / spacing, 0.0f, 1.0f);
    if (fade == 0) return 0;
    const float from = line_integral(x - 0.5f * footprint, spacing, half);
    const float to = line_integral(x + 0.5f * footprint, spacing, half);
    return fade * std::clamp((to - from) / footprint, 0.0f, 1.0f);
}

}  // namespace

Vec3 sky_light(Vec3 direction) {
    const Vec3 horizon{0.93f, 0.94f, 0.95f}, zenith{0.50f, 0.64f, 0.84f};
    const float up = std::clamp(direction.y, 0.0f, 1.0f);
    const float t = up * (2 - up);
    return (1 - t) * horizon + t * zenith;
}

// Deeper blue above, and warmer at the horizon: what shines has something to mirror.
Vec3 clear_sky(Vec3 direction) {
    const Vec3 horizon{1.05f, 1.05f, 1.04f}, zenith{0.22f, 0.42f, 0.80f};
    const float low = 1 - std::clamp(direction.y, 0.0f, 1.0f), t = 1 - low * low * low * low;
    return (1 - t) * horizon + t * zenith;
}

PictureScene::PictureScene(std::span<const DrawnBody> bodies, const PictureSettings& settings)
    : bodies_(bodies), settings_(settings) {
    for (uint32_t b = 0; b < bodies.size(); ++b) add(b, bodies[b].opacity < 1 ? glass_ : solid_);
    solid_.rays = RayScene(solid_.positions, solid_.triangles);
    if (has_transparent()) glass_.rays = RayScene(glass_.positions, glass_.triangles);
}

void PictureScene::add(uint32_t b, Triangles& to) const {
    const DrawnBody& body = bodies_[b];
    const uint32_t first = static_cast<uint32_t>(to.positions.size());
    const size_t triangle_count = body.indices.size() / 3, before = to.triangles.size();
    const bool has_normals = body.normals.size() == body.positions.size();
    const Mat3 turn = matrix(body.pose.orientation);
    for (const Vec3 p : body.positions) to.positions.push_back(turn * p + body.pose.position);
    if (settings_.has_finishes) {
        const bool is_moved = body.unmoved.size() == body.positions.size();
        const std::span<const Vec3> unmoved = is_moved ? body.unmoved : body.positions;
        to.unmoved.insert(to.unmoved.end(), unmoved.begin(), unmoved.end());
    }
    for (size_t v = 0; v < body.positions.size(); ++v)
        to.normals.push_back(has_normals ? turn * body.normals[v] : Vec3{});
    for (size_t t = 0; t < triangle_count; ++t) {
        const uint32_t* corner = body.indices.data() + 3 * t;
        const bool is_valid = std::max({corner[0], corner[1], corner[2]}) < body.positions.size();
        to.triangles.push_back(is_valid ? Triangle{first + corner[0], first + corner[1], first + corner[2]}
                                        : Triangle{first, first, first});
    }
    to.body.resize(to.triangles.size(), b);
    to.kind.resize(to.triangles.size(), FaceKind::Outer);
    for (const DrawnRun& run : body.runs) {
        const size_t from = std::min<size_t>(run.first_index / 3, triangle_count);
        const size_t count = std::min<size_t>(run.index_count / 3, triangle_count - from);
        std::fill_n(to.kind.begin() + before + from, count, run.kind);
    }
}

// A body without normals, or with the zero normal, is flat there.
SeenSurface PictureScene::surface(const Triangles& from, const RayScene::Hit& hit, Vec3 origin, Vec3 direction,
                                  float pixel_angle) const {
    const Triangle& corners = from.triangles[hit.triangle];
    const float weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};
    Vec3 corner[3], normal[3], point{}, smooth{};
    for (int k = 0; k < 3; ++k) corner[k] = from.positions[corners[k]];
    Vec3 face = normalised(cross(corner[1] - corner[0], corner[2] - corner[0]));
    if (dot(face, direction) > 0) face = -face;
    for (int k = 0; k < 3; ++k) {
        normal[k] = from.normals[corners[k]];
        if (dot(normal[k], face) < 0) normal[k] = -normal[k];
        point += weight[k] * corner[k];
        smooth += weight[k] * normal[k];
    }
    const DrawnBody& body = bodies_[from.body[hit.triangle]];
    SeenSurface surface;
    surface.face_normal = face;
    surface.normal = dot(smooth, smooth) > 0 ? normalised(smooth) : face;
    surface.point = lifted(point, corner, normal, weight) + clearance(point) * face;
    surface.distance = length(point - origin);
    surface.body = from.body[hit.triangle];
    surface.kind = from.kind[hit.triangle];
    surface.colour = coloured(body.colour, surface.kind);
    surface.gloss = surface.kind == FaceKind::Crack ? 0 : body.gloss;
    surface.opacity = body.opacity;
    if (settings_.has_finishes) finish(from, hit, direction, pixel_angle, surface);
    return surface;
}

void PictureScene::finish(const Triangles& from, const RayScene::Hit& hit, Vec3 direction, float pixel_angle,
                          SeenSurface& surface) const {
    const DrawnBody& body = bodies_[surface.body];
    const Triangle& corners = from.triangles[hit.triangle];
    const Vec3 a = from.unmoved[corners[0]], b = from.unmoved[corners[1]], c = from.unmoved[corners[2]];
    const float slope = std::max(0.2f, std::fabs(dot(surface.face_normal, direction)));
    const float size = body.pattern_size;
    FinishPlace place;
    place.point = (1 / size) * ((1 - hit.u - hit.v) * a + hit.u * b + hit.v * c);
    place.normal = normalised(cross(b - a, c - a));
    place.footprint = surface.distance * pixel_angle / std::sqrt(slope) / size;
    place.kind = surface.kind;
    place.is_model = size < 1;
    const FinishLook look = finish_at(body.finish, place, surface.colour, surface.gloss);
    surface.has_finish = true;
    surface.colour = look.colour;
    surface.mirror = look.mirror;
    surface.gloss = look.gloss;
    surface.facing = look.facing;
    surface.sharpness = look.sharpness;
    surface.spread = look.spread;
    surface.sheen = look.sheen;
    if (look.tilt == Vec3{}) return;
    const Vec3 tilted = normalised(surface.normal + matrix(body.pose.orientation) * look.tilt);
    if (dot(tilted, direction) < 0 && dot(tilted, surface.face_normal) > 0.2f) surface.normal = tilted;
}

// Slabs of half a metre.
void PictureScene::lay_floor(float along_x, float along_z, SeenSurface& surface) const {
    constexpr float kSlab = 0.5f, kSlabJoint = 0.004f;
    const Vec3 p = surface.point;
    const float footprint = std::sqrt(along_x * along_z);
    FinishPlace place{p, {0, 1, 0}, footprint, FaceKind::Outer};
    const FinishLook look = finish_at(Finish::Floor, place, kFloorColour, 0.25f);
    const auto slab = [](float along) { return std::floor(std::clamp(along / kSlab, -1e3f, 1e3f)); };
    const float x = slab(p.x), z = slab(p.z);
    const float shade = 0.5f - 0.5f * static_cast<float>(static_cast<int>(3 * x + 5 * z + 7 * x * z) & 3) / 1.5f;
    const float shows = std::clamp(1.5f - footprint / kSlab, 0.0f, 1.0f);
    const float joint = std::max(line_cover(p.x, std::max(along_x, kSlabJoint), kSlab),
                                 line_cover(p.z, std::max(along_z, kSlabJoint), kSlab));
    surface.colour = (1 + 0.03f * shows * shade) * (1 - 0.25f * joint) * look.colour;
    surface.has_finish = true;
    surface.gloss = 0.5f;
    surface.facing = 0.03f;
    surface.sharpness = 16;
    surface.spread = 0.8f;
}

SeenSurface PictureScene::ground(Vec3 origin, Vec3 direction, float distance, float pixel_angle) const {
    SeenSurface surface;
    surface.point = origin + distance * direction;
    surface.point.y = settings_.ground_height + clearance(surface.point);
    surface.distance = distance;
    surface.normal = surface.face_normal = {0, 1, 0};
    surface.body = kGroundBody;
    const float width = distance * pixel_angle, steepness = std::max(1e-4f, -direction.y);
    const float along_x = width * (1 + std::fabs(direction.x) / steepness);
    const float along_z = width * (1 + std::fabs(direction.z) / steepness);
    if (settings_.has_finishes) {
        lay_floor(along_x, along_z, surface);
        return surface;
    }
    float cover = 0;
    for (const float scale : {1.0f, 10.0f}) {
        const float spacing = scale * settings_.grid_spacing;
        const float across =
            std::max(line_cover(surface.point.x, along_x, spacing), line_cover(surface.point.z, along_z, spacing));
        cover = std::max(cover, (scale > 1 ? 0.8f : 0.4f) * across);
    }
    surface.colour = (1 - cover) * kGroundColour + cover * kLineColour;
    return surface;
}

SeenSurface PictureScene::opaque(Vec3 origin, Vec3 direction, float pixel_angle) const {
    const float drop = origin.y - settings_.ground_height;
    const bool meets_ground = settings_.has_ground && drop > 0 && direction.y < 0;
    const float to_ground = meets_ground ? std::min(kViewFar, drop / -direction.y) : kViewFar;
    RayScene::Hit hit;
    if (solid_.rays.closest(origin, direction, 0, to_ground, hit))
        return surface(solid_, hit, origin, direction, pixel_angle);
    if (meets_ground && to_ground < kViewFar) return ground(origin, direction, to_ground, pixel_angle);
    SeenSurface sky;
    sky.distance = kViewFar;
    sky.normal = sky.face_normal = -direction;
    sky.colour = settings_.has_finishes ? clear_sky(direction) : sky_light(direction);
    return sky;
}

size_t PictureScene::transparent(Vec3 origin, Vec3 direction, float far, float pixel_angle,
                                 std::array<SeenSurface, kLayers>& layers) const {
    size_t count = 0;
    float near = 0;
    RayScene::Hit hit;
    while (count < kLayers && glass_.rays.closest(origin, direction, near, far, hit)) {
        layers[count++] = surface(glass_, hit, origin, direction, pixel_angle);
        near = hit.distance + clearance(origin + hit.distance * direction);
    }
    return count;
}

float PictureScene::passes(Vec3 origin, Vec3 direction) const {
    if (solid_.rays.any(origin, direction, 0, kViewFar)) return 0;
    if (!has_transparent() || !glass_.rays.any(origin, direction, 0, kViewFar)) return 1;
    return 1 - (settings_.has_finishes ? kClearShadow : kGlassShadow);
}

}  // namespace cullet
