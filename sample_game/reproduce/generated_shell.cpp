#include "sample_game/reproduce/generated_shell.hpp"

#include <time.h>

#include <algorithm>
#include <set>

#include "engine/fp_mode.hpp"
#include "engine/jobs.hpp"
#include "sample_game/palette.hpp"
#include "systems/cook/crossings.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"

namespace cullet::reproduce {
namespace {

/// Of the processor and not of the wall's clock: other programs do not count.
double milliseconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

size_t count_inverted(const Surface& s, const Extrusion& extrusion, std::span<const Vec3d> inner) {
    size_t inverted = 0;
    for (const Triangle& t : s.triangles) {
        const PrismTetrahedra cut = prism_tetrahedra({s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]},
                                                     {inner[t[0]], inner[t[1]], inner[t[2]]}, {t[0], t[1], t[2]});
        bool is_bad = false;
        for (size_t k = 0; k < 3; ++k)
            is_bad = is_bad || (!(cut.volume[k] > 0) && extrusion.depth[t[cut.flattens[k]]] > 0);
        inverted += is_bad;
    }
    return inverted;
}

double mean_depth(const Surface& s, const Extrusion& extrusion) {
    double area = 0, depth = 0;
    for (const Triangle& t : s.triangles) {
        const double a = length(cross(s.positions[t[1]] - s.positions[t[0]], s.positions[t[2]] - s.positions[t[0]]));
        area += a;
        depth += a * (extrusion.depth[t[0]] + extrusion.depth[t[1]] + extrusion.depth[t[2]]) / 3;
    }
    return depth / area;
}

/// A wire along each edge: three-sided, a little outside of the surface.
Mesh wires_of(const Surface& s, float radius) {
    Mesh wires;
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const Triangle& t : s.triangles)
        for (size_t c = 0; c < 3; ++c) edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
    for (const auto& [a, b] : edges) {
        const Vec3d p = s.positions[a], q = s.positions[b], along = normalised(q - p);
        const Vec3d aside = std::abs(along.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
        const Vec3d u = normalised(cross(along, aside)), w = cross(along, u);
        const auto first = static_cast<uint32_t>(wires.positions.size());
        constexpr double kCorner[3][2] = {{1, 0}, {-0.5, 0.8660254}, {-0.5, -0.8660254}};
        for (const Vec3d end : {p, q})
            for (const auto& corner : kCorner)
                wires.positions.push_back(
                    (end + static_cast<double>(radius) * (corner[0] * u + corner[1] * w)).to_float());
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t n = (k + 1) % 3;
            wires.triangles.push_back({first + k, first + n, first + 3 + k});
            wires.triangles.push_back({first + n, first + 3 + n, first + 3 + k});
        }
    }
    return wires;
}

struct DrawnShell {
    std::vector<Vec3> points, normals;
    std::vector<uint32_t> indices;
    DrawnBody body;

    DrawnShell(std::span<const Vec3d> positions, std::span<const Triangle> triangles, bool is_smooth) {
        for (const Vec3d p : positions) points.push_back(p.to_float());
        if (is_smooth) normals.resize(points.size());
        for (const Triangle& t : triangles) {
            indices.insert(indices.end(), t.begin(), t.end());
            const Vec3 normal = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
            if (is_smooth)
                for (const uint32_t v : t) normals[v] += normal;
        }
        for (Vec3& n : normals)
            if (dot(n, n) > 0) n = normalised(n);
        body.positions = points, body.normals = normals, body.indices = indices;
    }
};

}  // namespace

std::span<const PropagationMode> propagation_modes() {
    static constexpr PropagationMode modes[] = {
        {"single vertex", [](ExtrusionSettings& s) { s.propagation = Propagation::SingleVertex; }},
        {"front", [](ExtrusionSettings& s) { s.propagation = Propagation::Front; }},
        {"single vertex + tetrahedra", [](ExtrusionSettings& s) { s.propagation = Propagation::SingleVertexTets; }},
        {"guarded front", [](ExtrusionSettings& s) { s.propagation = Propagation::GuardedFront; }},
    };
    return modes;
}

