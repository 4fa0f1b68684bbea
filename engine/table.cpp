#include "engine/table.hpp"

#include <algorithm>
#include <charconv>

namespace cullet {

std::byte* AnyTable::column_memory(const ColumnInfo& column, int array) const {
    const auto* object = reinterpret_cast<const std::byte*>(this);  // AnyTable is the first base of every table
    return reinterpret_cast<const ColumnMemory*>(object + column.offset)->array[array];
}

uint32_t AnyTable::append(uint32_t count) {
    if (count > limit_ - size_) return kNone;
    const uint32_t first = size_;
    size_ += count;
    // Rows that never were are not written to become zero: a frame that takes more than it uses would pay for the
    // pages.
    if (first < used_) clear_rows(first, (used_ < size_ ? used_ : size_) - first);
    used_ = used_ < size_ ? size_ : used_;
    return first;
}

void AnyTable::copy_rows(const AnyTable& source, uint32_t from, uint32_t to, uint32_t count) {
    CULLET_ASSERT(source.columns_ == columns_, "copy of rows between tables of two types");
    if (count == 0) return;
    CULLET_ASSERT(count <= source.size_ && from <= source.size_ - count && count <= size_ && to <= size_ - count,
                  "copy of rows %u + %u past the end of %s", from, count, name_);
    for (const ColumnInfo& c : *columns_)
        for (int a = 0; a < c.lanes * c.sides; ++a) {
            std::byte* const target = column_memory(c, a) + size_t{to} * c.row_bytes;
            const std::byte* const origin = source.column_memory(c, a) + size_t{from} * c.row_bytes;
            if (count == 1 && c.row_bytes == 4)  // half of what cracks copy: a call takes longer than the four bytes
                std::memmove(target, origin, 4);
            else
                std::memmove(target, origin, size_t{count} * c.row_bytes);
        }
}

void AnyTable::clear_rows(uint32_t first, uint32_t count) {
    if (count == 0) return;
    CULLET_ASSERT(count <= size_ && first <= size_ - count, "clearing rows %u + %u past the end of %s", first, count,
                  name_);
    for (const ColumnInfo& c : *columns_)
        for (int a = 0; a < c.lanes * c.sides; ++a)
            std::memset(column_memory(c, a) + size_t{first} * c.row_bytes, 0, size_t{count} * c.row_bytes);
}

// So many rows at least are asked for at once: a table that grows by a row a piece would ask for each of its columns a
// piece, at a microsecond each.
constexpr uint32_t kRowsAtOnce = 1024;

uint64_t AnyTable::commit_rows(uint32_t count, uint64_t most) {
    const uint32_t from = committed_ > size_ ? committed_ : size_;
    if (count <= from || from >= limit_) return 0;
    count = std::min(std::max(count, from + kRowsAtOnce), limit_);
    const uint64_t bytes = bytes_a_row(), rows = most / bytes;
    if (rows == 0) return 0;
    if (rows < count - from) count = from + static_cast<uint32_t>(rows);
    for (const ColumnInfo& c : *columns_)
        for (int a = 0; a < c.lanes * c.sides; ++a)
            commit_memory(column_memory(c, a) + size_t{from} * c.row_bytes, size_t{count - from} * c.row_bytes);
    committed_ = count;
    return bytes * (count - from);
}

uint64_t AnyTable::hash(uint64_t seed) const {
    uint64_t hash = hash_bytes(&size_, sizeof size_, seed);
    for (const ColumnInfo& c : *columns_) {
        if (!c.is_state()) continue;
        for (int a = 0; a < c.lanes * c.sides; ++a)
            hash = hash_bytes(column_memory(c, a), size_t{size_} * c.row_bytes, hash);
    }
    return hash;
}

namespace {

/// Whether one of the numbers is not finite: bits of its exponent are all ones, and one more at their lowest place
/// carries into the sign's. Blocks of a fixed size, so that the compiler takes many numbers at once: tests look at all
/// tables after each system.
template <class Word, Word kExponent, Word kLowest>
bool is_any_not_finite(const std::byte* numbers, size_t count) {
    constexpr size_t kBlock = 32;
    constexpr Word kSign = ~(~Word{0} >> 1);
    Word found = 0;
    Word words[kBlock];
    for (; count >= kBlock; count -= kBlock, numbers += sizeof words) {
        std::memcpy(words, numbers, sizeof words);
        for (size_t i = 0; i < kBlock; ++i) found |= (words[i] & kExponent) + kLowest;
    }
    std::memcpy(words, numbers, count * sizeof(Word));
    for (size_t i = 0; i < count; ++i) found |= (words[i] & kExponent) + kLowest;
    return (found & kSign) != 0;
}

bool is_any_not_finite(const std::byte* numbers, size_t bytes, Scalar scalar) {
    return scalar == Scalar::F32
               ? is_any_not_finite<uint32_t, 0x7f800000u, 0x00800000u>(numbers, bytes / sizeof(float))
               : is_any_not_finite<uint64_t, 0x7ff0000000000000u, 0x0010000000000000u>(numbers, bytes / sizeof(double));
}

}  // namespace

std::string AnyTable::validate() const {
    for (const ColumnInfo& c : *columns_) {
        if (c.scalar != Scalar::F32 && c.scalar != Scalar::F64) continue;
        for (int a = 0; a < c.lanes * c.sides; ++a) {
            if (size_ == 0 || !is_any_not_finite(column_memory(c, a), size_t{size_} * c.row_bytes, c.scalar)) continue;
            for (uint32_t row = 0; row < size_; ++row)
                for (int k = 0; k < c.components; ++k) {
                    const std::byte* place = column_memory(c, a) + size_t{row} * c.row_bytes;
                    const double value = c.scalar == Scalar::F32
                                             ? static_cast<double>(reinterpret_cast<const float*>(place)[k])
                                             : reinterpret_cast<const double*>(place)[k];
                    if (!std::isfinite(value))
                        return place_of(c, a, row) + " is " + describe_value(c, a, row) + ", not a finite number";
                }
        }
    }
    return {};
}

std::string AnyTable::first_difference(const AnyTable& other) const {
    if (size_ != other.size_)
        return std::string(name_) + ": " + std::to_string(size_) + " rows here, " + std::to_string(other.size_) +
               " there";
    if (size_ == 0) return {};
    for (const ColumnInfo& c : *columns_) {
        if (!c.is_state()) continue;
        for (int a = 0; a < c.lanes * c.sides; ++a) {
            const std::byte *mine = column_memory(c, a), *theirs = other.column_memory(c, a);
            if (std::memcmp(mine, theirs, size_t{size_} * c.row_bytes) == 0) continue;
            uint32_t row = 0;
            while (std::memcmp(mine + size_t{row} * c.row_bytes, theirs + size_t{row} * c.row_bytes, c.row_bytes) == 0)
                ++row;
            uint32_t byte = 0;
            while (mine[size_t{row} * c.row_bytes + byte] == theirs[size_t{row} * c.row_bytes + byte]) ++byte;
            return place_of(c, a, row) + ": " + describe_value(c, a, row, byte) + " here, " +
                   other.describe_value(c, a, row, byte) + " there";
        }
    }
    return {};
}

std::string AnyTable::place_of(const ColumnInfo& c, int array, uint32_t row) const {
    static const char* const kLaneNames[3] = {".x", ".y", ".z"};
    return std::string(name_) + "." + c.name + "[" + std::to_string(row) + "]" +
           (c.lanes == 3 ? kLaneNames[array % 3] : "");
}

std::string AnyTable::describe_value(const ColumnInfo& c, int array, uint32_t row, uint32_t from) const {
    const std::byte* bytes = column_memory(c, array) + size_t{row} * c.row_bytes;
    std::string text;
    for (int k = 0; k < c.components; ++k) {
        char digits[48];
        std::to_chars_result end{digits, {}};
        switch (c.scalar) {
            case Scalar::U8:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const uint8_t*>(bytes)[k]);
                break;
            case Scalar::U16:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const uint16_t*>(bytes)[k]);
                break;
            case Scalar::Row:
            case Scalar::U32:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const uint32_t*>(bytes)[k]);
                break;
            case Scalar::U64:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const uint64_t*>(bytes)[k]);
                break;
            case Scalar::F32:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const float*>(bytes)[k]);
                break;
            case Scalar::F64:
                end = std::to_chars(digits, digits + 48, reinterpret_cast<const double*>(bytes)[k]);
                break;
            case Scalar::Bytes:
                if (from) text.append("byte ").append(std::to_string(from)).append(" ");
                for (uint32_t b = from; b < c.row_bytes && b < from + 16; ++b) {
                    static const char* const kHex = "0123456789abcdef";
                    const auto byte = static_cast<unsigned>(bytes[b]);
                    text += kHex[byte >> 4];
                    text += kHex[byte & 15];
                }
                return text;
        }
        if (k) text += ' ';
        text.append(digits, end.ptr);
    }
    return text;
}

std::string AnyTable::describe_row(uint32_t row) const {
    std::string text = std::string(name_) + "[" + std::to_string(row) + "]";
    for (const ColumnInfo& c : *columns_) {
        text += std::string(" ") + c.name + "=";
        for (int lane = 0; lane < c.lanes; ++lane) text.append(lane ? "," : "").append(describe_value(c, lane, row));
        if (std::strcmp(c.unit, "1") != 0) text += std::string(" ") + c.unit;
    }
    return text;
}

uint64_t AnyTable::bytes_a_row() const {
    uint64_t bytes = 0;
    for (const ColumnInfo& c : *columns_) bytes += uint64_t{c.row_bytes} * c.lanes * c.sides;
    return bytes;
}

}  // namespace cullet
