#include <cstdio>
#include <string>

#include "perf/perf.hpp"
#include "sample_game/generation_figures.hpp"
#include "sample_game/propagation.hpp"

namespace cullet::perf {
namespace {

const GenerationFigure& row_of(const GenerationFigures& figures, double share, Propagation way) {
    for (const GenerationFigure& row : figures.rows)
        if (row.share == share && row.propagation == way) return row;
    return figures.rows.front();
}

/// Of one mesh: every way at every thickness in Embree builds, and what testing vertex by vertex costs beside the
/// front.
void add(const GenerationFigures& measured, Figures& figures) {
    const std::string prefix = measured.mesh + ": ";
    const double build = 1e3 * measured.embree_build;
    figures.add(prefix + "triangles", measured.triangles, "");
    figures.add(prefix + "one Embree build", build, "ms");
    figures.add(prefix + "crossing test of the input", 1e3 * measured.crossing_test, "ms");
    for (const GenerationFigure& row : measured.rows) {
        const std::string eps = prefix + "eps " + std::to_string(static_cast<int>(100 * row.share + 0.5)) + " %, ";
        const std::string way = eps + name_of(row.propagation);
        const bool has_limit = row.propagation == Propagation::GuardedFront && row.share == 0.03 &&
                               (measured.mesh == "vase" || measured.mesh == "piggy bank");
        figures.add_ratio(way + ", in Embree builds", 1e3 * row.seconds, build, "ms", has_limit ? 28 : 0);
        figures.add(way + ", collisions", row.collisions, "");
        if (row.propagation != Propagation::SingleVertexTets) continue;
        const GenerationFigure& guarded = row_of(measured, row.share, Propagation::GuardedFront);
        figures.add_ratio(eps + "single vertex with tetrahedra beside the guarded front", 1e3 * row.seconds,
                          1e3 * guarded.seconds, "ms", 1.5);
    }
}

}  // namespace

bool measure_generation(const Options& options, Figures& figures) {
    bool is_good = true;
    for (const Mesh& mesh : generation_meshes()) {
        const Result<GenerationFigures> measured =
            measure_generation_of(mesh, {0.01, 0.03, 0.10}, options.rounds_of_a_pass(5));
        if (measured.ok())
            add(*measured, figures);
        else
            std::printf("%s\n", measured.error().c_str()), is_good = false;
    }
    // Published (2005, Pentium 4 at 3 GHz, k = 5): another machine, another mesh; for the order of magnitude.
    figures.add("paper: castle of 12,000 triangles, front, eps 1 %", 2600, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 2 %", 3100, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 5 %", 4600, "ms");
    return is_good;
}

}  // namespace cullet::perf
