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
    const auto say = [&](uint32_t count, const char* before, const char* after) {
        if (count == 0) return;
        text += text.empty() ? "Surface: " : ", ";
        text += before + std::to_string(count) + after;
    };
    say(r.welded_vertices, "welded ", " vertices at the position of another");
    say(r.unused_vertices, "dropped ", " positions in no triangle");
    say(r.repeated_corner_triangles, "dropped ", " triangles with a repeated corner");
    say(r.zero_area_triangles, "dropped ", " triangles of no area");
    say(r.repeated_triangles, "dropped ", " repeated triangles");
    say(r.crowded_edges, "paired the sheets by angle at ", " edges of more than two triangles");
    say(r.loose_sheets, "left ", " sheets open there");
    say(r.turned_triangles, "turned ", " triangles to agree with their neighbours");
    say(r.turned_components, "turned ", " components that were inside out");
    say(r.cavities, "kept ", " components as walls of cavities");
    say(r.unorientable_components, "found ", " one-sided components (they get no depth)");
    say(r.split_vertices, "split off ", " vertices where several fans met");
    say(r.crossing_pairs, "found ",
        " pairs of triangles that cut or touch each other (never tested against each other)");
    say(r.independent_pairs, "took ", " pairs of components that meet as bodies of their own");
    text = text.empty() ? "Surface: nothing to repair" : text;
    if (r.is_mostly_border)
        text += "; most edges are borders, so prepare it with weld_tolerance 1e-7 if its positions are noisy";
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
    if (settings.searches_crossings) surface.crossings = find_crossings(surface);
    surface.independent = find_independent(surface);
    surface.repairs.crossing_pairs = static_cast<uint32_t>(surface.crossings.size());
    surface.repairs.independent_pairs = static_cast<uint32_t>(surface.independent.size() / 2);
    surface.repairs.is_mostly_border =
        surface.triangles.size() > 8 && 2 * surface.border_edges.size() > 3 * surface.triangles.size();
    return surface;
}

}  // namespace cullet
