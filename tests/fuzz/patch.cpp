#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "tests/fuzz/fuzz.hpp"

namespace cullet::fuzz {
namespace {

constexpr size_t kLargestFile = 1u << 20;

/// The bytes of an input, zeros behind its end.
struct Stream {
    std::span<const uint8_t> bytes;
    uint32_t take(uint32_t count) {
        uint32_t value = 0;
        for (uint32_t k = 0; k < count && !bytes.empty(); ++k, bytes = bytes.subspan(1))
            value |= uint32_t{bytes[0]} << (8 * k);
        return value;
    }
};

enum Edit : uint32_t { kSet1, kSet2, kSet4, kSpecial, kAdd, kCopy, kCutEnd, kRepeatOrErase, kEdits };

uint32_t special(uint32_t n) {
    constexpr float inf = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
    const uint32_t values[] = {0,
                               1,
                               0xffffffffu,
                               0xfffffffeu,
                               0x7fffffffu,
                               0x80000000u,
                               0xffffu,
                               std::bit_cast<uint32_t>(inf),
                               std::bit_cast<uint32_t>(-inf),
                               std::bit_cast<uint32_t>(none),
                               std::bit_cast<uint32_t>(1e30f),
                               std::bit_cast<uint32_t>(-1e30f),
                               std::bit_cast<uint32_t>(1e-30f),
                               std::bit_cast<uint32_t>(1.0f)};
    return values[n % std::size(values)];
}

void put(Bytes& file, size_t place, uint32_t value, size_t size) {
    std::memcpy(file.data() + place, &value, std::min(size, file.size() - place));
}
uint32_t get(const Bytes& file, size_t place) {
    uint32_t value = 0;
    std::memcpy(&value, file.data() + place, std::min(sizeof value, file.size() - place));
    return value;
}

void edit(Bytes& file, Stream& in) {
    const size_t place = in.take(3) % file.size();
    switch (in.take(1) % kEdits) {
        case kSet1:
            return put(file, place, in.take(1), 1);
        case kSet2:
            return put(file, place, in.take(2), 2);
        case kSet4:
            return put(file, place, in.take(4), 4);
        case kSpecial:
            return put(file, place, special(in.take(1)), 4);
        case kAdd:
            return put(file, place, get(file, place) + static_cast<uint32_t>(static_cast<int8_t>(in.take(1))), 4);
        case kCopy:
            return put(file, place, get(file, in.take(3) % file.size()), 4);
        case kCutEnd:
            return file.resize(place);
        case kRepeatOrErase:
            break;
    }
    const uint32_t count = in.take(1);
    const auto at = file.begin() + static_cast<ptrdiff_t>(place);
    const auto length = static_cast<ptrdiff_t>(std::min(size_t{count / 2} + 1, file.size() - place));
    if (count % 2 == 0) {
        file.erase(at, at + length);
    } else if (file.size() < kLargestFile) {
        const Bytes again(at, at + length);
        file.insert(at, again.begin(), again.end());
    }
}

}  // namespace

const std::vector<Bytes>& seeds_of(const Format& format) {
    static std::map<const Format*, std::vector<Bytes>> made;
    const auto found = made.find(&format);
    return found != made.end() ? found->second : made[&format] = format.make_seeds();
}

Bytes file_of(const Format& format, std::span<const uint8_t> input) {
    const std::vector<Bytes>& seeds = seeds_of(format);
    Stream in{input};
    const uint32_t seed = in.take(1) % static_cast<uint32_t>(seeds.size() + 1);
    Bytes file = seed == 0 ? Bytes(in.bytes.begin(), in.bytes.end()) : seeds[seed - 1];
    const size_t before = file.size();
    while (seed != 0 && !in.bytes.empty() && !file.empty()) edit(file, in);
    format.seal(file, file.size() != before);
    return file;
}

// Half of the inputs only change a few numbers by a little: those get furthest.
Bytes mutation(uint32_t n) {
    const Random random{0xf0220};
    uint32_t k = 0;
    const auto below = [&](uint32_t limit) { return static_cast<uint32_t>(random.uniform(n, k++) * limit); };
    Bytes input{static_cast<uint8_t>(below(255) + 1)};
    const uint32_t edits = 1 + below(4);
    const bool is_small = below(2) == 0;
    for (uint32_t e = 0; e < edits; ++e) {
        const uint32_t place = below(1u << 24);
        input.insert(input.end(), {static_cast<uint8_t>(place), static_cast<uint8_t>(place >> 8),
                                   static_cast<uint8_t>(place >> 16)});
        const uint32_t kind = is_small ? kSpecial + below(3) : below(kEdits);
        input.push_back(static_cast<uint8_t>(kind));
        const uint32_t operand[] = {1, 2, 4, 1, 1, 3, 0, 1};
        for (uint32_t b = 0; b < operand[kind]; ++b) input.push_back(static_cast<uint8_t>(below(256)));
    }
    return input;
}

}  // namespace cullet::fuzz
