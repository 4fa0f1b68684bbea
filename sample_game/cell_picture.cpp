#include "sample_game/cell_picture.hpp"

#include <algorithm>
#include <thread>

#include "components/shell_rows.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet {
namespace {

/// Triangles of one cell: corners of their own, so that its border is sharp.
struct CellMesh {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
};

std::vector<CellMesh> meshes_of(const Workbench& rows, Row<Structures> structure) {
    const Row<Shells> shell = rows.shell_of(structure);
    const Range vertices = rows.shells.vertices[shell], elements = rows.shells.elements[shell];
    const Row<MetalShells> metal = metal_of(rows, structure);
    std::vector<CellMesh> cells;
    for (uint32_t e = 0; e < elements.count; ++e) {
        const uint32_t row = elements.first + e;
        const uint32_t cell = metal.exists() ? rows.metal_elements.cell[rows.metal_shells.elements[metal].first + e]
                                             : rows.elements.cell[row];
        if (cell >= cells.size()) cells.resize(cell + 1);
        for (const uint32_t v : rows.elements.corner[row]) {
            cells[cell].indices.push_back(static_cast<uint32_t>(cells[cell].positions.size()));
            cells[cell].positions.push_back(rows.vertices.rest[vertices.first + v]);
        }
    }
    return cells;
}

void share_out(uint32_t threads, uint32_t count, const std::function<void(uint32_t)>& job) {
    std::vector<std::thread> workers;
    for (uint32_t t = 0; t < threads; ++t)
        workers.emplace_back([&, t] {
            for (uint32_t n = t; n < count; n += threads) job(n);
        });
    for (std::thread& worker : workers) worker.join();
}

}  // namespace

Picture draw_cells(const Model& model, uint32_t threads, uint32_t width) {
    const std::vector<CellMesh> cells = meshes_of(model.contents->state, model.contents->shell);
    std::vector<DrawnBody> bodies;
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    for (const CellMesh& cell : cells) {
        DrawnBody body;
        body.positions = cell.positions;
        body.indices = cell.indices;
        body.colour = fragment_colour(static_cast<uint32_t>(bodies.size() + 1));
        body.gloss = 0;
        body.is_outlined = false;
        bodies.push_back(body);
        for (const Vec3 p : cell.positions) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    const float size = length(high - low);
    Camera camera;
    camera.target = 0.5f * (low + high);
    camera.eye = camera.target + size * Vec3{0.85f, 0.6f, 1.15f};
    camera.vertical_field_of_view = 0.6f;
    PictureSettings settings;
    settings.width = width, settings.height = width * 9 / 16;
    settings.has_ground = false;
    settings.ambient_reach = 0.1f * size;
    const uint32_t workers = std::max(threads, 1u);
    settings.for_each = [workers](uint32_t count, const std::function<void(uint32_t)>& job) {
        share_out(workers, count, job);
    };
    return draw(bodies, camera, {}, settings);
}

}  // namespace cullet
