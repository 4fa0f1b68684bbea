#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "engine/fp_mode.hpp"
#include "perf/perf.hpp"
#include "sample_game/meshes.hpp"
#include "systems/cook/crossings.hpp"
#include "systems/cook/extrude.hpp"

namespace cullet::perf {
namespace {

/// One build of Embree's default tree on one thread, s: the least of `rounds`.
double embree_build(const Mesh& mesh, uint32_t rounds) {
    const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    double least = 1e9;
    for (uint32_t i = 0; i < rounds; ++i) {
        const RTCScene scene = rtcNewScene(device);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                                  mesh.positions.size());
        void* triangles =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
        std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
        std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * 12);
        least = std::min(least, seconds([&] {
                             rtcCommitGeometry(geometry);
                             rtcAttachGeometry(scene, geometry);
                             rtcCommitScene(scene);
                         }));
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
    }
    rtcReleaseDevice(device);
    return least;
}

double diagonal_of(const Mesh& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return static_cast<double>(length(high - low));
}

void measure(const char* name, const Mesh& mesh, uint32_t rounds, Figures& figures) {
    const Result<Surface> surface = prepare_surface(mesh);
    if (!surface.ok()) {
        std::printf("%s\n", surface.error().c_str());
        return;
    }
    const FpMode mode;
    const std::string prefix = std::string(name) + ": ";
    const double build = embree_build(mesh, 20 * rounds);
    figures.add(prefix + "triangles", static_cast<double>(mesh.triangles.size()), "");
    figures.add(prefix + "one Embree build", 1e3 * build, "ms");
    double crossings = 1e9;
    for (uint32_t i = 0; i < rounds; ++i)
        crossings = std::min(crossings, seconds([&] { (void)find_crossings(surface.value()); }));
    figures.add(prefix + "crossing test of the input", 1e3 * crossings, "ms");
    for (const double share : {0.01, 0.03, 0.10}) {
        double least = 1e9;
        ExtrusionStatistics statistics;
        for (uint32_t i = 0; i < rounds; ++i) {
            const auto run = [&] {
                const auto extrusion = extrude(surface.value(), share * diagonal_of(mesh));
                if (extrusion.ok()) statistics = extrusion->statistics;
            };
            least = std::min(least, seconds(run));
        }
        const std::string eps = "eps " + std::to_string(static_cast<int>(100 * share + 0.5)) + " %";
        figures.add(prefix + eps + ", guarded front", 1e3 * least, "ms");
        figures.add_ratio(prefix + eps + ", with the crossing test, in Embree builds", 1e3 * (least + crossings),
                          1e3 * build, "ms", share == 0.03 ? 28 : 0);
        figures.add(prefix + eps + ", set back", statistics.collisions, "times");
    }
}

}  // namespace

bool measure_generation(const Options& options, Figures& figures) {
    const uint32_t rounds = options.rounds_of_a_pass(5);
    measure("vase", make_vase(0.30f, 0.0055f), rounds, figures);
    measure("piggy bank", make_piggy_bank(0.40f, 0.0075f), rounds, figures);
    // Published (2005, Pentium 4 at 3 GHz, k = 5): another machine, another mesh; for the order of magnitude.
    figures.add("paper: castle of 12,000 triangles, front, eps 1 %", 2600, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 2 %", 3100, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 5 %", 4600, "ms");
    return true;
}

}  // namespace cullet::perf
