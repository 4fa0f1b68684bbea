#include "sample_game/generation_figures.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <ctime>

#include "engine/fp_mode.hpp"
#include "sample_game/propagation.hpp"
#include "systems/cook/crossings.hpp"
#include "systems/structures/shell/cook/extrude.hpp"
#include "systems/structures/shell/cook/true_wall.hpp"

namespace cullet {
namespace {

constexpr Propagation kWays[] = {Propagation::GuardedFront, Propagation::Front, Propagation::SingleVertex,
                                 Propagation::SingleVertexTets};

/// Of this thread, s: a machine that does other things meanwhile does not count.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least seconds of `rounds` calls.
template <class Call>
double least_seconds(uint32_t rounds, Call call) {
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round) {
        const double start = processor_seconds();
        call();
        least = std::min(least, processor_seconds() - start);
    }
    return least;
}

}  // namespace

// On this thread alone, as engine/ray_scene.cpp does it.
double embree_build(const Mesh& mesh, uint32_t rounds) {
    double least = 1e9;
    oneapi::tbb::task_arena alone(1, 1);
    alone.execute([&] {
        const RTCDevice device = rtcNewDevice(nullptr);
        for (uint32_t round = 0; round < rounds; ++round) {
            const RTCScene scene = rtcNewScene(device);
            const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            void* const positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                            sizeof(Vec3), mesh.positions.size());
            void* const triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                            sizeof(Triangle), mesh.triangles.size());
            if (positions && triangles) {
                std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
                std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
                rtcCommitGeometry(geometry);
                rtcAttachGeometry(scene, geometry);
                least = std::min(least, least_seconds(1, [&] { rtcJoinCommitScene(scene); }));
            }
            rtcReleaseGeometry(geometry);
            rtcReleaseScene(scene);
        }
        rtcReleaseDevice(device);
    });
    return least;
}

Result<GenerationFigures> measure_generation_of(const Mesh& mesh, const std::vector<double>& shares, uint32_t rounds) {
    const Result<Surface> surface = prepare_surface(mesh);
    if (!surface) return Error{mesh.name + ": " + surface.error()};
    const FpMode mode;
    GenerationFigures figures;
    figures.mesh = mesh.name;
    figures.vertices = static_cast<uint32_t>(surface->positions.size());
    figures.triangles = static_cast<uint32_t>(surface->triangles.size());
    figures.embree_build = embree_build(mesh, 20 * rounds);
    figures.crossing_test = least_seconds(rounds, [&] { (void)find_crossings(surface.value()); });
    for (const double share : shares)
        for (const Propagation way : kWays) {
            ExtrusionSettings settings;
            settings.propagation = way;
            const double thickness = share * surface->diagonal;
            Result<Extrusion> found = Extrusion();
            const double seconds =
                least_seconds(rounds, [&] { found = extrude(surface.value(), thickness, settings); });
            if (!found.ok()) return Error{mesh.name + ": " + found.error()};
            const Extrusion& shell = found.value();
            const ExtrusionStatistics& s = shell.statistics;
            figures.rows.push_back({way, share, seconds + figures.crossing_test, s.collisions,
                                    measure_true_wall(surface.value(), shell, thickness).mean, s.inverted_elements,
                                    s.crossings});
        }
    return figures;
}

std::string describe(const GenerationFigures& figures) {
    std::string text = fmt::format(
        "{}: {} vertices, {} triangles, one Embree build {:.2f} ms, crossing test {:.1f} ms\n", figures.mesh,
        figures.vertices, figures.triangles, 1e3 * figures.embree_build, 1e3 * figures.crossing_test);
    for (const GenerationFigure& row : figures.rows)
        text += fmt::format("  eps {:4.1f} %  {:18}  {:7.1f} ms ({:5.1f} builds) / {:6} / {:.3f} / {}, x {}\n",
                            100 * row.share, name_of(row.propagation), 1e3 * row.seconds,
                            row.seconds / figures.embree_build, row.collisions, row.wall, row.inverted, row.crossings);
    return text;
}

}  // namespace cullet
