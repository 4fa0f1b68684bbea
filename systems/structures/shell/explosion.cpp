#include "systems/structures/shell/explosion.hpp"

#include <algorithm>
#include <bit>

namespace cullet {
namespace {

Vec3 middle_of(Vec3 a, Vec3 b, Vec3 c) {
    return (1.0f / 3) * (a + b + c);
}

/// The nearest wall in each direction from the centre of an explosion: a picture of depths. From outside one square
/// looks at the body's bounds; from near or inside six faces of a cube look everywhere. Only the dots in which the
/// middle of an element in reach lies are ever looked up, so only those are drawn: of most shards twenty among 6,144.
class Shade {
 public:
    Shade(ShellView shell, const Explosion& explosion) : shell_(shell), from_(explosion.centre) {
        look_at_bounds();
        for (uint32_t e = 0; e < shell.element_count(); ++e)
            if (!(shell.state.elements.flags[shell.element(e)] & kDead)) want(e, explosion.radius);
        for (uint32_t e = 0; e < shell.element_count(); ++e)
            if (!(shell.state.elements.flags[shell.element(e)] & kDead)) draw(e, explosion.radius);
    }
    /// Whether the wall at `away` from the centre, seen under this cosine, is the nearest there is. A wall seen at a
    /// slant spans depths inside one dot of the picture: tan(angle) times the dot's width.
    bool is_lit(Vec3 away, float cosine, float longest_edge, float thickness) const {
        const float distance = length(away);
        const float slant = std::sqrt(std::max(0.0f, 1 - cosine * cosine)) / std::max(cosine, 0.05f);
        const int dot = dot_of(away);
        const float nearest = std::min(nearest_filled_[dot], std::sqrt(nearest_sampled_[dot]));
        return distance <= nearest + 1.5f * longest_edge + 2 * thickness + distance * width_ * slant;
    }

 private:
    static constexpr int kCubeSide = 32, kSquareSide = 64;
    static constexpr int kMostSamples = 16;  // along an edge: what is so near that it needs more is filled dot by dot
    static constexpr int kMostFilled = 256;  // triangles; a charge has about 15 of an even mesh so near, at a pole more

