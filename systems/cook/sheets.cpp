#include "systems/cook/sheets.hpp"
#include "systems/cook/disjoint_sets.hpp"

#include <algorithm>
#include <numeric>

namespace cullet {
namespace {

// Two triangles joined over the edge between positions low < high.
struct Joint {
    uint32_t low, high, first, second;
};

struct EdgeUse {
    uint32_t low, high, triangle;
    auto key() const { return std::array<uint32_t, 3>{low, high, triangle}; }
};

bool runs_forward(const Triangle& t, uint32_t low, uint32_t high) {
    return (t[0] == low && t[1] == high) || (t[1] == low && t[2] == high) || (t[2] == low && t[0] == high);
}

uint32_t edge_between(const Triangle& t, uint32_t a, uint32_t b) {
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t p = t[k], q = t[(k + 1) % 3];
        if ((p == a && q == b) || (p == b && q == a)) return k;
    }
    return 0;
}

void turn(CleanMesh& mesh, uint32_t t) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    std::swap(mesh.source_corners[t][1], mesh.source_corners[t][2]);
}

std::vector<EdgeUse> sorted_edges(const CleanMesh& mesh) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            uses.push_back({std::min(a, b), std::max(a, b), t});
        }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.key() < b.key(); });
    return uses;
}

template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
    for (size_t first = 0, last = 0; first < uses.size(); first = last) {
        while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
        visit(first, last);
    }
}

// Joints of triangle t, in the order of the list given.
struct JointRing {
    std::vector<uint32_t> start, joint;
    JointRing(size_t triangle_count, const std::vector<Joint>& joints) : start(triangle_count + 1) {
        for (const Joint& j : joints) ++start[j.first + 1], ++start[j.second + 1];
        for (size_t t = 0; t < triangle_count; ++t) start[t + 1] += start[t];
        joint.resize(2 * joints.size());
        std::vector<uint32_t> next(start.begin(), start.end() - 1);
        for (uint32_t k = 0; k < joints.size(); ++k)
            joint[next[joints[k].first]++] = k, joint[next[joints[k].second]++] = k;
    }
};

// Turns triangles until neighbours over ordinary edges agree, to the winding most triangles of the patch had. A
// one-sided patch is left as it came and every triangle of it is marked.
std::vector<uint8_t> agree_on_winding(CleanMesh& mesh, const std::vector<Joint>& joints, SurfaceRepairs& repairs) {
    const uint32_t count = static_cast<uint32_t>(mesh.triangles.size());
    const JointRing ring(count, joints);
    std::vector<uint8_t> is_seen(count), is_turned(count), is_one_sided(count);
    std::vector<uint32_t> patch;
    for (uint32_t seed = 0; seed < count; ++seed) {
        if (is_seen[seed]) continue;
        patch.assign(1, seed);
        is_seen[seed] = 1;
        bool is_orientable = true;
        size_t turned = 0;
        for (size_t head = 0; head < patch.size(); ++head) {
            const uint32_t t = patch[head];
            turned += is_turned[t];
            for (uint32_t at = ring.start[t]; at < ring.start[t + 1]; ++at) {
                const Joint& j = joints[ring.joint[at]];
                const uint32_t other = j.first == t ? j.second : j.first;
                const bool same_way = runs_forward(mesh.triangles[t], j.low, j.high) ==
                                      runs_forward(mesh.triangles[other], j.low, j.high);
                const uint8_t wanted = static_cast<uint8_t>(is_turned[t] ^ (same_way ? 1 : 0));
                if (!is_seen[other]) {
                    is_seen[other] = 1;
                    is_turned[other] = wanted;
                    patch.push_back(other);
                } else if (is_turned[other] != wanted) {
                    is_orientable = false;
                }
            }
        }
        const uint8_t minority = 2 * turned > patch.size() ? 0 : 1;
        for (const uint32_t t : patch) {
            if (!is_orientable) {
                is_one_sided[t] = 1;
            } else if (is_turned[t] == minority) {
                turn(mesh, t);
                ++repairs.turned_triangles;
            }
        }
    }
    return is_one_sided;
}

// Angle of a direction (x, y) as a number that grows with it, 0 to 4: no arc tangent, same order.
double angle_rank(double x, double y) {
    const double s = std::fabs(x) + std::fabs(y);
    if (s == 0) return 0;
    const double t = y / s;
    return x < 0 ? 2 - t : y < 0 ? 4 + t : t;
}

