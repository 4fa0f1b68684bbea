#include "engine/import/fbx_place.hpp"

#include <cmath>
#include <cstdio>

namespace cullet {
namespace {

constexpr double kSmallestUnit = 1e-7, kLargestUnit = 1e13;  // cm; from a nanometre to a light-minute

bool is_axis(int axis) {
    return axis >= 0 && axis <= 2;
}

Vec3d axis_of(int axis, int sign) {
    const double length = sign < 0 ? -1 : 1;
    return {axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

bool is_same(Vec3d a, Vec3d b) {
    return dot(a, b) > 0.5;
}

}  // namespace

Affine place_of(const FbxAxes& axes, std::vector<std::string>& notes) {
    const int up = is_axis(axes.up) ? axes.up : 1;
    if (up != axes.up)
        notes.push_back("Its up axis is " + std::to_string(axes.up) + ", not 0, 1 or 2; y was taken for up.");
    const Vec3d y = axis_of(up, axes.up_sign);
    const bool has_coord = is_axis(axes.coord) && axes.coord != up, has_front = is_axis(axes.front) && axes.front != up;
    const Vec3d front = axis_of(axes.front, axes.front_sign);
    Vec3d x = up == 0 ? Vec3d{0, -1, 0} : Vec3d{1, 0, 0};
    if (has_coord)
        x = axis_of(axes.coord, axes.coord_sign);
    else if (has_front)
        x = cross(y, front);
    const Vec3d z = cross(x, y);
    if (!has_coord || !has_front || axes.coord == axes.front)
        notes.push_back(
            "Its up, front and right axes are not three different ones; the model may be turned about "
            "its upright.");
    else if (!is_same(z, front))
        notes.push_back("Its front axis would make it left-handed; it was taken as right-handed.");

    const bool is_length = axes.unit >= kSmallestUnit && axes.unit <= kLargestUnit;  // false for NaN
    if (!is_length) {
        char text[96];
        std::snprintf(text, sizeof text, "Its unit is %g cm, which is no length; centimetres were taken.", axes.unit);
        notes.push_back(text);
    }
    const double scale = 0.01 * (is_length ? axes.unit : 1);
    Affine place;
    place.row[0] = scale * x;
    place.row[1] = scale * y;
    place.row[2] = scale * z;
    return place;
}

}  // namespace cullet
