// README and docs/*.md name nothing that the program does not know: settings, calls, options, keys, files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "cullet/world.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/options.hpp"
#include "sample_game/report.hpp"
#include "sample_game/run_scene.hpp"
#include "sample_game/script/script.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> pages() {
    std::vector<fs::path> list{fs::path(source_folder()) / "README.md"};
    for (const auto& file : fs::directory_iterator(fs::path(source_folder()) / "docs"))
        if (file.path().extension() == ".md") list.push_back(file.path());
    return list;
}

/// All that the pattern finds in the text: the first group, or all where it has none.
std::vector<std::string> found_in(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::vector<std::string> list;
    for (std::sregex_iterator at(text.begin(), text.end(), wanted), end; at != end; ++at)
        list.push_back((*at)[at->size() > 1 ? 1 : 0]);
    return list;
}

constexpr const char* kWord = "[A-Za-z_][A-Za-z0-9_]*";

void add_words(Names& names, const std::string& text) {
    for (std::string& word : found_in(text, kWord)) names.insert(std::move(word));
}

/// Calls what is wanted for each file below the folder, by its path.
template <class Visit>
void each_file(const std::string& folder, const Visit& visit) {
    for (const auto& file : fs::recursive_directory_iterator(fs::path(source_folder()) / folder))
        if (file.is_regular_file()) visit(file.path());
}

/// What the text of our sources says between quotation marks: names of arguments, keys, fields, options.
void add_quoted(Names& names, const fs::path& file) {
    if (file.extension() != ".cpp" && file.extension() != ".hpp" && file.extension() != ".lua") return;
    for (const std::string& quoted : found_in(text_of(file), "\"([^\"\\n]*)\"")) add_words(names, quoted);
}

std::string help_of(std::vector<std::string> arguments) {
    arguments.push_back("--help");
    return parse_options(arguments).value().help;
}

/// The help of every command, and of the program that imports.
std::string all_help() {
    std::string text = help_of({}) + test::run_program({build_folder() + "/cullet_import", "--help"}).output;
    for (const char* command : {"run", "cook", "replay", "reproduce", "truth", "fem", "frame"}) text += help_of({command});
    return text;
}

// Comments are left out: a name that only a comment still has is what this is to find.
Names known_names() {
    Names names;
    each_file("engine/include/cullet", [&](const fs::path& file) {
        std::string text = text_of(file);
        add_words(names, std::regex_replace(text, std::regex("//[^\n]*"), ""));
    });
    add_words(names, all_help());
    add_words(names, keys_help("").value());
    add_words(names, to_json(Report()));
    add_words(names, World::describe_frame());
    for (const char* folder : {"sample_game", "engine/import", "systems", "perf"})
        each_file(folder, [&](const fs::path& file) { add_quoted(names, file); });
    // Files and folders, targets, and what the environment may say.
    for (const char* folder : {"engine", "components", "systems", "sample_game", "tests", "perf", "scripts", "docs"})
        each_file(folder, [&](const fs::path& file) {
            add_words(names, fs::relative(file, source_folder()).string());
            if (file.extension() != ".cpp") return;
            for (const std::string& variable : found_in(text_of(file), "getenv\\(\"(\\w+)\"\\)"))
                names.insert(variable);
        });
    add_words(names, text_of(fs::path(source_folder()) / "CMakeLists.txt"));
    add_words(names, text_of(fs::path(source_folder()) / "CMakePresets.json"));
    return names;
}

/// Names that are somebody else's, or that a page makes up to show something with.
const Names kOthers{"XDG_CACHE_HOME", "BUILD_SHARED_LIBS", "RTLD_LOCAL", "RTLD_DEEPBIND", "X_UP", "Y_UP",
                    "Z_UP",           "is_over",           "is_ovr"};

/// The page without its blocks of code, which tests of their own build and run.
std::string prose_of(const fs::path& page) {
    std::string prose;
    bool is_code = false;
    std::ifstream file(page);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("```"))
            is_code = !is_code;
        else if (!is_code)
            prose += line + "\n";
    return prose;
}

/// What the headers of the sources name, for the page that tells how they are built.
Names names_of_headers() {
    Names names;
    for (const char* folder : {"engine", "components", "systems"})
        each_file(folder, [&](const fs::path& file) {
            if (file.extension() == ".hpp")
                add_words(names, std::regex_replace(text_of(file), std::regex("//[^\n]*"), ""));
        });
    return names;
}

