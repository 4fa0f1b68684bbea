// What the child that reads strangers' files may not do.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/import/import.hpp"
#include "engine/import/sanitized.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

/// Runs `work` in the child; it says what it found.
std::string told_by_child(const std::function<std::string()>& work, const ImportLimits& limits = {}) {
    const Result<Delivery> delivery = run_limited("file", limits, [&]() -> Result<Delivery> {
        return Delivery{{1}, work()};
    });
    return delivery.ok() ? delivery->line : "refused: " + delivery.error();
}

/// "" when the call failed as the filter makes it fail.
std::string expect_forbidden(const char* call, long result) {
    if (result < 0 && errno == EPERM) return "";
    return std::string(call) + (result < 0 ? " failed with " + std::string(std::strerror(errno)) : " worked") + "; ";
}

class Limits : public testing::Test {
 protected:
    void SetUp() override {
        if (kIsSanitized) GTEST_SKIP() << "sanitizers do not work under limits";
        folder_ = fs::temp_directory_path() / ("import_limits_test." + std::to_string(getpid()));
        fs::create_directories(folder_);
        std::ofstream(folder_ / "there") << "text";
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(Limits, TheChildHasNoNetwork) {
    EXPECT_EQ(told_by_child([] {
                  return expect_forbidden("socket", ::socket(AF_INET, SOCK_STREAM, 0)) +
                         expect_forbidden("local socket", ::socket(AF_UNIX, SOCK_STREAM, 0)) +
                         expect_forbidden("socketpair", [] {
                             int ends[2];
                             return ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends);
                         }());
              }),
              "");
}

TEST_F(Limits, TheChildStartsNoProcessAndNoThreadAndEndsNone) {
    const pid_t parent = getpid();
    EXPECT_EQ(told_by_child([parent] {
                  const pid_t made = ::fork();
                  if (made == 0) ::_exit(0);
                  std::string said = expect_forbidden("fork", made);
                  char name[] = "/bin/true";
                  char* arguments[] = {name, nullptr};
                  said += expect_forbidden("exec", ::execv(name, arguments));
                  said += expect_forbidden("kill", ::kill(parent, 0));
                  try {
                      std::thread([] {}).join();
                      said += "a thread was started; ";
                  } catch (const std::system_error&) {
                  }
                  return said;
              }),
              "");
}

TEST_F(Limits, TheChildSignalsNoOtherProcessByAnyCall) {
    const pid_t parent = getpid();
    EXPECT_EQ(told_by_child([parent] {
                  siginfo_t info{};
                  info.si_code = SI_QUEUE;
                  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, parent, 0));
                  std::string said = expect_forbidden("pidfd_open", handle);
                  said += expect_forbidden("kill", ::syscall(SYS_kill, parent, 0));
                  said += expect_forbidden("kill a group", ::syscall(SYS_kill, 0, 0));
                  said += expect_forbidden("tkill", ::syscall(SYS_tkill, parent, 0));
                  said += expect_forbidden("tgkill", ::syscall(SYS_tgkill, parent, parent, 0));
                  said += expect_forbidden("rt_sigqueueinfo", ::syscall(SYS_rt_sigqueueinfo, parent, SIGURG, &info));
                  said += expect_forbidden("rt_tgsigqueueinfo",
                                           ::syscall(SYS_rt_tgsigqueueinfo, parent, parent, SIGURG, &info));
                  said += expect_forbidden("pidfd_send_signal", ::syscall(SYS_pidfd_send_signal, 0, 0, nullptr, 0));
                  said += expect_forbidden("F_SETOWN", ::fcntl(0, F_SETOWN, parent));
                  said += expect_forbidden("ptrace", ::syscall(SYS_ptrace, 16, parent, 0, 0));
                  return said;
              }),
              "");
}

