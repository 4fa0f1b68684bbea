// What a model may open: itself, and ordinary files in its own folder and below. A model that names "../../secret" gets
// nothing. An OBJ file is handed on with ".5" written "0.5": assimp 5.2 takes the former for no number, and the vertex
// for none.
#pragma once
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <sys/stat.h>

#include <cctype>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

namespace cullet {

class FolderFiles : public Assimp::DefaultIOSystem {
 public:
    explicit FolderFiles(const std::string& model) : model_(canonical(model)), folder_(model_.parent_path()) {}

    bool Exists(const char* file) const override { return is_allowed(file) && DefaultIOSystem::Exists(file); }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (!is_allowed(file)) return nullptr;
        std::unique_ptr<Assimp::IOStream> stream(DefaultIOSystem::Open(file, mode));
        if (stream == nullptr || !is_obj(file)) return stream.release();
        std::string text(stream->FileSize(), '\0');
        if (stream->Read(text.data(), 1, text.size()) != text.size()) return nullptr;
        const size_t size_before = text.size();
        text = with_leading_zeros(text);
        if (text.size() == size_before) {
            stream->Seek(0, aiOrigin_SET);
            return stream.release();
        }
        auto bytes = std::make_unique<uint8_t[]>(text.size());
        std::memcpy(bytes.get(), text.data(), text.size());
        return new Assimp::MemoryIOStream(bytes.release(), text.size(), true);
    }

 private:
    static std::filesystem::path canonical(const std::string& file) {
        std::error_code trouble;
        return std::filesystem::canonical(file, trouble);
    }

    static bool is_obj(const std::string& file) {
        std::string end = std::filesystem::path(file).extension().string();
        for (char& letter : end) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        return end == ".obj";
    }

    /// Lines of points, normals and uvs ("v", "vn", "vt") with ".5" written "0.5"; the others as they are.
    static std::string with_leading_zeros(const std::string& text) {
        std::string out;
        out.reserve(text.size());
        bool is_vertex = false;
        char before = '\n';
        for (const char c : text) {
            if (before == '\n') is_vertex = c == 'v';
            if (is_vertex && c == '.' && (before == ' ' || before == '\t')) out += '0';
            out += c;
            before = c;
        }
        return out;
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
