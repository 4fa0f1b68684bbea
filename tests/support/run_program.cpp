#include "tests/support/run_program.hpp"

#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>

#include <cerrno>
#include <chrono>

extern char** environ;

namespace cullet::test {
namespace {

/// Takes what is there; false once the other end is closed.
bool take(int pipe, std::string& text) {
    char buffer[4096];
    const ssize_t n = ::read(pipe, buffer, sizeof buffer);
    if (n > 0) text.append(buffer, static_cast<size_t>(n));
    return n > 0 || (n < 0 && errno == EINTR);
}

}  // namespace

ProgramRun run_program(std::vector<std::string> arguments) {
    ProgramRun run;
    int out[2], err[2];
    if (::pipe2(out, O_CLOEXEC) != 0) return run;
    if (::pipe2(err, O_CLOEXEC) != 0) return run;
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    const auto begin = std::chrono::steady_clock::now();
    pid_t child = -1;
    const int trouble = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    ::close(err[1]);
    bool hears_out = trouble == 0, hears_err = trouble == 0;
    while (hears_out || hears_err) {
        pollfd ends[2] = {{hears_out ? out[0] : -1, POLLIN, 0}, {hears_err ? err[0] : -1, POLLIN, 0}};
        if (::poll(ends, 2, -1) < 0) continue;
        if (ends[0].revents != 0) hears_out = take(out[0], run.output);
        if (ends[1].revents != 0) hears_err = take(err[0], run.error);
    }
    ::close(out[0]);
    ::close(err[0]);
    if (trouble != 0) return run;
    int status = 0;
    rusage used{};
    while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    run.peak_bytes = static_cast<uint64_t>(used.ru_maxrss) * 1024;
    return run;
}

}  // namespace cullet::test
