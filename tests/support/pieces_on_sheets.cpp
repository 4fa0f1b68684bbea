#include "tests/support/pieces_on_sheets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/random.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {
namespace {

constexpr uint32_t kPiecesAWorld = 125;
constexpr float kHalf = 300;  // m, of a sheet: nothing gets to its edges
constexpr float kBehind = 0.001f;

/// A row of random numbers.
class Dice {
 public:
    Dice(uint64_t seed, uint64_t row) : random_{seed}, row_(row) {}
    float share() { return static_cast<float>(random_.uniform(row_, next_++)); }
    float between(float low, float high) { return low + (high - low) * share(); }
    /// Each doubling is as likely as the next.
    float scale(float low, float high) { return low * std::pow(high / low, share()); }
    uint32_t below(uint32_t count) {
        return std::min(count - 1, static_cast<uint32_t>(share() * static_cast<float>(count)));
    }
    Vec3 direction() {
        const float up = between(-1, 1), angle = between(0, 6.2831853f), flat = std::sqrt(1 - up * up);
        return {flat * std::cos(angle), up, flat * std::sin(angle)};
    }
    Quat turn() {
        const Vec3 axis = direction();
        const float half = between(0, 3.1415927f), s = std::sin(half);
        return {s * axis.x, s * axis.y, s * axis.z, std::cos(half)};
    }

