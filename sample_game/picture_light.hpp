// How much sun and sky reach a surface, by few rays a pixel, and what the eye makes of them.
#pragma once
#include "sample_game/picture_scene.hpp"

namespace cullet {

/// Shares from 0 to 1 that reach a surface: of the sun's disc, and of the half space above it.
struct Light {
    float sun = 1, sky = 1;
};

class PictureLight {
 public:
    PictureLight(const PictureScene& scene, const Sun& sun, const PictureSettings& settings);

    /// Averages of the rays first .. first + count - 1 of pixel (x, y). Sixteen neighbouring pixels share one even
    /// pattern of points, so that a filter over them sees sixteen times the rays.
    float sun_share(const SeenSurface& surface, uint32_t x, uint32_t y, uint32_t first, uint32_t count) const;
    float sky_share(const SeenSurface& surface, uint32_t x, uint32_t y, uint32_t first, uint32_t count) const;

    /// Light towards the eye, linear. `direction` is the ray of sight.
    Vec3 shaded(const SeenSurface& surface, const Light& light, Vec3 direction) const;
    /// Glass in front of `behind`: its own light (no shadows fall on it), and what it lets through.
    Vec3 through(const SeenSurface& glass, Vec3 direction, Vec3 behind) const;

 private:
    Vec3 finished(const SeenSurface& surface, const Light& light, Vec3 direction) const;
    Vec3 clear(const SeenSurface& glass, Vec3 direction, Vec3 behind) const;
    Vec3 mirrored_light(const SeenSurface& surface, Vec3 direction) const;
    Vec3 met_by(const SeenSurface& surface, Vec3 mirror) const;

    const PictureScene& scene_;
    const PictureSettings& settings_;
    Vec3 towards_, across_, aside_, sunlight_;
    float angular_radius_;
};

}  // namespace cullet
