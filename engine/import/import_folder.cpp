#include "engine/import/import_folder.hpp"

#include <sys/stat.h>

namespace cullet {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path) {
    std::error_code trouble;
    return fs::canonical(path, trouble);
}

bool is_ordinary(const fs::path& path) {
    struct stat status {};
    return !path.empty() && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool is_link(const fs::path& path) {
    std::error_code trouble;
    return fs::is_symlink(path, trouble);
}

/// -1 for what is no hexadecimal digit.
int digit_of(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 32);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// Each %XX as its byte. "" when there is none, or when one stands for the end of a C string.
std::string decoded_name(const std::string& name) {
    std::string out;
    for (size_t i = 0; i < name.size(); ++i) {
        const int high = name[i] == '%' && i + 2 < name.size() ? digit_of(name[i + 1]) : -1;
        const int low = high >= 0 ? digit_of(name[i + 2]) : -1;
        if (low < 0) {
            out += name[i];
            continue;
        }
        if (high == 0 && low == 0) return "";
        out += static_cast<char>(16 * high + low);
        i += 2;
    }
    return out.size() == name.size() ? "" : out;
}

/// Both real. Nothing is below a folder that is not there.
bool is_below(const fs::path& path, const fs::path& folder) {
    const std::string begin = folder == folder.root_path() ? folder.string() : folder.string() + "/";
    return !folder.empty() && path.string().rfind(begin, 0) == 0;
}

}  // namespace

ModelFolder::ModelFolder(const std::string& model)
    : given_(model.substr(0, model.rfind('/') + 1)),
      is_link_(is_link(model)),
      model_(real_path(model)),
      home_(model_.parent_path()),
      link_home_(real_path(given_.empty() ? "." : given_)) {}

std::string ModelFolder::allowed(const std::string& file) const {
    const fs::path real = real_path(file);
    if (!is_ordinary(real)) return "";
    if (real == model_ || is_below(real, home_) || is_below(real, link_home_)) return real.string();
    if (!is_link_) return "";
    // Only the last step may lead out: its folder, with every link and ".." followed, is inside.
    const fs::path folder = real_path(fs::path(file).has_parent_path() ? fs::path(file).parent_path() : ".");
    return folder == link_home_ || is_below(folder, link_home_) ? real.string() : "";
}

std::string ModelFolder::find(const std::string& file) const {
    std::string found = allowed(file);
    if (!found.empty()) return found;
    // The folder's own name is not the model's to encode.
    const size_t name = file.rfind(given_, 0) == 0 ? given_.size() : 0;
    const std::string decoded = decoded_name(file.substr(name));
    return decoded.empty() ? "" : allowed(file.substr(0, name) + decoded);
}

}  // namespace cullet
