#include "engine/byte_stream.hpp"

namespace cullet {

void ByteWriter::put(const void* data, size_t size) {
    const auto* from = static_cast<const uint8_t*>(data);
    bytes.insert(bytes.end(), from, from + size);
}

std::span<const uint8_t> ByteReader::take(uint64_t size, const char* what) {
    if (is_sound() && size > left())
        fail(std::string(what) + " needs " + std::to_string(size) + " bytes, there are " + std::to_string(left()));
    if (!is_sound()) return {};
    at_ += size;
    return bytes_.subspan(at_ - size, size);
}

std::string ByteReader::text(const char* what) {
    const auto size = number<uint32_t>(what);
    if (size > kLongestText) fail(std::string(what) + " states " + std::to_string(size) + " bytes of text");
    const auto from = take(is_sound() ? size : 0, what);
    for (const uint8_t letter : from)
        if (letter < 32 || letter == 127) {
            fail(std::string(what) + " has the control character " + std::to_string(letter));
            return {};
        }
    return {from.begin(), from.end()};
}

uint32_t ByteReader::count(const char* what, size_t bytes_each, uint32_t most) {
    const auto count = number<uint32_t>(what);
    if (count > most || uint64_t{count} * bytes_each > left())
        fail(std::string(what) + " is " + std::to_string(count) + ", more than " +
             (count > most ? std::to_string(most) : "the bytes that are left can hold"));
    return is_sound() ? count : 0;
}

}  // namespace cullet
