// Our own bugs. On in Debug and Checked builds, gone in Release; bad input is never asserted on, it is refused.
#pragma once

#if !defined(NDEBUG) || defined(CULLET_CHECKED)
#define CULLET_CHECKS_ON 1
#else
#define CULLET_CHECKS_ON 0
#endif

namespace cullet {
/// Prints the sentence (or hands it to `set_assert_handler`'s function) and aborts when that returns.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const char* format, ...)
    __attribute__((format(printf, 4, 5)));
using AssertHandler = void (*)(const char* sentence, void* user);
/// For this thread; null restores printing. The world sets its host's handler around step().
void set_assert_handler(AssertHandler handler, void* user);
}  // namespace cullet

#if CULLET_CHECKS_ON
#define CULLET_ASSERT(condition, ...) \
    ((condition) ? (void)0 : ::cullet::assertion_failed(#condition, __FILE__, __LINE__, __VA_ARGS__))
#else
#define CULLET_ASSERT(condition, ...) ((void)sizeof(condition))
#endif
