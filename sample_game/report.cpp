#include "sample_game/report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/profiler.hpp"
#include "sample_game/notes.hpp"

namespace cullet {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kDearest = 5;  // systems that are always in the table

Json to_object(const Spread& s) {
    return {{"p50", s.p50}, {"p95", s.p95}, {"p99", s.p99}, {"max", s.max}, {"total", s.total}, {"rows", s.rows}};
}

Json to_object(const FragmentShapes& s) {
    const auto ratio = [](const FragmentShapes::Ratio& r) {
        return Json{{"min", r.min}, {"median", r.median}, {"max", r.max}};
    };
    return {{"count", s.count},
            {"measured", s.measured},
            {"box_ratio", ratio(s.box_ratio)},
            {"hull_ratio", ratio(s.hull_ratio)}};
}

Json of_shapes(const Report& r) {
    Json shapes = r.shapes, fragments = Json::object();
    for (const auto& [kind, found] : r.fragment_shapes) fragments[kind] = to_object(found);
    shapes["fragments"] = fragments;
    return shapes;
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
              {"retired", r.fragments.retired},
              {"faded", r.fragments.faded},
              {"debris", r.fragments.debris}}},
            {"awake", {{"bodies", r.awake.bodies}, {"cells", r.awake.cells}}},
            {"rest",
             {{"asleep_share", r.rest.asleep_share},
              {"kinetic_share", r.rest.kinetic_share},
              {"measured", r.rest.measured},
              {"sink_mm", {{"p95", r.rest.sink_p95_mm}, {"max", r.rest.sink_max_mm}}},
              {"overlap_mm", {{"p95", r.rest.overlap_p95_mm}, {"max", r.rest.overlap_max_mm}}},
              {"hover_mm",
               {{"p95", r.rest.hover_p95_mm},
                {"max", r.rest.hover_max_mm},
                {"boxes_max", r.rest.hover_boxes_max_mm},
                {"hulls_max", r.rest.hover_hulls_max_mm}}},
              {"through", r.rest.through}}}};
}

Json of_work(const Report& r) {
    return {{"units",
             {{"used", r.units.used},
              {"left", r.units.left},
              {"most", r.units.most},
              {"slow_soft_frames", r.units.slow_soft_frames},
              {"softening", r.units.softening}}},
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
              {"ahead_misses", r.tasks.ahead_misses},
              {"first_breaks", r.tasks.first_breaks},
              {"first_ready", r.tasks.first_ready}}},
            {"sweeps", r.sweeps},
            {"clamped", r.clamped},
            {"crushed_j", r.crushed_j},
            {"shapes", of_shapes(r)}};
}

Json of_time(const Report& r) {
    Json systems = Json::object();
    for (const auto& [name, spread] : r.systems) systems[name] = to_object(spread);
    return {{"frame_ms", to_object(r.frame_ms)},
            {"systems", systems},
            {"worst_frame",
             {{"frame", r.worst_frame.frame},
              {"ms", r.worst_frame.ms},
              {"opened", r.worst_frame.facts.opened},
              {"broke", r.worst_frame.facts.broke},
              {"late", r.worst_frame.facts.late},
              {"frames_held", r.worst_frame.facts.frames_held},
              {"born", r.worst_frame.facts.born},
              {"debris", r.worst_frame.facts.debris},
              {"refused", r.worst_frame.facts.refused},
              {"units", r.worst_frame.facts.units},
              {"system", r.worst_frame.system},
              {"system_ms", r.worst_frame.system_ms}}},
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
            {"notes", counted_notes(r.notes)}};
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

std::string systems_table(const Report& report) {
    std::vector<std::pair<std::string, Spread>> rows(report.systems.begin(), report.systems.end());
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& a, const auto& b) { return a.second.total > b.second.total; });
    double total = 0, rest = 0;
    for (const auto& [name, spread] : rows) total += spread.total;
    std::string text = fmt::format("  {:<24} {:>8} {:>8} {:>8} {:>8} {:>10} {:>6} {:>12}\n", "system, ms", "p50", "p95",
                                   "p99", "worst", "total", "share", "rows");
    size_t shown = 0;
    for (const auto& [name, s] : rows) {
        if (s.total <= 0 || (shown >= kDearest && s.total < 0.01 * total)) {
            rest += s.total;
            continue;
        }
        ++shown;
        text += fmt::format("  {:<24} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.2f} {:>10.1f} {:>4.0f} % {:>12}\n", name, s.p50,
                            s.p95, s.p99, s.max, s.total, 100 * s.total / total, s.rows);
    }
    if (total > 0)
        text += fmt::format("  {:<60} {:>10.1f} {:>4.0f} %\n", fmt::format("{} others", rows.size() - shown), rest,
                            100 * rest / total);
    return text;
}

std::string worst_frame_line(const Report& report) {
    const auto& worst = report.worst_frame;
    const FrameFacts& facts = worst.facts;
    std::string text;
    const auto tell = [&text](uint64_t count, const char* one, const char* many) {
        if (count > 0) text += fmt::format("{} {}, ", count, count == 1 ? one : many);
    };
    tell(facts.opened, "hit opened", "hits opened");
    tell(facts.broke, "hit broke", "hits broke");
    tell(facts.late, "hit decided late", "hits decided late");
    tell(facts.born, "piece born", "pieces born");
    tell(facts.debris, "piece of debris", "pieces of debris");
    tell(facts.refused, "refusal", "refusals");
    tell(facts.frames_held, "body held", "bodies held");
    if (facts.units > 0) text += fmt::format("{:.1f} million units, ", 1e-6 * static_cast<double>(facts.units));
    if (text.empty()) text = "nothing broke, ";
    return fmt::format("worst frame {}: {:.2f} ms: {}{:.2f} ms in {}", worst.frame, worst.ms, text, worst.system_ms,
                       worst.system.empty() ? "no system" : worst.system);
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
