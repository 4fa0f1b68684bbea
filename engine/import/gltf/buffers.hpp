// The bytes that a glTF names: in the file itself, beside it, or written into its text.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/import/gltf/document.hpp"
#include "engine/import/import_folder.hpp"

namespace cullet::gltf {

class Buffers {
 public:
    explicit Buffers(const Document& document) : document_(document), folder_(document.path()) {}
    Buffers(const Buffers&) = delete;
    Buffers& operator=(const Buffers&) = delete;

    /// The bytes of the buffer view that `asker` names by its number. They stay where they are.
    std::span<const uint8_t> view(const Part& asker);

 private:
    /// Read when it is first asked for: a file that nothing needs may be missing.
    std::span<const uint8_t> buffer(const Part& asker);
    std::span<const uint8_t> read(const Part& buffer, uint64_t number);

    const Document& document_;
    ModelFolder folder_;
    std::map<uint64_t, std::span<const uint8_t>> buffers_;
    std::map<uint64_t, std::vector<uint8_t>> owned_;
};

}  // namespace cullet::gltf
