#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "perf/perf.hpp"
#include "sample_game/generation_figures.hpp"
#include "sample_game/import_model.hpp"
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

/// Those of the note's table, from the folder that CULLET_TEST_DATA names.
void add_real_meshes(std::vector<Mesh>& meshes) {
    const char* folder = std::getenv("CULLET_TEST_DATA");
    if (!folder) return;
    for (const char* name : {"thick_shell/spot_triangulated.obj", "thick_shell/husky_loop1.ply", "thick_shell/bowl.ply",
                             "thick_shell/vase_thick.ply", "lattice/castle_quads.obj", "thick_shell/curtain.ply"}) {
        const std::filesystem::path file = std::filesystem::path(folder) / name;
        if (!std::filesystem::exists(file)) continue;
        Result<Mesh> mesh = import_model(file.string());
        if (!mesh.ok()) {
            std::printf("%s\n", mesh.error().c_str());
            continue;
        }
        mesh->name = file.filename().string();
        meshes.push_back(std::move(mesh).value());
    }
}

}  // namespace

bool measure_generation(const Options& options, Figures& figures) {
    bool is_good = true;
    std::vector<Mesh> meshes = generation_meshes();
    add_real_meshes(meshes);
    for (const Mesh& mesh : meshes) {
        const Result<GenerationFigures> measured =
            measure_generation_of(mesh, {0.01, 0.03, 0.10}, options.rounds_of_a_pass(5));
        if (!measured.ok()) {
            std::printf("%s\n", measured.error().c_str());
            is_good = false;
            continue;
        }
        if (options.scene == "generation") std::fputs(describe(*measured).c_str(), stdout);
        add(*measured, figures);
    }
    // Published (2005, Pentium 4 at 3 GHz, k = 5): another machine, another mesh; for the order of magnitude.
    figures.add("paper: castle of 12,000 triangles, front, eps 1 %", 2600, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 2 %", 3100, "ms");
    figures.add("paper: castle of 12,000 triangles, front, eps 5 %", 4600, "ms");
    return is_good;
}

}  // namespace cullet::perf
