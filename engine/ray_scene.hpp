// The Embree bridge: rays against one set of triangles. Serves cooking and pictures only; a running world asks Embree
// for nothing that enters state, because its distances differ in the last bits between CPUs.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/math.hpp"

namespace cullet {

using Triangle = std::array<uint32_t, 3>;

class RayScene {
 public:
    struct Hit {
        float distance = 0;     // m along the (unit) direction
        uint32_t triangle = 0;  // index into the triangles given
        float u = 0, v = 0;     // barycentric weights of corners 1 and 2
    };

    /// Copies what it needs. Builds on the calling thread, so that it may run inside a job: about 0.6 us a triangle. A
    /// triangle that names a missing position is never hit.
    RayScene(std::span<const Vec3> positions, std::span<const Triangle> triangles);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// First triangle in (near, far); ties go to either. For pictures.
    bool closest(Vec3 origin, Vec3 direction, float near, float far, Hit& hit) const;
    /// Whether anything lies in (near, far). For shadows.
    bool any(Vec3 origin, Vec3 direction, float near, float far) const;
    /// Every triangle up to t_first (1 + 1e-4) + slack, into `found` (first come; the rest beyond its size are
    /// dropped), and returns how many it holds, each once. `ignore(triangle, context)` true leaves a triangle out and
    /// lets the ray go on. Cooking repeats the test of what was found in double, so that the result does not depend on
    /// the CPU.
    size_t collect(Vec3 origin, Vec3 direction, float far, float slack,
                   bool (*ignore)(uint32_t triangle, const void* context), const void* context,
                   std::span<uint32_t> found) const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cullet