TEST_F(Limits, TheChildRaisesNoLimitAndChangesNoOtherProcess) {
    const pid_t parent = getpid();
    EXPECT_EQ(told_by_child([parent] {
                  rlimit files{};
                  std::string said = ::getrlimit(RLIMIT_NOFILE, &files) == 0 ? "" : "limits cannot be asked for; ";
                  cpu_set_t all;
                  CPU_ZERO(&all);
                  CPU_SET(0, &all);
                  const iovec here{&files, sizeof files};
                  said += expect_forbidden("setrlimit", ::setrlimit(RLIMIT_NOFILE, &files));
                  said += expect_forbidden("setrlimit, the old call", ::syscall(SYS_setrlimit, RLIMIT_NOFILE, &files));
                  said += expect_forbidden("prlimit64", ::prlimit(parent, RLIMIT_NOFILE, nullptr, &files));
                  said += expect_forbidden("prlimit64 to set", ::prlimit(parent, RLIMIT_NOFILE, &files, nullptr));
                  said += expect_forbidden("sched_setaffinity", ::sched_setaffinity(parent, sizeof all, &all));
                  said += expect_forbidden("setpriority", ::setpriority(PRIO_PROCESS, static_cast<id_t>(parent), 0));
                  said += expect_forbidden("setpgid", ::setpgid(parent, 0));
                  said += expect_forbidden("process_vm_readv", ::process_vm_readv(parent, &here, 1, &here, 1, 0));
                  said += expect_forbidden("prctl", ::prctl(PR_SET_DUMPABLE, 1));
                  said += expect_forbidden("setuid", ::setuid(getuid()));
                  return said;
              }),
              "");
}

TEST_F(Limits, TheChildDatesAndMarksNoFile) {
    const std::string there = folder_ / "there";
    const auto before = fs::last_write_time(there);
    EXPECT_EQ(told_by_child([&] {
                  const char* const path = there.c_str();
                  const int file = ::open(path, O_RDONLY);
                  const timespec past[2] = {{1, 0}, {1, 0}};
                  const timeval old[2] = {{1, 0}, {1, 0}};
                  std::string said = file < 0 ? "the file cannot be read; " : "";
                  said += expect_forbidden("utime", ::syscall(SYS_utime, path, nullptr));
                  said += expect_forbidden("utimes", ::syscall(SYS_utimes, path, old));
                  said += expect_forbidden("futimesat", ::syscall(SYS_futimesat, AT_FDCWD, path, old));
                  said += expect_forbidden("utimensat", ::utimensat(AT_FDCWD, path, past, 0));
                  said += expect_forbidden("futimens", ::futimens(file, past));
                  said += expect_forbidden("setxattr", ::setxattr(path, "user.a", "b", 1, 0));
                  said += expect_forbidden("lsetxattr", ::lsetxattr(path, "user.a", "b", 1, 0));
                  said += expect_forbidden("fsetxattr", ::fsetxattr(file, "user.a", "b", 1, 0));
                  said += expect_forbidden("removexattr", ::removexattr(path, "user.a"));
                  said += expect_forbidden("fchmod", ::fchmod(file, 0));
                  said += expect_forbidden("fchown", ::fchown(file, 0, 0));
                  said += expect_forbidden("flock", ::flock(file, LOCK_EX));
                  said += expect_forbidden("ftruncate", ::ftruncate(file, 0));
                  said += expect_forbidden("chdir", ::chdir("/"));
                  said += expect_forbidden("open by openat2", [&] {
                      const uint64_t how[3] = {O_WRONLY, 0, 0};
                      return ::syscall(SYS_openat2, AT_FDCWD, path, how, sizeof how);
                  }());
                  return said;
              }),
              "");
    EXPECT_EQ(fs::last_write_time(there), before);
}

TEST_F(Limits, TheChildLeavesNothingWithTheKernel) {
    EXPECT_EQ(told_by_child([] {
                  msgbuf message{1, ""};
                  sembuf lock{};
                  std::string said = expect_forbidden("shmget", ::shmget(IPC_PRIVATE, 4096, IPC_CREAT | 0600));
                  said += expect_forbidden("shmat", ::syscall(SYS_shmat, 0, nullptr, 0));
                  said += expect_forbidden("shmctl", ::shmctl(0, IPC_RMID, nullptr));
                  said += expect_forbidden("semget", ::semget(IPC_PRIVATE, 1, IPC_CREAT | 0600));
                  said += expect_forbidden("semop", ::semop(0, &lock, 1));
                  said += expect_forbidden("semctl", ::semctl(0, 0, IPC_RMID));
                  said += expect_forbidden("msgget", ::msgget(IPC_PRIVATE, IPC_CREAT | 0600));
                  said += expect_forbidden("msgsnd", ::msgsnd(0, &message, 1, IPC_NOWAIT));
                  said += expect_forbidden("msgctl", ::msgctl(0, IPC_RMID, nullptr));
                  said += expect_forbidden("mq_open", ::syscall(SYS_mq_open, "a", O_RDWR | O_CREAT, 0600, nullptr));
                  said += expect_forbidden("mq_unlink", ::syscall(SYS_mq_unlink, "a"));
                  said += expect_forbidden("memfd_create", ::memfd_create("a", 0));
                  said += expect_forbidden("inotify", ::syscall(SYS_inotify_init1, 0));
                  said +=
                      expect_forbidden("timer_create", ::syscall(SYS_timer_create, CLOCK_MONOTONIC, nullptr, &lock));
                  said += expect_forbidden("io_uring", ::syscall(SYS_io_uring_setup, 1, nullptr));
                  said += expect_forbidden("TIOCSTI", ::ioctl(0, TIOCSTI, "x"));
                  return said;
              }),
              "");
}

