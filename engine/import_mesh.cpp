#include "engine/import_mesh.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string_view>

#include "engine/mesh_file.hpp"

extern char** environ;

namespace cullet {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestModel = 1ull << 30;  // bytes; the importer's own limit on memory is of that size
constexpr double kLongestImport = 20;           // s; the importer gives up after 14 by itself
constexpr uint32_t kImporterVersion = 1;        // raise it when the importer gives other meshes for the same file

std::string lower_case_extension(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return extension;
}

/// The values of "uri" in a glTF text that name files, in the order of the text. No JSON reader: a text that hides a
/// name behind escapes costs a stale cache entry, nothing else.
std::vector<std::string> named_files(const std::vector<uint8_t>& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::vector<std::string> names;
    for (size_t at = text.find("\"uri\""); at != text.npos; at = text.find("\"uri\"", at + 5)) {
        const size_t open = text.find('"', at + 5);
        const size_t close = open == text.npos ? text.npos : text.find('"', open + 1);
        if (close == text.npos) break;
        const std::string_view name = text.substr(open + 1, close - open - 1);
        if (name.size() < 1024 && name.substr(0, 5) != "data:") names.emplace_back(name);
    }
    return names;
}

std::string content_key(const std::string& path, const std::vector<uint8_t>& bytes) {
    const std::string extension = lower_case_extension(path);
    const auto hash_of = [](const std::vector<uint8_t>& b) { return XXH3_128bits(b.data(), b.size()); };
    std::vector<XXH128_hash_t> parts{
        hash_of(bytes), XXH3_128bits(extension.data(), extension.size()), {kImporterVersion, 0}};
    if (extension == ".gltf")
        for (const std::string& name : named_files(bytes)) {
            const auto beside = read_whole_file((fs::path(path).parent_path() / name).string(), kLargestModel);
            parts.push_back(beside.ok() ? hash_of(beside.value()) : XXH128_hash_t{});
        }
    const XXH128_hash_t all = XXH3_128bits(parts.data(), parts.size() * sizeof parts[0]);
    char hex[33];
    std::snprintf(hex, sizeof hex, "%016llx%016llx", static_cast<unsigned long long>(all.high64),
                  static_cast<unsigned long long>(all.low64));
    return hex;
}

/// What the program wrote to its standard error, read until it closes it or the time is over.
std::string listen(int pipe, const ImportWaiting& waiting, bool& is_late) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    std::string said;
    for (;;) {
        const double gone = std::chrono::duration<double>(Clock::now() - begin).count();
        is_late = gone >= kLongestImport;
        if (is_late) return said;
        pollfd wait{pipe, POLLIN, 0};
        if (::poll(&wait, 1, 100) <= 0) {
            if (waiting) waiting(gone, kLongestImport);
            continue;
        }
        char buffer[512];
        const ssize_t n = ::read(pipe, buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return said;
        if (said.size() < 4096) said.append(buffer, static_cast<size_t>(n));
    }
}

Result<pid_t> start(const std::string& program, const std::string& in, const std::string& out, int error_pipe) {
    std::string arguments[] = {program, in, out};
    char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, error_pipe, STDERR_FILENO);
    pid_t child = -1;
    const int trouble = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (trouble != 0)
        return Error{program + ": the import program cannot be started (" + std::strerror(trouble) +
                     "). Build the target cullet_import or give its path."};
    return child;
}

Result<void> run_importer(const std::string& program, const std::string& in, const std::string& out,
                          const ImportWaiting& waiting) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return Error{in + ": no pipe to the import program. Close some files."};
    const auto child = start(program, in, out, ends[1]);
    ::close(ends[1]);
    if (!child) {
        ::close(ends[0]);
        return Error{child.error()};
    }
    bool is_late = false;
    std::string said = listen(ends[0], waiting, is_late);
    ::close(ends[0]);
    if (is_late) ::kill(child.value(), SIGKILL);
    int status = 0;
    while (::waitpid(child.value(), &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    while (!said.empty() && said.back() == '\n') said.pop_back();
    std::replace(said.begin(), said.end(), '\n', ' ');
    if (said.empty()) said = in + ": the import program stopped without a word. Run it by hand: " + program + " " + in;
    return Error{said};
}

Result<Mesh> import_and_cache(const std::string& path, const std::string& program, const std::string& cache_folder,
                              const ImportWaiting& waiting) {
    auto bytes = read_whole_file(path, kLargestModel);
    if (!bytes) return Error{bytes.error()};
    if (is_mesh_file(*bytes)) return parse_mesh_file(*bytes, path);

    std::error_code trouble;
    fs::create_directories(cache_folder, trouble);
    const std::string cached = (fs::absolute(cache_folder) / (content_key(path, *bytes) + ".cmesh")).string();
    auto mesh = read_mesh_file(cached);
    if (mesh) {
        ::utimensat(AT_FDCWD, cached.c_str(), nullptr, 0);  // used now; whoever keeps the folder small sees it
    } else {
        // An absolute path cannot be taken for an option.
        if (auto r = run_importer(program, fs::absolute(path).string(), cached, waiting); !r) return Error{r.error()};
        mesh = read_mesh_file(cached);
        if (!mesh) return Error{mesh.error()};
    }
    mesh->name = fs::path(path).stem().string().substr(0, kLongestMeshName);
    if (auto r = validate_mesh(*mesh, path); !r) return Error{r.error()};
    return mesh;
}

}  // namespace

Result<Mesh> import_mesh(const std::string& path, const std::string& program_path, const std::string& cache_folder,
                         const ImportWaiting& waiting) {
    try {
        return import_and_cache(path, program_path, cache_folder, waiting);
    } catch (const std::exception& e) {
        return Error{path + ": cannot be imported (" + e.what() + "). Free memory or check the path."};
    }
}

}  // namespace cullet
