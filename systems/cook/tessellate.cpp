#include "systems/cook/tessellate.hpp"

#include <algorithm>
#include <map>
#include <queue>

#include "engine/math.hpp"

namespace cullet {
namespace {

bool comes_before(Vec3 a, Vec3 b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

// Ends are places: the lowest vertex of those at one position, the end that comes first in (x, y, z) first.
struct Edge {
    uint32_t a, b;
    bool operator<(const Edge& e) const { return a != e.a ? a < e.a : b < e.b; }
};

class Tessellator {
 public:
    Tessellator(const Mesh& mesh, const TessellationSettings& settings)
        : mesh_(mesh),
          settings_(settings),
          limit_(settings.longest_edge * settings.longest_edge),
          queue_(Shorter{this}) {
        find_places();
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) list_edges(t);
        for (const auto& [edge, triangles] : triangles_of_) offer(edge);
    }

    Result<Mesh> run() {
        while (!queue_.empty()) {
            const Edge edge = queue_.top();
            queue_.pop();
            const auto found = triangles_of_.find(edge);
            if (found == triangles_of_.end()) continue;
            if (mesh_.triangles.size() + found->second.size() > settings_.most_triangles)
                return Error{"tessellate: edges of at most " + std::to_string(settings_.longest_edge) +
                             " m would make mesh \"" + mesh_.name + "\" larger than " +
                             std::to_string(settings_.most_triangles) + " triangles; raise longest_edge (--edge-m)."};
            split(edge, found->second);
        }
        return std::move(mesh_);
    }

 private:
    // A queue of edges, longest on top. Distinct edges have distinct ends, so there are no ties.
    struct Shorter {
        const Tessellator* owner;
        bool operator()(const Edge& p, const Edge& q) const {
            const double lp = owner->length_squared(p), lq = owner->length_squared(q);
            if (lp != lq) return lp < lq;
            const auto& at = owner->mesh_.positions;
            if (p.a != q.a) return comes_before(at[q.a], at[p.a]);
            return p.b != q.b && comes_before(at[q.b], at[p.b]);
        }
    };

    double length_squared(const Edge& e) const {
        const Vec3d d = Vec3d(mesh_.positions[e.b]) - Vec3d(mesh_.positions[e.a]);
        return dot(d, d);
    }

    void find_places() {
        std::vector<uint32_t> order(mesh_.positions.size());
        for (uint32_t v = 0; v < order.size(); ++v) order[v] = v;
        const auto& at = mesh_.positions;
        std::sort(order.begin(), order.end(), [&](uint32_t v, uint32_t w) {
            return comes_before(at[v], at[w]) || (!comes_before(at[w], at[v]) && v < w);
        });
        place_.resize(order.size());
        for (size_t k = 0; k < order.size(); ++k)
            place_[order[k]] = k > 0 && at[order[k]] == at[order[k - 1]] ? place_[order[k - 1]] : order[k];
    }

    Edge edge_between(uint32_t v, uint32_t w) const {
        const uint32_t a = place_[v], b = place_[w];
        return comes_before(mesh_.positions[a], mesh_.positions[b]) ? Edge{a, b} : Edge{b, a};
    }

    void list_edges(uint32_t t) {
        for (size_t k = 0; k < 3; ++k) {
            const Edge e = edge_between(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
            std::vector<uint32_t>& list = triangles_of_[e];
            if (e.a != e.b && std::find(list.begin(), list.end(), t) == list.end()) list.push_back(t);
        }
    }

    void unlist_edges(uint32_t t) {
        for (size_t k = 0; k < 3; ++k) {
            const auto found = triangles_of_.find(edge_between(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]));
            if (found == triangles_of_.end()) continue;
            std::erase(found->second, t);
        }
    }

    void offer(const Edge& e) {
        if (length_squared(e) > limit_) queue_.push(e);
    }

    void split(const Edge& edge, std::vector<uint32_t> triangles) {
        const Vec3 a = mesh_.positions[edge.a], b = mesh_.positions[edge.b];
        const Vec3 middle = (0.5 * (Vec3d(a) + Vec3d(b))).to_float();
        if (middle == a || middle == b || triangles.empty()) return;
        const uint32_t vertex = static_cast<uint32_t>(mesh_.positions.size());
        mesh_.positions.push_back(middle);
        place_.push_back(vertex);
        std::sort(triangles.begin(), triangles.end());
        for (const uint32_t t : triangles) cut(t, edge, vertex);
        triangles_of_.erase(edge);
    }

    // Triangle t = (p, q, r) with p q the edge becomes (p, m, r) and the new (m, q, r).
    void cut(uint32_t t, const Edge& edge, uint32_t middle) {
        unlist_edges(t);
        const auto& c = mesh_.triangles[t];
        size_t k = 0;
        for (size_t at = 0; at < 3; ++at) {
            const Edge e = edge_between(c[at], c[(at + 1) % 3]);
            if (e.a == edge.a && e.b == edge.b) k = at;
        }
        const size_t next = (k + 1) % 3;
        const uint32_t born = static_cast<uint32_t>(mesh_.triangles.size());
        std::array<uint32_t, 3> far = mesh_.triangles[t];
        far[k] = middle;
        mesh_.triangles[t][next] = middle;
        mesh_.triangles.push_back(far);
        const auto interpolate = [&](auto& corners, auto mean) {
            if (corners.empty()) return;
            const auto half = mean(corners[3 * t + k], corners[3 * t + next]);
            for (size_t j = 0; j < 3; ++j) corners.push_back(corners[3 * t + j]);
            corners[3 * born + k] = half;
            corners[3 * t + next] = half;
        };
        interpolate(mesh_.corner_normals, [](Vec3 n, Vec3 m) {
            const Vec3 sum = normalised(n + m);
            return dot(sum, sum) > 0 ? sum : n;
        });
        interpolate(mesh_.corner_uvs, [](Vec2 p, Vec2 q) { return Vec2{0.5f * (p.x + q.x), 0.5f * (p.y + q.y)}; });
        if (!mesh_.materials.empty()) mesh_.materials.push_back(mesh_.materials[t]);
        for (const uint32_t made : {t, born}) {
            list_edges(made);
            for (size_t j = 0; j < 3; ++j) {
                const Edge e = edge_between(mesh_.triangles[made][j], mesh_.triangles[made][(j + 1) % 3]);
                if (e.a == middle || e.b == middle) offer(e);
            }
        }
    }

    Mesh mesh_;
    TessellationSettings settings_;
    double limit_;
    std::vector<uint32_t> place_;
    std::map<Edge, std::vector<uint32_t>> triangles_of_;
    std::priority_queue<Edge, std::vector<Edge>, Shorter> queue_;
};

}  // namespace

Result<Mesh> tessellate(const Mesh& mesh, const TessellationSettings& settings) {
    if (!(settings.longest_edge > 0) || !std::isfinite(settings.longest_edge))
        return Error{"tessellate: longest_edge " + std::to_string(settings.longest_edge) +
                     " m must be above 0 and finite; twice the thickness is usual."};
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return Error{"tessellate: position of vertex " + std::to_string(v) + " of mesh \"" + mesh.name +
                         "\" is not finite; repair or remove it."};
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const uint32_t v : mesh.triangles[t])
            if (v >= mesh.positions.size())
                return Error{"tessellate: triangle " + std::to_string(t) + " of mesh \"" + mesh.name +
                             "\" names vertex " + std::to_string(v) + " of " + std::to_string(mesh.positions.size()) +
                             "; repair the index list."};
    const size_t corners = 3 * mesh.triangles.size();
    if ((!mesh.corner_normals.empty() && mesh.corner_normals.size() != corners) ||
        (!mesh.corner_uvs.empty() && mesh.corner_uvs.size() != corners) ||
        (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()))
        return Error{"tessellate: corner attributes of mesh \"" + mesh.name + "\" do not match its " +
                     std::to_string(mesh.triangles.size()) +
                     " triangles; give three a triangle (materials: one), or none."};
    return Tessellator(mesh, settings).run();
}

}  // namespace cullet
