#include "sample_game/report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/profiler.hpp"

namespace cullet {
namespace {

using Json = nlohmann::ordered_json;

Json to_object(const Spread& s) {
    return {{"p50", s.p50}, {"p95", s.p95}, {"p99", s.p99}, {"max", s.max}, {"total", s.total}, {"rows", s.rows}};
}

Json of_run(const Report& r) {
    return {{"scene", r.scene},     {"seed", r.seed},       {"dt_s", r.dt_s}, {"frames", r.frames},
            {"threads", r.threads}, {"machine", r.machine}, {"hash", r.hash}, {"hash_chain", r.hash_chain},
            {"tables", r.tables}};
}

Json of_matter(const Report& r) {
    return {{"mass_kg", {{"start", r.mass_kg.start}, {"end", r.mass_kg.end}, {"debris", r.mass_kg.debris}}},
            {"momentum_ns",
             {{"start", r.momentum_ns.start}, {"end", r.momentum_ns.end}, {"impulse", r.momentum_ns.impulse}}},
            {"energy_j", {{"start", r.energy_j.start}, {"peak", r.energy_j.peak}, {"end", r.energy_j.end}}},
            {"fragments",
             {{"born", r.fragments.born},
              {"live", r.fragments.live},
              {"asleep", r.fragments.asleep},
              {"debris", r.fragments.debris}}},
            {"awake", {{"bodies", r.awake.bodies}, {"cells", r.awake.cells}}},
            {"rest",
             {{"asleep_share", r.rest.asleep_share},
              {"kinetic_share", r.rest.kinetic_share},
              {"measured", r.rest.measured},
              {"sink_mm", {{"p95", r.rest.sink_p95_mm}, {"max", r.rest.sink_max_mm}}},
              {"overlap_mm", {{"p95", r.rest.overlap_p95_mm}, {"max", r.rest.overlap_max_mm}}},
              {"hover_mm", {{"p95", r.rest.hover_p95_mm}, {"max", r.rest.hover_max_mm}}},
              {"through", r.rest.through}}}};
}

Json of_work(const Report& r) {
    return {{"units", {{"used", r.units.used}, {"left", r.units.left}, {"most", r.units.most}}},
            {"events", r.events},
            {"refused", r.refused},
            {"faults", r.faults},
            {"fault_list", r.fault_list},
            {"tasks",
             {{"opened", r.tasks.opened},
              {"broke", r.tasks.broke},
              {"dropped", r.tasks.dropped},
              {"redone", r.tasks.redone},
              {"late", r.tasks.late},
              {"frames_held", r.tasks.frames_held},
              {"ahead_hits", r.tasks.ahead_hits},
              {"ahead_misses", r.tasks.ahead_misses}}},
            {"sweeps", r.sweeps},
            {"clamped", r.clamped},
            {"shapes", r.shapes}};
}

Json of_time(const Report& r) {
    Json systems = Json::object();
    for (const auto& [name, spread] : r.systems) systems[name] = to_object(spread);
    return {{"frame_ms", to_object(r.frame_ms)},
            {"systems", systems},
            {"hitch", r.hitch},
            {"fracture_frames",
             {{"count", r.fracture_frames.count},
              {"p50_ms", r.fracture_frames.p50_ms},
              {"p99_ms", r.fracture_frames.p99_ms},
              {"max_ms", r.fracture_frames.max_ms}}},
            {"damage_frames",
             {{"count", r.damage_frames.count},
              {"p50_ms", r.damage_frames.p50_ms},
              {"p99_ms", r.damage_frames.p99_ms},
              {"max_ms", r.damage_frames.max_ms},
              {"p99_budgets", r.damage_frames.p99_budgets}}},
            {"yardsticks", r.yardsticks},
            {"allocations_in_frames", r.allocations_in_frames},
            {"allocations_in_rigid", r.allocations_in_rigid},
            {"peak_rss_bytes", r.peak_rss_bytes},
            {"repeats", r.repeats},
            {"repeats_agree", r.repeats_agree},
            {"notes", r.notes}};
}

}  // namespace

Spread spread_of(const std::vector<float>& milliseconds, uint64_t rows) {
    Spread spread{percentile(milliseconds, 0.5),
                  percentile(milliseconds, 0.95),
                  percentile(milliseconds, 0.99),
                  percentile(milliseconds, 1),
                  0,
                  rows};
    for (const float ms : milliseconds) spread.total += static_cast<double>(ms);
    return spread;
}

std::string to_json(const Report& report) {
    Json json = of_run(report);
    for (const Json& part : {of_matter(report), of_work(report), of_time(report)}) json.update(part);
    // A file name or a mesh's name may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<void> write_text(const std::string& text, const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file)
        return Error{fmt::format("{}: could not be written ({}); choose a folder that exists and has room.", path,
                                 std::strerror(errno))};
    return {};
}

std::string describe_machine() {
    std::string processor = "unknown processor", line;
    std::ifstream info("/proc/cpuinfo");
    while (std::getline(info, line))
        if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) {
            processor = line.substr(line.find(": ") + 2);
            break;
        }
#if defined(CULLET_CHECKED)
    const char* build = "Checked";
#elif defined(NDEBUG)
    const char* build = "Release";
#else
    const char* build = "Debug";
#endif
#if defined(__clang__)
    const std::string compiler = fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#else
    const std::string compiler = fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    return fmt::format("{}, {} hardware threads, {}, {}", processor, std::thread::hardware_concurrency(), compiler,
                       build);
}

uint64_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace cullet
