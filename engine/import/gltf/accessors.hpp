// Numbers in the bytes of a glTF: of five kinds of integers and float, packed or with a stride, normalised or not, some
// of them replaced (sparse). They are converted when they are asked for, so that a thousand primitives that share one
// accessor cost no thousand copies.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/import/gltf/buffers.hpp"
#include "engine/math.hpp"

namespace cullet::gltf {

/// 5124 is none that a file may hold.
enum ComponentType : unsigned {
    kByte = 5120,
    kUnsignedByte = 5121,
    kShort = 5122,
    kUnsignedShort = 5123,
    kUnsignedInt = 5125,
    kFloat = 5126
};

/// Of one component.
unsigned bytes_of(unsigned component_type);

class Accessor {
 public:
    /// As the file describes it, with no data yet: its elements are zeros.
    explicit Accessor(const Part& part);

    std::string place;  // "accessors[3]"
    uint64_t count = 0;
    unsigned components = 1, component_type = kFloat;
    bool is_normalized = false;

    uint64_t element_bytes() const { return uint64_t{components} * bytes_of(component_type); }
    /// `row` below count and `component` below components, or it throws: indices come from the file.
    double number(uint64_t row, unsigned component) const;
    uint64_t whole(uint64_t row, unsigned component) const;
    /// The first three.
    Vec3d vector(uint64_t row) const { return {number(row, 0), number(row, 1), number(row, 2)}; }
    /// Whoever asks for more components than there are, or for other kinds, is told so.
    void expect_components(unsigned wanted) const;
    void expect_whole_numbers() const;

    /// Elements that stand in `bytes`, `step` bytes from one to the next; throws where they reach past the end.
    void put_data(std::span<const uint8_t> bytes, uint64_t offset, uint64_t step);
    /// The same for elements made by a decoder.
    void own_data(std::vector<uint8_t> bytes);
    /// Rows (rising) whose elements stand in `bytes` instead.
    void put_replacements(std::vector<uint32_t> rows, std::span<const uint8_t> bytes);

 private:
    const uint8_t* element(uint64_t row) const;

    const uint8_t* data_ = nullptr;  // nullptr: zeros
    uint64_t step_ = 0;
    std::vector<uint8_t> owned_;
    std::vector<uint32_t> replaced_;
    const uint8_t* replacements_ = nullptr;
};

class Accessors {
 public:
    explicit Accessors(const Document& document) : document_(document), buffers_(document) {}

    /// The accessor that `asker` names by its number. It stays where it is.
    const Accessor& at(const Part& asker);
    Buffers& buffers() { return buffers_; }

 private:
    void read_sparse(const Part& part, Accessor& accessor);

    const Document& document_;
    Buffers buffers_;
    std::map<uint64_t, Accessor> known_;
};

}  // namespace cullet::gltf
