#include "sample_game/metal/metal_bench.hpp"

#include <algorithm>
#include <cmath>

#include "systems/cook/model_contents.hpp"

namespace cullet {

Mesh metal_sheet(double width, double height, uint32_t columns, uint32_t rows) {
    Mesh mesh;
    mesh.name = "sheet";
    for (uint32_t r = 0; r <= rows; ++r)
        for (uint32_t c = 0; c <= columns; ++c)
            mesh.positions.push_back(Vec3{static_cast<float>(width * (static_cast<double>(c) / columns - 0.5)),
                                          static_cast<float>(height * (static_cast<double>(r) / rows - 0.5)), 0});
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = r * (columns + 1) + c, b = a + 1, d = a + columns + 1, e = d + 1;
            if ((r + c) % 2 == 0) {
                mesh.triangles.push_back({a, b, e}), mesh.triangles.push_back({a, e, d});
            } else {
                mesh.triangles.push_back({a, b, d}), mesh.triangles.push_back({b, e, d});
            }
        }
    return mesh;
}

Result<Model> cook_metal_mesh(const Mesh& mesh, const std::string& material, double thickness, double longest_edge) {
    CookSettings settings;
    settings.model = "metal_shell";
    settings.material = material;
    settings.thickness = static_cast<float>(thickness);
    settings.longest_edge = static_cast<float>(longest_edge);
    MeshView view;
    view.positions = mesh.positions.data(), view.position_count = mesh.positions.size();
    view.indices = mesh.triangles.empty() ? nullptr : mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.name = mesh.name.c_str();
    return cook(view, settings);
}

MetalBench::MetalBench(const Model& model, const MetalCookSettings* settings) {
    const Model::Contents& from = *model.contents;
    rows_ = std::make_unique<Workbench>(cooking_limits(from.report.vertices, from.report.elements));
    const auto copy_all = [](auto& to, const auto& all) {
        to.append(all.size());
        for (uint32_t row = 0; row < all.size(); ++row) to.copy_rows(all, row, row, 1);
    };
    copy_all(rows_->materials, from.state.materials);
    copy_all(rows_->material_traits, from.state.material_traits);
    const char* full = "";
    shell_ = import_shell(*rows_, from.state, from.shell, &full);
    CULLET_ASSERT(shell_.exists(), "no room on a bench: %s", full);
    if (!settings) return;
    release_metal(*rows_, shell_);
    const Result<MetalReport> made = make_metal_rows(*rows_, shell_, *settings);
    CULLET_ASSERT(made.ok(), "%s", made.error().c_str());
}

void MetalBench::hold(const std::function<bool(Vec3)>& is_held) {
    const ShellView of(*rows_, shell_);
    for (uint32_t v = 0; v < of.vertex_count(); ++v) {
        if (!is_held(rows_->vertices.rest[of.vertex(v)])) continue;
        rows_->vertices.is_pinned[of.vertex(v)] = 1;
        rows_->vertices.inverse_mass[of.vertex(v)] = 0;
    }
    measure_pins(*rows_, shell_);
}

void MetalBench::clamp() {
    Vec3 low{1e30f, 1e30f, 0}, high{-1e30f, -1e30f, 0};
    const uint32_t count = view().vertex_count();
    for (uint32_t v = 0; v < count; ++v) {
        const Vec3 p = original(v);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0}, high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    const float rim = 1e-4f * (high.x - low.x);
    hold([&](Vec3 p) { return p.x < low.x + rim || p.x > high.x - rim || p.y < low.y + rim || p.y > high.y - rim; });
}

void MetalBench::set_yield(double stress) {
    const Row<Materials> material = rows_->structures.material[shell_];
    rows_->material_traits.yield_strain[material] =
        static_cast<float>(stress / double{rows_->materials.young_modulus[material]});
}

void MetalBench::set_crush_pressure(double pressure) {
    rows_->metal_shells.crush_pressure[view().row] = static_cast<float>(pressure);
}

Dent MetalBench::hit(const Striker& striker, double energy) {
    const MetalView metal = view();
    const Dent dent = work_dent(metal, striker, energy);
    if (dent.kind != DentKind::None) bake_dent(metal);
    return dent;
}

Striker MetalBench::ball_over(double x, double y, double radius) const {
    double z = -1e30;
    for (uint32_t v = 0; v < view().vertex_count(); ++v) {
        const Vec3d p(place(v));
        const double square = radius * radius - (p.x - x) * (p.x - x) - (p.y - y) * (p.y - y);
        if (square > 0) z = std::max(z, p.z - radius + std::sqrt(square));
    }
    Striker ball;
    ball.shape = StrikerShape::Sphere;
    ball.point = {x, y, z}, ball.push = {0, 0, -1};
    ball.radius = radius;
    return ball;
}

StretchCount MetalBench::stretch(double most_stretch, double most_shortening) const {
    const MetalView metal = view();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) metal.vertices().place.set(metal.vertex(v), place(v));
    return count_stretch(metal, most_stretch, most_shortening);
}

uint32_t MetalBench::turned_triangles() const {
    const MetalView metal = view();
    uint32_t turned = 0;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& c = metal.corners(e);
        const auto normal = [&](auto at) {
            return cross(Vec3d(at(c[1])) - Vec3d(at(c[0])), Vec3d(at(c[2])) - Vec3d(at(c[0])));
        };
        turned +=
            dot(normal([&](uint32_t v) { return place(v); }), normal([&](uint32_t v) { return original(v); })) < 0;
    }
    return turned;
}

double MetalBench::lowest() const {
    double low = 1e30;
    for (uint32_t v = 0; v < view().vertex_count(); ++v) low = std::min(low, double{place(v).z});
    return low;
}

bool MetalBench::is_finite() const {
    for (uint32_t v = 0; v < view().vertex_count(); ++v) {
        const Vec3 p = place(v);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    }
    return true;
}

MidLine mid_line(const MetalBench& bench, uint32_t stations) {
    const MetalView metal = bench.view();
    double low = 1e30, high = -1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        low = std::min(low, double{bench.original(v).x}), high = std::max(high, double{bench.original(v).x});
    }
    MidLine line;
    for (uint32_t s = 0; s < stations; ++s) {
        const double x = low + (high - low) * s / (stations - 1);
        line.x.push_back(x);
        double least = 1e-6, depth = 0;  // the triangle over whose border the station lies least
        for (uint32_t e = 0; e < metal.element_count(); ++e) {
            const auto& c = metal.corners(e);
            const Vec3d p(bench.original(c[0])), q(bench.original(c[1])), r(bench.original(c[2]));
            if (std::max({p.x, q.x, r.x}) < x - 1e-9 || std::min({p.x, q.x, r.x}) > x + 1e-9) continue;
            const double area = (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
            if (area == 0) continue;
            const double b = ((x - p.x) * (r.y - p.y) - (r.x - p.x) * -p.y) / area,
                         g = ((q.x - p.x) * -p.y - (x - p.x) * (q.y - p.y)) / area, a = 1 - b - g;
            const double outside = std::max({0.0, -a, -b, -g});
            if (outside >= least) continue;
            least = outside;
            const auto down = [&](uint32_t v) { return double{bench.original(v).z} - double{bench.place(v).z}; };
            depth = a * down(c[0]) + b * down(c[1]) + g * down(c[2]);
            if (outside == 0) break;
        }
        line.depth.push_back(depth);
    }
    return line;
}

}  // namespace cullet
