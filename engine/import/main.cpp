// cullet_import IN OUT.cmesh [--memory-mib 1024] [--seconds 10] [--notes-apart], or cullet_import --version
// Exit code 0 and one line of counts and repairs, or 2 and one sentence. With --notes-apart a second line tells what
// the mesh file does not hold, where there is anything. OUT is written whole or not at all, and over ordinary files
// only, never over IN.
#include <assimp/version.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "cullet/model.hpp"
#include "engine/import/import.hpp"
#include "engine/import/words.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

constexpr size_t kLongestLine = 4000;  // bytes; a path and all the repairs that there are
constexpr char kNotesBegin = '\n';     // between the line and its notes, while they are on the way

std::string box_of(const Mesh& mesh) {
    Vec3 low = mesh.positions[0], high = mesh.positions[0];
    for (const Vec3 p : mesh.positions) {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    char box[96];
    std::snprintf(box, sizeof box, "%.4g x %.4g x %.4g m", static_cast<double>(high.x - low.x),
                  static_cast<double>(high.y - low.y), static_cast<double>(high.z - low.z));
    return box;
}

uint64_t materials_of(const Mesh& mesh) {
    std::vector<bool> is_used(65536);
    uint64_t materials = 0;
    for (const uint16_t m : mesh.materials)
        if (!is_used[m]) is_used[m] = true, ++materials;
    return materials;
}

std::string parts_of(const MeshReport& report) {
    std::string text = counted(report.parts, "part", "parts");
    if (report.closed_parts == report.parts) return text + (report.parts == 1 ? ", closed" : ", all closed");
    return text + (report.closed_parts == 0 ? ", open" : ", " + std::to_string(report.closed_parts) + " closed");
}

/// What reading changed, and what the library will change whenever it cooks the mesh file.
std::string repairs_of(const ConvertedModel& model, const MeshReport& report) {
    std::string text;
    const auto say = [&text](uint64_t n, const std::string& before, const char* one, const char* many,
                             const std::string& after = "") {
        if (n > 0) text += (text.empty() ? "Reading " : ", ") + before + " " + counted(n, one, many) + after;
    };
    say(model.joined, "joined", "equal point", "equal points");
    say(model.collapsed, "dropped", "triangle", "triangles", " with a repeated corner");
    say(model.left_out, "left out", "line or point", "lines and points");
    say(model.unusable_normals, "took", "unusable normal", "unusable normals", " from the triangle");
    say(model.unusable_uvs, "set", "unusable texture coordinate", "unusable texture coordinates", " to 0");
    return (text.empty() ? "" : text + ". ") + report.repairs;
}

MeshView view_of(const Mesh& mesh) {
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.name = mesh.name.c_str();
    return view;
}

std::string line_of(const std::string& path, const ConvertedModel& model, const MeshReport& report) {
    const Mesh& mesh = model.mesh;
    std::string notes;
    for (const std::string& note : model.notes) notes += (notes.empty() ? kNotesBegin : ' ') + note;
    return one_line(path) + ": " + counted(mesh.positions.size(), "vertex", "vertices") + ", " +
           counted(mesh.triangles.size(), "triangle", "triangles") + ", " +
           counted(materials_of(mesh), "material", "materials") + ", " + box_of(mesh) + ", " + parts_of(report) + ". " +
           repairs_of(model, report) + notes;
}

Result<Delivery> convert_and_encode(const std::string& path) {
    auto model = convert_model(path);
    if (!model) return Error{model.error()};
    if (auto r = validate_mesh(model->mesh, path); !r) return Error{r.error()};
    const auto report = examine_mesh(view_of(model->mesh));
    if (!report) return Error{path + ": " + report.error()};
    return Delivery{encode_mesh_file(model->mesh), line_of(path, *model, *report)};
}

/// One line that is written over, on a terminal only; a refusal stays a single sentence everywhere.
class WaitingLine {
 public:
    WaitingLine(std::string path, double seconds) : path_(std::move(path)), seconds_(seconds) {}
    ~WaitingLine() {
        if (is_shown_) std::fprintf(stderr, "\r\033[K");
    }
    WaitingLine(const WaitingLine&) = delete;
    WaitingLine& operator=(const WaitingLine&) = delete;
    void show(double gone) {
        if (::isatty(STDERR_FILENO) != 1) return;
        std::fprintf(stderr, "\rreading %s: %.1f s, at most %.0f s\033[K", path_.c_str(), gone, seconds_);
        std::fflush(stderr);
        is_shown_ = true;
    }

 private:
    std::string path_;
    double seconds_;
    bool is_shown_ = false;
};

/// The game keeps meshes under it.
std::string version() {
    return "cullet_import " + std::to_string(kImporterVersion) + ", assimp " + std::to_string(aiGetVersionMajor()) +
           "." + std::to_string(aiGetVersionMinor()) + "." + std::to_string(aiGetVersionPatch());
}

/// Before a process is started for it.
Result<void> check_in(const std::string& in) {
    struct stat model {};
    if (::access(in.c_str(), R_OK) != 0 || ::stat(in.c_str(), &model) != 0)
        return Error{in + ": cannot open the file (" + std::strerror(errno) + "). Check the path."};
    if (S_ISDIR(model.st_mode)) return Error{in + ": is a folder. Give the path of a model in it."};
    if (S_ISREG(model.st_mode) && model.st_size == 0) return Error{in + ": is empty. Copy or export it again."};
    return {};
}

/// Before the model is read, so that nobody waits for a refusal.
Result<void> check_out(const std::string& in, const std::string& out) {
    if (const auto target = target_of(out); !target) return Error{target.error()};
    struct stat model {
    }, there{};
    if (::stat(in.c_str(), &model) == 0 && ::stat(out.c_str(), &there) == 0 && model.st_dev == there.st_dev &&
        model.st_ino == there.st_ino)
        return Error{out + ": is the model itself. Give the mesh file another name."};
    return {};
}

/// The child is not believed either: its bytes go through the reader.
Result<std::string> import_model(const std::string& in, const std::string& out, const ImportLimits& limits) {
    if (auto r = check_in(in); !r) return Error{r.error()};
    if (auto r = check_out(in, out); !r) return Error{r.error()};
    const auto work = [&in] { return convert_and_encode(in); };
    auto delivery = [&] {
        WaitingLine line(one_line(in), longest_wait(limits));
        return run_limited(in, limits, work, [&line](double gone) { line.show(gone); });
    }();
    if (!delivery) return Error{delivery.error()};
    auto mesh = parse_mesh_file(delivery->bytes, in);
    if (!mesh) return Error{mesh.error()};
    if (auto r = write_mesh_file(*mesh, out); !r) return Error{r.error()};
    return delivery->line;
}

/// On one line, or on a second one what the mesh does not hold.
void print(const std::string& line, bool notes_apart) {
    const size_t notes = notes_apart ? std::min(line.find(kNotesBegin), line.size()) : line.size();
    std::printf("%s\n", one_line(line.substr(0, notes), kLongestLine).c_str());
    if (notes < line.size()) std::printf("%s\n", one_line(line.substr(notes + 1), kLongestLine).c_str());
}

}  // namespace
}  // namespace cullet

