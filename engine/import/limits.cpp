#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <new>

#include "engine/import/import.hpp"
#include "engine/import/sanitized.hpp"
#include "engine/import/system_calls.hpp"

namespace cullet {
namespace {

constexpr size_t kLongestMessage = 4096;

bool limit(__rlimit_resource resource, rlim_t value, rlim_t hard) {
    const rlimit both{value, hard};
    return ::setrlimit(resource, &both) == 0;
}
bool limit(__rlimit_resource resource, rlim_t value) {
    return limit(resource, value, value);
}

/// Gives the stack what reading takes before memory is limited: afterwards it might find no room to grow, which is a
/// crash and no exception.
[[gnu::noinline]] void grow_stack() {  // within its caller it would lie above what is called next
    constexpr size_t kStack = 1u << 20, kPage = 4096;
    char stack[kStack];
    volatile char* const page = stack;
    for (size_t i = 0; i < kStack; i += kPage) page[i] = 0;
}

/// What is in the way, with what to do; "" when the limits stand. A kernel without filters of system calls leaves the
/// rlimits, which is what older systems had; where it has them and they cannot be set, nothing is read. A sanitized
/// build keeps to the processor time alone.
std::string limit_this_process(const ImportLimits& limits) {
    constexpr const char* kNoLimits =
        "the limits of the import process cannot be set. Lower --memory-mib or --seconds.";
    if (kIsSanitized) return limit(RLIMIT_CPU, 10 * limits.seconds, 10 * limits.seconds + 1) ? "" : kNoLimits;
    const SystemCallFilter filter;
    grow_stack();
    const rlim_t bytes = static_cast<rlim_t>(limits.memory_mib) << 20;
    const bool limited = limit(RLIMIT_CORE, 0) && limit(RLIMIT_AS, bytes) && limit(RLIMIT_FSIZE, bytes) &&
                         limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1) && limit(RLIMIT_NOFILE, 64);
    ::signal(SIGXFSZ, SIG_IGN);  // a file too large is then an error of write, with a sentence
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    ::prctl(PR_SET_DUMPABLE, 0);
    if (!filter.apply() && has_filters_of_system_calls())
        return "the system calls of the import process cannot be limited, so nothing is read. Run it where a process "
               "may set a seccomp filter.";
    return limited ? "" : kNoLimits;
}

bool write_all(int file, const void* data, size_t size) {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t n = ::write(file, from, size);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        from += n;
        size -= static_cast<size_t>(n);
    }
    return true;
}

std::string too_much_memory(const std::string& subject, const ImportLimits& limits) {
    return subject + ": needs more than " + std::to_string(limits.memory_mib) +
           " MiB to read. The counts in the file may be wrong; if they are right, raise --memory-mib.";
}

/// All from first to last, both inclusive. A kernel before 5.9 has no call for it: then one by one, as far as the limit
/// on open files goes.
void close_all(unsigned first, unsigned last) {
    if (first > last || ::syscall(SYS_close_range, first, last, 0u) == 0) return;
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) files.rlim_cur = 1u << 20;
    for (unsigned file = first; file <= last && file < files.rlim_cur; ++file) ::close(static_cast<int>(file));
}

/// The host's open files and sockets came along with the fork, and the calls that write to open files stay allowed:
/// everything goes but the two ways back. These are moved above the standard three first, whose places are theirs in a
/// host that runs without them. False when they cannot be moved.
bool keep_only(int& message_pipe, int& result_file) {
    message_pipe = ::fcntl(message_pipe, F_DUPFD_CLOEXEC, 3);
    result_file = ::fcntl(result_file, F_DUPFD_CLOEXEC, 3);
    if (message_pipe < 0 || result_file < 0) return false;
    const unsigned low = static_cast<unsigned>(std::min(message_pipe, result_file));
    const unsigned high = static_cast<unsigned>(std::max(message_pipe, result_file));
    close_all(0, 2);
    close_all(3, low - 1);
    close_all(low + 1, high - 1);
    close_all(high + 1, ~0u);
    const int null = ::open("/dev/null", O_RDWR);
    if (null == STDIN_FILENO) ::dup2(null, STDOUT_FILENO), ::dup2(null, STDERR_FILENO);
    return true;
}

