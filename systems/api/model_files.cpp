// Models to files and back.
#include <new>

#include "engine/host_scope.hpp"
#include "engine/memory.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/with_models.hpp"
#include "systems/cook/model_file.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLargestFile = 1ull << 34;  // rows of it, and of what is derived from them, count in 32 bits

}  // namespace

Result<void> write_model(const Model& model, const std::string& path) {
    if (!model.contents) return Error{path + ": the model is empty; cook one before writing it."};
    try {
        return write_whole_file(encode_model_file(*model.contents), path);
    } catch (const std::bad_alloc&) {
        return Error{path + ": no memory for the bytes of the model. Free memory."};
    }
}

Result<Model> read_model(const std::string& path, const Host* host) {
    return read_model_with(damage_models(), path, host);
}

Result<Model> read_model_with(const ModelList& models, const std::string& path, const Host* given) {
    static const Host no_host;
    const Host& host = given ? *given : no_host;
    if (const Result<void> valid = check_host(host); !valid) return Error{valid.error()};
    const HostScope call(host);
    const MemoryScope memory(host.allocator);
    const Result<std::vector<uint8_t>> bytes = read_whole_file(path, kLargestFile);
    if (!bytes) return Error{bytes.error()};
    return parse_model_file(*bytes, path, *models);
}

}  // namespace cullet
