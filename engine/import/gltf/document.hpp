// A glTF file, text or binary, taken apart into its JSON and its bytes.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/import/gltf/part.hpp"

namespace cullet::gltf {

class Document {
 public:
    /// Throws a Refusal for what is no glTF 1 or 2. The path is that of the model: buffers lie beside it.
    Document(std::vector<uint8_t> bytes, const std::string& path);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const std::string& path() const { return path_; }
    Part root() const { return Part(json_, ""); }
    /// One of a list at the root ("nodes"), which `asker` names by its number.
    Part named(const char* list, const Part& asker) const;
    /// How many there are in a list at the root.
    size_t count(const char* list) const;
    bool is_version_1() const { return is_version_1_; }
    /// Of a .glb, without what pads it.
    std::span<const uint8_t> binary_chunk() const { return binary_; }
    bool has_binary_chunk() const { return has_binary_; }
    /// Sentences: what the file holds beside the format.
    const std::vector<std::string>& notes() const { return notes_; }

 private:
    std::string json_text_of_chunks();
    void read_json(std::string_view text);
    void read_version();

    std::string path_;
    std::vector<uint8_t> bytes_;  // the whole file; the binary chunk lies in it
    std::span<const uint8_t> binary_;
    nlohmann::json json_;
    std::vector<std::string> notes_;
    bool has_binary_ = false, is_version_1_ = false;
};

/// The bytes of a model. Throws a Refusal when they cannot be had.
std::vector<uint8_t> bytes_of_model(const std::string& path);

/// By the name's ending, or by the first bytes of a .glb.
bool is_gltf(const std::string& path);

}  // namespace cullet::gltf