    void look_at_bounds() {
        const Vertices& vertices = shell_.state.vertices;
        Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
        for (uint32_t v = 0; v < shell_.vertex_count(); ++v) {
            if (vertices.element[shell_.vertex(v)] == kNone) continue;
            const Vec3 p = vertices.rest[shell_.vertex(v)];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const Vec3 towards = 0.5f * (low + high) - from_;
        const float distance = length(towards), bound = 0.5f * length(high - low);
        is_outside_ = distance > 1.2f * bound && bound > 0;
        width_ = 2.0f / kCubeSide;
        if (!is_outside_) return;
        forward_ = normalised(towards);
        const Vec3 helper = std::fabs(forward_.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        right_ = normalised(cross(helper, forward_));
        up_ = cross(forward_, right_);
        tangent_ = bound / std::sqrt(distance * distance - bound * bound);
        width_ = 2 * tangent_ / kSquareSide;
    }

    static int dot_along(float share, int side) {  // share: -1 to 1
        return std::clamp(static_cast<int>(0.5f * (share + 1) * static_cast<float>(side)), 0, side - 1);
    }
    int dot_of(Vec3 d) const {
        if (is_outside_) {
            const float ahead = std::max(dot(d, forward_), 1e-12f) * tangent_;
            const float u = std::clamp(dot(d, right_) / ahead, -1.0f, 1.0f),
                        v = std::clamp(dot(d, up_) / ahead, -1.0f, 1.0f);
            return dot_along(v, kSquareSide) * kSquareSide + dot_along(u, kSquareSide);
        }
        const float x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
        const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        const float major = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
        const float scale = 1 / std::max(std::fabs(major), 1e-12f);
        const float u = scale * (axis == 0 ? d.y : d.x), v = scale * (axis == 2 ? d.y : d.z);
        const int face = 2 * axis + (major < 0);
        return (face * kCubeSide + dot_along(std::clamp(v, -1.0f, 1.0f), kCubeSide)) * kCubeSide +
               dot_along(std::clamp(u, -1.0f, 1.0f), kCubeSide);
    }

    int side() const { return is_outside_ ? kSquareSide : kCubeSide; }
    int lines() const { return is_outside_ ? kSquareSide : 6 * kCubeSide; }
    int line_of(int dot) const { return is_outside_ ? dot / kSquareSide : dot / kCubeSide; }
    uint64_t bit_of(int dot) const { return uint64_t{1} << (is_outside_ ? dot % kSquareSide : dot % kCubeSide); }
    bool is_wanted(int dot) const { return wanted_[line_of(dot)] & bit_of(dot); }
    void want(uint32_t e, float reach) {
        const ShellRows& state = shell_.state;
        const auto& corner = state.elements.corner[shell_.element(e)];
        const Vec3 middle =
            middle_of(state.vertices.rest[shell_.vertex(corner[0])], state.vertices.rest[shell_.vertex(corner[1])],
                      state.vertices.rest[shell_.vertex(corner[2])]);
        const Vec3 away = middle - from_;
        if (!(length(away) < reach)) return;
        const int dot = dot_of(away);
        wanted_[line_of(dot)] |= bit_of(dot);
        nearest_filled_[dot] = nearest_sampled_[dot] = 1e30f;
    }

    /// Into the middle of a dot, of no particular length: what dot_of undoes.
    Vec3 middle_of_dot(int dot) const {
        const int face = dot / (side() * side());
        const auto share = [&](int at) { return (2 * static_cast<float>(at) + 1) / static_cast<float>(side()) - 1; };
        const float u = share(dot % side()), v = share(dot / side() % side());
        if (is_outside_) return forward_ + tangent_ * (u * right_ + v * up_);
        const float major = face % 2 ? -1.0f : 1.0f;
        return face / 2 == 0 ? Vec3{major, u, v} : face / 2 == 1 ? Vec3{u, major, v} : Vec3{u, v, major};
    }

    /// Every wanted dot whose middle lies behind the triangle: there the ray has all three edges' planes on one side.
    /// The plane of the triangle is met at (p.n / d.n) d.
    void fill(const Vec3 (&p)[3]) {
        const Vec3 a = cross(p[0], p[1]), b = cross(p[1], p[2]), c = cross(p[2], p[0]);
        const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
        const float height = dot(normal, p[0]);
        for (int line = 0; line < lines(); ++line) {
            const int first = line * side();
            if (!wanted_[line] || !may_meet(a, b, c, middle_of_dot(first), middle_of_dot(first + side() - 1))) continue;
            for (uint64_t left = wanted_[line]; left; left &= left - 1) {
                const int i = first + std::countr_zero(left);
                const Vec3 d = middle_of_dot(i);
                const float x = dot(a, d), y = dot(b, d), z = dot(c, d), along = dot(normal, d);
                if (!(x >= 0 && y >= 0 && z >= 0) && !(x <= 0 && y <= 0 && z <= 0)) continue;
                const float t = along != 0 ? height / along : 0;
                if (t > 0) nearest_filled_[i] = std::min(nearest_filled_[i], t * length(d));
            }
        }
    }

    /// Whether some direction from `first` to `last`, which run along a line, may have three edges' planes on one side.
    /// Products are linear along it, so that its ends bound them, to rounding. Without this a charge beside a wall
    /// looks at all dots for each of the triangles that are near: 35 ms a frame in a street.
    static bool may_meet(Vec3 a, Vec3 b, Vec3 c, Vec3 first, Vec3 last) {
        constexpr float kRounding = 1e-4f;
        bool has_upper = true, has_lower = true;
        for (const Vec3 plane : {a, b, c}) {
            const float from = dot(plane, first), to = dot(plane, last), slack = kRounding * length(plane);
            has_upper = has_upper && std::max(from, to) >= -slack;
            has_lower = has_lower && std::min(from, to) <= slack;
        }
        return has_upper || has_lower;
    }

    void draw(uint32_t e, float reach) {
        const ShellRows& state = shell_.state;
        const auto& corner = state.elements.corner[shell_.element(e)];
        Vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = state.vertices.rest[shell_.vertex(corner[k])] - from_;
        const float longest = std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
        const Vec3 middle = (1.0f / 3) * (p[0] + p[1] + p[2]);
        const float distance = length(middle);
        if (distance - longest > reach) return;
        const float near = std::max(distance - longest, 0.1f * longest);
        const float wanted = near > 0 ? longest / (near * width_) : 1.0f;
        const float radius = std::max({length(p[0] - middle), length(p[1] - middle), length(p[2] - middle)});
        if (longest > kMostSamples * width_ * (distance - radius) && filled_ < kMostFilled) {
            ++filled_;
            return fill(p);
        }
        const int samples = std::clamp(static_cast<int>(std::min(wanted, 1e3f)) + 1, 1, kMostSamples);
        const float step = 1.0f / static_cast<float>(samples);
        for (int i = 0; i <= samples; ++i)
            for (int j = 0; i + j <= samples; ++j) {
                const Vec3 at = p[0] + (static_cast<float>(i) * step) * (p[1] - p[0]) +
                                (static_cast<float>(j) * step) * (p[2] - p[0]);
                const int on = dot_of(at);
                if (is_wanted(on)) nearest_sampled_[on] = std::min(nearest_sampled_[on], dot(at, at));
            }
    }

    ShellView shell_;
    Vec3 from_, forward_, right_, up_;
    float tangent_ = 1, width_ = 1;  // of the square's half; of a dot, both at distance 1
    bool is_outside_ = false;
    int filled_ = 0;
    uint64_t wanted_[6 * kCubeSide] = {};  // a bit a dot, a word a line
    // Of the wanted dots: m; and square metres, whose least is the least's square.
    float nearest_filled_[6 * kCubeSide * kCubeSide], nearest_sampled_[6 * kCubeSide * kCubeSide];
};

/// Calls visit(element row, impulse, middle of the outer face) for each lit element in reach.
template <class Visit>
void for_each_lit(const ShellView& shell, const Explosion& explosion, Visit visit) {
    const ShellRows& state = shell.state;
    const Scratch<Shade> shade(state.scratch, shell, explosion);
    const float thickness = shell.shells().thickness[shell.row];
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (state.elements.flags[row] & kDead) continue;
        Vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = state.vertices.rest[shell.vertex(state.elements.corner[row][k])];
        const Vec3 middle = middle_of(p[0], p[1], p[2]);
        const Vec3 away = middle - explosion.centre;
        const float distance = length(away);
        if (!(distance < explosion.radius)) continue;
        const Vec3 area = 0.5f * cross(p[1] - p[0], p[2] - p[0]);
        const float size = length(area);
        if (!(size > 0) || !(distance > 0)) continue;
        const float facing = dot(area, away) / (size * distance);  // < 0: the outer face sees the centre
        const float longest = std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
        if (!shade->is_lit(away, std::fabs(facing), longest, thickness)) continue;
        const float left = 1 - distance / explosion.radius;
        visit(row, (explosion.strength * left * left * facing) * area, middle);
    }
}

}  // namespace

ExplosionSums measure_explosion(ShellView shell, const Explosion& explosion, Vec3d about) {
    ExplosionSums sums;
    for_each_lit(shell, explosion, [&](uint32_t row, Vec3 impulse, Vec3 middle) {
        const Vec3d j(impulse);
        const double size = length(j), mass = shell.state.elements.mass[row];
        sums.impulse += j;
        sums.turning += cross(Vec3d(middle) - about, j);
        sums.place += size * Vec3d(middle);
        sums.size += size;
        if (mass > 0) sums.energy += 0.5 * size * size / mass;
        if (mass > 0) sums.speed = std::max(sums.speed, static_cast<float>(size / mass));
    });
    if (sums.size > 0) sums.place = (1 / sums.size) * sums.place;
    return sums;
}

void kick_vertices(ShellView shell, const Explosion& explosion) {
    Vertices& vertices = shell.state.vertices;
    for_each_lit(shell, explosion, [&](uint32_t row, Vec3 impulse, Vec3) {
        for (const uint32_t v : shell.state.elements.corner[row]) {
            const uint32_t at = shell.vertex(v);
            const Vec3 gained = (vertices.inverse_mass[at] / 3) * impulse;
            vertices.velocity.set(at, vertices.velocity[at] + gained);
        }
    });
}

void kick_points(ShellView shell, uint32_t first_twin, const Explosion& explosion, Quat turn) {
    ShellRows& state = shell.state;
    for_each_lit(shell, explosion, [&](uint32_t row, Vec3 impulse, Vec3) {
        const Vec3 along = rotate(turn, impulse);
        for (const uint32_t v : state.elements.corner[row]) {
            const uint32_t at = shell.vertex(v);
            const Vec3 gained = (state.vertices.inverse_mass[at] / 3) * along;
            state.vertices.velocity.set(at, state.vertices.velocity[at] + gained);
            if (first_twin == kNone) continue;
            const uint32_t twin = first_twin + v;
            state.twins.velocity.set(twin, state.twins.velocity[twin] + gained);
        }
    });
}

}  // namespace cullet
