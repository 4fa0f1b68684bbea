#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>

#include "engine/simd.hpp"
#include "perf/compare.hpp"
#include "perf/perf.hpp"
#include "sample_game/progress.hpp"

namespace cullet::perf {
namespace {

struct Scene {
    const char* name;
    bool (*measure)(const Options&, Figures&);
    bool is_in_all = true;
};
const Scene kScenes[] = {{"hidden_step", measure_hidden_step},
                         {"hit", measure_hit},
                         {"large_hit", measure_large_hit},
                         {"parts", measure_parts},
                         {"local_hit", measure_local_hit},
                         {"generation", measure_generation},
                         {"pile", measure_pile},
                         {"handoff", measure_handoff},
                         {"soft_body", measure_soft_body},
                         {"springs", measure_springs},
                         {"quick", measure_quick},
                         {"metal", measure_metal},
                         {"vase", measure_vase_frames},
                         {"wall", measure_wall_frames},
                         {"pane", measure_pane_frames},
                         {"lattice", measure_solid_frames},
                         {"demolition", measure_demolition_frames, false},  // some minutes
                         {"pile_frames", measure_pile_frames, false},       // a pass takes half an hour
                         {"soak", measure_soak, false}};                    // and some minutes

std::string scene_names() {
    std::string names = "all (but demolition, pile_frames and soak)";
    for (const Scene& scene : kScenes) names += std::string(", ") + scene.name;
    return names;
}

int refuse(const std::string& sentence) {
    std::fprintf(stderr, "%s\n", sentence.c_str());
    return 2;
}

bool is_scene(const std::string& name) {
    return name == "all" ||
           std::any_of(std::begin(kScenes), std::end(kScenes), [&](const Scene& scene) { return name == scene.name; });
}

int measure(const Options& options) {
    if (!is_scene(options.scene))
        return refuse("--scene " + options.scene + ": there is no such scene. Give one of " + scene_names() + ".");
    if (const Result<void> level = set_simd_level(options.simd); !level) return refuse("--" + level.error());
    std::ofstream file;
    if (!options.json.empty()) file.open(options.json);
    if (!file) return refuse("--json " + options.json + ": cannot be written.");
    bool is_good = true;
    Figures figures;
    {
        Progress progress("measuring");
        for (uint32_t pass = 0; pass < options.passes; ++pass)
            for (const Scene& scene : kScenes) {
                if (options.scene == "all" ? !scene.is_in_all : options.scene != scene.name) continue;
                const double scenes = std::size(kScenes), done = static_cast<double>(&scene - kScenes);
                progress.show((pass + done / scenes) / options.passes,
                              std::string(scene.name) + ", pass " + std::to_string(pass + 1));
                figures.begin(scene.name);
                is_good &= scene.measure(options, figures);
            }
    }
    figures.print();
    const uint32_t missed = figures.missed();
    if (missed > 0) std::printf("%u limit%s missed\n", missed, missed == 1 ? "" : "s");
    const int outcome = is_good && missed == 0 ? 0 : 1;
    if (options.json.empty()) return outcome;
    Origin origin = describe_origin();
    origin.simd = options.simd, origin.passes = options.passes;
    file << figures.json(origin);
    file.close();
    if (!file) return refuse("--json " + options.json + ": cannot be written.");
    return outcome;
}

int compare_files(const std::string& before, const std::string& after) {
    const Result<FigureFile> old_file = read_figures(before), new_file = read_figures(after);
    if (!old_file.ok() || !new_file.ok()) return refuse((old_file.ok() ? new_file : old_file).error());
    if (old_file->machine != new_file->machine)
        return refuse(before + " is of another machine (" + old_file->machine + ") than " + after + " (" +
                      new_file->machine + "); nothing can be compared.");
    if (old_file->passes < 2 || new_file->passes < 2)
        return refuse((old_file->passes < 2 ? before : after) +
                      " is of one pass, so its noise is not known; measure with --passes 2 or more.");
    const Comparison comparison = compare(*old_file, *new_file);
    std::fputs(describe(comparison).c_str(), stdout);
    return comparison.moved.empty() ? 0 : 1;
}

}  // namespace
}  // namespace cullet::perf

int main(int argc, char** argv) {
    using namespace cullet::perf;
    Options options;
    std::vector<std::string> files;
    CLI::App app{
        "cullet_perf: what cullet costs, beside yardsticks measured in the same process.\n"
        "Ends with 0: every limit is met, 1: one is missed, or ours differs from its yardstick, 2: refused"};
    app.add_option("--scene", options.scene, scene_names());
    app.add_option("--threads", options.threads, "numbers of threads, by commas")
        ->delimiter(',')
        ->check(CLI::Range(1, 64));
    app.add_option("--simd", options.simd, "level of the kernels: best, scalar, sse4, avx2, avx512");
    app.add_option("--passes", options.passes, "times through all scenes; noise is how far they lie apart")
        ->check(CLI::Range(1, 100));
    app.add_option("--rounds", options.rounds,
                   "runs a pass of which the least is taken; of soak: fragments; 0: the scene's own number");
    app.add_option("--json", options.json, "writes all figures to this file");
    app.add_option("--compare", files,
                   "OLD NEW: prints what moved by more than the noise of both, and measures nothing.\n"
                   "Ends with 0: nothing moved, 1: something did, 2: files that cannot be compared")
        ->expected(2);
    CLI11_PARSE(app, argc, argv);
    return files.empty() ? measure(options) : compare_files(files[0], files[1]);
}