std::vector<Vec3d> inner_positions(const Surface& surface, const Extrusion& extrusion) {
    std::vector<Vec3d> inner;
    for (size_t v = 0; v < surface.positions.size(); ++v)
        inner.push_back(surface.positions[v] + extrusion.depth[v] * extrusion.direction[v]);
    return inner;
}

Mesh both_surfaces(const Surface& surface, std::span<const Vec3d> inner) {
    Mesh both;
    const auto count = static_cast<uint32_t>(inner.size());
    for (const Vec3d p : surface.positions) both.positions.push_back(p.to_float());
    for (const Vec3d p : inner) both.positions.push_back(p.to_float());
    both.triangles.assign(surface.triangles.begin(), surface.triangles.end());
    for (const Triangle& t : surface.triangles) both.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
    return both;
}

ExtrusionSettings settings_of(const PropagationMode& mode) {
    ExtrusionSettings settings;
    mode.choose(settings);
    return settings;
}

Result<GeneratedShell> generate(const Surface& surface, double thickness, const ExtrusionSettings& settings,
                                uint32_t rounds) {
    const FpMode fp;
    GeneratedShell shell;
    shell.ms = 1e300;
    std::string refusal;
    for (uint32_t round = 0; round < rounds && refusal.empty(); ++round)
        shell.ms = std::min(shell.ms, milliseconds([&] {
                                (void)find_crossings(surface);
                                Result<Extrusion> extrusion = extrude(surface, thickness, settings);
                                if (!extrusion.ok())
                                    refusal = extrusion.error();
                                else
                                    shell.extrusion = std::move(extrusion).value();
                            }));
    if (!refusal.empty()) return Error{refusal};
    const std::vector<Vec3d> inner = inner_positions(surface, shell.extrusion);
    const Result<Surface> both = prepare_surface(both_surfaces(surface, inner));
    if (!both.ok()) return Error{both.error()};
    shell.crossings = both->crossings.size();
    shell.inverted = count_inverted(surface, shell.extrusion, inner);
    shell.mean_depth = mean_depth(surface, shell.extrusion) / thickness;
    return shell;
}

Picture draw_shell(const Surface& surface, std::span<const Vec3d> inner, const Camera& camera, uint32_t width,
                   uint32_t threads, float wire_radius, std::span<const uint8_t> marked) {
    std::vector<Triangle> plain, yellow;
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        (!marked.empty() && marked[t] ? yellow : plain).push_back(surface.triangles[t]);
    const DrawnShell skin(inner, plain, true), met(inner, yellow, true);
    const Mesh wires = wires_of(surface, wire_radius);
    std::vector<Vec3d> wire_points;
    for (const Vec3 p : wires.positions) wire_points.push_back(Vec3d(p));
    const DrawnShell wire(wire_points, wires.triangles, false);
    std::vector<DrawnBody> bodies{skin.body, wire.body, met.body};
    bodies[0].colour = linear_from_srgb(196, 44, 38);
    bodies[0].is_outlined = false;
    bodies[1].colour = linear_from_srgb(250, 250, 246);
    bodies[1].gloss = 0;
    bodies[1].is_outlined = false;
    bodies[2].colour = linear_from_srgb(250, 190, 30);
    bodies[2].is_outlined = false;
    PictureSettings settings;
    settings.width = width, settings.height = width * 9 / 16;
    settings.ambient_reach = 0.05f;
    const std::unique_ptr<JobSystem> jobs = make_jobs(JobBackend::Threads, threads);
    settings.for_each = [&jobs](uint32_t count, const std::function<void(uint32_t)>& job) {
        parallel_for(*jobs, count, [&job](uint32_t i) { job(i); });
    };
    return draw(bodies, camera, Sun{}, settings);
}

}  // namespace cullet::reproduce
