#include "engine/import/system_calls.hpp"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <memory>

namespace cullet {
namespace {

/// What reading a file, allocating, sleeping, throwing and dying take, by strace over all test data and by what assimp
/// and its libraries import from libc; the rest are what other libcs use for the same. Nothing here
/// reaches another process, opens anything but for reading, or changes what is on the disk.
/// A call that the machine's kernel does not have (most of the older names on arm64) has a number below 0.
constexpr int kAllowedCalls[] = {
    // files that are open, and names looked up
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(preadv), SCMP_SYS(lseek), SCMP_SYS(close),
    SCMP_SYS(close_range), SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(dup), SCMP_SYS(dup2), SCMP_SYS(dup3),
    SCMP_SYS(pipe), SCMP_SYS(pipe2), SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(select), SCMP_SYS(pselect6),
    SCMP_SYS(stat), SCMP_SYS(fstat), SCMP_SYS(lstat), SCMP_SYS(newfstatat), SCMP_SYS(statx), SCMP_SYS(access),
    SCMP_SYS(faccessat), SCMP_SYS(faccessat2), SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getdents64),
    SCMP_SYS(getcwd), SCMP_SYS(fadvise64),
    // memory
    SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect), SCMP_SYS(madvise),
    SCMP_SYS(mincore), SCMP_SYS(msync), SCMP_SYS(membarrier),
    // one thread, its locks, signals to itself and its end
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(set_tid_address), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigpending),
    SCMP_SYS(rt_sigsuspend), SCMP_SYS(sigaltstack), SCMP_SYS(restart_syscall), SCMP_SYS(pause), SCMP_SYS(nanosleep),
    SCMP_SYS(clock_nanosleep), SCMP_SYS(exit), SCMP_SYS(exit_group),
    // questions
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(times),
    SCMP_SYS(getrandom), SCMP_SYS(getpid), SCMP_SYS(getppid), SCMP_SYS(gettid), SCMP_SYS(getpgrp), SCMP_SYS(getuid),
    SCMP_SYS(geteuid), SCMP_SYS(getgid), SCMP_SYS(getegid), SCMP_SYS(getrlimit), SCMP_SYS(getrusage),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(getcpu), SCMP_SYS(sysinfo), SCMP_SYS(uname)};

/// Calls with numbers from here on are newer than Linux 5.17; libc is told that they do not exist, and does without.
/// The last is far above what a kernel of today has.
constexpr int kFirstNewCall = 451, kLastNewCall = 511;

class Filter {
 public:
    Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release) {}

    /// As a program for the kernel; empty where it could not be made. Also when the call is made with the numbers of
    /// another machine (32 bits, x32): that ends the process.
    std::vector<sock_filter> program() {
        bool is_good = is_good_ && context_ != nullptr;
        is_good = is_good && seccomp_attr_set(context_.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS) == 0;
        const int file = is_good ? ::memfd_create("filter", MFD_CLOEXEC) : -1;
        if (file < 0) return {};
        std::vector<sock_filter> program;
        if (seccomp_export_bpf(context_.get(), file) == 0) {
            program.resize(static_cast<size_t>(::lseek(file, 0, SEEK_CUR)) / sizeof(sock_filter));
            const size_t size = program.size() * sizeof(sock_filter);
            if (::pread(file, program.data(), size, 0) != static_cast<ssize_t>(size)) program.clear();
        }
        ::close(file);
        return program;
    }

    /// Allowed when all conditions hold. Several of the same call: when one of them does.
    void allow(int call, std::initializer_list<scmp_arg_cmp> conditions = {}) { add(SCMP_ACT_ALLOW, call, conditions); }
    void deny_existence(int call) { add(SCMP_ACT_ERRNO(ENOSYS), call, {}); }

 private:
    void add(uint32_t action, int call, std::initializer_list<scmp_arg_cmp> conditions) {
        if (context_ == nullptr || call < 0) return;
        const int error = seccomp_rule_add_array(context_.get(), action, call, static_cast<unsigned>(conditions.size()),
                                                 conditions.begin());
        is_good_ = is_good_ && error == 0;
    }

    std::unique_ptr<void, decltype(&seccomp_release)> context_;
    bool is_good_ = true;
};

/// A condition on an argument: its bits under the mask are those of the value. Arguments of 32 bits are compared as
/// such, since the kernel does not look at the rest.
scmp_arg_cmp argument(unsigned number, uint64_t mask, uint64_t value) {
    return {number, SCMP_CMP_MASKED_EQ, mask, value};
}

constexpr uint64_t kWord = 0xFFFFFFFFu, kPointer = ~uint64_t{0};

}  // namespace

SystemCallFilter::SystemCallFilter() {
    constexpr uint64_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    Filter filter;
    filter.allow(SCMP_SYS(open), {argument(1, writing, 0)});
    filter.allow(SCMP_SYS(openat), {argument(2, writing, 0)});
    filter.allow(SCMP_SYS(tgkill), {argument(0, kWord, static_cast<uint64_t>(::getpid()))});  // abort
    // Its own limits, and only asked for: as root it could raise them.
    filter.allow(SCMP_SYS(prlimit64), {argument(0, kWord, 0), argument(2, kPointer, 0)});
    // Not F_SETOWN, which has signals sent to others, nor leases and locks on others' files.
    for (const uint64_t command : {F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC})
        filter.allow(SCMP_SYS(fcntl), {argument(1, kWord, command)});
    filter.allow(SCMP_SYS(ioctl), {argument(1, kWord, TCGETS)});  // isatty; not TIOCSTI, which types into the terminal
    for (const int call : kAllowedCalls) filter.allow(call);
    for (int call = kFirstNewCall; call <= kLastNewCall; ++call) filter.deny_existence(call);
    program_ = filter.program();
}

SystemCallFilter::~SystemCallFilter() = default;

bool SystemCallFilter::apply() const {
    if (program_.empty()) return false;
    const sock_fprog program{static_cast<unsigned short>(program_.size()), const_cast<sock_filter*>(program_.data())};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

bool has_filters_of_system_calls() {
    return ::prctl(PR_GET_SECCOMP) >= 0 || errno != EINVAL;
}

}  // namespace cullet
