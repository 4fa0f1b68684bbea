#include "engine/import/import_mesh.hpp"

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
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/import/import.hpp"
#include "engine/import/import_folder.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

extern char** environ;

namespace cullet {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestModel = 1ull << 30;    // bytes; the importer's own limit on memory is of that size
constexpr uint64_t kMostNamedBytes = 1ull << 29;  // of all files that a glTF names; a second or two to hash
constexpr size_t kMostNames = 4096;               // in a glTF; each costs a look at the folder, some 10 us
constexpr size_t kLongestName = 4096;             // bytes; no path is longer
constexpr double kLongestImport = 20;             // s; a program that has not given up by itself is ended
constexpr size_t kLongestSentence = 4096;         // bytes

std::string lower_case_extension(const std::string& path) {
    return small_letters(fs::path(path).extension().string());
}

/// The values of "uri" in a glTF text that name files, in the order of the text; nothing when there are too many. No
/// JSON reader: a text that hides a name behind escapes costs a stale cache entry, nothing else.
std::optional<std::vector<std::string>> named_files(std::string_view text) {
    std::vector<std::string> names;
    for (size_t at = text.find("\"uri\""); at != text.npos; at = text.find("\"uri\"", at + 5)) {
        const size_t open = text.find('"', at + 5);
        const size_t close = open == text.npos ? text.npos : text.find('"', open + 1);
        if (close == text.npos) break;
        const std::string_view name = text.substr(open + 1, close - open - 1);
        if (is_word(name.substr(0, 5), "data:")) continue;
        if (names.size() >= kMostNames || name.size() >= kLongestName) return std::nullopt;
        names.emplace_back(name);
    }
    return names;
}

/// Nothing when the file is no ordinary one, cannot be read to its end, or has more bytes than are left.
std::optional<XXH128_hash_t> hash_of_file(const std::string& path, uint64_t& bytes_left) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return std::nullopt;
    struct stat status {};
    bool is_good =
        ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && static_cast<uint64_t>(status.st_size) <= bytes_left;
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    is_good = is_good && state != nullptr && XXH3_128bits_reset(state.get()) == XXH_OK;
    std::vector<uint8_t> block(1 << 18);
    while (is_good) {
        const ssize_t n = ::read(file, block.data(), block.size());
        if (n < 0 && errno == EINTR) continue;
        if (n == 0) break;
        is_good = n > 0 && static_cast<uint64_t>(n) <= bytes_left;
        if (!is_good) break;
        bytes_left -= static_cast<uint64_t>(n);
        XXH3_128bits_update(state.get(), block.data(), static_cast<size_t>(n));
    }
    ::close(file);
    if (!is_good) return std::nullopt;
    return XXH3_128bits_digest(state.get());
}

/// One part a name: the hash of the file that the importer would open for it, or zero. Each file is read once, however
/// often it is named. False when they are too many or too large to be read here, where nothing limits the time: the
/// importer then reads them within its own limits, and the result is not kept.
bool append_named_files(const std::string& path, std::string_view text, std::vector<XXH128_hash_t>& parts) {
    const auto names = named_files(text);
    if (!names) return false;
    const ModelFolder folder(path);
    std::map<std::string, XXH128_hash_t> hashes;
    uint64_t bytes_left = kMostNamedBytes;
    for (const std::string& name : *names) {
        const std::string file = folder.find_beside(name);
        auto known = hashes.find(file);
        if (known == hashes.end()) {
            const auto hash = file.empty() ? XXH128_hash_t{} : hash_of_file(file, bytes_left);
            if (!hash) return false;
            known = hashes.emplace(file, *hash).first;
        }
        parts.push_back(known->second);
    }
    return true;
}

