#include "sample_game/reproduce/metal/metal_drawn.hpp"

#include <algorithm>
#include <cmath>

#include "engine/jobs.hpp"
#include "sample_game/metal/metal_car.hpp"
#include "sample_game/report.hpp"

namespace cullet::reproduce {

Camera camera_at(Vec3 eye, Vec3 target, float field_of_view) {
    Camera camera;
    camera.eye = eye, camera.target = target, camera.vertical_field_of_view = field_of_view;
    return camera;
}

Picture draw_metal(Bench& bench, const MetalBench& metal, const Camera& camera, bool shows_cells) {
    const MetalView view = metal.view();
    std::vector<Vec3> positions;
    float low = 1e30f, thick = 0;
    for (uint32_t v = 0; v < view.vertex_count(); ++v) thick = std::max(thick, std::fabs(metal.original(v).z));
    for (uint32_t v = 0; v < view.vertex_count(); ++v) {
        const Vec3 p = metal.place(v);
        positions.push_back(thick > 0.01f ? p : Vec3{p.x, p.z, -p.y});  // a panel lies on its back
        low = std::min(low, positions.back().y);
    }
    std::vector<std::vector<uint32_t>> indices(shows_cells ? view.cell_count() : 1);
    for (uint32_t e = 0; e < view.element_count(); ++e)
        for (const uint32_t v : view.corners(e)) indices[shows_cells ? view.cell_of(e) : 0].push_back(v);
    std::vector<DrawnBody> bodies;
    for (size_t k = 0; k < indices.size(); ++k) {
        DrawnBody body;
        body.positions = positions, body.indices = indices[k];
        body.colour = shows_cells ? fragment_colour(static_cast<uint32_t>(k + 1)) : Vec3{0.33f, 0.37f, 0.42f};
        body.gloss = 0.5f, body.is_outlined = false;
        bodies.push_back(body);
    }
    PictureSettings settings;
    settings.width = bench.picture_width(), settings.height = settings.width * 9 / 16;
    settings.ground_height = low - (thick > 0.01f ? 0 : 0.1f), settings.grid_spacing = 0.5f;
    settings.has_ground = true;
    const std::unique_ptr<JobSystem> jobs = make_jobs(JobBackend::Threads, bench.threads());
    settings.for_each = [&jobs](uint32_t count, const std::function<void(uint32_t)>& job) {
        parallel_for(*jobs, count, job);
    };
    return draw(bodies, camera, Sun{}, settings);
}

Result<void> add_plot(Bench& bench, Claim& claim, const Plot& plot, const std::string& name,
                      const std::string& caption) {
    const std::string file = claim.id + "_" + name + ".svg";
    if (auto written = write_text(to_svg(plot), bench.settings().out + "/" + file); !written.ok()) return written;
    claim.pictures.push_back({file, caption});
    return {};
}

Result<MetalBench> paper_panel(Bench& bench, uint8_t published) {
    const bool is_small = bench.settings().is_reduced;
    const Result<Model>& model = bench.once("panel", [&] {
        return cook_metal_mesh(metal_sheet(1.2, 0.8, is_small ? 48 : 120, is_small ? 32 : 80), "steel", 1e-3);
    });
    if (!model.ok()) return Error{model.error()};
    MetalCookSettings settings;
    settings.cells.count = 128, settings.published = published;
    MetalBench metal(*model, &settings);
    metal.clamp();
    return metal;
}

std::optional<MetalBench> paper_car(Bench& bench, uint8_t published) {
    const std::optional<Model>& car = toy_car();
    if (!car) {
        bench.note("metal_shell/toycar_body_26k.ply is not in the folder of test data: its rows are left out.");
        return std::nullopt;
    }
    MetalCookSettings settings;
    settings.cells.count = 128, settings.published = published;
    settings.crush_pressure = static_cast<float>(kCarPressure);
    return MetalBench(*car, &settings);
}

Striker coming(const MetalBench& metal, StrikerShape shape, Vec3d push, double radius, Vec3d through) {
    Striker striker;
    striker.shape = shape, striker.push = push, striker.radius = radius, striker.axis = {0, 1, 0};
    striker.point = through;
    double least = 1e30;
    for (uint32_t v = 0; v < metal.view().vertex_count(); ++v)
        least = std::min(least, striker.gap(Vec3d(metal.place(v))));
    striker.point += least * push;
    return striker;
}

}  // namespace cullet::reproduce