TEST(Docs, NameOnlyWhatTheProgramKnows) {
    const Names public_names = known_names(), inner_names = names_of_headers();
    ASSERT_FALSE(public_names.contains("mesh_vertices"));
    size_t checked = 0;
    for (const fs::path& page : pages()) {
        Names known = public_names;
        if (page.filename() == "architecture.md") known.insert(inner_names.begin(), inner_names.end());
        for (const std::string& span : found_in(prose_of(page), "`([^`\\n]+)`"))
            for (std::string word : found_in(span, "[A-Za-z_][A-Za-z0-9_]*_[A-Za-z0-9_]*|[A-Za-z]\\w*(?=::)|::\\w+")) {
                if (word.starts_with("::")) word = word.substr(2);
                if (word.starts_with("DCULLET_") || word.starts_with("DBUILD_")) word = word.substr(1);  // -D of CMake
                ++checked;
                EXPECT_TRUE(known.contains(word) || kOthers.contains(word))
                    << page.filename() << ": `" << span << "`: nothing knows " << word;
            }
    }
    EXPECT_GT(checked, 200u);
}

TEST(Docs, NameOnlySceneKeysThatASceneHas) {
    const std::string help = keys_help("").value();
    size_t checked = 0;
    for (const fs::path& page : pages()) {
        const std::string text = text_of(page);
        for (const std::string& key : found_in(text, "\\bscene\\.[a-z_]+\\b")) {
            ++checked;
            EXPECT_NE(help.find("    " + key + " "), std::string::npos) << page.filename() << ": " << key;
        }
        for (const std::string& key : found_in(text, "--set ([a-z_.]+)[=` ]")) {
            if (key == "help") continue;
            ++checked;
            EXPECT_NE(help.find("    " + key + " "), std::string::npos) << page.filename() << ": --set " << key;
        }
    }
    EXPECT_GT(checked, 10u);
}

TEST(Docs, NameOnlyOptionsThatAProgramHas) {
    // Those of CMake, CTest and our scripts and measurements, which have no help to ask for.
    std::string help =
        all_help() + " --build --target --preset --install --prefix --component --static --cflags --libs ";
    each_file("scripts", [&](const fs::path& file) { help += text_of(file); });
    each_file("perf", [&](const fs::path& file) {
        if (file.extension() == ".cpp") help += text_of(file);
    });
    size_t checked = 0;
    for (const fs::path& page : pages())
        for (const std::string& option : found_in(text_of(page), "(?:^|[\\s`(])(--[a-z][a-z-]+)")) {
            ++checked;
            EXPECT_TRUE(std::regex_search(help, std::regex(option + "(?![a-z-])")))
                << page.filename() << ": no program has " << option;
        }
    EXPECT_GT(checked, 40u);
}

/// "" or the sentence that ends a script that reads the name.
std::string trouble_with(const std::string& expression) {
    RunOptions options;
    options.threads = 1;
    Stage stage;
    stage.plan = plan_scene({"docs", "docs.lua",
                             "local body = game.throw{radius = 0.1, mass = 1, at = {0, 1, 0}}\n"
                             "local mesh = game.mesh.box{half_extents = {1, 1, 1}}\n"
                             "local it = " +
                                 expression + "\n"},
                            options);
    Script script(stage);
    const Result<void> done = script.start();
    return done.ok() ? "" : done.error();
}

TEST(Docs, NameOnlyCallsThatAScriptHas) {
    Names calls, methods;
    for (const fs::path& page : pages()) {
        const std::string text = text_of(page);
        for (const std::string& call : found_in(text, "\\bgame\\.(?:mesh\\.)?[a-z_]+\\b(?!\\.)")) calls.insert(call);
        if (page.filename() == "scripting.md")
            for (const std::string& method : found_in(text, "\\b[a-z]+:([a-z_]+)[({]")) methods.insert(method);
    }
    EXPECT_GT(calls.size(), 30u);
    EXPECT_GT(methods.size(), 12u);
    for (const std::string& call : calls) EXPECT_EQ(trouble_with(call), "") << call;
    for (const std::string& method : methods)
        EXPECT_TRUE(trouble_with("body." + method).empty() || trouble_with("mesh." + method).empty()) << method;
    EXPECT_NE(trouble_with("game.explod"), "");
    EXPECT_NE(trouble_with("body.explode"), "");
}

TEST(Docs, HaveTheTableOfAllSettingsOfDamageModels) {
    const std::string page = text_of(fs::path(source_folder()) / "docs/scripting.md");
    EXPECT_NE(page.find(settings_table()), std::string::npos)
        << "docs/scripting.md has another table than `sample_game settings` prints:\n"
        << settings_table();
}

}  // namespace
}  // namespace cullet
