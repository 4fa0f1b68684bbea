#include "systems/cook/surface.hpp"

#include <algorithm>

#include "systems/cook/clean_mesh.hpp"
#include "systems/cook/crossings.hpp"
#include "systems/cook/sheets.hpp"

namespace cullet {

bool Surface::are_independent(uint32_t component_a, uint32_t component_b) const {
    return component_a != component_b && !independent.empty() &&
           std::binary_search(independent.begin(), independent.end(),
                              std::array<uint32_t, 2>{component_a, component_b});
}

bool SurfaceRepairs::is_clean() const {
    return welded_vertices + unused_vertices + repeated_corner_triangles + zero_area_triangles + repeated_triangles +
               crowded_edges + turned_triangles + turned_components + unorientable_components + split_vertices +
               crossing_pairs + independent_pairs ==
           0;
}

std::string describe(const SurfaceRepairs& r) {
    std::string text;
    const auto say = [&](const char* before, uint32_t count, const char* one, const char* many, const char* after) {
        if (count == 0) return;
        text += text.empty() ? "Surface: " : ", ";
        text += before + std::to_string(count) + " " + (count == 1 ? one : many) + after;
    };
    say("welded ", r.welded_vertices, "vertex", "vertices", " at the position of another");
    say("dropped ", r.unused_vertices, "position", "positions", " in no triangle");
    say("dropped ", r.repeated_corner_triangles, "triangle", "triangles", " with a repeated corner");
    say("dropped ", r.zero_area_triangles, "triangle", "triangles", " of no area");
    say("dropped ", r.repeated_triangles, "repeated triangle", "repeated triangles", "");
    say("flipped ", r.flipped_triangles, "triangle", "triangles", " so that neighbours agree and outsides are outside");
    say("turned ", r.turned_components, "inside-out part", "inside-out parts", "");
    say("kept ", r.cavities, "part", "parts", " as walls of cavities");
    say("found ", r.unorientable_components, "one-sided part", "one-sided parts", " (without depth)");
    say("split ", r.crowded_edges, "edge", "edges", " of more than two triangles into sheets paired by angle");
    say("left ", r.loose_sheets, "sheet", "sheets", " open there");
    say("split off ", r.split_vertices, "vertex", "vertices", " where several fans met");
    say("found ", r.crossing_pairs, "pair", "pairs",
        " of triangles that cut or touch each other (never tested against each other)");
    say("took ", r.independent_pairs, "pair", "pairs", " of parts that meet as bodies of their own");
    say("left ", r.open_borders, "border", "borders", " open");
    if (r.open_borders > 0)
        text += " (" + std::to_string(r.border_edges) + (r.border_edges == 1 ? " edge)" : " edges)");
    text = text.empty() ? "Surface: nothing to repair" : text;
    if (r.is_mostly_border)
        text += "; most edges are borders: cook it with weld_tolerance 1e-7 if its positions are noisy";
    return text + ".";
}

Result<Surface> prepare_surface(const Mesh& mesh, const SurfaceSettings& settings) {
    if (!(settings.weld_tolerance >= 0 && settings.weld_tolerance <= 0.01))
        return Error{"prepare_surface: weld_tolerance " + std::to_string(settings.weld_tolerance) +
                     " must be 0 to 0.01 of the diagonal; 1e-7 heals a soup with noise."};
    Surface surface;
    Result<CleanMesh> clean = clean_mesh(mesh, settings, surface.repairs);
    if (!clean) return Error{clean.error()};
    make_sheets(std::move(*clean), surface);
    if (settings.searches_crossings) {
        Result<std::vector<std::array<uint32_t, 2>>> crossings = find_crossings(surface);
        if (!crossings) return Error{crossings.error()};
        surface.crossings = std::move(crossings).value();
    }
    surface.independent = find_independent(surface);
    surface.repairs.crossing_pairs = static_cast<uint32_t>(surface.crossings.size());
    surface.repairs.independent_pairs = static_cast<uint32_t>(surface.independent.size() / 2);
    surface.repairs.open_borders = static_cast<uint32_t>(surface.border_loops.size() - 1);
    surface.repairs.border_edges = static_cast<uint32_t>(surface.border_edges.size());
    surface.repairs.is_mostly_border =
        surface.triangles.size() > 8 && 2 * surface.border_edges.size() > 3 * surface.triangles.size();
    return surface;
}

}  // namespace cullet
