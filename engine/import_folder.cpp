#include "engine/import_folder.hpp"

#include <sys/stat.h>

namespace cullet {
namespace {

namespace fs = std::filesystem;

fs::path canonical(const fs::path& path) {
    std::error_code trouble;
    return fs::canonical(path, trouble);
}

bool is_ordinary(const fs::path& path) {
    struct stat status {};
    return !path.empty() && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

/// Both real.
bool is_below(const fs::path& path, const fs::path& folder) {
    const std::string begin = folder == folder.root_path() ? folder.string() : folder.string() + "/";
    return path.string().rfind(begin, 0) == 0;
}

}  // namespace

ModelFolder::ModelFolder(const std::string& model)
    : given_(model.substr(0, model.rfind('/') + 1)), model_(canonical(model)), home_(model_.parent_path()) {}

std::string ModelFolder::find(const std::string& file) const {
    const fs::path real = canonical(file);
    return is_ordinary(real) && (real == model_ || is_below(real, home_)) ? real.string() : "";
}

}  // namespace cullet
