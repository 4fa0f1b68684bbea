// The headless picture maker: a ray caster with a sun, soft shadows, a sky and a ground. Bodies have one colour, with
// thin lines between neighbours, so that somebody can judge a break by eye; or a finish, and look like what they are
// of.
#pragma once
#include <cstdint>
#include <functional>
#include <span>

#include "engine/math.hpp"
#include "sample_game/finish.hpp"
#include "sample_game/palette.hpp"
#include "sample_game/png.hpp"

namespace cullet {

/// A stretch of a body's indices whose triangles look alike.
struct DrawnRun {
    uint32_t first_index = 0;  // into indices, a multiple of 3
    uint32_t index_count = 0;
    FaceKind kind = FaceKind::Outer;
};

/// A thin dark line on a body's surface, seen where a face of this kind lies in front. Through glass both sides show.
struct DrawnLine {
    Vec3 from, to;  // body coordinates, m
    FaceKind kind = FaceKind::Outer;
};

/// One body as it is drawn. Spans need to live only during draw(). Fragments, tables, floors and walls alike.
struct DrawnBody {
    Pose pose;
    std::span<const Vec3> positions;    // body coordinates, m
    std::span<const Vec3> normals;      // one a position, unit; empty draws flat faces
    std::span<const uint32_t> indices;  // 3 a triangle
    std::span<const DrawnRun> runs;     // triangles in no run are outer faces
    std::span<const DrawnLine> lines;   // about a pixel wide, however near
    Vec3 colour{0.5f, 0.5f, 0.5f};      // linear light, see fragment_colour
    float opacity = 1;                  // below 1 the view goes straight on behind it, up to eight faces deep
    float gloss = 0.25f;            // strength of the sun's highlight on outer faces: 0 brick, 0.25 porcelain, 1 glass
    bool is_outlined = true;        // false for tables, floors and walls: no dark line around them
    Finish finish = Finish::Plain;  // counts where PictureSettings has finishes
    float pattern_size = 1;         // of its pattern, beside that of real things
    std::span<const Vec3> unmoved;  // where the pattern's positions are others than those drawn; empty: the same
};

struct Camera {
    Vec3 eye{1, 1, 2}, target;             // m
    float vertical_field_of_view = 0.65f;  // rad
};

struct Sun {
    Vec3 towards{0.45f, 0.8f, 0.35f};  // from the ground to the sun, any length
    Vec3 colour{1.0f, 0.955f, 0.88f};
    float strength = 2.3f;         // beside a sky of about 0.8
    float angular_radius = 0.03f;  // rad; the real one is 0.0047, a larger one has softer shadows
};

struct PictureSettings {
    uint32_t width = 960, height = 540;
    bool has_ground = true;
    float ground_height = 0;     // m
    float grid_spacing = 0.1f;   // m; every tenth line is stronger; slabs instead where there are finishes
    bool has_finishes = false;   // bodies look as their finish says, and what shines shows what is around it
    float ambient_reach = 0.4f;  // m, how far a thing darkens its neighbours' share of the sky
    float exposure = 0.46f;
    /// Calls job(0) ... job(count - 1) in any order on any threads, and returns when all are done. Empty: one after
    /// another on the calling thread. The picture is the same.
    std::function<void(uint32_t count, const std::function<void(uint32_t)>& job)> for_each;
};

/// For 100 000 triangles at 960 x 540 about 0.9 s on one core (0.1 s of it building the tree), 0.55 s on two.
/// the same bytes on the same kind of CPU. Triangles with a missing position are left out. A width or height of 0 gives
/// an empty picture.
Picture draw(std::span<const DrawnBody> bodies, const Camera& camera, const Sun& sun, const PictureSettings& settings);

}  // namespace cullet