// An edge in more than two triangles. Looking along it, material lies from a triangle that runs it backward,
// counter-clockwise, to the next that runs it forward; such neighbours are joined and leave the circle, until none is
// left to join.
void pair_by_angle(const CleanMesh& mesh, const EdgeUse* uses, size_t count, std::vector<Joint>& joints,
                   SurfaceRepairs& repairs) {
    struct Sheet {
        double rank;
        uint32_t triangle;
        bool is_forward;
    };
    const uint32_t low = uses[0].low, high = uses[0].high;
    const Vec3d axis = normalised(mesh.positions[high] - mesh.positions[low]);
    std::vector<Sheet> sheets;
    Vec3d x, y;
    for (size_t k = 0; k < count; ++k) {
        const Triangle& t = mesh.triangles[uses[k].triangle];
        const uint32_t opposite = t[0] + t[1] + t[2] - low - high;
        const Vec3d away = mesh.positions[opposite] - mesh.positions[low];
        const Vec3d side = away - dot(away, axis) * axis;
        if (k == 0) x = normalised(side), y = cross(axis, x);
        sheets.push_back({angle_rank(dot(side, x), dot(side, y)), uses[k].triangle, runs_forward(t, low, high)});
    }
    std::sort(sheets.begin(), sheets.end(), [](const Sheet& a, const Sheet& b) {
        return a.rank != b.rank ? a.rank < b.rank : a.triangle < b.triangle;
    });
    for (bool has_joined = true; has_joined && sheets.size() > 1;) {
        has_joined = false;
        for (size_t k = 0; k < sheets.size() && sheets.size() > 1; ++k) {
            const size_t next = (k + 1) % sheets.size();
            if (sheets[k].is_forward || !sheets[next].is_forward) continue;
            joints.push_back({low, high, sheets[k].triangle, sheets[next].triangle});
            sheets.erase(sheets.begin() + static_cast<ptrdiff_t>(std::max(k, next)));
            sheets.erase(sheets.begin() + static_cast<ptrdiff_t>(std::min(k, next)));
            has_joined = true;
            break;
        }
    }
    ++repairs.crowded_edges;
    repairs.loose_sheets += static_cast<uint32_t>(sheets.size());
}

void find_components(const CleanMesh& mesh, const std::vector<Joint>& joints, const std::vector<uint8_t>& is_one_sided,
                     Surface& surface) {
    const uint32_t count = static_cast<uint32_t>(mesh.triangles.size());
    DisjointSets sets(count);
    std::vector<uint8_t> joint_count(count);
    for (const Joint& j : joints) {
        sets.unite(j.first, j.second);
        ++joint_count[j.first], ++joint_count[j.second];
    }
    surface.component_of.assign(count, kNone);
    const Vec3d middle = 0.5 * (mesh.low + mesh.high);
    for (uint32_t t = 0; t < count; ++t) {
        const uint32_t root = sets.find(t);
        if (root == t) {
            surface.component_of[t] = static_cast<uint32_t>(surface.components.size());
            surface.components.push_back({t, 0, 0, true, true, false});
        }
        surface.component_of[t] = surface.component_of[root];
        SurfaceComponent& component = surface.components[surface.component_of[t]];
        ++component.triangle_count;
        component.is_closed = component.is_closed && joint_count[t] == 3;
        component.is_orientable = component.is_orientable && !is_one_sided[t];
        const Triangle& c = mesh.triangles[t];
        component.volume +=
            dot(mesh.positions[c[0]] - middle, cross(mesh.positions[c[1]] - middle, mesh.positions[c[2]] - middle)) / 6;
    }
    for (SurfaceComponent& component : surface.components) {
        if (!component.is_orientable) component.is_closed = false, ++surface.repairs.unorientable_components;
        if (!component.is_closed) component.volume = 0;
    }
}

// Whether p lies inside a closed component other than `self`: the ray from p in a direction no mesh is likely to follow
// crosses that one an odd number of times. One pass over the mesh for all of them.
bool is_inside_another(const CleanMesh& mesh, const Surface& surface, uint32_t self, Vec3d p) {
    const Vec3d ray(0.5377416, 0.6180339, 0.5733182);
    std::vector<uint8_t> is_odd(surface.components.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& c = mesh.triangles[t];
        const Vec3d a = mesh.positions[c[0]] - p, b = mesh.positions[c[1]] - p, d = mesh.positions[c[2]] - p;
        const double u = dot(ray, cross(a, b)), v = dot(ray, cross(b, d)), w = dot(ray, cross(d, a));
        if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
        const Vec3d normal = cross(b - a, d - a);
        if (dot(normal, a) / dot(normal, ray) > 0) is_odd[surface.component_of[t]] ^= 1;
    }
    for (uint32_t c = 0; c < is_odd.size(); ++c)
        if (c != self && is_odd[c] && surface.components[c].is_closed) return true;
    return false;
}

// A point just inside a component that is inside out: its normals point there. Not on the surface, where another body
// may touch.
Vec3d point_within(const CleanMesh& mesh, const SurfaceComponent& component) {
    const Triangle& t = mesh.triangles[component.first_triangle];
    const Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    return (1.0 / 3) * (a + b + c) + (1e-7 * mesh.diagonal) * normalised(cross(b - a, c - a));
}

// A closed component inside out is turned, unless it lies inside another closed one: then it is the wall of a cavity.
void turn_inside_out(CleanMesh& mesh, Surface& surface) {
    std::vector<uint8_t> is_turned(surface.components.size());
    for (uint32_t c = 0; c < surface.components.size(); ++c) {
        SurfaceComponent& component = surface.components[c];
        if (!component.is_closed || component.volume >= 0) continue;
        component.is_cavity = is_inside_another(mesh, surface, c, point_within(mesh, component));
        if (component.is_cavity) {
            ++surface.repairs.cavities;
            continue;
        }
        is_turned[c] = 1;
        component.volume = -component.volume;
        ++surface.repairs.turned_components;
    }
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (is_turned[surface.component_of[t]]) turn(mesh, t);
}

