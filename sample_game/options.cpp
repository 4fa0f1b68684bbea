#include "sample_game/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <utility>

#include "cullet/model.hpp"
#include "cullet/version.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/scene.hpp"
#include "sample_game/truth.hpp"

namespace cullet {
namespace {

const std::map<std::string, HashWhen> kHashWhen{
    {"every", HashWhen::Every}, {"last", HashWhen::Last}, {"off", HashWhen::Off}};

const std::map<std::string, PictureLook> kLooks{{"material", PictureLook::Material}, {"pieces", PictureLook::Pieces}};

/// CLI11's own prints six digits, whatever the ends are: "not in range 0.000000 to 1000000.000000".
template <class T>
CLI::Validator within(T least, T most) {
    const auto check = [least, most](std::string& text) -> std::string {
        const std::string_view digits = std::string_view(text).substr(text.starts_with('+'));
        T value{};
        const auto [end, trouble] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (trouble == std::errc() && end == digits.data() + digits.size() && value >= least && value <= most)
            return {};
        constexpr const char* kKind = std::is_integral_v<T> ? "whole number" : "number";
        return fmt::format("\"{}\" is no {} from {} to {}", text, kKind, least, most);
    };
    return {check, fmt::format("{} in [{} - {}]", std::is_integral_v<T> ? "UINT" : "FLOAT", least, most)};
}

/// How many letters to change, put in or leave out.
size_t letters_between(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t before = std::exchange(row[0], i);
        for (size_t j = 1; j <= b.size(); ++j)
            before = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, before + (a[i - 1] != b[j - 1])}));
    }
    return row[b.size()];
}

/// " Did you mean --frames?", or nothing where no name is near.
std::string guess(std::string_view word, const std::vector<std::string>& names) {
    size_t least = 1 + std::clamp<size_t>(word.size() / 3, 2, 3);
    std::string nearest;
    for (const std::string& name : names)
        if (const size_t away = letters_between(word, name); away < least) least = away, nearest = name;
    return nearest.empty() ? "" : " Did you mean " + nearest + "?";
}

std::string scene_names() {
    std::string names;
    for (const Scene& scene : scenes()) names += std::string(scene.name) + ", ";
    return names + "show_reel, or a file that ends in .lua";
}

std::string version_line() {
    return fmt::format("sample_game of cullet {}", version());
}

std::string shown(const Scene& scene) {
    ScenePlan plan;
    plan.scene = scene;
    const Result<Story> story = read_story(plan);
    return story.ok() ? story->shows : story.error();
}

std::string scene_list() {
    std::string text = "Scenes:\n";
    for (const Scene& scene : scenes()) text += fmt::format("  {:<10} {}\n", scene.name, shown(scene));
    return text + "  show_reel  wall, vase, pane, drop and demolition, one after another, with pictures\n";
}

std::string model_names() {
    return fmt::format("{}", fmt::join(damage_model_names(), ", "));
}

void add_run(CLI::App& app, RunOptions& run) {
    CLI::App* command = app.add_subcommand("run", "Plays a scene or a script and says how it went");
    command->footer(scene_list);
    command->add_option("scene", run.scene, "A scene of the list below, or a file that ends in .lua");
    command
        ->add_option(
            "--mesh", run.mesh,
            "A model file for scenes that take one, in any format of docs/importing.md; or vase, pig, cow, castle, "
            "castle_fine, slab, piggy_bank, wall, pane, car, drum, bowl")
        ->check(CLI::Validator(
            [](const std::string& name) { return std::string(name.empty() ? "the name is empty; give a file" : ""); },
            ""));
    command->add_option("--materials", run.materials, "A TOML file that adds and changes materials")
        ->check(CLI::Validator(
            [](const std::string& name) { return std::string(name.empty() ? "the name is empty; give a file" : ""); },
            ""));
    command->add_option("--model", run.model,
                        "How what is cooked breaks: " + model_names() + "; as the material says if not given");
    command->add_option("--frames", run.frames, "How many steps; the scene's own number if not given")
        ->check(within(1u, 1'000'000u));
    command->add_option("--dt-ms", run.dt_ms, "Milliseconds a step")->check(within(1000.0 / 240, 1000.0 / 20));
    command->add_option("--threads", run.threads, "Threads that step the world; all if not given")
        ->check(within(1u, 64u));
    command->add_option("--repeat", run.repeat, "Plays so often and takes each frame's least time")
        ->check(within(1u, 1000u));
    command->add_option("--out", run.out, "Folder for report.html, report.json, pictures and the trace");
    command->add_option("--draw", run.draw, "Draws every so many frames")->check(within(1u, 1'000'000u));
    command
        ->add_option_function<std::string>(
            "--look", [&run](const std::string& look) { run.look = kLooks.at(look); },
            "Of pictures: material, as things look, or pieces, a colour a piece and lines between them; material if "
            "not given")
        ->check(CLI::IsMember({"material", "pieces"}));
    command->add_option("--width", run.width, "Of pictures, pixels, 16 to 9; 960 if not given")
        ->check(within(160u, 3840u));
    command->add_flag("--contact-sheet", run.has_sheet, "Twelve frames in one picture, sheet.png");
    command->add_flag("--video", run.has_video, "A film of the run, film.mp4; needs the program ffmpeg");
    command->add_option("--trace", run.trace, "Chrome trace of the last repeat, for Perfetto");
    command->add_option("--record", run.record, "Writes down the run's calls and hashes, for replay");
    command
        ->add_option_function<std::string>(
            "--hash", [&run](const std::string& when) { run.hash = kHashWhen.at(when); },
            "When the state is hashed: every, last, off")
        ->check(CLI::IsMember({"every", "last", "off"}));
    command->add_flag("--validate", run.validates, "Checks every table after every system");
    command->add_option("--set", run.set, "KEY=VALUE, a setting of the scene; --set help lists them");
}

