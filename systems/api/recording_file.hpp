// The file of a recording: chunks that are only ever appended, so that a run that is killed keeps all but the last.
//
// 16 bytes: magic "crecd\r\n\x1a", u32 version, u32 0. Then chunks: u32 kind, u32 bytes, the bytes, and the XXH3-64 of
// all that seeded with the one before, so that no chunk stands where it did not stand.
#pragma once
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/byte_stream.hpp"

namespace cullet {

enum class ChunkKind : uint32_t {
    Begin = 1,  // who recorded, and the world at that moment: a snapshot
    Calls = 2,  // what the game asked for before a step, in order; the step follows
    Step = 3,   // what came of it
};

inline constexpr uint32_t kMostChunkBytes = 1u << 31;

class RecordingWriter {
 public:
    /// Makes the file anew.
    static Result<std::FILE*> open(const std::string& path);
    explicit RecordingWriter(std::FILE* file) : file_(file) {}
    ~RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    /// Hands the chunk to the system before it returns. Once a write fails nothing more is written.
    void append(ChunkKind kind, std::span<const uint8_t> bytes);
    bool is_sound() const { return is_sound_; }

 private:
    std::FILE* file_;
    uint64_t chain_ = 0;
    bool is_sound_ = true;
};

struct Chunk {
    ChunkKind kind;
    uint64_t first_byte = 0;  // of its bytes, in the file
    std::span<const uint8_t> bytes;
};

/// Takes chunk after chunk off a file's bytes, as long as they are whole.
class RecordingReader {
 public:
    RecordingReader(std::span<const uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
    /// Refuses what does not begin like a recording of this build.
    Result<void> begin();
    /// False at the end, and at the first chunk that is not whole: damage() then tells.
    bool next(Chunk& chunk);
    const std::string& damage() const { return damage_; }
    float share() const { return bytes_.empty() ? 1 : static_cast<float>(at_) / static_cast<float>(bytes_.size()); }

 private:
    std::span<const uint8_t> bytes_;
    std::string name_, damage_;
    size_t at_ = 0;
    uint64_t chain_ = 0;
};

}  // namespace cullet
