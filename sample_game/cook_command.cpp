#include "sample_game/cook_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "sample_game/cache.hpp"
#include "sample_game/cell_picture.hpp"
#include "sample_game/cook_cached.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/model_settings.hpp"
#include "sample_game/progress.hpp"
#include "sample_game/props.hpp"
#include "sample_game/read_materials.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/cook/hit_advice.hpp"

namespace cullet {
namespace {

/// What suits a hollow figure: the wall of the scene drop, 6 mm at 0.4 m.
constexpr float kWallOfLargestSide = 0.015f;

/// What the options said of the damage models' own settings.
Result<void> read_settings(const std::map<std::string, std::string>& given, CookSettings& settings) {
    for (const auto& group : all_cook_settings())
        for (const Setting& setting : group.list) {
            const auto found = given.find(setting.name);
            if (found == given.end()) continue;
            const Result<double> value = read_setting(setting, found->second);
            if (!value.ok()) return Error{value.error()};
            group.set(settings, setting, *value);
        }
    return {};
}

Result<CachedModel> cook_file(const CookOptions& options) {
    const Result<Mesh> mesh = import_model(options.mesh);
    if (!mesh.ok()) return Error{mesh.error()};
    CookSettings settings;
    MaterialTable materials;
    if (!options.materials.empty())
        if (const Result<void> read = read_materials(options.materials, materials); !read.ok())
            return Error{read.error()};
    settings.model = options.model;
    settings.materials = &materials;
    settings.material = options.material;
    for (const FractureKind kind : {FractureKind::Large, FractureKind::Coarse, FractureKind::Fine})
        if (options.fracture == name_of(kind)) settings.fracture = kind;
    settings.thickness =
        options.thickness_m > 0 ? static_cast<float>(options.thickness_m) : kWallOfLargestSide * largest_side(*mesh);
    settings.longest_edge = static_cast<float>(options.edge_m);
    settings.weld_tolerance = static_cast<float>(options.weld);
    settings.seed = options.seed;
    settings.thick_shell.joins_walls = !options.keeps_walls_apart;
    if (const Result<void> read = read_settings(options.of_model, settings); !read.ok()) return Error{read.error()};
    Progress progress(fmt::format("cooking {}", std::filesystem::path(options.mesh).filename().string()));
    settings.progress = &Progress::cooked;
    settings.progress_user = &progress;
    return cook_cached(*mesh, settings, cache_folder());
}

/// The picture beside the model file.
std::string picture_path(const CookOptions& options) {
    return std::filesystem::path(options.out).replace_extension(".png").string();
}

/// Of sheet metal, what stands for strength.
std::string metal_of(const Model& model) {
    const Workbench& rows = model.contents->state;
    const Row<MetalShells> metal = cullet::metal_of(rows, model.contents->shell);
    const double pressure = static_cast<double>(rows.metal_shells.crush_pressure[metal]);
    return fmt::format(
        "{} sub-shells; dents, {}", rows.metal_shells.cells[metal].count,
        pressure > 0 ? fmt::format("and gives way as a whole under {:.3g} MPa", 1e-6 * pressure) : "as an open sheet");
}

std::string strength_of(const ModelReport& r) {
    if (!(r.first_crack_speed > 0)) return "bends, stretches or tears, and has no first crack";
    return fmt::format("first crack at {:.3g} m/s against a floor, {:.0f} million units a hit, {} the {:.0f} of a hold",
                       r.first_crack_speed, 1e-6 * static_cast<double>(r.units_of_a_hit),
                       r.units_of_a_hit > kDefaultHoldUnits ? "more than" : "within",
                       1e-6 * static_cast<double>(kDefaultHoldUnits));
}

void print_summary(const CookOptions& options, const CachedModel& cooked) {
    const ModelReport& r = cooked.model.report();
    fmt::print("{}: {} vertices, {} elements, {} cells; {:.4g} kg of {}, {:.4g} mm thick on average; {}\n", options.out,
               r.vertices, r.elements, r.cells, r.mass, options.material, 1000 * r.mean_thickness,
               cooked.model.contents->damage_model == "metal_shell" ? metal_of(cooked.model) : strength_of(r));
    fmt::print("  generation   {} collisions, {} inverted elements, {} crossings\n", r.collisions, r.inverted_elements,
               r.crossings);
    for (const std::string& note : {r.repairs, r.walls, r.advice, cooked.trouble})
        if (!note.empty()) fmt::print("  note         {}\n", note);
    if (cooked.is_from_cache) fmt::print("  note         The cooked model was taken from the cache.\n");
}

}  // namespace

int cook_command(const CookOptions& options) {
    // Cooking may take long: what cannot be written is said before.
    const std::filesystem::path folder = std::filesystem::path(options.out).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        fmt::print(stderr, "{}: there is no folder {}; make it, or give another --out.\n", options.out,
                   folder.string());
        return 2;
    }
    const Result<CachedModel> cooked = cook_file(options);
    const Result<void> written =
        cooked.ok() ? write_model(cooked->model, options.out) : Result<void>(Error{cooked.error()});
    if (!written.ok()) {
        fmt::print(stderr, "{}\n", written.error());
        return 2;
    }
    print_summary(options, cooked.value());
    if (!options.draw.empty()) {
        const uint32_t threads = std::max(1u, std::thread::hardware_concurrency());
        const Result<void> drawn = write_png(draw_cells(cooked->model, threads), picture_path(options));
        if (!drawn.ok()) {
            fmt::print(stderr, "{}\n", drawn.error());
            return 2;
        }
        fmt::print("  picture      {}\n", picture_path(options));
    }
    return 0;
}

}  // namespace cullet
