#include "engine/packed_bytes.hpp"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

namespace cullet {
namespace {

constexpr uint8_t kFirstBytes[] = {0x28, 0xB5, 0x2F, 0xFD};  // of every frame of Zstandard's

struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

template <class Context>
std::unique_ptr<Context, Free> owned(Context* context) {
    if (!context) throw std::bad_alloc();
    return std::unique_ptr<Context, Free>(context);
}

Error damaged(const std::string& name, const std::string& why) {
    return Error{name + ": cannot be unpacked: " + why + ". The file is damaged; write it again."};
}

}  // namespace

std::vector<uint8_t> pack(std::span<const uint8_t> bytes) {
    const auto context = owned(ZSTD_createCCtx());
    // What bodies of one model have in common lies megabytes apart: long distances find it, and the quickest level does
    // for the rest.
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 1);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_enableLongDistanceMatching, 1);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    std::vector<uint8_t> packed(ZSTD_compressBound(bytes.size()));
    const size_t size = ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size)) throw std::bad_alloc();  // nothing else can go wrong with as much room
    packed.resize(size);
    packed.shrink_to_fit();
    return packed;
}

bool is_packed(std::span<const uint8_t> bytes) {
    return bytes.size() >= std::size(kFirstBytes) &&
           std::memcmp(bytes.data(), kFirstBytes, std::size(kFirstBytes)) == 0;
}

Result<std::vector<uint8_t>> unpack(std::span<const uint8_t> bytes, const std::string& name, uint64_t most_bytes) {
    constexpr size_t kFirstRoom = 1u << 20;
    const auto context = owned(ZSTD_createDCtx());
    const uint64_t claimed = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (claimed == ZSTD_CONTENTSIZE_ERROR) return damaged(name, "its header is no header of Zstandard");
    std::vector<uint8_t> unpacked;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    size_t used = 0;
    for (size_t left = 1; left > 0;) {
        if (used == unpacked.size())
            unpacked.resize(std::min<uint64_t>(most_bytes + 1, std::max(kFirstRoom, 2 * unpacked.size())));
        ZSTD_outBuffer out{unpacked.data(), unpacked.size(), used};
        left = ZSTD_decompressStream(context.get(), &out, &in);
        if (ZSTD_isError(left)) return damaged(name, ZSTD_getErrorName(left));
        if (out.pos > most_bytes)
            return Error{name + ": holds more than " + std::to_string(most_bytes) + " bytes when it is unpacked."};
        if (left > 0 && out.pos == used && in.pos == in.size) return damaged(name, "it ends too early");
        used = out.pos;
    }
    if (in.pos < in.size) return damaged(name, std::to_string(in.size - in.pos) + " bytes follow its end");
    unpacked.resize(used);
    return unpacked;
}

}  // namespace cullet
