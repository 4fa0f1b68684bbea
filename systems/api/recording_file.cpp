#include "systems/api/recording_file.hpp"

#include <cerrno>
#include <cstring>

#include "engine/hash.hpp"

namespace cullet {
namespace {

constexpr char kMagic[8] = {'c', 'r', 'e', 'c', 'd', '\r', '\n', '\x1a'};
constexpr uint32_t kVersion = 11;
constexpr size_t kHeadBytes = 16, kChunkHeadBytes = 8, kChainBytes = 8;

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kChainCounts = false;
#else
constexpr bool kChainCounts = true;
#endif

uint64_t chain_of(uint64_t before, ChunkKind kind, std::span<const uint8_t> bytes) {
    const uint32_t head[2] = {static_cast<uint32_t>(kind), static_cast<uint32_t>(bytes.size())};
    return hash_bytes(bytes.data(), bytes.size(), hash_bytes(head, sizeof head, before));
}

}  // namespace

Result<std::FILE*> RecordingWriter::open(const std::string& path) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (!file)
        return Error{path + ": cannot be written (" + std::strerror(errno) + "); choose another file to record to."};
    uint8_t head[kHeadBytes] = {};
    std::memcpy(head, kMagic, sizeof kMagic);
    std::memcpy(head + sizeof kMagic, &kVersion, sizeof kVersion);
    std::fwrite(head, 1, sizeof head, file);
    return file;
}

RecordingWriter::~RecordingWriter() {
    std::fclose(file_);
}

void RecordingWriter::append(ChunkKind kind, std::span<const uint8_t> bytes) {
    if (!is_sound_) return;
    chain_ = chain_of(chain_, kind, bytes);
    const uint32_t head[2] = {static_cast<uint32_t>(kind), static_cast<uint32_t>(bytes.size())};
    is_sound_ = std::fwrite(head, 1, sizeof head, file_) == sizeof head &&
                std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size() &&
                std::fwrite(&chain_, 1, sizeof chain_, file_) == sizeof chain_ && std::fflush(file_) == 0;
}

Result<void> RecordingReader::begin() {
    if (bytes_.size() < kHeadBytes || std::memcmp(bytes_.data(), kMagic, sizeof kMagic) != 0)
        return Error{name_ +
                     ": is no recording (its first bytes are not those of one). Record one with "
                     "World::start_recording, or sample_game run ... --record."};
    uint32_t version = 0, zero = 0;
    std::memcpy(&version, bytes_.data() + 8, sizeof version);
    std::memcpy(&zero, bytes_.data() + 12, sizeof zero);
    if (version != kVersion || zero != 0)
        return Error{name_ + ": has version " + std::to_string(version) + ", this build reads version " +
                     std::to_string(kVersion) + ". Record it again with this build."};
    at_ = kHeadBytes;
    return {};
}

bool RecordingReader::next(Chunk& chunk) {
    if (at_ == bytes_.size() || !damage_.empty()) return false;
    const auto stop = [&](const std::string& what) {
        damage_ = name_ + ": from byte " + std::to_string(at_) + " on " + what +
                  "; what stands before it was replayed. Record again, or go on without the rest.";
        return false;
    };
    const size_t left = bytes_.size() - at_;
    uint32_t head[2] = {};
    if (left < kChunkHeadBytes) return stop("the file is cut off inside of a chunk's head");
    std::memcpy(head, bytes_.data() + at_, sizeof head);
    if (head[0] < 1 || head[0] > 3) return stop("there is no chunk (its kind is " + std::to_string(head[0]) + ")");
    if (head[1] > kMostChunkBytes || left - kChunkHeadBytes < size_t{head[1]} + kChainBytes)
        return stop("the file is cut off: a chunk of " + std::to_string(head[1]) + " bytes is not whole");
    chunk.kind = static_cast<ChunkKind>(head[0]);
    chunk.bytes = bytes_.subspan(at_ + kChunkHeadBytes, head[1]);
    chunk.first_byte = at_ + kChunkHeadBytes;
    uint64_t chain = 0;
    std::memcpy(&chain, chunk.bytes.data() + head[1], sizeof chain);
    const uint64_t wanted = chain_of(chain_, chunk.kind, chunk.bytes);
    if (kChainCounts && chain != wanted) return stop("a chunk is damaged: its checksum does not fit");
    chain_ = wanted;
    at_ += kChunkHeadBytes + head[1] + kChainBytes;
    return true;
}

}  // namespace cullet
