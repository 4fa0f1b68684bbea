#include "systems/structures/tetrahedra/cook/mesh_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "engine/table.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostRestarts = 40;
constexpr uint32_t kLatticeAlone = 6;  // restarts that shift points of the lattice alone
constexpr double kGridError = 128;  // units of the grid: more than shifts of points make, along any edge but a flat one

List<uint8_t> known_points(const CutRequest& request) {
    if (request.known) return {request.is_known.begin(), request.is_known.end()};
    List<uint8_t> is_known(request.lattice.points.size());
    for (const LatticeFace& face : request.faces.faces)
        if (face.tetrahedron[1] == kNone)
            for (const uint32_t p : face.corner) is_known[p] = 1;
    return is_known;
}

void sort_once(List<uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Points of the lattice first. A triangle that has no area on the grid, and what stays in a plane, moves itself.
void shift(const ClosedMesh& mesh, Undecided& undecided, uint32_t restarts, GridPoints& points,
           List<uint8_t>& is_known) {
    for (const uint32_t t : undecided.flat_triangles)
        for (const uint32_t v : mesh.triangles[t]) undecided.mesh_points.push_back(v);
    if (restarts <= kLatticeAlone && undecided.flat_triangles.empty()) undecided.mesh_points.clear();
    sort_once(undecided.lattice_points);
    sort_once(undecided.mesh_points);
    for (const uint32_t p : undecided.lattice_points) {
        points.shift_lattice(p);
        is_known[p] = 0;
    }
    for (const uint32_t v : undecided.mesh_points) points.shift_mesh(v);
}

// Where a triangle's plane as it is drawn goes through an edge: points of one triangle then lie in one plane, and
// volumes add up to what it encloses. The grid's word where they differ: slivers have no plane worth the name.
double ratio_on_edge(const ClosedMesh& mesh, const Triangle& t, Vec3d u, Vec3d w, double on_grid, double units) {
    const Vec3d p = mesh.positions[t[0]], normal = cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p);
    const double low = dot(normal, u - p), high = dot(normal, w - p), ratio = low / (low - high);
    return ratio >= 0 && ratio <= 1 && units * std::fabs(ratio - on_grid) < kGridError ? ratio : on_grid;
}

}  // namespace

void find_places(const CutRequest& request, const GridPoints& points, Cut& cut) {
    const std::span<const Vec3d> lattice =
        request.points.empty() ? std::span<const Vec3d>(request.lattice.points) : request.points;
    const auto between = [](Vec3d a, Vec3d b, double low, double high) { return a + low / (low - high) * (b - a); };
    cut.places.resize(cut.keys.size());
    for (size_t i = 0; i < cut.keys.size(); ++i) {
        const CutKey key = cut.keys[i];
        switch (key.kind()) {
            case CutKeyKind::MeshVertex:
                cut.places[i] = request.mesh.positions[key.a()];
                break;
            case CutKeyKind::LatticePoint:
                cut.places[i] = lattice[key.a()];
                break;
            case CutKeyKind::OnPair: {
                const auto [a, b] = request.mesh.pairs[key.a()];
                const auto& c = request.faces.faces[key.b()].corner;
                const GridPoint &p = points.lattice[c[0]], &q = points.lattice[c[1]], &r = points.lattice[c[2]];
                cut.places[i] = between(request.mesh.positions[a], request.mesh.positions[b],
                                        determinant(p, q, r, points.mesh[a]), determinant(p, q, r, points.mesh[b]));
                break;
            }
            case CutKeyKind::OnTriangle: {
                const auto [u, w] = request.faces.edges[key.b()];
                const Triangle& t = request.mesh.triangles[key.a()];
                const GridPoint &p = points.mesh[t[0]], &q = points.mesh[t[1]], &r = points.mesh[t[2]];
                const double low = determinant(p, q, r, points.lattice[u]),
                             high = determinant(p, q, r, points.lattice[w]);
                const GridPoint &from = points.lattice[u], &to = points.lattice[w];
                const double units =
                    std::max({std::fabs(to.x - from.x), std::fabs(to.y - from.y), std::fabs(to.z - from.z)});
                cut.places[i] =
                    lattice[u] + ratio_on_edge(request.mesh, t, lattice[u], lattice[w], low / (low - high), units) *
                                     (lattice[w] - lattice[u]);
                break;
            }
        }
    }
}

MeshCutter::MeshCutter(const CutRequest& request)
    : request_(request),
      points_(request.mesh.positions,
              request.points.empty() ? std::span<const Vec3d>(request.lattice.points) : request.points,
              0.5 * (request.mesh.low + request.mesh.high)),
      is_known_(known_points(request)),
      count_(request.triangles.empty() ? request.mesh.triangles.size() : request.triangles.size()) {
    begin();
}

void MeshCutter::begin() {
    next_ = 0;
    of_triangles_ = {};
    of_triangles_.tetrahedron_of.assign(request_.mesh.positions.size(), kNone);
    cutter_.emplace(request_, points_, of_triangles_);
}

bool MeshCutter::advance(size_t polygons) {
    if (is_joining()) {
        polygons_made_ = of_triangles_.polygons.size();
        join();
        return true;
    }
    const bool are_all = request_.triangles.empty();
    size_t triangles = 0;
    const size_t before = of_triangles_.polygons.size();
    while (of_triangles_.polygons.size() - before < polygons && triangles < polygons && !is_joining()) {
        if (cutter_->is_done())
            cutter_->begin(are_all ? static_cast<uint32_t>(next_) : request_.triangles[next_]), ++next_, ++triangles;
        else
            cutter_->go_on();
    }
    polygons_made_ = of_triangles_.polygons.size() - before;
    if (!is_joining()) return false;
    Undecided& undecided = of_triangles_.undecided;
    if (!undecided.is_empty()) {
        if (cut_.restarts == kMostRestarts) {
            error_ = "triangle " + std::to_string(undecided.triangle) + " stays in a plane of the lattice after " +
                     std::to_string(kMostRestarts) + " tries to move it out; remove it";
            return true;
        }
        ++cut_.restarts;
        shift(request_.mesh, undecided, cut_.restarts, points_, is_known_);
        begin();
        return false;
    }
    if (of_triangles_.uncovered == kNone) return false;
    error_ = "triangle " + std::to_string(of_triangles_.uncovered) + " reaches out of the lattice";
    return true;
}

void MeshCutter::join() {
    cut_.polygons = std::move(of_triangles_.polygons);
    cut_.keys = std::move(of_triangles_.keys);
    cut_.piercings = std::move(of_triangles_.piercings);
    cut_.tetrahedron_of = std::move(of_triangles_.tetrahedron_of);
    sort_piercings(request_, points_, cut_);
    if (!find_windings(request_, is_known_, cut_))
        error_ = "faces are wanted that no known point is joined to";
    else if (request_.known && !are_consistent(request_, cut_))
        error_ = "what was known of a point is not so on this grid";
    if (!error_.empty()) return;
    find_loops(request_, of_triangles_.segments, cut_);
    find_places(request_, points_, cut_);
}

Result<Cut> MeshCutter::take() {
    if (!error_.empty()) return Error{error_};
    return std::move(cut_);
}

Result<Cut> cut_mesh(const CutRequest& request) {
    MeshCutter cutter(request);
    while (!cutter.advance(~size_t{0})) {
    }
    return cutter.take();
}

}  // namespace cullet
