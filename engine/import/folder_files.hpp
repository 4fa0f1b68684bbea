// What a model may open: itself, and ordinary files in its own folder and below. A model that names "../../secret" gets
// nothing.
#pragma once
#include <assimp/DefaultIOSystem.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace cullet {

class FolderFiles : public Assimp::DefaultIOSystem {
 public:
    explicit FolderFiles(const std::string& model) : model_(canonical(model)), folder_(model_.parent_path()) {}

    bool Exists(const char* file) const override { return is_allowed(file) && DefaultIOSystem::Exists(file); }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        return is_allowed(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }

 private:
    static std::filesystem::path canonical(const std::string& file) {
        std::error_code trouble;
        return std::filesystem::canonical(file, trouble);
    }

    bool is_allowed(const char* file) const {
        const std::filesystem::path path = canonical(file);
        struct stat status {};
        if (path.empty() || ::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
        if (path == model_) return true;
        const std::string inside = folder_ == folder_.root_path() ? folder_.string() : folder_.string() + "/";
        return path.string().rfind(inside, 0) == 0;
    }

    std::filesystem::path model_, folder_;
};

}  // namespace cullet
