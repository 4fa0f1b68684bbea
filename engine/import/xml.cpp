#include "engine/import/xml.hpp"

#include <expat.h>

#include <algorithm>
#include <climits>
#include <exception>
#include <memory>

#include "engine/import/text_encoding.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
/// What expat calls. An exception must not pass through it: it is kept until expat has come back.
struct XmlCalls {
    XML_Parser parser;
    XmlListener& listener;
    std::exception_ptr thrown;

    template <class F>
    static void guarded(void* user, const F& call) {
        XmlCalls& self = *static_cast<XmlCalls*>(user);
        if (self.thrown) return;
        try {
            self.listener.first_byte_ =
                static_cast<size_t>(std::max<XML_Index>(XML_GetCurrentByteIndex(self.parser), 0));
            self.listener.byte_count_ = static_cast<size_t>(std::max(XML_GetCurrentByteCount(self.parser), 0));
            call(self.listener);
        } catch (...) {
            self.thrown = std::current_exception();
            XML_StopParser(self.parser, XML_FALSE);
        }
    }
    static void begin(void* user, const char* name, const char** attributes) {
        guarded(user, [&](XmlListener& heard) { heard.begin(name, attributes); });
    }
    static void end(void* user, const char* name) {
        guarded(user, [&](XmlListener& heard) { heard.end(name); });
    }
    static void text(void* user, const char* text, int size) {
        guarded(user, [&](XmlListener& heard) { heard.text({text, static_cast<size_t>(size)}); });
    }
};

std::string_view without_prefix(std::string_view name) {
    const size_t colon = name.rfind(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}

const char* attribute(XmlListener::Attributes attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2)
        if (without_prefix(attributes[0]) == name) return attributes[1];
    return nullptr;
}

Result<void> read_xml(std::string_view bytes, XmlListener& listener, const std::string& path) {
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(is_utf8(bytes) ? "UTF-8" : "ISO-8859-1"), XML_ParserFree);
    if (parser == nullptr) throw std::bad_alloc();
    if (bytes.size() > INT_MAX) return Error{path + ": has more than 2 GiB of XML. Split the model."};
    XmlCalls calls{parser.get(), listener, nullptr};
    XML_SetUserData(parser.get(), &calls);
    XML_SetElementHandler(parser.get(), XmlCalls::begin, XmlCalls::end);
    XML_SetCharacterDataHandler(parser.get(), XmlCalls::text);
    const XML_Status status = XML_Parse(parser.get(), bytes.data(), static_cast<int>(bytes.size()), XML_TRUE);
    if (calls.thrown) std::rethrow_exception(calls.thrown);
    if (status == XML_STATUS_OK) return {};
    const XML_Error trouble = XML_GetErrorCode(parser.get());
    if (trouble == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    return Error{path + ": line " + std::to_string(XML_GetCurrentLineNumber(parser.get())) +
                 " of its XML cannot be read (" + XML_ErrorString(trouble) + "). Repair the file or export it again."};
}

}  // namespace cullet