// A setting of a damage model's own, by its list: --joins-walls false.
void add_setting(CLI::App& command, CookOptions& cook, const Setting& setting) {
    std::string option = std::string("--") + setting.name;
    std::replace(option.begin(), option.end(), '_', '-');
    if (command.get_option_no_throw(option)) return;  // two models have it: one option
    const auto is_right = [setting](const std::string& text) { return read_setting(setting, text).error(); };
    command
        .add_option_function<std::string>(
            option, [&cook, name = setting.name](const std::string& text) { cook.of_model[name] = text; },
            fmt::format("{} ({}); {} if not given", setting.help, range_of(setting),
                        text_of(setting, setting.standard)))
        ->check(CLI::Validator(is_right, ""));
}

void add_cook(CLI::App& app, CookOptions& cook) {
    CLI::App* command = app.add_subcommand("cook", "Cooks a mesh into a model file (.cmodel), so that a game need not");
    command->add_option("mesh", cook.mesh, "A model file in any format of docs/importing.md, or a .cmesh")->required();
    command->add_option("--out", cook.out, "The model file to write")->required();
    command->add_option("--model", cook.model, "How it breaks; as the material says if not given")
        ->check(CLI::IsMember(damage_model_names()));
    command->add_option("--material", cook.material, "One of " + MaterialTable().names() + ", or of --materials")
        ->capture_default_str();
    command->add_option("--materials", cook.materials, "A TOML file that adds and changes materials");
    command->add_option("--fracture", cook.fracture, "How near to each other cracks start; the material's if not given")
        ->check(CLI::IsMember({"large", "coarse", "fine"}));
    command->add_option("--thickness-m", cook.thickness_m, "Of the wall, m; 1.5 % of the largest side if not given")
        ->check(within(1e-9, 1e6));
    command
        ->add_option("--edge-m", cook.edge_m, "Longer edges are split first, m; what suits the thickness if not given")
        ->check(within(1e-9, 1e6));
    command->add_option("--weld", cook.weld, "Points so near are one, as a share of the diagonal; 1e-7 heals noise")
        ->check(within(0.0, 0.01));
    command->add_option("--seed", cook.seed, "Of the spread of strength")->capture_default_str();
    for (const auto& group : all_cook_settings())
        for (const Setting& setting : group.list) add_setting(*command, cook, setting);
    command
        ->add_option("--draw", cook.draw,
                     "cells: a picture, beside the model file, of what the mesh is cut into: sub-shells of metal")
        ->check(CLI::IsMember({"cells"}));
    command->add_flag("--walls-apart", cook.keeps_walls_apart,
                      "A mesh with both of its walls becomes two sheets, not one as thick as measured");
}

void add_replay(CLI::App& app, ReplayOptions& replay) {
    CLI::App* command = app.add_subcommand("replay", "Plays a recording again and names the first thing that differs");
    command->add_option("file", replay.file, "What run --record wrote")->required();
    command->add_option("--against", replay.against, "Numbers of threads, one run each: 1,2,8")
        ->delimiter(',')
        ->check(within(1u, 64u));
}

