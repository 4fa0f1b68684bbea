#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

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
                         {"generation", measure_generation},
                         {"pile", measure_pile},
                         {"soft_body", measure_soft_body},
                         {"vase", measure_vase_frames},
                         {"wall", measure_wall_frames},
                         {"pane", measure_pane_frames},
                         {"pile_frames", measure_pile_frames, false}};  // a pass takes half an hour

std::string scene_names() {
    std::string names = "all (but pile_frames)";
    for (const Scene& scene : kScenes) names += std::string(", ") + scene.name;
    return names;
}

int measure(const Options& options) {
    bool is_good = true, is_known = false;
    Figures figures;
    {
        Progress progress("measuring");
        for (uint32_t pass = 0; pass < options.passes; ++pass)
            for (const Scene& scene : kScenes) {
                if (options.scene == "all" ? !scene.is_in_all : options.scene != scene.name) continue;
                is_known = true;
                const double scenes = std::size(kScenes), done = static_cast<double>(&scene - kScenes);
                progress.show((pass + done / scenes) / options.passes,
                              std::string(scene.name) + ", pass " + std::to_string(pass + 1));
                figures.begin(scene.name);
                is_good &= scene.measure(options, figures);
            }
    }
    if (!is_known) {
        std::fprintf(stderr, "--scene %s: there is no such scene. Give one of %s.\n", options.scene.c_str(),
                     scene_names().c_str());
        return 2;
    }
    figures.print();
    if (!options.json.empty()) {
        std::ofstream file(options.json);
        file << figures.json(describe_origin());
        file.close();
        if (!file) return std::fprintf(stderr, "--json %s: cannot be written.\n", options.json.c_str()), 2;
    }
    return is_good ? 0 : 1;
}

int compare_files(const std::string& before, const std::string& after) {
    const Result<FigureFile> old_file = read_figures(before), new_file = read_figures(after);
    if (!old_file.ok() || !new_file.ok()) {
        std::fprintf(stderr, "%s\n", (old_file.ok() ? new_file : old_file).error().c_str());
        return 2;
    }
    if (old_file->machine != new_file->machine) {
        std::fprintf(stderr, "warning: %s is of another machine (%s) than %s (%s); nothing can be compared.\n",
                     before.c_str(), old_file->machine.c_str(), after.c_str(), new_file->machine.c_str());
        return 2;
    }
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
    CLI::App app{"cullet_perf: what cullet costs, beside yardsticks measured in the same process"};
    app.add_option("--scene", options.scene, scene_names());
    app.add_option("--threads", options.threads, "numbers of threads, by commas")->delimiter(',');
    app.add_option("--simd", options.simd, "best, scalar, sse4, avx2, avx512");
    app.add_option("--passes", options.passes, "times through all scenes; noise is how far they lie apart")
        ->check(CLI::Range(1, 100));
    app.add_option("--rounds", options.rounds, "runs a pass of which the least is taken; 0: the scene's own number");
    app.add_option("--json", options.json, "writes all figures to this file");
    app.add_option("--compare", files,
                   "OLD NEW: prints what moved by more than the noise of both, and measures nothing.\n"
                   "Ends with 0: nothing moved, 1: something did, 2: files that cannot be compared")
        ->expected(2);
    CLI11_PARSE(app, argc, argv);
    return files.empty() ? measure(options) : compare_files(files[0], files[1]);
}
