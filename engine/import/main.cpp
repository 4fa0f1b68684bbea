// cullet_import IN OUT.cmesh [--memory-mib 1024] [--seconds 10]
// Exit code 0 and one line of counts, or 2 and one sentence. OUT is written whole or not at all.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "engine/import/import.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

std::string counts_of(const std::string& path, const ConvertedModel& model) {
    const Mesh& mesh = model.mesh;
    std::vector<bool> is_used(65536);
    size_t materials = 0;
    for (const uint16_t m : mesh.materials)
        if (!is_used[m]) is_used[m] = true, ++materials;
    Vec3 low = mesh.positions[0], high = mesh.positions[0];
    for (const Vec3 p : mesh.positions) {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    char box[96];
    std::snprintf(box, sizeof box, "%.4g x %.4g x %.4g m", static_cast<double>(high.x - low.x),
                  static_cast<double>(high.y - low.y), static_cast<double>(high.z - low.z));
    const auto count = [](uint64_t n, const char* one, const char* many) {
        return std::to_string(n) + " " + (n == 1 ? one : many) + ", ";
    };
    std::string line = path + ": " + count(mesh.positions.size(), "vertex", "vertices") +
                       count(mesh.triangles.size(), "triangle", "triangles") +
                       count(materials, "material", "materials") + box;
    if (model.collapsed > 0) line += ", triangles left out for repeated corners: " + std::to_string(model.collapsed);
    return line;
}

Result<Delivery> convert_and_encode(const std::string& path) {
    auto model = convert_model(path);
    if (!model) return Error{model.error()};
    if (auto r = validate_mesh(model->mesh, path); !r) return Error{r.error()};
    return Delivery{encode_mesh_file(model->mesh), counts_of(path, *model)};
}

/// The child is not believed either: its bytes go through the reader.
Result<std::string> import_model(const std::string& in, const std::string& out, const ImportLimits& limits) {
    auto delivery = run_limited(in, limits, [&in] { return convert_and_encode(in); });
    if (!delivery) return Error{delivery.error()};
    auto mesh = parse_mesh_file(delivery->bytes, in);
    if (!mesh) return Error{mesh.error()};
    if (auto r = write_mesh_file(*mesh, out); !r) return Error{r.error()};
    return delivery->line;
}

}  // namespace
}  // namespace cullet

int main(int argc, char** argv) {
    std::string in, out;
    cullet::ImportLimits limits;
    CLI::App app{"Reads a model of any format that assimp knows and writes one mesh file (.cmesh).", "cullet_import"};
    app.add_option("in", in, "the model")->required();
    app.add_option("out", out, "the mesh file to write")->required();
    app.add_option("--memory-mib", limits.memory_mib, "most memory for reading the model, MiB")
        ->check(CLI::Range(64, 65536))
        ->capture_default_str();
    app.add_option("--seconds", limits.seconds, "longest time for reading the model, s")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        std::fprintf(stderr, "cullet_import: %s. See cullet_import --help.\n", cullet::one_line(e.what()).c_str());
        return 2;
    }
    try {
        const auto line = cullet::import_model(in, out, limits);
        if (line.ok()) {
            std::printf("%s\n", cullet::one_line(line.value()).c_str());
            return 0;
        }
        std::fprintf(stderr, "%s\n", cullet::one_line(line.error()).c_str());
    } catch (const std::exception&) {
        std::fprintf(stderr, "%s: no memory to take over the result. Simplify the model.\n",
                     cullet::one_line(in).c_str());
    }
    return 2;
}
