#include "systems/structures/shell/cook/opposite_wall.hpp"

namespace cullet {
namespace {

constexpr double kFacesBack = 0.1;  // n_q . m above this: a wall that looks the other way, for which the ball is meant
constexpr float kRaySlack = 2e-6f;  // local units; float rounding of the ray's origin and of the mesh
constexpr size_t kMostHits = 64;

// n is the unit normal. Outside the triangle the nearest point lies on an edge that has p on its outer side.
Vec3d closest_on_triangle(const std::array<Vec3d, 3>& t, Vec3d n, Vec3d p) {
    Vec3d best;
    double least = 1e300;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d a = t[k], e = t[(k + 1) % 3] - a, w = p - a;
        if (dot(cross(n, e), w) >= 0) continue;
        const double along = std::clamp(dot(w, e) / dot(e, e), 0.0, 1.0);
        const Vec3d q = a + along * e;
        const double d = dot(p - q, p - q);
        if (d < least) least = d, best = q;
    }
    return least < 1e300 ? best : p - dot(p - t[0], n) * n;
}

// Distance along the unit ray to triangle t, or `far`. Borders count as hit.
double ray_distance(const std::array<Vec3d, 3>& t, Vec3d origin, Vec3d ray, double far) {
    const Vec3d a = t[0] - origin, b = t[1] - origin, c = t[2] - origin;
    const double u = dot(ray, cross(b, c)), v = dot(ray, cross(c, a)), w = dot(ray, cross(a, b));
    constexpr double kSlack = 1e-14;
    if (!((u >= -kSlack && v >= -kSlack && w >= -kSlack) || (u <= kSlack && v <= kSlack && w <= kSlack))) return far;
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double slope = dot(normal, ray);
    if (slope == 0) return far;
    const double d = dot(normal, a) / slope;
    return d > 0 && d < far ? d : far;
}

struct Floats {
    alignas(16) std::array<float, 4> lane;
    explicit Floats(Vec3d p) : lane{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0} {}
};

RayScene make_rays(const ExtrusionWork& work) {
    std::vector<Vec3> points;
    points.reserve(work.points.size());
    for (const Vec3d p : work.points) points.push_back(p.to_float());
    return RayScene(points, work.surface.triangles);
}

}  // namespace

OppositeWall::OppositeWall(const ExtrusionWork& work, const InnerSkin* skin)
    : work_(work), tree_(triangle_boxes(work.points, work.surface.triangles)), rays_(make_rays(work)), skin_(skin) {
    if (skin) {
        std::vector<Vec3> points;
        for (const Vec3d p : skin->positions) {
            skin_points_.push_back(work.frame(p));
            points.push_back(skin_points_.back().to_float());
        }
        skin_rays_.emplace(points, skin->triangles);
    }
    faces_.reserve(tree_.order.size());
    for (const uint32_t t : tree_.order) {
        const Triangle& c = work.surface.triangles[t];
        faces_.push_back({{work.points[c[0]], work.points[c[1]], work.points[c[2]]}, work.normals[t]});
    }
    normal_boxes_.resize(tree_.nodes.size());
    for (size_t n = tree_.nodes.size(); n-- > 0;) {
        const BoxTree::Node& node = tree_.nodes[n];
        if (node.is_leaf()) {
            for (uint32_t k = node.first(); k < node.first() + node.count(); ++k)
                normal_boxes_[n].grow(faces_[k].normal);
        } else {
            normal_boxes_[n] = normal_boxes_[n + 1];
            normal_boxes_[n].grow(normal_boxes_[node.right]);
        }
    }
}

// Triangles at the same position as v, and those of bodies that do not limit each other.
bool OppositeWall::is_excluded(uint32_t v, uint32_t triangle) const {
    const Surface& s = work_.surface;
    for (const uint32_t w : s.triangles[triangle])
        if (s.position_ids[w] == s.position_ids[v]) return true;
    return s.are_independent(s.component_of[triangle], work_.component_of_vertex[v]);
}

double OppositeWall::first_hit(uint32_t v, Vec3d m, double far) const {
    struct Context {
        const OppositeWall* wall;
        uint32_t vertex;
    } context{this, v};
    std::array<uint32_t, kMostHits> found;
    const auto ignore = [](uint32_t triangle, const void* pointer) {
        const auto* c = static_cast<const Context*>(pointer);
        return c->wall->is_excluded(c->vertex, triangle);
    };
    const size_t count = rays_.collect(work_.points[v].to_float(), m.to_float(), static_cast<float>(far), kRaySlack,
                                       ignore, &context, found);
    double distance = far;
    for (size_t k = 0; k < count; ++k) {
        const Triangle& c = work_.surface.triangles[found[k]];
        distance = std::min(distance, ray_distance({work_.points[c[0]], work_.points[c[1]], work_.points[c[2]]},
                                                   work_.points[v], m, far));
    }
    return distance;
}