int main(int argc, char** argv) {
    std::string in, out;
    cullet::ImportLimits limits;
    CLI::App app{
        "Reads a model (OBJ, PLY, STL, 3MF, FBX, Collada, glTF and more: docs/importing.md) and writes one mesh file "
        "(.cmesh).",
        "cullet_import"};
    app.add_option("in", in, "the model")->required();
    app.add_option("out", out, "the mesh file to write")->required();
    app.add_option("--memory-mib", limits.memory_mib, "most memory for reading the model, MiB")
        ->check(CLI::Range(64, 65536))
        ->capture_default_str();
    app.add_option("--seconds", limits.seconds, "most processor time for reading the model, s")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    bool notes_apart = false;
    app.add_flag("--notes-apart", notes_apart, "a second line for what the model holds and the mesh file does not");
    app.set_version_flag("--version", cullet::version());
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
        return app.exit(e);
    } catch (const CLI::ArgumentMismatch& e) {  // an option at the end, without its number
        const std::string said = cullet::one_line(e.what());
        std::fprintf(stderr, "cullet_import: %s: wants a number. See cullet_import --help.\n",
                     said.substr(0, said.find(':')).c_str());
        return 2;
    } catch (const CLI::ParseError& e) {
        std::fprintf(stderr, "cullet_import: %s. See cullet_import --help.\n", cullet::one_line(e.what()).c_str());
        return 2;
    }
    try {
        const auto line = cullet::import_model(in, out, limits);
        if (line.ok()) {
            cullet::print(line.value(), notes_apart);
            return 0;
        }
        std::fprintf(stderr, "%s\n", cullet::one_line(line.error(), cullet::kLongestLine).c_str());
    } catch (const std::exception&) {
        std::fprintf(stderr, "%s: no memory to take over the result. Simplify the model.\n",
                     cullet::one_line(in).c_str());
    }
    return 2;
}
