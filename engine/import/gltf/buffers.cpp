#include "engine/import/gltf/buffers.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet::gltf {
namespace {

constexpr uint64_t kMostBytes = 1ull << 33;  // of a file; the limit on memory comes first

int value_of_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

/// Nothing for a text that holds another character. Line ends are passed over, '=' ends it.
std::optional<std::vector<uint8_t>> decoded_base64(std::string_view text) {
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t collected = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '\n' || c == '\r' || c == ' ') continue;
        if (c == '=') break;
        const int value = value_of_digit(c);
        if (value < 0) return std::nullopt;
        collected = (collected << 6 | static_cast<uint32_t>(value)) & 0xFFFFu;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<uint8_t>(collected >> bits));
    }
    return bytes;
}

std::vector<uint8_t> decoded_data_uri(const Part& uri) {
    const std::string_view text = uri.text();
    const size_t comma = text.find(',');
    constexpr std::string_view kBase64 = ";base64";
    if (comma == text.npos || comma < kBase64.size() ||
        !is_word(text.substr(comma - kBase64.size(), kBase64.size()), kBase64))
        uri.refuse("is data that is not written in base64");
    auto bytes = decoded_base64(text.substr(comma + 1));
    if (!bytes) uri.refuse("is no base64");
    return std::move(*bytes);
}

}  // namespace

std::span<const uint8_t> Buffers::read(const Part& buffer, uint64_t number) {
    const auto uri = buffer.find("uri");
    if (!uri) {
        if (number == 0 && document_.has_binary_chunk()) return document_.binary_chunk();
        buffer.refuse("has no \"uri\", and there are no bytes for it in the file");
    }
    if (is_word(uri->text().substr(0, 5), "data:")) return owned_[number] = decoded_data_uri(*uri);
    const std::string file = folder_.find_beside(uri->text());
    if (file.empty())
        uri->refuse("names \"" + one_line(uri->text(), 200) + "\", which is not in the folder of the model or below");
    auto bytes = read_whole_file(file, kMostBytes);
    if (!bytes) uri->refuse("names \"" + one_line(uri->text(), 200) + "\", which cannot be read");
    return owned_[number] = std::move(*bytes);
}

std::span<const uint8_t> Buffers::buffer(const Part& asker) {
    const Part buffer = document_.named("buffers", asker);
    const uint64_t number = asker.whole(kLargestWhole);
    const auto known = buffers_.find(number);
    if (known != buffers_.end()) return known->second;
    const uint64_t length = buffer.need("byteLength").whole(kLargestWhole);
    const std::span<const uint8_t> bytes = read(buffer, number);
    if (bytes.size() < length)
        buffer.refuse("has " + std::to_string(bytes.size()) + " bytes, not the " + std::to_string(length) +
                      " of its \"byteLength\"");
    return buffers_[number] = bytes.first(length);
}

std::span<const uint8_t> Buffers::view(const Part& asker) {
    const Part view = document_.named("bufferViews", asker);
    const Part number = view.need("buffer");
    const Part buffer_part = document_.named("buffers", number);
    for (const char* packed : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (view.find({"extensions", packed}) && !buffer_part.find("uri") && number.whole(kLargestWhole) != 0)
            throw Refusal(view.place() + " is packed by the extension \"" + packed + "\", which is not read",
                          "Export the model without it.");
    const std::span<const uint8_t> bytes = buffer(number);
    const uint64_t offset = view.whole("byteOffset", 0, kLargestWhole);
    const uint64_t length = view.need("byteLength").whole(kLargestWhole);
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.refuse("reaches to byte " + std::to_string(offset + length) + " of a buffer of " +
                    std::to_string(bytes.size()));
    return bytes.subspan(offset, length);
}

}  // namespace cullet::gltf
