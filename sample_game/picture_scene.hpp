// What a ray of sight meets: the triangles of all bodies in world coordinates, the ground and the sky.
#pragma once
#include <array>
#include <vector>

#include "engine/ray_scene.hpp"
#include "sample_game/picture.hpp"

namespace cullet {

inline constexpr uint32_t kSkyBody = 0xffffffffu;
inline constexpr uint32_t kGroundBody = 0xfffffffeu;
inline constexpr float kViewFar = 1e5f;  // m

/// A point that a ray met, with everything that its light needs.
struct SeenSurface {
    Vec3 point;          // m; lifted onto the smooth surface and off the face, so that shadow rays may start here
    float distance = 0;  // m from the eye
    Vec3 normal;         // interpolated, towards the eye
    uint32_t body = kSkyBody;
    Vec3 face_normal;  // towards the eye
    FaceKind kind = FaceKind::Outer;
    Vec3 colour;  // linear share of light sent back; the sky's own light for the sky
    float gloss = 0;
    float opacity = 1;
    // Of a finish; the mirrored light of what has none is the sky's.
    bool has_finish = false;
    Vec3 mirror{1, 1, 1};
    float facing = 0.04f, sharpness = 64, spread = 0, sheen = 0;
};

/// Opaque bodies and transparent ones apart: shadows and the last thing seen come from the first, what is seen on the
/// way from the second.
class PictureScene {
 public:
    static constexpr size_t kLayers = 8;  // transparent faces along one ray; the ones behind are not drawn

    PictureScene(std::span<const DrawnBody> bodies, const PictureSettings& settings);

    /// The first opaque thing: a body, the ground or the sky. `pixel_angle` (rad) is how wide the ray is.
    SeenSurface opaque(Vec3 origin, Vec3 direction, float pixel_angle) const;
    /// Transparent faces nearer than `far`, front to back; returns how many.
    size_t transparent(Vec3 origin, Vec3 direction, float far, float pixel_angle,
                       std::array<SeenSurface, kLayers>& layers) const;
    bool has_transparent() const { return !glass_.triangles.empty(); }

    /// Share of light that passes along a shadow ray: 0 behind an opaque body, about a half behind glass.
    float passes(Vec3 origin, Vec3 direction) const;
    /// Whether an opaque body lies within reach.
    bool is_near(Vec3 origin, Vec3 direction, float reach) const {
        return solid_.rays.any(origin, direction, 0, reach);
    }

    bool is_outlined(uint32_t body) const { return body < bodies_.size() && bodies_[body].is_outlined; }

 private:
    struct Triangles {
        std::vector<Vec3> positions, normals;
        std::vector<Vec3> unmoved;  // body coordinates; empty unless there are finishes
        std::vector<Triangle> triangles;
        std::vector<uint32_t> body;
        std::vector<FaceKind> kind;
        RayScene rays{{}, {}};
    };
    void add(uint32_t body, Triangles& to) const;
    SeenSurface surface(const Triangles& from, const RayScene::Hit& hit, Vec3 origin, Vec3 direction,
                        float pixel_angle) const;
    void finish(const Triangles& from, const RayScene::Hit& hit, Vec3 direction, float pixel_angle,
                SeenSurface& surface) const;
    void lay_floor(float along_x, float along_z, SeenSurface& surface) const;
    SeenSurface ground(Vec3 origin, Vec3 direction, float distance, float pixel_angle) const;

    std::span<const DrawnBody> bodies_;
    const PictureSettings& settings_;
    Triangles solid_, glass_;
};

/// Light of the sky in a direction, linear.
Vec3 sky_light(Vec3 direction);
/// The same over what has finishes.
Vec3 clear_sky(Vec3 direction);

}  // namespace cullet
