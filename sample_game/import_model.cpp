#include "sample_game/import_model.hpp"

#include <unistd.h>

#include <filesystem>

#include "engine/import_mesh.hpp"

namespace cullet {

namespace fs = std::filesystem;

Result<Mesh> import_model(const std::string& path) {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return Error{"/proc/self/exe: cannot be read, so cullet_import is not found; mount /proc."};
    fs::path cache = folder / "mesh_cache";
    fs::create_directories(cache, error);
    if (error || access(cache.c_str(), W_OK) != 0)
        cache = fs::temp_directory_path(error) / ("cullet_mesh_cache." + std::to_string(getuid()));
    return import_mesh(path, (folder / "cullet_import").string(), cache.string());
}

}  // namespace cullet
