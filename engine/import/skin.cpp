#include "engine/import/skin.hpp"

#include <algorithm>
#include <utility>

namespace cullet {
namespace {

constexpr double kRounding = 1e-5;  // of a mesh's diagonal; joints that differ by less rest as they were bound
constexpr double kRoundingOfMoves = 1 / 4194304.0;  // 2^-22 of the way: the 24 bits of a float, and what they sum up to

void add_to(Affine& sum, double weight, const Affine& affine) {
    for (int i = 0; i < 3; ++i) sum.row[i] += weight * affine.row[i];
    sum.move += weight * affine.move;
}

bool rest_alike(const Joint& a, const Joint& b, const BindBox& box) {
    const double diagonal = length(turned(a.place, box.high - box.low));
    const double most = kRounding * diagonal + a.rounding + b.rounding;
    for (int c = 0; c < 8; ++c)
        if (!(length(placed(a.place, box.corner(c)) - placed(b.place, box.corner(c))) <= most)) return false;
    return true;
}

/// True when the place mirrors what is about the corner. Its normal stays on the outside.
bool move_corner(SourceCorner& corner, const Affine& place) {
    const bool is_mirrored = determinant(place) < 0;
    corner.position = placed(place, corner.position);
    corner.normal = turned_normal(place, corner.normal);
    if (is_mirrored) corner.normal = -corner.normal;
    return is_mirrored;
}

}  // namespace

Joint joint_at(const Affine& node, const Affine& inverse_bind) {
    const double way = length(node.move) + length(turned(node, inverse_bind.move));
    return {chained(node, inverse_bind), kRoundingOfMoves * way};
}

void BindBox::grow(Vec3d p) {
    if (is_empty) low = high = p, is_empty = false;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

std::optional<Affine> common_place(const Skin& skin, const std::vector<bool>& is_used, const BindBox& box) {
    const Joint* common = nullptr;
    for (size_t j = 0; j < skin.size(); ++j) {
        if (!is_used[j]) continue;
        if (common == nullptr) common = &skin[j];
        if (!rest_alike(*common, skin[j], box)) return std::nullopt;
    }
    return common != nullptr ? std::optional(common->place) : std::nullopt;
}

void Blend::add(double weight, const Affine& place) {
    add_to(sum_, weight, place);
    total_ += weight;
}

std::optional<Affine> Blend::mean() const {
    if (!(total_ > 0)) return std::nullopt;
    Affine mean{{{}, {}, {}}, {}};
    add_to(mean, 1 / total_, sum_);
    return mean;
}

bool append_posed_triangle(Corners& out, SourceTriangle triangle, const std::array<Affine, 3>& places) {
    int mirrored = 0;
    for (size_t c = 0; c < 3; ++c) mirrored += move_corner(triangle.corner[c], places[c]);
    if (mirrored >= 2) std::swap(triangle.corner[1], triangle.corner[2]);
    return append_triangle(out, triangle, {});
}

}  // namespace cullet
