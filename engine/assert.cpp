#include "engine/assert.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace cullet {
namespace {
thread_local AssertHandler current_handler;
}  // namespace

AssertHandler assert_handler() {
    return current_handler;
}
AssertScope::AssertScope(AssertHandler handler) : before_(current_handler) {
    current_handler = handler;
}
AssertScope::~AssertScope() {
    current_handler = before_;
}

void assertion_failed(const char* condition, const char* file, int line, const char* format, ...) {
    char reason[512], sentence[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    std::snprintf(sentence, sizeof sentence, "%s:%d: %s (%s)", file, line, reason, condition);
    if (current_handler.call) current_handler.call(sentence, current_handler.user);
    std::fprintf(stderr, "%s\n", sentence);
    std::abort();
}

}  // namespace cullet
