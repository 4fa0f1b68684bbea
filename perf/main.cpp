#include <CLI/CLI.hpp>

#include "perf/perf.hpp"

int main(int argc, char** argv) {
    cullet::perf::Options options;
    CLI::App app{"cullet_perf: what cullet costs, beside yardsticks measured in the same process"};
    app.add_option("--scene", options.scene, "all, hidden_step");
    app.add_option("--threads", options.threads, "numbers of threads, by commas")->delimiter(',');
    app.add_option("--simd", options.simd, "best, scalar, sse4, avx2, avx512");
    CLI11_PARSE(app, argc, argv);
    bool is_good = true;
    if (options.scene == "all" || options.scene == "hidden_step") is_good &= cullet::perf::measure_hidden_step(options);
    return is_good ? 0 : 1;
}
