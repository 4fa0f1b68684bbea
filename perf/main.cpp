#include <CLI/CLI.hpp>
#include <cstdio>

#include "perf/perf.hpp"

int main(int argc, char** argv) {
    using namespace cullet::perf;
    struct Scene {
        const char* name;
        bool (*measure)(const Options&, Figures&);
    };
    const Scene scenes[] = {
        {"hidden_step", measure_hidden_step}, {"hit", measure_hit},          {"large_hit", measure_large_hit},
        {"generation", measure_generation},   {"pile", measure_pile},        {"soft_body", measure_soft_body},
        {"vase", measure_vase_frames},        {"wall", measure_wall_frames}, {"pane", measure_pane_frames},
        {"pile_frames", measure_pile_frames}};
    std::string names = "all";
    for (const Scene& scene : scenes) names += std::string(", ") + scene.name;
    Options options;
    CLI::App app{"cullet_perf: what cullet costs, beside yardsticks measured in the same process"};
    app.add_option("--scene", options.scene, names);
    app.add_option("--threads", options.threads, "numbers of threads, by commas")->delimiter(',');
    app.add_option("--simd", options.simd, "best, scalar, sse4, avx2, avx512");
    app.add_option("--rounds", options.rounds, "runs of which the least is taken; 0: the scene's own number");
    app.add_option("--json", options.json, "writes all figures to this file");
    CLI11_PARSE(app, argc, argv);
    bool is_good = true, is_known = false;
    Figures figures;
    for (const Scene& scene : scenes) {
        if (options.scene != "all" && options.scene != scene.name) continue;
        is_known = true;
        std::printf("%s\n", scene.name);
        figures.begin(scene.name);
        is_good &= scene.measure(options, figures);
        figures.print(scene.name);
    }
    if (!is_known) {
        std::fprintf(stderr, "--scene %s: there is no such scene. Give one of %s.\n", options.scene.c_str(),
                     names.c_str());
        return 2;
    }
    if (!options.json.empty() && !figures.write_json(options.json)) {
        std::fprintf(stderr, "--json %s: cannot be written.\n", options.json.c_str());
        return 2;
    }
    return is_good ? 0 : 1;
}
