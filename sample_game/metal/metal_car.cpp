#include "sample_game/metal/metal_car.hpp"

#include <cstdlib>
#include <filesystem>

#include "sample_game/import_model.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/props.hpp"

namespace cullet {

std::string metal_data_folder() {
    const char* folder = std::getenv("CULLET_TEST_DATA");
    return folder ? folder : "../shared/data";
}

Model even_car_of(const char* metal) {
    return cook_metal_mesh(make_car(), metal, 0.8e-3).value();
}

const Model& even_car() {
    static const Model kCar = even_car_of("steel");
    return kCar;
}

const std::optional<Model>& toy_car() {
    static const std::optional<Model> kCar = []() -> std::optional<Model> {
        const std::filesystem::path file =
            std::filesystem::path(metal_data_folder()) / "metal_shell/toycar_body_26k.ply";
        std::error_code error;
        if (!std::filesystem::exists(file, error)) return std::nullopt;
        Result<Mesh> mesh = import_model(file.string());
        if (!mesh.ok()) return std::nullopt;
        const MeshExtent extent = extent_of(*mesh);
        const Result<Model> model =
            cook_metal_mesh(*mesh, "steel", 0.8e-3, 0.05 * double{length(extent.high - extent.low)});
        if (!model.ok()) return std::nullopt;
        return *model;
    }();
    return kCar;
}

}  // namespace cullet
