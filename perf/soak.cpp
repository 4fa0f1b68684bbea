// A million fragments born and retired, at most 4,096 of them alive: memory and frame times flat, handles safe. One run
// a pass, of some minutes.
#include <algorithm>
#include <cstdio>

#include "perf/perf.hpp"
#include "sample_game/soak.hpp"

namespace cullet::perf {

bool measure_soak(const Options& options, Figures& figures) {
    SoakSettings settings;
    settings.threads = options.threads.empty() ? 1 : *std::max_element(options.threads.begin(), options.threads.end());
    if (options.rounds) settings.fragments = options.rounds;
    Result<Soak> soak = Soak::create(settings);
    if (!soak) {
        std::printf("%s\n", soak.error().c_str());
        return false;
    }
    const double taken = seconds([&] {
        while (!soak->is_done()) soak->step();
    });
    const SoakReport r = soak->report();
    if (!r.wrong.empty()) std::printf("%s\n", r.wrong.c_str());
    figures.add("fragments born", static_cast<double>(r.born), "", static_cast<double>(settings.fragments), true);
    figures.add("alive at most", r.most_alive, "", settings.alive);
    figures.add("retired", static_cast<double>(r.retired), "");
    figures.add("frames", static_cast<double>(r.frames), "");
    figures.add("the run", taken, "s");
    figures.add("memory at the end", r.memory_mib.empty() ? 0 : r.memory_mib.back(), "MiB");
    figures.add("memory, rise over the last 90 %", r.memory_rise_mib, "MiB", 1.0);
    figures.add("frame, fastest tenth of the last 45 %", r.late_ms, "ms");
    figures.add_ratio("frame, fastest tenth of the last 45 % / of the 45 % before", r.late_ms, r.early_ms, "ms", 1.25);
    return r.wrong.empty() && r.is_stale_refused && r.faults == 0;
}

}  // namespace cullet::perf
