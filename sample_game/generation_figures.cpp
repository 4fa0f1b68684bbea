#include "sample_game/generation_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "engine/fp_mode.hpp"
#include "sample_game/propagation.hpp"
#include "systems/cook/crossings.hpp"
#include "systems/cook/extrude.hpp"
#include "systems/cook/true_wall.hpp"

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

Result<GenerationFigures> measure_generation_of(const Mesh& mesh, const std::vector<double>& shares, uint32_t rounds) {
    const Result<Surface> surface = prepare_surface(mesh);
    if (!surface) return Error{mesh.name + ": " + surface.error()};
    const FpMode mode;
    GenerationFigures figures;
    figures.mesh = mesh.name;
    figures.vertices = static_cast<uint32_t>(surface->positions.size());
    figures.triangles = static_cast<uint32_t>(surface->triangles.size());
    figures.embree_build = least_seconds(20 * rounds, [&] { RayScene(mesh.positions, mesh.triangles); });
    figures.crossing_test = least_seconds(rounds, [&] { (void)find_crossings(surface.value()); });
    for (const double share : shares)
        for (const Propagation way : kWays) {
            ExtrusionSettings settings;
            settings.propagation = way;
            settings.has_mitre = false;
            const double thickness = share * surface->diagonal;
            Extrusion shell;
            const double seconds = least_seconds(rounds, [&] {
                if (Result<Extrusion> found = extrude(surface.value(), thickness, settings); found)
                    shell = std::move(found).value();
            });
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
