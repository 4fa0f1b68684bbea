#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "sample_game/film.hpp"
#include "sample_game/notes.hpp"
#include "sample_game/report_page.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

constexpr const char* kShowReel[] = {"wall", "vase", "pane", "drop", "demolition"};

int refuse(const std::string& sentence, int code) {
    fmt::print(stderr, "{}\n", sentence);
    return code;
}

void print_summary(const Report& r) {
    fmt::print("{}: {} frames of {:.2f} ms on {} threads, seed {}\n", r.scene, r.frames, 1000 * r.dt_s, r.threads,
               r.seed);
    if (!r.hash.empty())
        fmt::print("  hash         {}{}{}\n", r.hash, r.hash_chain.empty() ? "" : ", all frames ", r.hash_chain);
    fmt::print("  fragments    {} born, {} live, {} bodies asleep, {} awake, {} retired, {} debris, {} faded\n",
               r.fragments.born, r.fragments.live, r.fragments.asleep, r.awake.bodies, r.fragments.retired,
               r.fragments.debris, r.fragments.faded);
    fmt::print("  hits         {} opened, {} broke, {} late, {} dropped, {} frames held\n", r.tasks.opened,
               r.tasks.broke, r.tasks.late, r.tasks.dropped, r.tasks.frames_held);
    if (r.units.slow_soft_frames > 0)
        fmt::print("  slower       soft bodies had too few units in {} frames of theirs\n", r.units.slow_soft_frames);
    // A closed shell of rubber falls in under its own weight at some hundreds; a framed sheet hardly shows it.
    if (r.units.softening > 10)
        fmt::print(
            "  softened     a soft body has springs of 1/{:.0f} of its stiffness, to fit a frame: fewer and "
            "longer edges, or more units_a_frame, make it stiffer\n",
            r.units.softening);
    fmt::print(
        "  rest         {:.1f} % asleep; of {} drawn at rest: sink 95 % {:.2f}, worst {:.2f} mm, into each other 95 % "
        "{:.2f}, worst {:.2f} mm, hover 95 % {:.2f}, worst {:.2f} mm, {} fell through\n",
        100 * r.rest.asleep_share, r.rest.measured, r.rest.sink_p95_mm, r.rest.sink_max_mm, r.rest.overlap_p95_mm,
        r.rest.overlap_max_mm, r.rest.hover_p95_mm, r.rest.hover_max_mm, r.rest.through);
    fmt::print("  mass         {:.6f} kg put in, {:.6f} kg at the end\n", r.mass_kg.start, r.mass_kg.end);
    fmt::print("  kinetic      {:.4g} J at the most, {:.4g} J at the end\n", r.energy_j.peak, r.energy_j.end);
    fmt::print("  frame        p50 {:.2f}  p99 {:.2f}  worst {:.2f} ms\n", r.frame_ms.p50, r.frame_ms.p99,
               r.frame_ms.max);
    fmt::print(
        "  broke        in {} frames, worst {:.2f} ms, hitch {:.2f}; {} frames worked on hits, p99 {:.2f} budgets\n",
        r.fracture_frames.count, r.fracture_frames.max_ms, r.hitch, r.damage_frames.count, r.damage_frames.p99_budgets);
    fmt::print("{}  {}\n", systems_table(r), worst_frame_line(r));
    fmt::print("  allocations  {} in steps from frame {} on, {} of the rigid engine\n", r.allocations_in_frames,
               kFirstCountedFrame, r.allocations_in_rigid);
    for (const auto& [setting, count] : r.refused)
        fmt::print("  refused      {} times: {}\n", count,
                   setting == "longest_edge" ? "cook with a shorter longest edge, which gives cracks more room"
                   : setting.find(' ') != setting.npos ? setting
                                                       : "raise " + setting);
    for (const std::string& fault : r.fault_list) fmt::print("  fault        {}\n", fault);
    for (const std::string& note : counted_notes(r.notes)) fmt::print("  note         {}\n", note);
}

void print_files(const RunOptions& options) {
    if (options.has_sheet) fmt::print("  {}/sheet.png      twelve frames of the story in one picture\n", options.out);
    if (options.draw > 0) fmt::print("  {}/frame_*.png    every {} frames\n", options.out, options.draw);
    if (!options.out.empty()) fmt::print("  {}/report.html    the run on a page: open it in a browser\n", options.out);
    if (!options.out.empty()) fmt::print("  {}/report.json    what the run was like, in numbers\n", options.out);
    if (!options.record.empty())
        fmt::print("  {}      what was asked and what came of it: sample_game replay plays it again\n", options.record);
    if (options.has_video) fmt::print("  {}/film.mp4       the run as a film\n", options.out);
    if (!options.trace.empty())
        fmt::print("  {}      where the time went: open it in ui.perfetto.dev\n", options.trace);
}