// A triangle whose corners run the other way round than in the mesh given.
uint32_t count_flipped(const CleanMesh& mesh) {
    uint32_t count = 0;
    for (const auto& corner : mesh.source_corners) count += (corner[1] + 3u - corner[0]) % 3 == 2;
    return count;
}

// Every triangle corner starts as a vertex of its own; corners are united across joints only. This one rule splits bow
// ties and crowded edges. Vertices are numbered by (position, lowest corner).
void unite_corners(const CleanMesh& mesh, const std::vector<Joint>& joints, Surface& surface) {
    const uint32_t corner_count = static_cast<uint32_t>(3 * mesh.triangles.size());
    DisjointSets sets(corner_count);
    surface.neighbours.assign(mesh.triangles.size(), {kNone, kNone, kNone});
    for (const Joint& j : joints) {
        const Triangle &a = mesh.triangles[j.first], &b = mesh.triangles[j.second];
        surface.neighbours[j.first][edge_between(a, j.low, j.high)] = j.second;
        surface.neighbours[j.second][edge_between(b, j.low, j.high)] = j.first;
        for (uint32_t k = 0; k < 3; ++k)
            for (uint32_t l = 0; l < 3; ++l)
                if (a[k] == b[l] && (a[k] == j.low || a[k] == j.high)) sets.unite(3 * j.first + k, 3 * j.second + l);
    }
    std::vector<std::array<uint32_t, 2>> roots;  // position, corner
    for (uint32_t c = 0; c < corner_count; ++c)
        if (sets.find(c) == c) roots.push_back({mesh.triangles[c / 3][c % 3], c});
    std::sort(roots.begin(), roots.end());
    std::vector<uint32_t> vertex_of(corner_count);
    surface.positions.reserve(roots.size());
    surface.position_ids.reserve(roots.size());
    for (uint32_t v = 0; v < roots.size(); ++v) {
        vertex_of[roots[v][1]] = v;
        surface.positions.push_back(mesh.positions[roots[v][0]]);
        surface.position_ids.push_back(roots[v][0]);
    }
    surface.triangles.resize(mesh.triangles.size());
    for (uint32_t c = 0; c < corner_count; ++c) surface.triangles[c / 3][c % 3] = vertex_of[sets.find(c)];
    surface.position_count = static_cast<uint32_t>(mesh.positions.size());
    surface.repairs.split_vertices = static_cast<uint32_t>(roots.size() - mesh.positions.size());
}

// A vertex has one fan, so at most one border edge leaves it, and the edges chain into loops. On a one-sided component
// the chain may stop; the rest then starts a list of its own.
void find_borders(Surface& surface) {
    std::vector<BorderEdge> edges;
    std::vector<uint32_t> leaving(surface.positions.size(), kNone);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k)
            if (surface.neighbours[t][k] == kNone) {
                leaving[surface.triangles[t][k]] = static_cast<uint32_t>(edges.size());
                edges.push_back({t, k});
            }
    std::vector<uint8_t> is_listed(edges.size());
    for (uint32_t seed = 0; seed < edges.size(); ++seed) {
        if (is_listed[seed]) continue;
        surface.border_loops.push_back(static_cast<uint32_t>(surface.border_edges.size()));
        for (uint32_t e = seed; e != kNone && !is_listed[e];) {
            is_listed[e] = 1;
            surface.border_edges.push_back(edges[e]);
            e = leaving[surface.triangles[edges[e].triangle][(edges[e].edge + 1) % 3]];
        }
    }
    surface.border_loops.push_back(static_cast<uint32_t>(surface.border_edges.size()));
}

}  // namespace

void make_sheets(CleanMesh clean, Surface& surface) {
    const std::vector<EdgeUse> uses = sorted_edges(clean);
    std::vector<Joint> joints;
    for_each_edge(uses, [&](size_t first, size_t last) {
        if (last - first == 2)
            joints.push_back({uses[first].low, uses[first].high, uses[first].triangle, uses[first + 1].triangle});
    });
    const std::vector<uint8_t> is_one_sided = agree_on_winding(clean, joints, surface.repairs);
    for_each_edge(uses, [&](size_t first, size_t last) {
        if (last - first > 2) pair_by_angle(clean, &uses[first], last - first, joints, surface.repairs);
    });
    find_components(clean, joints, is_one_sided, surface);
    turn_inside_out(clean, surface);
    surface.repairs.flipped_triangles = count_flipped(clean);
    unite_corners(clean, joints, surface);
    surface.source_triangles = std::move(clean.source_triangles);
    surface.source_corners = std::move(clean.source_corners);
    surface.low = clean.low;
    surface.high = clean.high;
    surface.diagonal = clean.diagonal;
    find_borders(surface);
}

}  // namespace cullet