double OppositeWall::way_to_skin(uint32_t v, Vec3d m, double far) const {
    std::array<uint32_t, kMostHits> found;
    const auto ignore = [](uint32_t, const void*) { return false; };
    const size_t count = skin_rays_->collect(work_.points[v].to_float(), m.to_float(), static_cast<float>(far),
                                             kRaySlack, ignore, nullptr, found);
    double distance = far;
    for (size_t k = 0; k < count; ++k) {
        const Triangle& c = skin_->triangles[found[k]];
        distance = std::min(distance, ray_distance({skin_points_[c[0]], skin_points_[c[1]], skin_points_[c[2]]},
                                                   work_.points[v], m, far));
    }
    return distance;
}

// Radius of the largest ball through v with centre v + r m that no admissible surface point lies in: the minimum over
// those q of |q - v|^2 / (2 (q - v) . m).
double OppositeWall::ball_radius(uint32_t v, Vec3d m, double r) const {
    const Vec3d origin = work_.points[v];
    const Floats mf(m);
    Floats centre(origin + r * m);
    float reach = static_cast<float>(r * r * (1 + 1e-5));
    const auto can_limit = [&](uint32_t n) {
        const TreeBox& b = normal_boxes_[n];
        float most = 0;
        for (size_t k = 0; k < 3; ++k) most += std::max(mf.lane[k] * b.low[k], mf.lane[k] * b.high[k]);
        return most > 0.09999f;
    };
    struct Waiting {
        uint32_t node;
        float distance;
    };
    std::array<Waiting, 64> stack;
    size_t height = 0;
    if (can_limit(0)) stack[height++] = {0, 0};
    while (height > 0) {
        const Waiting top = stack[--height];
        const BoxTree::Node& node = tree_.nodes[top.node];
        // The ball shrinks inside its former self, so an old distance to the centre proves nothing: measure again.
        if (node.box.distance_squared(centre.lane) >= reach) continue;
        if (!node.is_leaf()) {
            const uint32_t left = top.node + 1, right = node.right;
            Waiting a{left, tree_.nodes[left].box.distance_squared(centre.lane)};
            Waiting b{right, tree_.nodes[right].box.distance_squared(centre.lane)};
            if (b.distance < a.distance) std::swap(a, b);
            if (b.distance < reach && can_limit(b.node)) stack[height++] = b;
            if (a.distance < reach && can_limit(a.node)) stack[height++] = a;
            continue;
        }
        for (uint32_t k = node.first(); k < node.first() + node.count(); ++k) {
            const Face& f = faces_[k];
            if (dot(f.normal, m) <= kFacesBack) continue;
            if (std::fabs(dot(f.normal, origin + r * m - f.point[0])) >= r) continue;
            bool is_checked = false;
            for (int again = 0; again < 4; ++again) {
                const Vec3d c = origin + r * m;
                const Vec3d q = closest_on_triangle(f.point, f.normal, c);
                const double limit = r * (1 - 1e-6), ahead = dot(q - origin, m);
                if (dot(q - c, q - c) >= limit * limit || ahead <= 0) break;
                if (!is_checked && is_excluded(v, tree_.order[k])) break;
                is_checked = true;
                r = dot(q - origin, q - origin) / (2 * ahead);
            }
            if (!is_checked) continue;
            centre = Floats(origin + r * m);
            reach = static_cast<float>(r * r * (1 + 1e-5));
        }
    }
    return r;
}

double OppositeWall::cap(uint32_t v, Vec3d m, double wanted) const {
    const double by_ray = std::min(wanted, 0.49 * first_hit(v, m, 2.05 * wanted));
    return std::min(by_ray, 0.98 * ball_radius(v, m, by_ray / 0.98));
}

double OppositeWall::distance(Vec3d p, double most) const {
    double least = most * most;
    const Floats at(p);
    std::array<uint32_t, 64> stack;
    size_t height = 0;
    stack[height++] = 0;
    while (height > 0) {
        const uint32_t n = stack[--height];
        const BoxTree::Node& node = tree_.nodes[n];
        if (static_cast<double>(node.box.distance_squared(at.lane)) >= least * (1 + 1e-5)) continue;
        if (!node.is_leaf()) {
            const bool is_left_nearer = tree_.nodes[n + 1].box.distance_squared(at.lane) <=
                                        tree_.nodes[node.right].box.distance_squared(at.lane);
            stack[height++] = is_left_nearer ? node.right : n + 1;
            stack[height++] = is_left_nearer ? n + 1 : node.right;
            continue;
        }
        for (uint32_t k = node.first(); k < node.first() + node.count(); ++k) {
            const Vec3d q = closest_on_triangle(faces_[k].point, faces_[k].normal, p);
            least = std::min(least, dot(q - p, q - p));
        }
    }
    return std::sqrt(least);
}

}  // namespace cullet
