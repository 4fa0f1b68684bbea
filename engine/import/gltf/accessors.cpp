#include "engine/import/gltf/accessors.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cullet::gltf {
namespace {

constexpr uint64_t kMostElements = 0xFFFFFFFFull;  // an index has 32 bits

unsigned components_of(const Part& type) {
    constexpr std::pair<const char*, unsigned> kTypes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                           {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, components] : kTypes)
        if (type.text() == name) return components;
    type.refuse("is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4");
}

unsigned component_type_of(const Part& part) {
    const Part type = part.need("componentType");
    const uint64_t number = type.whole(kLargestWhole);
    if (number < kByte || number > kFloat || number == 5124)
        type.refuse("is " + std::to_string(number) + ", not 5120 to 5123, 5125 or 5126");
    return static_cast<unsigned>(number);
}

template <class T>
T read_as(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

double number_at(const uint8_t* bytes, unsigned component_type) {
    switch (component_type) {
        case kByte:
            return read_as<int8_t>(bytes);
        case kUnsignedByte:
            return *bytes;
        case kShort:
            return read_as<int16_t>(bytes);
        case kUnsignedShort:
            return read_as<uint16_t>(bytes);
        case kUnsignedInt:
            return read_as<uint32_t>(bytes);
        default:
            return static_cast<double>(read_as<float>(bytes));
    }
}

/// As section 3.11 of glTF 2.0 has it: the lowest two values of a signed type are both -1.
double normalized(double value, unsigned component_type) {
    switch (component_type) {
        case kByte:
            return std::max(value / 127, -1.0);
        case kUnsignedByte:
            return value / 255;
        case kShort:
            return std::max(value / 32767, -1.0);
        case kUnsignedShort:
            return value / 65535;
        default:
            return value;
    }
}

}  // namespace

unsigned bytes_of(unsigned component_type) {
    switch (component_type) {
        case kByte:
        case kUnsignedByte:
            return 1;
        case kShort:
        case kUnsignedShort:
            return 2;
        default:
            return 4;
    }
}

Accessor::Accessor(const Part& part)
    : place(part.place()),
      count(part.need("count").whole(kMostElements)),
      components(components_of(part.need("type"))),
      component_type(component_type_of(part)),
      is_normalized(part.flag("normalized", false)) {
    if (is_normalized && component_type == kUnsignedInt)
        part.refuse("is normalized, which integers of 32 bits may not be");
}

const uint8_t* Accessor::element(uint64_t row) const {
    if (!replaced_.empty()) {
        const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), row);
        if (found != replaced_.end() && *found == row)
            return replacements_ + static_cast<uint64_t>(found - replaced_.begin()) * element_bytes();
    }
    return data_ == nullptr ? nullptr : data_ + row * step_;
}

double Accessor::number(uint64_t row, unsigned component) const {
    if (row >= count || component >= components)
        throw Refusal(place + " has " + std::to_string(count) + " elements of " + std::to_string(components) +
                      " components; element " + std::to_string(row) + " is asked for");
    const uint8_t* bytes = element(row);
    if (bytes == nullptr) return 0;
    const double value = number_at(bytes + uint64_t{component} * bytes_of(component_type), component_type);
    return is_normalized ? normalized(value, component_type) : value;
}

uint64_t Accessor::whole(uint64_t row, unsigned component) const {
    return static_cast<uint64_t>(number(row, component));  // whoever asks has called expect_whole_numbers
}

void Accessor::expect_components(unsigned wanted) const {
    if (components != wanted)
        throw Refusal(place + " has " + std::to_string(components) + " components, where " + std::to_string(wanted) +
                      " are wanted");
}

void Accessor::expect_whole_numbers() const {
    if (is_normalized ||
        (component_type != kUnsignedByte && component_type != kUnsignedShort && component_type != kUnsignedInt))
        throw Refusal(place + " has components of type " + std::to_string(component_type) +
                      (is_normalized ? ", normalized," : "") + " where whole numbers without a sign are wanted");
}

void Accessor::put_data(std::span<const uint8_t> bytes, uint64_t offset, uint64_t step) {
    const uint64_t element = element_bytes();
    if (step < element)
        throw Refusal(place + " has elements of " + std::to_string(element) + " bytes at a stride of " +
                      std::to_string(step));
    if (count == 0) return;
    // No sum here can overflow: count has 32 bits, a stride at most 12, an offset 53.
    const uint64_t end = offset + step * (count - 1) + element;
    if (end > bytes.size())
        throw Refusal(place + " reaches to byte " + std::to_string(end) + " of " + std::to_string(bytes.size()));
    data_ = bytes.data() + offset;
    step_ = step;
}

void Accessor::own_data(std::vector<uint8_t> bytes) {
    owned_ = std::move(bytes);
    put_data(owned_, 0, element_bytes());
}

void Accessor::put_replacements(std::vector<uint32_t> rows, std::span<const uint8_t> bytes) {
    if (rows.size() * element_bytes() > bytes.size())
        throw Refusal(place + " has sparse values to byte " + std::to_string(rows.size() * element_bytes()) + " of " +
                      std::to_string(bytes.size()));
    replaced_ = std::move(rows);
    replacements_ = bytes.data();
}

void Accessors::read_sparse(const Part& part, Accessor& accessor) {
    const Part indices = part.need("indices"), values = part.need("values");
    const uint64_t count = part.need("count").whole(accessor.count);
    Accessor rows = accessor;  // of whole numbers instead
    rows.place = indices.place();
    rows.count = count;
    rows.components = 1;
    rows.component_type = component_type_of(indices);
    rows.is_normalized = false;
    rows.expect_whole_numbers();
    rows.put_data(buffers_.view(indices.need("bufferView")), indices.whole("byteOffset", 0, kLargestWhole),
                  rows.element_bytes());
    std::vector<uint32_t> replaced(count);
    for (uint64_t i = 0; i < count; ++i) {
        replaced[i] = static_cast<uint32_t>(rows.whole(i, 0));
        if (replaced[i] >= accessor.count)
            indices.refuse("names element " + std::to_string(replaced[i]) + ", but there are " +
                           std::to_string(accessor.count));
        if (i > 0 && replaced[i] <= replaced[i - 1])
            indices.refuse("does not rise: " + std::to_string(replaced[i]) + " comes after " +
                           std::to_string(replaced[i - 1]));
    }
    const std::span<const uint8_t> bytes = buffers_.view(values.need("bufferView"));
    const uint64_t offset = values.whole("byteOffset", 0, kLargestWhole);
    if (offset > bytes.size()) values.refuse("begins after the end of its bytes");
    accessor.put_replacements(std::move(replaced), bytes.subspan(offset));
}

const Accessor& Accessors::at(const Part& asker) {
    const Part part = document_.named("accessors", asker);
    const uint64_t number = asker.whole(kLargestWhole);
    const auto known = known_.find(number);
    if (known != known_.end()) return known->second;
    Accessor accessor(part);
    if (const auto view = part.find("bufferView")) {
        const Part view_part = document_.named("bufferViews", *view);
        // A stride of at most 252 is allowed; larger ones are as clear.
        const uint64_t step = view_part.whole("byteStride", accessor.element_bytes(), 4096);
        accessor.put_data(buffers_.view(*view), part.whole("byteOffset", 0, kLargestWhole), step);
    }
    if (const auto sparse = part.find("sparse")) read_sparse(*sparse, accessor);
    return known_.emplace(number, std::move(accessor)).first->second;
}

}  // namespace cullet::gltf