/// The child's whole life. The first byte of the message is '+' or '-'.
[[noreturn]] void live_as_child(const std::string& subject, const ImportLimits& limits, int message_pipe,
                                int result_file, const std::function<Result<Delivery>()>& work) {
    if (!keep_only(message_pipe, result_file)) ::_exit(2);
    std::string message;
    try {
        if (const std::string trouble = limit_this_process(limits); !trouble.empty()) {
            message = "-" + subject + ": " + trouble;
        } else {
            auto result = work();
            if (!result)
                message = "-" + result.error();
            else if (!write_all(result_file, result->bytes.data(), result->bytes.size()))
                message = "-" + too_much_memory(subject, limits);
            else
                message = "+" + result->line;
        }
    } catch (const std::bad_alloc&) {
        message = "-" + too_much_memory(subject, limits);
    } catch (const std::exception& e) {
        message = "-" + subject + ": cannot be read (" + e.what() + "). Repair the file or export it again.";
    } catch (...) {
        message = "-" + subject + ": cannot be read. Repair the file or export it again.";
    }
    write_all(message_pipe, message.data(), message.size());
    ::_exit(message[0] == '+' ? 0 : 2);
}

/// Reads what the child says until it closes its end. False when the time is over.
bool listen(int pipe, double seconds, const Waiting& waiting, std::string& message) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    for (;;) {
        const double gone = std::chrono::duration<double>(Clock::now() - begin).count();
        if (gone >= seconds) return false;
        pollfd wait{pipe, POLLIN, 0};
        const int ready = ::poll(&wait, 1, 100);
        if (ready <= 0) {
            if (waiting) waiting(gone);
            continue;
        }
        char buffer[1024];
        const ssize_t n = ::read(pipe, buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return true;
        if (message.size() < kLongestMessage) message.append(buffer, static_cast<size_t>(n));
    }
}

std::string how_it_died(const std::string& subject, int status, bool is_late, const ImportLimits& limits) {
    if (is_late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return subject + ": was not read within " + std::to_string(limits.seconds) +
               " s of processor time. Repair or simplify the model, or raise --seconds.";
    const std::string number = std::to_string(WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
    return subject + ": the model reader crashed on it (" + (WIFSIGNALED(status) ? "signal " : "exit code ") + number +
           "). The file is probably damaged; export it again or to another format.";
}

Result<std::vector<uint8_t>> read_back(const std::string& subject, int file) {
    struct stat status {};
    if (::fstat(file, &status) != 0) return Error{subject + ": the import process left nothing. Try again."};
    std::vector<uint8_t> bytes(static_cast<size_t>(status.st_size));
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
        if (n <= 0) return Error{subject + ": the result of the import process cannot be read. Try again."};
        done += static_cast<size_t>(n);
    }
    return bytes;
}

}  // namespace

Result<Delivery> run_limited(const std::string& subject, const ImportLimits& limits,
                             const std::function<Result<Delivery>()>& work, const Waiting& waiting) {
    int ends[2] = {-1, -1};
    const int result_file = ::memfd_create("cullet_import", MFD_CLOEXEC);
    const pid_t child = result_file >= 0 && ::pipe2(ends, O_CLOEXEC) == 0 ? ::fork() : -1;
    if (child == 0) live_as_child(subject, limits, ends[1], result_file, work);
    const int number = errno;
    if (ends[1] >= 0) ::close(ends[1]);
    Delivery delivery;
    std::string message;
    int status = 0;
    bool is_late = false;
    if (child > 0) {
        is_late = !listen(ends[0], longest_wait(limits), waiting, message);
        if (is_late) ::kill(child, SIGKILL);
        while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
    }
    if (ends[0] >= 0) ::close(ends[0]);
    Result<Delivery> result = Error{};
    if (child < 0) {
        result = Error{subject + ": the import process cannot be started (" + std::strerror(number) + "). Try again."};
    } else if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !message.empty() && message[0] == '+') {
        auto bytes = read_back(subject, result_file);
        if (bytes)
            result = Delivery{std::move(*bytes), message.substr(1)};
        else
            result = Error{bytes.error()};
    } else if (WIFEXITED(status) && message.size() > 1 && message[0] == '-') {
        result = Error{message.substr(1)};
    } else {
        result = Error{how_it_died(subject, status, is_late, limits)};
    }
    if (result_file >= 0) ::close(result_file);
    return result;
}

}  // namespace cullet