 private:
    Random random_;
    uint64_t row_, next_ = 0;
};

/// Flat sheets that meet in the origin; pieces are on the side that all normals point to.
struct Corner {
    std::vector<Vec3> normals;
    float height_over(Vec3 p) const {
        float least = 1e30f;
        for (const Vec3 n : normals) least = std::min(least, dot(n, p));
        return least;
    }
};

struct Triangles {
    std::vector<Vec3> points;
    std::vector<std::array<uint32_t, 3>> faces;
};

// A square of cells x cells, each of two triangles, each of them wound as the dice fall.
void add_sheet(Triangles& out, Vec3 normal, uint32_t cells, Dice& dice) {
    const Vec3 side = normalised(cross(std::fabs(normal.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, normal)),
               other = cross(normal, side);
    const auto first = static_cast<uint32_t>(out.points.size());
    for (uint32_t i = 0; i <= cells; ++i)
        for (uint32_t j = 0; j <= cells; ++j) {
            const float u = 2 * static_cast<float>(i) / static_cast<float>(cells) - 1,
                        v = 2 * static_cast<float>(j) / static_cast<float>(cells) - 1;
            out.points.push_back(kHalf * u * side + kHalf * v * other);
        }
    for (uint32_t i = 0; i < cells; ++i)
        for (uint32_t j = 0; j < cells; ++j) {
            const uint32_t a = first + i * (cells + 1) + j, b = a + 1, c = a + cells + 1, d = c + 1;
            for (std::array<uint32_t, 3> face : {std::array{a, b, c}, std::array{b, d, c}}) {
                if (dice.share() < 0.5f) std::swap(face[0], face[1]);
                out.faces.push_back(face);
            }
        }
}

// One sheet, level or steep, two that make a groove, or three that make a corner.
Corner some_corner(Dice& dice) {
    const uint32_t kind = dice.below(4);
    if (kind == 0) return {{{0, 1, 0}}};
    if (kind == 1) {
        const float angle = dice.between(0, 1);
        return {{{std::sin(angle), std::cos(angle), 0}}};
    }
    Corner corner;
    if (kind == 2) {
        const float steep = dice.between(0.3f, 1.3f), tilt = dice.between(-0.2f, 0.2f);
        for (const float s : {steep + tilt, tilt - steep}) corner.normals.push_back({std::sin(s), std::cos(s), 0});
    } else {
        const float steep = dice.between(0.3f, 1.2f);
        for (int k = 0; k < 3; ++k) {
            const float around = 2.0943951f * static_cast<float>(k) + 0.3f;
            corner.normals.push_back(
                {std::sin(steep) * std::cos(around), std::cos(steep), std::sin(steep) * std::sin(around)});
        }
    }
    return corner;
}

struct Piece {
    std::vector<std::vector<Vec3>> cells;  // without their margins
    float margin, size, thickness, ball = 0;
};

// A flat shard: corners around an ellipse, as long as it is wide or many times as long.
Piece shard(float size, float thickness, Dice& dice) {
    Piece piece{{{}}, std::min(0.001f, 0.2f * thickness), size, thickness};
    const uint32_t corners = 3 + dice.below(6);
    const float narrow = dice.scale(0.08f, 1), half = 0.5f * thickness - piece.margin;
    for (uint32_t k = 0; k < corners; ++k) {
        const float angle = 6.2831853f * (static_cast<float>(k) + dice.between(0, 0.6f)) / static_cast<float>(corners);
        for (const float y : {-half, half})
            piece.cells[0].push_back({0.5f * size * std::cos(angle), y, 0.5f * size * narrow * std::sin(angle)});
    }
    return piece;
}

// Part of a shell about a ball, in cells.
Piece curved_shell(float size, float thickness, Dice& dice) {
    Piece piece{{}, std::min(0.001f, 0.2f * thickness), size, thickness};
    constexpr uint32_t kCells = 3;
    const float radius = size * dice.scale(0.55f, 3), half = 0.5f * thickness - piece.margin;
    const auto at = [&](uint32_t i, uint32_t j, float lift) {
        const float u = size * 0.7f * (static_cast<float>(i) / kCells - 0.5f),
                    v = size * 0.7f * (static_cast<float>(j) / kCells - 0.5f);
        const Vec3 out =
            normalised(Vec3{u, std::sqrt(std::max(0.01f * radius * radius, radius * radius - u * u - v * v)), v});
        return (radius + lift) * out - Vec3{0, radius, 0};
    };
    for (uint32_t i = 0; i < kCells; ++i)
        for (uint32_t j = 0; j < kCells; ++j) {
            std::vector<Vec3> cell;
            for (const float lift : {-half, half})
                for (const uint32_t k : {0u, 1u})
                    for (const uint32_t l : {0u, 1u}) cell.push_back(at(i + k, j + l, lift));
            piece.cells.push_back(cell);
        }
    return piece;
}

Piece some_piece(Dice& dice) {
    const float size = dice.scale(0.003f, 2), thickness = dice.scale(0.0002f, std::min(0.1f, size));
    const uint32_t kind = dice.below(8);
    if (kind == 0) return {{}, 0, size, size, 0.5f * size};
    return kind < 5 ? shard(size, thickness, dice) : curved_shell(size, thickness, dice);
}

// Mass and inertia as of a plate of this size.
void add_piece(RigidWorld& world, RigidId id, const Piece& piece, const Corner& corner, Dice& dice) {
    RigidDescription d;
    std::vector<ConvexPiece> pieces;
    for (const auto& cell : piece.cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    d.pieces = pieces;
    d.margin = piece.margin;
    d.radius = piece.ball;
    const double size = static_cast<double>(piece.size), thick = static_cast<double>(piece.thickness);
    d.mass = 2400 * 0.6 * size * size * thick;
    const double flat = d.mass / 12 * 0.6 * (size * size + thick * thick);
    d.inertia = {flat, 2 * flat, flat};
    Vec3d sum;
    double count = 0;
    for (const auto& cell : piece.cells)
        for (const Vec3 p : cell) sum += Vec3d(p), ++count;
    if (count > 0) d.centre = (1 / count) * sum;
    d.layer = 2, d.mask = 1;  // it meets sheets alone
    d.friction = dice.between(0, 0.8f);
    d.restitution = dice.between(0, 0.4f);
    // Most begin in the air, some with their middle just above the sheet and a part of them behind it.
    const bool is_cut = dice.share() < 0.15f;
    Vec3 middle;
    const float room = is_cut ? 0.1f : piece.size;
    for (float wide = 3; !(corner.height_over(middle) > room); wide *= 1.1f)  // narrow corners have their room far up
        middle = {dice.between(-wide, wide), dice.between(0, wide), dice.between(-wide, wide)};
    if (is_cut) {  // down to a twentieth of its size
        const float wanted = std::max(0.002f, 0.05f * piece.size);
        middle = middle * (wanted / corner.height_over(middle));
    }
    d.pose.orientation = dice.turn();
    d.pose.position = middle - rotate(d.pose.orientation, d.centre.to_float());
    Vec3 towards = dice.direction();
    if (dot(towards, corner.normals[0]) > 0 && dice.share() < 0.8f) towards = -towards;
    const float speed = dice.share() < 0.5f ? dice.between(0, 30) : dice.scale(0.1f, 30);
    d.motion = {speed * towards, dice.between(0, std::min(60.0f, 2 * speed / piece.size)) * dice.direction()};
    world.add(id, d);
}

void throw_some(uint64_t seed, uint64_t group, uint32_t count, uint32_t steps_a_second, ThrownPieces& sum) {
    Dice dice(seed, group << 20);
    const Corner corner = some_corner(dice);
    Triangles sheet;
    for (const Vec3 n : corner.normals) add_sheet(sheet, n, 1 + dice.below(2) * dice.below(40), dice);
    const std::unique_ptr<RigidWorld> world = make_bullet_world(count + 1);
    world->set_gravity({0, -9.81f, 0});
    world->add_static_triangles(0, sheet.points, sheet.faces, 0.5f, 0.2f, 1, ~0u);
    std::vector<Vec3d> centres(count);
    for (uint32_t k = 0; k < count; ++k) {
        Dice own(seed, (group << 20) + k + 1);
        const Piece piece = some_piece(own);
        add_piece(*world, k + 1, piece, corner, own);
        double points = 0;
        for (const auto& cell : piece.cells)
            for (const Vec3 p : cell) centres[k] += Vec3d(p), ++points;
        if (points > 0) centres[k] = (1 / points) * centres[k];
    }
    const float dt = 1 / static_cast<float>(steps_a_second);
    std::vector<float> lowest(count, 1);
    for (uint32_t step = 0; step < steps_a_second; ++step) {
        world->detect(dt);
        world->solve(dt);
        for (uint32_t k = 0; k < count; ++k) {
            const Pose pose = world->pose(k + 1);
            const Vec3 middle = pose.position + rotate(pose.orientation, centres[k].to_float());
            lowest[k] = std::min(lowest[k], corner.height_over(middle));
        }
    }
    sum.pieces += count;
    for (const float low : lowest) {
        sum.behind += !(low > -kBehind);
        sum.farthest = std::max(sum.farthest, -low);
    }
}

}  // namespace

ThrownPieces throw_pieces(uint64_t seed, uint32_t count, uint32_t steps_a_second) {
    ThrownPieces sum;
    for (uint64_t group = 0; sum.pieces < count; ++group)
        throw_some(seed, group, std::min(kPiecesAWorld, count - sum.pieces), steps_a_second, sum);
    return sum;
}

}  // namespace cullet
