#include "engine/assert.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace cullet {
namespace {
thread_local AssertHandler current_handler = nullptr;
thread_local void* current_user = nullptr;
}  // namespace

void set_assert_handler(AssertHandler handler, void* user) {
    current_handler = handler;
    current_user = user;
}

void assertion_failed(const char* condition, const char* file, int line, const char* format, ...) {
    char reason[512], sentence[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    std::snprintf(sentence, sizeof sentence, "%s:%d: %s (%s)", file, line, reason, condition);
    if (current_handler) current_handler(sentence, current_user);
    std::fprintf(stderr, "%s\n", sentence);
    std::abort();
}

}  // namespace cullet