void add_reproduce(CLI::App& app, reproduce::CommandOptions& options) {
    CLI::App* command =
        app.add_subcommand("reproduce", "Writes a page of a paper's claims beside ours: tables, numbers, pictures");
    command->add_option("model", options.model, "Damage model whose published work it is: " + reproduce::known_models())
        ->required();
    command->add_option("--out", options.out, "Folder for report.html, report.json and the pictures")->required();
    command->add_option("--data", options.data,
                        "Folder of test meshes; CULLET_TEST_DATA or ../shared/data if not given");
    command->add_option("--threads", options.threads, "Threads that step worlds and draw; all if not given")
        ->check(within(1u, 64u));
    command->add_option("--only", options.only, "One claim by its id, such as figure_3");
    command->add_flag(
        "--reduced", options.is_reduced,
        "Smaller meshes and fewer repeats, for a look in a minute; its numbers are not the paper's cases");
}

void add_fem(CLI::App& app, FemOptions& options) {
    CLI::App* command =
        app.add_subcommand("fem", "A dent of sheet metal beside a curve of a shell FEM; or the deck for one");
    FemCase& sheet = options.sheet;
    FemBlow& blow = options.blow;
    command->add_option("--curve", options.curve, "Text of a reference: places and deflections after unloading, work");
    command->add_option("--results", options.results, "What ccx printed (NAME.dat) of a deck with these parameters");
    command->add_option("--deck", options.deck, "Writes a deck for ccx to this file, and compares nothing");
    command->add_option("--out", options.out, "Folder for mid_line.csv");
    command->add_option("--work-j", blow.work, "Of the blow; the curve's if not given")->check(within(1e-3, 1e9));
    command->add_option("--width-m", sheet.width, "Along the mid-line")->check(within(0.01, 100.0));
    command->add_option("--height-m", sheet.height, "Across it")->check(within(0.01, 100.0));
    command->add_option("--thickness-m", sheet.thickness, "Of the sheet")->check(within(1e-5, 0.1));
    command->add_option("--material", sheet.material, "steel, aluminium or copper");
    command->add_option("--young-pa", sheet.young_modulus, "Of the deck")->check(within(1e6, 1e13));
    command->add_option("--yield-pa", sheet.yield_stress, "Of both")->check(within(1e5, 1e10));
    command->add_option("--patch-m", sheet.patch, "Side of the pressed square")->check(within(1e-3, 10.0));
    command->add_option("--pressure-pa", sheet.pressure, "On it, of the deck")->check(within(1.0, 1e10));
    command->add_option("--ball-m", blow.ball_radius, "Radius of our ball; 0: its contact is as large as the patch")
        ->check(within(0.0, 10.0));
    command->add_option("--columns", blow.columns, "Of our mesh")->check(within(4u, 1000u));
    command->add_option("--rows", blow.rows, "Of our mesh")->check(within(4u, 1000u));
    command->add_option("--cells", blow.cells, "Sub-shells")->check(within(4u, 512u));
    command->add_flag("--published", options.is_published, "Every switch as published");
}

/// What CLI11 cannot know.
Result<void> check_run(const RunOptions& run, bool asks_for_keys) {
    if (asks_for_keys) return {};
    if (run.scene.empty()) return Error{"run: which scene? Give one of " + scene_names() + "."};
    if (run.scene != "show_reel" && !find_scene(run.scene) && !run.scene.ends_with(".lua"))
        return Error{fmt::format("run {}: there is no such scene; give one of {}.", run.scene, scene_names())};
    const std::vector<std::string> models = damage_model_names();
    if (!run.model.empty() && std::find(models.begin(), models.end(), run.model) == models.end())
        return Error{fmt::format("--model {}: there is no such model; this version has {}.", run.model, model_names())};
    if (run.scene == "show_reel" && !run.trace.empty() && run.out.empty())
        return Error{"--trace: the show reel writes a trace for each scene; say where with --out FOLDER."};
    if (run.scene == "show_reel" && !run.record.empty())
        return Error{"--record: the show reel is five runs; record one of its scenes."};
    if (run.out.empty() && (run.draw > 0 || run.has_sheet || run.has_video))
        return Error{"--draw, --contact-sheet and --video write pictures: say where with --out FOLDER."};
    return {};
}

std::string command_names(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) names += ", " + command->get_name();
    return names.substr(2);
}

/// CLI11 takes a first word that it does not know for an argument without a command, and misses the command.
Result<void> check_command(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty()) return Error{"Which command? Give one of " + command_names(app) + "; --help tells of them."};
    const std::string& first = arguments[0];
    if (first.starts_with("-") && app.get_option_no_throw(first) == nullptr)
        return Error{
            fmt::format("{}: there is no such option before the command; --help shows what can be given.", first)};
    const auto has_name = [&](const CLI::App* command) { return command->get_name() == first; };
    if (first.starts_with("-") || !app.get_subcommands(has_name).empty()) return {};
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    return Error{
        fmt::format("{}: there is no such command; give one of {}.{}", first, command_names(app), guess(first, names))};
}

