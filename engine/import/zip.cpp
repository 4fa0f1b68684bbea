#include "engine/import/zip.hpp"

#include <minizip/unzip.h>

#include "engine/import/words.hpp"

namespace cullet {
namespace {

constexpr size_t kMostNames = 1 << 16, kLongestName = 1024;

std::string key_of(const std::string& name) {
    const std::string small = small_letters(name);
    return small.substr(small.find_first_not_of('/') == small.npos ? 0 : small.find_first_not_of('/'));
}

}  // namespace

ZipFile::ZipFile(const std::string& path) : archive_(unzOpen64(path.c_str())) {
    if (archive_ == nullptr) return;
    char name[kLongestName];
    for (int at = unzGoToFirstFile(archive_); at == UNZ_OK && names_.size() < kMostNames;
         at = unzGoToNextFile(archive_)) {
        if (unzGetCurrentFileInfo64(archive_, nullptr, name, sizeof name, nullptr, 0, nullptr, 0) != UNZ_OK) break;
        name[sizeof name - 1] = 0;
        names_.emplace_back(name);
    }
}

ZipFile::~ZipFile() {
    if (archive_ != nullptr) unzClose(archive_);
}

std::optional<std::string> ZipFile::read(const std::string& name) const {
    if (archive_ == nullptr) return std::nullopt;
    size_t i = 0;
    while (i < names_.size() && key_of(names_[i]) != key_of(name)) ++i;
    if (i == names_.size() || unzGoToFirstFile(archive_) != UNZ_OK) return std::nullopt;
    for (; i > 0; --i)
        if (unzGoToNextFile(archive_) != UNZ_OK) return std::nullopt;
    if (unzOpenCurrentFile(archive_) != UNZ_OK) return std::nullopt;
    std::string bytes(1 << 16, '\0');
    size_t done = 0;
    int count = 0;
    while ((count = unzReadCurrentFile(archive_, bytes.data() + done, static_cast<unsigned>(bytes.size() - done))) >
           0) {
        done += static_cast<size_t>(count);
        if (done == bytes.size()) bytes.resize(2 * done);
    }
    const bool is_whole = unzCloseCurrentFile(archive_) == UNZ_OK && count == 0;
    if (!is_whole) return std::nullopt;
    bytes.resize(done);
    return bytes;
}

}  // namespace cullet