/// The part of a glTF file that names others: all of a .gltf, the JSON that a binary one begins with, whatever it is
/// called (its length stands at byte 12, in version 1 as in version 2). Of other formats nothing: none of those that
/// games use keeps triangles beside it.
std::string_view naming_text(const std::string& extension, const std::vector<uint8_t>& bytes) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool is_binary = all.substr(0, 4) == "glTF";
    if (extension == ".gltf" && !is_binary) return all;
    if (!is_binary || bytes.size() < 20) return {};
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return all.substr(20, length);
}

XXH128_hash_t hash_of(std::string_view text) {
    return XXH3_128bits(text.data(), text.size());
}

/// The name of the cache entry; empty when the result is not to be kept.
std::string content_key(const std::string& path, const std::vector<uint8_t>& bytes, const std::string& version) {
    const std::string extension = lower_case_extension(path);
    const auto begin = bytes.begin(), end = begin + static_cast<ptrdiff_t>(std::min<size_t>(bytes.size(), 4));
    if (extension == ".gltf" && std::find(begin, end, 0) != end) return "";  // UTF-16: no names are found in it
    std::vector<XXH128_hash_t> parts{XXH3_128bits(bytes.data(), bytes.size()), hash_of(extension), hash_of(version)};
    if (!append_named_files(path, naming_text(extension, bytes), parts)) return "";
    const XXH128_hash_t all = XXH3_128bits(parts.data(), parts.size() * sizeof parts[0]);
    char hex[33];
    std::snprintf(hex, sizeof hex, "%016llx%016llx", static_cast<unsigned long long>(all.high64),
                  static_cast<unsigned long long>(all.low64));
    return hex;
}

/// What the program wrote, read until it closes the pipe or the time is over.
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
            const double most = longest_wait({});  // the program's own limit, by the clock
            if (waiting) waiting(std::min(gone, most), most);
            continue;
        }
        char buffer[512];
        const ssize_t n = ::read(pipe, buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return said;
        if (said.size() < 4 * kLongestSentence) said.append(buffer, static_cast<size_t>(n));
    }
}

/// `arguments` begin with the program. What it writes goes to the pipe.
Result<pid_t> start(std::vector<std::string> arguments, int pipe) {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe, STDERR_FILENO);
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);  // the game's own; the reading child closes them in any case
#endif
    pid_t child = -1;
    const int trouble = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (trouble != 0)
        return Error{arguments[0] + ": the import program cannot be started (" + std::strerror(trouble) +
                     "). Build the target cullet_import or give its path."};
    return child;
}

/// What the program said when it ended with exit code 0; otherwise that as the error, which may be empty.
Result<std::string> run_importer(const std::vector<std::string>& arguments, const ImportWaiting& waiting) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return Error{arguments[0] + ": no pipe to the import program. Close some files."};
    const auto child = start(arguments, ends[1]);
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
    while (!said.empty() && said.back() == '\n') said.pop_back();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return said;
    return Error{said};
}

/// The program's own version and that of assimp, which belong to the name of a cache entry. Asked for at each import: a
/// process started and ended, 10 to 15 ms. The library is loaded at run time, so what this was built with says nothing.
Result<std::string> version_of(const std::string& program) {
    auto said = run_importer({program, "--version"}, {});
    if (!said && said.error().empty())
        return Error{program + ": the import program does not tell its version. Build the target cullet_import anew."};
    return said;
}

struct Imported {
    Mesh mesh;
    std::string notes;
};

/// The mesh file that the program makes of a model, and the second line that it says, if there is one. An absolute path
/// cannot be taken for an option.
Result<Imported> read_imported(const std::string& path, const std::string& program, const std::string& out,
                               const ImportWaiting& waiting) {
    const auto said = run_importer({program, fs::absolute(path).string(), out, "--notes-apart"}, waiting);
    if (said) {
        auto mesh = read_mesh_file(out);
        if (!mesh) return Error{mesh.error()};
        const size_t end = said->find('\n');
        return Imported{std::move(*mesh), end == said->npos ? "" : said->substr(end + 1)};
    }
    if (!said.error().empty()) return Error{said.error()};
    return Error{path + ": the import program stopped without a word. Run it by hand: " + program + " " + path};
}

