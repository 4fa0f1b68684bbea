#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "perf/perf.hpp"
#include "sample_game/report.hpp"

namespace cullet::perf {

void Figures::print(const std::string& scene) const {
    for (const Figure& f : all_) {
        if (f.scene != scene) continue;
        std::printf("  %-58s %10.4g %-8s", f.name.c_str(), f.value, f.unit.c_str());
        if (f.limit > 0) {
            const bool is_met = f.is_least ? f.value >= f.limit : f.value <= f.limit;
            std::printf("  %s %g%s", f.is_least ? "at least" : "at most", f.limit, is_met ? "" : "  MISSED");
        }
        std::printf("\n");
    }
}

bool Figures::write_json(const std::string& path) const {
    nlohmann::ordered_json json;
    json["machine"] = describe_machine();
    for (const Figure& f : all_) {
        nlohmann::ordered_json figure{{"value", f.value}, {"unit", f.unit}};
        if (f.limit > 0) figure[f.is_least ? "at_least" : "at_most"] = f.limit;
        json[f.scene][f.name] = figure;
    }
    std::ofstream file(path);
    file << json.dump(2) << '\n';
    return file.good();
}

}  // namespace cullet::perf
