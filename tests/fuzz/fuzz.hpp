// What the fuzz programs and fuzz_corpus_test share: file formats, good files of each, and inputs that say what to
// change in them. A fuzzer that changes bytes blindly never gets past the first table; one that edits good files does.
//
// An input: u8 s; with s % (seeds + 1) = 0 the rest is the file itself, else seed number s % (seeds + 1) - 1 and
// edits: u24 place, u8 kind, operand (patch.cpp). Good files are made by the build that reads them, so that inputs stay
// of use when the formats change. What is read has its checksums made to fit.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/random.hpp"

namespace cullet::fuzz {

using Bytes = std::vector<uint8_t>;

struct Format {
    const char* name;                             // of its folder in corpus/
    std::vector<Bytes> (*make_seeds)();           // good files
    void (*seal)(Bytes& file, bool is_resized);   // makes checksums fit, and the stated size too
    bool (*read)(std::span<const uint8_t> file);  // true: it was accepted, and worked with
};

extern const Format mesh_file, model_file, snapshot, recording;

/// Made at the first call.
const std::vector<Bytes>& seeds_of(const Format& format);
/// The file that an input stands for.
Bytes file_of(const Format& format, std::span<const uint8_t> input);
inline bool run(const Format& format, std::span<const uint8_t> input) {
    return format.read(file_of(format, input));
}
/// Input number n of an endless list, the same everywhere: a seed with one to four edits.
Bytes mutation(uint32_t n);

/// Of files that begin with engine/file_header.hpp.
void seal_file(Bytes& file, bool is_resized);
/// False when the settings that stand at this place of a file ask for more memory or work than the good files' do:
/// those are honest wishes, but no machine fulfils 200,000 of them. Also true where no settings are.
bool has_small_settings(std::span<const uint8_t> file, size_t place);
/// The same for all snapshots that stand somewhere in the bytes.
bool has_small_snapshots(std::span<const uint8_t> file);

}  // namespace cullet::fuzz
