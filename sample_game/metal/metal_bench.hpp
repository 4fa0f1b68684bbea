// Metal without a game: one cooked shell in rows of its own, struck blow by blow. What truth, tests and pictures of
// dents are made with.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "components/workbench.hpp"
#include "cullet/model.hpp"
#include "engine/mesh.hpp"
#include "systems/models/metal_shell/cook/metal_rows.hpp"
#include "systems/models/metal_shell/dent/dent.hpp"
#include "systems/models/metal_shell/dent/limit_stretch.hpp"

namespace cullet {

/// A sheet in the x-y plane round the origin that faces +z; its triangles alternate, so it is symmetric in x and y
/// where columns and rows are even.
Mesh metal_sheet(double width, double height, uint32_t columns, uint32_t rows);

/// Cooks as metal_shell; splits edges longer than this, m.
Result<Model> cook_metal_mesh(const Mesh& mesh, const std::string& material, double thickness,
                              double longest_edge = 1e4);

class MetalBench {
 public:
    /// `settings`: null: as the model was cooked.
    explicit MetalBench(const Model& model, const MetalCookSettings* settings = nullptr);

    MetalView view() const { return {*rows_, shell_}; }
    Workbench& rows() { return *rows_; }
    Row<Structures> shell() const { return shell_; }

    /// Holds the vertices for which this is true, from now on.
    void hold(const std::function<bool(Vec3)>& is_held);
    /// The border of the box of the sheet, in x and y.
    void clamp();
    /// Of the material, Pa.
    void set_yield(double stress);
    void set_crush_pressure(double pressure);

    /// Its shape is the dented one afterwards.
    Dent hit(const Striker& striker, double energy);
    /// A ball along -z over (x, y), from where it first touches the sheet.
    Striker ball_over(double x, double y, double radius) const;

    Vec3 place(uint32_t v) const { return rows_->vertices.rest[view().shell.vertex(v)]; }
    Vec3 original(uint32_t v) const { return rows_->metal_vertices.original[view().vertex(v)]; }
    /// As the shape is now.
    StretchCount stretch(double most_stretch, double most_shortening) const;
    /// Triangles whose normal is more than a right angle off that of the original shape.
    uint32_t turned_triangles() const;
    double lowest() const;  // z
    bool is_finite() const;

 private:
    std::unique_ptr<Workbench> rows_;
    Row<Structures> shell_;
};

/// How deep the sheet is dented at `stations` places along y = 0, from one end of its original span to the other, m:
/// positive along -z.
struct MidLine {
    std::vector<double> x, depth;
};
MidLine mid_line(const MetalBench& bench, uint32_t stations);

}  // namespace cullet