std::string where_to_look(const CLI::App& app) {
    const auto given = app.get_subcommands();
    return "sample_game " + (given.empty() ? "" : given[0]->get_name() + " ") + "--help shows what can be given.";
}

std::vector<std::string> option_names(const CLI::App& app) {
    const auto given = app.get_subcommands();
    std::vector<std::string> names;
    for (const CLI::Option* option : (given.empty() ? app : *given[0]).get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::string one_sentence(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    if (!text.empty() && text.back() != '.') text += '.';
    return text;
}

/// Of an option that stands without what belongs to it. CLI11 begins with its name and goes on in its own words.
std::string lacking(const CLI::App& app, const std::string& said) {
    const std::string name = said.substr(0, said.find(':'));
    const auto given = app.get_subcommands();
    const CLI::App& command = given.empty() ? app : *given[0];
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (option == nullptr || said.find("missing") == said.npos) return one_sentence(said);
    const std::string type = option->get_type_name();
    const bool is_number = type.starts_with("UINT") || type.starts_with("INT") || type.starts_with("FLOAT");
    return name + ": wants " + (is_number ? "a number." : "a word behind it.");
}

}  // namespace

Result<Options> parse_options(std::vector<std::string> arguments) {
    Options options;
    CLI::App app("Things that shatter, without a window.", "sample_game");
    app.require_subcommand(1);
    app.set_version_flag("--version", version_line);
    add_run(app, options.run);
    add_cook(app, options.cook);
    add_replay(app, options.replay);
    add_reproduce(app, options.reproduce);
    add_fem(app, options.fem);
    app.add_subcommand("settings", "Prints what can be set of each damage model: default, range, what it is");
    app.add_subcommand("frame", "Prints the systems of a frame, and what each reads and writes");
    CLI::App* truth = app.add_subcommand("truth",
                                         "Prints the verification cases of a method: figure, bounds, verdict; the "
                                         "last, speeds of first cracks and pieces, takes minutes");
    truth->add_option("model", options.truth.model, "Damage model: " + truth_models())->required();
    truth
        ->add_option("--placements", options.truth.placements,
                     "Seeded placements of each scene for the medians; the bands are judged on the first 20")
        ->check(within(1u, 1000u));
    truth->add_option("--threads", options.truth.threads, "Threads that share the placements; 2 if not given")
        ->check(within(1u, 64u));
    truth->add_option("--out", options.truth.out, "Folder for truth.json");
    app.footer(scene_list);
    if (const Result<void> known = check_command(app, arguments); !known.ok()) return Error{known.error()};
    try {
        std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        options.help = app.help();  // of the command, where one was given
        return options;
    } catch (const CLI::CallForVersion&) {
        options.help = version_line() + "\n";
        return options;
    } catch (const CLI::ExtrasError&) {
        const std::string extra = app.remaining(true).at(0);
        const char* what = extra.starts_with("-") ? "there is no such option" : "one argument too many";
        const std::string word = extra.substr(0, extra.find('='));
        return Error{fmt::format("{}: {}.{} {}", extra, what, guess(word, option_names(app)), where_to_look(app))};
    } catch (const CLI::ArgumentMismatch& error) {
        return Error{lacking(app, error.what()) + " " + where_to_look(app)};
    } catch (const CLI::ParseError& error) {
        return Error{one_sentence(error.what()) + " " + where_to_look(app)};
    }
    options.command = app.got_subcommand("run")         ? Command::Run
                      : app.got_subcommand("frame")     ? Command::Frame
                      : app.got_subcommand("settings")  ? Command::Settings
                      : app.got_subcommand("cook")      ? Command::Cook
                      : app.got_subcommand("replay")    ? Command::Replay
                      : app.got_subcommand("reproduce") ? Command::Reproduce
                      : app.got_subcommand("fem")       ? Command::Fem
                                                        : Command::Truth;
    if (options.command != Command::Run) return options;
    const bool asks_for_keys =
        std::find(options.run.set.begin(), options.run.set.end(), "help") != options.run.set.end();
    if (auto checked = check_run(options.run, asks_for_keys); !checked.ok()) return Error{checked.error()};
    if (asks_for_keys) options.command = Command::KeysHelp;
    return options;
}

}  // namespace cullet