/// What is wrong with the mesh of --mesh is told without the line of the script that asked for it.
int refuse_run(const std::string& sentence, const RunOptions& options) {
    if (options.mesh.empty()) return refuse(sentence, 1);
    std::error_code error;
    for (const std::string& path : {options.mesh, std::filesystem::absolute(options.mesh, error).string()})
        for (const std::string& place : {"--mesh " + path, path + ": "})
            if (const size_t at = sentence.find(place); !path.empty() && at != std::string::npos)
                return refuse(sentence.substr(at), 2);
    return refuse(sentence, 1);
}

/// A file that is written at the end, or beside the run, must have a folder before it begins.
Result<void> check_place(const std::string& option, const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (path.empty() || folder.empty() || std::filesystem::is_directory(folder, error)) return {};
    return Error{fmt::format("{} {}: there is no folder {}; make it first.", option, path, folder.string())};
}

int run_one(const Scene& scene, const RunOptions& options) {
    const ScenePlan plan = plan_scene(scene, options);
    if (const Result<Story> story = read_story(plan); !story.ok()) return refuse(story.error(), 2);
    if (options.has_video)
        if (const auto found = look_for_ffmpeg(); !found.ok()) return refuse(found.error(), 2);
    std::error_code error;
    if (!options.out.empty()) std::filesystem::create_directories(options.out, error);
    if (error)
        return refuse(fmt::format("--out {}: {}; choose a folder that can be made.", options.out, error.message()), 2);
    for (const auto& [option, path] : {std::pair("--trace", options.trace), std::pair("--record", options.record)})
        if (const Result<void> place = check_place(option, path); !place.ok()) return refuse(place.error(), 2);
    const Result<Report> report = play(plan, options);
    if (!report.ok()) return refuse_run(report.error(), options);
    print_summary(report.value());
    if (!options.out.empty()) {
        for (const auto& [name, text] : {std::pair("/report.json", to_json(report.value())),
                                         std::pair("/report.html", report_page(report.value(), options))})
            if (auto written = write_text(text, options.out + name); !written.ok()) return refuse(written.error(), 1);
    }
    print_files(options);
    return report.value().repeats_agree ? 0 : 1;
}

bool has_key(const Scene& scene, const std::string& assignment) {
    const Result<Story> story = read_story(plan_scene(scene, {}));
    return story.ok() && story->keys.has(assignment.substr(0, assignment.find('=')));
}

/// Keys that a scene does not have are another scene's.
RunOptions for_scene(const Scene& scene, const RunOptions& options) {
    RunOptions own = options;
    own.scene = scene.name;
    own.set.clear();
    for (const std::string& assignment : options.set)
        if (has_key(scene, assignment)) own.set.push_back(assignment);
    if (own.scene != "drop") own.mesh.clear();
    own.trace.clear();
    if (!options.out.empty()) {
        own.out = options.out + "/" + scene.name;
        own.trace = own.out + "/trace.json";
        own.has_sheet = true;
    }
    return own;
}

int run_show_reel(const RunOptions& options) {
    for (const std::string& assignment : options.set) {
        bool is_known = false;
        for (const char* name : kShowReel) is_known = is_known || has_key(*find_scene(name), assignment);
        if (!is_known)
            return refuse(
                fmt::format("--set {}: no scene of the show reel has this key; --set help lists them.", assignment), 2);
    }
    for (const char* name : kShowReel) {
        const Scene& scene = *find_scene(name);
        fmt::print("\n{}\n", read_story(plan_scene(scene, {})).value().shows);
        std::fflush(stdout);
        if (const int code = run_one(scene, for_scene(scene, options)); code != 0) return code;
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int run_command(const RunOptions& options) {
    if (options.scene == "show_reel") return run_show_reel(options);
    const Result<Scene> scene = load_scene(options.scene);
    if (!scene.ok()) return refuse(scene.error(), 2);
    return run_one(scene.value(), options);
}

Result<std::string> keys_help(const std::string& scene_name) {
    std::vector<Scene> wanted(scenes().begin(), scenes().end());
    if (!scene_name.empty() && scene_name != "show_reel") {
        Result<Scene> scene = load_scene(scene_name);
        if (!scene.ok()) return Error{scene.error()};
        wanted = {std::move(scene).value()};
    }
    std::string text;
    for (const Scene& scene : wanted) {
        const Result<Story> story = read_story(plan_scene(scene, {}));
        if (!story.ok()) return Error{story.error()};
        text += fmt::format("{}: {}\n{}\n", scene.name, story->shows, story->keys.help());
    }
    return text;
}

}  // namespace cullet
