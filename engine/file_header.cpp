#include "engine/file_header.hpp"

#include <bit>
#include <cstring>

#include "engine/checksum.hpp"

namespace cullet {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian and are copied as they stand");

struct Header {
    char magic[8];
    uint32_t version;
    uint32_t zero;
    uint64_t payload_bytes;
    uint64_t nothing;
    Checksum payload;
    Checksum header;  // of everything above
};
static_assert(sizeof(Header) == kFileHeaderBytes);

// A fuzzer cannot guess checksums, and what stands behind them is to be looked at too.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kChecksumsCount = false;
#else
constexpr bool kChecksumsCount = true;
#endif

}  // namespace

void finish_file(const FileKind& kind, std::vector<uint8_t>& bytes) {
    Header header{};
    std::memcpy(header.magic, kind.magic, sizeof header.magic);
    header.version = kind.version;
    header.payload_bytes = bytes.size() - sizeof header;
    header.payload = checksum_of(std::span<const uint8_t>(bytes).subspan(sizeof header));
    std::memcpy(bytes.data(), &header, sizeof header);
    header.header = checksum_of(std::span<const uint8_t>(bytes).first(offsetof(Header, header)));
    std::memcpy(bytes.data(), &header, sizeof header);
}

Result<std::span<const uint8_t>> payload_of(const FileKind& kind, std::span<const uint8_t> bytes,
                                            const std::string& name) {
    const auto damaged = [&](const std::string& what) { return Error{name + ": " + what + ". " + kind.if_damaged}; };
    Header header;
    if (bytes.size() < sizeof kind.magic || std::memcmp(bytes.data(), kind.magic, sizeof kind.magic) != 0)
        return Error{name + ": is no " + kind.what + " (its first bytes are not those of a " + kind.extension + "). " +
                     kind.how_to_get};
    if (bytes.size() < sizeof header)
        return damaged("ends inside the header, after " + std::to_string(bytes.size()) + " of 64 bytes");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.version != kind.version)
        return Error{name + ": has version " + std::to_string(header.version) + ", this build reads version " +
                     std::to_string(kind.version) + ". " + kind.if_older};
    if (kChecksumsCount && checksum_of(bytes.first(offsetof(Header, header))) != header.header)
        return damaged("the header's checksum does not fit");
    const uint64_t present = bytes.size() - sizeof header;
    if (header.payload_bytes != present || header.zero != 0 || header.nothing != 0)
        return damaged("the header states " + std::to_string(header.payload_bytes) + " bytes after it, there are " +
                       std::to_string(present));
    if (kChecksumsCount && checksum_of(bytes.subspan(sizeof header)) != header.payload)
        return damaged("the checksum of the data does not fit");
    return bytes.subspan(sizeof header);
}

}  // namespace cullet
