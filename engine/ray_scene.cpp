#include "engine/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <new>
#include <utility>

namespace cullet {

namespace {

constexpr float kTieFactor = 1.0f + 1e-4f;  // collect() gathers up to t_first times this
constexpr unsigned kFlushAndZero = 0x8040;  // MXCSR bits FTZ and DAZ

// Embree wants subnormal numbers flushed; our own arithmetic does not. The caller's mode is back when this goes out of
// scope.
class FlushedSubnormals {
 public:
    FlushedSubnormals() : before_(_mm_getcsr()) { set(before_ | kFlushAndZero); }
    ~FlushedSubnormals() { set(before_); }
    FlushedSubnormals(const FlushedSubnormals&) = delete;
    FlushedSubnormals& operator=(const FlushedSubnormals&) = delete;

 private:
    // Writing MXCSR drains the pipeline, so a caller that flushes already (the picture maker) does not pay for it.
    void set(unsigned mode) const {
        if ((before_ & kFlushAndZero) != kFlushAndZero) _mm_setcsr(mode);
    }
    unsigned before_;
};

// Derived from Embree's context, which is how a filter function gets at its own data.
struct Gathering : RTCIntersectContext {
    bool (*ignore)(uint32_t, const void*) = nullptr;
    const void* context = nullptr;
    std::span<uint32_t> found;
    size_t count = 0;
};

void leave_out_ignored(const RTCFilterFunctionNArguments* args) {
    const auto* gathering = static_cast<const Gathering*>(args->context);
    const uint32_t triangle = RTCHitN_primID(args->hit, args->N, 0);
    if (gathering->ignore(triangle, gathering->context)) args->valid[0] = 0;
}

// Rejects every hit, so that the ray passes on to the next. A builder that splits triangles may report one twice.
void gather_and_go_on(const RTCFilterFunctionNArguments* args) {
    auto* gathering = static_cast<Gathering*>(args->context);
    const uint32_t triangle = RTCHitN_primID(args->hit, args->N, 0);
    args->valid[0] = 0;
    if (gathering->count == gathering->found.size()) return;
    if (gathering->ignore && gathering->ignore(triangle, gathering->context)) return;
    const auto gathered = gathering->found.first(gathering->count);
    if (std::find(gathered.begin(), gathered.end(), triangle) != gathered.end()) return;
    gathering->found[gathering->count++] = triangle;
}

RTCRay ray_of(Vec3 origin, Vec3 direction, float near, float far) {
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tnear = near, ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

RTCRayHit ray_hit_of(Vec3 origin, Vec3 direction, float near, float far) {
    RTCRayHit ray_hit{};
    ray_hit.ray = ray_of(origin, direction, near, far);
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray_hit;
}

// A triangle that names a missing position becomes a point, which no ray meets.
RTCGeometry geometry_of(RTCDevice device, std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                              sizeof(Vec3), positions.size()));
    auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   sizeof(Triangle), triangles.size()));
    if (points == nullptr || corners == nullptr) {
        rtcReleaseGeometry(geometry);
        throw std::bad_alloc();
    }
    std::copy(positions.begin(), positions.end(), points);
    for (size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& corner = triangles[t];
        const bool is_valid = std::max({corner[0], corner[1], corner[2]}) < positions.size();
        corners[t] = is_valid ? corner : Triangle{0, 0, 0};
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

}  // namespace

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

// The device's setting threads=1 would limit oneTBB in the whole process for as long as the device lives. A device born
// inside an arena with room for the calling thread alone takes that as its own limit. Joining the commit keeps the
// build there. Measured: without either of the two, a second thread does half of the work.
RayScene::RayScene(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : impl_(std::make_unique<Impl>()) {
    oneapi::tbb::task_arena alone(1, 1);
    alone.execute([&] {
        const FlushedSubnormals flushed;
        impl_->device = rtcNewDevice(nullptr);
        impl_->scene = impl_->device ? rtcNewScene(impl_->device) : nullptr;
        if (impl_->scene == nullptr) throw std::bad_alloc();
        rtcSetSceneFlags(impl_->scene,
                         static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
        if (!positions.empty() && !triangles.empty()) {
            RTCGeometry geometry = geometry_of(impl_->device, positions, triangles);
            rtcAttachGeometry(impl_->scene, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcJoinCommitScene(impl_->scene);
        if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) throw std::bad_alloc();  // the only one that can be
    });
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::closest(Vec3 origin, Vec3 direction, float near, float far, Hit& hit) const {
    const FlushedSubnormals flushed;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray_hit = ray_hit_of(origin, direction, near, far);
    rtcIntersect1(impl_->scene, &context, &ray_hit);
    if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = {ray_hit.ray.tfar, ray_hit.hit.primID, ray_hit.hit.u, ray_hit.hit.v};
    return true;
}

bool RayScene::any(Vec3 origin, Vec3 direction, float near, float far) const {
    const FlushedSubnormals flushed;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_of(origin, direction, near, far);
    rtcOccluded1(impl_->scene, &context, &ray);
    return ray.tfar < 0;
}

// Two rays: the first finds t_first, the second gathers up to the limit. One ray would do if a filter could raise the
// far end of an accepted hit, but Embree allows it only to lower it.
size_t RayScene::collect(Vec3 origin, Vec3 direction, float far, float slack,
                         bool (*ignore)(uint32_t triangle, const void* context), const void* context,
                         std::span<uint32_t> found) const {
    const FlushedSubnormals flushed;
    Gathering gathering;
    rtcInitIntersectContext(&gathering);
    gathering.ignore = ignore, gathering.context = context, gathering.found = found;
    gathering.filter = ignore ? leave_out_ignored : nullptr;
    RTCRayHit first = ray_hit_of(origin, direction, 0, far);
    rtcIntersect1(impl_->scene, &gathering, &first);
    if (first.hit.geomID == RTC_INVALID_GEOMETRY_ID) return 0;

    gathering.filter = gather_and_go_on;
    RTCRayHit through = ray_hit_of(origin, direction, 0, std::min(far, first.ray.tfar * kTieFactor + slack));
    rtcIntersect1(impl_->scene, &gathering, &through);
    return gathering.count;
}

}  // namespace cullet
