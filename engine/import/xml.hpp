// XML of strangers, read by expat: 3MF, Collada.
#pragma once
#include <string>
#include <string_view>

#include "cullet/result.hpp"

namespace cullet {

/// What the reader meets, in the order of the file. Names come as they stand there, with their prefix.
class XmlListener {
 public:
    /// Names and values in turn, ended by a null pointer.
    using Attributes = const char* const*;

    virtual ~XmlListener() = default;
    virtual void begin(std::string_view name, Attributes attributes) = 0;
    virtual void end(std::string_view) {}
    virtual void text(std::string_view) {}

    /// Where the tag stands in the bytes, while begin() or end() runs.
    size_t first_byte() const { return first_byte_; }
    size_t byte_count() const { return byte_count_; }

 private:
    friend struct XmlCalls;
    size_t first_byte_ = 0, byte_count_ = 0;
};

/// The value of an attribute, its name without prefix; nullptr when it is not there.
const char* attribute(XmlListener::Attributes attributes, std::string_view name);
/// "node" of "x:node".
std::string_view without_prefix(std::string_view name);

/// The bytes as plain_xml() gives them: UTF-8, or where they are not that, Latin-1, whatever their declaration says.
/// Programs declare what is not so, and only names differ. Entities that grow without end and files that others name
/// are refused by expat.
Result<void> read_xml(std::string_view bytes, XmlListener& listener, const std::string& path);

}  // namespace cullet
