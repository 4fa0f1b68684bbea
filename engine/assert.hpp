// Our own bugs. On in Debug and Checked builds, gone in Release; bad input is never asserted on, it is refused.
#pragma once

#if !defined(NDEBUG) || defined(CULLET_CHECKED)
#define CULLET_CHECKS_ON 1
#else
#define CULLET_CHECKS_ON 0
#endif

namespace cullet {
/// Hands the sentence to this thread's handler, prints it and aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const char* format, ...)
    __attribute__((format(printf, 4, 5)));

/// Who hears of it before the program aborts; nobody when `call` is null.
struct AssertHandler {
    void (*call)(const char* sentence, void* user) = nullptr;
    void* user = nullptr;
};
/// This thread's.
AssertHandler assert_handler();

/// While one of these lives, this thread has this handler. A job system gives each job its caller's.
class AssertScope {
 public:
    explicit AssertScope(AssertHandler handler);
    ~AssertScope();
    AssertScope(const AssertScope&) = delete;
    AssertScope& operator=(const AssertScope&) = delete;

 private:
    AssertHandler before_;
};
}  // namespace cullet

#if CULLET_CHECKS_ON
#define CULLET_ASSERT(condition, ...) \
    ((condition) ? (void)0 : ::cullet::assertion_failed(#condition, __FILE__, __LINE__, __VA_ARGS__))
#else
#define CULLET_ASSERT(condition, ...) ((void)sizeof(condition))
#endif