/// libc tries newer calls first and takes the older ones only when it is told that those are not there.
TEST_F(Limits, CallsNewerThanTheListDoNotExist) {
    EXPECT_EQ(told_by_child([] {
                  std::string said;
                  for (const long call : {451, 452, 462, 500, 511})
                      if (::syscall(call, 0, 0, 0, 0, 0, 0) != -1 || errno != ENOSYS)
                          said += "call " + std::to_string(call) + ": " + std::strerror(errno) + "; ";
                  return said;
              }),
              "");
}

#if defined(__x86_64__)
/// The same calls under other numbers, which compare with nothing on the list.
TEST_F(Limits, TheChildEndsAtCallsOfAnotherMachine) {
    constexpr long kX32 = 0x40000000;
    const std::string said = told_by_child([] {
        ::syscall(kX32 | SYS_getpid);
        return std::string("lives");
    });
    EXPECT_NE(said, "lives");
}
#endif

/// Arguments of 32 bits: what stands above them is not looked at by the kernel, and not by the filter.
TEST_F(Limits, TheUpperHalfOfAnArgumentHidesNothing) {
    const std::string there = folder_ / "there";
    EXPECT_EQ(told_by_child([&] {
                  constexpr unsigned long kUpper = 1ul << 32;
                  std::string said;
                  said += expect_forbidden("open to write", ::syscall(SYS_open, there.c_str(), kUpper | O_WRONLY));
                  said += expect_forbidden("F_SETOWN", ::syscall(SYS_fcntl, 0, kUpper | F_SETOWN, ::getppid()));
                  if (::syscall(SYS_fcntl, 0, kUpper | F_GETFD, 0) < 0) said += "F_GETFD is refused; ";
                  return said;
              }),
              "");
}

TEST_F(Limits, TheChildMayAbort) {
    const std::string said = told_by_child([] {
        ::abort();
        return std::string();
    });
    EXPECT_NE(said.find("the model reader crashed on it (signal 6)"), std::string::npos) << said;
}

TEST_F(Limits, TheChildWritesRemovesAndRenamesNoFile) {
    const std::string there = folder_ / "there", made = folder_ / "made";
    EXPECT_EQ(told_by_child([&] {
                  return expect_forbidden("open to write", ::open(there.c_str(), O_WRONLY)) +
                         expect_forbidden("open to read and write", ::open(there.c_str(), O_RDWR)) +
                         expect_forbidden("create", ::open(made.c_str(), O_RDONLY | O_CREAT, 0600)) +
                         expect_forbidden("openat", ::openat(AT_FDCWD, made.c_str(), O_WRONLY | O_CREAT, 0600)) +
                         expect_forbidden("unlink", ::unlink(there.c_str())) +
                         expect_forbidden("rename", ::rename(there.c_str(), made.c_str())) +
                         expect_forbidden("mkdir", ::mkdir(made.c_str(), 0700)) +
                         expect_forbidden("truncate", ::truncate(there.c_str(), 0)) +
                         expect_forbidden("chmod", ::chmod(there.c_str(), 0)) +
                         expect_forbidden("link", ::link(there.c_str(), made.c_str())) +
                         expect_forbidden("symlink", ::symlink(there.c_str(), made.c_str()));
              }),
              "");
    EXPECT_EQ(fs::file_size(there), 4u);
    EXPECT_FALSE(fs::exists(made));
}

/// An open file and a connected socket of this process, without the flag that closes them in other programs.
struct OpenHere {
    explicit OpenHere(const std::string& path) : file(::open(path.c_str(), O_RDWR | O_APPEND)) {
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
        high = ::fcntl(ends[0], F_DUPFD, 500);
    }
    ~OpenHere() {
        for (const int handle : {file, ends[0], ends[1], high}) ::close(handle);
    }
    int file, ends[2] = {-1, -1}, high = -1;
};

