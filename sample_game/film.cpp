#include "sample_game/film.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

namespace cullet {

Result<void> look_for_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access(((folder.empty() ? "." : folder) + "/ffmpeg").c_str(), X_OK) == 0) return {};
    return Error{
        "--video: the program ffmpeg is not in PATH; install it (Debian: apt-get install ffmpeg), or leave "
        "--video out."};
}

Film::~Film() {
    (void)end();
}

Result<void> Film::start(const Picture& picture, const std::string& path, double frames_a_second) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return Error{fmt::format("--video: no socket for ffmpeg ({}); leave --video out.", std::strerror(errno))};
    std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error", "-y"};
    words.insert(words.end(), {"-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
                               fmt::format("{}x{}", picture.width, picture.height), "-framerate",
                               fmt::format("{:.6f}", frames_a_second), "-i", "pipe:0"});
    words.insert(words.end(), {"-c:v", "libx264", "-preset", "veryfast", "-pix_fmt", "yuv420p", "-movflags",
                               "+faststart", "file:" + path});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    const int fault = posix_spawnp(&program_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    input_ = ends[0];
    if (fault == 0) return {};
    program_ = -1;
    (void)end();
    return Error{fmt::format("--video: ffmpeg could not be started ({}); install it, or leave --video out.",
                             std::strerror(fault))};
}

Result<void> Film::add(const Picture& picture, const std::string& path, double frames_a_second) {
    if (program_ == -1)
        if (auto started = start(picture, path, frames_a_second); !started.ok()) return started;
    const uint8_t* from = picture.rgb.data();
    for (size_t left = picture.rgb.size(); left > 0;) {
        const ssize_t sent = send(input_, from, left, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0)
            return Error{fmt::format("{}: ffmpeg stopped before the film's end (code {}); its own words stand above.",
                                     path, end())};
        from += sent;
        left -= static_cast<size_t>(sent);
    }
    return {};
}

int Film::end() {
    if (input_ >= 0) close(input_);
    input_ = -1;
    int status = 0;
    if (program_ != -1)
        while (waitpid(program_, &status, 0) < 0 && errno == EINTR) {
        }
    program_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Result<void> Film::finish() {
    const int code = end();
    if (code == 0) return {};
    return Error{
        fmt::format("--video: ffmpeg ended with code {}, so the film is not whole; its own words stand above.", code)};
}

}  // namespace cullet
