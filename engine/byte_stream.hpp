// Numbers, texts and arrays one after another in bytes, little-endian, as they stand in memory; and their reading back,
// which believes nothing.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace cullet {

static_assert(std::endian::native == std::endian::little, "files are little-endian and are copied as they stand");

struct ByteWriter {
    std::vector<uint8_t> bytes;

    void put(const void* data, size_t size);
    template <class T>
    void number(T value) {
        static_assert(std::is_arithmetic_v<T>);
        put(&value, sizeof value);
    }
    void text(const std::string& text) {
        number(static_cast<uint32_t>(text.size()));
        put(text.data(), text.size());
    }
};

/// Takes things off the front of bytes; the first failure stays, and everything after it reads as nothing.
class ByteReader {
 public:
    /// `name` is the file's. Its byte `first_byte` is the first of `bytes`. `advice` ends the sentence: what to do.
    ByteReader(std::span<const uint8_t> bytes, std::string name, std::string advice, uint64_t first_byte = 0)
        : bytes_(bytes), name_(std::move(name)), advice_(std::move(advice)), first_byte_(first_byte) {}

    bool is_sound() const { return trouble_.empty(); }
    /// Empty, or one sentence.
    const std::string& trouble() const { return trouble_; }
    bool is_at_end() const { return at_ == bytes_.size(); }
    size_t left() const { return bytes_.size() - at_; }
    /// In the file, of what is read next.
    uint64_t byte() const { return first_byte_ + at_; }

    /// `what` is wrong: "<name>: <what> at byte 123. <advice>"
    void fail(const std::string& what) {
        if (!is_sound()) return;
        const std::string said = what.ends_with('.') ? what.substr(0, what.size() - 1) : what;  // a whole sentence
        trouble_ = name_ + ": " + said + " at byte " + std::to_string(byte()) + ". " + advice_;
    }
    bool expect(bool fits, const std::string& what) {
        if (!fits) fail(what);
        return is_sound();
    }
    std::span<const uint8_t> take(uint64_t size, const char* what);
    template <class T>
    T number(const char* what) {
        static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
        T value{};
        if (const auto from = take(sizeof value, what); !from.empty()) std::memcpy(&value, from.data(), sizeof value);
        return value;
    }
    /// Printable, at most kLongestText bytes.
    std::string text(const char* what);
    /// A count of things of at least `bytes_each`: no more than the bytes that are left can hold.
    uint32_t count(const char* what, size_t bytes_each, uint32_t most);

    static constexpr uint32_t kLongestText = 4096;

 private:
    std::span<const uint8_t> bytes_;
    std::string name_, advice_;
    uint64_t first_byte_;
    size_t at_ = 0;
    std::string trouble_;
};

}  // namespace cullet
