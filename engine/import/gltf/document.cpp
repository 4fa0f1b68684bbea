#include "engine/import/gltf/document.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "engine/import/text_encoding.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet::gltf {
namespace {

constexpr uint64_t kMostBytes = 1ull << 32;  // of a .glb, whose lengths have 32 bits
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;  // "JSON", "BIN\0"

bool begins_as_binary(const char* bytes, size_t size) {
    return size >= 4 && std::memcmp(bytes, "glTF", 4) == 0;
}

uint32_t word_at(const std::vector<uint8_t>& bytes, size_t at) {
    return static_cast<uint32_t>(bytes[at]) | static_cast<uint32_t>(bytes[at + 1]) << 8 |
           static_cast<uint32_t>(bytes[at + 2]) << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

/// With '?' for each byte that belongs to no character: names in the code page of somebody's machine.
std::string with_characters_only(std::string_view text) {
    std::string out(text);
    for (size_t i = 0; i < out.size(); ++i) {
        const int followers = utf8_followers(text.substr(i, 4));
        if (followers < 0)
            out[i] = '?';
        else
            i += static_cast<size_t>(followers);
    }
    return out;
}

/// What the parser says, without its own numbers of errors.
std::string reason_of(const nlohmann::json::exception& error) {
    const std::string said = error.what();
    const size_t begin = said.find("] ");
    return one_line(begin == said.npos ? said : said.substr(begin + 2), 160);
}

}  // namespace

Document::Document(std::vector<uint8_t> bytes, const std::string& path) : path_(path), bytes_(std::move(bytes)) {
    if (bytes_.empty()) throw Refusal("is empty", "Copy or export it again.");
    const char* begin = reinterpret_cast<const char*>(bytes_.data());
    if (begins_as_binary(begin, bytes_.size())) {
        const std::string text = json_text_of_chunks();
        if (!is_version_1_) read_json(text);
    } else {
        read_json(plain_text({begin, bytes_.size()}));
        bytes_ = {};
    }
    if (!is_version_1_) read_version();
}

/// Chunks of other kinds, and all after the second, are not ours to read: the format says so.
std::string Document::json_text_of_chunks() {
    if (bytes_.size() < kHeaderBytes) throw Refusal("ends within its header of 12 bytes");
    const uint32_t version = word_at(bytes_, 4), stated = word_at(bytes_, 8);
    is_version_1_ = version == 1;
    if (is_version_1_) return "";
    if (version != 2) throw Refusal("is binary glTF of version " + std::to_string(version) + ", not 2");
    if (stated > bytes_.size())
        throw Refusal("states a length of " + std::to_string(stated) + " bytes, but has " +
                      std::to_string(bytes_.size()));
    if (stated < bytes_.size())
        notes_.push_back("Passed over " + std::to_string(bytes_.size() - stated) + " bytes after the end it states.");
    std::string text;
    size_t at = kHeaderBytes;
    for (int chunk = 0; chunk < 2 && at < stated; ++chunk) {
        if (stated - at < kChunkHeaderBytes) throw Refusal("ends within the header of a chunk");
        const uint32_t length = word_at(bytes_, at), kind = word_at(bytes_, at + 4);
        at += kChunkHeaderBytes;
        if (length > stated - at)
            throw Refusal("has a chunk of " + std::to_string(length) + " bytes where " + std::to_string(stated - at) +
                          " are left");
        if (chunk == 0 && kind != kJsonChunk) throw Refusal("does not begin with a chunk of JSON");
        if (chunk == 0) text.assign(reinterpret_cast<const char*>(bytes_.data()) + at, length);
        if (chunk == 1 && kind == kBinaryChunk) binary_ = std::span(bytes_).subspan(at, length), has_binary_ = true;
        at += length;
    }
    text.erase(text.find_last_not_of('\0') + 1);  // blanks should pad it; zeros do in some programs
    return plain_text(text);
}

void Document::read_json(std::string_view text) {
    try {
        try {
            json_ = nlohmann::json::parse(text);
        } catch (const nlohmann::json::parse_error&) {
            const std::string readable = with_characters_only(text);
            if (readable == text) throw;
            json_ = nlohmann::json::parse(readable);
        }
    } catch (const nlohmann::json::exception& error) {
        throw Refusal("is no JSON: " + reason_of(error));
    }
}

void Document::read_version() {
    const std::string version = root().need("asset").need("version").text();
    is_version_1_ = version.rfind("1.", 0) == 0;
    if (is_version_1_) return;
    const auto least = root().need("asset").find("minVersion");
    if (version.rfind("2.", 0) != 0 || (least && least->text() != "2.0"))
        throw Refusal("is glTF " + one_line(least ? least->text() : version, 20) + ", not 2.0");
}

Part Document::named(const char* list, const Part& asker) const {
    const size_t there = count(list);
    const uint64_t number = asker.whole(kLargestWhole);
    if (number >= there)
        asker.refuse("is " + std::to_string(number) + ", but there are " + std::to_string(there) + " " + list);
    return root().need(list).item(number);
}

size_t Document::count(const char* list) const {
    const auto found = root().find(list);
    return found ? found->size() : 0;
}

std::vector<uint8_t> bytes_of_model(const std::string& path) {
    auto bytes = read_whole_file(path, kMostBytes);
    if (!bytes) throw Refusal("cannot be opened as an ordinary file");
    return std::move(*bytes);
}

bool is_gltf(const std::string& path) {
    const std::string extension = small_letters(std::filesystem::path(path).extension().string());
    if (extension == ".gltf" || extension == ".glb") return true;
    std::error_code trouble;
    if (!std::filesystem::is_regular_file(path, trouble)) return false;  // opening a pipe would wait
    char first[4] = {};
    std::ifstream(path, std::ios::binary).read(first, sizeof first);
    return begins_as_binary(first, sizeof first);
}

}  // namespace cullet::gltf