/// Where a mesh stands before it has its name, in a folder that several runs may share.
std::string passing_file(const fs::path& folder) {
    return folder / ("passing." + std::to_string(::gettid()) + ".cmesh");
}

Result<Imported> import_without_cache(const std::string& path, const std::string& program, const fs::path& folder,
                                      const ImportWaiting& waiting) {
    const std::string out = passing_file(folder);
    auto mesh = read_imported(path, program, out, waiting);
    ::unlink(out.c_str());
    return mesh;
}

/// Notes stand beside the mesh file, where there are any, and before it: whoever finds the mesh finds them too. When
/// they cannot be written, the mesh is not kept.
Result<Imported> import_into_cache(const std::string& path, const std::string& program, const std::string& cached,
                                   const ImportWaiting& waiting) {
    const std::string out = passing_file(fs::path(cached).parent_path()), beside = cached + ".notes";
    auto imported = read_imported(path, program, out, waiting);
    bool is_kept = imported.ok();
    if (is_kept && imported->notes.empty()) ::unlink(beside.c_str());
    if (is_kept && !imported->notes.empty()) {
        const auto* bytes = reinterpret_cast<const uint8_t*>(imported->notes.data());
        is_kept = write_whole_file({bytes, imported->notes.size()}, beside).ok();
    }
    if (!is_kept || ::rename(out.c_str(), cached.c_str()) != 0) ::unlink(out.c_str());
    return imported;
}

Result<Imported> import_with_cache(const std::string& path, const std::string& program, const std::string& cached,
                                   const ImportWaiting& waiting) {
    const std::string beside = cached + ".notes";
    auto mesh = read_mesh_file(cached);
    if (!mesh) return import_into_cache(path, program, cached, waiting);
    for (const std::string& used : {cached, beside})
        ::utimensat(AT_FDCWD, used.c_str(), nullptr, 0);  // used now; whoever keeps the folder small sees it
    const auto notes = read_whole_file(beside, kLongestSentence);
    return Imported{std::move(*mesh), notes ? std::string(notes->begin(), notes->end()) : ""};
}

Result<Imported> import_any(const std::string& path, const std::string& program, const std::string& cache_folder,
                            const ImportWaiting& waiting) {
    auto bytes = read_whole_file(path, kLargestModel);
    if (!bytes) return Error{bytes.error()};
    if (is_mesh_file(*bytes)) {
        auto mesh = parse_mesh_file(*bytes, path);
        if (!mesh) return Error{mesh.error()};
        return Imported{std::move(*mesh), ""};
    }

    const auto version = version_of(program);
    if (!version) return Error{version.error()};
    std::error_code trouble;
    fs::create_directories(cache_folder, trouble);
    const fs::path folder = fs::absolute(cache_folder);
    const std::string key = content_key(path, *bytes, *version);
    auto imported = key.empty() ? import_without_cache(path, program, folder, waiting)
                                : import_with_cache(path, program, folder / (key + ".cmesh"), waiting);
    if (!imported) return Error{imported.error()};
    Mesh& mesh = imported->mesh;
    mesh.name = one_line(fs::path(path).stem().string()).substr(0, kLongestMeshName);
    if (auto r = validate_mesh(mesh, path); !r) return Error{r.error()};
    return imported;
}

}  // namespace

Result<Mesh> import_mesh(const std::string& path, const std::string& program_path, const std::string& cache_folder,
                         const ImportWaiting& waiting, std::string* notes) {
    try {
        auto imported = import_any(path, program_path, cache_folder, waiting);
        if (!imported) return Error{one_line(imported.error(), kLongestSentence)};
        if (notes != nullptr) *notes = one_line(imported->notes, kLongestSentence);
        return std::move(imported->mesh);
    } catch (const std::exception& e) {
        return Error{one_line(path) + ": cannot be imported (" + e.what() + "). Free memory or check the path."};
    }
}

}  // namespace cullet
