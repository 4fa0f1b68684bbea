// How assimp opens files: those that a model may open (import_folder.hpp), and no others. Text is handed on as UTF-8
// without a byte order mark, which assimp takes for a part of the first word.
#pragma once
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "engine/import/import_folder.hpp"
#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"

namespace cullet {

class FolderFiles : public Assimp::DefaultIOSystem {
 public:
    explicit FolderFiles(const std::string& model) : model_(model), folder_(model) {}

    bool Exists(const char* file) const override { return is_model(file) || !folder_.find(file).empty(); }

    /// The bytes as they are on the disk.
    Assimp::IOStream* open_as_it_is(const std::string& file, const char* mode = "rb") {
        const std::string real = folder_.find(file);
        return real.empty() ? nullptr : DefaultIOSystem::Open(real.c_str(), mode);
    }

    /// What is handed on in place of the model's own bytes, under its name or another one.
    void replace_model(std::string text, const std::string& name) {
        model_text_ = std::move(text);
        model_ = name;
    }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (is_model(file)) return in_memory(*model_text_);
        std::unique_ptr<Assimp::IOStream> stream(open_as_it_is(file, mode));
        if (stream == nullptr) return nullptr;
        const std::string extension = small_letters(std::filesystem::path(file).extension().string());
        char bytes[4] = {};
        const std::string_view front(bytes, stream->Read(bytes, 1, sizeof bytes));
        stream->Seek(0, aiOrigin_SET);
        const bool is_coded = has_byte_order_mark(front) || (kTexts.count(extension) > 0 && is_like_utf16(front));
        if (!is_coded) return stream.release();
        return in_memory(plain_text(whole(*stream)));
    }

    static std::string whole(Assimp::IOStream& stream) {
        std::string bytes(stream.FileSize(), '\0');
        bytes.resize(stream.Read(bytes.data(), 1, bytes.size()));
        return bytes;
    }

 private:
    bool is_model(const std::string& file) const {
        if (!model_text_) return false;
        return file == model_ || (!folder_.find(file).empty() && folder_.find(file) == folder_.find(model_));
    }

    /// Formats of text, which may be UTF-16 without a mark. With a mark any file is text.
    inline static const std::set<std::string> kTexts{".off", ".dae",  ".fbx", ".x3d", ".amf", ".ase", ".ac",
                                                     ".nff", ".enff", ".raw", ".xml", ".smd", ".x",   ".dxf"};

    static Assimp::IOStream* in_memory(const std::string& text) {
        auto bytes = std::make_unique<uint8_t[]>(text.size());
        std::memcpy(bytes.get(), text.data(), text.size());
        return new Assimp::MemoryIOStream(bytes.release(), text.size(), true);
    }

    std::string model_;
    ModelFolder folder_;
    std::optional<std::string> model_text_;
};

}  // namespace cullet
