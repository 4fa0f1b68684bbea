#include "systems/structures/shell/cook/certificates.hpp"

namespace cullet {
namespace {

using Float3 = std::array<float, 3>;

// Local coordinates: twenty times the rounding of a float projection.
constexpr float kFloatMargin = 5e-6f;
constexpr double kMargin = 1e-10;
constexpr double kLeastSide = 1e-7;

Float3 operator-(const Float3& a, const Float3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Float3 cross(const Float3& a, const Float3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
float dot(const Float3& a, const Float3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Float3 to_floats(Vec3d p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void range(const Unit& u, const Float3& axis, float& low, float& high) {
    std::array<float, 8> d;
    for (size_t k = 0; k < 8; ++k) d[k] = axis[0] * u.x[k] + axis[1] * u.y[k] + axis[2] * u.z[k];
    std::array<float, 4> least, most;
    for (size_t k = 0; k < 4; ++k) {
        least[k] = d[k] < d[k + 4] ? d[k] : d[k + 4];
        most[k] = d[k] > d[k + 4] ? d[k] : d[k + 4];
    }
    low = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
    high = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

bool separates(const Unit& a, const Unit& b, const Float3& axis) {
    float a_low, a_high, b_low, b_high;
    range(a, axis, a_low, a_high);
    range(b, axis, b_low, b_high);
    const float gap = std::max(b_low - a_high, a_low - b_high);
    return gap > 0 && gap * gap > kFloatMargin * kFloatMargin * dot(axis, axis);
}

void fill(Unit& u, const ExtrusionWork& work, size_t vertex_count) {
    std::array<Vec3d, 8> p;
    Vec3d sum, push;
    for (size_t k = 0; k < vertex_count; ++k) {
        const uint32_t v = u.vertex[k];
        p[2 * k] = work.points[v];
        p[2 * k + 1] = work.inner(v, work.caps[v]);
        sum += p[2 * k] + p[2 * k + 1];
        push += work.directions[v];
    }
    for (size_t k = 2 * vertex_count; k < 8; ++k) p[k] = p[k - 1];
    for (size_t k = 0; k < 8; ++k) {
        const Float3 f = to_floats(p[k]);
        u.x[k] = f[0], u.y[k] = f[1], u.z[k] = f[2];
    }
    u.centre = to_floats((0.5 / static_cast<double>(vertex_count)) * sum);
    u.push = to_floats(push);
    u.vertex_count = static_cast<uint8_t>(vertex_count);
}

Float3 outer_point(const Unit& u, size_t k) {
    return {u.x[2 * k], u.y[2 * k], u.z[2 * k]};
}

}  // namespace

Unit make_element(const ExtrusionWork& work, uint32_t t) {
    Unit u{};
    u.vertex = work.surface.triangles[t];
    u.triangle = t;
    u.normal = to_floats(work.normals[t]);
    fill(u, work, 3);
    return u;
}

Unit make_rim(const ExtrusionWork& work, const BorderEdge& border) {
    Unit u{};
    const Triangle& c = work.surface.triangles[border.triangle];
    const uint32_t a = c[border.edge], b = c[(border.edge + 1) % 3];
    u.vertex = {a, b, b};
    u.triangle = border.triangle;
    fill(u, work, 2);
    u.normal = cross(to_floats(work.points[b] - work.points[a]), u.push);
    return u;
}

bool are_hulls_apart(const Unit& a, const Unit& b) {
    const Float3 between = b.centre - a.centre;
    const Float3 push{a.push[0] + b.push[0], a.push[1] + b.push[1], a.push[2] + b.push[2]};
    const float push2 = dot(push, push);
    if (push2 > 0) {
        const float s = dot(between, push) / push2;
        if (separates(a, b, {between[0] - s * push[0], between[1] - s * push[1], between[2] - s * push[2]}))
            return true;
    }
    if (separates(a, b, between) || separates(a, b, a.normal) || separates(a, b, b.normal)) return true;
    for (const Unit* u : {&a, &b}) {
        const size_t edges = u->vertex_count == 3 ? 3 : 1;
        for (size_t k = 0; k < edges; ++k)
            if (separates(a, b, cross(outer_point(*u, (k + 1) % 3) - outer_point(*u, k), u->push))) return true;
    }
    return false;
}

bool are_split_at(const ExtrusionWork& work, const Unit& a, const Unit& b, uint32_t shared) {
    const Vec3d m = work.directions[shared], origin = work.points[shared];
    const Vec3d helper = std::fabs(m.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d x = cross(m, helper), y = cross(m, x);  // of one length, 0.6 to 1
    // Looking along the segment: is there a line with a's points on one side and b's on the other? There is when a's
    // points and the mirrored points of b fit into less than half a turn; grow the sector [low, high] that holds them.
    struct Side {
        double x, y;
    };
    std::array<Side, 8> sides;
    size_t count = 0;
    for (const Unit* u : {&a, &b}) {
        const double sign = u == &a ? 1 : -1;
        for (size_t k = 0; k < u->vertex_count; ++k) {
            const uint32_t v = u->vertex[k];
            if (v == shared) continue;
            for (const Vec3d p : {work.points[v] - origin, work.inner(v, work.caps[v]) - origin}) {
                const Side side{sign * dot(p, x), sign * dot(p, y)};
                if (side.x * side.x + side.y * side.y < kLeastSide * kLeastSide) return false;
                sides[count++] = side;
            }
        }
    }
    Side low = sides[0], high = sides[0];
    const auto turn = [](Side p, Side q) { return p.x * q.y - p.y * q.x; };
    for (size_t k = 1; k < count; ++k) {
        const bool is_right_of_low = turn(low, sides[k])<0, is_left_of_high = turn(high, sides[k])> 0;
        if (is_right_of_low && is_left_of_high) return false;
        if (is_right_of_low) low = sides[k];
        if (is_left_of_high) high = sides[k];
    }
    // Less than half a turn by 1e-6 at least: the bisector then has every side in front of it by more than rounding.
    const double cosine = low.x * high.x + low.y * high.y, sine = turn(low, high);
    const double low2 = low.x * low.x + low.y * low.y, high2 = high.x * high.x + high.y * high.y;
    return cosine > 0 || (sine > 0 && sine * sine > 1e-12 * low2 * high2);
}

bool stays_below(const ExtrusionWork& work, uint32_t i, uint32_t j) {
    const Triangle &ci = work.surface.triangles[i], &cj = work.surface.triangles[j];
    const auto& ids = work.surface.position_ids;
    const Vec3d nj = work.normals[j], pj = work.points[cj[0]];
    bool is_below = true;
    for (const uint32_t v : ci) {
        const bool is_shared = ids[v] == ids[cj[0]] || ids[v] == ids[cj[1]] || ids[v] == ids[cj[2]];
        const double slope = dot(work.directions[v], nj), height = is_shared ? -1 : dot(work.points[v] - pj, nj);
        if (is_shared ? slope >= -1e-6 : height >= -kMargin || height + work.caps[v] * slope >= -kMargin) {
            is_below = false;
            break;
        }
    }
    if (is_below) return true;
    const Vec3d ni = work.normals[i], pi = work.points[ci[0]];
    for (const uint32_t v : cj)
        if (dot(work.points[v] - pi, ni) < -1e-13) return false;
    for (const uint32_t v : ci)
        if (work.is_frozen[v] || dot(work.directions[v], ni) >= -1e-6) return false;
    return true;
}

}  // namespace cullet