TEST_F(Limits, TheChildHasNoFileAndNoSocketOfItsParent) {
    const std::string there = folder_ / "there";
    const OpenHere open(there);
    EXPECT_EQ(told_by_child([&] {
                  std::string said;
                  for (const int handle : {open.file, open.ends[0], open.ends[1], open.high})
                      if (::write(handle, "x", 1) != -1 || errno != EBADF)
                          said += "wrote to " + std::to_string(handle) + "; ";
                  size_t handles = 0;
                  for (int handle = 0; handle < 4096; ++handle) handles += ::fcntl(handle, F_GETFD) >= 0;
                  if (handles != 5)
                      said += std::to_string(handles) + " are open, not null three times and two ways back";
                  return said;
              }),
              "");
    EXPECT_EQ(fs::file_size(there), 4u);
}

TEST_F(Limits, AParentWithoutStandardFilesGetsItsResult) {
    const pid_t host = ::fork();
    ASSERT_GE(host, 0);
    if (host == 0) {
        for (const int handle : {0, 1, 2}) ::close(handle);
        ::_exit(told_by_child([] { return std::string("said"); }) == "said" ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(host, &status, 0), host);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/// What run_limited() says in a process that can set no filters; with `has_none` the kernel seems to know of none.
std::string told_without_filters(bool has_none) {
    int ends[2] = {};
    if (::pipe(ends) != 0) return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
        const auto refuse = [](scmp_filter_ctx filter, int error, long option) {
            const scmp_arg_cmp condition{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(option), 0};
            seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(static_cast<uint32_t>(error)), SCMP_SYS(prctl), 1,
                                   &condition);
        };
        const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
        seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(seccomp), 0);
        refuse(filter, EPERM, PR_SET_SECCOMP);
        if (has_none) refuse(filter, EINVAL, PR_GET_SECCOMP);
        const bool is_set = seccomp_load(filter) == 0;
        const std::string said = is_set ? told_by_child([] { return std::string("read"); }) : "no filter in the test";
        const bool is_written = ::write(ends[1], said.data(), said.size()) == static_cast<ssize_t>(said.size());
        ::_exit(is_written ? 0 : 1);
    }
    ::close(ends[1]);
    std::string said(4096, '\0');
    const ssize_t size = ::read(ends[0], said.data(), said.size());
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return said.substr(0, static_cast<size_t>(std::max<ssize_t>(size, 0)));
}

TEST_F(Limits, NothingIsReadWhereAFilterIsRefusedButOnAKernelWithoutFilters) {
    EXPECT_EQ(
        told_without_filters(false),
        "refused: file: the system calls of the import process cannot be limited, so nothing is read. Run it where "
        "a process may set a seccomp filter.");
    EXPECT_EQ(told_without_filters(true), "read");
}

TEST_F(Limits, TheChildReadsFiles) {
    const std::string there = folder_ / "there";
    EXPECT_EQ(told_by_child([&] {
                  std::string text;
                  std::ifstream(there) >> text;
                  return text;
              }),
              "text");
}

TEST_F(Limits, MemoryEndsWhereItIsSetAndTheSentenceNamesTheOption) {
    const auto take = [](size_t mib) {
        return [mib] {
            std::vector<char> block(mib << 20, 1);
            return std::to_string(block[block.size() / 2]);
        };
    };
    EXPECT_EQ(told_by_child(take(100), {512, 10}), "1");
    const std::string refused = told_by_child(take(600), {512, 10});
    EXPECT_NE(refused.find("file: needs more than 512 MiB"), std::string::npos) << refused;
    EXPECT_NE(refused.find("--memory-mib"), std::string::npos) << refused;
}

double seconds_of(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST_F(Limits, AChildThatComputesOrSleepsWithoutEndIsEnded) {
    std::string computing, sleeping;
    const double computed = seconds_of([&] {
        computing = told_by_child(
            [] {
                std::string text;
                for (;;) text.assign(1000, ' ');
                return text;
            },
            {256, 1});
    });
    const double slept = seconds_of([&] {
        sleeping = told_by_child(
            [] {
                for (;;) ::pause();
                return std::string();
            },
            {256, 1});
    });
    EXPECT_LT(computed, 4);
    EXPECT_LT(slept, 4);
    for (const std::string& said : {computing, sleeping})
        EXPECT_NE(said.find("was not read within 1 s of processor time"), std::string::npos) << said;
}

TEST_F(Limits, AChildThatCrashesIsOneSentence) {
    const std::string said = told_by_child([] {
        ::raise(SIGSEGV);
        ::abort();
        return std::string();
    });
    EXPECT_NE(said.find("the model reader crashed on it (signal"), std::string::npos) << said;
}

}  // namespace
}  // namespace cullet
