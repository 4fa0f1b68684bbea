#include "sample_game/import_model.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>

#include "engine/import/import_mesh.hpp"
#include "sample_game/cache.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/progress.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

/// Where nothing can be kept: a folder for this one call.
struct PassingFolder {
    std::string path;
    PassingFolder() {
        std::error_code error;
        std::string name = fs::temp_directory_path(error) / "cullet_mesh.XXXXXX";
        if (!error && ::mkdtemp(name.data()) != nullptr) path = name;
    }
    ~PassingFolder() {
        std::error_code error;
        if (!path.empty()) fs::remove_all(path, error);
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;
};

void say_notes(const std::string& path, const std::string& notes) {
    if (!notes.empty()) fmt::print(stderr, "{}: {}\n", fs::path(path).filename().string(), notes);
}

}  // namespace

Result<Mesh> import_model(const std::string& path) {
    std::error_code error;
    if (!fs::exists(path, error))
        if (Mesh named = make_mesh_named(path); !named.triangles.empty()) return named;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return Error{"/proc/self/exe: cannot be read, so cullet_import is not found; mount /proc."};
    const std::string program = folder / "cullet_import", cache = cache_folder();
    Progress progress(fmt::format("importing {}", fs::path(path).filename().string()));
    const auto waiting = [&progress](double seconds, double most) {
        progress.show(seconds / most, fmt::format("of the {:.0f} s that it may take", most));
    };
    std::string notes;
    if (cache.empty()) {
        const PassingFolder passing;
        if (passing.path.empty())
            return Error{path + ": no folder for its mesh file can be written; set TMPDIR to one that can."};
        Result<Mesh> mesh = import_mesh(path, program, passing.path, waiting, &notes);
        say_notes(path, notes);
        return mesh;
    }
    Result<Mesh> mesh = import_mesh(path, program, cache, waiting, &notes);
    say_notes(path, notes);
    trim_cache(cache);
    return mesh;
}

}  // namespace cullet
