// The shape of systems/, counted. Each bound is today's count and may only fall; what it is to become stands beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "systems/models.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

// Today's counts.
constexpr uint32_t kFilesWithState = 0;
constexpr uint32_t kUnnamedParameters = 0;
constexpr uint32_t kMutualFolders = 0;
constexpr uint32_t kWideSystems = 0;
constexpr uint32_t kManyTables = 24;
constexpr uint32_t kSystemsOfManyTables = 46;
constexpr uint32_t kPassesOfAFrame = 55;
constexpr uint32_t kFilesWithAModel = 0;
constexpr uint32_t kFilesWithAShell = 0;   // of births and tasks
constexpr uint32_t kSharedWithAShell = 0;  // of the other shared folders

struct Source {
    std::string path;    // "systems/structures/shell/ring.cpp"
    std::string folder;  // "damage", "models/thick_shell/hidden"; "" of systems/ itself
    std::string text;    // without comments
};

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Source> sources_of_systems() {
    static const std::regex comment("//[^\n]*");
    const fs::path root = source_folder();
    std::vector<Source> sources;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "systems")) {
        const std::string kind = entry.path().extension().string();
        if (kind != ".cpp" && kind != ".hpp") continue;
        const std::string folder = fs::relative(entry.path().parent_path(), root / "systems").generic_string();
        sources.push_back({fs::relative(entry.path(), root).generic_string(), folder == "." ? "" : folder,
                           std::regex_replace(text_of(entry.path()), comment, "")});
    }
    std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
    return sources;
}

uint32_t matches(const std::string& text, const std::regex& what) {
    return static_cast<uint32_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), what), std::sregex_iterator()));
}

/// Folders that each folder includes from.
std::map<std::string, std::set<std::string>> arrows(const std::vector<Source>& sources) {
    static const std::regex include("#include \"systems/([^\"]+)/[^/\"]+\"");
    std::map<std::string, std::set<std::string>> result;
    for (const Source& source : sources)
        for (std::sregex_iterator at(source.text.begin(), source.text.end(), include), end; at != end; ++at)
            if ((*at)[1] != source.folder) result[source.folder].insert((*at)[1]);
    return result;
}

/// Parameters of the functions that a header declares, by name.
std::map<std::string, uint32_t> parameter_counts(const std::string& header) {
    static const std::regex function("void (\\w+)\\(([^;{]*)\\);");
    std::map<std::string, uint32_t> counts;
    for (std::sregex_iterator at(header.begin(), header.end(), function), end; at != end; ++at)
        counts[(*at)[1]] = matches((*at)[2], std::regex(",")) + 1;
    return counts;
}

TEST(House, WholeStatesOutsideOfTheApiGetFewer) {
    // The binder, world_data, hands its tables out. Keep::State is of columns.
    static const std::regex whole_state("(^|[^:\\w])State\\b");
    uint32_t files = 0;
    std::string named;
    for (const Source& source : sources_of_systems()) {
        if (source.folder.starts_with("api") || source.path.starts_with("systems/world_data.")) continue;
        if (!std::regex_search(source.text, whole_state)) continue;
        ++files;
        named += "\n  " + source.path;
    }
    EXPECT_LE(files, kFilesWithState) << "files that name the whole State; wanted: 0; today:" << named;
}

TEST(House, TableParametersWithoutANameGetFewer) {
    static const std::regex unnamed("[(,]\\s*(const )?[A-Z]\\w*(<[\\w:]+>)?&(?=[,)])");
    uint32_t parameters = 0;
    for (const Source& source : sources_of_systems())
        if (source.path.ends_with(".cpp")) parameters += matches(source.text, unnamed);
    EXPECT_LE(parameters, kUnnamedParameters) << "a parameter without a name hides what a function reaches";
}

TEST(House, FoldersThatIncludeEachOtherGetFewer) {
    const auto to = arrows(sources_of_systems());
    uint32_t pairs = 0;
    std::string named;
    for (const auto& [folder, others] : to)
        for (const std::string& other : others)
            if (folder < other && to.contains(other) && to.at(other).contains(folder)) {
                ++pairs;
                named += "\n  " + folder + " and " + other;
            }
    EXPECT_LE(pairs, kMutualFolders) << "wanted: 0; today:" << named;
}

