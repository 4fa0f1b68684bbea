#include "tests/support/data_files.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace cullet::test {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path inner = entry.path().lexically_relative(folder);
        const bool is_about =
            *inner.begin() == "README.md" || *inner.begin() == "LICENSES" || *inner.begin() == "tools";
        if (entry.is_regular_file() && !is_about) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool is_companion(const fs::path& file) {
    const std::string extension = file.extension();
    return extension == ".bin" || extension == ".json" || extension == ".vtk" || extension == ".node" ||
           extension == ".ele";
}

std::map<std::string, char> wanted_of_hostile(const fs::path& readme) {
    std::map<std::string, char> wanted;
    std::ifstream text(readme);
    bool is_inside = false;
    for (std::string line; std::getline(text, line);) {
        if (line.rfind("## ", 0) == 0) is_inside = line == "## Broken and awkward files";
        if (!is_inside || line.rfind("| ", 0) != 0 || line.size() < 6) continue;
        const std::string file = line.substr(2, line.find_first_of(" ,", 2) - 2);
        const char verdict = line[line.find_last_not_of(" |")];
        if (file != "file") wanted[file] = verdict;
    }
    return wanted;
}

}  // namespace cullet::test
