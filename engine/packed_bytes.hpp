// Bytes packed by Zstandard, for files; `zstd -d` reads them, too.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

std::vector<uint8_t> pack(std::span<const uint8_t> bytes);

/// They begin as packed bytes do.
bool is_packed(std::span<const uint8_t> bytes);

/// Refuses with a sentence that begins with `name` what is damaged, and what grows beyond `most_bytes`. Memory is asked
/// for as the bytes come, whatever size the file claims to have.
Result<std::vector<uint8_t>> unpack(std::span<const uint8_t> bytes, const std::string& name, uint64_t most_bytes);

}  // namespace cullet