TEST(House, SharedFilesThatIncludeAModelGetFewer) {
    // The list of models alone is to name them.
    static const std::regex model("#include \"systems/models/[^\"]+/");
    uint32_t files = 0;
    std::string named;
    for (const Source& source : sources_of_systems()) {
        if (source.folder.starts_with("models") || !std::regex_search(source.text, model)) continue;
        ++files;
        named += "\n  " + source.path;
    }
    EXPECT_LE(files, kFilesWithAModel) << "wanted: 0; today:" << named;
}

/// Of files in these folders, those that know what a shell or a solid is made of.
std::vector<std::string> files_with_a_shell(const std::set<std::string>& folders) {
    static const std::regex shell(
        "structures/(?:shell|tetrahedra)/"
        "|\\b(is_shell|is_solid|ShellView|ShellRows|Shells|shells|shell_of|Vertices|Elements|Hinges|"
        "(?:make|release|copy)_shell)\\b|Row<Structures> shell\\b");
    std::vector<std::string> files;
    for (const Source& source : sources_of_systems())
        if (folders.contains(source.folder) && std::regex_search(source.text, shell)) files.push_back(source.path);
    return files;
}

std::string lines_of(const std::vector<std::string>& files) {
    std::string all;
    for (const std::string& file : files) all += "\n  " + file;
    return all;
}

TEST(House, SharedFilesThatKnowAShellGetFewer) {
    const auto own = files_with_a_shell({"births", "tasks"});
    EXPECT_LE(own.size(), kFilesWithAShell) << "births and tasks; wanted: 0; today:" << lines_of(own);
    const auto others = files_with_a_shell({"", "impacts", "bodies", "hulls", "drawn", "checks"});
    EXPECT_LE(others.size(), kSharedWithAShell) << "wanted: 0; today:" << lines_of(others);
}

TEST(House, SystemsWithMoreThanNineParametersGetFewer) {
    uint32_t wide = 0;
    std::string named;
    for (const Source& source : sources_of_systems())
        if (source.path.ends_with("systems.hpp"))
            for (const auto& [name, count] : parameter_counts(source.text))
                if (count > 9) {
                    ++wide;
                    named += "\n  " + name + " " + std::to_string(count);
                }
    EXPECT_LE(wide, kWideSystems) << "wanted: 0; today:" << named;
}

/// Names in "reads  a, b, c" or "writes ..." of a printed system.
void add_tables(const std::string& line, std::set<std::string>& names) {
    static const std::regex table("[ ]([a-z_]+)");  // what is no table begins with a capital
    const std::string list = line.substr(line.find_first_not_of(' ') + 6);
    for (std::sregex_iterator at(list.begin(), list.end(), table), end; at != end; ++at) names.insert((*at)[1]);
}

// Of the printed frame and its inner loops: what asks models and structures in turn reaches all that they have. What
// works for one of them is to declare what it needs.
TEST(House, SystemsThatReachManyTablesGetFewer) {
    const std::string frame = make_frame_plan(false, *damage_models()).describe();
    std::istringstream lines(frame);
    std::map<std::string, std::set<std::string>> reached;
    std::string system;
    uint32_t passes = 0;
    for (std::string line; std::getline(lines, line);) {
        static const std::regex head("(?:pass (\\d+)  )?(\\w+)  \\[(?:rows|bodies|serial)\\]");
        std::smatch found;
        if (std::regex_search(line, found, head)) {
            system = found[2];
            if (found[1].matched) passes = std::max(passes, static_cast<uint32_t>(std::stoul(found[1])));
        } else if (line.find("  reads  ") != line.npos || line.find("  writes ") != line.npos) {
            add_tables(line, reached[system]);
        }
    }
    ASSERT_GT(reached.size(), 40u) << frame;
    uint32_t many = 0;
    std::string named;
    for (const auto& [name, tables] : reached)
        if (tables.size() > kManyTables) {
            ++many;
            named += "\n  " + name + " " + std::to_string(tables.size());
        }
    EXPECT_LE(many, kSystemsOfManyTables) << "wanted: those that ask in turn; today:" << named;
    EXPECT_LE(passes, kPassesOfAFrame);
}

}  // namespace
}  // namespace cullet
