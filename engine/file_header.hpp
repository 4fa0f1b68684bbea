// The 64 bytes that begin a file of ours, little-endian:
//
//     0  8 bytes  magic, ending in "\r\n\x1a"
//     8  u32      version
//    12  u32      0
//    16  u64      bytes of the payload, which follows
//    24  u64      0
//    32  2 u64    XXH3-128 of the payload
//    48  2 u64    XXH3-128 of the 48 bytes before
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

inline constexpr size_t kFileHeaderBytes = 64;

struct FileKind {
    char magic[8];
    uint32_t version;
    const char* what;        // "model file"
    const char* extension;   // ".cmodel"
    const char* how_to_get;  // a sentence for those who gave another kind of file
    const char* if_damaged;  // a sentence: what to do about a damaged one
    const char* if_older;    // a sentence: what to do about another version
};

/// Bytes whose first 64 are still free, and the payload after them: writes the header.
void finish_file(const FileKind& kind, std::vector<uint8_t>& bytes);
/// The payload of a sound header whose checksums fit; or a sentence.
Result<std::span<const uint8_t>> payload_of(const FileKind& kind, std::span<const uint8_t> bytes,
                                            const std::string& name);

}  // namespace cullet
